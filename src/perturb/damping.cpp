// SPDX-License-Identifier: MIT
// Damping: matrices of friction, linear damping, internal energy dissipation, and Kane's damper.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "perturb/damper_kernel.hpp"
#include "perturb/detail/friction_matrix.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/kane_damper.hpp"

namespace polhode {
inline namespace v0 {

namespace {

using detail::number_text;
using Kernel = detail::DamperKernel<double>;

constexpr double symmetry = 8.0 * std::numeric_limits<double>::epsilon();

std::string text(const Vec3& v) { return detail::tuple_text({v.x, v.y, v.z}); }

Mat3 diagonal(const Vec3& d) { return {{{d.x, 0.0, 0.0}, {0.0, d.y, 0.0}, {0.0, 0.0, d.z}}}; }

void require_positive(const char* what, double x) {
  if (!(x > 0.0) || !std::isfinite(x))
    throw DomainError(std::string("InternalDamping: ") + what + " " + number_text(x) +
                      " must be positive and finite");
}

// (1/2)(1/A + 1/B) - 1/C, C the largest moment: a small wobble falls as exp(-k G^2 t) to this
// power.
double wobble_factor(const Body& body) {
  const Vec3& I = body.moments();
  double m[] = {I.x, I.y, I.z};
  std::sort(m, m + 3);
  const double factor = 0.5 * ((m[2] - m[0]) / (m[0] * m[2]) + (m[2] - m[1]) / (m[1] * m[2]));
  if (!(factor > 0.0))
    throw DomainError("InternalDamping: moments " + text(I) +
                      " of a sphere have no wobble to damp: give a coefficient");
  return factor;
}

}  // namespace

namespace detail {

Eigen::Matrix3d dense(const Mat3& m) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out(i, j) = m(i, j);
  }
  return out;
}

Mat3 friction_matrix(const Mat3& D, const std::string& called) {
  const std::string name =
      called + " (" + text(D.row[0]) + ", " + text(D.row[1]) + ", " + text(D.row[2]) + ")";
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!std::isfinite(D(i, j))) throw DomainError(name + " must be finite");
      largest = std::max(largest, std::abs(D(i, j)));
    }
  }
  Mat3 even;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::abs(D(i, j) - D(j, i)) > symmetry * largest)
        throw DomainError(name + " must be symmetric");
      even(i, j) = 0.5 * D(i, j) + 0.5 * D(j, i);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(dense(even), Eigen::EigenvaluesOnly);
  if (!(solver.eigenvalues()(0) >= -symmetry * largest))
    throw DomainError(name + " has the eigenvalue " + number_text(solver.eigenvalues()(0)) +
                      ": damping must not drive the body, eigenvalues >= 0");
  return even;
}

}  // namespace detail

LinearDamping::LinearDamping(double d) : LinearDamping(Vec3{d, d, d}) {}

LinearDamping::LinearDamping(const Vec3& d) : D_(diagonal(d)) {
  for (const double x : {d.x, d.y, d.z}) {
    if (!(x >= 0.0) || !std::isfinite(x))
      throw DomainError("LinearDamping: coefficients " + text(d) + " must be >= 0 and finite");
  }
}

LinearDamping::LinearDamping(const Mat3& D, const Body& body)
    : D_(detail::friction_matrix(D, "LinearDamping: matrix")),
      modes_(modes_of(D_, body.moments())) {}

LinearDamping::Modes LinearDamping::modes_of(const Mat3& D, const Vec3& moments) {
  const Vec3 root{std::sqrt(moments.x), std::sqrt(moments.y), std::sqrt(moments.z)};
  Mat3 S;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) S(i, j) = D(i, j) / (root[i] * root[j]);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(detail::dense(S));
  Modes m{moments, {}, {}, {}};
  for (int k = 0; k < 3; ++k) {
    m.rate[k] = std::max(0.0, solver.eigenvalues()(k));  // below 0 by rounding alone
    for (int i = 0; i < 3; ++i) {
      m.to_g(i, k) = root[i] * solver.eigenvectors()(i, k);
      m.from_g(k, i) = solver.eigenvectors()(i, k) / root[i];
    }
  }
  return m;
}

