// SPDX-License-Identifier: MIT
#include "paper/support.hpp"

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <cstddef>

namespace polhode::paper {

Mp s(const Mp& x) { return sin(x); }
Mp c(const Mp& x) { return cos(x); }
Mp root(const Mp& x) { return sqrt(x); }
Mp arctan(const Mp& x) { return atan(x); }
Mp angle(const Mp& y, const Mp& x) { return atan2(y, x); }
Mp magnitude(const Mp& x) { return abs(x); }
Mp squared(const Mp& x) { return x * x; }
const Mp& pi() {
  static const Mp value = boost::math::constants::pi<Mp>();
  return value;
}
Mp turned(const Mp& a) { return a - 2 * pi() * round(a / (2 * pi())); }

Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(const Mp& k, const Vec& a) { return {k * a[0], k * a[1], k * a[2]}; }
Vec operator*(const Mat& m, const Vec& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }
Mat operator*(const Mat& a, const Mat& b) {
  const Mat bt = transposed(b);
  return {bt * a[0], bt * a[1], bt * a[2]};
}
Mp dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Mp length(const Vec& a) { return root(dot(a, a)); }
Mat transposed(const Mat& m) {
  return {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}};
}
Mat hat(const Vec& w) {
  return {{{Mp(0), -w[2], w[1]}, {w[2], Mp(0), -w[0]}, {-w[1], w[0], Mp(0)}}};
}
Vec scaled(const Vec& moments, const Vec& w) {
  return {moments[0] * w[0], moments[1] * w[1], moments[2] * w[2]};
}
Vec unscaled(const Vec& moments, const Vec& g) {
  return {g[0] / moments[0], g[1] / moments[1], g[2] / moments[2]};
}

Mat R1(const Mp& a) { return {{{Mp(1), Mp(0), Mp(0)}, {Mp(0), c(a), s(a)}, {Mp(0), -s(a), c(a)}}}; }
Mat R3(const Mp& a) { return {{{c(a), s(a), Mp(0)}, {-s(a), c(a), Mp(0)}, {Mp(0), Mp(0), Mp(1)}}}; }
Mat euler_matrix(const Vec& q) { return R3(q[2]) * R1(q[1]) * R3(q[0]); }
Mat andoyer_matrix(const Mp& l, const Mp& J, const Mp& g, const Mp& I, const Mp& h) {
  return R3(l) * R1(J) * R3(g) * R1(I) * R3(h);
}
Vec euler_angles(const Mat& R) {
  const Mp sine = root(R[0][2] * R[0][2] + R[1][2] * R[1][2]);
  return {angle(R[2][0], -R[2][1]), angle(sine, R[2][2]), angle(R[0][2], R[1][2])};
}

Vec inertial_rate(const std::function<Mat(const Mp&)>& R) {
  const Mp step("1e-16");
  const Mat at = R(Mp(0)), after = R(step), before = R(-step);
  Vec rate{};
  for (std::size_t i = 0; i < 3; ++i)
    rate = rate + cross(at[i], (Mp(1) / (4 * step)) * (after[i] - before[i]));
  return rate;
}

namespace {
// Axes about which phi, theta and psi turn: s3, the node, b3, in body components.
Mat turning_axes(const Vec& q) {
  const Mat late = R3(q[2]);
  const Vec s3 = (late * R1(q[1])) * Vec{Mp(0), Mp(0), Mp(1)};
  return {s3, late * Vec{Mp(1), Mp(0), Mp(0)}, {Mp(0), Mp(0), Mp(1)}};
}
}  // namespace

Vec body_rate(const Vec& q, const Vec& rates) { return transposed(turning_axes(q)) * rates; }
Vec euler_momenta(const Vec& q, const Vec& g) { return turning_axes(q) * g; }

Mp kinetic(const Vec& moments, const Vec& g) { return dot(g, unscaled(moments, g)) / 2; }

Mp derivative(const Curve& f, const Mp& x) {
  const Mp step("1e-16");
  return (f(x + step) - f(x - step)) / (2 * step);
}
Phase gradient(const Field& f, const Phase& x) {
  Phase d;
  for (std::size_t i = 0; i < 6; ++i) {
    d[i] = derivative(
        [&](const Mp& v) {
          Phase y = x;
          y[i] = v;
          return f(y);
        },
        x[i]);
  }
  return d;
}
std::array<Phase, 6> jacobian(const std::function<Phase(const Phase&)>& f, const Phase& x) {
  const Mp step("1e-16");
  std::array<Phase, 6> rows;
  for (std::size_t j = 0; j < 6; ++j) {
    Phase up = x, down = x;
    up[j] += step;
    down[j] -= step;
    const Phase after = f(up), before = f(down);
    for (std::size_t i = 0; i < 6; ++i) rows[i][j] = (after[i] - before[i]) / (2 * step);
  }
  return rows;
}
Mp bracket(const Phase& df, const Phase& dh) {
  Mp sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += df[i] * dh[i + 3] - df[i + 3] * dh[i];
  return sum;
}
Mp bracket(const Field& f, const Field& h, const Phase& x) {
  return bracket(gradient(f, x), gradient(h, x));
}
double symplectic_defect(const std::array<Phase, 6>& rows) {
  Gap gap;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      gap.add(bracket(rows[i], rows[j]), Mp(i + 3 == j ? 1 : (j + 3 == i ? -1 : 0)));
  return gap.size();
}

