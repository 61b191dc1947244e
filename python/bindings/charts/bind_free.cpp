// SPDX-License-Identifier: MIT
// Free rotation, and the charts that are read from it.
#include "charts/many_states.hpp"
#include "charts/propagate.hpp"
#include "charts/states.hpp"
#include "interface/value.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/rounding_sensitivity.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

void require_sign(const char* what, int sign) {
  if (sign != 1 && sign != -1) throw DomainError(std::string(what) + ": expected 1 or -1");
}

// Whatever else these sets must satisfy depends on the body: to_rotor says so.
SerretState checked(const SerretState& s) {
  require_finite("SerretState", {s.g0, s.h, s.t0, s.G, s.H, s.T});
  require_sign("SerretState: sign_g1", s.sign_g1);
  require_sign("SerretState: sign_g3", s.sign_g3);
  return s;
}
SadovState checked(const SadovState& s) {
  require_finite("SadovState", {s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h});
  if (s.region != SadovRegion::short_axis && s.region != SadovRegion::long_axis)
    throw DomainError("SadovState: region: expected a SadovRegion");
  require_sign("SadovState: lobe", s.lobe);
  return s;
}
// Observers' words too.
Regime mode_of(nb::handle value, const char* name) {
  if (nb::isinstance<nb::str>(value)) {
    const auto word = nb::cast<std::string>(value);
    if (word == "SAM") return Regime::short_axis;
    if (word == "LAM") return Regime::long_axis;
  }
  return choice<Regime>(value, name);
}
int mode_named(nb::handle word, const char* field) {
  return static_cast<int>(mode_of(word, field));
}

TumblerState checked(const TumblerState& s) {
  require_finite("TumblerState", {s.precession_period, s.rotation_period, s.pole.x, s.pole.y,
                                  s.pole.z, s.phi0, s.psi0});
  if (s.mode != Regime::short_axis && s.mode != Regime::long_axis)
    throw DomainError("TumblerState: mode: expected Regime.short_axis or Regime.long_axis");
  require_sign("TumblerState: branch", s.branch);
  require_sign("TumblerState: sense", s.sense);
  return s;
}

constexpr Field sign_field(const char* name, const char* text, std::size_t offset) {
  return {name, text, offset, Kind::integer, nullptr, nullptr, 1};
}

constexpr Chart<SerretState, 8> serret_chart{
    "SerretState",
    R"(Serret's elements g0, h (rad), t0 (time), G, H, T (energy): constants of free rotation.

sign_g1 and sign_g3 are the signs of the momentum along the axes of least and greatest moment at t0.
[SA section 3.1, (56)-(62)])",
    {{{"g0", "Andoyer's g at the instant t0, rad.", offsetof(SerretState, g0)},
      {"h", "Node of the invariable plane, rad.", offsetof(SerretState, h)},
      {"t0", "Instant at which the elliptic argument is zero, in the unit of time.",
       offsetof(SerretState, t0)},
      {"G", "Size of the angular momentum.", offsetof(SerretState, G)},
      {"H", "Its part along the frame's third axis.", offsetof(SerretState, H)},
      {"T", "Kinetic energy.", offsetof(SerretState, T)},
      sign_field("sign_g1", "Sign of the momentum along the axis of least moment at t0: 1 or -1.",
                 offsetof(SerretState, sign_g1)),
      sign_field("sign_g3",
                 "Sign of the momentum along the axis of greatest moment at t0: 1 or -1.",
                 offsetof(SerretState, sign_g3))}},
    checked,
    true};

