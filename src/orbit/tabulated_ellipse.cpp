// SPDX-License-Identifier: MIT
#include "orbit/detail/tabulated_ellipse.hpp"

#include <algorithm>
#include <array>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t series_size = 13;
using Series = std::array<double, series_size>;

// cos E and sin E by powers of u, M = M_0 + u dM, from E' = 1 / (1 - e cos E).
struct Directions {
  Series cosine{}, sine{};
};

Directions directions(double cosine, double sine, double e, double dM) {
  Directions d;
  Series rate{};  // dE/dM
  d.cosine[0] = cosine;
  d.sine[0] = sine;
  const double inverse_slope = 1.0 / (1.0 - e * cosine);
  rate[0] = inverse_slope;
  for (std::size_t k = 0; k + 1 < series_size; ++k) {
    double along = 0.0, ahead = 0.0;
    for (std::size_t i = 0; i <= k; ++i) {
      along += d.sine[i] * rate[k - i];
      ahead += d.cosine[i] * rate[k - i];
    }
    const double step = dM / static_cast<double>(k + 1);
    d.cosine[k + 1] = -step * along;
    d.sine[k + 1] = step * ahead;
    double sum = 0.0;
    for (std::size_t i = 1; i <= k + 1; ++i) sum += d.cosine[i] * rate[k + 1 - i];
    rate[k + 1] = e * inverse_slope * sum;
  }
  return d;
}

// The powers from `size` on give way to the lower ones that are nearest to them in [-1/2, 1/2].
void economise(Series& c, std::size_t size) {
  for (std::size_t n = series_size; n-- > size;) {
    // T_n(2 u) / 2^(2n - 1) = u^n + lower powers
    double factor = 1.0;
    const auto degree = static_cast<double>(n);
    for (std::size_t k = n; k >= 2; k -= 2) {
      const auto a = static_cast<double>(k);
      factor *= -a * (a - 1.0) / (4.0 * (degree - a + 2.0) * (degree + a - 2.0));
      c[k - 2] -= c[n] * factor;
    }
  }
}

// log2 of the intervals of a turn.
int intervals_exponent(double e) {
  constexpr double ratio = 0.0095;  // half an interval over twice the distance of the singularity
  constexpr double half_turn = RealTraits<double>::pi();
  if (e < 0.2) return 7;
  const double distance = std::acosh(1.0 / e) - std::sqrt((1.0 - e) * (1.0 + e));
  return std::max(7, static_cast<int>(std::ceil(std::log2(half_turn / (2.0 * ratio * distance)))));
}

}  // namespace

bool TabulatedEllipse::serves(const PlanarKepler::Shape& shape) {
  return shape.eccentricity.e.hi <= largest_eccentricity &&
         TurnCounter::counts(shape.mean_motion / DoubleDouble::two_pi(), shape.pericentre_time);
}

TabulatedEllipse::TabulatedEllipse(const PlanarKepler::Shape& shape)
    : turns_(shape.mean_motion / DoubleDouble::two_pi(), shape.pericentre_time),
      row_bits_(intervals_exponent(shape.eccentricity.e.hi)),
      row_shift_(64 - row_bits_),
      rows_(std::size_t{1} << row_bits_) {
  const std::size_t n = rows_.size();
  rate_ = shape.mean_motion.hi * static_cast<double>(n) / (2.0 * RealTraits<double>::pi());
  for (std::size_t j = 0; j < n / 2; ++j) {
    const Row half = row(shape, j);
    rows_[j] = half;
    // x is even, y is odd; element k > 0 belongs to u^(k - 1).
    Row& other = rows_[n - 1 - j];
    other[0] = half[0] * Pair{1.0, -1.0};
    for (std::size_t k = 1; k < size; ++k)
      other[k] = half[k] * (k % 2 == 1 ? Pair{1.0, -1.0} : Pair{-1.0, 1.0});
  }
}

TabulatedEllipse::Row TabulatedEllipse::row(const PlanarKepler::Shape& shape, std::size_t j) const {
  const BasicEccentricity<DoubleDouble>& e = shape.eccentricity;
  const auto n = static_cast<double>(rows_.size());
  const DoubleDouble M = DoubleDouble::two_pi() * ((static_cast<double>(j) + 0.5) / n);
  // E to a rounding, then one step: what it misses is its square, 1e-31.
  const DoubleDouble E(eccentric_anomaly(M.hi, {e.e.hi, e.complement.hi}).anomaly);
  const auto near = sincos(E);
  const double missed = ((M - (E - e.e * near.sin)) / (1.0 - e.e * near.cos)).hi;
  const DoubleDouble cosine = near.cos - near.sin * missed, sine = near.sin + near.cos * missed;
  const DoubleDouble a = shape.pericentre / e.complement;
  const DoubleDouble b = a * sqrt(e.complement * (e.e + 1.0));
  Directions d = directions(cosine.hi, sine.hi, e.e.hi, DoubleDouble::two_pi().hi / n);
  // All that is added to the exact values
  d.cosine[0] = d.sine[0] = 0.0;
  economise(d.cosine, size - 1);
  economise(d.sine, size - 1);
  const DoubleDouble x = shape.pericentre - a * (1.0 - cosine) + a * d.cosine[0];
  const DoubleDouble y = b * (sine + d.sine[0]);
  Row r{Pair{x.hi, y.hi}, Pair{x.lo, y.lo}};
  for (std::size_t k = 1; k + 1 < size; ++k) r[k + 1] = Pair{a.hi * d.cosine[k], b.hi * d.sine[k]};
  return r;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
