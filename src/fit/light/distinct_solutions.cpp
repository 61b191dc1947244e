// SPDX-License-Identifier: MIT
// The distinct solutions of a search of light curves, and how they are related.
#include "fit/detail/distinct_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "fit/light_states.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

namespace detail {
namespace {

// States this near are alike: in rad, of the rate, and of ratios of axes.
constexpr double alike_turn = 0.25, alike_rate = 0.03, alike_ratio = 0.1;
// What two fits to one least differ by at most, where errors are small.
constexpr double same_turn = 1e-3, same_rate = 1e-5, same_ratio = 1e-3;
// Turns over the time base by which frequencies are told apart.
constexpr double apart = 0.25;

const char* mode_text(Regime mode) {
  switch (mode) {
    case Regime::long_axis:
      return "long-axis mode";
    case Regime::short_axis:
      return "short-axis mode";
    default:
      return "no tumbling";
  }
}

const char* image_text(LightImage image) {
  switch (image) {
    case LightImage::normal:
      return "the normal of the plane of Sun and observer (the mirror pole)";
    case LightImage::bisector:
      return "the bisector of Sun and observer";
    default:
      return "the difference of the directions to Sun and observer";
  }
}

double turns_apart(double period, double other, double time_base) {
  if (!(period > 0.0) || !(other > 0.0)) return period == other ? 0.0 : apart * 2.0;
  return std::abs(1.0 / period - 1.0 / other) * time_base;
}

bool same_periods(const TumblerPeriods& a, const TumblerPeriods& b, double time_base) {
  return turns_apart(a.precession_period, b.precession_period, time_base) < apart &&
         turns_apart(a.rotation_period, b.rotation_period, time_base) < apart;
}

// How far a state is from another, in rad and of the rate, in units of what is still alike.
double spins_apart(const SpinState& a, const SpinState& b) {
  return std::max(norm(attitude_residual(a.q, b.q)) / alike_turn,
                  norm(b.w_F - a.w_F) / (alike_rate * norm(a.w_F)));
}

// The same for ellipsoids, with their ratios of axes.
double distance_of(const LightModel& a, const LightModel& other, bool half_turns) {
  const LightModel b = half_turns ? nearest_of_same(a, other) : other;
  const light::Ellipsoid &e = a.ellipsoid(), &f = b.ellipsoid();
  return std::max({spins_apart(a.spin, b.spin), std::abs(e.b / e.a - f.b / f.a) / alike_ratio,
                   std::abs(e.c / e.b - f.c / f.b) / alike_ratio});
}

// Its parent: of those before solution j, with the same counts of turns, the one whose image it is
// nearest to; one that is no image itself, where there is such a one.
void set_parent(std::vector<FoundLight>& solutions, std::size_t j, const LightGeometry& g,
                bool half_turns) {
  using Beside = FoundLight::Beside;
  FoundLight& f = solutions[j];
  for (const bool of_images : {false, true}) {
    double least = 1.0;
    for (std::size_t k = 0; k < j; ++k) {
      if ((solutions[k].beside == Beside::image) != of_images ||
          !same_periods(solutions[k].solution.periods, f.solution.periods, g.time_base))
        continue;
      for (const LightImage i :
           {LightImage::normal, LightImage::bisector, LightImage::difference}) {
        const LightModel image = image_of(as_ellipsoid(solutions[k]), i, g.to_sun, g.to_observer);
        const double off = distance_of(image, as_ellipsoid(f), half_turns);
        if (!(off < least)) continue;
        least = off;
        f.beside = Beside::image;
        f.image = i;
        f.of = k;
      }
    }
    if (f.beside == Beside::image) return;
  }
}

std::string motion_text(const LightSolution& s) {
  std::string text = mode_text(s.periods.mode);
  if (s.periods.precession_period > 0.0)
    text += ", P_phi " + polhode::detail::rounded_text(s.periods.precession_period) + ", P_psi " +
            polhode::detail::rounded_text(s.periods.rotation_period);
  return text;
}

double data_cost(const LightSolution& s) {
  return s.terms.empty() ? s.result.cost : s.terms.front().value;
}

// Of the solution with the lowest cost. Where others fit the data better, the best of these and the
// term of the cost that put it behind.
std::string first_text(const std::vector<FoundLight>& solutions) {
  constexpr double lower = 1e-6;  // of the cost
  const LightSolution& first = solutions.front().solution;
  const bool is_squared = first.loss.kind == Loss::Kind::squared;
  if (first.terms.size() < 2) return is_squared ? "the lowest chi-square" : "the lowest loss";
  const auto best = std::ranges::min_element(
      solutions, {}, [](const FoundLight& f) { return data_cost(f.solution); });
  const LightSolution& other = best->solution;
  const std::string text = "the lowest cost";
  if (!(data_cost(first) - data_cost(other) > lower * first.result.cost) ||
      other.terms.size() != first.terms.size())
    return text;
  std::size_t term = 1;
  const auto more = [&](std::size_t k) { return other.terms[k].value - first.terms[k].value; };
  for (std::size_t k = 2; k < first.terms.size(); ++k)
    if (more(k) > more(term)) term = k;
  return text + "; solution " + std::to_string(best - solutions.begin() + 1) + " has a lower " +
         (is_squared ? "chi-square, " : "loss of the data, ") +
         polhode::detail::rounded_text(data_cost(other)) + " against " +
         polhode::detail::rounded_text(data_cost(first)) + ", but its " + first.terms[term].name +
         " costs " + polhode::detail::rounded_text(other.terms[term].value) + " against " +
         polhode::detail::rounded_text(first.terms[term].value);
}

std::string beside_text(const FoundLight& f) {
  const std::string of = "solution " + std::to_string(f.of + 1);
  switch (f.beside) {
    case FoundLight::Beside::image:
      return of + ", turned by pi about " + image_text(f.image);
    case FoundLight::Beside::alias:
      return "other periods than " + of + " in the same mode: one of them is an alias";
    case FoundLight::Beside::other_mode:
      return "the other mode than " + of;
    case FoundLight::Beside::other_pole:
      return "nearly the periods of " + of + ", with another attitude or shape";
    default:
      return "alone of its kind";
  }
}

}  // namespace

LightGeometry geometry_of(std::span<const light::LightCurve> curves) {
  LightGeometry g{{}, {}, 0.0};
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const light::LightCurve& curve : curves) {
    for (const light::LightPoint& p : curve.points) {
      g.to_sun = g.to_sun + (1.0 / norm(p.to_sun)) * p.to_sun;
      g.to_observer = g.to_observer + (1.0 / norm(p.to_observer)) * p.to_observer;
      first = std::min(first, p.t);
      last = std::max(last, p.t);
    }
  }
  g.time_base = last - first;
  return g;
}

