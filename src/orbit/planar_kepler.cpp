// SPDX-License-Identifier: MIT
// Kepler motion in its plane: at one time, by a table of the ellipse, and at many times.
#include <algorithm>
#include <array>
#include <cmath>

#include "orbit/detail/orbit_lanes.hpp"
#include "orbit/detail/tabulated_ellipse.hpp"
#include "polhode/orbit/kepler_orbit.hpp"

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

// src/orbit/lanes, one source for each set.
template <InstructionSet isa>
OrbitLanes orbit_kernels();
extern template OrbitLanes orbit_kernels<InstructionSet::baseline>();
#if defined(__x86_64__)
extern template OrbitLanes orbit_kernels<InstructionSet::avx2>();
extern template OrbitLanes orbit_kernels<InstructionSet::avx512>();
#endif

OrbitLanes orbit_lanes([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return orbit_kernels<InstructionSet::avx512>();
  if (set == InstructionSet::avx2) return orbit_kernels<InstructionSet::avx2>();
#endif
  return orbit_kernels<InstructionSet::baseline>();
}

}  // namespace detail

namespace {

// The fraction of a phase in turns, in [-1/2, 1/2].
DoubleDouble fraction(const DoubleDouble& turns) {
  DoubleDouble rest = turns - std::rint(turns.hi);
  rest = rest - std::rint(rest.hi);  // turns.hi beyond 2^53 leaves all to turns.lo
  return rest;
}

}  // namespace

PlanarKepler::PlanarKepler(const Shape& shape)
    : shape_(shape),
      rounded_{shape.eccentricity.e.hi, shape.eccentricity.complement.hi},
      hyperbola_(shape.eccentricity.e > DoubleDouble(1.0)),
      a_(shape.pericentre / shape.eccentricity.complement),
      b_(a_ * sqrt(shape.eccentricity.complement * (shape.eccentricity.e + 1.0))),
      frequency_(shape.mean_motion / DoubleDouble::two_pi()) {
  if (detail::TabulatedEllipse::serves(shape))
    table_ = std::make_shared<const detail::TabulatedEllipse>(shape);
}

DoubleDouble PlanarKepler::mean_anomaly(const DoubleDouble& t) const {
  const DoubleDouble elapsed = t - shape_.pericentre_time;
  if (hyperbola_) return shape_.mean_motion * elapsed;
  return DoubleDouble::two_pi() * fraction(frequency_ * elapsed);
}

PlanarKepler::Direction PlanarKepler::direction(double t, double rest) const {
  const double M = mean_anomaly(DoubleDouble::sum(t, rest)).hi;
  const KeplerAnomaly at = eccentric_anomaly(M, rounded_);
  return {at.sine, at.versine};
}

BasicKeplerAnomaly<DoubleDouble> PlanarKepler::anomaly(const DoubleDouble& t) const {
  return eccentric_anomaly(mean_anomaly(t), shape_.eccentricity);
}

inline BasicPlanarPoint<double> PlanarKepler::point_of(const Direction& at) const {
  return {shape_.pericentre.hi - a_.hi * at.versine, b_.hi * at.sine};
}

BasicPlanarPoint<double> PlanarKepler::solved_point(double t, double rest) const {
  return point_of(direction(t, rest));
}

BasicPlanarPoint<double> PlanarKepler::position(double t, double rest) const {
  return point(t, rest);
}

BasicPlanarPoint<DoubleDouble> PlanarKepler::position(const DoubleDouble& t) const {
  const auto at = anomaly(t);
  return {shape_.pericentre - a_ * at.versine, b_ * at.sine};
}

namespace {

// dE/dt = n / (|1 - e| + e (1 - cos E)), hyperbolas alike.
template <Real T>
BasicPlanarMotion<T> planar_motion(const T& sine, const T& versine, const T& q, const T& a,
                                   const T& b, const T& n, const BasicEccentricity<T>& e,
                                   bool hyperbola) {
  const T one(1.0);
  const T rate = n / (e.complement + e.e * versine);
  const T cosine = hyperbola ? one + versine : one - versine;
  return {{q - a * versine, b * sine}, {-(a * rate * sine), b * rate * cosine}};
}

}  // namespace

inline BasicPlanarMotion<double> PlanarKepler::motion_of(const Direction& at) const {
  return planar_motion<double>(at.sine, at.versine, shape_.pericentre.hi, a_.hi, b_.hi,
                               shape_.mean_motion.hi, rounded_, hyperbola_);
}

BasicPlanarMotion<double> PlanarKepler::motion(double t) const {
  if (table_ && table_->holds(t, 0.0)) {
    const BasicPlanarPoint<double> at = table_->at(t, 0.0);
    BasicPlanarMotion<double> motion =
        motion_of({at.y / b_.hi, (shape_.pericentre.hi - at.x) / a_.hi});
    motion.position = at;
    return motion;
  }
  return motion_of(direction(t, 0.0));
}

BasicPlanarMotion<DoubleDouble> PlanarKepler::motion(const DoubleDouble& t) const {
  const BasicKeplerAnomaly<DoubleDouble> at = anomaly(t);
  return planar_motion<DoubleDouble>(at.sine, at.versine, shape_.pericentre, a_, b_,
                                     shape_.mean_motion, shape_.eccentricity, hyperbola_);
}

detail::SteadyEllipse PlanarKepler::ellipse() const {
  return {frequency_,
          shape_.pericentre_time,
          rounded_.e,
          rounded_.complement,
          shape_.pericentre.hi,
          a_.hi,
          b_.hi};
}

// Rows of a table are looked up one by one: so many gathers would take as long.
void PlanarKepler::positions(const TimeRows& times, const PlanarRows& to,
                             InstructionSet set) const {
  if (table_ || hyperbola_) {
    for (std::size_t i = 0; i < times.count; ++i) {
      const BasicPlanarPoint<double> at = point(times.t[i], times.rest_of(i));
      to.x[i] = at.x;
      to.y[i] = at.y;
    }
    return;
  }
  const detail::OrbitLanes lanes = detail::orbit_lanes(set);
  detail::each_block(times, [&](const detail::LaneTimes& block) {
    detail::OrbitBlock x, y;
    lanes.points(ellipse(), block, {block.room(to.x, x), block.room(to.y, y)});
    block.take(to.x, x);
    block.take(to.y, y);
  });
}

void PlanarKepler::motions(const TimeRows& times, const PlanarRows& position,
                           const PlanarRows& velocity, InstructionSet set) const {
  const auto place = [&](std::size_t i, const BasicPlanarMotion<double>& at) {
    position.x[i] = at.position.x;
    position.y[i] = at.position.y;
    velocity.x[i] = at.velocity.x;
    velocity.y[i] = at.velocity.y;
  };
  if (table_ || hyperbola_) {
    for (std::size_t i = 0; i < times.count; ++i) place(i, motion(times.t[i]));
  } else {
    const detail::OrbitLanes lanes = detail::orbit_lanes(set);
    detail::each_block({times.count, times.t}, [&](const detail::LaneTimes& block) {
      detail::OrbitBlock sine, versine;
      lanes.directions(ellipse(), block, {sine.of, versine.of});
      for (std::size_t i = 0; i < block.count; ++i)
        place(block.first + i, motion_of({sine.of[i], versine.of[i]}));
    });
  }
}

}  // namespace v0
}  // namespace polhode
