// SPDX-License-Identifier: MIT
// Solutions extended to further sessions, with the counts of turns that their errors leave open.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "fit/detail/distinct_solutions.hpp"
#include "fit/detail/light_outcome.hpp"
#include "fit/free_motion.hpp"
#include "fit/light/search_checks.hpp"
#include "fit/result_bytes.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {
namespace {

// Bodies whose light in one session is that of a solution, with other counts of turns until another
// session.
struct TurnCounts {
  std::size_t count = 1;           // that the errors of the periods leave
  std::size_t without_body = 0;    // of them those that no body near the solution has
  bool has_periods = true;         // else the solution alone: its periods are not determined
  std::vector<LightModel> bodies;  // at the epoch of the solution; none of more than `most`
};

constexpr double errors = 3.0;  // up to which counts of turns are looked for
// Of a step, what their standard errors are widened by: neighbours of a point are always among
// them.
constexpr double widened = 0.35;
// Steps of the lattice, in turns until the session: a fit comes to the count that is nearest.
constexpr double precession_turns = 0.5, rotation_turns = 0.25;
// Of a step, how near the frequencies of a start come; and in how many steps of Newton's.
constexpr double near = 0.02;
constexpr int most_newton_steps = 12;

struct Frequencies {
  Regime mode;
  Eigen::Vector2d F;
  Eigen::MatrixXd J;  // by the unknowns
};

// None of a motion that has not two periods.
std::optional<Frequencies> frequencies_of(const LightSolution& s, const LightUnknowns& unknowns) {
  const DerivedParameters f = derived_parameters(s, unknowns);
  if (!(f.periods.precession_period > 0.0) || !(f.periods.rotation_period > 0.0))
    return std::nullopt;
  Frequencies found{f.periods.mode, {}, Eigen::MatrixXd(2, std::ssize(f.precession_slope))};
  const auto add = [&](Eigen::Index row, double period, const std::vector<double>& slope) {
    found.F[row] = 1.0 / period;
    for (std::size_t i = 0; i < slope.size(); ++i)
      found.J(row, static_cast<Eigen::Index>(i)) = -slope[i] / (period * period);
  };
  add(0, f.periods.precession_period, f.precession_slope);
  add(1, f.periods.rotation_period, f.rotation_slope);
  if (!found.F.allFinite() || !found.J.allFinite()) return std::nullopt;
  return found;
}

void hold(Eigen::MatrixXd& C, Eigen::Index i) {
  C.row(i).setZero();
  C.col(i).setZero();
}

class Counts {
 public:
  Counts(const LightSolution& solution, const LightUnknowns& unknowns, double distance)
      : solution_(solution),
        unknowns_(unknowns),
        about_{.curves = {}, .start = solution.body, .unknowns = unknowns, .loss = {}},
        bounds_(light_unknowns(about_)),
        here_(frequencies_of(solution, unknowns)),
        step_{precession_turns / distance, rotation_turns / distance} {
    const auto n = std::ssize(solution.covariance.names);
    const double scale = solution.error_factor(), factor = scale > 1.0 ? scale : 1.0;
    C_ = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
             solution.covariance.matrix.data(), n, n) *
         (factor * factor);
    if (!here_) return;
    // an unknown that may be anything, and changes no period
    for (Eigen::Index i = 0; i < n; ++i)
      if (!std::isfinite(C_(i, i)) && here_->J.col(i).isZero(0.0)) hold(C_, i);
    V_ = here_->J * C_ * here_->J.transpose();
    if (!V_.allFinite()) here_.reset();
    V_.diagonal() += (widened * step_).cwiseAbs2();
  }

  TurnCounts found(std::size_t most) const {
    if (!here_) return {1, 0, false, {solution_.body}};
    const std::vector<Eigen::Vector2d> all = lattice(most);
    TurnCounts counts{all.size(), 0, true, {}};
    if (all.size() > most) return counts;
    for (const Eigen::Vector2d& d : all)
      if (const auto body = body_with(here_->F + d)) counts.bodies.push_back(*body);
    counts.without_body = all.size() - counts.bodies.size();
    return counts;
  }

