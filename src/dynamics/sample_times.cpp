// SPDX-License-Identifier: MIT
#include "dynamics/sample_times.hpp"

#include <algorithm>
#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::vector<double> sample_times(const std::string& function, const Problem& problem,
                                 const SaveAt& samples) {
  const double sign = problem.start <= problem.stop ? 1.0 : -1.0;
  // SaveAt keeps a row that rounding puts beyond stop.
  const double slack =
      8.0 * epsilon<double>() * std::max(std::abs(problem.start), std::abs(problem.stop));
  std::vector<double> times;
  for (std::int64_t k = 0; k < samples.size(); ++k) {
    const double t = samples[k];
    if (!(sign * (t - problem.start) >= 0.0 && sign * (problem.stop - t) >= -slack)) continue;
    if (!times.empty() && sign * (t - times.back()) < 0.0)
      throw DomainError(function + ": sample times must run from start to stop: " + number_text(t) +
                        " comes after " + number_text(times.back()));
    times.push_back(t);
  }
  return times;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