constexpr Chart<SadovState, 8> sadov_chart{
    "SadovState",
    R"(Sadov's action-angle variables: angles phi_l, phi_g, phi_h (rad), actions I_l, I_g, I_h.

region says about which axis the momentum circulates (SadovRegion); in the long-axis region lobe is
the sign of the momentum along the long axis. [SA "actions", "phiSadov"])",
    {{{"phi_l", "Angle of the motion in the body, rad.", offsetof(SadovState, phi_l)},
      {"phi_g", "Angle of the precession about the angular momentum, rad.",
       offsetof(SadovState, phi_g)},
      {"phi_h", "Node of the invariable plane, rad.", offsetof(SadovState, phi_h)},
      {"I_l", "Action of the motion in the body, a momentum.", offsetof(SadovState, I_l)},
      {"I_g", "Size of the angular momentum.", offsetof(SadovState, I_g)},
      {"I_h", "Part of the momentum along the frame's third axis.", offsetof(SadovState, I_h)},
      enum_field<SadovRegion>("region", "About which axis the momentum circulates, a SadovRegion.",
                              offsetof(SadovState, region), "SadovRegion",
                              static_cast<int>(SadovRegion::short_axis)),
      sign_field("lobe", "Sign of the momentum along that axis: 1 or -1.",
                 offsetof(SadovState, lobe))}},
    checked,
    true};

constexpr Chart<TumblerState, 8> tumbler_chart{
    "TumblerState",
    R"(A tumbling asteroid as observers describe it (Kaasalainen 2001, long-axis convention).

precession_period P_phi, of the long axis, and rotation_period P_psi (time), pole (..., 3):
direction of the momentum in inertial axes; mode Regime.short_axis or "SAM", Regime.long_axis or
"LAM"; phi0, psi0 (rad) at the epoch; branch: sign of cos theta; sense: -1 for a SAM about the far
side of the short axis.)",
    {{{"precession_period", "P_phi, of the long axis about the momentum, in the unit of time.",
       offsetof(TumblerState, precession_period)},
      {"rotation_period", "P_psi, about the long axis, in the unit of time.",
       offsetof(TumblerState, rotation_period)},
      {"pole", "Direction of the momentum in inertial axes; (..., 3).",
       offsetof(TumblerState, pole), Kind::vector},
      {"mode", "Regime.short_axis or \"SAM\", Regime.long_axis or \"LAM\".",
       offsetof(TumblerState, mode), Kind::integer, member_of<Regime>, "Regime", 0, mode_named},
      {"phi0", "Precession angle at the epoch, rad.", offsetof(TumblerState, phi0)},
      {"psi0", "Rotation angle at the epoch, rad.", offsetof(TumblerState, psi0)},
      sign_field("branch", "Sign of cos theta: 1 or -1.", offsetof(TumblerState, branch)),
      sign_field("sense", "-1 for a SAM about the far side of the short axis, else 1.",
                 offsetof(TumblerState, sense))}},
    checked};

const RotorState& single(const Rotors& states, const char* what) {
  if (!states.shape().empty())
    throw nb::value_error((std::string(what) + ": got states of shape " + text_of(states.shape()) +
                           "; expected one state")
                              .c_str());
  return states[0];
}

bool same_rates(const FreeRotation& a, const FreeRotation& b) {
  return a.kernel().phase_rate == b.kernel().phase_rate &&
         a.kernel().half_precession == b.kernel().half_precession;
}

// Prepared in double precision throughout, if that makes a difference.
bool is_short_arc(const FreeRotation& f) {
  return !same_rates(f, FreeRotation(f.body(), f.initial_state(), f.epoch()));
}

