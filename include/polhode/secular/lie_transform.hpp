// SPDX-License-Identifier: MIT
// Angles eliminated from a Hamiltonian by a canonical Lie transform, to any order, by Deprit's
// triangle or by Hori's method; and the maps between mean and osculating functions.
//
// Equations   H = sum of H_n, n the order in the small parameters, H_0 without angles.
//             Hori: K = exp(L_S) H, L_S f = {f, S}. Deprit: H_n^(k) = H_(n+1)^(k-1)
//             + sum over j of binomial(n, j) {H_(n-j)^(k-1), W_(j+1)}, n! H_n at k = 0, K from
//             H_0^(n) / n!. Order by order, K_n is what is kept of all that is known, and the rest
//             is the flow of H_0 on the generator: w.dS_n/dphi = rest, w = dH_0/dp. The generator
//             is sum of S_n, or of W_n / (n-1)!.
// Units       those of the Hamiltonian's symbols.
// Domain      small parameters: variables in no pair, with weights > 0. H_0 has no angle, and no
//             coordinate that is a variable, nor its momentum. A clock is an angle without a
//             momentum that advances at a rate of its own: time. That has neither angles, nor
//             small parameters, nor what is in a pair. At most 30 orders.
// Accuracy    exact in Rational, to the order kept; else the roundings of T.
// Errors      DomainError for what breaks this, for a divisor below the bound (with its combination
//             of angles), and, before it starts, for an order that may need more memory than
//             keep.most_bytes, by the estimate of transform_size.hpp.
// Cost        brackets: some order^3 / 6 of parts of series, which grow with the order themselves.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/secular/detail/lie_problem.hpp"
#include "polhode/secular/elimination.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

enum class LieMethod { deprit, hori };

template <series::Coefficient T>
class LieTransform {
 public:
  explicit LieTransform(Elimination<T> problem, LieMethod method = LieMethod::hori)
      : problem_(std::move(problem)),
        method_(method),
        keys_(detail::lie_keys(problem_, detail::checked_parts(problem_))),
        generator_(problem_.hamiltonian.symbols()),
        mean_(problem_.hamiltonian.symbols()) {
    require_room(keys_.count(), "");
    const detail::Parts<T> h = detail::parts(problem_.hamiltonian, problem_.keep);
    const detail::LieSolver<T> solver{
        [&](const series::Series<T>& s) { return flow(h[0], s); },
        [&](const series::Series<T>& rest) { return eliminated(h[0], rest); }};
    auto [mean, generator] = method_ == LieMethod::deprit
                                 ? detail::deprit_mean(h, solver, problem_.keep)
                                 : detail::hori_mean(h, solver, problem_.keep);
    generators_ = std::move(generator);
    mean_ = detail::sum(mean);
    for (std::size_t n = 1; n < generators_.size(); ++n)
      generator_ += method_ == LieMethod::deprit
                        ? generators_[n] / detail::factorial<T>(static_cast<int>(n) - 1)
                        : generators_[n];
  }

  const series::Series<T>& mean_hamiltonian() const { return mean_; }
  const series::Series<T>& generator() const { return generator_; }

  // f of the osculating variables, as a function of the mean ones.
  series::Series<T> in_mean(const series::Series<T>& f) const { return mapped(f, false); }
  // f of the mean variables, as a function of the osculating ones.
  series::Series<T> in_osculating(const series::Series<T>& f) const { return mapped(f, true); }

  // Osculating minus mean value of a variable or an angle, as a function of the mean variables.
  series::Series<T> short_period(std::string_view name) const { return displacement(name, false); }
  // Mean minus osculating value, as a function of the osculating variables.
  series::Series<T> short_period_back(std::string_view name) const {
    return displacement(name, true);
  }

 private:
  // {H_0, s}, and what the clocks add to it.
  series::Series<T> flow(const series::Series<T>& h0, const series::Series<T>& s) const {
    series::Series<T> sum = series::bracket(h0, s, problem_.keep);
    for (const series::AngleRate<T>& clock : problem_.clocks)
      sum -= series::product(clock.rate, series::derivative(s, clock.angle), problem_.keep);
    return sum;
  }

