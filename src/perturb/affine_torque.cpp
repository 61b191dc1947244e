// SPDX-License-Identifier: MIT
#include "polhode/detail/perturb/affine_torque.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/finite.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double small = 0.5;
constexpr int most_terms = 20;  // 0.5^20 / 21! is far below a rounding

double largest_row_sum(const Mat3& m) {
  double r = 0.0;
  for (const Vec3& row : m.row)
    r = detail::larger(r, std::abs(row.x) + std::abs(row.y) + std::abs(row.z));
  return r;
}

Mat3 scaled(double f, const Mat3& m) { return {{f * m.row[0], f * m.row[1], f * m.row[2]}}; }
Mat3 sum(const Mat3& a, const Mat3& b) {
  return {{a.row[0] + b.row[0], a.row[1] + b.row[1], a.row[2] + b.row[2]}};
}

// phi(X) v = v + X v / 2 + X^2 v / 6 + ...; |X| <= 1/2
Vec3 series(const Mat3& X, const Vec3& v) {
  Vec3 result = v, term = v;
  for (int k = 2; k < most_terms; ++k) {  // 18 trips
    term = (1.0 / k) * (X * term);
    const Vec3 next = result + term;
    if (next == result) break;
    result = next;
  }
  return result;
}

// The same for a larger X: phi(2 X) = (exp(X) + 1) phi(X) / 2.
Vec3 doubled(const Mat3& X, double size, const Vec3& v) {
  const int doublings = std::min(std::ilogb(size / small) + 1, 1100);
  const Mat3 Y = scaled(std::ldexp(1.0, -doublings), X);
  Mat3 phi;  // by columns
  for (int j = 0; j < 3; ++j) {
    Vec3 unit;
    unit[j] = 1.0;
    const Vec3 column = series(Y, unit);
    for (int i = 0; i < 3; ++i) phi(i, j) = column[i];
  }
  Mat3 exponential = sum(Mat3::identity(), Y * phi);
  for (int k = 0; k < doublings; ++k) {  // 1100 trips
    phi = scaled(0.5, sum(exponential, Mat3::identity()) * phi);
    exponential = exponential * exponential;
  }
  return phi * v;
}

}  // namespace

AffineTorque operator+(const AffineTorque& a, const AffineTorque& b) {
  return {a.constant + b.constant, sum(a.damping, b.damping)};
}

Vec3 change_of_momentum(const AffineTorque& torque, const Vec3& g, double h) {
  const Vec3 u = torque.constant - torque.damping * g;
  const Mat3 X = scaled(-h, torque.damping);
  const double size = largest_row_sum(X);
  if (size > small && size <= std::numeric_limits<double>::max()) return h * doubled(X, size, u);
  return h * series(X, u);
}

}  // namespace v0
}  // namespace polhode