void def_motion(nb::class_<FreeRotation>& c) {
  c.def(
       "__init__",
       [](FreeRotation* self, const Body& body, const Rotors& s0, double t0) {
         new (self) FreeRotation(body, single(s0, "FreeRotation"), t0);
       },
       "body"_a, "s0"_a, "t0"_a = 0.0)
      .def_static(
          "short_arc",
          [](const Body& body, const Rotors& s0, double t0) {
            return FreeRotation::short_arc(body, single(s0, "FreeRotation.short_arc"), t0);
          },
          "body"_a, "s0"_a, "t0"_a = 0.0,
          "The same, prepared in double precision throughout: a microsecond, for a few turns.")
      .def(
          "at",
          [](const FreeRotation& f, ArrayLike t, int threads) {
            const Numbers times(t, "t");
            const std::size_t count = size_of(times.shape());
            return Rotors::filled(times.shape(), [&](RotorState* states) {
              const auto some = [&](std::size_t begin, std::size_t end) {
                f.at({times.at(begin), end - begin}, {states + begin, end - begin});
              };
              for_each_part(count, some, checked_threads(threads), least_states);
            });
          },
          "t"_a, nb::kw_only(), "threads"_a = 1,
          "The exact state at time t: t of any shape, a RotorState of that shape. NaN in, NaN out. "
          "Many times in one call are several times as fast as one by one, with the same bits, on "
          "any number of threads.")
      .def("at_grid", states_of_grid, "start"_a, "step"_a, "count"_a, nb::kw_only(), "first"_a = 0,
           "threads"_a = 1,
           R"(The states first, first + 1, ..., first + count - 1 of an even grid of times.

Parameters
----------
start, step : state i of the grid is at the time start + i step, without rounding.
count : how many, an int.
first : the index to begin with, an int; the grid ends at 2**53.
threads : how many parts at a time, from 1. No bit depends on it.

A RotorState of shape (count,), three times as fast as at() of as many times. The bits of a state
depend on the grid and its index alone, not on first and count; they are not those of at(), from
which they differ by rounding. NaN where a time is not finite. ValueError for a negative count or
first. Without the GIL.)")
      .def(
          "state_transition",
          [](const FreeRotation& f, ArrayLike t) {
            const Numbers times(t, "t");
            return mapped_numbers(times, {6, 6}, [&](double at) { return f.state_transition(at); });
          },
          "t"_a,
          "d(dtheta_B, dg_B)(t) / d(dtheta_B, dg_B)(t0): (..., 6, 6); attitude changes in body "
          "axes, q exp(dtheta_B / 2).");
}

// A motion as a value: what it prints, that it is copied, pickled and compared.
void def_motion_value(nb::class_<FreeRotation>& c) {
  c.def("__repr__",
        [](const FreeRotation& f) {
          const double turn = 2.0 * pi<double>();
          return "<FreeRotation: " + nb::cast<std::string>(nb::cast(f.regime()).attr("name")) +
                 ", G=" + number_text(f.momentum()) + ", T=" + number_text(f.energy()) +
                 ", polhode_period=" + number_text(f.polhode_period()) +
                 ", precession_period=" + number_text(turn / f.precession_rate_long()) + ">";
        })
      .def("__copy__", [](const FreeRotation& f) { return f; })
      .def(
          "__deepcopy__", [](const FreeRotation& f, nb::handle) { return f; }, "memo"_a)
      .def("__getstate__",
           [](const FreeRotation& f) {
             return nb::make_tuple(f.body(), Rotors::one(f.initial_state()), f.epoch(),
                                   is_short_arc(f));
           })
      .def("__setstate__",
           [](FreeRotation& f, const std::tuple<Body, Rotors, double, bool>& state) {
             const auto& [body, s0, t0, is_short] = state;
             new (&f) FreeRotation(is_short ? FreeRotation::short_arc(body, s0[0], t0)
                                            : FreeRotation(body, s0[0], t0));
           })
      .def(
          "__eq__",
          [](const FreeRotation& a, const FreeRotation& b) {
            return a.body().moments() == b.body().moments() && a.body().q_FB() == b.body().q_FB() &&
                   a.initial_state() == b.initial_state() && a.epoch() == b.epoch() &&
                   same_rates(a, b);
          },
          nb::is_operator(), "other"_a);
  c.attr("__hash__") = nb::none();
}