LightModel as_ellipsoid(const FoundLight& found) {
  const LightModel& body = found.solution.body;
  return {body.spin, found.ellipsoid, body.law};
}

bool are_alike(const LightModel& a, const LightModel& b) {
  return (a.is_ellipsoid() ? distance_of(a, b, true) : spins_apart(a.spin, b.spin)) < 1.0;
}

bool are_same(const FoundLight& of_a, const FoundLight& of_b, const LightUnknowns& unknowns,
              double time_base) {
  const LightSolution &a = of_a.solution, &b = of_b.solution;
  if (!a.body.is_ellipsoid())
    return are_same_spins(of_a, of_b, a.body.is_convex() && unknowns.shape, time_base);
  // where a rate or a moment may be anything, so may the periods
  const UnknownsCovariance& c = a.covariance;
  bool is_open = false;
  for (std::size_t i = 3; i < c.names.size(); ++i)
    is_open = is_open || c.error(i) == std::numeric_limits<double>::infinity();
  if (!is_open && !same_periods(a.periods, b.periods, time_base)) return false;
  const std::vector<double> x = light_unknowns_at(unknowns, a.body, a.body);
  const std::vector<double> y =
      light_unknowns_at(unknowns, a.body, nearest_of_same(a.body, b.body));
  const double rate = norm(a.body.spin.w_F), factor = std::max(1.0, a.error_factor());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double error = factor * a.covariance.error(i);
    const double least = i < 3 ? same_turn : i < 6 ? same_rate * rate : same_ratio;
    // an unknown that the data do not determine may be anything
    if (error == std::numeric_limits<double>::infinity()) continue;
    if (!(std::abs(y[i] - x[i]) <= (error > least ? error : least))) return false;
  }
  return true;
}

