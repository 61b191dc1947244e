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
#include <concepts>
#include <cstddef>

#include "polhode/elliptic/agm.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/error_free.hpp"
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
  T whole = T(0.0);  // the angle of the half periods that were taken off the time
};

template <Real T, std::size_t terms>
T convolution(const std::array<T, terms>& a, const std::array<T, terms>& b, std::size_t k) {
  T s = a[0] * b[k];
  for (std::size_t i = 1; i <= k; ++i) s = s + a[i] * b[k - i];  // <= 8 trips
  return s;
}

// Taylor series of the four functions: S and angle are odd, C and D even; the powers of h are
// inside the coefficients.
template <std::size_t terms, Real T, class H>
FlowFunctions<T> flow_by_series(const FlowParameters<T>& p, const H& h) {
  std::array<T, terms> S{}, C{}, D{}, f{}, w_dot{};
  C[0] = D[0] = T(1.0);
  const H h2 = h * h;
  const T mu = p.mu * h2, nu = p.nu * h2, epsilon = p.epsilon * h2;
  for (std::size_t k = 0; k < terms; ++k) {
    const double odd = 2.0 * static_cast<double>(k) + 1.0;
    S[k] = convolution(C, D, k) * H(H(1.0) / H(odd));
    if (k + 1 == terms) break;
    const H next = H(1.0) / H(odd + 1.0);
    C[k + 1] = -(mu * (convolution(S, D, k) * next));
    D[k + 1] = -(nu * (convolution(S, C, k) * next));
    f[k + 1] = epsilon * convolution(S, S, k);
    w_dot[k + 1] = f[k + 1] - convolution(w_dot, f, k + 1);  // (1 + f) w' = f, w_dot[k + 1] = 0
  }
  FlowFunctions<T> v{S[terms - 1], C[terms - 1], D[terms - 1], T(0.0)};
  for (std::size_t k = terms - 1; k-- > 0;) {
    v.S = v.S + S[k];
    v.C = v.C + C[k];
    v.D = v.D + D[k];
    v.angle = v.angle + w_dot[k + 1] * H(H(1.0) / H(2.0 * static_cast<double>(k) + 3.0));
  }
  v.S = v.S * h;
  v.angle = p.weight * (v.angle * h);
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

// The series converges as (2 h rate / pi)^(2 terms): to 1e-36 and 1e-17 of its sum.
template <Real T, class H>
FlowFunctions<T> flow_functions(const FlowParameters<T>& p, const H& t) {
  constexpr bool wide = RealTraits<T>::epsilon() < 1e-20;
  constexpr double longest = wide ? 1.0 / 64.0 : 1.0 / 8.0;
  const double rate = std::sqrt(std::max(to_double(p.mu), to_double(p.nu)));
  int halvings = 0;
  double step = std::abs(to_double(t)) * rate;
  for (; step > longest && halvings < 1100; step *= 0.5) ++halvings;
  const H h = t * H(std::ldexp(1.0, -halvings));
  FlowFunctions<T> v;
  if constexpr (wide) {
    v = flow_by_series<9>(p, h);
  } else {
    v = step < 1.0 / 32.0 ? flow_by_series<5>(p, h) : flow_by_series<8>(p, h);
  }
  for (int i = 0; i < halvings; ++i) v = doubled(p, v);  // <= log2(64 rate t) trips
  return v;
}

// 2K/n and the angle over that half of a period, both smooth in the parameters away from delta = 0.
template <Real T>
struct FlowHalfPeriod {
  T time, angle;
};

template <Real T>
FlowHalfPeriod<T> flow_half_period(const FlowParameters<T>& p) {
  using std::sqrt;
  const bool short_axis = to_double(p.delta) > 0.0;
  const T& larger = short_axis ? p.mu : p.nu;
  const T& smaller = short_axis ? p.nu : p.mu;
  const auto modulus = BasicModulus<T>::from_ratio(smaller, T(short_axis ? p.delta : T(-p.delta)));
  const T root = sqrt(larger);
  const T ratio = p.epsilon / larger;
  const T quarter_w = cel(T(sqrt(modulus.m1())), T(T(1.0) + ratio), T(0.0), ratio) / root;
  return {T(2.0) * complete_k(modulus) / root, T(2.0) * p.weight * quarter_w};
}

// At any time: whole half periods are taken off first. Next to the separatrix an arc beyond a
// quarter of the period grows by what the rest takes away again, with the digits.
template <Real T, class S>
FlowFunctions<T> flow_over(const FlowParameters<T>& p, const S& time) {
  const double rate = std::sqrt(std::max(to_double(p.mu), to_double(p.nu)));
  // A quarter of the period is at least pi / (2 rate).
  if (to_double(p.delta) == 0.0 || !(std::abs(to_double(time)) * rate > 1.5))
    return flow_functions(p, time);
  const FlowHalfPeriod<T> half = flow_half_period(p);
  const double count = std::rint(to_double(time) / to_double(half.time));
  if (count == 0.0) return flow_functions(p, time);
  FlowFunctions<T> v = flow_functions(p, T(T(time) - half.time * S(count)));
  v.whole = half.angle * S(count);
  if (std::fmod(count, 2.0) != 0.0) {  // sn, and of cn and dn the one that has zeros
    T& swinging = to_double(p.delta) > 0.0 ? v.C : v.D;
    v.S = -v.S;
    swinging = -swinging;
  }
  return v;
}

// Quotients of the moments, which must be in ascending order.
template <Real S>
struct FlowBody {
  explicit FlowBody(const BasicVec3<S>& moments) {
    const S I1 = moments.x, I2 = moments.y, I3 = moments.z, one(1.0), zero(0.0);
    const S I21 = I2 - I1, I31 = I3 - I1, I32 = I3 - I2, product = I1 * I2 * I3;
    const S beta = to_double(I31) > 0.0 ? S(I21 / I31) : zero;  // any value serves the sphere
    I = moments;
    inverse = {one / I1, one / I2, one / I3};
    share1 = I1 / I2 * (one - beta);
    share3 = I3 / I2 * beta;
    mu_a3 = I32 * I31 / (I3 * product);
    nu_a1 = I21 * I31 / (I1 * product);
    delta_D2 = I31 / product;
    k23 = I32 / (I2 * I3);  // not 1/I2 - 1/I3: cancels
    k13 = I31 / (I1 * I3);
    k12 = I21 / (I1 * I2);
  }
  BasicVec3<S> I, inverse;
  S share1, share3;  // a1 = g1^2 + share1 g2^2, a3 = g3^2 + share3 g2^2 are constant
  S mu_a3, nu_a1;    // mu / a3, nu / a1
  S delta_D2;        // delta / (G^2 - 2 T I2)
  S k23, k13, k12;   // 1/I2 - 1/I3 and so on, >= 0
};

// Where the momentum goes, and by which angle the node of body axis `pole` precesses about it:
// turn less the argument of (node_cos, node_sin).
template <Real T>
struct EulerFlow {
  BasicVec3<T> g;
  BasicVec3<T> change;  // g(t) - g0, with its own digits
  T G;
  T turn, node_cos, node_sin;
  int pole;  // 0 or 2: the axis of least or greatest moment, whichever stays away from g
};

// The precession at the rate of the pole's partner, G t / I.
template <Real T, class S>
T steady_turn(const T& G, const S& time, const S& moment, const S& inverse) {
  if constexpr (std::same_as<S, double>) {
    // Rounded once per arc the quotient t / I would leave a phase that grows with every arc.
    const TwoTerms<double> p = two_prod(time, inverse), unit = two_prod(moment, inverse);
    return G * p.hi + G * (p.lo - p.hi * ((unit.hi - 1.0) + unit.lo));
  } else {
    return G * T(time) * inverse;
  }
}

// t may be any time, D2 is G^2 - 2 T I2 as a function of g0.
template <Real T, class S>
EulerFlow<T> euler_flow(const FlowBody<S>& body, const BasicVec3<T>& g0, const T& D2,
                        const S& time) {
  using std::sqrt;
  const S one(1.0);
  const T g1 = g0.x, g2 = g0.y, g3 = g0.z, g22 = g2 * g2, g33 = g3 * g3;
  const T a1 = g1 * g1 + body.share1 * g22;  // squared amplitudes of g1, g3 at g2 = 0
  const T a3 = g33 + body.share3 * g22;

  EulerFlow<T> r;
  r.G = sqrt(a1 + a3);
  r.pole = to_double(a1) <= to_double(a3) ? 0 : 2;
  FlowParameters<T> p;
  p.mu = body.mu_a3 * a3;
  p.nu = body.nu_a1 * a1;
  p.delta = body.delta_D2 * D2;
  p.epsilon = r.pole == 0 ? T(body.mu_a3 * a1) : T(body.nu_a1 * a3);
  p.weight = (r.pole == 0 ? S(-body.k13) : body.k13) * r.G;

  const FlowFunctions<T> v = flow_over(p, time);
  const T SS = v.S * v.S;
  // sn^2 and the like of the sum u0 + nt: 1 - k^2 sn^2 sn^2 = C^2 + mu (g3/a3)^2 S^2.
  const T n3 = body.mu_a3 * (g33 * SS);
  const T inverse = one / (v.C * v.C + n3);
  const T g2S = g2 * v.S;
  if (to_double(v.C * v.C + n3) < 0x1p-20) {
    // A long arc next to the separatrix: the sum below would leave C D of 1 - 1.
    r.g.x = (g1 * v.C - body.k23 * (g3 * g2S * v.D)) * inverse;
    r.g.y = (g2 * (v.C * v.D) + body.k13 * (g1 * g3 * v.S)) * inverse;
    r.g.z = (g3 * v.D - body.k12 * (g1 * g2S * v.C)) * inverse;
    r.change = r.g - g0;
  } else {
    // 1 - C, 1 - D and D - C; not by subtraction on short arcs: cancels
    const bool near = to_double(v.C) > 0.0 && to_double(v.D) > 0.0;
    const T c1 = near ? T(p.mu * SS / (one + v.C)) : T(one - v.C);
    const T d1 = near ? T(p.nu * SS / (one + v.D)) : T(one - v.D);
    const T dc = near ? T(p.delta * SS / (v.C + v.D)) : T(v.D - v.C);
    r.change.x = (g1 * (v.C * c1 - n3) - body.k23 * (g3 * g2S * v.D)) * inverse;
    r.change.y = (g2 * (v.C * dc - n3) + body.k13 * (g1 * g3 * v.S)) * inverse;
    r.change.z =
        (g3 * (body.mu_a3 * ((body.share3 * g22) * SS) - d1) - body.k12 * (g1 * g2S * v.C)) *
        inverse;
    r.g = g0 + r.change;
  }

  const T& across = r.pole == 0 ? r.g.z : r.g.x;
  const T slope = (r.pole == 0 ? S(-body.k23) : body.k12) * g2S;
  // The pole's node turns with the other extreme moment.
  const int partner = 2 - r.pole;
  r.turn = steady_turn(r.G, time, body.I[partner], body.inverse[partner]) - v.whole - v.angle;
  const T sway = slope * (r.g.x * r.g.z);
  r.node_cos = across * across + r.g.y * r.g.y + (r.pole == 0 ? sway : T(-sway));
  r.node_sin = r.G * (slope * r.g.y);
  return r;
}

template <Real T>
T precession(const EulerFlow<T>& flow) {
  using std::atan2;
  return flow.turn - atan2(flow.node_sin, flow.node_cos);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
