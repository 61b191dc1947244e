// SPDX-License-Identifier: MIT
// Derivatives of the motion by attitude, rate and every entry of the tensor, against differences of
// a Taylor integration in 50 digits that knows neither principal axes nor elliptic functions.
#include "fit/free_motion.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "fit/detail/rotation_vector.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using fit::detail::MotionPoint;
using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                             boost::multiprecision::et_off>;
using DigitsVec3 = std::array<Digits, 3>;

struct WideSpin {
  std::array<Digits, 4> q;
  DigitsVec3 w;
  std::array<DigitsVec3, 3> T;
};

WideSpin wide(const fit::SpinState& s) {
  const Quaternion q = normalized(s.q);
  WideSpin found{{q.w, q.x, q.y, q.z}, {s.w_F.x, s.w_F.y, s.w_F.z}, {}};
  Digits n = 0;
  for (const Digits& x : found.q) n += x * x;
  for (Digits& x : found.q) x /= sqrt(n);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) found.T[i][j] = s.inertia_F(int(i), int(j));
  }
  return found;
}

std::array<DigitsVec3, 3> inverse(const std::array<DigitsVec3, 3>& T) {
  std::array<DigitsVec3, 3> m;
  Digits det = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      m[i][j] = T[a][c] * T[b][d] - T[a][d] * T[b][c];
    }
  }
  for (std::size_t j = 0; j < 3; ++j) det += T[0][j] * m[j][0];
  for (auto& row : m) {
    for (Digits& x : row) x /= det;
  }
  return m;
}

// dL/dt = L x T^-1 L, dq/dt = q w / 2 by Taylor series of this order, through time t in this many
// steps.
void advance(WideSpin& s, const Digits& t, int steps) {
  constexpr std::size_t order = 36;
  const auto inverse_T = inverse(s.T);
  const auto times = [](const std::array<DigitsVec3, 3>& m, const DigitsVec3& v) {
    DigitsVec3 r;
    for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return r;
  };
  DigitsVec3 L = times(s.T, s.w);
  const Digits h = t / steps;
  for (int n = 0; n < steps; ++n) {
    std::vector<DigitsVec3> l{L}, w;
    std::vector<std::array<Digits, 4>> q{s.q};
    for (std::size_t k = 0; k < order; ++k) {
      w.push_back(times(inverse_T, l[k]));
      DigitsVec3 dl{};
      std::array<Digits, 4> dq{};
      for (std::size_t j = 0; j <= k; ++j) {
        const DigitsVec3 &a = l[j], &b = w[k - j];
        const auto& p = q[j];
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t c = (i + 1) % 3, d = (i + 2) % 3;
          dl[i] += a[c] * b[d] - a[d] * b[c];
          dq[i + 1] += p[0] * b[i] + p[c + 1] * b[d] - p[d + 1] * b[c];
          dq[0] -= p[i + 1] * b[i];
        }
      }
      for (Digits& x : dl) x /= k + 1;
      for (Digits& x : dq) x /= 2 * (k + 1);
      l.push_back(dl);
      q.push_back(dq);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      L[i] = l[order][i];
      for (std::size_t k = order; k-- > 0;) L[i] = L[i] * h + l[k][i];
    }
    for (std::size_t i = 0; i < 4; ++i) {
      s.q[i] = q[order][i];
      for (std::size_t k = order; k-- > 0;) s.q[i] = s.q[i] * h + q[k][i];
    }
  }
  s.w = times(inverse_T, L);
}

WideSpin changed(WideSpin s, std::size_t p, const Digits& by) {
  constexpr std::size_t places[5][2] = {{0, 0}, {1, 1}, {0, 1}, {1, 2}, {0, 2}};
  if (p < 3) {
    // q exp(by e_p / 2), to order 2: the third is an even one's difference
    const auto q = s.q;
    const std::size_t c = (p + 1) % 3, d = (p + 2) % 3;
    const Digits half = by / 2, cosine = 1 - half * half / 2;
    s.q[0] = cosine * q[0] - half * q[p + 1];
    s.q[p + 1] = cosine * q[p + 1] + half * q[0];
    s.q[c + 1] = cosine * q[c + 1] + half * q[d + 1];
    s.q[d + 1] = cosine * q[d + 1] - half * q[c + 1];
  } else if (p < 6) {
    s.w[p - 3] += by;
  } else {
    const auto [i, j] = std::pair(places[p - 6][0], places[p - 6][1]);
    s.T[i][j] += by;
    if (i != j) s.T[j][i] += by;
  }
  return s;
}

// The worst error of attitude and rate, and of derivatives over the greatest of their column.
struct Errors {
  double values, derivatives;
};

