// SPDX-License-Identifier: MIT
#include "motion/system_functions.hpp"

#include "charts/canonical_chart.hpp"
#include "charts/states.hpp"
#include "motion/system_value.hpp"
#include "polhode/system/axes.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "polhode/system/osculation.hpp"

namespace polhode {
inline namespace v0 {

// Python compares whatever it holds.
inline bool operator==(const AngularVelocities& a, const AngularVelocities& b) {
  return a.inertial == b.inertial && a.relative == b.relative;
}
inline bool operator==(const RotorRates& a, const RotorRates& b) {
  return a.q == b.q && a.g == b.g;
}

}  // namespace v0
}  // namespace polhode

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;
using Andoyers = Batch<AndoyerState>;

// A result is checked only where a user makes one.
template <class R>
R unchecked(const R& r) {
  return r;
}

constexpr Chart<Effect, 2> effect_chart{
    "Effect",
    R"(What a system's terms and frame do to a rotor: w_SB = I^-1 g + v, dg/dt = g x w_SB + u.

v (..., 3): rate (rad per time) that they add to I^-1 g, the convective term of the paper as a
vector; u (..., 3): torque, momentum per time. Components along the body axes. [SA (105)-(107)])",
    {{{"v", "Rate that is added to I^-1 g, body components, rad per time; (..., 3).",
       offsetof(Effect, v), Kind::vector},
      {"u", "Torque, body components, momentum per time; (..., 3).", offsetof(Effect, u),
       Kind::vector}}},
    unchecked};

constexpr Chart<AngularVelocities, 2> velocities_chart{
    "AngularVelocities",
    R"(The angular velocity of a body, twice; components along the body axes, rad per time.

inertial (..., 3): with respect to inertial axes, I^-1 g + v(terms); relative (..., 3): with respect
to the reference frame, less by mu. [SA (124)])",
    {{{"inertial", "With respect to inertial axes, body components, rad per time; (..., 3).",
       offsetof(AngularVelocities, inertial), Kind::vector},
      {"relative", "With respect to the reference frame, body components, rad per time; (..., 3).",
       offsetof(AngularVelocities, relative), Kind::vector}}},
    unchecked};

constexpr Chart<RotorRates, 2> rotor_rates_chart{
    "RotorRates",
    "Rates of a hub state: q (..., 4), dq_SB/dt; g (..., 3), dg_B/dt.",
    {{{"q", "dq_SB/dt, per time; (..., 4).", offsetof(RotorRates, q), Kind::quaternion},
      {"g", "dg_B/dt, momentum per time; (..., 3).", offsetof(RotorRates, g), Kind::vector}}},
    unchecked};

constexpr Chart<rates::HubRates, 2> hub_rates_chart{
    "HubRates",
    "Rates in the tangent of chart_jacobian: theta (..., "
    "3), w_SB, the rate of turn relative to the "
    "frame; g (..., 3), dg_B/dt. Body components.",
    {{{"theta",
       "w_SB, the rate of turn relative to the frame, body components, rad per time; (..., 3).",
       offsetof(rates::HubRates, theta), Kind::vector},
      {"g", "dg_B/dt, momentum per time; (..., 3).", offsetof(rates::HubRates, g), Kind::vector}}},
    unchecked};

constexpr Chart<rates::AndoyerRates, 6> andoyer_rates_chart{
    "AndoyerRates",
    "Rates of Andoyer variables: l, g, h (rad per time), L, G, H (momentum per time). NaN where "
    "one "
    "does not exist.",
    {{{"l", "dl/dt, rad per time.", offsetof(rates::AndoyerRates, l)},
      {"g", "dg/dt, rad per time.", offsetof(rates::AndoyerRates, g)},
      {"h", "dh/dt, rad per time.", offsetof(rates::AndoyerRates, h)},
      {"L", "dL/dt, momentum per time.", offsetof(rates::AndoyerRates, L)},
      {"G", "dG/dt, momentum per time.", offsetof(rates::AndoyerRates, G)},
      {"H", "dH/dt, momentum per time.", offsetof(rates::AndoyerRates, H)}}},
    unchecked};

