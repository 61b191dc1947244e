// SPDX-License-Identifier: MIT
// The constants of one polhode: which regime, which elliptic modulus, which amplitudes [SA
// (A15)-(A35)].
//
// Everything is a product, or a sum of products of one sign, except D2, which is formed in
// double-double: nothing here cancels. "Primed" axes put the axis that the momentum circulates
// about third (b3 in short-axis mode, b1 in long-axis mode), so that one set of formulas serves
// both.
#pragma once

#include <cmath>

#include "polhode/elliptic/agm.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// D1 = G^2 - 2 T I1 >= 0, D2 = G^2 - 2 T I2, D3 = 2 T I3 - G^2 >= 0, for I1 <= I2 <= I3.
template <Real T>
struct Discriminants {
  T D1, D2, D3;
};

// D2 over a common denominator: exact zeros (moments (3, 4, 6), g1 = g3) come out as zeros.
template <Real S, Real T>
T separatrix_discriminant(const BasicVec3<S>& I, const T& g1_squared, const T& g3_squared) {
  return (g3_squared * ((I.z - I.y) * I.x) - g1_squared * ((I.y - I.x) * I.z)) / (I.x * I.z);
}

// As sums of signed squares; moments and momentum in sorted axes.
inline Discriminants<DoubleDouble> discriminants(const Vec3& moments, const Vec3& g) {
  using DD = DoubleDouble;
  const DD I1 = moments.x, I2 = moments.y, I3 = moments.z;
  const DD g1 = DD::product(g.x, g.x), g2 = DD::product(g.y, g.y), g3 = DD::product(g.z, g.z);
  const DD I21 = I2 - I1, I31 = I3 - I1, I32 = I3 - I2;
  return {g2 * I21 / I2 + g3 * I31 / I3, separatrix_discriminant(BasicVec3<DD>{I1, I2, I3}, g1, g3),
          g1 * I31 / I1 + g2 * I32 / I2};
}

template <Real T>
struct PolhodeCurve {
  bool long_axis = false;   // primed axes are (b3, -b2, b1) of the sorted ones; else (b1, b2, b3)
  bool steady = false;      // omega parallel to g, or K' and u meaningless: only A, B, C, G are set
  bool separatrix = false;  // kp2 = 0: K is infinite and not set
  T A, B, C;                // moments about the primed axes
  T G;                      // |g|
  T DA, DC;                 // D of axis A and of axis C, both >= 0
  T a1, a2, a3;             // amplitudes: g' = (a1 cn u, a2 sn u, a3 dn u)  [SA (A24)]
  T n;                      // du/dt, negative in long-axis mode  [SA (A35)]
  T k2, kp2;                // modulus squared and its complement
  T kap2, r2;  // kappa^2 and lambda^2 / kappa^2 (primed), k2 = kap2 r2  [SA "SadovPar"]
  T K, Kp;     // complete integrals of k and k'; Kp is not set when k2 = 0
};

// Moments sorted. on_middle_axis: g is along b2, where u is infinite.
template <Real T>
PolhodeCurve<T> polhode_curve(const BasicVec3<T>& I, const T& G, const Discriminants<T>& D,
                              bool on_middle_axis) {
  using std::abs;
  using std::sqrt;
  PolhodeCurve<T> c{};
  c.G = G;
  c.long_axis = D.D2 < T(0.0);
  c.A = c.long_axis ? I.z : I.x;
  c.B = I.y;
  c.C = c.long_axis ? I.x : I.z;
  c.DA = c.long_axis ? D.D3 : D.D1;
  c.DC = c.long_axis ? D.D1 : D.D3;
  const T CA = abs(c.C - c.A), CB = abs(c.C - c.B), BA = abs(c.B - c.A);
  // Below 2^-900 a discriminant (scaled, G^2 in [1, 12)) is that of a momentum within 1e-135 of an
  // axis: calling it zero errs by less than that, and no quotient below can overflow.
  if (!(c.DC > T(0x1p-900))) c.DC = T(0.0);
  c.steady = !(CB > T(0.0)) || !(c.DA > T(0x1p-900)) || on_middle_axis;
  if (c.steady) return c;
  const T scale = CB * c.DA;
  c.a1 = sqrt(c.A * c.DC / CA);
  c.a2 = sqrt(c.B * c.DC / CB);
  c.a3 = sqrt(c.C * c.DA / CA);
  // Of a needle n^2 is like 1/C^2, which soon is beyond double-double.
  c.n = c.C < T(0x1p-200) ? T(sqrt(scale / (c.A * c.B)) / sqrt(c.C))
                          : T(sqrt(scale / (c.A * c.B * c.C)));
  if (c.long_axis) c.n = -c.n;
  c.k2 = BA * c.DC / scale;
  c.kp2 = CA * abs(D.D2) / scale;
  c.kap2 = c.C * BA / (c.A * CB);
  c.r2 = c.A * c.DC / (c.C * c.DA);
  c.separatrix = !(c.kp2 > T(0.0));
  const BasicModulus<T> modulus = BasicModulus<T>::from_ratio(c.k2, c.kp2);
  if (!c.separatrix) c.K = complete_k(modulus);
  if (c.k2 > T(0.0)) c.Kp = complete_k(modulus.complement());
  return c;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
