// SPDX-License-Identifier: MIT
// Searches of light curves: random starts of given periods, then fits of the best.
#include "polhode/fit/light_search.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "fit/detail/distinct_solutions.hpp"
#include "fit/detail/light_outcome.hpp"
#include "fit/detail/light_starts.hpp"
#include "fit/light/search_checks.hpp"
#include "fit/light/search_progress.hpp"
#include "fit/result_bytes.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/ensemble/draws.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

class Draws {
 public:
  Draws(const LightSearch& search, std::uint64_t member)
      // of a known body as drawn before meshes had the same search
      : random_(search.seed, ensemble::key_of(search.body ? "search_mesh" : "search_light")),
        member_(member) {}
  double uniform() { return random_.uniform(member_, next_++); }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  std::size_t below(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(uniform() * static_cast<double>(n)));
  }
  Quaternion attitude() {
    const double u0 = uniform(), u1 = uniform(), u2 = uniform();
    return ensemble::UniformAttitude().from_uniform(u0, u1, u2);
  }

 private:
  ensemble::CounterRandom random_;
  std::uint64_t member_;
  std::uint64_t next_ = 0;
};

namespace {

// Bodies of one tilt that are looked at, and tilts that are drawn until one has a body.
constexpr std::size_t bodies_of_tilt = 6;
constexpr int most_tilts = 12;
// Thinner bodies are no start; a fit may come to them.
constexpr double least_start_ratio = 0.15;

// Points that an attitude of a known body is tried on, about, and the least of a session.
constexpr std::size_t most_looked_at = 60, least_of_session = 10;

bool is_thick(const TumblingBody& body) {
  const light::Ellipsoid e = light::homogeneous_ellipsoid(body.body.moments(), 1.0);
  return e.c >= least_start_ratio * e.a && e.b >= least_start_ratio * e.a;
}

// The rate in principal axes at a phase of the polhode, with the shape.
std::optional<LightModel> drawn_body(const LightSearch& search, const TumblerPeriods& periods,
                                     Draws& draws) {
  for (int k = 0; k < most_tilts; ++k) {
    const double tilt = draws.between(0.05, 0.5 * pi<double>() - 0.05);
    std::vector<TumblingBody> bodies = inertia_from_periods(periods, tilt, bodies_of_tilt);
    std::erase_if(bodies, [](const TumblingBody& b) { return !is_thick(b); });
    const double part = draws.uniform();
    const std::size_t which = draws.below(bodies.empty() ? 1 : bodies.size());
    if (bodies.empty()) continue;
    const TumblingBody& chosen = bodies[which];
    const FreeRotation motion = FreeRotation::short_arc(chosen.body, chosen.state);
    const Vec3 g = motion.at(part * periods.rotation_period).g, I = chosen.body.moments();
    const light::Ellipsoid e = light::homogeneous_ellipsoid(I, 1.0);
    return LightModel::homogeneous(epoch_of(search.curves), {}, {g.x / I.x, g.y / I.y, g.z / I.z},
                                   {1.0, e.b / e.a, e.c / e.a}, search.law);
  }
  return std::nullopt;
}

// Evenly spread points of each session, so that there are not many; but as many as say something of
// a session whose factor is its own.
std::vector<light::LightCurve> thinned(const std::vector<light::LightCurve>& curves) {
  std::size_t count = 0;
  for (const light::LightCurve& curve : curves) count += curve.points.size();
  std::vector<light::LightCurve> few;
  for (const light::LightCurve& curve : curves) {
    const std::size_t size = curve.points.size();
    const std::size_t share = (most_looked_at * size + count - 1) / count;
    const std::size_t taken = std::min(size, std::max(share, least_of_session));
    light::LightCurve kept{curve.name, curve.is_calibrated, {}};
    for (std::size_t i = 0; i < taken; ++i) kept.points.push_back(curve.points[i * size / taken]);
    few.push_back(std::move(kept));
  }
  return few;
}

// The motions of a body with a pair of periods, the momentum along the third inertial axis: on both
// sides of the axis of circulation. None where the body has no such motion.
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

}  // namespace

