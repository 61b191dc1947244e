// SPDX-License-Identifier: MIT
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

}  // namespace

BodyRun integrate_body(std::size_t index, const Problem& problem, const Keep& keep,
                       const Progress& progress) {
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

void integrate_many(std::size_t count, const std::function<Problem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, BodyRun)>& done,
                    const Progress& progress) {
  for (std::size_t k = 0; k < count; ++k) done(k, integrate_body(k, problem(k), keep, progress));
}

std::vector<BodyRun> integrate_many(std::span<const Problem> problems, const Keep& keep) {
  std::vector<BodyRun> runs;
  for (const Problem& problem : problems)
    runs.push_back(integrate_body(runs.size(), problem, keep));
  return runs;
}

}  // namespace v0
}  // namespace polhode
