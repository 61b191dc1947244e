// SPDX-License-Identifier: MIT
// The oracle of the charts: Andoyer's, Serret's and Sadov's variables and the periods of a tumbler
// from a hub state, in a thousand digits.
//
// Equations   Legendre's forms as the paper prints them, corrected [SA (36)-(62), "IellSadov",
//             "phiSadov", Appendix A]; Carlson's integrals for F and Pi, the AGM for K.
//             The library uses theta series, Bulirsch's cel and double-double instead.
// Domain      moments in any order; momenta and transverse parts of any size that doubles have:
//             differences lose at most 900 of the digits.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <utility>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "worst.hpp"

namespace oracle {

using Long = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<1000, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;
using LongVec3 = polhode::BasicVec3<Long>;
using LongQuaternion = polhode::BasicQuaternion<Long>;

inline Long long_pi() {
  static const Long value = 4 * atan(Long(1));
  return value;
}

inline Long long_agm(Long a, Long b) {
  for (int i = 0; i < 64; ++i) {
    const Long mean = (a + b) / 2;
    if (abs(a - b) <= ldexp(mean, -1700)) return mean;
    b = sqrt(a * b);
    a = mean;
  }
  return a;
}

// Carlson's RF and RJ by duplication until the arguments agree to 1e-130, then the series of
// degree 7 [DLMF 19.36]: 1e-1000 and beyond.
inline Long long_rf(Long x, Long y, Long z) {
  Long a = (x + y + z) / 3;
  for (int i = 0; i < 4000; ++i) {
    const Long off = polhode::test::larger(Long(abs(a - x)), Long(abs(a - y)), Long(abs(a - z)));
    if (off <= ldexp(a, -420)) break;
    const Long sx = sqrt(x), sy = sqrt(y), sz = sqrt(z), lambda = sx * (sy + sz) + sy * sz;
    a = (a + lambda) / 4;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
  }
  const Long dx = (a - x) / a, dy = (a - y) / a, dz = -(dx + dy);
  const Long e2 = dx * dy - dz * dz, e3 = dx * dy * dz;
  return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44 - 5 * e2 * e2 * e2 / 208 +
          3 * e3 * e3 / 104 + e2 * e2 * e3 / 16) /
         sqrt(a);
}

// RC(1, 1 + e)
inline Long long_rc(const Long& e) {
  if (e == 0) return 1;
  const Long root = sqrt(Long(abs(e)));
  return (e < 0 ? Long(atanh(root)) : Long(atan(root))) / root;
}

inline Long long_rj(Long x, Long y, Long z, Long p) {
  Long a = (x + y + z + 2 * p) / 5, sum = 0, factor = 1;
  for (int i = 0; i < 4000; ++i) {
    const Long off = polhode::test::larger(Long(abs(a - x)), Long(abs(a - y)), Long(abs(a - z)),
                                           Long(abs(a - p)));
    if (off <= ldexp(a, -420)) break;
    const Long sx = sqrt(x), sy = sqrt(y), sz = sqrt(z), sp = sqrt(p);
    const Long lambda = sx * (sy + sz) + sy * sz;
    const Long d = (sp + sx) * (sp + sy) * (sp + sz);
    const Long e = (sp - sx) * (sp - sy) * (sp - sz) / d;
    sum += factor / d * long_rc(e);
    factor /= 4;
    a = (a + lambda) / 4;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    p = (p + lambda) / 4;
  }
  const Long dx = (a - x) / a, dy = (a - y) / a, dz = (a - z) / a, dp = -(dx + dy + dz) / 2;
  const Long e2 = dx * dy + dx * dz + dy * dz - 3 * dp * dp;
  const Long e3 = dx * dy * dz + 2 * e2 * dp + 4 * dp * dp * dp;
  const Long e4 = (2 * dx * dy * dz + e2 * dp + 3 * dp * dp * dp) * dp;
  const Long e5 = dx * dy * dz * dp * dp;
  return 6 * sum + factor / (a * sqrt(a)) *
                       (1 - 3 * e2 / 14 + e3 / 6 + 9 * e2 * e2 / 88 - 3 * e4 / 22 -
                        9 * e2 * e3 / 52 + 3 * e5 / 26);
}