void describe_relations(std::vector<FoundLight>& solutions, const LightGeometry& geometry,
                        bool half_turns) {
  using Beside = FoundLight::Beside;
  for (std::size_t j = 0; j < solutions.size(); ++j) {
    FoundLight& f = solutions[j];
    f.beside = Beside::first;
    f.image = LightImage::none;
    f.of = 0;
    set_parent(solutions, j, geometry, half_turns);
    for (std::size_t k = 0; k < j && f.beside == Beside::first; ++k) {
      const TumblerPeriods &a = solutions[k].solution.periods, &b = f.solution.periods;
      if (a.mode != b.mode || !same_periods(a, b, geometry.time_base)) continue;
      f.beside = Beside::other_pole;
      f.of = k;
    }
    if (j > 0 && f.beside == Beside::first) {
      const bool same = solutions[0].solution.periods.mode == f.solution.periods.mode;
      f.beside = same ? Beside::alias : Beside::other_mode;
    }
    f.sentence = motion_text(f.solution) + ": " + (j == 0 ? first_text(solutions) : beside_text(f));
  }
}

bool are_same_spins(const FoundLight& of_a, const FoundLight& of_b, bool half_turns,
                    double time_base) {
  const LightSolution &a = of_a.solution, &b = of_b.solution;
  if (!same_periods(a.periods, b.periods, time_base)) return false;
  constexpr double errors = 2.0, least_turn = 0.01, least_rate = 1e-4;
  const SpinState& s = a.body.spin;
  const SpinState t =
      half_turns ? nearest_of_same(as_ellipsoid(of_a), as_ellipsoid(of_b)).spin : b.body.spin;
  const Vec3 turn = attitude_residual(s.q, t.q), dw = t.w_F - s.w_F;
  const double factor = errors * std::fmax(1.0, a.error_factor());
  const double rate = least_rate * norm(s.w_F);
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = static_cast<int>(i);
    if (std::fabs(turn[k]) > std::fmax(factor * a.covariance.error(i), least_turn)) return false;
    if (std::fabs(dw[k]) > std::fmax(factor * a.covariance.error(i + 3), rate)) return false;
  }
  return true;
}

std::vector<std::size_t> starts_of_images(const std::vector<FoundLight>& solutions) {
  std::vector<std::size_t> first(solutions.size()), sum(solutions.size(), 0);
  for (std::size_t k = 0; k < solutions.size(); ++k) {
    const FoundLight& f = solutions[k];
    first[k] = f.beside == FoundLight::Beside::image ? first[f.of] : k;
    sum[first[k]] += f.starts;
  }
  std::vector<std::size_t> found;
  for (const std::size_t k : first) found.push_back(sum[k]);
  return found;
}

}  // namespace detail

FoundLight found_light(LightSolution solution, std::size_t periods) {
  FoundLight f;
  const LightModel& body = solution.body;
  if (body.is_ellipsoid()) {
    f.ellipsoid = body.ellipsoid();
  } else {
    try {
      f.ellipsoid = ellipsoid_of_moments(body.spin.inertia_F);
    } catch (const DomainError& error) {
      solution.notes.push_back(std::string("no ellipsoid has these moments: ") + error.what());
    }
  }
  f.solution = std::move(solution);
  f.periods = periods;
  return f;
}

void describe_solutions(std::vector<FoundLight>& solutions,
                        std::span<const light::LightCurve> curves, bool half_turns) {
  detail::describe_relations(solutions, detail::geometry_of(curves), half_turns);
}

