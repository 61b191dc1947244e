// SPDX-License-Identifier: MIT
// Friction inside the body, and torques that are tables of time.
#include "interface/choice.hpp"
#include "interface/value.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "terms/term_binding.hpp"

namespace polhode::python {

namespace {

struct InternalDampingTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct TorqueTableTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};

void bind_material(nb::module_& m) {
  using D = DampedMaterial;
  bind_value<D>(m, "DampedMaterial",
                R"(A material and the size of a body, in the units of the system.

Parameters
----------
rigidity : mu, a pressure.
quality_factor : Q.
density : rho.
radius : the mean one.
shape_factor : K3^2, about 0.1 for elongated bodies, 0.01 for nearly spherical ones.)",
                field("rigidity", &D::rigidity, "mu."),
                field("quality_factor", &D::quality_factor, "Q."),
                field("density", &D::density, "rho."), field("radius", &D::radius, "The mean one."),
                field("shape_factor", &D::shape_factor, "K3^2.", 0.1));
  m.def("wobble_time", &wobble_time, "material"_a, "rate"_a,
        "mu Q / (rho K3^2 R^2 rate^3): the time in which a small wobble about the axis of the "
        "largest moment falls by e at this rate of rotation (Burns and Safronov 1973). ValueError "
        "unless all are positive.");
}

void bind_internal(nb::module_& m) {
  using C = InternalDampingTerm;
  nb::class_<C, PythonTerm> c(m, "InternalDamping",
                              R"(Friction inside the body: energy falls, angular momentum stays.

InternalDamping(k): v = k g x w, w = I^-1 g, k in 1 / momentum: one number, or a diagonal (3,) in
principal axes; with `grows` times |g|, and in 1 / momentum^2. It has no torque; I^-1 g + v is the
angular velocity. For I = (A, A, C) the angle J from axis 3 to g obeys
tan J = tan J0 exp(-k (C - A) G^2 t / (A C)).

ValueError for a negative coefficient.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, ArrayLike k, Text name, bool grows) {
         const Numbers any(k, "k");
         const bool one = any.shape().empty();
         const InternalDamping term(one ? Vec3{any[0], any[0], any[0]} : vec3(k, "k"), grows);
         const nb::object kept =
             one ? nb::object(nb::float_(any[0])) : nb::object(tuple_of(term.coefficients()));
         new (self) C(AnyPerturbation(name_of(name, "InternalDamping"), term),
                      recipe_of("", {"k", "name", "grows"}, nb::make_tuple(kept, name, grows)));
       },
       "k"_a, "name"_a = nb::none(), "grows"_a = false)
      .def_prop_ro(
          "coefficients",
          [](const C& term) { return array_of(term.target<InternalDamping>()->coefficients()); },
          "(3,): k along the principal axes.")
      .def_prop_ro(
          "grows",
          [](const C& term) { return term.target<InternalDamping>()->grows_with_momentum(); },
          "Whether k is multiplied by the momentum.")
      .def_static(
          "of_wobble",
          [](const Body& body, double time, double momentum, Text name) {
            return C(AnyPerturbation(name_of(name, "InternalDamping"),
                                     InternalDamping::of_wobble(body, time, momentum)),
                     recipe_of("of_wobble", {"body", "time", "momentum", "name"},
                               nb::make_tuple(body, time, momentum, name)));
          },
          "body"_a, "time"_a, "momentum"_a, "name"_a = nb::none(),
          "The k with which a small wobble about the axis of the largest moment falls by e in "
          "`time` at this momentum, in the units of the body's moments and of time. ValueError for "
          "a "
          "sphere.")
      .def_static(
          "of_material",
          [](const Body& body, const DampedMaterial& material, Text name) {
            return C(AnyPerturbation(name_of(name, "InternalDamping"),
                                     InternalDamping::of_material(body, material)),
                     recipe_of("of_material", {"body", "material", "name"},
                               nb::make_tuple(body, material, name)));
          },
          "body"_a, "material"_a, "name"_a = nb::none(),
          "k in proportion to the momentum: a small wobble falls by e in wobble_time(material, "
          "rate) at any rate. ValueError for a sphere.");
  def_term<C>(c);
}

