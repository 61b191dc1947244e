// SPDX-License-Identifier: MIT
#include "polhode/fit/scan_advice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/fit/scan_points.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double least_height = 0.5;
constexpr std::size_t most_frequencies = 60000, most_peaks = 10;

std::vector<double> sorted_times(const LightCurve& session) {
  std::vector<double> t;
  for (const LightPoint& p : session.points) t.push_back(p.t);
  std::sort(t.begin(), t.end());
  return t;
}

double window(std::span<const double> t, double f) {
  double c = 0.0, s = 0.0;
  for (const double x : t) {
    const double turns = f * x, angle = 2.0 * pi<double>() * (turns - std::rint(turns));
    c += std::cos(angle);
    s += std::sin(angle);
  }
  const double n = static_cast<double>(t.size());
  return (c * c + s * s) / (n * n);
}

std::vector<WindowPeak> peaks_of(std::span<const double> t, double time_base, double most) {
  const double step = 0.25 / time_base;
  const double wanted = std::min((most - 1.0 / time_base) / step, double{most_frequencies});
  std::vector<WindowPeak> found;
  double before = 1.0, here = window(t, 1.0 / time_base);
  for (std::size_t i = 1; static_cast<double>(i) < wanted; ++i) {
    const double f = 1.0 / time_base + static_cast<double>(i) * step;
    const double after = window(t, f);
    if (here >= before && here > after && here >= least_height) {
      // the top of the parabola through three
      const double bend = before - 2.0 * here + after, tilt = 0.5 * (before - after);
      found.push_back({f - step + step * tilt / bend, here - 0.5 * tilt * tilt / bend});
    }
    before = here;
    here = after;
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const WindowPeak& a, const WindowPeak& b) { return a.height > b.height; });
  if (found.size() > most_peaks) found.resize(most_peaks);
  return found;
}

}  // namespace

ScanAdvice scan_advice(std::span<const LightCurve> sessions, std::size_t order) {
  const ScanPoints points(sessions);
  if (order == 0) throw DomainError("scan_advice: order 0: it must be positive");
  ScanAdvice advice{};
  std::vector<double> all, gaps;
  std::vector<std::pair<double, double>> spans;
  for (const LightCurve& s : sessions) {
    const std::vector<double> t = sorted_times(s);
    if (t.empty()) continue;
    double longest = 0.0;
    for (std::size_t i = 1; i < t.size(); ++i) {
      const double gap = t[i] - t[i - 1];
      longest = std::max(longest, gap);
      if (gap > 0.0) gaps.push_back(gap);
    }
    for (const double x : t) all.push_back(x - points.epoch());
    advice.sessions.push_back({s.name, t.size(), t.front(), t.back(), longest});
    spans.emplace_back(t.front(), t.back());
  }
  std::sort(spans.begin(), spans.end());
  double within = 0.0, reached = spans.front().first;
  for (const auto& [first, last] : spans) {
    within += std::max(0.0, last - std::max(first, reached));
    reached = std::max(reached, last);
  }
  const double T = points.time_base();
  if (gaps.empty()) gaps.push_back(T / static_cast<double>(all.size() - 1));
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  advice.time_base = T;
  advice.step = 1.0 / (4.0 * static_cast<double>(order) * T);
  advice.least = 1.0 / T;
  advice.typical_gap = *middle;
  advice.most = std::max(0.25 / *middle, advice.least);
  advice.covered = within / T;
  advice.aliases = peaks_of(all, T, advice.most);
  return advice;
}

}  // namespace v0
}  // namespace polhode
