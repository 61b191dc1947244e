// SPDX-License-Identifier: MIT
// The oracle of free rotation: the exact state at any time from a Taylor integration of half a
// polhode period, with 76 digits and steps good to 1e-66. It uses no elliptic function.
//
// Equations   Euler's dg/dt = g x omega; the attitude is
//                 q(t) = L exp(e phi/2) m(g(t)),
//             e the body axis that the polhode circles, m(g) the shortest rotation that takes g/|g|
//             to e, L constant. Kinematics dq/dt = (1/2) q (0, omega) then says
//                 dphi/dt = omega . (g/G + e) / (1 + g.e/G)
//             because the shortest rotation turns about axes normal to g/G + e.
//             (tests/unit/oracle compares this with the integration of q itself.)
//             Half a period turns g by pi about e, so that any t costs one polynomial:
//                 g(N P/2 + r) = S^N g(r),  phi(N P/2 + r) = phi(r) + N phi(P/2).
// Domain      moments in any order, any g, any q but 0. On the separatrix there is no period: the
//             state is followed to within 1e-70 of the spin about the middle axis.
#pragma once

#include <array>
#include <stdexcept>
#include <vector>

#include "oracle/euler_taylor.hpp"
#include "worst.hpp"

namespace oracle {

using polhode::test::smaller;

enum class Motion { rest, steady, periodic, separatrix };

class FreeBody {
 public:
  FreeBody(const polhode::Vec3& moments, const polhode::Quaternion& q, const polhode::Vec3& g,
           const TaylorSettings& settings = {});

  // State after `elapsed`; the separatrix is integrated as far as asked.
  WideState at(const Wide& elapsed);
  // State at t when the state given holds at t0; t - t0 is exact.
  WideState at(double t, double t0) { return at(Wide(t) - Wide(t0)); }

  Motion motion() const { return motion_; }
  // The body axis (0, 1, 2) that the polhode circles, and the sign of g there.
  std::size_t pole() const { return pole_; }
  int pole_sign() const { return sign_; }
  // Time in which g turns by pi about the pole, and the growth of phi in it.
  const Wide& half_period() const { return half_period_; }
  const Wide& half_period_angle() const { return half_angle_; }
  const Wide& momentum() const { return G_; }
  const Wide& twice_energy() const { return twice_T_; }
  // G^2 - 2 T I_mid; its sign is exact.
  const Wide& d2() const { return equations_.axes().d2; }
  const EulerEquations& equations() const { return equations_; }
  const WideState& initial() const { return initial_; }
  const TaylorSettings& settings() const { return settings_; }
  std::size_t steps() const { return forward_.size() + backward_.size(); }

 private:
  struct Step {
    Wide begin, length;  // length < 0 going backward
    Series3 y;
    Series phi;
  };
  struct Reading {
    WideVec3 y;
    Wide phi;
  };

  Step expanded(const Wide& begin, const Reading& start) const;
  static Reading reading(const Step& step, const Wide& t);
  WideVec3 momentum_coefficient(const Step& step, std::size_t k) const;
  void integrate_half_period();
  Wide half_period_in(const Step& step, bool first) const;
  Wide area(const WideVec3& g) const;
  void check_half_period(const WideVec3& g) const;
  Reading periodic_reading(const Wide& elapsed) const;
  Reading separatrix_reading(const Wide& elapsed);
  WideVec3 pole_axis() const;
  WideQuaternion section(const WideVec3& g) const;
  WideQuaternion steady_attitude(const Wide& elapsed) const;

