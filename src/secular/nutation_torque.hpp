// SPDX-License-Identifier: MIT
// The pull on a planet's bulge as Fourier series in the arguments.
#pragma once

#include <string>
#include <vector>

#include "polhode/secular/nutation.hpp"
#include "polhode/series/symbols.hpp"
#include "secular/complex_series.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Pairs: h, less its mean, with x = H / G0 - cos I0; Phi, where it is there, with y = G / G0 - 1.
// k counts orders. Then the arguments.
class NutationSymbols {
 public:
  explicit NutationSymbols(const NutationProblem& problem);
  const std::vector<std::string>& arguments() const { return arguments_; }
  bool has_phi() const { return arguments_.size() > given_; }
  const Symbols& symbols() const { return symbols_; }

  static constexpr const char* x = "x_";
  static constexpr const char* y = "y_";
  static constexpr const char* k = "k_";
  static constexpr const char* h = "h_";

 private:
  std::vector<std::string> arguments_;
  std::size_t given_;
  Symbols symbols_;
};

// Sums over bodies of gm / r^3 times u_z^2 - 1/3, u_z (u_x + i u_y), (u_x + i u_y)^2; u points at
// the body.
struct NutationTorque {
  NutationTorque(const NutationProblem& problem, const NutationSymbols& names,
                 const std::vector<double>& rates);
  Series<double> q0;
  ComplexSeries q1, q2;
  double folding;
};

// The rate of the arguments in a key.
double rate_of(const Symbols& symbols, const TermKey& key, const std::vector<double>& rates);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
