// SPDX-License-Identifier: MIT
// How the axes of a planet answer the torque: Poisson terms of the momentum by a Lie transform,
// Oppolzer terms of the body by Euler's equations.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "polhode/error.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "secular/nutation_theory.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

namespace {

constexpr int most_powers = 3;  // of x and y: second-order terms take three derivatives at most

using Number = series::Series<double>;

// c = cos I = (cos I0 + x) / (1 + y), s = sin I and I itself less I0, as polynomials in x and y.
struct Inclination {
  Number c, s, I;
  series::Truncation keep;
};

Inclination inclination(const NutationSymbols& names, double I0) {
  const series::Symbols& symbols = names.symbols();
  series::Truncation keep{{{NutationSymbols::x, 1}}, most_powers};
  const double c0 = std::cos(I0), s0 = std::sin(I0);
  Number c =
      series::constant(symbols, c0) + series::monomial(symbols, 1.0, {{NutationSymbols::x, 1}});
  if (names.has_phi()) {
    keep.weights.emplace_back(NutationSymbols::y, 1);
    Number inverse(symbols);
    for (int n = 0; n <= most_powers; ++n)
      inverse += series::monomial(symbols, n % 2 == 0 ? 1.0 : -1.0, {{NutationSymbols::y, n}});
    c = series::product(c, inverse, keep);
  }
  // s = s0 sqrt(1 + e), e = (c0^2 - c^2) / s0^2.
  const Number e = (series::constant(symbols, c0 * c0) - series::product(c, c, keep)) / (s0 * s0);
  Number s = series::constant(symbols, s0), term = s;
  for (int n = 1; n <= most_powers; ++n) {
    term = series::product(term, e, keep) * ((1.5 - n) / n);
    s += term;
  }
  // dI/dc = -1/s, d(1/s)/dc = c/s^3.
  const std::array<double, 3> derivatives = {-1.0 / s0, -c0 / (s0 * s0 * s0),
                                             -(1.0 + 3.0 * c0 * c0 / (s0 * s0)) / (s0 * s0 * s0)};
  const Number of_c = c - series::constant(symbols, c0);
  Number I(symbols), power = series::constant(symbols, 1.0);
  double factorial = 1.0;
  for (int n = 1; n <= most_powers; ++n) {
    power = series::product(power, of_c, keep);
    factorial *= n;
    I += (derivatives[static_cast<std::size_t>(n - 1)] / factorial) * power;
  }
  return {c, s, I, keep};
}

// The harmonics of the pull in axes that turn with the node: u_z^2 - 1/3, u_z w, w^2, with
// w = -(u_x + i u_y) exp(-i h) = (u_x + i u_y) exp(-i h_), since h = pi + h_.
struct PullAtNode {
  Number q0;
  ComplexSeries q1, q2;
};

PullAtNode at_node(const NutationTorque& torque, const series::Truncation& keep) {
  return {torque.q0, turned(torque.q1, {{NutationSymbols::h, -1}}, keep),
          turned(torque.q2, {{NutationSymbols::h, -2}}, keep)};
}

// u3^2 - 1/3, weighted with gm / r^3.
Number of_the_bulge(const PullAtNode& pull, const Inclination& at) {
  const auto times = [&](const Number& a, const Number& b) {
    return series::product(a, b, at.keep);
  };
  const Number c2 = times(at.c, at.c), one = series::constant(at.c.symbols(), 1.0);
  return times(1.5 * c2 - 0.5 * one, pull.q0) + 2.0 * times(times(at.c, at.s), pull.q1.im) -
         0.5 * times(one - c2, pull.q2.re);
}

// The real part of exp(-2 i Phi) (u . (X + i Y))^2, X along the node and Y across it, normal to the
// momentum, with the same weights.
Number of_the_equator(const PullAtNode& pull, const Inclination& at) {
  const Number one = series::constant(at.c.symbols(), 1.0);
  const Number plus = one + at.c, minus = one - at.c;
  const auto times = [&](const Number& a, const Number& b) {
    return series::product(a, b, at.keep);
  };
  ComplexSeries sum = product(0.25 * times(plus, plus), pull.q2, at.keep) +
                      product(0.25 * times(minus, minus), conj(pull.q2), at.keep);
  sum = sum - times_i(product(times(at.s, plus), pull.q1, at.keep));
  sum = sum - times_i(product(times(at.s, minus), conj(pull.q1), at.keep));
  sum.re -= 1.5 * times(times(plus, minus), pull.q0);
  return turned(sum, {{"Phi", -2}}, at.keep).re;
}

// The pull, and the turning ecliptic, over G0.
struct Pull {
  Number of_bodies, of_ecliptic;
};

Pull pull(const NutationProblem& problem, const NutationSymbols& names,
          const NutationTorque& torque, const Inclination& at) {
  const series::Symbols& symbols = names.symbols();
  const Vec3& m = problem.body.moments();
  const double per_G = 1.5 / (m.z * problem.spin_rate);
  const PullAtNode turned_pull = at_node(torque, at.keep);
  Number bodies = per_G * (m.z - 0.5 * (m.x + m.y)) * of_the_bulge(turned_pull, at);
  if (names.has_phi()) bodies += per_G * 0.5 * (m.x - m.y) * of_the_equator(turned_pull, at);
  const Vec3& mu = problem.ecliptic_rate;
  // -mu.n, n = (-s sin h_, s cos h_, c)
  const Number wave = mu.x * series::sine(symbols, 1.0, {}, {{NutationSymbols::h, 1}}) -
                      mu.y * series::cosine(symbols, 1.0, {}, {{NutationSymbols::h, 1}});
  return {bodies, series::product(at.s, wave, at.keep) - mu.z * at.c};
}

// At the mean axis: x = y = h_ = 0.
Number at_mean(const Number& a) {
  const series::Symbols& symbols = a.symbols();
  const int k = symbols.variable(NutationSymbols::k), h = symbols.angle(NutationSymbols::h);
  std::vector<series::Term<double>> terms;
  for (const series::Term<double>& term : a.terms()) {
    const auto exponents =
        symbols.exponents().with(term.key.exponents, k, -series::exponent(symbols, term.key, k));
    if (exponents != symbols.exponents().zero()) continue;
    const auto multipliers = symbols.multipliers().with(term.key.multipliers, h,
                                                        -series::multiplier(symbols, term.key, h));
    terms.push_back({{exponents, multipliers}, term.c});
  }
  return Number(symbols, std::move(terms));
}
// What does not turn, and what turns slowly as it stands at the epoch.
double at_epoch(const Number& a, const NutationProblem& problem) {
  const series::Symbols& symbols = a.symbols();
  double sum = 0.0;
  for (const series::Term<double>& term : a.terms()) {
    double theta = 0.0;
    for (std::size_t i = 0; i < problem.arguments.size(); ++i)
      theta += series::multiplier(symbols, term.key, static_cast<int>(i) + 1) *
               problem.arguments[i].at_epoch;
    sum += term.c *
           (term.key.function() == series::Trigonometric::sine ? std::sin(theta) : std::cos(theta));
  }
  return sum;
}

// k counts orders. A term so small that its product with the largest falls below `least` is of the
// second order itself: it then enters alone, and products with it are left out.
Number with_orders(const Number& of_bodies, const series::Truncation& of_momenta,
                   const NutationProblem& problem, const std::vector<double>& rates) {
  const series::Symbols& symbols = of_bodies.symbols();
  constexpr double largest = 1e-3;  // rad: of the nutation of any planet
  const double first = problem.least / largest;
  const int k = symbols.variable(NutationSymbols::k);
  const series::detail::Orders degree(symbols, of_momenta);
  std::vector<series::Term<double>> terms;
  for (const series::Term<double>& term : of_bodies.terms()) {
    const double rate = std::abs(rate_of(symbols, term.key, rates));
    const bool small = problem.order == 2 && std::abs(term.c) < 0.1 * first * rate;
    if (small && degree.of(term.key) > 1) continue;
    terms.push_back(
        {{symbols.exponents().with(term.key.exponents, k, small ? 2 : 1), term.key.multipliers},
         term.c});
  }
  return Number(symbols, std::move(terms));
}

Waves waves(const Number& longitude, const Number& obliquity) {
  const series::Symbols& symbols = longitude.symbols();
  Waves found;
  const auto each = [&](const Number& of, bool is_longitude) {
    for (const series::Term<double>& term : of.terms()) {
      std::vector<int> multipliers;
      for (int i = 1; i < symbols.multipliers().count(); ++i)
        multipliers.push_back(series::multiplier(symbols, term.key, i));
      NutationWave& wave = found[multipliers];
      const bool is_sine = term.key.function() == series::Trigonometric::sine;
      (is_longitude ? (is_sine ? wave.longitude_sine : wave.longitude_cosine)
                    : (is_sine ? wave.obliquity_sine : wave.obliquity_cosine)) += term.c;
    }
  };
  each(longitude, true);
  each(obliquity, false);
  return found;
}

}  // namespace

