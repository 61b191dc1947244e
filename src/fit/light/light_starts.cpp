// SPDX-License-Identifier: MIT
#include "fit/detail/light_starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/detail/light_residuals.hpp"
#include "polhode/ensemble/counter_random.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Bodies of one tilt that are looked at, and tilts that are drawn until one has a body.
constexpr std::size_t bodies_of_tilt = 6;
constexpr int most_tilts = 12;
// Thinner bodies are no start; a fit may come to them.
constexpr double least_start_ratio = 0.15;

class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t member)
      : random_(seed, key_of("search_light")), member_(member) {}
  double uniform() { return random_.uniform(member_, next_++); }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  std::size_t below(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(uniform() * static_cast<double>(n)));
  }
  Quaternion attitude() {
    const double u0 = uniform(), u1 = uniform(), u2 = uniform();
    return UniformAttitude().from_uniform(u0, u1, u2);
  }

 private:
  CounterRandom random_;
  std::uint64_t member_;
  std::uint64_t next_ = 0;
};

bool is_thick(const TumblingBody& body) {
  const Ellipsoid e = homogeneous_ellipsoid(body.body.moments(), 1.0);
  return e.c >= least_start_ratio * e.a && e.b >= least_start_ratio * e.a;
}

// The rate in principal axes at a phase of the polhode, with the shape.
std::optional<BrightEllipsoid> drawn_body(const LightSearch& search, const TumblerPeriods& periods,
                                          Draws& draws) {
  for (int k = 0; k < most_tilts; ++k) {
    const double tilt = draws.between(0.05, 0.5 * pi<double>() - 0.05);
    std::vector<TumblingBody> bodies = bodies_with_periods(periods, tilt, bodies_of_tilt);
    std::erase_if(bodies, [](const TumblingBody& b) { return !is_thick(b); });
    const double part = draws.uniform();
    const std::size_t which = draws.below(bodies.empty() ? 1 : bodies.size());
    if (bodies.empty()) continue;
    const TumblingBody& chosen = bodies[which];
    const FreeRotation motion = FreeRotation::short_arc(chosen.body, chosen.state);
    const Vec3 g = motion.at(part * periods.rotation_period).g, I = chosen.body.moments();
    const Ellipsoid e = homogeneous_ellipsoid(I, 1.0);
    return BrightEllipsoid::homogeneous(epoch_of(search.curves), {},
                                        {g.x / I.x, g.y / I.y, g.z / I.z},
                                        {1.0, e.b / e.a, e.c / e.a}, search.law);
  }
  return std::nullopt;
}

}  // namespace

double epoch_of(std::span<const LightCurve> curves) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const LightCurve& curve : curves) {
    for (const LightPoint& p : curve.points) {
      first = std::min(first, p.t);
      last = std::max(last, p.t);
    }
  }
  return first + 0.5 * (last - first);
}

std::optional<LightTrial> light_trial(const LightSearch& search, std::uint64_t number) {
  Draws draws(search.seed, number);
  const TumblerPeriods& periods = search.periods[number % search.periods.size()];
  std::optional<BrightEllipsoid> body = drawn_body(search, periods, draws);
  if (!body) return std::nullopt;
  // One motion, turned as a whole: q_IB(t) = q p(t).
  const LightResiduals looked_at(search.curves, search.unknowns, *body, search.loss);
  std::vector<MotionPoint> motion, turned;
  if (!free_motion(body->spin, looked_at.curves().times(), {}, motion)) return std::nullopt;
  turned = motion;
  std::vector<double> B(looked_at.points());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < search.tries; ++k) {
    const Quaternion q = draws.attitude();
    for (std::size_t i = 0; i < motion.size(); ++i) turned[i].q = q * motion[i].q;
    if (!looked_at.brightness_of(*body, turned, B)) continue;
    const double cost = looked_at.curves().cost(B);
    if (!(cost < least)) continue;
    least = cost;
    body->spin.q = q;
  }
  const LightResiduals residuals(search.curves, search.unknowns, *body, search.loss, Rows::held);
  const LeastSquaresResult result =
      solve(light_problem(residuals, search.unknowns, *body, search.short_iterations));
  if (result.end == LeastSquaresResult::End::no_value) return std::nullopt;
  return LightTrial{residuals.body_at(result.x), result.cost};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
