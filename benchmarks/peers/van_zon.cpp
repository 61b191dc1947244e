// SPDX-License-Identifier: MIT
// The algorithm of van Zon and Schofield (J. Comput. Phys. 225, 145, 2007; Comput. Phys. Commun.
// 176, 2007), restated from the papers: Jacobi functions by Landen's transformation for each state,
// the angle round the momentum by a theta series whose coefficients are prepared, matrices.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "textbook.hpp"

namespace peers {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr std::size_t most_terms = 16;

double arithmetic_geometric(double a, double b) {
  while (std::abs(a - b) > 4.0 * eps * a) {  // quadratic: some six times
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 0.5 * (a + b);
}

// Carlson's RF by duplication.
double carlson_rf(double x, double y, double z) {
  for (int k = 0; k < 60; ++k) {
    const double mean = (x + y + z) / 3.0;
    const double X = 1.0 - x / mean, Y = 1.0 - y / mean, Z = -(X + Y);
    if (std::abs(X) < 2e-3 && std::abs(Y) < 2e-3 && std::abs(Z) < 2e-3) {
      const double e2 = X * Y - Z * Z, e3 = X * Y * Z;
      return (1.0 + (e2 / 24.0 - 0.1 - 3.0 * e3 / 44.0) * e2 + e3 / 14.0) / std::sqrt(mean);
    }
    const double a = std::sqrt(x), b = std::sqrt(y), c = std::sqrt(z),
                 shift = a * b + b * c + c * a;
    x = 0.25 * (x + shift);
    y = 0.25 * (y + shift);
    z = 0.25 * (z + shift);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// F(phi, m) of sin phi = s, cos phi = c, for |phi| <= pi.
double incomplete_f(double s, double c, double m1, double K) {
  const double half = s * carlson_rf(c * c, c * c + m1 * s * s, 1.0);
  return c >= 0.0 ? half : std::copysign(2.0 * K, s) - half;
}

struct Triple {
  double sn, cn, dn;
};

// Bulirsch's recurrence (1965).
Triple jacobi(double u, double m1) {
  std::array<double, 12> a{}, b{};
  double mean = 1.0, root = m1, c = 1.0;
  std::size_t last = 0;
  for (; last < a.size(); ++last) {
    a[last] = mean;
    b[last] = root = std::sqrt(root);
    c = 0.5 * (mean + root);
    if (std::abs(mean - root) <= 1e-8 * mean) break;
    root *= mean;
    mean = c;
  }
  Triple f{std::sin(c * u), std::cos(c * u), 1.0};
  if (f.sn == 0.0) return f;
  double x = f.cn / f.sn;
  c *= x;
  for (std::size_t k = last + 1; k-- > 0;) {
    const double y = a[k];
    x *= c;
    c *= f.dn;
    f.dn = (b[k] + x) / (y + x);
    x = c / y;
  }
  const double size = 1.0 / std::sqrt(c * c + 1.0);
  f.sn = f.sn >= 0.0 ? size : -size;
  f.cn = c * f.sn;
  return f;
}

class VanZon : public Motion {
 public:
  explicit VanZon(const Start& s) : axes_(s) {
    const double A = axes_.A, B = axes_.B, C = axes_.C, x = axes_.x, y = axes_.y, z = axes_.z;
    const double DA = y * y * (B - A) / B + z * z * (C - A) / C;
    const double DC = x * x * (C - A) / A + y * y * (C - B) / B;
    L_ = std::sqrt(x * x + y * y + z * z);
    most_ = {std::sqrt(A * DC / (C - A)), std::sqrt(B * DC / (C - B)), std::sqrt(C * DA / (C - A))};
    rate_ = std::sqrt((C - B) * DA / (A * B * C));
    if (axes_.swapped) rate_ = -rate_;
    const double m = (B - A) * DC / ((C - B) * DA);
    m1_ = 1.0 - m;
    const double pi = std::numbers::pi;
    const double K = 0.5 * pi / arithmetic_geometric(1.0, std::sqrt(m1_));
    const double K1 = 0.5 * pi / arithmetic_geometric(1.0, std::sqrt(m));
    const double size = std::hypot(x / most_[0], y / most_[1]);
    u0_ = incomplete_f(y / most_[1] / size, x / most_[0] / size, m1_, K);
    const double q = std::exp(-pi * K1 / K), s3 = most_[2] / L_;
    const double eta = incomplete_f(s3, std::sqrt((1.0 - s3) * (1.0 + s3)), m, K1) - K1;
    prepare_series(q, eta, K);
    scale_ = 0.5 * pi / K;
    const double xi = std::exp(pi * eta / K);
    double sum = (xi + 1.0) / (xi - 1.0);
    double q2 = q * q, power = q2, up = xi;
    for (int n = 1; n < 200; ++n) {
      const double term = power / (1.0 - power) * (up - 1.0 / up);
      sum -= 2.0 * term;
      if (std::abs(term) < eps * std::abs(sum)) break;
      power *= q2;
      up *= xi;
    }
    slow_ = L_ / A + scale_ * rate_ * sum;
    offset_ = series_angle(u0_);
  }

  std::size_t width() const override { return 12; }

  void rows(std::span<const double> t, double* out) const override {
    for (const double x : t) {
      row(x, out);
      out += 12;
    }
  }

 private:
  void prepare_series(double q, double eta, double K) {
    // (-1)^n q^(n (n + 1)) times twice cosh and sinh of (2 n + 1) pi eta / (2 K).
    double up = std::exp(0.5 * std::numbers::pi * eta / K), down = 1.0 / up;
    const double step = up * up;
    double size = 1.0, power = 1.0;
    for (terms_ = 0; terms_ < most_terms; ++terms_) {
      real_[terms_] = size * (up + down);
      imaginary_[terms_] = size * (down - up);
      if (std::abs(real_[terms_]) < 0.1 * eps * real_[0]) break;
      power *= q * q;
      size *= -power;
      up *= step;
      down /= step;
    }
  }
  // arg of theta1 at u - i eta.
  double series_angle(double u) const {
    const double x = scale_ * u, s1 = std::sin(x), c1 = std::cos(x);
    const double s2 = 2.0 * s1 * c1, c2 = c1 * c1 - s1 * s1;
    double s = s1, c = c1, re = 0.0, im = 0.0;
    for (std::size_t k = 0; k < terms_; ++k) {
      re += real_[k] * s;
      im += imaginary_[k] * c;
      const double next = s * c2 + c * s2;
      c = c * c2 - s * s2;
      s = next;
    }
    return std::atan2(im, re);
  }
  void row(double t, double* out) const {
    const double u = u0_ + rate_ * t;
    const Triple f = jacobi(u, m1_);
    std::array<double, 3> g{most_[0] * f.cn, most_[1] * f.sn, most_[2] * f.dn};
    const double angle = slow_ * t - series_angle(u) + offset_;
    const double s = std::sin(angle), c = std::cos(angle);
    const double flat = std::sqrt(g[0] * g[0] + g[1] * g[1]), nx = g[0] / L_, ny = g[1] / L_,
                 nz = g[2] / L_;
    // Rows: two axes across the momentum and the momentum, in body axes; turned by the angle.
    const std::array<double, 3> e1{g[1] / flat, -g[0] / flat, 0.0};
    const std::array<double, 3> e2{nz * g[0] / flat, nz * g[1] / flat, -flat / L_};
    std::array<std::array<double, 3>, 3> m{};
    for (std::size_t k = 0; k < 3; ++k) {
      m[0][k] = c * e1[k] - s * e2[k];
      m[1][k] = s * e1[k] + c * e2[k];
    }
    m[2] = {nx, ny, nz};
    for (auto& line : m) {
      axes_.restore(line);
      for (const double y : line) *out++ = y;
    }
    g = {g[0] / axes_.A, g[1] / axes_.B, g[2] / axes_.C};
    axes_.restore(g);
    for (const double y : g) *out++ = y;
  }

  Renamed<double> axes_;
  double L_, rate_, m1_, u0_, scale_ = 0.0, slow_, offset_ = 0.0;
  std::array<double, 3> most_;
  std::size_t terms_ = 0;
  std::array<double, most_terms> real_{}, imaginary_{};
};

std::unique_ptr<Motion> make(const Start& s) { return std::make_unique<VanZon>(s); }

double fresh(std::span<const Start> starts, double t) {
  double sum = 0.0;
  std::array<double, 12> row;
  for (const Start& s : starts) {
    const VanZon motion(s);
    motion.rows({&t, 1}, row.data());
    sum += row[0];
  }
  return sum;
}

}  // namespace

Maker van_zon_maker() { return {"van Zon and Schofield, restated", make, fresh}; }

}  // namespace peers
