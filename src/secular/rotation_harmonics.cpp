// SPDX-License-Identifier: MIT
// The gravity gradient's Poisson series: functions of I_l / I_g, harmonics of the body and of the
// orbit, and their product.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "polhode/free/free_rotation.hpp"
#include "polhode/math/quaternion.hpp"
#include "secular/gravity_gradient_transform.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {
namespace {

using Complex = std::complex<double>;

constexpr double turn = 2.0 * std::numbers::pi;

// --- functions of the ratio x = I_l / I_g, interpolated about its value ---

constexpr std::size_t nodes = 21;
constexpr std::size_t taylor_size = action_degree + 1;
using Taylor = std::array<double, taylor_size>;

double node(std::size_t i) {
  return std::cos((static_cast<double>(i) + 0.5) * std::numbers::pi / static_cast<double>(nodes));
}

// Taylor coefficients at y = 0 of the polynomial through values at the nodes in [-1, 1], for unit
// values at one node each.
std::array<Taylor, nodes> taylor_of_nodes() {
  std::array<Taylor, nodes> found{};
  // T_k at 0 with its derivatives over n!: T_(k+1) = 2 y T_k - T_(k-1).
  Taylor before{}, now{};
  before[0] = 1.0;  // T_0
  now[1] = 1.0;     // T_1
  for (std::size_t k = 0; k < nodes; ++k) {
    const Taylor& at_zero = k == 0 ? before : now;
    for (std::size_t i = 0; i < nodes; ++i) {
      const double angle = static_cast<double>(k) * (static_cast<double>(i) + 0.5) *
                           std::numbers::pi / static_cast<double>(nodes);
      const double weight = (k == 0 ? 1.0 : 2.0) / static_cast<double>(nodes) * std::cos(angle);
      for (std::size_t d = 0; d < taylor_size; ++d) found[i][d] += weight * at_zero[d];
    }
    if (k == 0) continue;
    Taylor next{};
    for (std::size_t d = 0; d < taylor_size; ++d)
      next[d] = (d > 0 ? 2.0 * now[d - 1] : 0.0) - before[d];
    before = now;
    now = next;
  }
  return found;
}

// sum of c_n (I_l/I_g - x0)^n.
ActionTaylor of_ratio(const Taylor& c, const ActionTaylor& displacement) {
  ActionTaylor sum(c[taylor_size - 1]);
  for (std::size_t n = taylor_size - 1; n-- > 0;) sum = ActionTaylor(c[n]) + displacement * sum;
  return sum;
}

// --- the body ---

// Of d0, d1 and d2 at one ratio: coefficients of exp(i k phi_l), k = 0, 1, ..., -2, -1; and the
// frequency of phi_l.
constexpr std::size_t points = 129;
constexpr int most_multiple = static_cast<int>(points / 2);
using Values = std::array<Complex, points>;
struct Turn {
  std::array<Values, 3> d;
  double n_l;
  Complex harmonic(std::size_t m, int k) const {
    return d[m][static_cast<std::size_t>(k < 0 ? k + static_cast<int>(points) : k)];
  }
};

Values harmonics(const Values& values) {
  Values roots, found;
  for (std::size_t j = 0; j < points; ++j)
    roots[j] = std::polar(1.0 / static_cast<double>(points),
                          -turn * static_cast<double>(j) / static_cast<double>(points));
  for (std::size_t k = 0; k < points; ++k) {
    Complex sum = 0.0;
    for (std::size_t j = 0; j < points; ++j) sum += values[j] * roots[j * k % points];
    found[k] = sum;
  }
  return found;
}

Turn turn_at(const Body& body, const SadovState& at, double x) {
  SadovState start = at;
  start.phi_l = start.phi_g = start.phi_h = start.I_h = 0.0;
  start.I_l = x * at.I_g;
  const FreeRotation motion(body, to_rotor(body, start));
  const SadovFrequencies n = sadov_frequencies(motion);
  const Vec3& m = body.moments();
  const double third = (m.x + m.y + m.z) / 3.0;
  const auto tensor = [&](const Vec3& a, const Vec3& b) {
    return (m.x - third) * a.x * b.x + (m.y - third) * a.y * b.y + (m.z - third) * a.z * b.z;
  };
  std::array<Values, 3> d;
  for (std::size_t j = 0; j < points; ++j) {
    const double t = turn * static_cast<double>(j) / (static_cast<double>(points) * n.n_l);
    // I_h = 0: the node is along x, and the momentum along -y.
    const Quaternion q =
        rotation_z(-n.n_g * t) * rotation_x(-0.5 * std::numbers::pi) * motion.at(t).q;
    const auto axes = rotation_matrix(q);
    const Vec3 &X = axes.row[0], &Y = axes.row[1], &Z = axes.row[2];
    d[0][j] = tensor(Z, Z);
    d[1][j] = {tensor(X, Z), tensor(Y, Z)};
    d[2][j] = {0.5 * (tensor(X, X) - tensor(Y, Y)), tensor(X, Y)};
  }
  return {{harmonics(d[0]), harmonics(d[1]), harmonics(d[2])}, n.n_l};
}

}  // namespace