 private:
  // Those inside of the ellipse; where they are more than `most`, some of them.
  std::vector<Eigen::Vector2d> lattice(std::size_t most) const {
    const Eigen::Matrix2d A = V_.inverse();
    const double width = std::floor(errors * std::sqrt(V_(0, 0)) / step_[0]);
    // a row has a point or more
    if (!(width <= static_cast<double>(most)))
      return std::vector<Eigen::Vector2d>(most + 1, Eigen::Vector2d::Zero());
    std::vector<Eigen::Vector2d> all;
    for (double i = -width; i <= width; i += 1.0) {
      // what A leaves of the second frequency, given the first
      const double d = i * step_[0], middle = -A(0, 1) * d / A(1, 1);
      const double square = middle * middle - (A(0, 0) * d * d - errors * errors) / A(1, 1);
      if (!(square >= 0.0)) continue;
      const double half = std::sqrt(square), last = std::floor((middle + half) / step_[1]);
      for (double j = std::ceil((middle - half) / step_[1]); j <= last; j += 1.0) {
        all.push_back({d, j * step_[1]});
        if (all.size() > most) return all;
      }
    }
    return all;
  }

  // The likeliest body of these frequencies; none where there is none in this mode.
  std::optional<LightModel> body_with(const Eigen::Vector2d& wanted) const {
    LightSolution there = solution_;
    std::vector<double> x = light_unknowns_at(unknowns_, solution_.body, solution_.body);
    Eigen::MatrixXd C = C_;  // less what comes to a bound
    for (int k = 0; k < most_newton_steps; ++k) {
      try {
        there.body = body_at(about_, x);
        const std::optional<Frequencies> f = frequencies_of(there, unknowns_);
        if (!f || f->mode != here_->mode) return std::nullopt;
        const Eigen::Vector2d miss = wanted - f->F;
        if ((miss.array().abs() <= near * step_.array()).all()) return there.body;
        const Eigen::MatrixXd CJ = C * f->J.transpose();
        const Eigen::Matrix2d V = f->J * CJ;
        const Eigen::VectorXd step = CJ * V.ldlt().solve(miss);
        if (!step.allFinite()) return std::nullopt;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += step[static_cast<Eigen::Index>(i)];
      } catch (const DomainError&) {  // no body has these unknowns
        return std::nullopt;
      }
      const std::vector<double> free = x;
      keep_sound(x);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] != free[i]) hold(C, static_cast<Eigen::Index>(i));
    }
    return std::nullopt;
  }

  // Inside of the bounds of a fit.
  void keep_sound(std::vector<double>& x) const {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::clamp(x[i], bounds_[i].low, bounds_[i].high);
  }

  const LightSolution& solution_;
  const LightUnknowns& unknowns_;
  LightFit about_;
  std::vector<Unknown> bounds_;
  std::optional<Frequencies> here_;
  Eigen::Vector2d step_;
  Eigen::MatrixXd C_;
  Eigen::Matrix2d V_;
};

// `distance` is D of light_extension.hpp.
TurnCounts turn_counts(const LightSolution& solution, const LightUnknowns& unknowns,
                       double distance, std::size_t most) {
  return Counts(solution, unknowns, distance).found(most);
}

}  // namespace
}  // namespace detail

namespace {

const std::string extend_name = "extend_light: ";
// Solutions that go on to the next session, the lowest ones.
constexpr std::size_t most_solutions = 100;
// Of fits, so that they stay at their count of turns.
constexpr double first_step = 30.0;
// Of those before, where a fit that is not at its end goes on.
constexpr int more_iterations = 5;

struct TimeRange {
  double begin = std::numeric_limits<double>::infinity();
  double end = -std::numeric_limits<double>::infinity();

