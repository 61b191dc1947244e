// SPDX-License-Identifier: MIT
// With g, I the momentum and the moments in principal axes B at t0, and p(t; g, I) the rotation
// from B at t0 to B at t: q_IB(t) = q_IB(t0) p(t). Six derivatives, of p and g(t) by g and I, come
// from dual numbers; those by the tensor in axes F follow from them and from how principal moments
// and axes change with a symmetric matrix, dI_k = v_k . dT v_k and axes turning by phi,
// phi_1 = (v_3 . dT v_2) / (I_2 - I_3) and so on.
#include "fit/free_motion.hpp"

#include <cmath>

#include "free/evaluate.hpp"
#include "free/prepare.hpp"
#include "polhode/error.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/rotor/body.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {
namespace {

using D = Dual<double, 6>;
constexpr std::size_t by_moments = 3;  // of the six: g first
// How far beside a degenerate form its derivatives are taken.
constexpr double aside = 1e-8;

struct PrincipalState {
  Vec3 moments;
  Vec3 g;
  Mat3 R;  // v_F = R v_B; columns are the principal axes
};

PrincipalState principal_state(const SpinState& s) {
  const Mat3& T = s.inertia_F;
  const double unit = T(2, 2);
  const bool is_diagonal = T(0, 1) == 0.0 && T(1, 2) == 0.0 && T(0, 2) == 0.0;
  const Vec3 L = (1.0 / unit) * (T * s.w_F);
  if (is_diagonal) {
    const Vec3 moments{T(0, 0) / unit, T(1, 1) / unit, 1.0};
    return {Body(moments.x, moments.y, moments.z).moments(), L, Mat3::identity()};
  }
  Mat3 scaled = T;
  for (Vec3& row : scaled.row) row = (1.0 / unit) * row;
  const Body body = Body::from_tensor(scaled);
  const Mat3 R = rotation_matrix(normalized(body.q_FB()));
  return {body.moments(), transpose(R) * L, R};
}

// Beside a degenerate form: moments apart, and the triangle inequality kept.
void step_aside(PrincipalState& b) {
  int largest = 0, least = 0;
  for (int i = 1; i < 3; ++i) {
    if (b.moments[i] > b.moments[largest]) largest = i;
    if (b.moments[i] <= b.moments[least]) least = i;
  }
  b.moments[largest] *= 1.0 - 2.0 * aside;
  b.moments[3 - largest - least] *= 1.0 - aside;
  b.g = b.g + aside * norm(b.g) * Vec3{0.6, -0.64, 0.48};
}

BasicFreeKernel<D> dual_kernel(const PrincipalState& b, double t0) {
  const BasicVec3<D> moments{D::variable(b.moments.x, 3), D::variable(b.moments.y, 4),
                             D::variable(b.moments.z, 5)};
  const BasicRotorState<D> s0{
      {D(1.0), D(0.0), D(0.0), D(0.0)},
      {D::variable(b.g.x, 0), D::variable(b.g.y, 1), D::variable(b.g.z, 2)}};
  return prepare<D>(moments, s0, D(t0));
}

// What one parameter changes at t0, in axes B.
struct Change {
  Vec3 attitude;
  std::array<double, 6> of;  // g, I
  Vec3 axes;                 // phi
};

std::array<Change, spin_parameters> changes(const SpinState& s, const PrincipalState& b,
                                            bool products) {
  const Mat3 Rt = transpose(b.R);
  std::array<Change, spin_parameters> found{};
  const Mat3& T = s.inertia_F;
  for (int k = 0; k < 3; ++k) {
    Vec3 e;
    e[k] = 1.0;
    found[static_cast<std::size_t>(k)].attitude = Rt * e;
    const Vec3 dg = Rt * ((1.0 / T(2, 2)) * (T * e));
    Change& c = found[first_rate + static_cast<std::size_t>(k)];
    for (int i = 0; i < 3; ++i) c.of[static_cast<std::size_t>(i)] = dg[i];
  }
  constexpr int places[5][2] = {{0, 0}, {1, 1}, {0, 1}, {1, 2}, {0, 2}};
  const bool is_turned = !(b.R == Mat3::identity());
  for (std::size_t j = 0; j < (products ? 5u : 2u); ++j) {
    Mat3 dT;
    dT(places[j][0], places[j][1]) = dT(places[j][1], places[j][0]) = 1.0;
    const Mat3 M = Rt * (dT * b.R);
    Change& c = found[first_ratio + j];
    if (is_turned || j >= 2) {
      for (int i = 0; i < 3; ++i) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        c.axes[i] = M(l, k) / (b.moments[k] - b.moments[l]);
      }
    }
    c.attitude = c.axes;
    const Vec3 dg = Rt * (dT * s.w_F) - cross(c.axes, b.g);
    for (int i = 0; i < 3; ++i) {
      c.of[static_cast<std::size_t>(i)] = dg[i];
      c.of[by_moments + static_cast<std::size_t>(i)] = M(i, i);
    }
  }
  return found;
}

// The rotation vector in body axes of dq, per variable: 2 (q* dq), and the change of w_B.
struct Columns {
  std::array<Vec3, 6> turn, rate;
  Mat3 P;  // v_B(t0) = P v_B(t)
};

