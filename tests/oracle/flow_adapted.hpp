// SPDX-License-Identifier: MIT
// The derivatives of the state by Serret's and by Sadov's variables, without their formulas: what
// tests allow the sets that follow the free motion rests on it.
//
// Equations   Axes by moment, the middle one reversed where that makes them right-handed. At
//             Serret's t0 the momentum is in the plane of the axes 1 and 3,
//                 g1^2 = I1 (2 T I3 - G^2)/(I3 - I1), g2 = 0,
//                 g3^2 = I3 (G^2 - 2 T I1)/(I3 - I1),
//             and q = qz(h) qx(I) qz(g0) qx(J) qz(+-pi/2). Its derivatives by G and T are carried
//             to t by the variational equations theta' = theta x w + I^-1 dg, dg' = dg x w +
//             g x I^-1 dg; the others are rotations about g, about the axis h is counted about and
//             about the node, and the flow itself. Sadov's variables of the same motion have
//                 phi_l = n_l (t - t0), phi_g = g0 + n_g (t - t0), dT = n_l dI_l + n_g dI_g,
//             with n_l = +-2 pi / P, I_l = (1 / 2 pi) int L dl over a period, and T of degree 2 in
//             (I_l, I_g), so that the slope of P by T alone gives all derivatives of n_l, n_g.
// Accuracy    some 1e-9 of the largest entry of a column, less next to the separatrix: Taylor
//             series of order 18 in long double.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "oracle/wide_real.hpp"
#include "polhode/math/vector.hpp"

namespace oracle {

class FlowAdapted {
 public:
  // By the momentum along the body axes and the vertical of space there.
  FlowAdapted(const polhode::Vec3& moments, const polhode::RotorState& s);

  bool long_axis() const { return long_axis_; }
  double period() const { return static_cast<double>(period_); }
  double momentum() const { return static_cast<double>(G_); }
  double vertical_momentum() const { return static_cast<double>(H_); }
  double twice_energy() const { return static_cast<double>(2 * T_); }
  double action() const { return static_cast<double>(I_l_); }  // I_l, with its sign
  double sine_of_tilt() const { return static_cast<double>(sine_I_); }
  // sqrt(1 - (I_l / G)^2), from what is left where they are near: short-axis mode only
  double sine_of_action() const;

  // Columns (g0, h, -t0; G, H, T) and (phi_l, phi_g, phi_h; I_l, I_g, I_h) at `elapsed` after t0.
  polhode::Matrix6 by_serret(double elapsed) const;
  polhode::Matrix6 by_sadov(double elapsed) const {
    return in_body_axes(sadov_columns(carried(elapsed), elapsed, false));
  }
  // |by_sadov| and what its sums have lost where they cancel, next to the axes.
  polhode::Matrix6 size_by_sadov(double elapsed) const;
  // |g(elapsed) - g| / G: is that when the state given is met?
  double miss(double elapsed) const;

 private:
  using Real = long double;
  using Triple = std::array<Real, 3>;
  struct Column {
    Triple theta{}, g{};
  };
  using Columns = std::array<Column, 6>;
  struct Carried {
    Triple g;
    Column by_G, by_T;
  };
  static constexpr std::size_t order = 18;
  using Coefficients = std::array<Real, order + 1>;

