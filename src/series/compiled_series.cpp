// SPDX-License-Identifier: MIT
#include "polhode/series/compiled_series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace series {

namespace {
// Points that go together.
constexpr std::size_t most_lanes = 8;
}  // namespace

// The scratch array holds numbers in this order, `lanes` values each: powers of each variable,
// pairs (cosine, sine) of multiples of each angle from 0 on, pairs of each combination of angles.
CompiledSeries::CompiledSeries(const Series<double>& series) {
  const Symbols& symbols = series.symbols();
  variables_.resize(symbols.variables().size());
  angles_.resize(symbols.angles().size());
  for (std::size_t i = 0; i < symbols.values().size(); ++i)
    variables_[i].origin = symbols.values()[i];
  for (const Term<double>& term : series.terms()) {
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      const int n = exponent(symbols, term.key, static_cast<int>(i));
      variables_[i].least = std::min(variables_[i].least, n);
      variables_[i].largest = std::max(variables_[i].largest, n);
    }
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      const int k = std::abs(multiplier(symbols, term.key, static_cast<int>(i)));
      angles_[i].largest = std::max(angles_[i].largest, k);
    }
  }
  for (Range& range : variables_) {
    range.start = scratch_;
    scratch_ += static_cast<std::size_t>(range.largest - range.least + 1);
  }
  for (Range& range : angles_) {
    range.start = scratch_;
    scratch_ += 2 * static_cast<std::size_t>(range.largest + 1);
  }
  wave_start_ = scratch_;

  std::map<std::uint64_t, std::size_t> known;  // combinations of angles
  std::uint64_t exponents = 0;
  for (const Term<double>& term : series.terms()) {
    if (groups_.empty() || term.key.exponents != exponents) {
      exponents = term.key.exponents;
      groups_.push_back({monomial_of(symbols, term.key), terms_.size(), terms_.size()});
    }
    const auto [found, is_new] = known.emplace(term.key.angle(), waves_.size());
    if (is_new) waves_.push_back(wave_of(symbols, term.key));
    const std::size_t is_sine = term.key.function() == Trigonometric::sine ? 1 : 0;
    terms_.push_back({term.c, wave_start_ + 2 * found->second + is_sine});
    groups_.back().last = terms_.size();
  }
  scratch_ += 2 * waves_.size();
}

CompiledSeries::Product CompiledSeries::monomial_of(const Symbols& symbols, const TermKey& key) {
  const std::size_t first = factors_.size();
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const int n = exponent(symbols, key, static_cast<int>(i));
    if (n == 0) continue;
    factors_.push_back(variables_[i].start + static_cast<std::size_t>(n - variables_[i].least));
  }
  return {first, factors_.size()};
}

// Even factors turn forwards, odd ones backwards.
CompiledSeries::Product CompiledSeries::wave_of(const Symbols& symbols, const TermKey& key) {
  const std::size_t first = factors_.size();
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    const int k = multiplier(symbols, key, static_cast<int>(i));
    if (k == 0) continue;
    const std::size_t place = angles_[i].start + 2 * static_cast<std::size_t>(std::abs(k));
    factors_.push_back(2 * place + (k < 0 ? 1U : 0U));
  }
  return {first, factors_.size()};
}

template <std::size_t lanes>
void CompiledSeries::fill_powers(const double* points, double* scratch) const {
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Range& range = variables_[i];
    const auto row = [&](int n) {
      return scratch + lanes * (range.start + static_cast<std::size_t>(n - range.least));
    };
    for (std::size_t p = 0; p < lanes; ++p) {
      const double x = points[p * dimension() + i] - range.origin;
      row(0)[p] = 1.0;
      for (int n = 1; n <= range.largest; ++n) row(n)[p] = row(n - 1)[p] * x;
      if (range.least == 0) continue;
      const double inverse = 1.0 / x;
      for (int n = -1; n >= range.least; --n) row(n)[p] = row(n + 1)[p] * inverse;
    }
  }
}

