// SPDX-License-Identifier: MIT
// The constants of one polhode: which regime, which elliptic modulus, which amplitudes.
//
// Everything is a product, or a sum of products of one sign, except D2, which is formed exactly:
// nothing here cancels. "Primed" axes put the axis that the momentum circulates about third (b3 in
// short-axis mode, b1 in long-axis mode), so that one set of formulas serves both.
#pragma once

#include <cmath>

#include "polhode/elliptic/agm.hpp"
#include "polhode/free/detail/separatrix_distance.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// D1 = G^2 - 2 T I1 >= 0, D2 2^D2_exponent = G^2 - 2 T I2, D3 = 2 T I3 - G^2 >= 0, for I1 <= I2 <=
// I3.
template <Real T>
struct Discriminants {
  T D1, D2, D3;
  int D2_exponent = 0;
};

// x^2 of a number whose value is a double: no digit is lost.
inline DoubleDouble exact_square(const DoubleDouble& x) {
  return DoubleDouble::product(x.hi, x.hi);
}
template <Real T, int N>
Dual<T, N> exact_square(const Dual<T, N>& x) {
  return x.chained(exact_square(x.value), T(2.0) * x.value);
}

// As sums of signed squares; moments and momentum in sorted axes, the largest of each in [1, 2),
// and their values are doubles.
template <Real T>
Discriminants<T> discriminants(const BasicVec3<T>& I, const BasicVec3<T>& g) {
  using std::abs;
  const T g1 = exact_square(g.x), g2 = exact_square(g.y), g3 = exact_square(g.z);
  const T I21 = I.y - I.x, I31 = I.z - I.x, I32 = I.z - I.y;
  const T tiny(0x1p-450);  // a needle makes a square that double-double loses large again
  return {g2 * I21 / I.y + g3 * I31 / I.z, separatrix_discriminant(I, g1, g3),
          (abs(g.x) < tiny ? T(I31 / I.x * g.x * g.x) : T(g1 * I31 / I.x)) + g2 * I32 / I.y};
}

template <Real T>
struct PolhodeCurve {
  bool long_axis = false;   // primed axes are (b3, -b2, b1) of the sorted ones; else (b1, b2, b3)
  bool steady = false;      // omega parallel to g, or K' and u meaningless: only A, B, C, G are set
  bool separatrix = false;  // D2 = 0: K is infinite and not set
  bool merging = false;     // kp2 < 2^-200: k is 1 to the last digit of any sum, kp2 may underflow
  int kp2_exponent = 0;     // merging: kp2 = kp2_mantissa 2^kp2_exponent
  T A, B, C;                // moments about the primed axes
  T G;                      // |g|
  T DA, DC;                 // D of axis A and of axis C, both >= 0
  T a1, a2, a3;             // amplitudes: g' = (a1 cn u, a2 sn u, a3 dn u)  [SA (A24)]
  T n;                      // du/dt, negative in long-axis mode  [SA (A35)]
  T k2, kp2;                // modulus squared and its complement
  T kap2;                   // kappa^2 (primed); k2 = kap2 r2  [SA "SadovPar"]
  T r2;                     // lambda^2 / kappa^2 = (a1/a3)^2; may be infinite for a needle
  T K, Kp;                  // complete integrals of k and k'; Kp is not set when k2 = 0
  T kp2_mantissa = T(0.0);
};

// The momentum is so nearly across the axis of circulation that r2 has no room for sums.
template <Real T>
bool is_across(const PolhodeCurve<T>& c) {
  return !(to_double(c.r2) < 0x1p800);
}

// Below this exponent of kp2 what K leaves of kp2 itself, kp2 K / 4, is far below the last digit.
inline constexpr int merging_exponent = -200;

// K = ln(4/k')  [DLMF 19.12.1], with the exponent of k'^2 apart.
template <Real T>
T merging_k(const T& kp2_mantissa, int kp2_exponent) {
  using std::log;
  const T two_log2 = T(2.0) * log(T(2.0));
  return T(0.5) * (two_log2 * T(2.0 - 0.5 * kp2_exponent) - log(kp2_mantissa));
}

// sqrt(x y / z) of a moment, a discriminant and a difference of moments; of a needle x y may be
// below double-double.
template <Real T>
T root_of_product(const T& x, const T& y, const T& z) {
  using std::sqrt;
  const T product = x * y;
  return product > T(0x1p-900) ? T(sqrt(product / z)) : T(sqrt(x / z) * sqrt(y));
}

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
  c.a1 = root_of_product(c.A, c.DC, CA);
  c.a2 = sqrt(c.B * c.DC / CB);
  c.a3 = root_of_product(c.C, c.DA, CA);
  // Of a needle n^2 is like 1/C^2, which soon is beyond double-double.
  c.n = c.C < T(0x1p-200) ? T(sqrt(scale / (c.A * c.B)) / sqrt(c.C))
                          : T(sqrt(scale / (c.A * c.B * c.C)));
  if (c.long_axis) c.n = -c.n;
  c.k2 = BA * c.DC / scale;
  c.kp2_mantissa = CA * abs(D.D2) / scale;
  c.kp2_exponent = D.D2_exponent;
  c.kp2 = c.kp2_mantissa * T(std::ldexp(1.0, c.kp2_exponent));
  c.kap2 = c.C * BA / (c.A * CB);
  const T across = c.C * c.DA;
  c.r2 = across > T(0x1p-900) ? T(c.A * c.DC / across) : T(c.A / c.C * (c.DC / c.DA));
  c.separatrix = !(c.kp2_mantissa > T(0.0));
  c.merging =
      c.separatrix || std::ilogb(to_double(c.kp2_mantissa)) + c.kp2_exponent < merging_exponent;
  const elliptic::BasicModulus<T> modulus = elliptic::BasicModulus<T>::from_ratio(c.k2, c.kp2);
  if (!c.separatrix)
    c.K = c.merging ? merging_k(c.kp2_mantissa, c.kp2_exponent) : elliptic::complete_k(modulus);
  if (c.k2 > T(0.0)) c.Kp = elliptic::complete_k(modulus.complement());
  return c;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
