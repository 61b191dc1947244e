// SPDX-License-Identifier: MIT
// Lie transforms of Hamiltonians in series.
#include <memory>

#include "interface/value.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "series/series_value.hpp"

namespace polhode::python {

namespace {

// What it was made from, and what came of it.
struct PythonTransform {
  template <class T>
  using Shared = std::shared_ptr<const secular::LieTransform<T>>;

  PythonSeries hamiltonian;
  series::Truncation keep;
  std::vector<std::string> angles;
  std::vector<Counts> resonances;
  Operands clocks;
  double least_divisor;
  secular::LieMethod method;
  std::variant<Shared<series::Rational>, Shared<double>, Shared<MomentumFunction>> transform;
};

template <class T>
std::shared_ptr<const secular::LieTransform<T>> solved(const PythonTransform& of) {
  const series::Symbols& symbols = of.hamiltonian.symbols();
  secular::Elimination<T> problem{as<T>(of.hamiltonian),           of.keep,         of.angles, {},
                                  rates_of<T>(symbols, of.clocks), of.least_divisor};
  for (const Counts& resonance : of.resonances) problem.resonances.push_back(pairs_of(resonance));
  return std::make_shared<secular::LieTransform<T>>(std::move(problem), of.method);
}

PythonTransform transform_of(const PythonSeries& hamiltonian, const series::Truncation& keep,
                             const std::vector<std::string>& angles,
                             const std::vector<Counts>& resonances, const Operands& clocks,
                             double least_divisor, secular::LieMethod method) {
  PythonTransform out{hamiltonian, keep, angles, resonances, clocks, least_divisor, method, {}};
  const WithoutGil released;
  with_numbers_of(hamiltonian, are_exact(hamiltonian.symbols(), clocks),
                  [&]<class T>() { out.transform = solved<T>(out); });
  return out;
}

// f(transform), a series.
template <class F>
PythonSeries of(const PythonTransform& t, F f) {
  const WithoutGil released;
  return std::visit([&](const auto& shared) { return PythonSeries{f(*shared)}; }, t.transform);
}
template <class T>
series::Series<T> alike(const secular::LieTransform<T>& lie, const PythonSeries& f) {
  series::detail::require_same(f.symbols(), lie.mean_hamiltonian().symbols());
  return as<T>(f);
}

void def_maps(nb::class_<PythonTransform>& c) {
  using T = PythonTransform;
  c.def_prop_ro(
       "mean_hamiltonian",
       [](const T& t) { return of(t, [](const auto& lie) { return lie.mean_hamiltonian(); }); },
       "In mean variables, without the angles that were eliminated.")
      .def_prop_ro(
          "generator",
          [](const T& t) { return of(t, [](const auto& lie) { return lie.generator(); }); },
          "Hori's S; of Deprit the sum of W_n / (n - 1)!.")
      .def(
          "in_mean",
          [](const T& t, const PythonSeries& f) {
            return of(t, [&](const auto& lie) { return lie.in_mean(alike(lie, f)); });
          },
          "f"_a, "f of the osculating variables, as a function of the mean ones.")
      .def(
          "in_osculating",
          [](const T& t, const PythonSeries& f) {
            return of(t, [&](const auto& lie) { return lie.in_osculating(alike(lie, f)); });
          },
          "f"_a, "f of the mean variables, as a function of the osculating ones.")
      .def(
          "short_period",
          [](const T& t, const std::string& name) {
            return of(t, [&](const auto& lie) { return lie.short_period(name); });
          },
          "name"_a,
          "Osculating minus mean value of a variable or an angle, as a function of the mean ones.")
      .def(
          "short_period_back",
          [](const T& t, const std::string& name) {
            return of(t, [&](const auto& lie) { return lie.short_period_back(name); });
          },
          "name"_a, "Mean minus osculating value, as a function of the osculating variables.");
}

}  // namespace

void bind_lie_transform(nb::module_& m) {
  nb::enum_<secular::LieMethod>(m, "LieMethod", "A way to the mean Hamiltonian.")
      .value("deprit", secular::LieMethod::deprit, "Deprit's triangle.")
      .value("hori", secular::LieMethod::hori, "Hori's exponential of one generator.");
  using T = PythonTransform;
  auto c = bind_made_value<T>(
      m, "LieTransform", R"(Angles eliminated from a Hamiltonian, to any order.

H = sum of H_n, n the order in the small parameters. Hori: K = exp(L_S) H with L_S f = {f, S};
Deprit: his triangle. Order by order K_n is what has none of the angles, and the rest is the flow
of H_0 on the generator. Exact if the Hamiltonian and the clocks are. The rate of each combination
of angles is one term, or any function of the momenta if the symbols have values of them; results
then hold near these values.

Parameters
----------
hamiltonian : Series; its part of order 0 has no angle, and no coordinate that is a variable, nor
    the momentum of one.
keep : Truncation by small parameters, which are in no pair; at most order 30.
angles : to be eliminated.
resonances : combinations of them that stay, with their multiples: [{"l": 1, "g": -2}].
clocks : rates of angles without a momentum: time, {"t": 1}. They have no angles, no small
    parameters, and nothing that is in a pair.
least_divisor : the smallest coefficient of a rate to divide by.
method : LieMethod or its name.

ValueError for what breaks this, for a divisor below the bound, with its combination of angles, and,
before it starts, for an order that may need more memory than keep.most_bytes (by
Series.transform_size). Releases the GIL. (Hori 1966; Deprit
1969))",
      transform_of, field("hamiltonian", &T::hamiltonian, "What was given."),
      field("keep", &T::keep, "The small parameters, and the highest order."),
      field("angles", &T::angles, "Those eliminated."),
      field("resonances", &T::resonances, "Combinations of them that stay.", std::vector<Counts>()),
      field("clocks", &T::clocks, "Rates of angles without a momentum.", Operands()),
      field("least_divisor", &T::least_divisor, "The smallest coefficient of a rate.", 0.0),
      field("method", &T::method, "Hori's or Deprit's.", secular::LieMethod::hori));
  def_maps(c);
  bind_mean_rotation(m);
}

}  // namespace polhode::python