// A moving motion in the axes sorted by moment: constants of the polhode and where the state is.
struct FlowCharts {
  bool moves = false;      // false: steady or at rest, the fields below T are not set
  bool long_axis = false;  // circulates the axis of the least moment
  Long G, T, H, D2;
  Long across;                // distance from the axis of circulation, of G
  Long node;                  // sin I
  Long l, g, h;               // Andoyer's angles about sorted axis 3
  Long u, n, K;               // K is 0 on the separatrix
  Long g0, elapsed;           // Serret's, u = 0 nearest in the sense of am in (-pi, pi]
  Long phi_l, phi_g, action;  // Sadov's, action as |I_l| / G; no meaning on the separatrix
  Long P_psi, P_phi;
  int sign_g1 = 1, sign_g3 = 1;
};

namespace detail {

struct SortedAxes {
  std::array<int, 3> axis{0, 1, 2};
  int middle_sign = 1;
};
// Rising moments; the middle axis is reversed where the permutation is odd.
inline SortedAxes sorted_axes(const polhode::Vec3& I) {
  SortedAxes s;
  std::stable_sort(s.axis.begin(), s.axis.end(), [&](int a, int b) { return I[a] < I[b]; });
  const auto [a, b, c] = s.axis;
  if ((b - a + 3) % 3 != 1) s.middle_sign = -1;
  static_cast<void>(c);
  return s;
}

// Legendre's F and Pi(-p) at the amplitude phi in (-pi, pi], modulus by k^2 and its complement.
struct Incomplete {
  Long F, Pi;
};
inline Incomplete incomplete(const Long& phi_sin, const Long& phi_cos, const Long& kp2,
                             const Long& p) {
  const Long s2 = phi_sin * phi_sin, c2 = phi_cos * phi_cos;
  const Long delta2 = c2 + kp2 * s2;
  const Long F = phi_sin * long_rf(c2, delta2, 1);
  const Long Pi = p == 0 ? F : F - p / 3 * phi_sin * s2 * long_rj(c2, delta2, 1, Long(1 + p * s2));
  return {F, Pi};
}
inline Long complete_pi(const Long& kp2, const Long& p) {
  const Long F = long_pi() / 2 / long_agm(1, sqrt(kp2));
  return p == 0 ? F : F - p / 3 * long_rj(0, kp2, 1, Long(1 + p));
}

}  // namespace detail

