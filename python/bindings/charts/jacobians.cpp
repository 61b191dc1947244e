// SPDX-License-Identifier: MIT
// Derivatives of charts by the hub state and by each other.
#include "charts/canonical_chart.hpp"
#include "interface/batch.hpp"
#include "interface/value.hpp"
#include "polhode/rotor/chart_jacobian.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

Matrix6 matrix6(const double* a) {
  Matrix6 m;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) m(i, j) = *a++;
  return m;
}

void bind_chart(nb::module_& m) {
  nb::enum_<CanonicalSet>(m, "CanonicalSet", "The canonical charts.", nb::is_arithmetic())
      .value("euler", CanonicalSet::euler, "EulerState")
      .value("andoyer", CanonicalSet::andoyer, "AndoyerState")
      .value("poincare", CanonicalSet::poincare, "PoincareState");
  using C = CanonicalChart;
  bind_value<C>(
      m, "CanonicalChart",
      "One of the canonical charts: a CanonicalSet or its name, and, for the Poincare-type sets "
      "alone, the poles at which it is regular.",
      field("set", &C::set, "Which of the charts."),
      field("pole_J", &C::pole_J, "Where a Poincare-type set is regular in J.", Pole::zero)
          .but_quiet(),
      field("pole_I", &C::pole_I, "Where a Poincare-type set is regular in I.", Pole::zero)
          .but_quiet());
}

template <class S>
void def_chart_jacobian(nb::module_& m) {
  m.def(
      "chart_jacobian",
      [](const Batch<S>& states) {
        return mapped_numbers(states, {6, 6}, [](const S& s) { return chart_jacobian(s); });
      },
      "state"_a,
      R"(B = d(dtheta_B, dg_B) / d(chart): (..., 6, 6). [SA (dr1), (dr2)]

Rows: a small turn of the body about its axes, q exp(dtheta_B / 2), and the change of its momentum
along them. Columns: three angles, then three momenta, in the order of the fields; rates for
EulerRates. Right to the last bit; entries of a plain set are infinite at its singularities. A
canonical chart satisfies B J B^T = Pi, J = [[0, 1], [-1, 0]], Pi = [[0, 1], [-1, hat(g)]].)");
}

void bind_canonical(nb::module_& m) {
  def_chart_jacobian<EulerState>(m);
  def_chart_jacobian<AndoyerState>(m);
  def_chart_jacobian<PoincareState>(m);
  m.def(
      "chart_jacobian",
      [](const Rotors& states, AnyChart chart) {
        const CanonicalChart of = chart_of(chart, "chart");
        return mapped_numbers(states, {6, 6},
                              [=](const RotorState& s) { return chart_jacobian(s, of); });
      },
      "state"_a, "chart"_a,
      "B of a chart at hub states: (..., 6, 6). Keeps digits of a small theta, J or I that the "
      "chart itself has rounded away.");
  m.def(
      "inverse_chart_jacobian",
      [](const Rotors& states, AnyChart chart) {
        const CanonicalChart of = chart_of(chart, "chart");
        return mapped_numbers(states, {6, 6},
                              [=](const RotorState& s) { return inverse_chart_jacobian(s, of); });
      },
      "state"_a, "chart"_a, "B^-1 = d(chart) / d(dtheta_B, dg_B) at hub states: (..., 6, 6).");
  m.def(
      "canonical_transformation",
      [](const Rotors& states, AnyChart from, AnyChart to) {
        const CanonicalChart of = chart_of(from, "from_chart"), into = chart_of(to, "to_chart");
        return mapped_numbers(states, {6, 6}, [=](const RotorState& s) {
          return canonical_transformation(s, of, into);
        });
      },
      "state"_a, "from_chart"_a, "to_chart"_a,
      "d(to) / d(from) at hub states: (..., 6, 6), a symplectic matrix.");
}

// The overloads of matrices take anything: a chart before the state is not a momentum.
void require_state_first(const char* function, nb::handle state) {
  bool is_chart = nb::isinstance<nb::str>(state) || nb::isinstance<CanonicalChart>(state) ||
                  nb::isinstance<CanonicalSet>(state);
  const nb::object shape = nb::getattr(state, "shape", nb::none());
  if (!is_chart && nb::isinstance<nb::tuple>(shape) && nb::len(shape) >= 2)
    is_chart = shape[nb::len(shape) - 1].equal(nb::int_(6));
  if (is_chart)
    throw nb::type_error((std::string(function) +
                          ": state: got a chart; expected a RotorState or a momentum (..., 3), and "
                          "charts after it")
                             .c_str());
}

