// SPDX-License-Identifier: MIT
// Interleaved repetitions in CPU time of the thread, and lines of JSON for run.py: one for each
// contender, with every repetition.
#pragma once

#include <time.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace peers {

inline double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Entry {
  std::string who;
  std::function<void()> run;
  double units;  // of work in one run
  double error = std::nan("");
};

template <class T>
void keep(const T& x) {
  asm volatile("" : : "r,m"(x) : "memory");
}

inline void print_line(const std::string& goal, const std::string& what, const Entry& e,
                       const std::string& unit, const std::vector<double>& values) {
  std::printf("{\"goal\": \"%s\", \"case\": \"%s\", \"who\": \"%s\", \"unit\": \"%s\", ",
              goal.c_str(), what.c_str(), e.who.c_str(), unit.c_str());
  if (std::isfinite(e.error))
    std::printf("\"error\": %.3g, ", e.error);
  else
    std::printf("\"error\": null, ");
  std::printf("\"repetitions\": [");
  for (std::size_t k = 0; k < values.size(); ++k)
    std::printf("%s%.6g", k == 0 ? "" : ", ", values[k]);
  std::printf("]}\n");
  std::fflush(stdout);
}

// Each entry runs until `least` seconds are full, then the next; this `repetitions` times. Values
// are nanoseconds for a unit of work, by the thread's clock or another.
inline void compare(const std::string& goal, const std::string& what,
                    const std::vector<Entry>& entries, int repetitions, double least = 0.01,
                    double (*seconds)() = thread_seconds) {
  std::vector<std::vector<double>> values(entries.size());
  for (int r = -1; r < repetitions; ++r)  // the first warms up
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const double begin = seconds();
      double passed = 0.0;
      int runs = 0;
      do {
        entries[k].run();
        ++runs;
        passed = seconds() - begin;
      } while (passed < (r < 0 ? 0.1 * least : least));
      if (r >= 0) values[k].push_back(1e9 * passed / (runs * entries[k].units));
    }
  for (std::size_t k = 0; k < entries.size(); ++k)
    print_line(goal, what, entries[k], "ns", values[k]);
}

}  // namespace peers
