// SPDX-License-Identifier: MIT
#include "polhode/perturb/linear_damping.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>

#include "math/number_text.hpp"
#include "perturb/detail/friction_matrix.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

Mat3 diagonal(const Vec3& d) { return {{{d.x, 0.0, 0.0}, {0.0, d.y, 0.0}, {0.0, 0.0, d.z}}}; }

std::string text(const Vec3& v) { return detail::tuple_text({v.x, v.y, v.z}); }

}  // namespace

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

}  // namespace v0
}  // namespace polhode
