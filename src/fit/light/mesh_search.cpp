// SPDX-License-Identifier: MIT
#include "polhode/fit/mesh_search.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "fit/detail/distinct_solutions.hpp"
#include "fit/detail/light_outcome.hpp"
#include "fit/detail/light_starts.hpp"
#include "fit/detail/weighed_curves.hpp"
#include "fit/free_motion.hpp"
#include "fit/light/search_checks.hpp"
#include "fit/light_states.hpp"
#include "fit/result_bytes.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/ensemble/counter_random.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/error.hpp"
#include "polhode/free/tumbler.hpp"

namespace polhode {
inline namespace v0 {
namespace {

const std::string search_name = "search_mesh: ";
// Points that an attitude is tried on, about, and the least of a session.
constexpr std::size_t most_looked_at = 60, least_of_session = 10;
// States this near are alike, in rad and of the rate: fits from both would most likely meet.
constexpr double alike_turn = 0.25, alike_rate = 0.03;
constexpr std::array<LightImage, 3> images{LightImage::normal, LightImage::bisector,
                                           LightImage::difference};

// Evenly spread points of each session, so that there are not many; but as many as say something of
// a session whose factor is its own.
std::vector<LightCurve> thinned(const std::vector<LightCurve>& curves) {
  std::size_t count = 0;
  for (const LightCurve& curve : curves) count += curve.points.size();
  std::vector<LightCurve> few;
  for (const LightCurve& curve : curves) {
    const std::size_t size = curve.points.size();
    const std::size_t share = (most_looked_at * size + count - 1) / count;
    const std::size_t taken = std::min(size, std::max(share, least_of_session));
    LightCurve kept{curve.name, curve.is_calibrated, {}};
    for (std::size_t i = 0; i < taken; ++i) kept.points.push_back(curve.points[i * size / taken]);
    few.push_back(std::move(kept));
  }
  return few;
}

// The motions of the body with a pair of periods, the momentum along the third inertial axis: on
// both sides of the axis of circulation. None where the body has no such motion.
std::vector<FreeRotation> motions_of(const Body& body, const TumblerPeriods& periods) {
  std::vector<FreeRotation> found;
  for (const int side : {1, -1}) {
    TumblerState t{periods.precession_period,
                   periods.rotation_period,
                   {0.0, 0.0, 1.0},
                   periods.mode,
                   0.0,
                   0.0};
    (periods.mode == Regime::long_axis ? t.branch : t.sense) = side;
    try {
      found.emplace_back(body, to_rotor(body, t));
    } catch (const DomainError&) {  // no motion of this body has them
    }
  }
  return found;
}

bool are_alike(const SpinState& a, const SpinState& b) {
  return norm(attitude_residual(a.q, b.q)) < alike_turn &&
         norm(b.w_F - a.w_F) < alike_rate * norm(a.w_F);
}

// That of the same moments, as far as there is one.
Ellipsoid ellipsoid_like(const Mat3& inertia) {
  try {
    const Vec3 I = Body::from_tensor(inertia).moments();
    double all[3] = {I.x, I.y, I.z};
    std::ranges::sort(all);
    const Ellipsoid e = homogeneous_ellipsoid(Vec3{all[0], all[1], all[2]}, 1.0);
    return {1.0, e.b / e.a, e.c / e.a};
  } catch (const DomainError&) {
    return {1.0, 1.0, 1.0};
  }
}

struct Start {
  SpinState spin;
  std::size_t periods;
  double cost;
};

class Search {
 public:
  explicit Search(const MeshSearch& search)
      : search_(search),
        body_(Body::from_tensor(search.body.spin.inertia_F)),
        epoch_(detail::epoch_of(search.curves)),
        geometry_(detail::geometry_of(search.curves)),
        looked_at_(thinned(search.curves), search.loss),
        finds_(
            search.curves, search.periods.size(), search.within,
            [base = geometry_.time_base](const LightSolution& a, const LightSolution& b) {
              return detail::are_same_spins(a, b, base);
            },
            false) {
    for (const TumblerPeriods& p : search.periods) motions_.push_back(motions_of(body_, p));
  }

  LightSearchResult found() {
    fit(finalists());
    fit(image_starts());
    finds_.move_to(result_);
    add_notes();
    return std::move(result_);
  }

 private:
  // The best attitude that was tried for a phase of a polhode, after a few iterations.
  std::optional<Start> start(std::uint64_t number) const {
    const std::size_t pair = number % search_.periods.size();
    const std::vector<FreeRotation>& sides = motions_[pair];
    if (sides.empty()) return std::nullopt;
    const CounterRandom random(search_.seed, key_of("search_mesh"));
    std::uint64_t next = 0;
    const auto uniform = [&] { return random.uniform(number, next++); };
    const FreeRotation& motion = sides[uniform() < 0.5 ? 0 : sides.size() - 1];
    const Vec3 g = motion.at(uniform() * motion.polhode_period()).g, I = body_.moments();
    // One motion, turned as a whole.
    SpinState spin{epoch_,
                   {},
                   rotate(body_.q_FB(), Vec3{g.x / I.x, g.y / I.y, g.z / I.z}),
                   search_.body.spin.inertia_F};
    std::vector<detail::MotionPoint> points;
    if (!detail::free_motion(spin, looked_at_.times(), {}, points)) return std::nullopt;
    std::vector<double> B(points.size());
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < search_.tries; ++k) {
      if (search_.between) search_.between();
      const double u0 = uniform(), u1 = uniform(), u2 = uniform();
      const Quaternion q = UniformAttitude().from_uniform(u0, u1, u2);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Quaternion back = conj(q * points[i].q);
        B[i] = search_.body.shape.brightness(search_.body.law, rotate(back, looked_at_[i].to_sun),
                                             rotate(back, looked_at_[i].to_observer));
      }
      const double cost = looked_at_.cost(B);
      if (!(cost < least)) continue;
      least = cost;
      spin.q = q;
    }
    MeshFit fit = fit_from(spin, search_.short_iterations);
    fit.moments = MomentSource::start;
    const MeshSolution found = fit_mesh(fit);
    if (found.result.end == LeastSquaresResult::End::no_value) return std::nullopt;
    return Start{found.body.spin, pair, found.result.cost};
  }

  MeshFit fit_from(const SpinState& spin, int most_iterations) const {
    return {.curves = search_.curves,
            .start = {spin, search_.body.shape, search_.body.law},
            .moments = search_.moments,
            .multiple = search_.multiple,
            .loss = search_.loss,
            .most_iterations = most_iterations};
  }

  // Of each pair of periods the best, and after it the next best that is unlike those taken.
  std::vector<Start> finalists() {
    std::vector<std::vector<Start>> all(search_.periods.size());
    ordered_parallel_for(
        search_.journal, static_cast<std::int64_t>(search_.starts), search_.threads,
        [&](std::int64_t k) { return start(static_cast<std::uint64_t>(k)); },
        [&](std::int64_t, const std::optional<Start>& one) {
          if (!one) return;
          ++result_.starts;
          all[one->periods].push_back(*one);
        },
        [](Archive& bytes, std::optional<Start>& one) {
          bool is_there = one.has_value();
          bytes(is_there);
          if (bytes.reads() && is_there) one.emplace();
          if (!is_there) return;
          detail::serialize(bytes, one->spin);
          bytes.all(one->periods, one->cost);
        });
    std::vector<Start> taken;
    const auto alike = [](const Start& a, const Start& b) { return are_alike(a.spin, b.spin); };
    for (std::vector<Start>& of_pair : all)
      for (const Start& one : detail::best_unlike(std::move(of_pair), search_.finalists, alike))
        taken.push_back(one);
    return taken;
  }

  std::vector<Start> image_starts() const {
    std::vector<Start> starts;
    for (const FoundLight& f : finds_.within_limit()) {
      for (const LightImage i : images) {
        const EllipsoidModel image =
            image_of(f.solution.body, i, geometry_.to_sun, geometry_.to_observer);
        starts.push_back({image.spin, f.periods, 0.0});
      }
    }
    return starts;
  }

  void fit(const std::vector<Start>& starts) {
    result_.finalists += starts.size();
    ordered_parallel_for(
        search_.journal, std::ssize(starts), search_.threads,
        [&](std::int64_t k) {
          if (search_.between) search_.between();
          const Start& from = starts[static_cast<std::size_t>(k)];
          MeshSolution found = fit_mesh(fit_from(from.spin, search_.most_iterations));
          LightSolution one;
          one.body = {found.body.spin, ellipsoid_like(found.body.spin.inertia_F), found.body.law};
          static_cast<LightOutcome&>(one) = std::move(found);
          return one;
        },
        [&](std::int64_t k, const LightSolution& s) {
          if (s.is_found()) finds_.add(s, starts[static_cast<std::size_t>(k)].periods);
        },
        [](Archive& bytes, LightSolution& s) { detail::serialize(bytes, s); });
  }

  void add_notes() {
    const auto without = std::ranges::count_if(motions_, [](const auto& m) { return m.empty(); });
    if (without > 0)
      result_.notes.push_back("the body has no motion with " + std::to_string(without) + " of " +
                              std::to_string(motions_.size()) +
                              (motions_.size() == 1 ? " pair of periods" : " pairs of periods"));
    if (result_.starts > 0 && result_.solutions.empty())
      result_.notes.push_back("no fit converged: more starts, more iterations, or other periods");
  }

  const MeshSearch& search_;
  Body body_;
  double epoch_;
  detail::LightGeometry geometry_;
  detail::WeighedCurves looked_at_;
  detail::DistinctSolutions finds_;
  std::vector<std::vector<FreeRotation>> motions_;  // of each pair of periods
  LightSearchResult result_;
};

}  // namespace

LightSearchResult search_mesh(const MeshSearch& search) {
  detail::check_search(search_name, search);
  // says what is wrong with moments and law before the starts do
  MeshFit first{.curves = search.curves,
                .start = search.body,
                .moments = search.moments,
                .multiple = search.multiple,
                .loss = search.loss};
  first.start.spin.t0 = 0.0;
  first.start.spin.q = {1.0, 0.0, 0.0, 0.0};
  first.start.spin.w_F = {1.0, 1.0, 1.0};
  static_cast<void>(least_squares_of(first));
  return Search(search).found();
}

}  // namespace v0
}  // namespace polhode