inline FlowCharts flow_charts(const polhode::Vec3& moments, const LongQuaternion& q_any,
                              const LongVec3& g_B) {
  const detail::SortedAxes order = detail::sorted_axes(moments);
  const Long I1 = moments[order.axis[0]], I2 = moments[order.axis[1]], I3 = moments[order.axis[2]];
  const LongVec3 g{g_B[order.axis[0]], order.middle_sign * g_B[order.axis[1]], g_B[order.axis[2]]};
  FlowCharts c;
  const Long G2 = g.x * g.x + g.y * g.y + g.z * g.z;
  c.G = sqrt(G2);
  const Long twice_T = g.x * g.x / I1 + g.y * g.y / I2 + g.z * g.z / I3;
  c.T = twice_T / 2;
  const LongQuaternion q = polhode::normalized(q_any);
  const LongVec3 b3_body{order.axis[2] == 0 ? 1 : 0, order.axis[2] == 1 ? 1 : 0,
                         order.axis[2] == 2 ? 1 : 0};
  const LongVec3 M = rotate(q, g_B), b3 = rotate(q, b3_body);
  c.H = M.z;
  if (c.G == 0) return c;
  c.node = sqrt(M.x * M.x + M.y * M.y) / c.G;
  c.l = atan2(g.x, g.y);
  c.h = atan2(M.x, Long(-M.y));
  const LongVec3 cr = cross(M, b3);
  c.g = atan2(Long(cr.z / c.G), Long(M.z * dot(b3, M) / G2 - b3.z));
  c.sign_g1 = g.x < 0 ? -1 : 1;
  c.sign_g3 = g.z < 0 ? -1 : 1;
  const Long D1 = g.y * g.y * (I2 - I1) / I2 + g.z * g.z * (I3 - I1) / I3;
  const Long D3 = g.x * g.x * (I3 - I1) / I1 + g.y * g.y * (I3 - I2) / I2;
  c.D2 = g.z * g.z * (I3 - I2) / I3 - g.x * g.x * (I2 - I1) / I1;
  c.long_axis = c.D2 < 0;
  c.across = c.long_axis ? sqrt(g.y * g.y + g.z * g.z) / c.G : sqrt(g.x * g.x + g.y * g.y) / c.G;
  const Long D = c.long_axis ? D3 : D1, Dc = c.long_axis ? D1 : D3;
  const Long gap = c.long_axis ? I2 - I1 : I3 - I2, other = c.long_axis ? I3 - I2 : I2 - I1;
  c.moves = D > 0 && Dc > 0 && gap > 0 && !(g.x == 0 && g.z == 0);
  if (!c.moves) return c;
  const Long k2 = other * Dc / (gap * D), kp2 = (I3 - I1) * abs(c.D2) / (gap * D);
  c.n = sqrt(gap * D / (I1 * I2 * I3));
  const Long a2 = sqrt(I2 * Dc / gap);
  const Long a_cn = c.long_axis ? sqrt(I3 * D1 / (I3 - I1)) : sqrt(I1 * D3 / (I3 - I1));
  const int s = c.long_axis ? c.sign_g1 : c.sign_g3;
  Long sine = s * g.y / a2, cosine = (c.long_axis ? g.z : g.x) / a_cn;
  const Long length = sqrt(sine * sine + cosine * cosine);
  sine /= length;
  cosine /= length;
  const Long p = c.long_axis ? Long(I3 * D1 / (I1 * D3)) : Long(I3 * (I2 - I1) / (I1 * (I3 - I2)));
  detail::Incomplete f = detail::incomplete(sine, Long(abs(cosine)), kp2, p);
  const bool separatrix = kp2 == 0;
  const Long Pic = separatrix ? Long(0) : detail::complete_pi(kp2, p);
  c.K = separatrix ? Long(0) : Long(long_pi() / 2 / long_agm(1, sqrt(kp2)));
  if (cosine < 0 && separatrix) f = {-f.F, -f.Pi};  // from the base point of this branch
  if (cosine < 0 && !separatrix) {                  // F(pi - phi) = 2K - F(phi)
    const Long side = sine < 0 ? -1 : 1;
    f = {side * 2 * c.K - f.F, side * 2 * Pic - f.Pi};
  }
  c.u = f.F;
  c.elapsed = c.u / c.n;
  const Long per_Pi = c.G / c.n * (1 / I1 - 1 / I3);
  c.g0 = c.g - c.G / I3 * c.elapsed - per_Pi * f.Pi;
  if (separatrix) return c;
  const Long x = long_pi() / 2 * c.u / c.K;
  c.phi_l = c.long_axis ? Long(-x) : Long(-s * x);
  c.phi_g = c.g - per_Pi * (f.Pi - Pic * c.u / c.K);
  const Long r = I1 * D3 / (I3 * D1);
  c.action = 2 / long_pi() * per_Pi * (Pic - r / (1 + r) * c.K);
  c.P_psi = 4 * c.K / c.n;
  // rate about the long axis: 1/I1 - (D1/I1)/(G^2 - g1^2), g1 = a1 cn or a1 dn
  const Long a1 = sqrt(I1 * D3 / (I3 - I1)), rest = D1 * I3 / (I3 - I1);  // G^2 - a1^2
  const Long weight = c.long_axis ? Long(a1 * a1 * k2) : Long(a1 * a1);
  const Long mean = detail::complete_pi(kp2, Long(weight / rest)) / c.K;
  c.P_phi = 2 * long_pi() / (c.G * (1 / I1 - D1 / I1 / rest * mean));
  return c;
}

inline LongVec3 lengthened(const polhode::Vec3& v) { return {Long(v.x), Long(v.y), Long(v.z)}; }
inline LongQuaternion lengthened(const polhode::Quaternion& q) {
  return {Long(q.w), Long(q.x), Long(q.y), Long(q.z)};
}
inline FlowCharts flow_charts(const polhode::Vec3& moments, const polhode::RotorState& s) {
  return flow_charts(moments, lengthened(s.q), lengthened(s.g));
}

}  // namespace oracle