double epoch_of(std::span<const light::LightCurve> curves) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const light::LightCurve& curve : curves) {
    for (const light::LightPoint& p : curve.points) {
      first = std::min(first, p.t);
      last = std::max(last, p.t);
    }
  }
  return first + 0.5 * (last - first);
}

LightStarts::LightStarts(const LightSearch& search) : search_(search) {
  if (!search.body) return;
  known_ = Body::from_tensor(search.body->spin.inertia_F);
  looked_at_ = thinned(search.curves);
  for (const TumblerPeriods& p : search.periods) motions_.push_back(motions_of(*known_, p));
}

std::size_t LightStarts::pairs_without_motion() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(motions_, [](const auto& sides) { return sides.empty(); }));
}

std::optional<LightTrial> LightStarts::trial(std::uint64_t number, const LightUnknowns& unknowns,
                                             int iterations) const {
  Draws draws(search_, number);
  const std::size_t pair = number % search_.periods.size();
  std::optional<LightModel> body =
      known_ ? known_body(pair, draws) : drawn_body(search_, search_.periods[pair], draws);
  if (!body) return std::nullopt;
  LightFit fit{known_ ? looked_at_ : search_.curves, *body, unknowns, search_.loss, iterations};
  const auto best = best_attitude(fit, search_.tries, [&] {
    if (search_.between) search_.between();
    return draws.attitude();
  });
  if (!best) return std::nullopt;
  fit.start.spin.q = best->first;
  if (!known_) return fit_shortly(fit);
  fit.curves = search_.curves;
  const LightSolution found = fit_light(fit);
  if (found.result.end == LeastSquaresResult::End::no_value) return std::nullopt;
  return LightTrial{found.body, found.result.cost};
}

// At a phase of one of its polhodes.
std::optional<LightModel> LightStarts::known_body(std::size_t pair, Draws& draws) const {
  const std::vector<FreeRotation>& sides = motions_[pair];
  if (sides.empty()) return std::nullopt;
  const FreeRotation& motion = sides[draws.uniform() < 0.5 ? 0 : sides.size() - 1];
  const Vec3 g = motion.at(draws.uniform() * motion.polhode_period()).g, I = known_->moments();
  LightModel body = *search_.body;
  body.spin.t0 = epoch_of(search_.curves);
  body.spin.q = {};
  body.spin.w_F = rotate(known_->q_FB(), Vec3{g.x / I.x, g.y / I.y, g.z / I.z});
  return body;
}

}  // namespace detail

namespace {

using detail::LightTrial;
using detail::more_short_iterations;
using detail::starts_of_round;
using detail::times;

// Factor of the iterations with which an unfinished fit goes on.
constexpr int more_search_iterations = 4;

// Where a fit begins, and for which pair of periods.
struct Finalist {
  LightModel start;
  std::size_t periods;
};

// Fewer unknowns first, up to those that are asked for: each begins where the one before it ended,
// so that none ends higher. Of a known body all at once.
std::vector<LightUnknowns> models_of(const LightSearch& search) {
  LightUnknowns model = search.unknowns;
  if (search.body) {
    model.shape = false;
    if (model.moments == MomentSource::shape) model.moments = MomentSource::start;  // known as well
    return {model};
  }
  if (model.moments == MomentSource::fit) model.moments = MomentSource::shape;
  model.multiple = false;
  std::vector<LightUnknowns> models{model};
  if (search.unknowns.multiple) {
    model.multiple = true;
    models.push_back(model);
  }
  if (search.unknowns.moments == MomentSource::fit) models.push_back(search.unknowns);
  return models;
}

class Search {
 public:
  explicit Search(const LightSearch& search)
      : search_(search),
        is_known_(search.body.has_value()),
        starts_(search),
        geometry_(detail::geometry_of(search.curves)),
        finds_(search.curves, search.periods.size(), search.within, {},
               !is_known_ || search.body->is_ellipsoid()),
        progress_(search) {}