template <std::size_t lanes>
void CompiledSeries::fill_waves(const double* points, double* scratch) const {
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    const Range& range = angles_[i];
    double* const row = scratch + lanes * range.start;
    for (std::size_t p = 0; p < lanes; ++p) {
      const double x = points[p * dimension() + variables_.size() + i];
      const double c = std::cos(x), s = std::sin(x);
      row[p] = 1.0;
      row[lanes + p] = 0.0;
      for (std::size_t k = 1; k <= static_cast<std::size_t>(range.largest); ++k) {
        const double before_c = row[2 * (k - 1) * lanes + p];
        const double before_s = row[(2 * (k - 1) + 1) * lanes + p];
        row[2 * k * lanes + p] = before_c * c - before_s * s;
        row[(2 * k + 1) * lanes + p] = before_s * c + before_c * s;
      }
    }
  }
  for (std::size_t w = 0; w < waves_.size(); ++w) {
    std::array<double, lanes> c, s;
    c.fill(1.0);
    s.fill(0.0);
    for (std::size_t f = waves_[w].first; f < waves_[w].last; ++f) {
      const double sign = factors_[f] % 2 == 0 ? 1.0 : -1.0;
      const double* const turn_c = scratch + lanes * (factors_[f] / 2);
      const double* const turn_s = turn_c + lanes;
      for (std::size_t p = 0; p < lanes; ++p) {
        const double turn = sign * turn_s[p], before = c[p];
        c[p] = before * turn_c[p] - s[p] * turn;
        s[p] = s[p] * turn_c[p] + before * turn;
      }
    }
    double* const wave = scratch + lanes * (wave_start_ + 2 * w);
    std::copy(c.begin(), c.end(), wave);
    std::copy(s.begin(), s.end(), wave + lanes);
  }
}

template <std::size_t lanes>
void CompiledSeries::evaluate(const double* points, double* scratch, double* values) const {
  fill_powers<lanes>(points, scratch);
  fill_waves<lanes>(points, scratch);
  std::array<double, lanes> sum{};
  for (const Group& group : groups_) {
    std::array<double, lanes> inner{}, monomial;
    monomial.fill(1.0);
    for (std::size_t t = group.first; t < group.last; ++t) {
      const double c = terms_[t].c;
      const double* const wave = scratch + lanes * terms_[t].wave;
      for (std::size_t p = 0; p < lanes; ++p) inner[p] += c * wave[p];
    }
    for (std::size_t f = group.monomial.first; f < group.monomial.last; ++f) {
      const double* const factor = scratch + lanes * factors_[f];
      for (std::size_t p = 0; p < lanes; ++p) monomial[p] *= factor[p];
    }
    for (std::size_t p = 0; p < lanes; ++p) sum[p] += monomial[p] * inner[p];
  }
  std::copy(sum.begin(), sum.end(), values);
}

double CompiledSeries::at(std::span<const double> point) const {
  if (point.size() != dimension())
    throw DomainError("CompiledSeries: a point of " + std::to_string(point.size()) +
                      " numbers; it needs " + std::to_string(dimension()));
  std::vector<double> scratch(scratch_);
  double value = 0.0;
  evaluate<1>(point.data(), scratch.data(), &value);
  return value;
}

std::vector<double> CompiledSeries::at_each(std::span<const double> points) const {
  if (dimension() == 0 || points.size() % dimension() != 0)
    throw DomainError("CompiledSeries: points of " + std::to_string(points.size()) +
                      " numbers in all; each needs " + std::to_string(dimension()));
  std::vector<double> values(points.size() / dimension());
  std::vector<double> scratch(scratch_ * most_lanes);
  std::size_t i = 0;
  for (; i + most_lanes <= values.size(); i += most_lanes)
    evaluate<most_lanes>(&points[i * dimension()], scratch.data(), &values[i]);
  for (; i < values.size(); ++i) evaluate<1>(&points[i * dimension()], scratch.data(), &values[i]);
  return values;
}

}  // namespace series
}  // namespace v0
}  // namespace polhode
