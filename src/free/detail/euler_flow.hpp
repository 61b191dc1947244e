// SPDX-License-Identifier: MIT
// Euler's flow g0 -> g(t) and its precession angle as smooth functions of g0, for dual numbers.
//
// The addition theorems of sn, cn, dn and Pi turn the solution into rational functions of g0 and of
// S = sn(nt)/n, C = cn(nt), D = dn(nt), which depend on g0 only through mu = n^2 and nu = k^2 n^2.
// Nothing here is singular: not at principal-axis spin (no phase u0 appears), not on the separatrix
// (no K), not for axisymmetric bodies or the sphere. docs/design/0003-transition-matrix.md
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "polhode/elliptic/agm.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// S' = C D, C' = -mu S D, D' = -nu S C, w' = epsilon S^2 / (1 + epsilon S^2), angle = weight w.
template <Real T>
struct FlowParameters {
  T mu, nu, delta;    // delta = mu - nu, known without subtraction
  T epsilon, weight;  // the third-kind integral that the precession needs
};

template <Real T>
struct FlowFunctions {
  T S, C, D, angle;
};

inline constexpr std::size_t flow_order = 18;
template <Real T>
using FlowSeries = std::array<T, flow_order + 1>;

template <Real T>
T convolution(const FlowSeries<T>& a, const FlowSeries<T>& b, std::size_t k) {
  T s = a[0] * b[k];
  for (std::size_t i = 1; i <= k; ++i) s = s + a[i] * b[k - i];  // <= 18 trips
  return s;
}

// Taylor series of the four functions; |h| sqrt(max(mu, nu)) <= 1/64, so order 18 is beyond 1e-36.
template <Real T>
FlowFunctions<T> flow_by_series(const FlowParameters<T>& p, const T& h) {
  FlowSeries<T> S{}, C{}, D{}, w{}, f{}, w_dot{};
  C[0] = D[0] = T(1.0);
  for (std::size_t k = 0; k < flow_order; ++k) {
    f[k] = p.epsilon * convolution(S, S, k);
    w_dot[k] = f[k] - convolution(w_dot, f, k);  // (1 + f) w' = f, and w_dot[k] is still 0
    const T next = T(1.0) / T(static_cast<double>(k + 1));
    S[k + 1] = next * convolution(C, D, k);
    C[k + 1] = -(next * (p.mu * convolution(S, D, k)));
    D[k + 1] = -(next * (p.nu * convolution(S, C, k)));
    w[k + 1] = next * (p.weight * w_dot[k]);
  }
  FlowFunctions<T> v{S[flow_order], C[flow_order], D[flow_order], w[flow_order]};
  for (std::size_t k = flow_order; k-- > 0;) {
    v.S = v.S * h + S[k];
    v.C = v.C * h + C[k];
    v.D = v.D * h + D[k];
    v.angle = v.angle * h + w[k];
  }
  return v;
}

// From h to 2h. The denominators 1 - mu nu S^4 and the numerators are written as sums that do not
// cancel next to the separatrix.
template <Real T>
FlowFunctions<T> doubled(const FlowParameters<T>& p, const FlowFunctions<T>& v) {
  using std::atan2;
  const T S2 = v.S * v.S, C2 = v.C * v.C, D2 = v.D * v.D;
  const T inverse = T(1.0) / (C2 + p.mu * S2 * D2);
  FlowFunctions<T> r;
  r.S = T(2.0) * (v.S * (v.C * v.D)) * inverse;
  // C^2/N and S^2/N first: each is of order one where C^2 and D^2 underflow, on the separatrix.
  const T along = (C2 * inverse) * D2, apart = p.delta * (S2 * inverse);
  r.C = along - apart;
  r.D = along + apart;
  const T eS2 = p.epsilon * S2;
  r.angle = T(2.0) * v.angle +
            atan2(p.weight * (eS2 * r.S), T(1.0) + p.epsilon * (r.S * r.S) - eS2 * (r.C * r.D));
  return r;
}

template <Real T>
FlowFunctions<T> flow_functions(const FlowParameters<T>& p, const T& t) {
  using std::abs;
  using std::sqrt;
  const double rate = std::sqrt(std::max(to_double(p.mu), to_double(p.nu)));
  int halvings = 0;
  double step = std::abs(to_double(t)) * rate;
  for (; step > 1.0 / 64.0 && halvings < 1100; step *= 0.5) ++halvings;
  FlowFunctions<T> v = flow_by_series(p, t * T(std::ldexp(1.0, -halvings)));
  for (int i = 0; i < halvings; ++i) v = doubled(p, v);  // <= log2(64 rate t) trips
  return v;
}