  double middle() const { return 0.5 * (begin + end); }
  void take(const TimeRange& other) {
    begin = std::min(begin, other.begin);
    end = std::max(end, other.end);
  }
  // 0 where they overlap.
  double gap(const TimeRange& other) const {
    return std::max({0.0, other.begin - end, begin - other.end});
  }
};

TimeRange range_of(const light::LightCurve& curve) {
  TimeRange range;
  for (const light::LightPoint& p : curve.points) range.take({p.t, p.t});
  return range;
}

LightModel at_time(LightModel body, double t) {
  body.spin = detail::spin_at(body.spin, t);
  return body;
}

void check(const LightExtension& e) {
  light::require_sound(e.curves, {.vectors = true});
  if (e.starts.empty()) throw DomainError(extend_name + "no starts; expected one body");
  for (const LightModel& start : e.starts)
    if (start.shape.index() != e.starts.front().shape.index())
      throw DomainError(extend_name + "starts of several shapes; expected bodies of one shape");
  if (e.first >= e.curves.size())
    throw DomainError(extend_name + "first = " + std::to_string(e.first) + " must be below " +
                      std::to_string(e.curves.size()) + ", the number of sessions");
  detail::require_at_least_one(extend_name, "most_counts", e.most_counts);
  detail::require_at_least_one(extend_name, "most_iterations", e.most_iterations);
  detail::require_at_least_one(extend_name, "threads", e.threads);
  detail::require_within(extend_name, e.within);
}

// Where a fit begins, from which of the starts it came, and of convex bodies the usual one.
struct Begin {
  LightModel body;
  std::size_t from;
  std::optional<LightModel> about;
};

class Extension {
 public:
  explicit Extension(const LightExtension& asked) : asked_(asked) {
    for (const light::LightCurve& curve : asked.curves) ranges_.push_back(range_of(curve));
  }

  LightExtensionResult found() {
    std::vector<Begin> begins;
    for (std::size_t k = 0; k < asked_.starts.size(); ++k) {
      const LightModel& start = asked_.starts[k];
      begins.push_back({start, k, asked_.regularisation.about});
      if (start.is_convex() && !begins.back().about) begins.back().about = start;
    }
    join(asked_.first, 0.0, begins);
    while (result_.failure.empty() && joined_.size() < ranges_.size()) join_next();
    if (!result_.failure.empty()) result_.solutions.clear();
    if (asked_.progress) asked_.progress(1.0);
    return std::move(result_);
  }

 private:
  bool is_joined(std::size_t k) const { return std::ranges::find(joined_, k) != joined_.end(); }

  // The session that is nearest to those that have joined, by what lies between them.
  void join_next() {
    std::size_t next = ranges_.size();
    for (std::size_t k = 0; k < ranges_.size(); ++k) {
      if (is_joined(k)) continue;
      if (next == ranges_.size() || all_.gap(ranges_[k]) < all_.gap(ranges_[next])) next = k;
    }
    const double distance = std::abs(ranges_[next].middle() - all_.middle());
    std::vector<Begin> begins;
    std::size_t wide = 0, without_body = 0, without_periods = 0;
    for (std::size_t k = 0; k < result_.solutions.size(); ++k) {
      const FoundLight& f = result_.solutions[k];
      detail::TurnCounts counts;
      if (distance > 0.0)
        counts = detail::turn_counts(f.solution, asked_.unknowns, distance, asked_.most_counts);
      else
        counts.bodies = {f.solution.body};
      if (counts.count > asked_.most_counts) {
        if (k == 0) return refuse(next);
        ++wide;
      }
      without_body += counts.without_body;
      without_periods += counts.has_periods ? 0 : 1;
      for (const LightModel& body : counts.bodies) begins.push_back({body, f.periods, f.begun});
    }
    const std::string before = "before session " + std::to_string(next + 1) + ", ";
    note(before + "solutions left out, with more than " + std::to_string(asked_.most_counts) +
             " counts of turns",
         wide);
    note(before + "counts of turns that no body near their solution has", without_body);
    note(
        before + "solutions whose periods are not determined, with their own counts of turns alone",
        without_periods);
    join(next, distance, begins);
  }

  void note(const std::string& what, std::size_t count) {
    if (count > 0) result_.notes.push_back(what + ": " + std::to_string(count));
  }

  void refuse(std::size_t next) {
    result_.failure =
        "session " + std::to_string(next + 1) +
        " is too far from those before it: the errors of the periods leave more than " +
        std::to_string(asked_.most_counts) + " counts of turns; add a session between them";
  }

