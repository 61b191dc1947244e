// SPDX-License-Identifier: MIT
#include "polhode/rotor/attitude.hpp"

#include <cmath>
#include <limits>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
// How far R R^T may be from 1: room for matrices written with seven digits.
constexpr double orthogonality = 1e-6;

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string text(const Vec3& v) { return detail::tuple_text({v.x, v.y, v.z}); }

void require_rotation(const Mat3& R) {
  for (const Vec3& row : R.row) {
    if (!finite(row)) throw DomainError("attitude: matrix row " + text(row) + " must be finite");
  }
  const Mat3 product = R * transpose(R);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double error = product(i, j) - (i == j ? 1.0 : 0.0);
      if (!(std::abs(error) <= orthogonality)) {
        throw DomainError("attitude: matrix with R R^T off the identity by " +
                          detail::number_text(error) + " must be orthogonal to " +
                          detail::number_text(orthogonality));
      }
    }
  }
  const double det = dot(R.row[0], cross(R.row[1], R.row[2]));
  if (det < 0.0) {
    throw DomainError("attitude: matrix with determinant " + detail::number_text(det) +
                      " must be a proper rotation");
  }
}

}  // namespace

Quaternion unit_quaternion(double w, double x, double y, double z) {
  const Quaternion q{w, x, y, z};
  if (!std::isfinite(w) || !finite({x, y, z})) {
    throw DomainError("unit_quaternion: " + detail::tuple_text({w, x, y, z}) + " must be finite");
  }
  if (w == 0.0 && x == 0.0 && y == 0.0 && z == 0.0) {
    throw DomainError("unit_quaternion: (0, 0, 0, 0) must not be zero");
  }
  const double n2 = w * w + x * x + y * y + z * z;
  return std::abs(n2 - 1.0) <= 8.0 * eps ? q : normalized(q);
}

// From the largest of 4 w^2, 4 x^2, 4 y^2, 4 z^2: no difference of near-equal numbers is divided.
Quaternion attitude(const Mat3& R) {
  require_rotation(R);
  const double a = R(0, 0), b = R(1, 1), c = R(2, 2);
  const double x1 = R(1, 2) - R(2, 1), y1 = R(2, 0) - R(0, 2), z1 = R(0, 1) - R(1, 0);
  const double yz = R(1, 2) + R(2, 1), zx = R(2, 0) + R(0, 2), xy = R(0, 1) + R(1, 0);
  const double w4 = 1.0 + a + b + c, x4 = 1.0 + a - b - c, y4 = 1.0 - a + b - c,
               z4 = 1.0 - a - b + c;
  if (w4 >= x4 && w4 >= y4 && w4 >= z4) return normalized(Quaternion{w4, x1, y1, z1});
  if (x4 >= y4 && x4 >= z4) return normalized(Quaternion{x1, x4, xy, zx});
  if (y4 >= z4) return normalized(Quaternion{y1, xy, y4, yz});
  return normalized(Quaternion{z1, zx, yz, z4});
}

RotorState rotor_state(const Body& body, const Quaternion& q, const Vec3& omega_B) {
  if (!finite(omega_B)) {
    throw DomainError("rotor_state: omega_B " + text(omega_B) + " must be finite");
  }
  const Vec3& I = body.moments();
  return {unit_quaternion(q.w, q.x, q.y, q.z), {I.x * omega_B.x, I.y * omega_B.y, I.z * omega_B.z}};
}

RotorState rotor_state_inertial(const Body& body, const Quaternion& q, const Vec3& omega_I) {
  if (!finite(omega_I)) {
    throw DomainError("rotor_state_inertial: omega_I " + text(omega_I) + " must be finite");
  }
  const Quaternion unit = unit_quaternion(q.w, q.x, q.y, q.z);
  return rotor_state(body, unit, rotate(conj(unit), omega_I));
}

template Mat3 attitude_matrix(const Quaternion&);
template Quaternion attitude(const EulerAngles&);
template EulerAngles euler_angles(const Quaternion&);

}  // namespace v0
}  // namespace polhode