namespace detail {

namespace {

constexpr double near_limit = 2.0;
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

DistinctSolutions::DistinctSolutions(std::span<const light::LightCurve> curves, std::size_t periods,
                                     double within, AreSame are_same, bool half_turns)
    : within_(within),
      geometry_(geometry_of(curves)),
      are_same_(std::move(are_same)),
      half_turns_(half_turns),
      best_(periods) {}

void DistinctSolutions::begin(AreSame are_same) {
  are_same_ = std::move(are_same);
  solutions_.clear();
}

void DistinctSolutions::add(const LightSolution& solution, std::size_t periods,
                            const std::optional<LightModel>& begun) {
  FoundLight found = found_light(solution, periods);
  found.begun = begun;
  ++converged_;
  std::optional<LightSolution>& best = best_[periods];
  const double cost = solution.result.cost;
  if (!best || cost < best->result.cost) best = solution;
  for (FoundLight& f : solutions_) {
    if (!are_same_(f, found)) continue;
    ++f.starts;
    if (!(cost < f.solution.result.cost)) return;
    f.solution = std::move(found.solution);
    f.ellipsoid = found.ellipsoid;
    f.begun = std::move(found.begun);
    return;
  }
  found.starts = 1;
  solutions_.push_back(std::move(found));
}

double DistinctSolutions::limit() const {
  double least = infinite;
  for (const FoundLight& f : solutions_) least = std::min(least, f.solution.result.cost);
  return within_ * least;
}

std::size_t DistinctSolutions::count_within() const {
  const double most = limit();
  return static_cast<std::size_t>(std::ranges::count_if(
      solutions_, [most](const FoundLight& f) { return f.solution.result.cost <= most; }));
}

bool DistinctSolutions::is_near(double cost) const { return cost <= near_limit * limit(); }

std::vector<FoundLight> DistinctSolutions::within_limit() const {
  const double most = limit();
  std::vector<FoundLight> found;
  for (const FoundLight& f : solutions_)
    if (f.solution.result.cost <= most) found.push_back(f);
  sort_by_cost(found, [](const FoundLight& f) -> const LightSolution& { return f.solution; });
  describe_relations(found, geometry_, half_turns_);
  return found;
}

// Where a solution was found by one start alone, some are unseen still; what is unseen where none
// was would be found by few starts of the next ones (Good 1953).
std::vector<std::size_t> DistinctSolutions::open_pairs(int round) const {
  const std::vector<FoundLight> within = within_limit();
  const std::vector<std::size_t> found_by = starts_of_images(within);
  const auto is_open = [&](std::size_t p) {
    bool has_one = false;
    for (std::size_t k = 0; k < within.size(); ++k) {
      if (within[k].periods != p) continue;
      if (round < least_rounds || found_by[k] < 2) return true;
      has_one = true;
    }
    return !has_one && round == 0 && best_[p] && is_near(best_[p]->result.cost);
  };
  std::vector<std::size_t> open;
  for (std::size_t p = 0; p < best_.size(); ++p)
    if (is_open(p)) open.push_back(p);
  std::ranges::stable_sort(open, {}, [&](std::size_t p) { return best_[p]->result.cost; });
  if (open.size() > pairs_of_round) open.resize(pairs_of_round);
  return open;
}

std::size_t DistinctSolutions::seldom() const {
  const std::vector<FoundLight> within = within_limit();
  const std::vector<std::size_t> found_by = starts_of_images(within);
  std::size_t count = 0;
  for (std::size_t k = 0; k < within.size(); ++k)
    if (found_by[k] == 1 && within[k].beside != FoundLight::Beside::image) ++count;
  return count;
}

void DistinctSolutions::move_to(LightSearchResult& result) {
  result.solutions = within_limit();
  result.converged = converged_;
  for (const auto& best : best_)
    result.chi_square_of_periods.push_back(best ? best->result.cost : infinite);
  result.best_of_periods = std::move(best_);
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