constexpr Chart<rates::EulerPhaseRates, 6> phase_rates_chart{
    "EulerPhaseRates",
    "Rates of Euler angles (rad per time) and of their canonical momenta. NaN where one does not "
    "exist: of phi and psi at theta = 0, pi.",
    {{{"phi", "dphi/dt, rad per time.", offsetof(rates::EulerPhaseRates, phi)},
      {"theta", "dtheta/dt, rad per time.", offsetof(rates::EulerPhaseRates, theta)},
      {"psi", "dpsi/dt, rad per time.", offsetof(rates::EulerPhaseRates, psi)},
      {"Phi", "dPhi/dt, momentum per time.", offsetof(rates::EulerPhaseRates, Phi)},
      {"Theta", "dTheta/dt, momentum per time.", offsetof(rates::EulerPhaseRates, Theta)},
      {"Psi", "dPsi/dt, momentum per time.", offsetof(rates::EulerPhaseRates, Psi)}}},
    unchecked};

constexpr Chart<charts::AxisAngles, 2> axis_chart{
    "AxisAngles",
    "An axis as the plane that it is normal to: inclination I in [0, pi] and node h (rad).",
    {{{"I", "Inclination of the plane that the axis is normal to, rad, in [0, pi].",
       offsetof(charts::AxisAngles, I)},
      {"h", "Node of that plane, rad.", offsetof(charts::AxisAngles, h)}}},
    unchecked};

// f(system, t, state) of times and states that broadcast: a set of structs.
template <class S, class F>
void def_states(nb::module_& m, const char* name, F f, const char* doc) {
  m.def(
      name,
      [f](const PythonSystem& system, ArrayLike t, const Batch<S>& states) {
        Numbers times(t, "t");
        return mapped(states, times, [&](const S& s, double at) { return f(system, at, s); });
      },
      "system"_a, "t"_a, "state"_a, doc);
}

void bind_motion(nb::module_& m) {
  def_states<RotorState>(
      m, "effect", [](const System& of, double t, const RotorState& s) { return effect(of, t, s); },
      "The sum of all effects on states of any shape, the frame's own included, in body "
      "components: "
      ".v (..., 3), rad per time, what is added to I^-1 g; .u (..., 3), torque. States are those "
      "relative to the system's frame. [SA (105)-(107), (118)]");
  def_states<RotorState>(
      m, "angular_velocity",
      [](const System& of, double t, const RotorState& s) { return angular_velocity(of, t, s); },
      "Both angular velocities of states: .inertial = I^-1 g + v(terms), .relative less by mu. "
      "[SA (124)]");
  def_states<RotorState>(
      m, "rotor_rates",
      [](const System& of, double t, const RotorState& s) { return rotor_rates(of, t, s); },
      "The equations of motion: dq/dt and dg/dt.");
  def_states<RotorState>(
      m, "hub_rates",
      [](const System& of, double t, const RotorState& s) { return rates::hub_rates(of, t, s); },
      "The equations of motion as rates of turn: w_SB and dg/dt.");
  m.def(
      "energy",
      [](const PythonSystem& system, ArrayLike t, const Rotors& states) -> Floats {
        Numbers times(t, "t");
        return mapped_numbers(states, times, {}, [&](const RotorState& s, double at) {
          return energy(system, at, s);
        });
      },
      "system"_a, "t"_a, "state"_a,
      "The Hamiltonian of the motion in S: kinetic energy, the terms' energies, and -mu . g. "
      "Constant where nothing depends on time. ValueError where a term has none.");
  def_states<RotorState>(
      m, "inertial_state",
      [](const System& of, double t, const RotorState& s) { return inertial_state(of, t, s); },
      "The same states described in inertial axes.");
  def_states<RotorState>(
      m, "reference_state",
      [](const System& of, double t, const RotorState& s) { return reference_state(of, t, s); },
      "States given in inertial axes, described in the reference frame.");
}

