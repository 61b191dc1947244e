// SPDX-License-Identifier: MIT
// Body, the hub state and the charts that need no motion.
#include "charts/canonical_chart.hpp"
#include "charts/states.hpp"
#include "interface/dual_number.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/many_states.hpp"
#include "polhode/rotor/poincare.hpp"

namespace polhode::python {

namespace {

RotorState checked(const RotorState& s) {
  require_finite("RotorState: g", {s.g.x, s.g.y, s.g.z});
  require_finite("RotorState: q", {s.q.w, s.q.x, s.q.y, s.q.z});
  if (s.q == Quaternion{0.0, 0.0, 0.0, 0.0})
    throw DomainError("RotorState: q: got (0, 0, 0, 0); expected an attitude, which is not zero");
  return {unit_quaternion(s.q.w, s.q.x, s.q.y, s.q.z), s.g};
}
EulerAngles checked(const EulerAngles& e) {
  require_finite("EulerAngles", {e.phi, e.theta, e.psi});
  return e;
}
EulerState checked(const EulerState& e) {
  return euler_state(e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi);
}
EulerRates checked(const EulerRates& e) {
  require_finite("EulerRates", {e.phi, e.theta, e.psi, e.phi_dot, e.theta_dot, e.psi_dot});
  return e;
}
AndoyerState checked(const AndoyerState& s) { return andoyer_state(s.l, s.g, s.h, s.L, s.G, s.H); }
PoincareState checked(const PoincareState& s) {
  for (const Pole pole : {s.pole_J, s.pole_I})
    if (pole != Pole::zero && pole != Pole::pi)
      throw DomainError("PoincareState: got a pole that is neither Pole.zero nor Pole.pi");
  return poincare_state(s.sigma, s.Q1, s.Q2, s.G, s.P1, s.P2, s.pole_J, s.pole_I);
}

constexpr Field pole_field(const char* name, const char* text, std::size_t offset) {
  return enum_field<Pole>(name, text, offset, "Pole");
}

constexpr Chart<RotorState, 2> rotor_chart{
    "RotorState",
    R"(The hub: attitude and body angular momentum, the one chart without singularities.

q (..., 4): unit quaternion (w, x, y, z), body to frame, v_I = q v_B q*; a scipy Rotation is taken
too; any length, kept as q/|q|. g (..., 3): angular momentum along the principal axes, moment x
rate. One state or an array of states: the arguments broadcast. ValueError for numbers that are
not finite and for a zero quaternion. [SA (1), (2), (24)])",
    {{{"q", "Attitude, a unit quaternion (w, x, y, z), body to frame; (..., 4).",
       offsetof(RotorState, q), Kind::quaternion},
      {"g", "Angular momentum along the principal axes, moment x rate; (..., 3).",
       offsetof(RotorState, g), Kind::vector}}},
    checked,
    true};

constexpr Chart<EulerAngles, 3> angles_chart{
    "EulerAngles",
    "3-1-3 angles phi, theta, psi (rad) of an attitude: q "
    "= qz(phi) qx(theta) qz(psi). [SA (1), (2)]",
    {{{"phi", "Angle of precession, rad.", offsetof(EulerAngles, phi)},
      {"theta", "Angle between the third axes of body and frame, rad.",
       offsetof(EulerAngles, theta)},
      {"psi", "Angle of proper rotation, rad.", offsetof(EulerAngles, psi)}}},
    checked};

constexpr Chart<EulerState, 6> euler_chart{
    "EulerState",
    R"(3-1-3 Euler angles (rad) and their canonical momenta Phi, Theta, Psi. [SA (25)-(27)]

Any theta is taken; functions return theta in [0, pi], phi and psi in (-pi, pi]. ValueError for
numbers that are not finite and, at theta = 0 or pi, for momenta that no state has.)",
    {{{"phi", "Angle of precession, rad.", offsetof(EulerState, phi)},
      {"theta", "Angle between the third axes of body and frame, rad.",
       offsetof(EulerState, theta)},
      {"psi", "Angle of proper rotation, rad.", offsetof(EulerState, psi)},
      {"Phi", "Momentum of phi: along the frame's third axis.", offsetof(EulerState, Phi)},
      {"Theta", "Momentum of theta: along the line of nodes.", offsetof(EulerState, Theta)},
      {"Psi", "Momentum of psi: along the body's third axis.", offsetof(EulerState, Psi)}}},
    checked,
    true};

