// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <complex>

#include "polhode/error.hpp"
#include "secular/nutation_motion.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using Complex = std::complex<double>;
constexpr Complex i(0.0, 1.0);

// sum of c exp(i k.phi), k of either sign.
using Phasors = std::map<std::vector<int>, Complex>;

std::vector<int> opposite(std::vector<int> k) {
  for (int& one : k) one = -one;
  return k;
}

void add(Phasors& sum, const Series<double>& a, Complex factor) {
  const Symbols& symbols = a.symbols();
  for (const Term<double>& term : a.terms()) {
    std::vector<int> k;
    for (int j = 1; j < symbols.multipliers().count(); ++j)
      k.push_back(multiplier(symbols, term.key, j));
    const bool is_sine = term.key.function() == Trigonometric::sine;
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
  Multiples multiples;
  for (std::size_t j = 0; j < k.size(); ++j) multiples.emplace_back(names.arguments()[j], k[j]);
  throw DomainError(
      "NutationTheory: a resonance: the free wobble turns with the torque of " +
      text(names.symbols(), packed(names.symbols(), {}, multiples, Trigonometric::cosine)));
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
}  // namespace v0
}  // namespace polhode