  LightSearchResult found() {
    const std::vector<LightUnknowns> models = models_of(search_);
    begin(models.front());
    progress_.further_models = models.size() - 1;
    progress_.rounds_are_done = is_known_;
    add_finalists();
    if (!is_known_) add_rounds();
    const std::size_t seldom = finds_.seldom();
    progress_.images_are_done = true;
    fit(images());
    for (std::size_t m = 1; m < models.size(); ++m) {
      const std::vector<Finalist> starts = ends();
      begin(models[m]);
      --progress_.further_models;
      fit(starts);
    }
    progress_.end();
    finds_.move_to(result_);
    if (is_known_)
      add_notes_of_known();
    else
      add_notes(seldom);
    if (result_.solutions.empty())
      result_.failure = result_.notes.empty() ? "no fit converged" : result_.notes.front();
    return std::move(result_);
  }

 private:
  using Trials = std::vector<std::vector<LightTrial>>;

  void begin(const LightUnknowns& model) {
    model_ = model;
    finds_.begin([model, base = geometry_.time_base](const FoundLight& a, const FoundLight& b) {
      return detail::are_same(a, b, model, base);
    });
  }

  // Short fits of the starts with these numbers, by pair of periods; about `fits` of them will be
  // fitted to the end.
  Trials trials(const std::vector<std::uint64_t>& numbers, int iterations, double fits) {
    LightUnknowns unknowns = model_;
    if (is_known_) unknowns.moments = MomentSource::start;
    Trials found(search_.periods.size());
    tried_ += numbers.size();
    ensemble::ordered_parallel_for(
        search_.journal, std::ssize(numbers), search_.threads,
        [&](std::int64_t k) {
          return starts_.trial(numbers[static_cast<std::size_t>(k)], unknowns, iterations);
        },
        [&](std::int64_t k, const std::optional<LightTrial>& trial) {
          if (trial && finds_.all().empty()) progress_.add_cost(trial->cost);
          progress_.add_start(iterations, static_cast<double>(std::ssize(numbers) - k - 1), fits,
                              finds_);
          if (!trial) return;
          ++result_.starts;
          const std::uint64_t number = numbers[static_cast<std::size_t>(k)];
          found[static_cast<std::size_t>(number % search_.periods.size())].push_back(*trial);
        },
        [this](Archive& bytes, std::optional<LightTrial>& trial) {
          detail::serialize(bytes, trial, search_.body);
        });
    return found;
  }

  // Of each pair of periods the best, and after it the next best that is unlike those taken.
  void add_finalists() {
    std::vector<std::uint64_t> numbers(search_.starts);
    std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
    const std::size_t most = search_.finalists * search_.periods.size();
    Trials all = trials(numbers, search_.short_iterations,
                        static_cast<double>(std::min(most, numbers.size())));
    std::vector<Finalist> found;
    const auto are_alike = [](const LightTrial& a, const LightTrial& b) {
      return detail::are_alike(a.body, b.body);
    };
    for (std::size_t p = 0; p < all.size(); ++p)
      for (const LightTrial& t :
           detail::best_unlike(std::move(all[p]), search_.finalists, are_alike))
        found.push_back({t.body, p});
    fit(found);
  }