constexpr Chart<EulerRates, 6> rates_chart{
    "EulerRates",
    "3-1-3 Euler angles (rad) and their rates (rad per time): not canonical, needs a body. "
    "[SA (5)-(7)]",
    {{{"phi", "Angle of precession, rad.", offsetof(EulerRates, phi)},
      {"theta", "Angle between the third axes of body and frame, rad.",
       offsetof(EulerRates, theta)},
      {"psi", "Angle of proper rotation, rad.", offsetof(EulerRates, psi)},
      {"phi_dot", "Rate of phi, rad per time.", offsetof(EulerRates, phi_dot)},
      {"theta_dot", "Rate of theta, rad per time.", offsetof(EulerRates, theta_dot)},
      {"psi_dot", "Rate of psi, rad per time.", offsetof(EulerRates, psi_dot)}}},
    checked,
    true};

constexpr Chart<AndoyerState, 6> andoyer_chart{
    "AndoyerState",
    R"(Andoyer variables: angles l, g, h (rad), momenta L, G, H. [SA section 3.2, (84)]

G is the angular momentum, L = G cos J its part along the body's third axis, H = G cos I that along
the frame's. ValueError unless G >= 0, |L| <= G, |H| <= G. At J = 0, pi: l = 0, and g holds g +- l;
at I = 0, pi: h = 0.)",
    {{{"l", "From the node of the invariable plane on the equator to the first body axis, rad.",
       offsetof(AndoyerState, l)},
      {"g", "From the node of the invariable plane on the frame to that on the equator, rad.",
       offsetof(AndoyerState, g)},
      {"h", "Node of the invariable plane on the frame, rad.", offsetof(AndoyerState, h)},
      {"L", "Part of the momentum along the body's third axis.", offsetof(AndoyerState, L)},
      {"G", "Size of the angular momentum.", offsetof(AndoyerState, G)},
      {"H", "Part of the momentum along the frame's third axis.", offsetof(AndoyerState, H)}}},
    checked,
    true};

constexpr Chart<PoincareState, 8> poincare_chart{
    "PoincareState",
    R"(Poincare-type variables sigma (rad), Q1, Q2, G, P1, P2: regular where Andoyer's are not.

pole_J and pole_I (Pole.zero or Pole.pi) say at which pole of J and of I the set is regular.
ValueError unless G >= 0 and Q^2 + P^2 <= 4 G for both pairs.)",
    {{{"sigma", "Sum or difference of l, g and h that stays regular, rad.",
       offsetof(PoincareState, sigma)},
      {"Q1", "Coordinate of the pair that replaces l and L, the square root of a momentum.",
       offsetof(PoincareState, Q1)},
      {"Q2", "Coordinate of the pair that replaces h and H, the square root of a momentum.",
       offsetof(PoincareState, Q2)},
      {"G", "Size of the angular momentum.", offsetof(PoincareState, G)},
      {"P1", "Momentum of Q1, the square root of a momentum.", offsetof(PoincareState, P1)},
      {"P2", "Momentum of Q2, the square root of a momentum.", offsetof(PoincareState, P2)},
      pole_field("pole_J", "At which pole of J the set is regular, a Pole.",
                 offsetof(PoincareState, pole_J)),
      pole_field("pole_I", "At which pole of I the set is regular, a Pole.",
                 offsetof(PoincareState, pole_I))}},
    checked,
    true};

std::string repr_of(const Body& body) {
  const Vec3& I = body.moments();
  const nb::object moments = nb::make_tuple(I.x, I.y, I.z);
  const auto text = nb::cast<std::string>(nb::repr(moments));
  const Quaternion& q = body.q_FB();
  if (q == Quaternion{1.0, 0.0, 0.0, 0.0}) return "Body" + text;
  return "Body.with_axes(" + text + ", " +
         nb::cast<std::string>(nb::repr(nb::make_tuple(q.w, q.x, q.y, q.z))) + ")";
}

