// SPDX-License-Identifier: MIT
// Perturbation terms: what all of them can be asked, and the first kinds.
#include "interface/choice.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/linear_damping.hpp"
#include "terms/term_binding.hpp"
#include "terms/term_value.hpp"

namespace polhode::python {

namespace {

// One C++ type per Python class.
struct GravityGradientTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct ConstantTorqueTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct LinearDampingTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
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
          "Whether it can name switching functions, at whose zeros Adaptive ends a step.")
      .def_prop_ro(
          "time_scale", [](const P& p) { return p.time_scale(); },
          "A quarter of a turn of what it follows, the default of Adaptive's largest_step; inf "
          "where it knows none.");
  def_term<P>(c);
}

void bind_gravity(nb::module_& m) {
  using C = GravityGradientTerm;
  nb::class_<C, PythonTerm> c(m, "GravityGradient",
                              R"(The torque of a point mass on a rigid body (MacCullagh).

H' = gm / (2 r^3) (3 n.I n - tr I), u = (3 gm / r^3) n x I n, n = r / |r| in body axes.

Parameters
----------
gm : of the attracting point mass, length^3 / time^2. ValueError unless positive.
orbit : KeplerOrbit, PrecessingKeplerOrbit, TableOrbit, or any function t -> 3 numbers: the
    position of the mass from the body or of the body from the mass.
axes : of those positions: SpaceAxes, or its name.
name : stands in messages.

The moments of the body may be in any unit of moment; lengths of gm and of the orbit must agree. A
function in Python works on float alone: not with Precision.double_double.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, double gm, Orbit orbit, OneOf<SpaceAxes> axes, Text name) {
         const auto of = choice<SpaceAxes>(axes, "axes");
         make_along(self, "GravityGradient", orbit, name,
                    {{"gm", "orbit", "axes", "name"}, nb::make_tuple(gm, orbit, of, name)},
                    [&](const std::string& called, const auto& o) {
                      return AnyPerturbation(called, GravityGradient(gm, o, of));
                    });
       },
       "gm"_a, "orbit"_a, "axes"_a = "inertial", "name"_a = nb::none())
      .def_prop_ro("gm", given<0, "float">, "Of the attracting point mass.")
      .def_prop_ro("orbit", given<1, "typing.Any">, "The very object that was given.")
      .def_prop_ro("axes", given<2, "SpaceAxes">, "Of the positions of the orbit.");
  def_term<C>(c);
}

void bind_torque(nb::module_& m) {
  using C = ConstantTorqueTerm;
  nb::class_<C, PythonTerm> c(m, "ConstantTorque",
                              R"(A torque that is constant in body axes or in space.

ConstantTorque.in_body(u_B), ConstantTorque.in_space(u, axes): momentum per time, no energy.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def_static(
       "in_body",
       [](ArrayLike u_B, Text name) {
         const Vec3 u = vec3(u_B, "u_B");
         return C(AnyPerturbation(name_of(name, "ConstantTorque"), ConstantTorque::in_body(u)),
                  recipe_of("in_body", {"u_B", "name"}, nb::make_tuple(tuple_of(u), name)));
       },
       "u_B"_a, "name"_a = nb::none(),
       "Constant along the principal body axes: (3,). ValueError for a component that is not "
       "finite.")
      .def_static(
          "in_space",
          [](ArrayLike u, OneOf<SpaceAxes> axes, Text name) {
            const Vec3 given = vec3(u, "u");
            const auto of = choice<SpaceAxes>(axes, "axes");
            return C(AnyPerturbation(name_of(name, "ConstantTorque"),
                                     ConstantTorque::in_space(given, of)),
                     recipe_of("in_space", {"u", "axes", "name"},
                               nb::make_tuple(tuple_of(given), of, name)));
          },
          "u"_a, "axes"_a = "inertial", "name"_a = nb::none(),
          "Constant (3,) in inertial axes, or in those of the reference frame.")
      .def_prop_ro(
          "u", [](const C& term) { return array_of(vec3(term.recipe.argument(0), "u")); },
          "(3,): its components, in body axes where `axes` is None.")
      .def_prop_ro(
          "axes", [](const C& term) -> Typed<"SpaceAxes | None"> {
            return term.recipe.names.size() == 3 ? term.recipe.argument(1) : nb::object(nb::none());
          },
          "Those in space; None: body axes.");
  def_term<C>(c);
}

// One number, a diagonal, or a matrix with its body.
LinearDamping damping_of(nb::handle D, nb::handle body) {
  const Numbers any(D, "D");
  if (any.shape().empty()) return LinearDamping(any[0]);
  if (any.shape() == Shape{3}) return LinearDamping(vec3(D, "D"));
  if (any.shape() != Shape{3, 3})
    throw nb::value_error(
        ("LinearDamping: D: got shape " + text_of(any.shape()) + "; expected (), (3,) or (3, 3)")
            .c_str());
  if (body.is_none())
    throw nb::value_error("LinearDamping: a matrix D needs the body: LinearDamping(D, body)");
  return LinearDamping(mat3(D, "D"), nb::cast<const Body&>(body));
}

void bind_damping(nb::module_& m) {
  using C = LinearDampingTerm;
  nb::class_<C, PythonTerm> c(m, "LinearDamping",
                              R"(Viscous friction against inertial axes: u = -D w, w = I^-1 g.

Parameters
----------
D : one number, the diagonal (3,) in principal body axes, or a symmetric matrix (3, 3) that drives
    no motion; torque per rate.
body : the one that a matrix will be applied to.
name : stands in messages.

ValueError for a matrix that is not finite, not symmetric, or would drive the body.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, ArrayLike D, Typed<"Body"> body, Text name) {
         if (!body.is_none() && !nb::isinstance<Body>(body))
           throw nb::type_error(
               ("LinearDamping: body: got " + class_name(body) + "; expected a Body").c_str());
         const LinearDamping damping = damping_of(D, body);
         const bool full = Numbers(D, "D").shape().size() == 2;
         const Mat3& matrix = damping.matrix();
         const nb::object kept =
             full ? rows_of(matrix) : nb::make_tuple(matrix(0, 0), matrix(1, 1), matrix(2, 2));
         new (self) C(AnyPerturbation(name_of(name, "LinearDamping"), damping),
                      recipe_of("", {"D", "body", "name"}, nb::make_tuple(kept, body, name)));
       },
       "D"_a, "body"_a = nb::none(), "name"_a = nb::none())
      .def_prop_ro(
          "matrix",
          [](const C& term) {
            const nb::object D = term.recipe.argument(0);
            if (Numbers(D, "D").shape().size() == 2) return array_of(mat3(D, "D"));
            const Vec3 d = vec3(D, "D");
            return array_of(Mat3{{{d.x, 0.0, 0.0}, {0.0, d.y, 0.0}, {0.0, 0.0, d.z}}});
          },
          "(3, 3): D in principal body axes.");
  def_term<C>(c);
}

}  // namespace

void bind_perturb(nb::module_& m) {
  bind_any(m);
  bind_gravity(m);
  bind_torque(m);
  bind_damping(m);
}

}  // namespace polhode::python