// The same from the B of any canonical charts.
void bind_of_matrices(nb::module_& m) {
  m.def(
      "inverse_chart_jacobian",
      [](ArrayLike g_B, ArrayLike B) {
        require_state_first("inverse_chart_jacobian", g_B);
        std::vector<Numbers> both;
        both.emplace_back(g_B, "state", std::initializer_list<std::size_t>{3});
        both.emplace_back(B, "chart", std::initializer_list<std::size_t>{6, 6});
        const Shape shape = broadcast(both);
        Result out(shape, {6, 6});
        for_each(size_of(shape), [&](std::size_t k) {
          const double* g = both[0].at(k);
          put(out.at(k), inverse_chart_jacobian(Vec3{g[0], g[1], g[2]}, matrix6(both[1].at(k))));
        });
        return out.take();
      },
      "state"_a, "chart"_a,
      "The same for any canonical chart: `chart` is its B (..., 6, 6), `state` the momentum g_B "
      "(..., 3) along the body axes.");
  m.def(
      "canonical_transformation",
      [](ArrayLike g_B, ArrayLike B_from, ArrayLike B_to) {
        require_state_first("canonical_transformation", g_B);
        std::vector<Numbers> all;
        all.emplace_back(g_B, "state", std::initializer_list<std::size_t>{3});
        all.emplace_back(B_from, "from_chart", std::initializer_list<std::size_t>{6, 6});
        all.emplace_back(B_to, "to_chart", std::initializer_list<std::size_t>{6, 6});
        const Shape shape = broadcast(all);
        Result out(shape, {6, 6});
        for_each(size_of(shape), [&](std::size_t k) {
          const double* g = all[0].at(k);
          put(out.at(k), canonical_transformation(Vec3{g[0], g[1], g[2]}, matrix6(all[1].at(k)),
                                                  matrix6(all[2].at(k))));
        });
        return out.take();
      },
      "state"_a, "from_chart"_a, "to_chart"_a,
      "The same for any canonical charts: `from_chart` and `to_chart` are their B (..., 6, 6) at "
      "one "
      "hub state, `state` is its momentum g_B (..., 3) along the body axes.");
}

// Of one body: (6, 6).
void def_of_body(nb::module_& m, const char* name, Matrix6 (*of)(const Body&), const char* doc) {
  m.def(
      name, [of](const Body& body) { return array_of(of(body)); }, "body"_a, doc);
}

template <class S>
void def_of_states(nb::module_& m, const char* name, Matrix6 (*of)(const Body&, const S&),
                   const char* doc) {
  m.def(
      name,
      [of](const Body& body, const Batch<S>& states) {
        return mapped_numbers(states, {6, 6}, [&](const S& s) { return of(body, s); });
      },
      "body"_a, "state"_a, doc);
}

void bind_rates(nb::module_& m) {
  def_of_states<EulerRates>(
      m, "chart_jacobian",
      [](const Body& body, const EulerRates& s) { return chart_jacobian(body, s); },
      "B of Euler angles and their rates: (..., 6, 6). [SA (5)-(7), (24)]");
  def_of_states<EulerRates>(
      m, "inverse_chart_jacobian",
      [](const Body& body, const EulerRates& s) { return inverse_chart_jacobian(body, s); },
      "d(angles, rates) / d(dtheta_B, dg_B): (..., 6, 6). Infinite or NaN at theta = 0, pi.");
  def_of_body(m, "body_rate_jacobian", body_rate_jacobian,
              "d(dtheta_B, dg_B) / d(dtheta_B, domega_B): (6, 6).");
  def_of_body(m, "inverse_body_rate_jacobian", inverse_body_rate_jacobian,
              "d(dtheta_B, domega_B) / d(dtheta_B, dg_B): (6, 6).");
  def_of_states<RotorState>(m, "inertial_rate_jacobian", inertial_rate_jacobian,
                            "d(dtheta_B, dg_B) / d(dtheta_B, domega_I): (..., 6, 6). [SA (8)]");
  def_of_states<RotorState>(m, "inverse_inertial_rate_jacobian", inverse_inertial_rate_jacobian,
                            "d(dtheta_B, domega_I) / d(dtheta_B, dg_B): (..., 6, 6).");
}

}  // namespace

CanonicalChart chart_of(nb::handle chart, const char* name) {
  if (nb::isinstance<CanonicalChart>(chart)) return nb::cast<CanonicalChart>(chart);
  return {choice<CanonicalSet>(chart, name)};
}

void bind_jacobians(nb::module_& m) {
  bind_chart(m);
  bind_canonical(m);
  bind_rates(m);
  bind_of_matrices(m);  // last: it takes anything
}

}  // namespace polhode::python
