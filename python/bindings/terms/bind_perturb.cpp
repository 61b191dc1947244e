// SPDX-License-Identifier: MIT
// Perturbation terms: what all of them can be asked, and the first kinds.
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/linear_damping.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

void bind_any(nb::module_& m) {
  nb::enum_<SpaceAxes>(m, "SpaceAxes", "The axes of a vector that is not the body's own.",
                       nb::is_arithmetic())
      .value("inertial", SpaceAxes::inertial, "those that do not turn")
      .value("reference", SpaceAxes::reference, "those of the frame S of the system");
  using P = PythonTerm;
  nb::class_<P> c(m, "AnyPerturbation",
                  R"(A term of a System: what every kind of term can be asked.

Made by GravityGradient, HigherGravity, OblateGravity, TidalTorque, ConstantTorque, TorqueTable,
LinearDamping, InternalDamping, SolarPressure, AtmosphericDrag, ResidualDipole, EddyCurrents,
TorqueTerm, HamiltonianTerm.)",
                  nb::type_slots(recipe_slots<P>()));
  c.def_prop_ro(
       "name", [](const P& p) { return p.name(); }, "Stands for the term in messages.")
      .def_prop_ro(
          "arguments", [](const P& p) { return p.recipe.by_name(); },
          "What it was made from, by name.")
      .def_prop_ro(
          "supports_energy", [](const P& p) { return p.supports_energy(); },
          "Whether it has an energy H', of which its effect is the derivative.")
      .def_prop_ro(
          "supports_flow", [](const P& p) { return p.supports_flow(); },
          "Whether its own motion is known exactly, as Splitting needs.")
      .def_prop_ro(
          "is_kick", [](const P& p) { return p.is_kick(); },
          "Whether it is a torque of time and attitude alone.")
      .def_prop_ro(
          "supports_any_real", [](const P& p) { return p.supports_any_real(); },
          "Whether double-double runs and state transitions can use it.")
      .def_prop_ro(
          "breakpoints", [](const P& p) { return array_of(p.breakpoints()); },
          "(n,): the times at which it is not smooth, where integrate ends a step.")
      .def_prop_ro(
          "supports_switches", [](const P& p) { return p.supports_switches(); },
          "Whether it can name switching functions, at whose zeros Collocation and Adaptive "
          "end a step.")
      .def_prop_ro(
          "time_scale", [](const P& p) { return p.time_scale(); },
          "A quarter of a turn of what it follows, the default of largest_step; inf where it "
          "knows none.");
  def_recipe<P>(c, [](const P& term) { return "\"" + term.name() + "\""; });
}

void bind_gravity(nb::module_& m) {
  bind_term<"GravityGradient">(
      m,
      R"(The torque of a point mass on a rigid body (MacCullagh).

H' = gm / (2 r^3) (3 n.I n - tr I), u = (3 gm / r^3) n x I n, n = r / |r| in body axes.)",
      R"(The moments of the body may be in any unit of moment; lengths of gm and of the orbit must
agree. A function in Python works on float alone: not with Precision.double_double.)",
      [](Making& at, double gm, nb::handle orbit, SpaceAxes axes) {
        return along(at, orbit, [&](const auto& o) { return GravityGradient(gm, o, axes); });
      },
      argument<double>("gm",
                       "of the attracting point mass, length^3 / time^2. ValueError unless "
                       "positive."),
      argument<Orbit>("orbit",
                      "KeplerOrbit, PrecessingKeplerOrbit, TableOrbit, or any function t "
                      "-> 3 numbers: the position of the mass from the body or of the "
                      "body from the mass."),
      argument<SpaceAxes>("axes", "of those positions: SpaceAxes, or its name.", "inertial"),
      term_name());
}

void bind_torque(nb::module_& m) {
  auto c = term_class<"ConstantTorque">(m, R"(A torque that is constant in body axes or in space.

ConstantTorque.in_body(u_B), ConstantTorque.in_space(u, axes): momentum per time, no energy.)");
  def_maker(
      c, "in_body",
      "Constant along the principal body axes: (3,). ValueError for a component that is not "
      "finite.",
      [](const Making& at, const Vec3& u) {
        return AnyPerturbation(at.name, ConstantTorque::in_body(u));
      },
      argument<Vec3>("u_B"), term_name());
  def_maker(
      c, "in_space", "Constant (3,) in inertial axes, or in those of the reference frame.",
      [](const Making& at, const Vec3& u, SpaceAxes axes) {
        return AnyPerturbation(at.name, ConstantTorque::in_space(u, axes));
      },
      argument<Vec3>("u"), argument<SpaceAxes>("axes", "", "inertial"), term_name());
  using C = TermOf<"ConstantTorque">;
  c.def_prop_ro(
       "u", [](const C& term) { return array_of(vec3(term.recipe.argument(0), "u")); },
       "(3,): its components, in body axes where `axes` is None.")
      .def_prop_ro(
          "axes", [](const C& term) -> Typed<"SpaceAxes | None"> {
            return term.recipe.names.size() == 3 ? term.recipe.argument(1) : nb::object(nb::none());
          },
          "Those in space; None: body axes.");
}

// A matrix needs its body.
LinearDamping damping_of(const Tensor& D, nb::handle body) {
  if (!body.is_none() && !nb::isinstance<Body>(body))
    throw nb::type_error(
        ("LinearDamping: body: got " + class_name(body) + "; expected a Body").c_str());
  const Mat3& d = D.matrix;
  if (!D.is_full) return LinearDamping(Vec3{d(0, 0), d(1, 1), d(2, 2)});
  if (body.is_none())
    throw nb::value_error("LinearDamping: a matrix D needs the body: LinearDamping(D, body)");
  return LinearDamping(d, nb::cast<const Body&>(body));
}

void bind_damping(nb::module_& m) {
  bind_term<"LinearDamping">(
      m, "Viscous friction against inertial axes: u = -D w, w = I^-1 g.",
      "ValueError for a matrix that is not finite, not symmetric, or would drive the body.",
      [](const Making& at, const Tensor& D, nb::handle body) {
        return AnyPerturbation(at.name, damping_of(D, body));
      },
      argument<Tensor>("D",
                       "one number, the diagonal (3,) in principal body axes, or a symmetric "
                       "matrix (3, 3) that drives no motion; torque per rate."),
      argument<Typed<"Body">>("body", "the one that a matrix will be applied to.", nb::none()),
      term_name())
      .def_prop_ro(
          "matrix",
          [](const TermOf<"LinearDamping">& term) {
            return Taken<Tensor>::show(term.recipe.argument(0));
          },
          "(3, 3): D in principal body axes.");
}

}  // namespace

void bind_perturb(nb::module_& m) {
  bind_any(m);
  bind_gravity(m);
  bind_torque(m);
  bind_damping(m);
}

}  // namespace polhode::python