std::vector<TorqueRow> rows_of(nb::handle times, nb::handle torques) {
  Numbers both[] = {Numbers(times, "times"), Numbers(torques, "torques", {3})};
  if (both[0].shape().size() != 1 || both[0].shape() != both[1].shape())
    throw nb::value_error(("TorqueTable: torques: got shape " + text_of(both[1].shape()) +
                           " x 3 with times of shape " + text_of(both[0].shape()) +
                           "; expected (n, 3) and (n,)")
                              .c_str());
  const Shape shape = broadcast(both);
  std::vector<TorqueRow> rows;
  for (std::size_t k = 0; k < size_of(shape); ++k) {
    const double* u = both[1].at(k);
    rows.push_back({both[0][k], {u[0], u[1], u[2]}});
  }
  return rows;
}

void bind_table(nb::module_& m) {
  using C = TorqueTableTerm;
  nb::enum_<TorqueTable::Between>(m, "Between", "What holds between two rows of a table.",
                                  nb::is_arithmetic())
      .value("step", TorqueTable::Between::step, "the row before")
      .value("linear", TorqueTable::Between::linear, "a straight line")
      .value("cubic", TorqueTable::Between::cubic, "a cubic that keeps the shape (PCHIP)");
  nb::enum_<TorqueTable::Outside>(
      m, "Outside", "What holds before the first row and after the last.", nb::is_arithmetic())
      .value("zero", TorqueTable::Outside::zero, "nothing")
      .value("hold", TorqueTable::Outside::hold, "that row")
      .value("refuse", TorqueTable::Outside::refuse, "ValueError");
  nb::class_<C, PythonTerm> c(m, "TorqueTable",
                              R"(A torque given by rows of time: thrusters, wheels.

Adaptive and VariationOfConstants end a step wherever it is not smooth (`breakpoints`), so that no
pulse is stepped over. Splitting refuses it.

Parameters
----------
times : (n,), increasing.
torques : (n, 3), momentum per time.
between : Between or its name.
outside : Outside or its name.
axes : of the components: SpaceAxes or its name; None: principal body axes.
name : stands in messages.

ValueError for rows that are not finite or times that do not increase.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
      "__init__",
      [](C* self, ArrayLike times, ArrayLike torques, OneOf<TorqueTable::Between> between,
         OneOf<TorqueTable::Outside> outside, OneOf<SpaceAxes> axes, Text name) {
        std::vector<TorqueRow> rows = rows_of(times, torques);
        TorqueTable::Rules rules;
        rules.between = choice<TorqueTable::Between>(between, "between");
        rules.outside = choice<TorqueTable::Outside>(outside, "outside");
        if (!axes.is_none()) rules.axes = choice<SpaceAxes>(axes, "axes");
        nb::list kept_times, kept_torques;
        for (const TorqueRow& row : rows) {
          kept_times.append(row.t);
          kept_torques.append(tuple_of(row.torque));
        }
        const nb::object space = rules.axes ? nb::cast(*rules.axes) : nb::object(nb::none());
        new (self)
            C(AnyPerturbation(name_of(name, "TorqueTable"), TorqueTable(std::move(rows), rules)),
              recipe_of("", {"times", "torques", "between", "outside", "axes", "name"},
                        nb::make_tuple(nb::tuple(kept_times), nb::tuple(kept_torques),
                                       rules.between, rules.outside, space, name)));
      },
      "times"_a, "torques"_a, "between"_a = "linear", "outside"_a = "zero", "axes"_a = nb::none(),
      "name"_a = nb::none());
  def_term<C>(c);
}

}  // namespace

void bind_damping_terms(nb::module_& m) {
  bind_material(m);
  bind_internal(m);
  bind_table(m);
}

}  // namespace polhode::python