  // More starts of the pairs of periods near the limit, until no solution within it was found by
  // one start alone: what is still unseen would then be found by few starts (Good 1953).
  void add_rounds() {
    const std::size_t pairs = search_.periods.size();
    std::vector<std::uint64_t> next(pairs);
    for (std::size_t p = 0; p < pairs; ++p)
      next[p] = p + (search_.starts + pairs - 1 - p) / pairs * pairs;
    for (int round = 0; round < detail::DistinctSolutions::most_rounds; ++round) {
      const std::vector<std::size_t> open = finds_.open_pairs(round);
      if (open.empty()) break;
      progress_.open_pairs = open.size();
      progress_.round = round + 1;
      std::vector<std::uint64_t> numbers;
      for (std::size_t k = 0; k < starts_of_round; ++k)
        for (const std::size_t p : open) {
          numbers.push_back(next[p]);
          next[p] += pairs;
        }
      const Trials all = trials(numbers, times(search_.short_iterations, more_short_iterations),
                                progress_.part_near * static_cast<double>(numbers.size()));
      std::vector<Finalist> found;
      for (const std::size_t p : open)
        for (const LightTrial& t : all[p])
          if (finds_.is_near(t.cost)) found.push_back({t.body, p});
      progress_.part_near = static_cast<double>(found.size()) / static_cast<double>(numbers.size());
      fit(found);
    }
    progress_.rounds_are_done = true;
  }

  std::vector<Finalist> images() const {
    std::vector<Finalist> found;
    for (const FoundLight& f : finds_.within_limit()) {
      for (const LightImage i : {LightImage::normal, LightImage::bisector, LightImage::difference})
        found.push_back(
            {image_of(f.solution.body, i, geometry_.to_sun, geometry_.to_observer), f.periods});
    }
    return found;
  }

  // What a model with more unknowns begins with: the best of each pair of periods, and all
  // solutions near the limit.
  std::vector<Finalist> ends() const {
    std::vector<Finalist> found;
    for (std::size_t p = 0; p < search_.periods.size(); ++p)
      if (const auto& best = finds_.best_of(p)) found.push_back({best->body, p});
    for (const FoundLight& f : finds_.all()) {
      const double cost = f.solution.result.cost;
      if (finds_.is_near(cost) && cost > finds_.best_of(f.periods)->result.cost)
        found.push_back({f.solution.body, f.periods});
    }
    return found;
  }

  // What has not come to its end goes on where it is near the limit, or the lowest of its pair of
  // periods.
  void fit(const std::vector<Finalist>& finalists) {
    fit(finalists, search_.most_iterations, !is_known_);
    result_.finalists += finalists.size();
    if (is_known_) return;
    std::ranges::stable_sort(unfinished_, {}, [](const auto& u) { return u.first; });
    std::vector<bool> has_one(search_.periods.size());
    std::vector<Finalist> longer;
    for (const auto& [cost, finalist] : unfinished_) {
      const std::optional<LightSolution>& best = finds_.best_of(finalist.periods);
      const bool is_lowest = !has_one[finalist.periods] && (!best || cost < best->result.cost);
      if (!is_lowest && !finds_.is_near(cost)) continue;
      has_one[finalist.periods] = true;
      longer.push_back(finalist);
    }
    unfinished_.clear();
    fit(longer, times(search_.most_iterations, more_search_iterations), false);
  }

  // A known body has its known law.
  LightModel start_of(const LightModel& from) const {
    if (!is_known_) return from;
    return {from.spin, search_.body->shape, search_.body->law};
  }

  // Keeps what has not come to its end where `goes_on`.
  void fit(const std::vector<Finalist>& finalists, int most_iterations, bool goes_on) {
    ensemble::ordered_parallel_for(
        search_.journal, std::ssize(finalists), search_.threads,
        [&](std::int64_t k) {
          if (search_.between) search_.between();
          const LightModel& from = finalists[static_cast<std::size_t>(k)].start;
          return fit_light({search_.curves, start_of(from), model_, search_.loss, most_iterations});
        },
        [&](std::int64_t k, const LightSolution& s) {
          progress_.add_fit(s.result.iterations, static_cast<double>(std::ssize(finalists) - k - 1),
                            finds_);
          const std::size_t periods = finalists[static_cast<std::size_t>(k)].periods;
          if (s.is_found())
            finds_.add(s, periods);
          else if (goes_on && s.result.end == LeastSquaresResult::End::iteration_limit)
            unfinished_.push_back({s.result.cost, {s.body, periods}});
        },
        [this](Archive& bytes, LightSolution& s) { detail::serialize(bytes, s, search_.body); });
  }

