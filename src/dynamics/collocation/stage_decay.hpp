// SPDX-License-Identifier: MIT
// A decay that is part of the rate of a number, s' = r - d s: solved within each sweep, so that
// sweeps converge however fast it is.
#pragma once

#include <cmath>
#include <utility>

#include "dynamics/collocation/gauss_scheme.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// S = P - d mu (hb S), P what the stages would be by r alone.
class StageDecay {
 public:
  // For steps of weights hb: the inverse of 1 + d mu hb, by elimination with pivots. Its worst loop
  // has 32^3 trips, once for each length of steps.
  void prepare(const GaussScheme& scheme, const StageRow& hb, double d) {
    count_ = scheme.stages;
    StageMatrix a{};
    for (std::size_t j = 0; j < count_; ++j) {
      inverse_[j] = {};
      inverse_[j][j] = 1.0;
      for (std::size_t i = 0; i < count_; ++i)
        a[j][i] = (i == j ? 1.0 : 0.0) + d * hb[j] * scheme.mu[j][i];
    }
    for (std::size_t k = 0; k < count_; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < count_; ++i)
        if (std::abs(a[k][i]) > std::abs(a[k][pivot])) pivot = i;
      for (std::size_t j = 0; j < count_; ++j) {
        std::swap(a[j][k], a[j][pivot]);
        std::swap(inverse_[j][k], inverse_[j][pivot]);
      }
      const double scale = 1.0 / a[k][k];
      for (std::size_t j = 0; j < count_; ++j) {
        a[j][k] *= scale;
        inverse_[j][k] *= scale;
      }
      for (std::size_t i = 0; i < count_; ++i) {
        const double factor = a[k][i];
        if (i == k || factor == 0.0) continue;
        for (std::size_t j = 0; j < count_; ++j) {
          a[j][i] -= factor * a[j][k];
          inverse_[j][i] -= factor * inverse_[j][k];
        }
      }
    }
  }

  StageRow solved(const StageRow& P) const {
    StageRow S{};
    for (std::size_t j = 0; j < count_; ++j)
      for (std::size_t i = 0; i < count_; ++i) S[i] += inverse_[j][i] * P[j];
    return S;
  }

 private:
  std::size_t count_ = 0;
  StageMatrix inverse_{};  // by columns
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