namespace {
constexpr std::size_t kNodes = 40;
struct GaussRule {
  std::array<Mp, kNodes> x, w;
};
// Newton's method on the Legendre polynomial of degree 40, from the usual cosine guess.
GaussRule gauss_rule() {
  GaussRule rule;
  for (std::size_t i = 0; i < kNodes; ++i) {
    Mp x = c(pi() * (Mp(i) + Mp("0.75")) / (Mp(kNodes) + Mp("0.5")));
    Mp slope = 1;
    for (int step = 0; step < 8; ++step) {
      Mp before = 1, at = x;
      for (std::size_t k = 2; k <= kNodes; ++k) {
        const Mp next = ((2 * Mp(k) - 1) * x * at - (Mp(k) - 1) * before) / Mp(k);
        before = at;
        at = next;
      }
      slope = Mp(kNodes) * (before - x * at) / (1 - x * x);
      x -= at / slope;
    }
    rule.x[i] = x;
    rule.w[i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}
}  // namespace

Mp integral(const Curve& f, const Mp& a, const Mp& b) {
  static const GaussRule rule = gauss_rule();
  const int panels = 1 + static_cast<int>(2 * std::fabs(static_cast<double>(b - a)));
  const Mp half = (b - a) / (2 * panels);
  Mp sum = 0;
  for (int p = 0; p < panels; ++p) {
    const Mp centre = a + (2 * p + 1) * half;
    for (std::size_t i = 0; i < kNodes; ++i) sum += rule.w[i] * f(centre + half * rule.x[i]);
  }
  return half * sum;
}

Mp ellint_F(const Mp& z, const Mp& k) { return ellint_Pi(z, Mp(0), k); }
Mp ellint_Pi(const Mp& z, const Mp& n, const Mp& k) {
  return integral(
      [&](const Mp& x) {
        const Mp sx = s(x), q = sx * sx;
        return 1 / ((1 + n * q) * root(1 - k * k * q));
      },
      Mp(0), z);
}
Mp ellint_K(const Mp& k) {
  Mp a = 1, b = root(1 - k * k);
  for (int step = 0; step < 12; ++step) {  // quadratic convergence: 1e-50 long before 12
    const Mp mean = (a + b) / 2;
    b = root(a * b);
    a = mean;
  }
  return pi() / (2 * a);
}

Jacobi jacobi(const Mp& u, const Mp& k) {
  constexpr std::size_t kSteps = 9;
  std::array<Mp, kSteps + 1> ratio;  // c/a of each step
  Mp a = 1, b = root(1 - k * k), two_n = 1;
  for (std::size_t i = 1; i <= kSteps; ++i) {
    const Mp difference = (a - b) / 2, mean = (a + b) / 2;
    b = root(a * b);
    a = mean;
    ratio[i] = difference / mean;
    two_n *= 2;
  }
  Mp phi = two_n * a * u;
  for (std::size_t i = kSteps; i >= 1; --i) phi = (phi + asin(ratio[i] * s(phi))) / 2;
  const Mp sn = s(phi);
  return {phi, sn, c(phi), root(1 - k * k * sn * sn)};
}

void Gap::add(const Mp& a, const Mp& b) { size_.add(static_cast<double>(magnitude(a - b))); }
void Gap::add(const Vec& a, const Vec& b) {
  for (std::size_t i = 0; i < 3; ++i) add(a[i], b[i]);
}
void Gap::add(const Mat& a, const Mat& b) {
  for (std::size_t i = 0; i < 3; ++i) add(a[i], b[i]);
}

double Random::number(double low, double high) {
  const double unit = static_cast<double>(engine_() >> 11) * 0x1p-53;
  return low + (high - low) * unit;
}
Vec Random::moments() {
  for (;;) {
    const double a = number(0.4, 1.0), b = number(0.5, 1.2), d = number(0.6, 1.5);
    if (a < 0.92 * b && b < 0.92 * d && d < 0.98 * (a + b)) return {Mp(a), Mp(b), Mp(d)};
  }
}

}  // namespace polhode::paper