  void add_notes_of_known() {
    const std::size_t without = starts_.pairs_without_motion(), pairs = search_.periods.size();
    if (without > 0)
      result_.notes.push_back("the body has no motion with " + std::to_string(without) + " of " +
                              std::to_string(pairs) +
                              (pairs == 1 ? " pair of periods" : " pairs of periods"));
    if (result_.starts > 0 && result_.solutions.empty())
      result_.notes.push_back("no fit converged: more starts, more iterations, or other periods");
  }

  void add_notes(std::size_t seldom) {
    const bool has_best = std::ranges::any_of(result_.best_of_periods,
                                              [](const auto& best) { return best.has_value(); });
    if (result_.starts == 0)
      result_.notes.push_back("no ellipsoid thicker than 1 : 6.7 has any of these periods");
    else if (result_.solutions.empty() && has_best)
      result_.notes.push_back(
          "fits with law or moments unknown did not converge; without them there are solutions");
    else if (result_.solutions.empty())
      result_.notes.push_back("no fit converged: more starts, more iterations, or other periods");
    if (seldom > 0)
      result_.notes.push_back((seldom == 1
                                   ? std::string("1 solution within the limit was")
                                   : std::to_string(seldom) + " solutions within the limit were") +
                              " found from a single start (images counted as one): other starts "
                              "may find more");
    const std::size_t without = tried_ - result_.starts;
    if (without > 0 && result_.starts > 0)
      result_.notes.push_back(
          std::to_string(without) + " of " + std::to_string(tried_) +
          " starts found no body with their periods whose light can be computed");
  }

  const LightSearch& search_;
  bool is_known_;  // the body
  detail::LightStarts starts_;
  detail::LightGeometry geometry_;
  detail::DistinctSolutions finds_;
  detail::SearchProgress progress_;
  LightUnknowns model_;
  std::size_t tried_ = 0;
  std::vector<std::pair<double, Finalist>> unfinished_;  // with their costs
  LightSearchResult result_;
};

// Says what is wrong with a surface before the starts do; `any` is an ellipsoid.
void check_surface(const LightSearch& search, const LightModel& any) {
  if (!search.surface) return;
  const SurfaceSearch& s = *search.surface;
  if (s.mesh && !s.mesh->is_mesh())
    throw DomainError("search_light: a surface that is known must be a mesh");
  detail::require_at_least_one("search_light: ", "most_iterations", s.most_iterations);
  const LightModel start =
      s.mesh
          ? LightModel{{0.0, {}, any.spin.w_F, s.mesh->spin.inertia_F}, s.mesh->shape, s.mesh->law}
          : s.convex_of(any);
  static_cast<void>(least_squares_of(s.fit_from(start, search.curves, search.loss, 1)));
}

}  // namespace

LightSearchResult search_light(const LightSearch& search) {
  detail::check_search("search_light: ", search);
  if (search.body && search.surface)
    throw DomainError("search_light: a known body has no ellipsoids that a surface could follow");
  // says what is wrong with law, moments and unknowns before the starts do
  LightModel any = LightModel::homogeneous(0.0, {}, {1.0, 1.0, 1.0}, {1.0, 0.8, 0.6}, search.law);
  LightUnknowns unknowns = search.unknowns;
  if (search.body) {
    any = {
        {0.0, {}, any.spin.w_F, search.body->spin.inertia_F}, search.body->shape, search.body->law};
    unknowns.shape = false;
  }
  static_cast<void>(least_squares_of(LightFit{search.curves, any, unknowns, search.loss}));
  check_surface(search, any);
  if (search.begins)
    search.begins("search", polhode::detail::counted(search.starts, "start", "starts") + " of " +
                                polhode::detail::counted(search.periods.size(), "pair of periods",
                                                         "pairs of periods"));
  LightSearchResult found = Search(search).found();
  if (search.surface) detail::fit_surfaces(search, found);
  return found;
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