double distance_in_region(const Body& body, const SadovState& at) {
  Vec3 m = body.moments();
  if (m.x > m.y) std::swap(m.x, m.y);
  if (m.y > m.z) std::swap(m.y, m.z);
  if (m.x > m.y) std::swap(m.x, m.y);
  // The planes of the separatrix cut the sphere of the momentum at the ratio 2/pi atan(kappa).
  const double kappa2 = m.z * (m.y - m.x) / (m.x * (m.z - m.y));
  const double border = std::atan(std::sqrt(kappa2)) / (0.5 * std::numbers::pi);
  const double x = std::abs(at.I_l) / at.I_g;
  return at.region == SadovRegion::long_axis ? std::min(x, border - x)
                                             : std::min(1.0 - x, x - border);
}

TurningTensor turning_tensor(const Body& body, const SadovState& at, double least) {
  const double x0 = at.I_l / at.I_g, half = 0.3 * distance_in_region(body, at);
  const auto unit = taylor_of_nodes();
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < nodes; ++i) turns.push_back(turn_at(body, at, x0 + half * node(i)));
  // value(turn) as a Taylor polynomial of x - x0.
  const auto taylor = [&](const auto& value) {
    Taylor sum{};
    for (std::size_t i = 0; i < nodes; ++i)
      for (std::size_t d = 0; d < taylor_size; ++d) sum[d] += unit[i][d] * value(turns[i]);
    double scale = 1.0;
    for (double& c : sum) {
      c *= scale;
      scale /= half;
    }
    return sum;
  };
  const ActionVariables actions(at);
  const ActionTaylor displacement = actions.I_l / actions.I_g - ActionTaylor(x0);

  // H_0 = I_g^2 f(x), of which f' = n_l at I_g = 1.
  const Taylor slope = taylor([&](const Turn& one) { return one.n_l / at.I_g; });
  SadovState start = at;
  start.I_h = 0.0;
  const FreeRotation motion(body, to_rotor(body, start));
  Taylor energy{};
  energy[0] = motion.energy() / (at.I_g * at.I_g);
  for (std::size_t d = 1; d < taylor_size; ++d) energy[d] = slope[d - 1] / static_cast<double>(d);
  TurningTensor found{actions.I_g * actions.I_g * of_ratio(energy, displacement), {}};

  const Turn& middle = turns[nodes / 2];
  double largest = 0.0;
  for (const Values& of_d : middle.d)
    for (const Complex& c : of_d) largest = std::max(largest, std::abs(c));
  for (std::size_t m = 0; m < 3; ++m)
    for (int k = -most_multiple; k <= most_multiple; ++k) {
      if (!(std::abs(middle.harmonic(m, k)) > least * largest)) continue;
      const Taylor re = taylor([&](const Turn& one) { return one.harmonic(m, k).real(); });
      const Taylor im = taylor([&](const Turn& one) { return one.harmonic(m, k).imag(); });
      found.waves[m].push_back({k, of_ratio(re, displacement), of_ratio(im, displacement)});
    }
  return found;
}

// --- the orbit ---

OrbitWaves orbit_waves(const Eccentricity& e, double least) {
  // Coefficients fall like (e exp(sqrt(1 - e^2)) / (1 + sqrt(1 - e^2)))^q.
  const double root = std::sqrt(e.complement * (1.0 + e.e));
  const double fall = e.e * std::exp(root) / (1.0 + root);
  const int most =
      fall == 0.0 ? 2 : static_cast<int>(12.0 + 1.5 * std::log(least) / std::log(fall));
  const int steps = 4 * most + 1;
  std::vector<Complex> even(static_cast<std::size_t>(steps)), turning(even.size());
  for (int j = 0; j < steps; ++j) {
    const KeplerAnomaly at = eccentric_anomaly(turn * j / steps, e);
    // In units of a: x = 1 - e - (1 - cos E), y = sqrt(1 - e^2) sin E.
    const Complex position(e.complement - at.versine, root * at.sine);
    const double r = std::abs(position), r3 = r * r * r;
    even[static_cast<std::size_t>(j)] = 1.0 / r3;
    turning[static_cast<std::size_t>(j)] = position * position / (r * r * r3);
  }
  std::vector<Complex> roots;
  for (int j = 0; j < steps; ++j) roots.push_back(std::polar(1.0, -turn * j / steps));
  const auto coefficient = [&](const std::vector<Complex>& values, int q) {
    double sum = 0.0;  // real: both are symmetric about the pericentre
    const auto by = static_cast<std::size_t>(q < 0 ? q + steps : q);
    for (std::size_t j = 0, at = 0; j < values.size(); ++j, at = (at + by) % values.size())
      sum += values[j].real() * roots[at].real() - values[j].imag() * roots[at].imag();
    return sum / steps;
  };
  OrbitWaves found;
  for (int q = -most; q <= most; ++q) {
    const double of_even = coefficient(even, std::abs(q)), of_turning = coefficient(turning, q);
    if (std::abs(of_even) > least) found.even.push_back({q, of_even});
    if (std::abs(of_turning) > least) found.turning.push_back({q, of_turning});
  }
  return found;
}

