// SPDX-License-Identifier: MIT
// Light of a tumbling ellipsoid in double-double, by a Taylor integration that knows no elliptic
// functions, for tests of derivatives.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/fit/light_fit.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode::test {

// dg/dt = g x w, dq/dt = q w / 2 by Taylor series, which know no elliptic functions.
struct WideMotion {
  using DD = DoubleDouble;
  BasicQuaternion<DD> q;
  BasicVec3<DD> g, I;

  void advance(const DD& t) {
    constexpr std::size_t order = 26;
    const int steps = 1 + static_cast<int>(3.0 * static_cast<double>(t));
    const DD h = t / DD(static_cast<double>(steps));
    for (int n = 0; n < steps; ++n) {
      std::vector<BasicVec3<DD>> gs{g}, ws;
      std::vector<BasicQuaternion<DD>> qs{q};
      for (std::size_t k = 0; k < order; ++k) {
        ws.push_back({gs[k].x / I.x, gs[k].y / I.y, gs[k].z / I.z});
        BasicVec3<DD> dg{DD(0.0), DD(0.0), DD(0.0)};
        BasicQuaternion<DD> dq{DD(0.0), DD(0.0), DD(0.0), DD(0.0)};
        for (std::size_t j = 0; j <= k; ++j) {
          const BasicVec3<DD>& w = ws[k - j];
          dg = dg + cross(gs[j], w);
          const auto p = qs[j] * BasicQuaternion<DD>{DD(0.0), w.x, w.y, w.z};
          dq = {dq.w + p.w, dq.x + p.x, dq.y + p.y, dq.z + p.z};
        }
        const DD part = DD(1.0) / DD(static_cast<double>(k + 1)), half = DD(0.5) * part;
        gs.push_back(part * dg);
        qs.push_back({half * dq.w, half * dq.x, half * dq.y, half * dq.z});
      }
      g = gs[order];
      q = qs[order];
      for (std::size_t k = order; k-- > 0;) {
        g = h * g + gs[k];
        q = {h * q.w + qs[k].w, h * q.x + qs[k].x, h * q.y + qs[k].y, h * q.z + qs[k].z};
      }
    }
  }
};

// Brightness at the points of one session in double-double, at x + h e_k: of attitude to second
// order in h.
inline std::vector<DoubleDouble> wide_brightness(const BrightEllipsoid& b, const LightCurve& curve,
                                                 std::size_t k, const DoubleDouble& h) {
  using DD = DoubleDouble;
  const auto off = [&](std::size_t j) { return j == k ? h : DD(0.0); };
  const Quaternion q0 = b.spin.q;
  const DD half = DD(0.5);
  BasicQuaternion<DD> q{DD(q0.w), DD(q0.x), DD(q0.y), DD(q0.z)};
  const BasicQuaternion<DD> turn{DD(1.0), half * off(0), half * off(1), half * off(2)};
  q = q * turn;
  const DD size = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  q = {q.w / size, q.x / size, q.y / size, q.z / size};
  const DD ratio = DD(b.shape.b) + off(6);
  const DD c = ratio * (DD(b.shape.c / b.shape.b) + off(7));
  const BasicEllipsoid<DD> shape{DD(1.0), ratio, c};
  const BasicVec3<DD> I = homogeneous_moments(shape, DD(1.0));
  const BasicVec3<DD> X{I.x / I.z, I.y / I.z, DD(1.0)};
  const BasicRotorState<DD> s{q,
                              {X.x * (DD(b.spin.w_F.x) + off(3)), X.y * (DD(b.spin.w_F.y) + off(4)),
                               DD(b.spin.w_F.z) + off(5)}};
  WideMotion motion{s.q, s.g, X};
  DD now(b.spin.t0);
  std::vector<DD> B;
  for (const LightPoint& p : curve.points) {
    motion.advance(DD(p.t) - now);
    now = DD(p.t);
    const auto back = conj(motion.q);
    const auto wide = [](const Vec3& v) { return BasicVec3<DD>{DD(v.x), DD(v.y), DD(v.z)}; };
    B.push_back(lommel_seeliger_brightness<DD>(shape, rotate(back, wide(p.to_sun)),
                                               rotate(back, wide(p.to_observer))));
  }
  return B;
}

}  // namespace polhode::test
