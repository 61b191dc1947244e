// SPDX-License-Identifier: MIT
// Lie transforms order by order. Functions are split into parts of order 0, 1, ..., N; so is the
// generator, whose part 0 is zero. f_0 enters by first(s) = {f_0, s} alone: f may be an angle,
// which is no series, or a Hamiltonian with clocks.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/linear_flow.hpp"
#include "polhode/series/product.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

template <class T>
using Parts = std::vector<series::Series<T>>;

// Throws unless the weights are those of small parameters.
void require_small(const series::Symbols& symbols, const series::Truncation& keep);

// Which terms stay in the mean Hamiltonian.
class KeptAngles {
 public:
  KeptAngles(const series::Symbols& symbols, const std::vector<std::string>& angles,
             const std::vector<std::vector<std::pair<std::string, int>>>& resonances);
  // None of the angles, or a multiple of a resonance.
  bool keeps(const series::TermKey& key) const;

 private:
  series::Symbols symbols_;
  std::vector<int> places_;
  std::vector<std::vector<int>> resonances_;  // multipliers of the places
};

template <class T>
void require_integrable(const series::Series<T>& h0) {
  for (const std::string& angle : h0.symbols().angles())
    if (!series::derivative(h0, angle).is_zero())
      throw DomainError("LieTransform: the part of order 0 depends on the angle " + angle);
  for (const series::ConjugatePair& pair : h0.symbols().pairs())
    if (h0.symbols().has_variable(pair.coordinate) &&
        !series::derivative(h0, pair.coordinate).is_zero())
      throw DomainError("LieTransform: the part of order 0 depends on the coordinate " +
                        pair.coordinate);
  // q would advance in time, and nothing here follows it.
  for (const series::ConjugatePair& pair : h0.symbols().pairs())
    if (h0.symbols().has_variable(pair.coordinate) &&
        !series::derivative(h0, pair.momentum).is_zero())
      throw DomainError("LieTransform: the part of order 0 depends on the momentum " +
                        pair.momentum + " of " + pair.coordinate +
                        ", which is a variable; give that part an order");
}

template <class T>
void require_clock(const series::Series<T>& h, const series::AngleRate<T>& clock,
                   const series::Truncation& keep) {
  const series::Symbols& symbols = h.symbols();
  series::detail::require_same(symbols, clock.rate.symbols());
  symbols.angle(clock.angle);
  for (const auto& [q, p] : symbols.pairs())
    if (q == clock.angle && !series::derivative(h, p).is_zero())
      throw DomainError("LieTransform: the clock " + q + " has the momentum " + p +
                        ", and a rate by the Hamiltonian");
  const series::detail::Orders orders(symbols, keep);
  const auto refuse = [&](const std::string& why) {
    throw DomainError("LieTransform: the rate of the clock " + clock.angle + " " + why);
  };
  for (const series::Term<T>& term : clock.rate.terms()) {
    if (term.key.angle() != symbols.multipliers().zero()) refuse("depends on angles");
    if (orders.of(term.key) != 0) refuse("has a small parameter");
  }
  for (const series::ConjugatePair& pair : symbols.pairs())
    for (const std::string& name : {pair.coordinate, pair.momentum})
      if (!series::derivative(clock.rate, name).is_zero())
        refuse("depends on " + name + ", of a pair");
}

template <class T>
Parts<T> parts(const series::Series<T>& f, const series::Truncation& keep) {
  const series::detail::Orders orders(f.symbols(), keep);
  for (const series::Term<T>& term : f.terms())
    if (orders.of(term.key) < 0)
      throw DomainError("LieTransform: the term with " + series::text(f.symbols(), term.key) +
                        " has an order below 0");
  Parts<T> all;
  for (int n = 0; n <= keep.order; ++n) all.push_back(series::part_of_order(f, keep, n));
  return all;
}

template <class T>
series::Series<T> sum(const Parts<T>& parts) {
  series::Series<T> whole(parts[0].symbols());
  for (const series::Series<T>& part : parts) whole += part;
  return whole;
}

template <class T>
T factorial(int n) {
  T product(1);
  for (int k = 2; k <= n; ++k) product = product * T(k);
  return product;
}
// In T: past 30 it would leave int.
template <class T>
T binomial(std::size_t n, std::size_t k) {
  T product(1);
  for (std::size_t i = 1; i <= k; ++i)
    product = product * T(static_cast<int>(n - k + i)) / T(static_cast<int>(i));
  return product;
}

// Throws for an unknown one.
void require_symbol(const series::Symbols& symbols, std::string_view name);

// {x, s} of the symbol x itself: ds/dp of a coordinate, -ds/dq of a momentum, 0 of others.
template <class T>
series::Series<T> symbol_bracket(const series::Series<T>& s, std::string_view name) {
  for (const series::ConjugatePair& pair : s.symbols().pairs()) {
    if (pair.coordinate == name) return series::derivative(s, pair.momentum);
    if (pair.momentum == name) return -series::derivative(s, pair.coordinate);
  }
  return series::Series<T>(s.symbols());
}

template <class T>
struct LieSolver {
  std::function<series::Series<T>(const series::Series<T>&)> flow;  // {H_0, s}
  // What stays of the rest, and the s whose flow takes the others away.
  std::function<std::pair<series::Series<T>, series::Series<T>>(const series::Series<T>&)>
      eliminated;
};

template <class T>
struct MeanAndGenerator {
  Parts<T> mean, generator;
};

// --- Hori: rows[m][n] is the part of order n of L^m f / m! ---