// --- their product ---

namespace {

struct ComplexTaylor {
  ActionTaylor re, im;
};
ComplexTaylor operator*(const ActionTaylor& a, const ComplexTaylor& b) {
  return {a * b.re, a * b.im};
}
ComplexTaylor times_i(const ComplexTaylor& a) { return {-a.im, a.re}; }

// A function of the inclination times a^3/r^3 exp(i (turns (f - phi_h))): turns is 0, 2 or -2.
struct Attraction {
  ActionTaylor of_inclination;
  int turns;
  bool is_imaginary;
};

class GradientTerms {
 public:
  GradientTerms(const series::Symbols& symbols, const OrbitWaves& orbit)
      : symbols_(symbols), orbit_(orbit) {}

  // The real part of c exp(i (-k phi_l - m phi_g)) times the pull.
  void add(const ComplexTaylor& c, int k, int m, const Attraction& pull) {
    const ComplexTaylor turned = pull.of_inclination * (pull.is_imaginary ? times_i(c) : c);
    const int sign = pull.turns < 0 ? -1 : 1;
    for (const OrbitWave& wave : pull.turns == 0 ? orbit_.even : orbit_.turning) {
      const ActionTaylor x(wave.c);
      add_wave({{"phi_l", -k}, {"phi_g", -m}, {"phi_h", -pull.turns}, {"M", sign * wave.multiple}},
               x * turned);
    }
  }
  series::Series<ActionTaylor> series() && {
    return series::Series<ActionTaylor>(symbols_, std::move(terms_));
  }

 private:
  // Re (re + i im) exp(i angle).
  void add_wave(const series::Multiples& angle, const ComplexTaylor& c) {
    const series::Powers first = {{"k", 1}};
    terms_.push_back({series::packed(symbols_, first, angle, series::Trigonometric::cosine), c.re});
    terms_.push_back({series::packed(symbols_, first, angle, series::Trigonometric::sine), -c.im});
  }

  const series::Symbols& symbols_;
  const OrbitWaves& orbit_;
  std::vector<series::Term<ActionTaylor>> terms_;
};

}  // namespace

series::Series<ActionTaylor> gradient_series(const series::Symbols& symbols,
                                             const TurningTensor& tensor, const OrbitWaves& orbit,
                                             const SadovState& at, double strength) {
  const auto number = [](double x) { return ActionTaylor(x); };
  const ActionVariables actions(at);
  const ActionTaylor c = actions.I_h / actions.I_g, s2 = number(1.0) - c * c, s = sqrt(s2);
  const ActionTaylor plus = number(0.5) * (number(1.0) + c),
                     minus = number(0.5) * (number(1.0) - c);
  // With w = n_x + i n_y = plus exp(i u) + minus exp(-i u) and n_z = -s sin u, u = f - phi_h:
  // n.I n = d0 (3 n_z^2 - 1)/2 + 2 Re conj(D1) n_z w + Re conj(D2) w^2, D_m = d_m exp(i m phi_g).
  const std::array<std::vector<Attraction>, 3> pulls = {
      {{{number(0.5) * (number(1.5) * s2 - number(1.0)), 0, false}, {number(-0.75) * s2, 2, false}},
       {{-(s * c), 0, true}, {s * plus, 2, true}, {-(s * minus), -2, true}},
       {{number(0.5) * s2, 0, false}, {plus * plus, 2, false}, {minus * minus, -2, false}}}};
  GradientTerms terms(symbols, orbit);
  for (int m = 0; m < 3; ++m)
    for (const TensorWave& wave : tensor.waves[m]) {
      const ComplexTaylor conjugate{number(strength) * wave.re, -(number(strength) * wave.im)};
      for (const Attraction& pull : pulls[static_cast<std::size_t>(m)])
        terms.add(conjugate, wave.multiple, m, pull);
    }
  return std::move(terms).series();
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