void bind_osculation(nb::module_& m) {
  def_states<RotorState>(
      m, "osculating_state",
      [](const System& of, double t, const RotorState& s) {
        return charts::osculating_state(of, t, s);
      },
      "The states of the free rotors that have the attitude and the angular velocity of this "
      "instant: g + I v. [SA (104)-(107), (118)]");
  def_states<RotorState>(
      m, "canonical_state",
      [](const System& of, double t, const RotorState& s) {
        return charts::canonical_state(of, t, s);
      },
      "The inverse of osculating_state, by Newton's method. ValueError where it does not "
      "converge.");
  def_states<RotorState>(
      m, "osculating_andoyer",
      [](const System& of, double t, const RotorState& s) {
        return charts::osculating_andoyer(of, t, s);
      },
      "Andoyer's elements of the osculating states of canonical ones. The canonical elements are "
      "to_andoyer(state).");
  m.def(
      "osculating_andoyer",
      [](const PythonSystem& system, ArrayLike t, const Andoyers& states) {
        Numbers times(t, "t");
        return mapped(states, times, [&](const AndoyerState& s, double at) {
          return charts::osculating_andoyer(system, at, s);
        });
      },
      "system"_a, "t"_a, "state"_a, "Osculating elements of canonical ones.");
  m.def(
      "canonical_andoyer",
      [](const PythonSystem& system, ArrayLike t, const Andoyers& states) {
        Numbers times(t, "t");
        return mapped(states, times, [&](const AndoyerState& s, double at) {
          return charts::canonical_andoyer(system, at, s);
        });
      },
      "system"_a, "t"_a, "osculating"_a, "Canonical elements of osculating ones.");
}

// Andoyer's variables at an epoch t0 of states at times t.
void bind_modified(nb::module_& m) {
  m.def(
      "modified_andoyer",
      [](const Body& body, ArrayLike t, const Rotors& states, double t0) {
        Numbers times(t, "t");
        return mapped(states, times, [&](const RotorState& s, double at) {
          return charts::modified_andoyer(body, at, s, t0);
        });
      },
      "body"_a, "t"_a, "state"_a, "t0"_a,
      "The modified Andoyer set: the AndoyerState that the free motion through a state at time t "
      "has at the epoch t0. [SA (102), (103)]");
  m.def(
      "from_modified_andoyer",
      [](const Body& body, ArrayLike t, const Andoyers& states, double t0) {
        Numbers times(t, "t");
        return mapped(states, times, [&](const AndoyerState& s, double at) {
          return charts::from_modified_andoyer(body, at, s, t0);
        });
      },
      "body"_a, "t"_a, "state"_a, "t0"_a,
      "The state at time t of a modified Andoyer set with epoch t0.");
  m.def(
      "modified_andoyer_rates",
      [](const PythonSystem& system, ArrayLike t, const Rotors& states, double t0) {
        Numbers times(t, "t");
        return mapped(states, times, [&](const RotorState& s, double at) {
          return charts::modified_andoyer_rates(system, at, s, t0);
        });
      },
      "system"_a, "t"_a, "state"_a, "t0"_a,
      "Rates of the modified Andoyer set at time t: zero without a perturbation. [SA (102), "
      "(103)]");
}

// f(system, t, state, chart) of N numbers.
template <std::size_t N>
void def_of_chart(nb::module_& m, const char* name,
                  std::array<double, N> (*f)(const System&, double, const RotorState&,
                                             const CanonicalChart&),
                  const char* doc) {
  m.def(
      name,
      [f](const PythonSystem& system, ArrayLike t, const Rotors& states, AnyChart chart) {
        const CanonicalChart of = chart_of(chart, "chart");
        Numbers times(t, "t");
        return mapped_numbers(states, times, {N},
                              [&](const RotorState& s, double at) { return f(system, at, s, of); });
      },
      "system"_a, "t"_a, "state"_a, "chart"_a, doc);
}

void bind_canonical_rates(nb::module_& m) {
  def_states<RotorState>(
      m, "andoyer_rates",
      [](const System& of, double t, const RotorState& s) {
        return rates::andoyer_rates(of, t, s);
      },
      "Rates of Andoyer variables under the system. [SA (101)]");
  def_states<RotorState>(
      m, "euler_phase_rates",
      [](const System& of, double t, const RotorState& s) {
        return rates::euler_phase_rates(of, t, s);
      },
      "Rates of Euler angles and of their momenta under the system.");
  def_states<RotorState>(
      m, "perturbation_rates",
      [](const System& of, double t, const RotorState& s) {
        return rates::perturbation_rates(of, t, s);
      },
      "What the terms and the frame add to the free rates (I^-1 g, g x I^-1 g).");
  def_of_chart<6>(
      m, "canonical_rates", rates::canonical_rates,
      "Rates (..., 6) of a chart, \"andoyer\", \"euler\" or a CanonicalChart, under the "
      "system: three coordinates, then three momenta, in the order of its fields. NaN "
      "where one does not exist. [SA (101)]");
  def_of_chart<6>(m, "perturbation_rates", rates::perturbation_rates,
                  "The part (..., 6) of canonical_rates that the perturbation makes. [SA "
                  "(104)-(107), (111), (118)-(122)]");
  def_of_chart<3>(m, "convective_term", rates::convective_term,
                  "What the perturbation adds to the rates of the three coordinates of a chart, "
                  "in addition to the unperturbed function of the same variables: (..., 3). Of the "
                  "Euler angles it is Phi of [SA (107), (111)].");
}

