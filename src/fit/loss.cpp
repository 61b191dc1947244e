// SPDX-License-Identifier: MIT
#include "polhode/fit/loss.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Below this the quotients of ln(1 + z) cancel, and four terms of their series are exact.
constexpr double small = 1e-4;

LossValue huber(double z) {
  if (!(z > 1.0)) return {};
  const double root = std::sqrt(z);
  return {(2.0 * root - 1.0) / z, (1.0 - root) / z / z, 1.0 / root, 0.0};
}

LossValue soft_l1(double z) {
  const double root = std::sqrt(1.0 + z), sum = 1.0 + root;
  return {2.0 / sum, -1.0 / (root * sum * sum), 1.0 / root, 1.0 / (root * root * root)};
}

LossValue cauchy(double z) {
  const double weight = 1.0 / (1.0 + z), curvature = (1.0 - z) * weight * weight;
  if (z < small) {
    return {1.0 - z * (1.0 / 2.0 - z * (1.0 / 3.0 - z * (1.0 / 4.0 - z / 5.0))),
            -1.0 / 2.0 + z * (2.0 / 3.0 - z * (3.0 / 4.0 - z * (4.0 / 5.0))), weight, curvature};
  }
  const double ratio = std::log1p(z) / z;
  return {ratio, (weight - ratio) / z, weight, curvature};
}

}  // namespace

LossValue value(const Loss& loss, double z) {
  switch (loss.kind) {
    case Loss::Kind::huber:
      return huber(z);
    case Loss::Kind::soft_l1:
      return soft_l1(z);
    case Loss::Kind::cauchy:
      return cauchy(z);
    case Loss::Kind::squared:
      break;
  }
  return {};
}

void check(const Loss& loss) {
  if (!(loss.scale > 0.0) || !std::isfinite(loss.scale)) {
    throw DomainError("Loss: scale = " + detail::number_text(loss.scale) +
                      " must be positive, in standard errors of a residual");
  }
}

}  // namespace v0
}  // namespace polhode