  std::pair<series::Series<T>, series::Series<T>> eliminated(const series::Series<T>& h0,
                                                             const series::Series<T>& rest) const {
    const std::vector<series::AngleRate<T>> rates = detail::angle_rates(h0, problem_.clocks);
    const detail::KeptAngles kept(h0.symbols(), problem_.angles, problem_.resonances);
    const series::Series<T> mean = series::selected(rest, [&](const series::TermKey& key) {
      return kept.keeps(key) || is_slow(rest, key, rates);
    });
    return {mean, series::integral(rest - mean, rates, problem_.least_divisor)};
  }

  bool is_slow(const series::Series<T>& rest, const series::TermKey& key,
               const std::vector<series::AngleRate<T>>& rates) const {
    if (!(problem_.slowest > 0.0)) return false;
    const series::Series<T> w = series::rate(rest, key, rates);
    return w.is_zero() || (w.size() == 1 && std::abs(to_double(w.terms()[0].c)) < problem_.slowest);
  }

  series::Series<T> mapped(const series::Series<T>& f, bool back) const {
    series::detail::require_same(f.symbols(), mean_.symbols());
    const detail::Parts<T> parts = detail::parts(f, problem_.keep);
    require_room(keys_.count_of(detail::keys_of(parts)), "a map to ");
    return carried(
        parts,
        [&](const series::Series<T>& s) { return series::bracket(parts[0], s, problem_.keep); },
        back);
  }

  series::Series<T> displacement(std::string_view name, bool back) const {
    const series::Symbols& symbols = mean_.symbols();
    detail::require_symbol(symbols, name);
    require_room(keys_.count_of(name), "a map to ");
    const detail::Parts<T> none(generators_.size(), series::Series<T>(symbols));
    return carried(
        none, [&](const series::Series<T>& s) { return detail::symbol_bracket(s, name); }, back);
  }

  void require_room(const detail::KeyCount& count, const char* what) const {
    detail::require_room(what, count, detail::bytes_of<T>(count), problem_.keep.most_bytes);
  }

  // first(s) is {f_0, s}.
  template <class First>
  series::Series<T> carried(const detail::Parts<T>& f, const First& first, bool back) const {
    if (method_ == LieMethod::hori)
      return detail::sum(detail::hori_map(f, generators_, first, back, problem_.keep));
    return detail::sum(back ? detail::deprit_inverse(f, generators_, first, problem_.keep)
                            : detail::deprit_map(f, generators_, first, problem_.keep));
  }

  Elimination<T> problem_;
  LieMethod method_;
  detail::LieKeys keys_;
  detail::Parts<T> generators_;  // by order; S_n, or W_n
  series::Series<T> generator_, mean_;
};

// How many terms and bytes a Lie transform will take, before it starts.
//
// Equations   keys of order n, exponents and multipliers, are those of H_n, and those of order
//             n - a with a key of H_a, a momentum less, over a rate. Bytes: n + 3 series of each
//             order n, and the table of a product, which begins with 2^18 places.
// Units       bytes.
// Domain      as in lie_transform.hpp.
// Accuracy    terms: an upper bound, 1 to 2.5 times what is there, and 5 where few terms of H have
//             to do with each other (tests/unit/secular/transform_size.cpp). It is counted for a
//             tenth of a second; higher orders are extrapolated by a power of the order, that of
//             the dimensions of the keys. Digits of rationals on the heap come on top.
// Errors      DomainError for what a Lie transform refuses of H_0, its orders and clocks.
// Cost        20 to 50 ns a pair of keys, 2e6 pairs at most; from a fifth of a small transform down
//             to a hundredth of a large one (benchmarks/perturbation_theory.cpp).

// By order.
struct TransformSize {
  std::vector<double> terms;  // of a series of this order, at most
  std::vector<double> bytes;  // of memory, if this order is the last
  int counted;                // the last order that was counted; what follows is extrapolated
};

template <series::Coefficient T>
TransformSize transform_size(const Elimination<T>& problem) {
  const detail::KeyCount count = detail::lie_keys(problem, detail::checked_parts(problem)).count();
  return {count.terms, detail::bytes_of<T>(count), count.counted};
}

}  // namespace secular
}  // namespace v0
}  // namespace polhode
