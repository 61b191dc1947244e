// SPDX-License-Identifier: MIT
// Random numbers of the tests: the same on every machine, one independent stream per case, so that
// a case does not depend on how many others ran.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace oracle {

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t index) {
    std::seed_seq sequence{seed & 0xffffffffU, seed >> 32U, index & 0xffffffffU, index >> 32U};
    engine_.seed(sequence);
  }
  double uniform(double lo, double hi) {
    return lo + (hi - lo) * std::ldexp(static_cast<double>(engine_() >> 11U), -53);
  }
  // 10^x, x uniform
  double power_of_ten(double lo, double hi) { return std::pow(10.0, uniform(lo, hi)); }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  // One coordinate of a Gaussian vector (polar form, one of the two thrown away).
  double normal() {
    const double r = std::sqrt(-2.0 * std::log1p(-uniform(0.0, 1.0)));
    return r * std::cos(uniform(0.0, 2.0 * 3.141592653589793));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace oracle