  // Fits of all sessions so far and of this one.
  void join(std::size_t session, double distance, std::vector<Begin>& begins) {
    joined_.push_back(session);
    all_.take(ranges_[session]);
    std::vector<light::LightCurve> curves;  // in their order
    for (std::size_t k = 0; k < ranges_.size(); ++k)
      if (is_joined(k)) curves.push_back(asked_.curves[k]);
    detail::DistinctSolutions finds(
        curves, asked_.starts.size(), asked_.within,
        [&](const FoundLight& a, const FoundLight& b) {
          return detail::are_same(a, b, asked_.unknowns, all_.end - all_.begin);
        },
        asked_.starts.front().is_ellipsoid() ||
            (asked_.starts.front().is_convex() && asked_.unknowns.shape));
    Pass pass{curves, asked_.most_iterations, 0.0, {}, 0};
    fit(begins, pass, finds);
    // what has not come to its end and is near the limit goes on, from where it is
    std::vector<Begin> longer;
    for (const auto& [cost, begin] : pass.unfinished)
      if (pass.converged == 0 || finds.is_near(cost)) longer.push_back(begin);
    Pass next{curves, detail::times(asked_.most_iterations, more_iterations), 0.5, {}, 0};
    fit(longer, next, finds);
    const std::size_t converged = pass.converged + next.converged;
    note("with session " + std::to_string(session + 1) +
             ", fits near the limit that did not end in " + std::to_string(next.most_iterations) +
             " iterations, so that solutions may be missing",
         longer.size() - next.converged);
    result_.solutions = finds.within_limit();
    const bool is_found = !result_.solutions.empty();
    result_.joined.push_back({session, distance, begins.size(), converged, result_.solutions.size(),
                              is_found ? result_.solutions.front().solution.result.cost
                                       : std::numeric_limits<double>::quiet_NaN()});
    if (!is_found) {
      result_.failure = "none of " + std::to_string(begins.size()) +
                        (begins.size() == 1 ? " fit" : " fits") + " of session " +
                        std::to_string(session + 1) +
                        (joined_.size() == 1 ? "" : " with those before it") +
                        " converged: more iterations, or another start";
      return;
    }
    if (result_.solutions.size() <= most_solutions || joined_.size() == ranges_.size()) return;
    result_.notes.push_back("of " + std::to_string(result_.solutions.size()) +
                            " solutions with session " + std::to_string(session + 1) + " the " +
                            std::to_string(most_solutions) + " lowest went on");
    result_.solutions.resize(most_solutions);
  }

  // Fits with so many iterations, and what they leave.
  struct Pass {
    const std::vector<light::LightCurve>& curves;
    int most_iterations;
    double done;                                       // of the session, before them
    std::vector<std::pair<double, Begin>> unfinished;  // with their costs
    std::size_t converged;
  };

  LightFit fit_from(const Begin& begin, const Pass& pass) const {
    LightFit fit{pass.curves,          at_time(begin.body, all_.middle()),
                 asked_.unknowns,      asked_.loss,
                 pass.most_iterations, first_step,
                 asked_.regularisation};
    fit.regularisation.about = begin.about;
    return fit;
  }

  void fit(const std::vector<Begin>& begins, Pass& pass, detail::DistinctSolutions& finds) {
    ensemble::ordered_parallel_for(
        asked_.journal, std::ssize(begins), asked_.threads,
        [&](std::int64_t k) {
          if (asked_.between) asked_.between();
          return fit_light(fit_from(begins[static_cast<std::size_t>(k)], pass));
        },
        [&](std::int64_t k, const LightSolution& s) {
          tell(pass.done + 0.5 * static_cast<double>(k + 1) / static_cast<double>(begins.size()));
          const Begin& begin = begins[static_cast<std::size_t>(k)];
          if (s.is_found()) {
            finds.add(s, begin.from, begin.about);
            ++pass.converged;
          } else if (s.result.end == LeastSquaresResult::End::iteration_limit) {
            pass.unfinished.push_back({s.result.cost, {s.body, begin.from, begin.about}});
          }
        },
        [this](Archive& bytes, LightSolution& s) {
          detail::serialize(bytes, s, asked_.starts.front());
        });
  }

  // Of the present session.
  void tell(double part) {
    if (asked_.progress)
      asked_.progress((static_cast<double>(joined_.size() - 1) + part) /
                      static_cast<double>(ranges_.size()));
  }

  const LightExtension& asked_;
  std::vector<TimeRange> ranges_;  // of the sessions
  std::vector<std::size_t> joined_;
  TimeRange all_;
  LightExtensionResult result_;
};

}  // namespace

LightExtensionResult extend_light(const LightExtension& extension) {
  check(extension);
  return Extension(extension).found();
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