// Three axes at every state: the AxisAngles of each are views of one block.
struct AxesOfStates {
  Batch<charts::RotorAxes> all;

  Batch<charts::AxisAngles> part(std::size_t offset) const {
    return {all.shape(), all.owner(), all.first() + offset, all.stride()};
  }
};

void bind_axes(nb::module_& m) {
  nb::class_<AxesOfStates>(m, "RotorAxes",
                           "The axes of figure, of angular momentum and of rotation, each an "
                           "AxisAngles of the shape of the states.")
      .def_prop_ro(
          "shape", [](const AxesOfStates& a) { return shape_tuple(a.all.shape()); },
          "Of the states.")
      .def_prop_ro(
          "figure",
          [](const AxesOfStates& a) { return a.part(offsetof(charts::RotorAxes, figure)); },
          "Of b3: the equator's plane.")
      .def_prop_ro(
          "momentum",
          [](const AxesOfStates& a) { return a.part(offsetof(charts::RotorAxes, momentum)); },
          "Of the canonical momentum.")
      .def_prop_ro(
          "rotation",
          [](const AxesOfStates& a) { return a.part(offsetof(charts::RotorAxes, rotation)); },
          "Of the angular velocity.")
      .def("__repr__", [](nb::handle_t<AxesOfStates> a) {
        std::string text = "RotorAxes(";
        for (const char* name : {"figure", "momentum", "rotation"})
          text += (text.back() == '(' ? "" : ", ") + std::string(name) + "=" +
                  nb::cast<std::string>(nb::repr(nb::object(a.attr(name))));
        return text + ")";
      });
  const auto axes = [&m](const char* name, auto f, const char* doc) {
    m.def(
        name,
        [f](const PythonSystem& system, ArrayLike t, const Rotors& states) {
          Numbers times(t, "t");
          return AxesOfStates{mapped(
              states, times, [&](const RotorState& s, double at) { return f(system, at, s); })};
        },
        "system"_a, "t"_a, "state"_a, doc);
  };
  axes("inertial_axes", charts::inertial_axes,
       "Axes of figure, momentum and rotation (w_IB) in inertial axes, as inclination and node. "
       "NaN for a vector of length 0.");
  axes("relative_axes", charts::relative_axes,
       "The same in the axes of the reference frame, with the rotation axis of w_SB. [SA (124)]");
  m.def(
      "axis_angles",
      [](ArrayLike axis) {
        const Numbers n(axis, "axis", {3});
        return Batch<charts::AxisAngles>::filled(n.shape(), [&](charts::AxisAngles* out) {
          for_each(size_of(n.shape()), [&](std::size_t k) {
            const double* a = n.at(k);
            out[k] = charts::axis_angles(Vec3{a[0], a[1], a[2]});
          });
        });
      },
      "axis"_a, "Inclination and node of the planes normal to vectors (..., 3).");
}

}  // namespace

void bind_system_functions(nb::module_& m) {
  bind_states<2>(m, effect_chart);
  bind_states<2>(m, velocities_chart);
  bind_states<2>(m, rotor_rates_chart);
  bind_states<2>(m, hub_rates_chart);
  bind_states<6>(m, andoyer_rates_chart);
  bind_states<6>(m, phase_rates_chart);
  bind_states<2>(m, axis_chart);
  bind_motion(m);
  bind_osculation(m);
  bind_modified(m);
  bind_element_rates(m);
  bind_canonical_rates(m);
  bind_axes(m);
}

}  // namespace polhode::python
