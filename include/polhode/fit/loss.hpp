// SPDX-License-Identifier: MIT
// Loss: what a residual costs. The square of it, or less where it is far out, so that a few bad
// observations do not draw a fit away from the good ones.
//
// Equations   With z = |r|^2 / scale^2 a residual (one number, or the three of a rotation) costs
//             scale^2 rho(z) in place of |r|^2: z (squared); z, and 2 sqrt(z) - 1 from z = 1 on
//             (huber); 2 (sqrt(1 + z) - 1) (soft_l1); ln(1 + z) (cauchy). A least-squares method
//             sees f = r sqrt(rho(z) / z), whose square is the loss to the last digit, and the
//             derivative of that.
// Units       residuals are in units of their standard errors, and so is scale.
// Domain      scale > 0; any residual. As z -> 0 every loss is the square.
// Accuracy    budget loss in tests/budgets/fit.hpp.
// Errors      DomainError for a scale that is not positive and finite.
// Cost        a few dozen flops.
#pragma once

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

struct Loss {
  enum class Kind { squared, huber, soft_l1, cauchy };
  Kind kind = Kind::squared;
  double scale = 1.0;
};

// At z, the square of a residual over that of the scale.
struct LossValue {
  double ratio = 1.0;  // rho(z) / z, which the square of a residual is multiplied by
  double slope = 0.0;  // of the ratio, d(rho / z)/dz
  // rho'(z): the weight that the residual keeps in the normal equations.
  double weight = 1.0;
  // rho' + 2 z rho'': the derivative of weight times residual by the residual, for one number
  double curvature = 1.0;
};

LossValue value(const Loss& loss, double z);

// Throws unless the scale is positive and finite.
void check(const Loss& loss);

}  // namespace v0
}  // namespace polhode
