// SPDX-License-Identifier: MIT
#include "polhode/rotor/body.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

// By how many roundings eps of the largest moment I3 may exceed I1 + I2.
constexpr double flat_slack = 4.0;
// By what part of the largest moment a tensor may exceed it. A plate that was moved by the parallel
// axis theorem and back has lost (distance / size)^2 eps: 1e-10 when a plate of 1 m went 1 km.
// Digits of a file that were rounded, 1e-6 and more, are still rejected.
constexpr double tensor_slack = 1e-9;

int largest(const Vec3& m) { return m.x < m.y ? (m.y < m.z ? 2 : 1) : (m.x < m.z ? 2 : 0); }

// Imax - (Imid + Imin) in units of eps Imax; the subtraction comes first, so nothing
// overflows.
double excess(const Vec3& m) {
  const int i = largest(m);
  const double a = m[(i + 1) % 3], b = m[(i + 2) % 3];
  return ((m[i] - std::max(a, b)) - std::min(a, b)) / m[i] / rounding;
}

void require_moments(const std::string& function, const Vec3& m) {
  const std::string what = function + ": moments " + detail::tuple_text({m.x, m.y, m.z});
  for (const double x : {m.x, m.y, m.z}) {
    if (!(x > 0.0) || !std::isfinite(x)) throw DomainError(what + " must be positive and finite");
  }
  if (excess(m) > flat_slack) {
    const int i = largest(m);
    const auto name = [](int axis) { return "I" + std::to_string(axis + 1); };
    const int a = std::min((i + 1) % 3, (i + 2) % 3), b = std::max((i + 1) % 3, (i + 2) % 3);
    throw DomainError(what + " break " + name(i) + " <= " + name(a) + " + " + name(b));
  }
}

void require_symmetric(const Mat3& t) {
  double size = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!std::isfinite(t(i, j))) {
        throw DomainError("Body::from_tensor: entry " + detail::number_text(t(i, j)) +
                          " must be finite");
      }
      size = std::max(size, std::abs(t(i, j)));
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) {
      if (std::abs(t(i, j) - t(j, i)) > 8.0 * rounding * size) {
        const std::string place = std::to_string(j + 1) + std::to_string(i + 1);
        throw DomainError("Body::from_tensor: entries " + detail::tuple_text({t(j, i), t(i, j)}) +
                          " at " + place + " and its mirror must be equal");
      }
    }
  }
}

// The largest moment of a tensor, which rounding has made larger than those of any body, becomes
// that of a flat one.
Vec3 possible(Vec3 m) {
  const double over = excess(m);
  const int i = largest(m);
  if (over > 0.0 && over * rounding <= tensor_slack) m[i] = m[(i + 1) % 3] + m[(i + 2) % 3];
  return m;
}

// The principal axes as columns, in the order and with the signs of the proper rotation that is
// closest to the identity: largest trace.
struct PrincipalAxes {
  Vec3 moments;
  Mat3 columns;
};

PrincipalAxes nearest_to_identity(const Eigen::Vector3d& values, const Eigen::Matrix3d& vectors) {
  std::array<int, 3> order{0, 1, 2}, best_order = order;
  std::array<double, 3> best_sign{1.0, 1.0, 1.0};
  double best = -4.0;
  do {  // 6 orders of 4 proper sign patterns
    Eigen::Matrix3d v;
    for (int j = 0; j < 3; ++j) v.col(j) = vectors.col(order[static_cast<std::size_t>(j)]);
    const double handed = v.determinant() < 0.0 ? -1.0 : 1.0;
    for (int pattern = 0; pattern < 4; ++pattern) {
      const double s0 = (pattern & 1) != 0 ? -1.0 : 1.0, s1 = (pattern & 2) != 0 ? -1.0 : 1.0;
      const std::array<double, 3> sign{s0, s1, handed * s0 * s1};
      const double trace = sign[0] * v(0, 0) + sign[1] * v(1, 1) + sign[2] * v(2, 2);
      if (trace > best) {
        best = trace;
        best_order = order;
        best_sign = sign;
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
  PrincipalAxes axes{};
  for (int j = 0; j < 3; ++j) {
    const int from = best_order[static_cast<std::size_t>(j)];
    axes.moments[j] = values(from);
    for (int i = 0; i < 3; ++i) {
      axes.columns(i, j) = best_sign[static_cast<std::size_t>(j)] * vectors(i, from);
    }
  }
  return axes;
}

}  // namespace

Body::Body(double I1, double I2, double I3) : Body(Vec3{I1, I2, I3}, Quaternion{}) {
  require_moments("Body", moments_);
}

Body Body::from_tensor(const Mat3& t) {
  require_symmetric(t);
  if (t(0, 1) == 0.0 && t(0, 2) == 0.0 && t(1, 2) == 0.0 && t(1, 0) == 0.0 && t(2, 0) == 0.0 &&
      t(2, 1) == 0.0) {
    const Vec3 given{t(0, 0), t(1, 1), t(2, 2)};
    const Vec3 moments = excess(given) > flat_slack ? possible(given) : given;
    require_moments("Body::from_tensor", moments);
    return Body(moments, Quaternion{});
  }
  Eigen::Matrix3d tensor;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) tensor(i, j) = 0.5 * t(i, j) + 0.5 * t(j, i);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor);
  const PrincipalAxes axes = nearest_to_identity(solver.eigenvalues(), solver.eigenvectors());
  const Vec3 moments = possible(axes.moments);
  require_moments("Body::from_tensor", moments);
  return Body(moments, attitude(transpose(axes.columns)));
}

Body Body::with_axes(const Vec3& moments, const Quaternion& q_FB) {
  require_moments("Body::with_axes", moments);
  return Body(moments, unit_quaternion(q_FB.w, q_FB.x, q_FB.y, q_FB.z));
}

Vec3 angular_velocity(const Body& body, const RotorState& s) {
  const Vec3& I = body.moments();
  return {s.g.x / I.x, s.g.y / I.y, s.g.z / I.z};
}

Vec3 inertial_angular_velocity(const Body& body, const RotorState& s) {
  return rotate(normalized(s.q), angular_velocity(body, s));
}

double kinetic_energy(const Body& body, const RotorState& s) {
  return 0.5 * dot(s.g, angular_velocity(body, s));
}

}  // namespace v0
}  // namespace polhode
