// SPDX-License-Identifier: MIT
// The nutation of a rigid planet: the torque as Fourier series, and how the axes answer it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/secular/nutation.hpp"
#include "polhode/series/product.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

// Two real series as one complex series, for what turns with angles.
struct ComplexSeries {
  series::Series<double> re, im;
};

inline ComplexSeries operator+(const ComplexSeries& a, const ComplexSeries& b) {
  return {a.re + b.re, a.im + b.im};
}
inline ComplexSeries operator-(const ComplexSeries& a, const ComplexSeries& b) {
  return {a.re - b.re, a.im - b.im};
}
inline ComplexSeries conj(const ComplexSeries& a) { return {a.re, -a.im}; }
inline ComplexSeries times_i(const ComplexSeries& a) { return {-a.im, a.re}; }

inline ComplexSeries product(const series::Series<double>& a, const ComplexSeries& b,
                             const series::Truncation& keep) {
  return {series::product(a, b.re, keep), series::product(a, b.im, keep)};
}

// a exp(i n angle).
inline ComplexSeries turned(const ComplexSeries& a, const series::Multiples& by,
                            const series::Truncation& keep) {
  const series::Series<double> c = series::cosine(a.re.symbols(), 1.0, {}, by),
                               s = series::sine(a.re.symbols(), 1.0, {}, by);
  return {series::product(a.re, c, keep) - series::product(a.im, s, keep),
          series::product(a.re, s, keep) + series::product(a.im, c, keep)};
}

// The symbols of the pull on a planet's bulge. Pairs: h, less its mean, with x = H / G0 - cos I0;
// Phi, where it is there, with y = G / G0 - 1. k counts orders. Then the arguments.
class NutationSymbols {
 public:
  explicit NutationSymbols(const NutationProblem& problem);
  const std::vector<std::string>& arguments() const { return arguments_; }
  bool has_phi() const { return arguments_.size() > given_; }
  const series::Symbols& symbols() const { return symbols_; }

  static constexpr const char* x = "x_";
  static constexpr const char* y = "y_";
  static constexpr const char* k = "k_";
  static constexpr const char* h = "h_";

 private:
  std::vector<std::string> arguments_;
  std::size_t given_;
  series::Symbols symbols_;
};

// Sums over bodies of gm / r^3 times u_z^2 - 1/3, u_z (u_x + i u_y), (u_x + i u_y)^2; u points at
// the body.
struct NutationTorque {
  NutationTorque(const NutationProblem& problem, const NutationSymbols& names,
                 const std::vector<double>& rates);
  series::Series<double> q0;
  ComplexSeries q1, q2;
  double folding;
};

// The rate of the arguments in a key.
double rate_of(const series::Symbols& symbols, const series::TermKey& key,
               const std::vector<double>& rates);

// By multipliers, of which the first that is not zero is positive.
using Waves = std::map<std::vector<int>, NutationWave>;

Waves sum(const Waves& a, const Waves& b);

struct MomentumMotion {
  NutationOffset precession;
  double phi_rate;  // of Phi, where it is there
  Waves nutation;
};
// Poisson terms.
MomentumMotion momentum_motion(const NutationProblem& problem, const NutationSymbols& names,
                               const NutationTorque& torque, const std::vector<double>& rates);

struct WobbleMotion {
  Waves figure, rotation;  // less the momentum
};
// Oppolzer terms.
WobbleMotion wobble_motion(const NutationProblem& problem, const NutationSymbols& names,
                           const NutationTorque& torque, const std::vector<double>& rates);

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
