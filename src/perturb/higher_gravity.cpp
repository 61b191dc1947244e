// SPDX-License-Identifier: MIT
#include "polhode/perturb/higher_gravity.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr Vec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

// The product with x^2 + y^2 + z^2.
template <int degree>
BasicMoments<double, degree + 2> times_square(const BasicMoments<double, degree>& p) {
  BasicMoments<double, degree + 2> sum{};
  for (const Vec3& axis : axes) {
    const BasicMoments<double, degree + 2> part = times<degree + 1>(times<degree>(p, axis), axis);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
  }
  return sum;
}

// integral of (the monomials of degree - 2) |x|^2 dm: what the product with |x|^2 is dual to.
template <int degree>
BasicMoments<double, degree - 2> traces(const BasicMoments<double, degree>& m) {
  BasicMoments<double, degree - 2> out{};
  for (int c = 0; c <= degree - 2; ++c)
    for (int b = 0; b + c <= degree - 2; ++b)
      out[moment_place(b, c)] =
          m[moment_place(b, c)] + m[moment_place(b + 2, c)] + m[moment_place(b, c + 2)];
  return out;
}

// integral of (x . y)^degree dm(y), a polynomial in x: moments times multinomial coefficients.
template <int degree>
BasicMoments<double, degree> power_sum(const BasicMoments<double, degree>& m) {
  BasicMoments<double, degree> out{};
  for (int c = 0; c <= degree; ++c) {
    double ways = 1.0;  // degree! / (a! b! c!)
    for (int k = 1; k <= c; ++k) ways = ways * (degree - c + k) / k;
    for (int b = 0; b + c <= degree; ++b) {
      out[moment_place(b, c)] = ways * m[moment_place(b, c)];
      ways = ways * (degree - c - b) / (b + 1);
    }
  }
  return out;
}

template <int degree>
HarmonicGradient<degree> gradient_of(const BasicMoments<double, degree>& p) {
  HarmonicGradient<degree> g{};
  for (int c = 0; c < degree; ++c) {
    for (int b = 0; b + c < degree; ++b) {
      const int a = degree - 1 - b - c;
      const std::size_t at = moment_place(b, c);
      g.by[0][at] = (a + 1) * p[moment_place(b, c)];
      g.by[1][at] = (b + 1) * p[moment_place(b + 1, c)];
      g.by[2][at] = (c + 1) * p[moment_place(b, c + 1)];
    }
  }
  return g;
}

}  // namespace

// (5 (n.x)^3 - 3 |n|^2 |x|^2 n.x) / 2
HarmonicGradient<3> potential_gradient(const BasicMoments<double, 3>& m) {
  const BasicMoments<double, 3> cube = power_sum<3>(m);
  const BasicMoments<double, 3> mean = times_square<1>(traces<3>(m));
  BasicMoments<double, 3> p{};
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = 2.5 * cube[i] - 1.5 * mean[i];
  return gradient_of<3>(p);
}

// (35 (n.x)^4 - 30 |n|^2 |x|^2 (n.x)^2 + 3 |n|^4 |x|^4) / 8
HarmonicGradient<4> potential_gradient(const BasicMoments<double, 4>& m) {
  const BasicMoments<double, 2> second = traces<4>(m);
  const BasicMoments<double, 4> fourth = power_sum<4>(m);
  const BasicMoments<double, 4> square = times_square<2>(power_sum<2>(second));
  const BasicMoments<double, 4> mean = times_square<2>(times_square<0>(traces<2>(second)));
  BasicMoments<double, 4> p{};
  for (std::size_t i = 0; i < p.size(); ++i)
    p[i] = 4.375 * fourth[i] - 3.75 * square[i] + 0.375 * mean[i];
  return gradient_of<4>(p);
}

void require_higher_gravity(double gm, const MassMoments& moments) {
  if (!(gm > 0.0) || !std::isfinite(gm))
    throw DomainError("HigherGravity: gm " + number_text(gm) + " must be positive and finite");
  const auto require_finite = [](const auto& of, const char* degree) {
    for (const double x : of)
      if (!std::isfinite(x))
        throw DomainError(std::string("HigherGravity: ") + degree + " moment " + number_text(x) +
                          " must be finite");
  };
  require_finite(moments.third, "third-degree");
  require_finite(moments.fourth, "fourth-degree");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
