// SPDX-License-Identifier: MIT
// The textbook form of the free rotation, on a library F of elliptic functions: sn, cn, dn and an
// incomplete integral of the third kind for each state [SA (54), (1490)-(1492)]. Any mode: axes are
// renamed so that the momentum goes round the third one, on its positive side.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "contenders.hpp"

namespace peers {

template <class T>
using Four = std::array<T, 4>;

template <class T>
Four<T> product(const Four<T>& a, const Four<T>& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

// Axes renamed: v' = (z, -y, x) in long-axis mode, then (x, -y, -z) where the third is negative.
template <class T>
struct Renamed {
  T A, B, C, x, y, z;
  bool swapped, turned;

  explicit Renamed(const Start& s)
      : A(s.I[0]), B(s.I[1]), C(s.I[2]), x(s.g[0]), y(s.g[1]), z(s.g[2]) {
    // G^2 - 2 T I2 without the cancellation of G^2.
    swapped = x * x * (A - B) / A + z * z * (C - B) / C < 0;
    if (swapped) {
      std::swap(A, C);
      std::swap(x, z);
      y = -y;
    }
    turned = z < 0;
    if (turned) {
      y = -y;
      z = -z;
    }
  }
  // The renaming as a quaternion that follows the attitude of the renamed axes.
  Four<T> back() const {
    using std::sqrt;
    const T h = 1 / sqrt(T(2));
    const Four<T> swap = swapped ? Four<T>{0, h, 0, h} : Four<T>{1, 0, 0, 0};
    const Four<T> turn = turned ? Four<T>{0, 1, 0, 0} : Four<T>{1, 0, 0, 0};
    return product(turn, swap);
  }
  void restore(std::array<T, 3>& v) const {
    if (turned) {
      v[1] = -v[1];
      v[2] = -v[2];
    }
    if (swapped) {
      std::swap(v[0], v[2]);
      v[1] = -v[1];
    }
  }
};

template <class F>
class Textbook {
 public:
  using T = typename F::Real;

  explicit Textbook(const Start& start) : axes_(start) {
    using std::atan2;
    using std::sqrt;
    const T &A = axes_.A, &B = axes_.B, &C = axes_.C, &x = axes_.x, &y = axes_.y, &z = axes_.z;
    const T DA = y * y * (B - A) / B + z * z * (C - A) / C;
    const T DC = x * x * (C - A) / A + y * y * (C - B) / B;
    G_ = sqrt(x * x + y * y + z * z);
    a1_ = sqrt(A * DC / (C - A));
    a2_ = sqrt(B * DC / (C - B));
    a3_ = sqrt(C * DA / (C - A));
    n_ = sqrt((C - B) * DA / (A * B * C));
    if (axes_.swapped) n_ = -n_;
    m_ = (B - A) * DC / ((C - B) * DA);
    f_ = F(m_, complement(DA), -C * (B - A) / (A * (C - B)));
    slow_ = G_ / C;
    weight_ = G_ / n_ * (1 / A - 1 / C);
    u0_ = f_.incomplete_f(T(atan2(T(y / a2_), T(x / a1_))));
    pi0_ = pi_of(u0_);
    back_ = axes_.back();
  }

  // Attitude and angular velocity at t.
  void row(const T& t, std::array<T, 7>& out) const {
    using std::atan2;
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T u = u0_ + n_ * t;
    T cn = 0, dn = 0;
    const T sn = f_.jacobi(u, cn, dn);
    std::array<T, 3> g{a1_ * cn, a2_ * sn, a3_ * dn};
    const T node = slow_ * t + weight_ * (pi_of(u) - pi0_);
    const T J = atan2(T(sqrt(g[0] * g[0] + g[1] * g[1])), g[2]), l = atan2(g[0], g[1]);
    const T a = node / 2, b = J / 2, c = l / 2;
    const Four<T> q =
        product(product(product(Four<T>{cos(a), 0, 0, sin(a)}, Four<T>{cos(b), sin(b), 0, 0}),
                        Four<T>{cos(c), 0, 0, sin(c)}),
                back_);
    g = {g[0] / axes_.A, g[1] / axes_.B, g[2] / axes_.C};
    axes_.restore(g);
    out = {q[0], q[1], q[2], q[3], g[0], g[1], g[2]};
  }

  const T& momentum() const { return G_; }
  // The action of the circulation [SA, IellSadov] and its angle; g less its periodic part.
  std::array<T, 3> sadov() const {
    using std::acos;
    using std::sqrt;
    const T kappa2 = axes_.C * (axes_.B - axes_.A) / (axes_.A * (axes_.C - axes_.B));
    const T pi = acos(T(-1)), both = kappa2 + m_;
    const T action = G_ * 2 * sqrt((1 + kappa2) / kappa2 / both) / pi * (both * f_.Pi - m_ * f_.K);
    return {action, pi * u0_ / (2 * f_.K), weight_ * (f_.Pi / f_.K * u0_ - pi0_)};
  }

 private:
  // 1 - m from products.
  T complement(const T& DA) const {
    const T &A = axes_.A, &B = axes_.B, &C = axes_.C;
    const T D = axes_.x * axes_.x * (A - B) / A + axes_.z * axes_.z * (C - B) / C;
    return (C - A) * D / ((C - B) * DA);
  }
  T pi_of(const T& u) const {
    using std::atan2;
    using std::floor;
    const T periods = floor(u / (2 * f_.K) + T(0.5)), r = u - 2 * periods * f_.K;
    T cn = 0, dn = 0;
    const T sn = f_.jacobi(r, cn, dn);
    return f_.incomplete_pi(sn, cn, dn) + 2 * periods * f_.Pi;
  }

  Renamed<T> axes_;
  T G_, m_, a1_, a2_, a3_, n_, slow_, weight_, u0_, pi0_;
  F f_;
  Four<T> back_;
};

// A textbook form as a contender.
template <class F>
class TextbookMotion : public Motion {
 public:
  explicit TextbookMotion(const Start& start) : form_(start) {}
  void rows(std::span<const double> t, double* out) const override {
    for (const double x : t) {
      std::array<double, 7> row;
      form_.row(x, row);
      for (const double y : row) *out++ = y;
    }
  }

 private:
  Textbook<F> form_;
};

template <class F>
double fresh_sum(std::span<const Start> starts, double t) {
  double sum = 0.0;
  std::array<double, 7> row;
  for (const Start& s : starts) {
    Textbook<F>(s).row(t, row);
    sum += row[0];
  }
  return sum;
}

// Andoyer's angles of the attitude 1, then Sadov's variables: all six are formed.
template <class F>
double sadov_action(const Start& s) {
  const Textbook<F> form(s);
  const std::array<double, 3> found = form.sadov();
  const double G = std::hypot(s.g[0], s.g[1], s.g[2]);
  const double h = std::atan2(s.g[0], -s.g[1]), g = std::atan2(s.g[2], s.g[0]) + found[2];
  asm volatile("" : : "m"(h), "m"(g), "m"(found[1]));
  return found[0] / G;
}

template <class F>
std::unique_ptr<Motion> textbook_motion(const Start& s) {
  return std::make_unique<TextbookMotion<F>>(s);
}

}  // namespace peers