  static Triple cross(const Triple& a, const Triple& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Real norm(const Triple& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
  Triple sorted(const polhode::Vec3& v) const;
  Triple rate(const Triple& g) const { return {g[0] / I_[0], g[1] / I_[1], g[2] / I_[2]}; }
  Wide period_of(const Wide& G, const Wide& T) const;
  void set_base();
  void set_action();
  Carried stepped(const Carried& at, Real h) const;
  Carried carried(Real elapsed) const;
  Columns serret_columns(const Carried& at) const;
  Columns sadov_columns(const Carried& at, Real elapsed, bool sizes) const;
  polhode::Matrix6 in_body_axes(const Columns& columns) const;

  std::array<int, 3> axis_{0, 1, 2};
  Real middle_ = 1;
  Triple I_{}, g_{}, vertical_{}, node_{};
  Wide wide_I_[3], wide_G_, wide_T_;
  bool long_axis_ = false;
  int sense_ = 1;  // of g3 in short-axis mode, of g1 in long-axis mode
  Real G_ = 0, H_ = 0, T_ = 0, sine_I_ = 0, period_ = 0, slope_ = 0, I_l_ = 0;
  Carried base_{};
};

inline FlowAdapted::Triple FlowAdapted::sorted(const polhode::Vec3& v) const {
  return {v[axis_[0]], middle_ * v[axis_[1]], v[axis_[2]]};
}

inline FlowAdapted::FlowAdapted(const polhode::Vec3& moments, const polhode::RotorState& s) {
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
    if (moments[axis_[static_cast<std::size_t>(j)]] < moments[axis_[static_cast<std::size_t>(i)]]) {
      std::swap(axis_[static_cast<std::size_t>(i)], axis_[static_cast<std::size_t>(j)]);
      middle_ = -middle_;
    }
  }
  const WideVec3 g = widened(s.g);
  Wide twice_T = 0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    wide_I_[i] = moments[axis_[k]];
    I_[k] = moments[axis_[k]];
    twice_T += g[axis_[k]] * g[axis_[k]] / wide_I_[i];
  }
  wide_G_ = sqrt(dot(g, g));
  wide_T_ = twice_T / 2;
  G_ = static_cast<Real>(wide_G_);
  T_ = static_cast<Real>(wide_T_);
  g_ = sorted(s.g);
  long_axis_ = wide_G_ * wide_G_ < twice_T * wide_I_[1];
  sense_ = g_[long_axis_ ? 0 : 2] < 0 ? -1 : 1;
  // the third row of the matrix of q: the vertical of space along the body axes
  const WideQuaternion q = polhode::normalized(widened(s.q));
  const polhode::Vec3 up{static_cast<double>(Wide(2 * (q.x * q.z - q.w * q.y))),
                         static_cast<double>(Wide(2 * (q.y * q.z + q.w * q.x))),
                         static_cast<double>(Wide(1 - 2 * (q.x * q.x + q.y * q.y)))};
  vertical_ = sorted(up);
  H_ = vertical_[0] * g_[0] + vertical_[1] * g_[1] + vertical_[2] * g_[2];
  const Triple node = cross(vertical_, g_);
  sine_I_ = norm(node) / G_;
  for (std::size_t i = 0; i < 3; ++i) node_[i] = node[i] / (sine_I_ * G_);
  period_ = static_cast<Real>(period_of(wide_G_, wide_T_));
  const Wide d = Wide(1e-25) * abs(Wide(wide_G_ * wide_G_ / (2 * wide_I_[1]) - wide_T_));
  slope_ = static_cast<Real>(
      Wide((period_of(wide_G_, wide_T_ + d) - period_of(wide_G_, wide_T_ - d)) / (2 * d)));
  set_base();
  set_action();
}

// 4 K / n by the arithmetic-geometric mean (Landau and Lifshitz, Mechanics, section 37).
inline Wide FlowAdapted::period_of(const Wide& G, const Wide& T) const {
  const auto& I = wide_I_;
  const Wide G2 = G * G, low = G2 - 2 * T * I[0], high = 2 * T * I[2] - G2;
  const Wide product = I[0] * I[1] * I[2];
  const Wide n2 = (long_axis_ ? (I[1] - I[0]) * high : (I[2] - I[1]) * low) / product;
  const Wide k2 = long_axis_ ? (I[2] - I[1]) * low / ((I[1] - I[0]) * high)
                             : (I[1] - I[0]) * high / ((I[2] - I[1]) * low);
  Wide a = 1, b = sqrt(1 - k2);
  for (int i = 0; i < 12; ++i) {
    const Wide mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return 2 * acos(Wide(-1)) / (a * sqrt(n2));
}

// The state at t0 and its derivatives by G and T, but for the turn of the plane of the momentum.
inline void FlowAdapted::set_base() {
  const auto& I = wide_I_;
  const Wide spread = I[2] - I[0], G2 = wide_G_ * wide_G_;
  const Real s1 = long_axis_ ? sense_ : 1, s3 = long_axis_ ? 1 : sense_;
  const Real g1 = s1 * static_cast<Real>(sqrt(Wide(I[0] * (2 * wide_T_ * I[2] - G2) / spread)));
  const Real g3 = s3 * static_cast<Real>(sqrt(Wide(I[2] * (G2 - 2 * wide_T_ * I[0]) / spread)));
  const Real by_T = I_[0] * I_[2] / (I_[2] - I_[0]), by_G = G_ / (I_[2] - I_[0]);
  base_.g = {g1, 0, g3};
  base_.by_T.g = {by_T / g1, 0, -by_T / g3};
  base_.by_G.g = {-I_[0] * by_G / g1, 0, I_[2] * by_G / g3};
  // cos J = g3 / G and the body axis of dJ is (cos l, -sin l, 0), l = +-pi/2
  const Real sine_J = std::abs(g1) / G_;
  const auto turn = [&](Real dg3, Real dG) {
    const Real dJ = -(dg3 - g3 / G_ * dG) / (G_ * sine_J);
    return Triple{0, g1 > 0 ? -dJ : dJ, 0};
  };
  base_.by_T.theta = turn(base_.by_T.g[2], 0);
  base_.by_G.theta = turn(base_.by_G.g[2], 1);
}

// The trapezoidal rule over half a period, after which L dl repeats.
inline void FlowAdapted::set_action() {
  constexpr int pieces = 256;
  const Real h = period_ / 2 / pieces;
  Carried at = base_;
  Real sum = 0;
  for (int i = 0; i < pieces; ++i) {
    const Triple& g = at.g;
    const Triple rates = cross(g, rate(g));
    sum += g[2] * (rates[0] * g[1] - g[0] * rates[1]) / (g[0] * g[0] + g[1] * g[1]);
    at = stepped(at, h);
  }
  const Real size = std::abs(sum * h) / std::acos(Real(-1));
  I_l_ = long_axis_ ? size : sense_ * size;
}

inline double FlowAdapted::sine_of_action() const {
  const Real left = (G_ - std::abs(I_l_)) * (G_ + std::abs(I_l_));
  return left > 0 ? static_cast<double>(std::sqrt(left) / G_) : 0.0;
}

// One Taylor step of g and of the two columns.
inline FlowAdapted::Carried FlowAdapted::stepped(const Carried& at, Real h) const {
  struct Expansion {
    std::array<Coefficients, 3> c{};
  };
  // c of (a x b)_k
  const auto crossed = [](const Expansion& a, const Expansion& b, std::size_t k) {
    Triple sum{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto j = (i + 1) % 3, l = (i + 2) % 3;
      for (std::size_t m = 0; m <= k; ++m)
        sum[i] += a.c[j][m] * b.c[l][k - m] - a.c[l][m] * b.c[j][k - m];
    }
    return sum;
  };
  Expansion g, w;
  std::array<Expansion, 2> theta, dg, dw;
  const std::array<const Column*, 2> from{&at.by_G, &at.by_T};
  const auto put = [&](Expansion& s, std::size_t k, const Triple& v, Real factor) {
    for (std::size_t i = 0; i < 3; ++i) s.c[i][k] = factor * v[i];
  };
  put(g, 0, at.g, 1);
  for (std::size_t n = 0; n < 2; ++n) {
    put(theta[n], 0, from[n]->theta, 1);
    put(dg[n], 0, from[n]->g, 1);
  }
  for (std::size_t k = 0; k < order; ++k) {
    const Real over = Real(1) / static_cast<Real>(k + 1);
    for (std::size_t i = 0; i < 3; ++i) {
      w.c[i][k] = g.c[i][k] / I_[i];
      for (std::size_t n = 0; n < 2; ++n) dw[n].c[i][k] = dg[n].c[i][k] / I_[i];
    }
    put(g, k + 1, crossed(g, w, k), over);
    for (std::size_t n = 0; n < 2; ++n) {
      Triple turn = crossed(theta[n], w, k), change = crossed(dg[n], w, k);
      const Triple more = crossed(g, dw[n], k);
      for (std::size_t i = 0; i < 3; ++i) {
        turn[i] += dw[n].c[i][k];
        change[i] += more[i];
      }
      put(theta[n], k + 1, turn, over);
      put(dg[n], k + 1, change, over);
    }
  }
  const auto sum = [&](const Expansion& s) {
    Triple v{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = order + 1; k-- > 0;) v[i] = v[i] * h + s.c[i][k];
    return v;
  };
  return {sum(g), {sum(theta[0]), sum(dg[0])}, {sum(theta[1]), sum(dg[1])}};
}

inline FlowAdapted::Carried FlowAdapted::carried(Real elapsed) const {
  const Real whole = std::ceil(8 * std::abs(elapsed) * G_ / I_[0]) + 1;  // steps of 1/8 rad
  Carried at = base_;
  for (Real i = 0; i < whole; i += 1) at = stepped(at, elapsed / whole);
  return at;
}

inline double FlowAdapted::miss(double elapsed) const {
  const Triple g = carried(elapsed).g;
  return static_cast<double>(norm({g[0] - g_[0], g[1] - g_[1], g[2] - g_[2]}) / G_);
}

inline FlowAdapted::Columns FlowAdapted::serret_columns(const Carried& at) const {
  Columns c;
  const Real by_H = -1 / (G_ * sine_I_), by_G = H_ / (G_ * G_ * sine_I_);  // of I, cos I = H / G
  const Triple w = rate(g_);
  for (std::size_t i = 0; i < 3; ++i) {
    c[0].theta[i] = g_[i] / G_;
    c[1].theta[i] = vertical_[i];
    c[2].theta[i] = w[i];
    c[3].theta[i] = at.by_G.theta[i] + by_G * node_[i];
    c[4].theta[i] = by_H * node_[i];
    c[5].theta[i] = at.by_T.theta[i];
  }
  c[2].g = cross(g_, w);
  c[3].g = at.by_G.g;
  c[5].g = at.by_T.g;
  return c;
}

inline polhode::Matrix6 FlowAdapted::in_body_axes(const Columns& columns) const {
  polhode::Matrix6 m;
  for (int j = 0; j < 6; ++j) {
    const Column& c = columns[static_cast<std::size_t>(j)];
    for (std::size_t i = 0; i < 3; ++i) {
      const Real sign = i == 1 ? middle_ : Real(1);
      m(axis_[i], j) = static_cast<double>(sign * c.theta[i]);
      m(3 + axis_[i], j) = static_cast<double>(sign * c.g[i]);
    }
  }
  return m;
}

inline polhode::Matrix6 FlowAdapted::by_serret(double elapsed) const {
  return in_body_axes(serret_columns(carried(elapsed)));
}

inline polhode::Matrix6 FlowAdapted::size_by_sadov(double elapsed) const {
  const Carried at = carried(elapsed);
  polhode::Matrix6 m = in_body_axes(sadov_columns(at, elapsed, false));
  const polhode::Matrix6 terms = in_body_axes(sadov_columns(at, elapsed, true));
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) m(i, j) = std::abs(m(i, j)) + 0x1p-60 * std::abs(terms(i, j));
  return m;
}

// With `sizes` the moduli of all terms, added up.
inline FlowAdapted::Columns FlowAdapted::sadov_columns(const Carried& at, Real t,
                                                       bool sizes) const {
  const Columns s = serret_columns(at);
  const Real turn = 2 * std::acos(Real(-1));
  const Real n_l = (!long_axis_ && sense_ < 0 ? turn : -turn) / period_;
  const Real n_g = (2 * T_ - I_l_ * n_l) / G_;
  // second derivatives of T: n_l is of degree 1
  const Real n_ll = -n_l / period_ * slope_ * n_l, n_lg = (n_l - I_l_ * n_ll) / G_;
  const Real n_gg = (n_g - I_l_ * n_lg) / G_;
  Columns c;
  const auto term = [sizes](Real x) { return sizes ? std::abs(x) : x; };
  const auto add = [&term](Column& to, Real factor, const Column& from) {
    for (std::size_t i = 0; i < 3; ++i) {
      to.theta[i] += term(factor * from.theta[i]);
      to.g[i] += term(factor * from.g[i]);
    }
  };
  const auto by = [&](Column& to, Real time, Real node, Real energy) {
    add(to, time, s[2]);
    add(to, node, s[0]);
    add(to, energy, s[5]);
  };
  by(c[0], 1 / n_l, -n_g / n_l, 0);
  by(c[1], 0, 1, 0);
  add(c[2], 1, s[1]);
  // t = phi_l / n_l, g0 = phi_g - n_g t
  const Real t_l = -t / n_l * n_ll, t_g = -t / n_l * n_lg;
  by(c[3], t_l, -n_lg * t - n_g * t_l, n_l);
  by(c[4], t_g, -n_gg * t - n_g * t_g, n_g);
  add(c[4], 1, s[3]);
  add(c[5], 1, s[4]);
  return c;
}

}  // namespace oracle
