// SPDX-License-Identifier: MIT
// Settings of terms, and the effect of a term by differences of its energy at 76 digits.
#pragma once

#include <cmath>
#include <string>

#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "oracle/wide_real.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/effect.hpp"

namespace perturb_test {

using oracle::Draw;
using oracle::Wide;
using oracle::WideQuaternion;
using oracle::WideState;
using oracle::WideVec3;
using namespace polhode;
using polhode::test::message_of;

inline constexpr double eps = 0x1p-52;

struct Case {
  Body body;
  double t;
  RotorState s;
  Quaternion q_IS;

  template <class T>
  BasicSetting<T> on() const {
    return {body,
            T(t),
            {{T(s.q.w), T(s.q.x), T(s.q.y), T(s.q.z)}, {T(s.g.x), T(s.g.y), T(s.g.z)}},
            {T(q_IS.w), T(q_IS.x), T(q_IS.y), T(q_IS.z)}};
  }
};

inline Vec3 drawn_vector(Draw& draw) { return {draw.normal(), draw.normal(), draw.normal()}; }
inline Quaternion drawn_attitude(Draw& draw) {
  return polhode::normalized(
      Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()});
}
inline Case drawn_case(std::uint64_t seed, std::uint64_t index) {
  Draw draw(seed, index);
  const double a = draw.uniform(0.2, 1.0), b = draw.uniform(0.2, 1.0), c = draw.uniform(0.2, 1.0);
  return {Body(b + c, a + c, a + b),
          draw.uniform(-3.0, 3.0),
          {drawn_attitude(draw), drawn_vector(draw)},
          drawn_attitude(draw)};
}

// A curve that any number type can follow, and a place.
struct Curve {
  template <Real T>
  BasicVec3<T> position(const T& t) const {
    return {T(1.1) + t * t, T(0.7) - t, T(0.4) * t - T(0.3)};
  }
};
struct Still {
  Vec3 at;
  template <Real T>
  BasicVec3<T> position(const T&) const {
    return {T(at.x), T(at.y), T(at.z)};
  }
};
// What is seen along r in the space axes, along the body's.
inline WideVec3 seen_in_body(const BasicSetting<Wide>& at, const WideVec3& r) {
  return rotate(conj(normalized(at.s.q)), rotate(conj(normalized(at.q_IS)), r));
}

inline double largest(const WideVec3& v) { return static_cast<double>(sqrt(dot(v, v))); }
inline WideVec3 wide(const Vec3& v) { return oracle::widened(v); }
inline WideVec3 wide(const BasicVec3<DoubleDouble>& v) {
  const auto w = [](const DoubleDouble& x) { return Wide(x.hi) + Wide(x.lo); };
  return {w(v.x), w(v.y), w(v.z)};
}

// v = dH'/dg, u = -dH'/d(theta_B): central differences of step 1e-25.
template <class Term>
BasicEffect<Wide> effect_by_differences(const Term& term, const BasicSetting<Wide>& at) {
  const Wide h = 1e-25;
  BasicEffect<Wide> e;
  for (int i = 0; i < 3; ++i) {
    const auto energy = [&](const Wide& turn, const Wide& push) {
      WideVec3 axis, g = at.s.g;
      axis[i] = sin(turn / 2);
      g[i] += push;
      const WideQuaternion q = at.s.q * WideQuaternion{cos(turn / 2), axis.x, axis.y, axis.z};
      return term.energy(BasicSetting<Wide>{at.body, at.t, {q, g}, at.q_IS});
    };
    e.u[i] = -(energy(h, 0) - energy(-h, 0)) / (2 * h);
    e.v[i] = (energy(0, h) - energy(0, -h)) / (2 * h);
  }
  return e;
}

}  // namespace perturb_test