// 4K/n and the angle over that period, both smooth in the parameters away from delta = 0.
template <Real T>
struct FlowPeriod {
  T time, angle;
};

template <Real T>
FlowPeriod<T> flow_period(const FlowParameters<T>& p) {
  using std::sqrt;
  const bool short_axis = to_double(p.delta) > 0.0;
  const T& larger = short_axis ? p.mu : p.nu;
  const T& smaller = short_axis ? p.nu : p.mu;
  const auto modulus = BasicModulus<T>::from_ratio(smaller, T(short_axis ? p.delta : T(-p.delta)));
  const T root = sqrt(larger);
  const T ratio = p.epsilon / larger;
  const T quarter_w = cel(T(sqrt(modulus.m1())), T(T(1.0) + ratio), T(0.0), ratio) / root;
  return {T(4.0) * complete_k(modulus) / root, T(4.0) * p.weight * quarter_w};
}

// Where the momentum goes, and by which angle the node of body axis `pole` precesses about it.
template <Real T>
struct EulerFlow {
  BasicVec3<T> g;
  T precession;
  int pole;  // 0 or 2: the axis of least or greatest moment, whichever stays away from g
};

// Moments sorted; t may be any time, D2 is G^2 - 2 T I2 as a function of g0.
template <Real T, class S>
EulerFlow<T> euler_flow(const BasicVec3<S>& moments, const BasicVec3<T>& g0, const T& D2,
                        const S& time) {
  using std::atan2;
  using std::sqrt;
  const S I1 = moments.x, I2 = moments.y, I3 = moments.z, zero(0.0), one(1.0);
  const S I21 = I2 - I1, I31 = I3 - I1, I32 = I3 - I2;
  const S beta = to_double(I31) > 0.0 ? S(I21 / I31) : zero;  // any value serves the sphere
  const T g1 = g0.x, g2 = g0.y, g3 = g0.z, g22 = g2 * g2;
  const T a1 = g1 * g1 + (I1 / I2 * (one - beta)) * g22;  // squared amplitudes of g1, g3 at g2 = 0
  const T a3 = g3 * g3 + (I3 / I2 * beta) * g22;
  const T G = sqrt(a1 + a3);
  const S product = I1 * I2 * I3;

  EulerFlow<T> r;
  r.pole = to_double(a1) <= to_double(a3) ? 0 : 2;
  const S I_pole = r.pole == 0 ? I3 : I1;  // the pole's node turns with the other extreme moment
  const S far =
      r.pole == 0 ? S(I32 * I31 / (I3 * I3 * I1 * I2)) : S(I21 * I31 / (I1 * I1 * I2 * I3));
  FlowParameters<T> p;
  p.mu = (I32 * I31 / (I3 * product)) * a3;
  p.nu = (I21 * I31 / (I1 * product)) * a1;
  p.delta = (I31 / product) * D2;
  p.epsilon = far * (r.pole == 0 ? a1 : a3);
  p.weight = (r.pole == 0 ? S(one / I3 - one / I1) : S(one / I1 - one / I3)) * G;

  T t(time);
  T angle(zero);
  if (to_double(p.delta) != 0.0) {
    const FlowPeriod<T> period = flow_period(p);
    const double count = std::rint(to_double(time) / to_double(period.time));
    if (count != 0.0) {
      t = t - period.time * S(count);
      angle = period.angle * S(count);
    }
  }
  const FlowFunctions<T> v = flow_functions(p, t);
  const T SS = v.S * v.S;
  // sn^2 and the like of the sum u0 + nt: 1 - k^2 sn^2 sn^2 = C^2 + mu (g3/a3)^2 S^2.
  const T inverse = one / (v.C * v.C + (I32 * I31 / (I3 * product)) * (g3 * g3 * SS));
  r.g.x = (g1 * v.C + (one / I3 - one / I2) * (g2 * g3 * v.S * v.D)) * inverse;
  r.g.y = (g2 * v.C * v.D + (one / I1 - one / I3) * (g1 * g3 * v.S)) * inverse;
  r.g.z = (g3 * v.D + (one / I2 - one / I1) * (g1 * g2 * v.S * v.C)) * inverse;

  const S slope = r.pole == 0 ? S(one / I3 - one / I2) : S(one / I1 - one / I2);
  const T& across = r.pole == 0 ? r.g.z : r.g.x;
  const T g2S = slope * (g2 * v.S);
  const T cosine_sign = r.pole == 0 ? T(one) : T(-one);
  r.precession = G * T(time) * (one / I_pole) - angle - v.angle -
                 atan2(G * (g2S * r.g.y),
                       across * across + r.g.y * r.g.y + cosine_sign * (g2S * (r.g.x * r.g.z)));
  return r;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