  TaylorSettings settings_;
  EulerEquations equations_;
  WideState initial_;
  WideQuaternion left_;
  Wide G_, twice_T_, half_period_ = 0, half_angle_ = 0;
  Motion motion_ = Motion::rest;
  std::size_t pole_ = 2;
  int sign_ = 1;
  std::vector<Step> forward_, backward_;
};

inline FreeBody::FreeBody(const polhode::Vec3& moments, const polhode::Quaternion& q,
                          const polhode::Vec3& g, const TaylorSettings& settings)
    : settings_(settings),
      equations_(moments, g),
      initial_{polhode::normalized(widened(q)), widened(g)},
      left_(initial_.q) {
  const auto& I = equations_.moments();
  const auto& [g1, g2, g3] = initial_.g;
  G_ = sqrt(g1 * g1 + g2 * g2 + g3 * g3);
  twice_T_ = g1 * g1 / I.x + g2 * g2 / I.y + g3 * g3 / I.z;
  if (!equations_.moves()) {
    motion_ = G_ == 0 ? Motion::rest : Motion::steady;
    return;
  }
  motion_ = d2() == 0 ? Motion::separatrix : Motion::periodic;
  pole_ = d2() < 0 ? equations_.axes().lo : equations_.axes().hi;
  sign_ = component(initial_.g, pole_) < 0 ? -1 : 1;
  left_ = initial_.q * conj(section(initial_.g));
  if (motion_ == Motion::periodic) integrate_half_period();
}

inline WideVec3 FreeBody::pole_axis() const {
  WideVec3 e;
  e[static_cast<int>(pole_)] = sign_;
  return e;
}

// The shortest rotation that takes g/G to the pole; g.e > 0, so that nothing cancels.
inline WideQuaternion FreeBody::section(const WideVec3& g) const {
  const WideVec3 e = pole_axis(), axis = cross(g, e);
  return polhode::normalized(WideQuaternion{G_ + dot(g, e), axis.x, axis.y, axis.z});
}

inline WideVec3 FreeBody::momentum_coefficient(const Step& step, std::size_t k) const {
  return equations_.momentum({step.y[0][k], step.y[1][k], step.y[2][k]});
}

// One expansion and how far forward it may be used.
inline FreeBody::Step FreeBody::expanded(const Wide& begin, const Reading& start) const {
  Step step{begin, 0, {Series{start.y.x}, Series{start.y.y}, Series{start.y.z}}, {start.phi}};
  Series numerator, denominator, rate;  // dphi/dt = (2T + s G g_p/I_p) / (G + s g_p)
  const Wide slope = sign_ * G_ / component(equations_.moments(), pole_);
  for (std::size_t k = 0; k < settings_.order; ++k) {
    const Wide pole_k = component(momentum_coefficient(step, k), pole_);
    numerator.push_back(slope * pole_k + (k == 0 ? twice_T_ : Wide(0)));
    denominator.push_back(sign_ * pole_k + (k == 0 ? G_ : Wide(0)));
    rate.push_back(0);
    rate[k] = (numerator[k] - convolution(denominator, rate, k, 1)) / denominator[0];
    step.phi.push_back(rate[k] / (k + 1));
    equations_.append_order(step.y, k);
  }
  const double length = smaller(log2_step(step.phi, settings_, 0.0), log2_step(step.y, settings_));
  step.length = pow(Wide(2), Wide(length));
  return step;
}

inline FreeBody::Reading FreeBody::reading(const Step& step, const Wide& t) {
  const Wide h = t - step.begin;
  return {polynomial(step.y, h), polynomial(step.phi, h)};
}

// g(0) x g along the pole: 0 at the start, and again when g has turned by pi about the pole.
inline Wide FreeBody::area(const WideVec3& g) const {
  const std::size_t i = (pole_ + 1) % 3, j = (pole_ + 2) % 3;
  return component(initial_.g, i) * component(g, j) - component(initial_.g, j) * component(g, i);
}

inline void FreeBody::integrate_half_period() {
  constexpr int most_steps = 10000;
  Wide begin = 0;
  Reading now{equations_.unknowns(), 0};
  for (int n = 0; n < most_steps; ++n) {
    forward_.push_back(expanded(begin, now));
    const Step& step = forward_.back();
    begin += step.length;
    now = reading(step, begin);
    const bool side = area(equations_.momentum(now.y)) > 0;
    const bool first_side = area(momentum_coefficient(forward_.front(), 1)) > 0;
    if (side != first_side) {
      half_period_ = step.begin + half_period_in(step, n == 0);
      const Reading half = reading(step, half_period_);
      half_angle_ = half.phi;
      check_half_period(equations_.momentum(half.y));
      return;
    }
  }
  throw std::runtime_error("oracle: no half period within 10000 steps");
}

// The root of area(g(t)) in one step, from its begin: bisection, then Newton.
inline Wide FreeBody::half_period_in(const Step& step, bool first) const {
  Series value, slope;
  for (std::size_t k = 0; k < step.phi.size(); ++k) {
    value.push_back(area(momentum_coefficient(step, k)));
    if (k > 0) slope.push_back(k * value[k]);
  }
  Wide left = 0, right = step.length;
  if (first) left = ldexp(right, -20);  // the start itself is not the root sought
  const bool left_side = polynomial(value, left) > 0;
  for (int i = 0; i < 12; ++i) {
    const Wide middle = (left + right) / 2;
    ((polynomial(value, middle) > 0) == left_side ? left : right) = middle;
  }
  Wide t = (left + right) / 2;
  for (int i = 0; i < 8; ++i) t -= polynomial(value, t) / polynomial(slope, t);
  if (!(t >= left && t <= right)) throw std::runtime_error("oracle: Newton left its bracket");
  return t;
}

inline void FreeBody::check_half_period(const WideVec3& g) const {
  const WideVec3& g0 = initial_.g;
  for (std::size_t i = 0; i < 3; ++i) {
    const Wide expected = i == pole_ ? component(g0, i) : -component(g0, i);
    if (!(abs(component(g, i) - expected) < Wide(1e-55) * G_))
      throw std::runtime_error("oracle: half a period does not turn g by pi about the pole");
  }
}

inline FreeBody::Reading FreeBody::periodic_reading(const Wide& elapsed) const {
  const Wide halves = floor(elapsed / half_period_);
  const Wide r = elapsed - halves * half_period_;
  auto step = std::upper_bound(forward_.begin(), forward_.end(), r,
                               [](const Wide& x, const Step& s) { return x < s.begin; });
  if (step != forward_.begin()) --step;
  const Reading now = reading(*step, r);
  WideVec3 g = equations_.momentum(now.y);
  if (fmod(halves, Wide(2)) != 0) {
    for (std::size_t i = 0; i < 3; ++i)
      if (i != pole_) g[static_cast<int>(i)] = -component(g, i);
  }
  return {g, now.phi + halves * half_angle_};
}

inline FreeBody::Reading FreeBody::separatrix_reading(const Wide& elapsed) {
  constexpr std::size_t most_steps = 10000;
  std::vector<Step>& steps = elapsed < 0 ? backward_ : forward_;
  Wide begin = 0;
  Reading now{equations_.unknowns(), 0};
  for (std::size_t n = 0; n < most_steps; ++n) {
    if (n == steps.size()) {
      steps.push_back(expanded(begin, now));
      if (elapsed < 0) steps.back().length = -steps.back().length;
    }
    const Step& step = steps[n];
    begin = step.begin + step.length;
    const bool inside = abs(elapsed) <= abs(begin);
    now = reading(step, inside ? elapsed : begin);
    if (inside) return {equations_.momentum(now.y), now.phi};
    if (abs(now.y.x) + abs(now.y.y) < Wide(1e-70) * G_)  // the spin about the middle axis
      return {equations_.momentum(now.y), now.phi + (elapsed - begin) * twice_T_ / G_};
  }
  throw std::runtime_error("oracle: separatrix not followed within 10000 steps");
}

inline WideQuaternion FreeBody::steady_attitude(const Wide& elapsed) const {
  if (motion_ == Motion::rest) return initial_.q;
  const WideVec3& I = equations_.moments();
  const WideVec3 w{initial_.g.x / I.x, initial_.g.y / I.y, initial_.g.z / I.z};
  const Wide rate = sqrt(dot(w, w)), half = rate * elapsed / 2;
  const Wide s = sin(half) / rate;
  return initial_.q * WideQuaternion{cos(half), s * w.x, s * w.y, s * w.z};
}

inline WideState FreeBody::at(const Wide& elapsed) {
  if (motion_ == Motion::rest || motion_ == Motion::steady)
    return {steady_attitude(elapsed), initial_.g};
  const Reading now =
      motion_ == Motion::separatrix ? separatrix_reading(elapsed) : periodic_reading(elapsed);
  const Wide half = now.phi / 2, s = sin(half);
  const WideVec3 e = pole_axis();
  const WideQuaternion turn{cos(half), s * e.x, s * e.y, s * e.z};
  return {left_ * turn * section(now.y), now.y};
}

}  // namespace oracle