void bind_body(nb::module_& m) {
  nb::class_<Body>(
      m, "Body",
      R"(Principal moments of inertia about the axes b1, b2, b3, in any order. [SA (15)]

Body(I1, I2, I3), or Body.from_tensor(M). Any unit: the library is scale-free. ValueError unless all
are positive and the largest is at most the sum of the others.)")
      .def(nb::init<double, double, double>(), "I1"_a, "I2"_a, "I3"_a)
      .def_static(
          "from_tensor", [](ArrayLike tensor) { return Body::from_tensor(mat3(tensor, "tensor")); },
          "tensor"_a,
          "From a symmetric (3, 3) inertia tensor in any body-fixed axes; q_FB keeps the rotation "
          "to the principal axes. tensor[0][1] is minus the integral of x y dm: a product of "
          "inertia "
          "that is defined as the integral itself changes its sign.")
      .def_static(
          "with_axes",
          [](ArrayLike moments, ArrayLike q_FB) {
            return Body::with_axes(vec3(moments, "moments"), quaternion(q_FB, "q_FB"));
          },
          "moments"_a, "q_FB"_a,
          "Principal moments (3,) with a rotation q_FB (4,) to other body axes, known already.")
      .def_prop_ro(
          "moments", [](const Body& b) { return array_of(b.moments()); },
          "(3,): moments about b1, b2, b3 as given.")
      .def_prop_ro(
          "q_FB", [](const Body& b) { return array_of(b.q_FB()); },
          "(4,): rotation from principal axes to those of the tensor, v_F = q_FB v_B q_FB*.")
      .def(
          "__eq__",
          [](const Body& a, const Body& b) {
            return a.moments() == b.moments() && a.q_FB() == b.q_FB();
          },
          nb::is_operator(), "other"_a)
      .def("__hash__",
           [](const Body& b) {
             return nb::hash(nb::make_tuple(b.moments().x, b.moments().y, b.moments().z));
           })
      .def("__repr__", [](const Body& b) { return repr_of(b); })
      .def("__getstate__",
           [](const Body& b) { return nb::make_tuple(array_of(b.moments()), array_of(b.q_FB())); })
      .def("__setstate__",
           [](Body& b, const std::tuple<nb::object, nb::object>& state) {
             const auto& [moments, q_FB] = state;
             new (&b) Body(Body::with_axes(vec3(moments, "moments"), quaternion(q_FB, "q_FB")));
           })
      .def("__copy__", [](const Body& b) { return b; })
      .def(
          "__deepcopy__", [](const Body& b, nb::handle) { return b; }, "memo"_a);
}

using Rotors = Batch<RotorState>;

Numbers quaternions(nb::handle q) { return {q, "q", {4}}; }
Quaternion quaternion_at(const double* q) { return {q[0], q[1], q[2], q[3]}; }

FloatArray matrices_of(nb::handle q) {
  nb::object of_duals = dual_attitude_matrix(q);
  if (!of_duals.is_none()) return of_duals;
  const Numbers n = quaternions(q);
  Result out(n.shape(), {3, 3});
  for_each(size_of(n.shape()),
           [&](std::size_t k) { put(out.at(k), attitude_matrix(quaternion_at(n.at(k)))); });
  return out.take();
}

