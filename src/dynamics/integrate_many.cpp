// SPDX-License-Identifier: MIT
#include "polhode/dynamics/integrate_many.hpp"

#include <utility>

#include "math/number_text.hpp"
#include "polhode/dynamics/integrate.hpp"

namespace polhode {
inline namespace v0 {
namespace {

std::string text_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "an exception that is not a std::exception";
  }
}

template <MotionState S>
BasicBodyRun<S> body_run(std::size_t index, const BasicProblem<System, S>& problem,
                         const Keep& keep, const Progress& progress) {
  double reached = problem.start;
  bool is_outside = false;  // in progress, whose exceptions are not the body's
  const Progress watched = [&](double t) {
    reached = t;
    if (!progress) return;
    is_outside = true;
    progress(t);
    is_outside = false;
  };
  try {
    return {integrate(problem, keep, watched), {}, {}};
  } catch (...) {
    if (is_outside) throw;
    const std::exception_ptr thrown = std::current_exception();
    return {std::nullopt,
            "body " + std::to_string(index) + " at t = " + detail::number_text(reached) + ": " +
                text_of(thrown),
            thrown};
  }
}

template <MotionState S>
void each_body(std::size_t count,
               const std::function<BasicProblem<System, S>(std::size_t)>& problem, const Keep& keep,
               const std::function<void(std::size_t, BasicBodyRun<S>)>& done,
               const Progress& progress) {
  for (std::size_t k = 0; k < count; ++k) done(k, body_run(k, problem(k), keep, progress));
}

template <MotionState S>
std::vector<BasicBodyRun<S>> all_runs(std::span<const BasicProblem<System, S>> problems,
                                      const Keep& keep) {
  std::vector<BasicBodyRun<S>> runs;
  for (const BasicProblem<System, S>& problem : problems)
    runs.push_back(body_run(runs.size(), problem, keep, {}));
  return runs;
}

}  // namespace

BodyRun integrate_body(std::size_t index, const Problem& problem, const Keep& keep,
                       const Progress& progress) {
  return body_run(index, problem, keep, progress);
}
DampedBodyRun integrate_body(std::size_t index, const DampedProblem& problem, const Keep& keep,
                             const Progress& progress) {
  return body_run(index, problem, keep, progress);
}

void integrate_many(std::size_t count, const std::function<Problem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, BodyRun)>& done,
                    const Progress& progress) {
  each_body(count, problem, keep, done, progress);
}
void integrate_many(std::size_t count, const std::function<DampedProblem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, DampedBodyRun)>& done,
                    const Progress& progress) {
  each_body(count, problem, keep, done, progress);
}

std::vector<BodyRun> integrate_many(std::span<const Problem> problems, const Keep& keep) {
  return all_runs(problems, keep);
}
std::vector<DampedBodyRun> integrate_many(std::span<const DampedProblem> problems,
                                          const Keep& keep) {
  return all_runs(problems, keep);
}

}  // namespace v0
}  // namespace polhode
