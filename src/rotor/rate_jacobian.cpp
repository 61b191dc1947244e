// SPDX-License-Identifier: MIT
#include "polhode/rotor/rate_jacobian.hpp"

#include <cmath>

namespace polhode {
inline namespace v0 {
namespace {

Mat3 diagonal(const Vec3& d) { return {{{d.x, 0.0, 0.0}, {0.0, d.y, 0.0}, {0.0, 0.0, d.z}}}; }

Mat3 inertia(const Body& body) { return diagonal(body.moments()); }

Mat3 inverse_inertia(const Body& body) {
  const Vec3& I = body.moments();
  return diagonal({1.0 / I.x, 1.0 / I.y, 1.0 / I.z});
}

Matrix6 lower_triangular(const Mat3& upper_left, const Mat3& lower_left, const Mat3& lower_right) {
  Matrix6 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m(i, j) = upper_left(i, j);
      m(i + 3, j) = lower_left(i, j);
      m(i + 3, j + 3) = lower_right(i, j);
    }
  }
  return m;
}

Mat3 columns(const Vec3& a, const Vec3& b, const Vec3& c) { return transpose(Mat3{{a, b, c}}); }

Mat3 negated(const Mat3& m) { return {{-m.row[0], -m.row[1], -m.row[2]}}; }

// omega_B = E (phid, thetad, psid), and C = d omega_B / d(phi, theta, psi).
struct EulerKinematics {
  Mat3 E;
  Mat3 inverse_E;
  Mat3 C;
};

EulerKinematics kinematics(const EulerRates& e) {
  const double s = std::sin(e.theta), c = std::cos(e.theta);
  const double sp = std::sin(e.psi), cp = std::cos(e.psi);
  const Vec3 m{sp, cp, 0.0}, n{cp, -sp, 0.0}, b3{0.0, 0.0, 1.0};
  const Vec3 d_theta = e.phi_dot * (c * m - s * b3);
  const Vec3 d_psi = (e.phi_dot * s) * n - e.theta_dot * m;
  return {columns(s * m + c * b3, n, b3),
          {{(1.0 / s) * m, n, b3 - (c / s) * m}},
          columns({}, d_theta, d_psi)};
}

}  // namespace

Matrix6 chart_jacobian(const Body& body, const EulerRates& s) {
  const EulerKinematics k = kinematics(s);
  return lower_triangular(k.E, inertia(body) * k.C, inertia(body) * k.E);
}

Matrix6 inverse_chart_jacobian(const Body& body, const EulerRates& s) {
  const EulerKinematics k = kinematics(s);
  return lower_triangular(k.inverse_E, negated(k.inverse_E * (k.C * k.inverse_E)),
                          k.inverse_E * inverse_inertia(body));
}

Matrix6 body_rate_jacobian(const Body& body) {
  return lower_triangular(Mat3::identity(), {}, inertia(body));
}

Matrix6 inverse_body_rate_jacobian(const Body& body) {
  return lower_triangular(Mat3::identity(), {}, inverse_inertia(body));
}

// d omega_B = A^T d omega_I + omega_B x dtheta_B
Matrix6 inertial_rate_jacobian(const Body& body, const RotorState& s) {
  return lower_triangular(Mat3::identity(), inertia(body) * hat(angular_velocity(body, s)),
                          inertia(body) * attitude_matrix(s.q));
}

Matrix6 inverse_inertial_rate_jacobian(const Body& body, const RotorState& s) {
  const Mat3 A = transpose(attitude_matrix(s.q));
  return lower_triangular(Mat3::identity(), negated(A * hat(angular_velocity(body, s))),
                          A * inverse_inertia(body));
}

}  // namespace v0
}  // namespace polhode
