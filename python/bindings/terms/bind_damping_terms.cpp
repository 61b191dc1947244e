// SPDX-License-Identifier: MIT
// Friction inside the body, and torques that are tables of time.
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

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
  using C = TermOf<"InternalDamping">;
  auto c = bind_term<"InternalDamping">(
      m,
      R"(Friction inside the body: energy falls, angular momentum stays.

InternalDamping(k): v = k g x w, w = I^-1 g. It has no torque; I^-1 g + v is the angular velocity.
For I = (A, A, C) the angle J from axis 3 to g obeys
tan J = tan J0 exp(-k (C - A) G^2 t / (A C)).)",
      "ValueError for a negative coefficient.",
      [](const Making& at, const Diagonal& k, bool grows) {
        return AnyPerturbation(at.name, InternalDamping(k.all, grows));
      },
      argument<Diagonal>("k",
                         "in 1 / momentum, with `grows` in 1 / momentum^2: one number, or "
                         "a diagonal (3,) in principal axes."),
      term_name(),
      argument<bool>("grows", "whether k is multiplied by the momentum |g|.", false)
          .without_property());
  c.def_prop_ro(
       "coefficients",
       [](const C& term) { return array_of(term.target<InternalDamping>()->coefficients()); },
       "(3,): k along the principal axes.")
      .def_prop_ro(
          "grows",
          [](const C& term) { return term.target<InternalDamping>()->grows_with_momentum(); },
          "Whether k is multiplied by the momentum.");
  def_maker(
      c, "of_wobble",
      "The k with which a small wobble about the axis of the largest moment falls by e in `time` "
      "at this momentum, in the units of the body's moments and of time. ValueError for a sphere.",
      [](const Making& at, nb::handle_t<Body> body, double time, double momentum) {
        return AnyPerturbation(
            at.name, InternalDamping::of_wobble(nb::cast<const Body&>(body), time, momentum));
      },
      argument<Body>("body"), argument<double>("time"), argument<double>("momentum"), term_name());
  def_maker(
      c, "of_material",
      "k in proportion to the momentum: a small wobble falls by e in wobble_time(material, rate) "
      "at "
      "any rate. ValueError for a sphere.",
      [](const Making& at, nb::handle_t<Body> body, const auto& material) {
        return AnyPerturbation(
            at.name, InternalDamping::of_material(nb::cast<const Body&>(body),
                                                  nb::cast<const DampedMaterial&>(material)));
      },
      argument<Body>("body"), argument<DampedMaterial>("material"), term_name());
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

void bind_torque_table(nb::module_& m) {
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
  bind_term<"TorqueTable">(
      m,
      R"(A torque given by rows of time: thrusters, wheels.

Collocation, Adaptive and VariationOfConstants end a step wherever it is not smooth (`breakpoints`),
so that no pulse is stepped over. Splitting refuses it.)",
      "ValueError for rows that are not finite or times that do not increase.",
      [](const Making& at, const Table& times, const Table& torques, TorqueTable::Between between,
         TorqueTable::Outside outside, std::optional<SpaceAxes> axes) {
        return AnyPerturbation(at.name, TorqueTable(rows_of(times.numbers, torques.numbers),
                                                    {between, outside, axes}));
      },
      argument<Table>("times", "(n,), increasing."),
      argument<Table>("torques", "(n, 3), momentum per time."),
      argument<TorqueTable::Between>("between", "Between or its name.", "linear"),
      argument<TorqueTable::Outside>("outside", "Outside or its name.", "zero"),
      argument<std::optional<SpaceAxes>>("axes",
                                         "of the components: SpaceAxes or its name; None: "
                                         "principal body axes.",
                                         nb::none()),
      term_name());
}

}  // namespace

void bind_damping_terms(nb::module_& m) {
  bind_material(m);
  bind_internal(m);
  bind_torque_table(m);
}

}  // namespace polhode::python