Errors errors_of(const fit::SpinState& s, double t, bool products) {
  std::vector<MotionPoint> points;
  if (!fit::detail::free_motion(s, {t}, {true, products}, points)) return {1.0, 1.0};
  const MotionPoint& found = points[0];
  const int steps = 1 + int(4.0 * std::abs(t - s.t0) * norm(s.w_F));
  const Digits elapsed = Digits(t) - Digits(s.t0), h("1e-17");
  WideSpin exact = wide(s);
  advance(exact, elapsed, steps);
  test::Worst<> values, derivatives;
  Quaternion q{double(exact.q[0]), double(exact.q[1]), double(exact.q[2]), double(exact.q[3])};
  values.add(norm(fit::attitude_residual(q, found.q)));
  for (int i = 0; i < 3; ++i) {
    values.add(std::abs(double(exact.w[std::size_t(i)]) - found.w_F[i]) / norm(s.w_F));
  }
  for (std::size_t p = 0; p < (products ? 11u : 8u); ++p) {
    WideSpin above = changed(wide(s), p, h), below = changed(wide(s), p, -h);
    advance(above, elapsed, steps);
    advance(below, elapsed, steps);
    std::array<Digits, 4> dq;
    Vec3 turn, rate;
    for (std::size_t i = 0; i < 4; ++i) dq[i] = (above.q[i] - below.q[i]) / (2 * h);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t c = (i + 1) % 3, d = (i + 2) % 3;
      const auto& e = exact.q;
      turn[int(i)] = double(
          2 * (e[0] * dq[i + 1] - e[i + 1] * dq[0] - e[c + 1] * dq[d + 1] + e[d + 1] * dq[c + 1]));
      rate[int(i)] = double((above.w[i] - below.w[i]) / (2 * h));
    }
    // columns that are 0 at the epoch, or for steady spin
    const double turns = test::larger(norm(turn), budget::fit_least_column),
                 rates = test::larger(norm(rate), norm(s.w_F) * turns);
    derivatives.add(norm(found.turn[p] - turn) / turns);
    derivatives.add(norm(found.rate[p] - rate) / rates);
  }
  return {values.value(), derivatives.value()};
}

fit::SpinState body(double Ixx, double Iyy, const Vec3& w) {
  fit::SpinState s{0.5, {0.3, -0.5, 0.4, 0.7}, w, Mat3::identity()};
  s.inertia_F(0, 0) = Ixx;
  s.inertia_F(1, 1) = Iyy;
  return s;
}

TEST(FreeMotion, DerivativesAreThoseOf50Digits) {
  const std::vector<fit::SpinState> cases{
      body(3.1, 3.2, {0.3, 0.6, -1.8}),        // long-axis mode, as Toutatis
      body(0.5, 0.8, {0.2, -0.3, 1.4}),        // short-axis mode
      body(1.3, 1.3 + 1e-3, {0.5, 0.4, 0.9}),  // nearly symmetric
      body(2.0, 1.6, {1.1, 0.3, 0.4}),
  };
  for (const fit::SpinState& s : cases) {
    for (const double t : {-1.5, 0.5, 3.0}) {
      const Errors e = errors_of(s, t, true);
      EXPECT_LE(e.values, budget::fit_motion) << s.inertia_F(0, 0) << " at " << t;
      EXPECT_LE(e.derivatives, budget::fit_derivatives) << s.inertia_F(0, 0) << " at " << t;
    }
  }
}

TEST(FreeMotion, TakesAnyTensor) {
  fit::SpinState s = body(2.3, 1.9, {0.5, -0.3, 0.8});
  for (Vec3& row : s.inertia_F.row) row = 4.0 * row;  // units do not act
  s.inertia_F(0, 1) = s.inertia_F(1, 0) = 0.7;
  s.inertia_F(1, 2) = s.inertia_F(2, 1) = -0.4;
  s.inertia_F(0, 2) = s.inertia_F(2, 0) = 0.2;
  const fit::SpinState same = [&] {
    fit::SpinState unit = s;
    for (Vec3& row : unit.inertia_F.row) row = 0.25 * row;
    return unit;
  }();
  const Errors e = errors_of(same, 2.0, true);
  EXPECT_LE(e.values, budget::fit_motion);
  EXPECT_LE(e.derivatives, budget::fit_derivatives);
  std::vector<MotionPoint> a, b;
  ASSERT_TRUE(fit::detail::free_motion(s, {2.0}, {}, a));
  ASSERT_TRUE(fit::detail::free_motion(same, {2.0}, {}, b));
  EXPECT_LE(norm(fit::attitude_residual(a[0].q, b[0].q)), budget::fit_motion);
}

// Where neighbours have another form derivatives are taken beside.
TEST(FreeMotion, HasDerivativesOfEveryForm) {
  for (const fit::SpinState& s : {body(2.0, 2.0, {0.3, 0.2, 1.0}), body(1.0, 1.0, {0.3, 0.2, 1.0}),
                                  body(0.5, 0.8, {0.0, 0.0, 1.3}), body(2.0, 1.5, {0.0, 0.0, 1.3}),
                                  body(1.0, 0.7, {0.4, 0.0, 0.0})}) {
    const Errors e = errors_of(s, 2.0, false);
    EXPECT_LE(e.values, budget::fit_motion) << s.inertia_F(0, 0) << " " << s.w_F.z;
    EXPECT_LE(e.derivatives, budget::fit_derivatives_aside) << s.inertia_F(0, 0) << s.w_F.z;
  }
}

TEST(RotationVector, DerivativesAreInverseAndExact) {
  for (const double size : {1e-7, 9e-3, 1.1e-2, 0.7, 3.0}) {
    const Vec3 v = size * Vec3{0.48, -0.6, 0.64};
    EXPECT_LE(norm(fit::detail::rotation_vector(fit::detail::turn_by(v)) - v),
              budget::fit_rotation * size);
    const Mat3 product = fit::detail::exp_derivative(v) * fit::detail::log_derivative(v);
    for (int j = 0; j < 3; ++j) {
      Vec3 e;
      e[j] = 1.0;
      EXPECT_LE(norm(product * e - e), budget::fit_rotation);
      const double h = 1e-4;
      const auto moved = [&](double by) {
        return fit::attitude_residual(fit::detail::turn_by(v), fit::detail::turn_by(v + by * e));
      };
      const Vec3 slope = (1.0 / (12.0 * h)) *
                         ((8.0 * (moved(h) - moved(-h))) - (moved(2.0 * h) - moved(-2.0 * h)));
      EXPECT_LE(norm(slope - fit::detail::exp_derivative(v) * e), budget::fit_rotation_difference);
    }
  }
}

}  // namespace
