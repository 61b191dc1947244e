// SPDX-License-Identifier: MIT
#include "run/time_left.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace polhode {
inline namespace v0 {
namespace io {

double seconds_left(std::span<const double> ends, std::int64_t done, double left) {
  const auto workers = static_cast<std::int64_t>(ends.size());
  const auto cells = static_cast<std::int64_t>(std::ceil(left));
  if (cells <= 0 || done <= 0 || workers == 0) return 0.0;
  const double mean = std::accumulate(ends.begin(), ends.end(), 0.0) / static_cast<double>(done);
  const auto duration = [&](std::int64_t cell) {
    return cell + 1 < cells ? mean : mean * (left - static_cast<double>(cell));
  };
  std::vector<double> free;  // when each worker will be, from now on
  for (std::int64_t k = 0; k < std::min(workers, cells); ++k)
    free.push_back(std::max(ends[static_cast<std::size_t>(k)] + duration(k) - ends.back(), 0.0));
  const std::int64_t waiting = std::max<std::int64_t>(cells - workers, 0);
  const std::int64_t rounds = std::max<std::int64_t>(waiting - 1, 0) / workers;
  for (std::int64_t k = workers * (1 + rounds); k < cells; ++k)
    free[static_cast<std::size_t>(k % workers)] += duration(k);
  return static_cast<double>(rounds) * mean + *std::max_element(free.begin(), free.end());
}

void CellClock::begin(int workers) {
  begun_ = Clock::now();
  ends_.assign(static_cast<std::size_t>(std::max(workers, 1)), 0.0);
  done_ = 0;
}

void CellClock::ended() {
  ends_.erase(ends_.begin());
  ends_.push_back(std::chrono::duration<double>(Clock::now() - begun_).count());
  ++done_;
}

double CellClock::part(double left) const {
  if (done_ == 0) return 0.0;
  const double passed = std::chrono::duration<double>(Clock::now() - made_).count();
  return passed / (passed + seconds_left(ends_, done_, left));
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