void bind_motion(nb::module_& m) {
  bind_made_value<elliptic::Modulus>(
      m, "Modulus",
      "The modulus m of elliptic functions with its complement: m1 = 1 - m keeps its digits near "
      "the separatrix.",
      [](double p, double q) { return elliptic::Modulus::from_pair(p, q); },
      field("m", &elliptic::Modulus::m, "The parameter m = k^2."),
      field("m1", &elliptic::Modulus::m1, "1 - m, to its own full accuracy."));
  using F = FreeRotation;
  nb::class_<F> c(m, "FreeRotation",
                  R"(The exact torque-free motion of a body, at any time, in every regime. [SA (12)]

body: Body; s0: RotorState (one state) at time t0. Prepared once, in tens of microseconds; at(t)
then costs tens of nanoseconds a state, however far t is. ValueError for a rate g / I beyond double
range.)");
  def_motion(c);
  def_motion_value(c);
  c.def_prop_ro(
       "body", [](const F& f) { return f.body(); }, "The body that rotates.")
      .def_prop_ro(
          "initial_state", [](const F& f) { return Rotors::one(f.initial_state()); },
          "The state at the epoch, as given.")
      .def_prop_ro("epoch", &F::epoch, "t0.")
      .def_prop_ro("regime", &F::regime, "Which way the momentum moves in the body.")
      .def_prop_ro("momentum", &F::momentum, "G, the length of the angular momentum.")
      .def_prop_ro("energy", &F::energy, "T, the kinetic energy.")
      .def_prop_ro("modulus", &F::modulus, "Modulus of the motion; m = 0 when steady.")
      .def_prop_ro("separatrix_distance", &F::separatrix_distance,
                   "G^2 - 2 T I2: > 0 in short-axis mode, < 0 in long-axis mode.")
      .def_prop_ro("circulates_long_axis", &F::circulates_long_axis,
                   "Whether the momentum circulates about the axis of least moment.")
      .def_prop_ro("sign_g1", &F::sign_g1, "Sign of the momentum along the axis of least moment.")
      .def_prop_ro("sign_g3", &F::sign_g3,
                   "Sign of the momentum along the axis of greatest moment.")
      .def_prop_ro("circulation_action", &F::circulation_action,
                   "(1/2pi) of the integral of g3' dl' over a polhode; 0 where there is none.")
      .def_prop_ro("circulation_deficit", &F::circulation_deficit,
                   "G minus circulation_action, to its own full accuracy.")
      .def_prop_ro("polhode_period", &F::polhode_period,
                   "Period of the momentum in the body; inf where it does not return.")
      .def_prop_ro("precession_rate_long", &F::precession_rate_long,
                   "Mean rate (rad per time) of the long axis about the momentum.")
      .def_prop_ro("precession_rate_short", &F::precession_rate_short,
                   "Mean rate (rad per time) of the short axis about the momentum.");
}

// A chart of a motion at times, and the same of any states: each is the epoch of its own motion.
template <class To, class Of>
void def_flow_chart(nb::module_& m, const char* name, Of of, const char* doc) {
  m.def(
      name,
      [of](const FreeRotation& motion, ArrayLike t, int threads) {
        const Numbers times(t, "t");
        return mapped(
            times, [&](double at) { return of(motion, at); }, checked_threads(threads));
      },
      "body"_a, "t"_a, nb::kw_only(), "threads"_a = 1, doc);
  m.def(
      name,
      [of](const Body& body, const Rotors& states, ArrayLike t, int threads) {
        Numbers times(t, "t");
        return mapped(
            states, times,
            [&](const RotorState& s, double at) { return of(FreeRotation(body, s, at), at); },
            checked_threads(threads));
      },
      "body"_a, "state"_a, "t"_a = 0.0, nb::kw_only(), "threads"_a = 1, doc);
}

void bind_flow_charts(nb::module_& m) {
  bind_states<6>(m, serret_chart);
  bind_states<6>(m, sadov_chart);
  bind_states<6>(m, tumbler_chart);
  bind_to_serret(m);
  bind_to_sadov(m);
  def_flow_chart<TumblerState>(
      m, "to_tumbler", [](const FreeRotation& f, double t) { return to_tumbler(f, t); },
      "Observers' description of a motion at time t, or of any states. ValueError where there is "
      "none: steady rotation, separatrix, rest.");
  bind_rotor_of_sadov(m);
  m.def(
      "to_rotor",
      [](const Body& body, const Batch<TumblerState>& states, int threads) {
        return mapped(
            states, [&](const TumblerState& s) { return to_rotor(body, s); },
            checked_threads(threads));
      },
      "body"_a, "state"_a, nb::kw_only(), "threads"_a = 1,
      "The hub state at the epoch of the angles. ValueError for periods that the body cannot "
      "have.");
  bind_rotor_of_serret(m);
}