RotorState LinearDamping::flow(const Setting& at, double h) const {
  const Vec3& g = at.s.g;
  const Vec3& I = at.body.moments();
  if (!modes_) {
    return {at.s.q,
            {g.x * std::exp(-h * D_(0, 0) / I.x), g.y * std::exp(-h * D_(1, 1) / I.y),
             g.z * std::exp(-h * D_(2, 2) / I.z)}};
  }
  const Modes& m = modes_->moments == I ? *modes_ : modes_of(D_, I);
  const Vec3 y = m.from_g * g;
  // not exp: the roundings of the two matrices would stay where nothing is damped
  const Vec3 change{y.x * std::expm1(-h * m.rate.x), y.y * std::expm1(-h * m.rate.y),
                    y.z * std::expm1(-h * m.rate.z)};
  return {at.s.q, g + m.to_g * change};
}

InternalDamping::InternalDamping(const Vec3& k_B, bool grows) : law_{k_B, grows} {
  for (const double x : {k_B.x, k_B.y, k_B.z})
    if (!(x >= 0.0) || !std::isfinite(x))
      throw DomainError("InternalDamping: coefficients " + text(k_B) + " must be >= 0 and finite");
}

InternalDamping::InternalDamping(double k) : InternalDamping(Vec3{k, k, k}) {}

InternalDamping InternalDamping::of_wobble(const Body& body, double time, double momentum) {
  require_positive("time", time);
  require_positive("momentum", momentum);
  const double k = 1.0 / (time * momentum * momentum * wobble_factor(body));
  return InternalDamping(k);
}

InternalDamping InternalDamping::of_material(const Body& body, const DampedMaterial& material) {
  const double C = std::max({body.moments().x, body.moments().y, body.moments().z});
  // at |g| = C, where w = 1: k |g|^3 is the rate of the wobble, as w^3 is
  const double k = 1.0 / (wobble_time(material, 1.0) * (C * C * C) * wobble_factor(body));
  return InternalDamping(Vec3{k, k, k}, true);
}

double wobble_time(const DampedMaterial& m, double rate) {
  require_positive("rigidity", m.rigidity);
  require_positive("quality factor", m.quality_factor);
  require_positive("density", m.density);
  require_positive("radius", m.radius);
  require_positive("shape factor", m.shape_factor);
  require_positive("rate", rate);
  return m.rigidity * m.quality_factor /
         (m.density * m.shape_factor * (m.radius * m.radius) * (rate * rate * rate));
}

KaneDamper::KaneDamper(double moment, double friction) : moment_(moment), friction_(friction) {
  if (!(moment > 0.0) || !std::isfinite(moment))
    throw DomainError("KaneDamper: moment " + number_text(moment) + " must be positive and finite");
  if (!(friction >= 0.0) || !std::isfinite(friction))
    throw DomainError("KaneDamper: friction " + number_text(friction) + " must be >= 0 and finite");
}

void KaneDamper::require_room(const Body& body) const {
  const Vec3& I = body.moments();
  double m[] = {I.x, I.y, I.z};
  std::sort(m, m + 3);
  const double room = m[0] - (m[2] - m[1]);  // I1 + I2 - I3 of the largest
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * m[2];
  if (moment_ <= room + rounding && moment_ < m[0]) return;
  throw DomainError("KaneDamper: moment " + number_text(moment_) + " in a body of moments " +
                    text(I) + " must be at most " + number_text(room) +
                    ", the sum of the two smaller ones less the largest, and less than each: what "
                    "is left must be a body");
}

Vec3 KaneDamper::rate_of_body(const Body& body, const Vec3& s) const {
  return Kernel(body, *this).rate_of_body(s);
}

Vec3 KaneDamper::acceleration(const Body& body, const Vec3& g, const Vec3& dg,
                              const Vec3& s) const {
  const Kernel kernel(body, *this);
  return kernel.acceleration(kernel.rate(g) + kernel.rate_of_body(s), dg, s);
}

double KaneDamper::energy(const Body& body, const Vec3& s) const {
  return 0.5 * moment_ * dot(s, s + rate_of_body(body, s));
}

Vec3 KaneDamper::momentum(const Body& body, const Vec3& g, const Vec3& s) const {
  const Kernel kernel(body, *this);
  return moment_ * (kernel.rate(g) + kernel.rate_of_body(s) + s);
}

// h = J (I^-1 g + (1 - J/I) s)
Vec3 KaneDamper::relative_rate(const Body& body, const Vec3& g, const Vec3& momentum) const {
  const Kernel kernel(body, *this);
  return kernel.lagged((1.0 / moment_) * momentum - kernel.rate(g));
}

}  // namespace v0
}  // namespace polhode