MomentumMotion momentum_motion(const NutationProblem& problem, const NutationSymbols& names,
                               const NutationTorque& torque, const std::vector<double>& rates) {
  const series::Symbols& symbols = names.symbols();
  const Inclination at = inclination(names, problem.obliquity);
  const auto [of_bodies, of_ecliptic] = pull(problem, names, torque, at);
  const series::Truncation keep{{{NutationSymbols::k, 1}}, problem.order};
  Number h =
      with_orders(of_bodies, at.keep, problem, rates) +
      series::product(series::monomial(symbols, 1.0, {{NutationSymbols::k, 1}}), of_ecliptic);
  // The arguments are counted from the mean equinox: h_ has no mean motion of the first order.
  const double turn = at_epoch(
      at_mean(series::derivative(series::mean(h, names.arguments()), NutationSymbols::x)), problem);
  h -= series::monomial(symbols, turn, {{NutationSymbols::x, 1}, {NutationSymbols::k, 1}});
  if (names.has_phi()) {  // G^2 / (2 C) over G0; y is small
    h += series::monomial(symbols, problem.spin_rate, {{NutationSymbols::y, 1}}) +
         series::monomial(symbols, 0.5 * problem.spin_rate,
                          {{NutationSymbols::y, 2}, {NutationSymbols::k, 1}});
  }
  Elimination<double> elimination{h, keep, names.arguments()};
  elimination.slowest = problem.slowest;
  for (std::size_t i = 0; i < problem.arguments.size(); ++i)
    elimination.clocks.push_back({names.arguments()[i], series::constant(symbols, rates[i])});
  const LieTransform<double> transform(std::move(elimination));
  const Number& mean_h = transform.mean_hamiltonian();
  const NutationOffset precession{
      -turn - at_epoch(at_mean(series::derivative(mean_h, NutationSymbols::x)), problem),
      at_epoch(at_mean(series::derivative(mean_h, NutationSymbols::h)), problem) /
          std::sin(problem.obliquity)};
  const Number longitude = -at_mean(transform.short_period(NutationSymbols::h));
  const Number obliquity = at_mean(transform.in_mean(at.I));
  const double phi_rate =
      names.has_phi() ? at_epoch(at_mean(series::derivative(mean_h, NutationSymbols::y)), problem)
                      : 0.0;
  return {precession, phi_rate, waves(longitude, obliquity)};
}

