// SPDX-License-Identifier: MIT
// Light of a tumbling ellipsoid in double-double, by a Taylor integration that knows no elliptic
// functions, for tests of derivatives.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/fit/light_fit.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/math/double_double.hpp"
#include "wide_motion.hpp"

namespace polhode::test {

// Brightness at the points of one session in double-double, at x + h e_k: of attitude to second
// order in h.
inline std::vector<DoubleDouble> wide_brightness(const fit::LightModel& b,
                                                 const light::LightCurve& curve, std::size_t k,
                                                 const DoubleDouble& h) {
  using DD = DoubleDouble;
  const auto off = [&](std::size_t j) { return j == k ? h : DD(0.0); };
  const Quaternion q0 = b.spin.q;
  const DD half = DD(0.5);
  BasicQuaternion<DD> q{DD(q0.w), DD(q0.x), DD(q0.y), DD(q0.z)};
  const BasicQuaternion<DD> turn{DD(1.0), half * off(0), half * off(1), half * off(2)};
  q = q * turn;
  const DD size = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  q = {q.w / size, q.x / size, q.y / size, q.z / size};
  const DD ratio = DD(b.ellipsoid().b) + off(6);
  const DD c = ratio * (DD(b.ellipsoid().c / b.ellipsoid().b) + off(7));
  const light::BasicEllipsoid<DD> shape{DD(1.0), ratio, c};
  const BasicVec3<DD> I = light::homogeneous_moments(shape, DD(1.0));
  const BasicVec3<DD> X{I.x / I.z, I.y / I.z, DD(1.0)};
  const BasicRotorState<DD> s{q,
                              {X.x * (DD(b.spin.w_F.x) + off(3)), X.y * (DD(b.spin.w_F.y) + off(4)),
                               DD(b.spin.w_F.z) + off(5)}};
  WideMotion motion{s.q, s.g, X};
  DD now(b.spin.t0);
  std::vector<DD> B;
  for (const light::LightPoint& p : curve.points) {
    motion.advance(DD(p.t) - now);
    now = DD(p.t);
    const auto back = conj(motion.q);
    const auto wide = [](const Vec3& v) { return BasicVec3<DD>{DD(v.x), DD(v.y), DD(v.z)}; };
    B.push_back(light::lommel_seeliger_brightness<DD>(shape, rotate(back, wide(p.to_sun)),
                                                      rotate(back, wide(p.to_observer))));
  }
  return B;
}

}  // namespace polhode::test