FloatArray quaternions_of(nb::handle R) {
  nb::object of_duals = dual_attitude(R);
  if (!of_duals.is_none()) return of_duals;
  const Numbers n(R, "rotation", {3, 3});
  Result out(n.shape(), {4});
  for_each(size_of(n.shape()), [&](std::size_t k) {
    const double* a = n.at(k);
    put(out.at(k), attitude(Mat3{{{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {a[6], a[7], a[8]}}}));
  });
  return out.take();
}

void bind_attitudes(nb::module_& m) {
  m.def(
      "attitude_matrix", [](ArrayLike q) { return matrices_of(q); }, "q"_a,
      "R of [SA (2)], v_B = R v_I: q (..., 4) -> (..., 3, 3). One q of Dual gives Duals.");
  m.def(
      "euler_angles",
      [](ArrayLike q) {
        const Numbers n = quaternions(q);
        return Batch<EulerAngles>::filled(n.shape(), [&](EulerAngles* out) {
          for_each(size_of(n.shape()),
                   [&](std::size_t k) { out[k] = euler_angles(quaternion_at(n.at(k))); });
        });
      },
      "q"_a, "3-1-3 angles of an attitude: q (..., 4). At theta = 0, pi: psi = 0. [SA (1), (2)]");
  m.def(
      "attitude",
      [](const Batch<EulerAngles>& angles) {
        return mapped_numbers(angles, {4}, [](const EulerAngles& e) { return attitude(e); });
      },
      "rotation"_a, "Quaternion (..., 4), body to inertial, of 3-1-3 angles.");
  m.def(
      "attitude", [](ArrayLike R) { return quaternions_of(R); }, "rotation"_a,
      "Quaternion (..., 4), body to inertial, of rotation matrices R (..., 3, 3), v_B = R v_I. "
      "ValueError for a matrix that is no rotation (to 1e-6). One R of Dual gives Duals, "
      "unchecked.");
}

using StateOfRate = RotorState(const Body&, const Quaternion&, const Vec3&);

Rotors with_rate(const Body& body, nb::handle q, nb::handle omega, StateOfRate* build) {
  std::vector<Numbers> both;
  both.push_back(quaternions(q));
  both.emplace_back(omega, "omega", std::initializer_list<std::size_t>{3});
  const Shape shape = broadcast(both);
  return Rotors::filled(shape, [&](RotorState* out) {
    for_each(size_of(shape), [&](std::size_t k) {
      const double* w = both[1].at(k);
      out[k] = build(body, quaternion_at(both[0].at(k)), Vec3{w[0], w[1], w[2]});
    });
  });
}

void bind_attitudes_with_rates(nb::module_& m) {
  m.def(
      "rotor_state",
      [](const Body& body, ArrayLike q, ArrayLike omega) {
        return with_rate(body, q, omega, rotor_state);
      },
      "body"_a, "q"_a, "omega_B"_a,
      "The state of attitudes q (..., 4) and angular velocities (..., 3) along the body axes. "
      "[SA (24)]");
  m.def(
      "rotor_state_inertial",
      [](const Body& body, ArrayLike q, ArrayLike omega) {
        return with_rate(body, q, omega, rotor_state_inertial);
      },
      "body"_a, "q"_a, "omega_I"_a,
      "The same with the angular velocity in inertial components. [SA (8)]");
}

// Of arrays in the lanes of the processor, and one state in the same way: with the same bits.
template <class S>
void def_to_rotor_together(nb::module_& m) {
  m.def(
      "to_rotor",
      [](const Batch<S>& states, int threads) {
        return mapped_together<RotorState>(
            states, [](std::span<const S> from, std::span<RotorState> to) { to_rotor(from, to); },
            checked_threads(threads));
      },
      "state"_a, nb::kw_only(), "threads"_a = 1, "The hub state of a canonical set; same shape.");
}

void bind_conversions(nb::module_& m) {
  def_to_rotor_together<EulerState>(m);
  def_to_rotor_together<AndoyerState>(m);
  def_to_rotor_together<PoincareState>(m);
  m.def(
      "to_rotor",
      [](const Body& body, const Batch<EulerRates>& states, int threads) {
        return mapped(
            states, [&](const EulerRates& s) { return to_rotor(body, s); },
            checked_threads(threads));
      },
      "body"_a, "state"_a, nb::kw_only(), "threads"_a = 1,
      "The hub state of Euler angles with their rates.");
  m.def(
      "to_euler",
      [](const Rotors& states, int threads) {
        return mapped_together<EulerState>(
            states,
            [](std::span<const RotorState> from, std::span<EulerState> to) { to_euler(from, to); },
            checked_threads(threads));
      },
      "state"_a, nb::kw_only(), "threads"_a = 1,
      "Euler angles and momenta of hub states; same shape. [SA (25)-(27)]");
  m.def(
      "to_euler_rates",
      [](const Body& body, const Rotors& states, int threads) {
        return mapped(
            states, [&](const RotorState& s) { return to_euler_rates(body, s); },
            checked_threads(threads));
      },
      "body"_a, "state"_a, nb::kw_only(), "threads"_a = 1,
      "Euler angles and their rates of hub states. [SA (5)-(7)]");
  m.def(
      "to_andoyer",
      [](const Rotors& states, int threads) {
        return mapped_together<AndoyerState>(
            states,
            [](std::span<const RotorState> from, std::span<AndoyerState> to) {
              to_andoyer(from, to);
            },
            checked_threads(threads));
      },
      "state"_a, nb::kw_only(), "threads"_a = 1,
      "Andoyer variables of hub states; same shape. [SA section 3.2]");
  m.def(
      "to_poincare",
      [](const Rotors& states, OneOf<Pole> J, OneOf<Pole> I, int threads) {
        const Pole pole_J = choice<Pole>(J, "pole_J"), pole_I = choice<Pole>(I, "pole_I");
        return mapped_together<PoincareState>(
            states,
            [=](std::span<const RotorState> from, std::span<PoincareState> to) {
              to_poincare(from, pole_J, pole_I, to);
            },
            checked_threads(threads));
      },
      "state"_a, "pole_J"_a, "pole_I"_a, nb::kw_only(), "threads"_a = 1,
      "The Poincare-type set that is regular at J = 0 (Pole.zero) or pi (Pole.pi), and so for I; "
      "same shape.");
  m.def(
      "nearest_poincare",
      [](const Rotors& states, int threads) {
        return mapped_together<PoincareState>(
            states,
            [](std::span<const RotorState> from, std::span<PoincareState> to) {
              nearest_poincare(from, to);
            },
            checked_threads(threads));
      },
      "state"_a, nb::kw_only(), "threads"_a = 1,
      "The Poincare-type set whose poles are nearest, state by state.");
}

void bind_functions(nb::module_& m) {
  const auto vector_of_body = [&m](const char* name, nb::arg first, auto f, const char* doc) {
    m.def(
        name,
        [f](const Body& body, const Rotors& states) {
          return mapped_numbers(states, {3}, [&](const RotorState& s) { return f(body, s); });
        },
        first, "state"_a, doc);
  };
  // a body alone is a system without perturbations: one name for both
  vector_of_body(
      "angular_velocity", "system"_a,
      [](const Body& body, const RotorState& s) { return angular_velocity(body, s); },
      "omega_B = I^-1 g, body components: (..., 3). [SA (24)]");
  vector_of_body(
      "inertial_angular_velocity", "body"_a,
      [](const Body& body, const RotorState& s) { return inertial_angular_velocity(body, s); },
      "The same vector in inertial components: (..., 3). [SA (8)]");
  m.def(
      "kinetic_energy",
      [](const Body& body, const Rotors& states) -> Floats {
        return mapped_numbers(states, {},
                              [&](const RotorState& s) { return kinetic_energy(body, s); });
      },
      "body"_a, "state"_a,
      "T = (1/2) g . I^-1 g: a float, or an array of the shape of the states.");
  m.def(
      "inertial_momentum",
      [](const Rotors& states) {
        return mapped_numbers(states, {3},
                              [](const RotorState& s) { return inertial_momentum(s); });
      },
      "state"_a, "Angular momentum in inertial components (..., 3): constant in free rotation.");
}

}  // namespace

void bind_rotor(nb::module_& m) {
  nb::enum_<Pole>(m, "Pole", "The pole of J or I that a Poincare-type set is regular at.",
                  nb::is_arithmetic())
      .value("zero", Pole::zero)
      .value("pi", Pole::pi);
  bind_body(m);
  bind_states<2>(m, rotor_chart);
  bind_states<3>(m, angles_chart);
  bind_states<6>(m, euler_chart);
  bind_states<6>(m, rates_chart);
  bind_states<6>(m, andoyer_chart);
  bind_states<8>(m, poincare_chart);
  bind_attitudes(m);
  bind_attitudes_with_rates(m);
  bind_conversions(m);
  bind_dual_state(m);
  bind_functions(m);
  bind_jacobians(m);
}

}  // namespace polhode::python