namespace {

using Complex = std::complex<double>;
constexpr Complex i(0.0, 1.0);

// sum of c exp(i k.phi), k of either sign.
using Phasors = std::map<std::vector<int>, Complex>;

std::vector<int> opposite(std::vector<int> k) {
  for (int& one : k) one = -one;
  return k;
}

void add(Phasors& sum, const series::Series<double>& a, Complex factor) {
  const series::Symbols& symbols = a.symbols();
  for (const series::Term<double>& term : a.terms()) {
    std::vector<int> k;
    for (int j = 1; j < symbols.multipliers().count(); ++j)
      k.push_back(series::multiplier(symbols, term.key, j));
    const bool is_sine = term.key.function() == series::Trigonometric::sine;
    const Complex half = 0.5 * term.c * factor;
    sum[k] += is_sine ? -i * half : half;
    sum[opposite(k)] += is_sine ? i * half : half;
  }
}

// The sum over bodies of gm/r^3 u_Z (u_X + i u_Y), Z along the mean momentum, X along its node.
Phasors product_of_directions(const NutationTorque& torque, double I) {
  const double c = std::cos(I), s = std::sin(I);
  Phasors sum;
  const auto with = [&](const ComplexSeries& q, Complex a, Complex of_conjugate) {
    add(sum, q.re, a + of_conjugate);
    add(sum, q.im, i * (a - of_conjugate));
  };
  add(sum, torque.q0, 1.5 * i * c * s);
  with(torque.q1, -0.5 * (2.0 * c - 1.0) * (1.0 + c), -0.5 * (1.0 + 2.0 * c) * (1.0 - c));
  with(torque.q2, 0.25 * i * s * (1.0 + c), -0.25 * i * s * (1.0 - c));
  return sum;
}

// z = sin(I) dh - i dI, from one sign of each pair of multipliers.
Waves waves(const Phasors& z, double sin_I) {
  Waves found;
  for (const auto& [k, c] : z) {
    const auto first = std::find_if(k.begin(), k.end(), [](int n) { return n != 0; });
    const bool flipped = first != k.end() && *first < 0;
    NutationWave& wave = found[flipped ? opposite(k) : k];
    const double sign = flipped ? -1.0 : 1.0;
    wave.longitude_cosine -= c.real() / sin_I;
    wave.longitude_sine += sign * c.imag() / sin_I;
    wave.obliquity_cosine -= c.imag();
    wave.obliquity_sine -= sign * c.real();
  }
  return found;
}

// Where the torque turns with the free wobble, as seen from the body.
void require_no_resonance(double determinant, const NutationSymbols& names,
                          const std::vector<int>& k) {
  constexpr double least = 1e-12;
  if (std::abs(determinant) > least) return;
  series::Multiples multiples;
  for (std::size_t j = 0; j < k.size(); ++j) multiples.emplace_back(names.arguments()[j], k[j]);
  throw DomainError("NutationTheory: a resonance: the free wobble turns with the torque of " +
                    series::text(names.symbols(), series::packed(names.symbols(), {}, multiples,
                                                                 series::Trigonometric::cosine)));
}

}  // namespace