bool columns_at(const BasicRotorState<D>& s, const BasicVec3<D>& moments, Columns& c) {
  const Quaternion q{s.q.w.value, s.q.x.value, s.q.y.value, s.q.z.value};
  const BasicVec3<D> w{s.g.x / moments.x, s.g.y / moments.y, s.g.z / moments.z};
  bool is_finite = true;
  for (std::size_t i = 0; i < 6; ++i) {
    const Quaternion dq{s.q.w.derivative[i], s.q.x.derivative[i], s.q.y.derivative[i],
                        s.q.z.derivative[i]};
    const Quaternion r = conj(q) * dq;
    c.turn[i] = {2.0 * r.x, 2.0 * r.y, 2.0 * r.z};
    c.rate[i] = {w.x.derivative[i], w.y.derivative[i], w.z.derivative[i]};
    for (int k = 0; k < 3; ++k) {
      is_finite = is_finite && std::isfinite(c.turn[i][k]) && std::isfinite(c.rate[i][k]);
    }
  }
  c.P = rotation_matrix(q);
  return is_finite;
}

bool add_derivatives(const SpinState& s, const PrincipalState& exact, const PrincipalState& b,
                     const std::vector<double>& times, bool products,
                     std::vector<MotionPoint>& points) {
  const BasicFreeKernel<D> kernel = dual_kernel(b, s.t0);
  const BasicVec3<D> moments{D::variable(b.moments.x, 3), D::variable(b.moments.y, 4),
                             D::variable(b.moments.z, 5)};
  const std::array<Change, spin_parameters> change = changes(s, exact, products);
  Columns c;
  for (std::size_t n = 0; n < times.size(); ++n) {
    if (!columns_at(evaluate(kernel, D(times[n])), moments, c)) return false;
    const Mat3 Pt = transpose(c.P), Rt = transpose(exact.R);
    const Vec3 w_B = Rt * points[n].w_F;
    for (std::size_t j = 0; j < spin_parameters; ++j) {
      Vec3 turn = Pt * change[j].attitude, rate;
      for (std::size_t i = 0; i < 6; ++i) {
        turn = turn + change[j].of[i] * c.turn[i];
        rate = rate + change[j].of[i] * c.rate[i];
      }
      points[n].turn[j] = exact.R * (turn - change[j].axes);
      points[n].rate[j] = exact.R * (rate + cross(change[j].axes, w_B));
    }
  }
  return true;
}

}  // namespace

FreeRotation free_rotation_of(const SpinState& s) {
  const double unit = s.inertia_F(2, 2);
  Mat3 T = s.inertia_F;
  for (Vec3& row : T.row) row = (1.0 / unit) * row;
  const bool is_diagonal = T(0, 1) == 0.0 && T(1, 2) == 0.0 && T(0, 2) == 0.0;
  const Body body = is_diagonal ? Body(T(0, 0), T(1, 1), 1.0) : Body::from_tensor(T);
  const Quaternion f = is_diagonal ? Quaternion{} : body.q_FB();
  return FreeRotation(body, {normalized(s.q) * f, rotate(conj(f), T * s.w_F)}, s.t0);
}

SpinState spin_at(const SpinState& s, double t) {
  if (s.t0 == t) return s;
  const FreeRotation motion = free_rotation_of(s);
  const Quaternion& f = motion.body().q_FB();
  const RotorState there = motion.at(t);
  return {t, there.q * conj(f), rotate(f, angular_velocity(motion.body(), there)), s.inertia_F};
}

bool free_motion(const SpinState& s, const std::vector<double>& times, Asked asked,
                 std::vector<MotionPoint>& points) {
  points.resize(times.size());
  try {
    PrincipalState b = principal_state(s);
    const FreeKernel kernel =
        prepare(Body(b.moments.x, b.moments.y, b.moments.z), RotorState{{}, b.g}, s.t0);
    const Quaternion q0 = normalized(s.q);
    // v_F = q_FB v_B; the rotation of p seen in axes F: q_FB p q_FB*.
    for (std::size_t n = 0; n < times.size(); ++n) {
      const RotorState at = evaluate(kernel, times[n]);
      const Vec3 turned = b.R * Vec3{at.q.x, at.q.y, at.q.z};
      points[n].q = normalized(q0 * Quaternion{at.q.w, turned.x, turned.y, turned.z});
      points[n].w_F = b.R * Vec3{at.g.x / b.moments.x, at.g.y / b.moments.y, at.g.z / b.moments.z};
    }
    if (!asked.derivatives) return true;
    const PrincipalState exact = b;
    if (add_derivatives(s, exact, b, times, asked.products, points)) return true;
    step_aside(b);
    return add_derivatives(s, exact, b, times, asked.products, points);
  } catch (const DomainError&) {
    return false;  // a trial step to a tensor or a rate that no body has
  }
}

// Rates and periods of the kernel are those of the motion but for factors that do not change: the
// period of the polhode is one or two of the phase's, and P_1 the inverse of twice Lambda.
RateDerivatives rate_derivatives(const SpinState& s) {
  const PrincipalState b = principal_state(s);
  const BasicFreeKernel<D> kernel = dual_kernel(b, s.t0);
  const D precession = kernel.half_precession.hi, rate = kernel.phase_rate.hi,
          period = kernel.phase_period.hi;
  const std::array<Change, spin_parameters> change = changes(s, b, true);
  RateDerivatives found{};
  for (std::size_t j = 0; j < spin_parameters; ++j)
    for (std::size_t i = 0; i < 6; ++i) {
      const double by = change[j].of[i];
      if (by == 0.0) continue;
      found.precession[j] += by * precession.derivative[i] / precession.value;
      found.period[j] +=
          by * (period.derivative[i] / period.value - rate.derivative[i] / rate.value);
    }
  return found;
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