void bind_flow_jacobians(nb::module_& m) {
  m.def(
      "chart_jacobian",
      [](const Body& body, const Batch<SadovState>& states) {
        return mapped_numbers(states, {6, 6},
                              [&](const SadovState& s) { return chart_jacobian(body, s); });
      },
      "body"_a, "state"_a,
      "B of action-angle variables: (..., 6, 6), columns phi_l, phi_g, phi_h, I_l, I_g, I_h.");
  m.def(
      "chart_jacobian",
      [](const Body& body, const Batch<SerretState>& states, ArrayLike t) {
        Numbers times(t, "t");
        return mapped_numbers(states, times, {6, 6}, [&](const SerretState& s, double at) {
          return chart_jacobian(body, s, at);
        });
      },
      "body"_a, "state"_a, "t"_a,
      "B at time t of Serret's elements: (..., 6, 6), columns g0, h, -t0, G, H, T: canonical with "
      "-t0 as the third angle.");
}

void bind_properties(nb::module_& m) {
  using N = SadovFrequencies;
  bind_value<N>(m, "SadovFrequencies", "Constant rates (rad per time) of phi_l and phi_g; n_h = 0.",
                field("n_l", &N::n_l, "Rate of phi_l."), field("n_g", &N::n_g, "Rate of phi_g."));
  m.def("sadov_frequencies", &sadov_frequencies, "motion"_a,
        "The rates n = dT/dI of a motion. [SA \"Hamilton\" in section 5]");
  m.def("psi_max", &psi_max, "motion"_a,
        "Largest |psi| (rad) of a motion in short-axis mode; NaN in other regimes.");
  m.def(
      "rounding_sensitivity", &free::rounding_sensitivity, "motion"_a, "t"_a,
      "How far (rad) the attitude at t moves when one component of the moments or of the momentum\n"
      "changes by its last digit: the largest of all. NaN for a time that is not finite.");
  m.def(
      "long_axis_period", &long_axis_period, "short_axis_period"_a, "rotation_period"_a,
      "P_phi of the long axis where that of the short one is known: 1/P_phi = 1/P_short - 1/P_psi "
      "in both modes, in the unit of the periods. ValueError unless 0 < P_short < P_psi.");
  m.def(
      "least_period_ratio",
      [](const Body& body, OneOf<Regime> mode) {
        return least_period_ratio(body, mode_of(mode, "mode"));
      },
      "body"_a, "mode"_a, "The least P_psi / P_phi that the body has in a mode.");
  m.def(
      "free_rotation",
      [](const Body& body, const Batch<SerretState>& s) {
        if (!s.shape().empty()) throw nb::value_error("free_rotation: expected one SerretState");
        return free_rotation(body, s[0]);
      },
      "body"_a, "state"_a, "The motion with these elements, epoch t0.");
}

}  // namespace

void bind_free(nb::module_& m) {
  nb::enum_<Regime>(m, "Regime", "Which way the momentum moves in the body.", nb::is_arithmetic())
      .value("rest", Regime::rest, "G = 0")
      .value("steady", Regime::steady, "omega parallel to g")
      .value("short_axis", Regime::short_axis, "circulation about the axis of greatest moment")
      .value("long_axis", Regime::long_axis, "circulation about the axis of least moment")
      .value("separatrix", Regime::separatrix, "G^2 = 2 T I2 exactly");
  nb::enum_<SadovRegion>(m, "SadovRegion", "Where action-angle variables live.",
                         nb::is_arithmetic())
      .value("short_axis", SadovRegion::short_axis, "circulation about the axis of greatest moment")
      .value("long_axis", SadovRegion::long_axis, "circulation about the axis of least moment");
  bind_motion(m);
  bind_propagate(m);
  bind_flow_charts(m);
  bind_flow_jacobians(m);
  bind_properties(m);
}

}  // namespace polhode::python