Waves sum(const Waves& a, const Waves& b) {
  Waves total = a;
  for (const auto& [k, wave] : b) {
    NutationWave& into = total[k];
    into.longitude_sine += wave.longitude_sine;
    into.longitude_cosine += wave.longitude_cosine;
    into.obliquity_cosine += wave.obliquity_cosine;
    into.obliquity_sine += wave.obliquity_sine;
  }
  return total;
}

// g1 + i g2 = sum of p exp(i (theta - Phi)) + r exp(i (Phi - theta)), with
// d(g1 + i g2)/dt = i (alpha (g1 + i g2) + beta (g1 - i g2)) + N, N = -3 i (bulge S exp(-i Phi)
// + equator conj(S) exp(i Phi)), S = sum of S_k exp(i theta).
WobbleMotion wobble_motion(const NutationProblem& problem, const NutationSymbols& names,
                           const NutationTorque& torque, const std::vector<double>& rates) {
  const Vec3& m = problem.body.moments();
  const double spin = problem.spin_rate, G = m.z * spin;
  const double of_1 = m.z / m.x - 1.0, of_2 = m.z / m.y - 1.0;  // C/A - 1, C/B - 1
  const double gamma = 0.5 * (of_1 + of_2), eta = 0.5 * (of_1 - of_2);
  const double alpha = spin * gamma, beta = spin * eta;
  const double bulge = m.z - 0.5 * (m.x + m.y), equator = 0.5 * (m.y - m.x);
  Phasors figure, rotation;
  for (const auto& [k, S] : product_of_directions(torque, problem.obliquity)) {
    double rate = -spin;
    for (std::size_t j = 0; j < rates.size(); ++j) rate += k[j] * rates[j];
    const double determinant = rate * rate - alpha * alpha + beta * beta;
    require_no_resonance(determinant / (spin * spin), names, k);
    const Complex p = 3.0 * S * (beta * equator - bulge * (rate + alpha)) / determinant;
    const Complex r_conjugate = 3.0 * S * ((rate - alpha) * equator + beta * bulge) / determinant;
    figure[k] -= p / G;
    rotation[k] += (gamma * p + eta * r_conjugate) / G;
    if (!names.has_phi()) continue;
    std::vector<int> fast = opposite(k);
    fast.back() += 2;
    figure[fast] -= std::conj(r_conjugate) / G;
    rotation[fast] += (gamma * std::conj(r_conjugate) + eta * std::conj(p)) / G;
  }
  const double s = std::sin(problem.obliquity);
  return {waves(figure, s), waves(rotation, s)};
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