// That of rows[m], m >= 1, from s_1 to s_(n - 1), and from s_n too where it is there.
template <class T>
series::Series<T> hori_entry(const std::vector<Parts<T>>& rows, const Parts<T>& s, std::size_t m,
                             std::size_t n, const series::Truncation& keep) {
  series::Series<T> entry(s[0].symbols());
  for (std::size_t j = 1; j < n; ++j) entry += series::bracket(rows[m - 1][n - j], s[j], keep);
  return entry / T(static_cast<int>(m));
}

template <class T>
MeanAndGenerator<T> hori_mean(const Parts<T>& h, const LieSolver<T>& solver,
                              const series::Truncation& keep) {
  const std::size_t count = h.size();
  const series::Series<T> zero(h[0].symbols());
  MeanAndGenerator<T> found{{h[0]}, {zero}};
  std::vector<Parts<T>> rows(count, Parts<T>(count, zero));
  rows[0] = h;
  for (std::size_t n = 1; n < count; ++n) {
    series::Series<T> rest = h[n];
    for (std::size_t m = 1; m <= n; ++m) {
      rows[m][n] = hori_entry(rows, found.generator, m, n, keep);
      rest += rows[m][n];
    }
    auto [mean, s] = solver.eliminated(rest);
    rows[1][n] += solver.flow(s);
    found.mean.push_back(std::move(mean));
    found.generator.push_back(std::move(s));
  }
  return found;
}

template <class T, class First>
Parts<T> hori_map(const Parts<T>& f, Parts<T> s, const First& first, bool back,
                  const series::Truncation& keep) {
  const std::size_t count = s.size();
  if (back)
    for (series::Series<T>& one : s) one = -one;
  std::vector<Parts<T>> rows(count, Parts<T>(count, series::Series<T>(s[0].symbols())));
  rows[0] = f;
  Parts<T> result = f;
  for (std::size_t n = 1; n < count; ++n) {
    for (std::size_t m = 1; m <= n; ++m) rows[m][n] = hori_entry(rows, s, m, n, keep);
    rows[1][n] += first(s[n]);
    for (std::size_t m = 1; m <= n; ++m) result[n] += rows[m][n];
  }
  return result;
}

// --- Deprit: rows[k][n] is f_n^(k) ---

// The sum over j of binomial(n, j) {f_(n-j)^(k), w_(j+1)}, without {f_0^(0), w}.
template <class T>
series::Series<T> deprit_sum(const std::vector<Parts<T>>& rows, const Parts<T>& w, std::size_t k,
                             std::size_t n, const series::Truncation& keep) {
  series::Series<T> sum(w[0].symbols());
  for (std::size_t j = 0; j <= n; ++j)
    if (k > 0 || j < n) sum += binomial<T>(n, j) * series::bracket(rows[k][n - j], w[j + 1], keep);
  return sum;
}

// f_(n-k)^(k) for k = 1, ..., n, from f_n^(0) on; step is {f_0, w_n}.
template <class T>
void deprit_diagonal(std::vector<Parts<T>>& rows, const Parts<T>& w, std::size_t n,
                     const series::Series<T>& step, const series::Truncation& keep) {
  for (std::size_t k = 1; k <= n; ++k) {
    rows[k][n - k] = rows[k - 1][n - k + 1] + deprit_sum(rows, w, k - 1, n - k, keep);
    if (k == 1) rows[k][n - k] += step;
  }
}

template <class T>
MeanAndGenerator<T> deprit_mean(const Parts<T>& h, const LieSolver<T>& solver,
                                const series::Truncation& keep) {
  const std::size_t count = h.size();
  const series::Series<T> zero(h[0].symbols());
  MeanAndGenerator<T> found{{h[0]}, Parts<T>(count, zero)};
  std::vector<Parts<T>> rows(count, Parts<T>(count, zero));
  rows[0][0] = h[0];
  for (std::size_t n = 1; n < count; ++n) {
    const T scale = factorial<T>(static_cast<int>(n));
    rows[0][n] = scale * h[n];
    deprit_diagonal(rows, found.generator, n, zero, keep);
    auto [mean, w] = solver.eliminated(rows[n][0]);
    const series::Series<T> flow = solver.flow(w);
    for (std::size_t k = 1; k <= n; ++k) rows[k][n - k] += flow;
    found.mean.push_back(mean / scale);
    found.generator[n] = std::move(w);
  }
  return found;
}

template <class T, class First>
Parts<T> deprit_map(const Parts<T>& f, const Parts<T>& w, const First& first,
                    const series::Truncation& keep) {
  const std::size_t count = w.size();
  std::vector<Parts<T>> rows(count, Parts<T>(count, series::Series<T>(w[0].symbols())));
  Parts<T> result = f;
  for (std::size_t n = 0; n < count; ++n) {
    const T scale = factorial<T>(static_cast<int>(n));
    rows[0][n] = scale * f[n];
    deprit_diagonal(rows, w, n, first(w[n]), keep);
    result[n] = rows[n][0] / scale;
  }
  return result;
}

// The triangle from its other side: f_0^(k) is given, f_n^(0) is wanted.
template <class T, class First>
Parts<T> deprit_inverse(const Parts<T>& f, const Parts<T>& w, const First& first,
                        const series::Truncation& keep) {
  const std::size_t count = w.size();
  std::vector<Parts<T>> rows(count, Parts<T>(count, series::Series<T>(w[0].symbols())));
  Parts<T> result = f;
  for (std::size_t n = 0; n < count; ++n) {
    const T scale = factorial<T>(static_cast<int>(n));
    rows[n][0] = scale * f[n];
    for (std::size_t k = n; k >= 1; --k) {
      rows[k - 1][n - k + 1] = rows[k][n - k] - deprit_sum(rows, w, k - 1, n - k, keep);
      if (k == 1) rows[0][n] -= first(w[n]);
    }
    result[n] = rows[0][n] / scale;
  }
  return result;
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
