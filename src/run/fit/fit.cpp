// SPDX-License-Identifier: MIT
#include "polhode/run/fit.hpp"

#include <algorithm>
#include <utility>

#include "fit/result_bytes.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/ensemble/draws.hpp"
#include "polhode/error.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/fit/fit_torques.hpp"
#include "run/time_left.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

// Nearer than this two solutions are one.
constexpr double same_distance = 1.0;
// Fewer degrees of freedom say nothing of errors.
constexpr double least_freedom = 0.5;

const FitPlan& plan_of(const Scenario& scenario) {
  const FitPlan& plan = require_fit(scenario);
  detail::require_inertial(scenario);
  if (plan.has_light())
    plan.observations.front().place.refuse(
        "expected \"attitude\", \"direction\" or \"rate\"; light curves are fitted by "
        "fit_light_scenario");
  return plan;
}

fit::SpinFit spin_fit_of(const Scenario& scenario, const FitPlan& plan,
                         const fit::Snapshots& seen) {
  fit::SpinFit problem;
  problem.start = spin_state(scenario.rotation());
  problem.seen = seen;
  problem.unknowns = plan.unknowns;
  problem.priors = plan.priors;
  problem.attitude_prior = plan.attitude_prior;
  problem.loss = plan.loss;
  problem.most_iterations = plan.most_iterations;
  return problem;
}

// The start of this place: the file's own, or one that is drawn.
fit::SpinState start_of(const FitPlan& plan, const fit::SpinState& own, std::int64_t place) {
  if (place == 0) return own;
  fit::SpinState start = own;
  const auto member = static_cast<std::uint64_t>(place);
  const ensemble::CounterRandom attitudes(plan.seed, ensemble::key_of("fit.starts attitude"));
  const ensemble::CounterRandom rates(plan.seed, ensemble::key_of("fit.starts rate"));
  if (plan.unknowns.attitude)
    start.q = normalized(Quaternion{attitudes.normal(member, 0), attitudes.normal(member, 1),
                                    attitudes.normal(member, 2), attitudes.normal(member, 3)});
  if (plan.unknowns.rate)
    for (int i = 0; i < 3; ++i)
      start.w_F[i] += plan.rate_spread * rates.normal(member, static_cast<std::uint64_t>(i));
  return start;
}

bool are_same(const FitReport& report, const fit::SpinSolution& kept,
              const fit::SpinSolution& found) {
  return fit::mahalanobis(kept.covariance, detail::unknowns_of(report, kept.state, found),
                          detail::unknowns_of(report, kept.state, kept)) <= same_distance;
}

// What one start came to; that of a start which is none, since the file's own has said what is
// wrong with the file.
struct Tried {
  std::optional<fit::SpinSolution> found;
  std::string failure;
};

Tried tried(const FitReport& report, const FitPlan& plan, std::int64_t start) {
  fit::SpinFit one = report.problem;
  one.start = start_of(plan, report.problem.start, start);
  if (start == 0) return {detail::solved(report, one), {}};
  try {
    return {detail::solved(report, one), {}};
  } catch (const DomainError& error) {
    return {std::nullopt, error.what()};
  }
}

// The solutions so far, each once.
class Solutions {
 public:
  Solutions(const fit::SpinFit& problem, const FitPlan& plan, FitReport& report)
      : problem_(problem), plan_(plan), report_(report) {}

  void add(fit::SpinSolution found, std::int64_t start) {
    if (!found.is_found()) return fail(found.result.sentence);
    for (FoundSpin& kept : report_.solutions) {
      if (!are_same(report_, kept.raw, found)) continue;
      ++kept.starts;
      if (found.result.cost < kept.raw.result.cost) kept.raw = std::move(found);
      return;
    }
    report_.solutions.push_back({std::move(found), std::nullopt, start, 1});
  }

  void add(const Tried& tried, std::int64_t start) {
    if (tried.found)
      add(*tried.found, start);
    else
      fail(tried.failure);
  }

