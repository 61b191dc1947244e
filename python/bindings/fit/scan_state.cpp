// SPDX-License-Identifier: MIT
// A scan as numbers, for pickles, and again from them.
#include <algorithm>
#include <utility>

#include "bindings.hpp"
#include "fit/scan_found.hpp"
#include "interface/arrays.hpp"

namespace polhode::python {

namespace {

using GridState = std::tuple<double, double, std::size_t>;
using TermState = std::tuple<int, int, double, double>;
using RefinedState = std::tuple<bool, double, double, double, double, int>;

GridState state_parts(const fit::FrequencyGrid& g) { return {g.first, g.step, g.count}; }
fit::FrequencyGrid grid_of_state(const GridState& parts) {
  const auto& [first, step, count] = parts;
  return {first, step, count};
}

nb::tuple state_parts(const fit::FourierFit& f) {
  std::vector<TermState> terms;
  for (const fit::FourierTerm& t : f.terms) terms.emplace_back(t.j, t.k, t.cosine, t.sine);
  return nb::make_tuple(f.f1, f.f2, f.chi_square, f.degrees_of_freedom, f.rank, f.unknowns,
                        f.condition, f.constants, terms);
}

fit::FourierFit fourier_fit_of_state(const nb::tuple& parts) {
  fit::FourierFit f{nb::cast<double>(parts[0]),
                    nb::cast<double>(parts[1]),
                    nb::cast<double>(parts[2]),
                    nb::cast<std::size_t>(parts[3]),
                    nb::cast<std::size_t>(parts[4]),
                    nb::cast<std::size_t>(parts[5]),
                    nb::cast<double>(parts[6]),
                    nb::cast<std::vector<double>>(parts[7]),
                    {}};
  for (const auto& [j, k, cosine, sine] : nb::cast<std::vector<TermState>>(parts[8]))
    f.terms.push_back({j, k, cosine, sine});
  return f;
}

nb::tuple state_parts(const fit::ScanMinimum& m) {
  const fit::RefinedPair& r = m.refined;
  return nb::make_tuple(
      m.row, m.column, m.chi_square, m.at_edge, m.resolved, state_parts(r.fit),
      RefinedState{r.converged, r.sigma_f1, r.sigma_f2, r.correlation, r.scale, r.iterations});
}

fit::ScanMinimum minimum_of_state(const nb::tuple& parts) {
  const auto [converged, sigma_f1, sigma_f2, correlation, scale, iterations] =
      nb::cast<RefinedState>(parts[6]);
  return {nb::cast<std::size_t>(parts[0]),
          nb::cast<std::size_t>(parts[1]),
          nb::cast<double>(parts[2]),
          nb::cast<bool>(parts[3]),
          nb::cast<bool>(parts[4]),
          {fourier_fit_of_state(nb::cast<nb::tuple>(parts[5])), converged, sigma_f1, sigma_f2,
           correlation, scale, iterations}};
}

}  // namespace

nb::tuple scan_state(const ScanFound& scan) {
  const fit::Landscape& of = scan.landscape;
  nb::list minima;
  for (const fit::ScanMinimum& m : scan.minima) minima.append(state_parts(m));
  return nb::make_tuple(state_parts(of.first), state_parts(of.second), of.orders.first,
                        of.orders.second, array_of(std::span<const double>(of.chi_square)),
                        of.again, minima);
}

ScanFound scan_of_state(const nb::tuple& state) {
  const Numbers numbers(state[4], "chi_square", {});
  const std::size_t count = size_of(numbers.shape());
  std::vector<double> chi_square(count);
  for (std::size_t i = 0; i < count; ++i) chi_square[i] = *numbers.at(i);
  ScanFound scan{{grid_of_state(nb::cast<GridState>(state[0])),
                  grid_of_state(nb::cast<GridState>(state[1])),
                  {nb::cast<std::size_t>(state[2]), nb::cast<std::size_t>(state[3])},
                  std::move(chi_square),
                  nb::cast<std::size_t>(state[5])},
                 {}};
  for (const nb::handle one : nb::cast<nb::list>(state[6]))
    scan.minima.push_back(minimum_of_state(nb::cast<nb::tuple>(one)));
  return scan;
}

}  // namespace polhode::python