  // In order, those near the best.
  void finish() {
    std::vector<FoundSpin>& all = report_.solutions;
    std::stable_sort(all.begin(), all.end(), [](const FoundSpin& a, const FoundSpin& b) {
      return a.raw.result.cost < b.raw.result.cost;
    });
    if (all.empty()) return;
    const double most = all.front().raw.result.cost + plan_.within;
    std::erase_if(all, [&](const FoundSpin& one) { return one.raw.result.cost > most; });
    for (FoundSpin& one : all) one.scaled = scaled(one);
  }

 private:
  void fail(const std::string& why) {
    ++report_.failed;
    if (report_.failure.empty()) report_.failure = why;
  }

  std::optional<fit::SpinSolution> scaled(const FoundSpin& of) const {
    const fit::SpinSolution& raw = of.raw;
    if (!(raw.degrees_of_freedom >= least_freedom) || !(raw.result.chi_square > 0.0))
      return std::nullopt;
    fit::SpinFit again = problem_;
    again.start = raw.state;
    again.scales_errors = true;
    try {
      fit::SpinSolution found = detail::solved(report_, again, &raw);
      if (found.is_found()) return found;
    } catch (const DomainError&) {  // a state that is no start
      return scaled_from_its_start(of, again);
    }
    return std::nullopt;
  }

  // From the start that led to it, where that leads to it again.
  std::optional<fit::SpinSolution> scaled_from_its_start(const FoundSpin& of,
                                                         fit::SpinFit again) const {
    again.start = start_of(plan_, problem_.start, of.start);
    try {
      fit::SpinSolution found = detail::solved(report_, again);
      if (found.is_found() && are_same(report_, of.raw, found)) return found;
    } catch (const DomainError&) {  // errors are as they were given
    }
    return std::nullopt;
  }

  const fit::SpinFit& problem_;
  const FitPlan& plan_;
  FitReport& report_;
};

}  // namespace

FitProblem fit_problem(const Scenario& scenario) {
  const FitPlan& plan = plan_of(scenario);
  ReadObservations observed = read_observations(scenario);
  fit::SpinFit fit = spin_fit_of(scenario, plan, observed.seen);
  return {std::move(fit), detail::drive_of(scenario), std::move(observed)};
}

FitReport fit_scenario(const Scenario& scenario, const FitOptions& options) {
  const FitPlan& plan = plan_of(scenario);
  FitReport report;
  FitProblem problem = fit_problem(scenario);
  report.problem = std::move(problem.fit);
  report.drive = std::move(problem.drive);
  report.observed = std::move(problem.observed);
  Solutions solutions(report.problem, plan, report);
  const auto stop = [&] {
    if (options.stop && options.stop())
      throw RunInterrupted(scenario.document.name + ": stopped after " +
                           std::to_string(report.starts) + " of " + std::to_string(plan.starts) +
                           " starts");
  };
  report.starts = 0;
  stop();
  CellClock clock(options.threads);  // results that are read take no time
  const std::size_t read = options.journal != nullptr ? options.journal->results() : 0;
  plan.places.unknowns.built([&] {
    ensemble::ordered_parallel_for(
        options.journal, plan.starts, options.threads,
        [&](std::int64_t start) { return tried(report, plan, start); },
        [&](std::int64_t start, const Tried& one) {
          solutions.add(one, start);
          report.starts = start + 1;
          clock.ended();
          if (static_cast<std::size_t>(start) < read) clock = CellClock(options.threads);
          const auto done = static_cast<double>(report.starts);
          if (options.progress)
            options.progress({done, clock.part(static_cast<double>(plan.starts) - done)});
          if (report.starts < plan.starts) stop();
        },
        [](Archive& bytes, Tried& one) {
          fit::detail::serialize(bytes, one.found);
          bytes(one.failure);
        });
    return 0;
  });
  solutions.finish();
  return report;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
