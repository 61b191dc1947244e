// SPDX-License-Identifier: MIT
// The points of a frequency scan, and advice on its range, its step and its aliases.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fit/detail/scan_task.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

namespace {

using detail::ScanTable;

[[noreturn]] void refuse(const std::string& what) { throw DomainError("ScanPoints: " + what); }

void check(const light::LightCurve& session, ScanQuantity quantity) {
  const auto refuse_point = [&](std::size_t i, const std::string& what) {
    refuse("point " + std::to_string(i + 1) + " of session \"" + session.name + "\" has " + what);
  };
  for (std::size_t i = 0; i < session.points.size(); ++i) {
    const light::LightPoint& p = session.points[i];
    if (!std::isfinite(p.t))
      refuse_point(i, "time " + polhode::detail::number_text(p.t) + ": it must be finite");
    if (!std::isfinite(p.flux))
      refuse_point(i, "flux " + polhode::detail::number_text(p.flux) + ": it must be finite");
    if (!(p.sigma > 0.0) || !std::isfinite(p.sigma))
      refuse_point(
          i, "sigma " + polhode::detail::number_text(p.sigma) + ": an error must be positive");
    if (quantity == ScanQuantity::log_flux && !(p.flux > 0.0))
      refuse_point(i, "flux " + polhode::detail::number_text(p.flux) +
                          ", which has no logarithm: scan the flux");
  }
}

// The points of sessions that share a constant.
using Group = std::vector<const light::LightCurve*>;

std::vector<Group> groups_of(std::span<const light::LightCurve> sessions) {
  Group calibrated;
  std::vector<Group> groups;
  for (const light::LightCurve& s : sessions) {
    if (s.points.empty()) continue;
    if (s.is_calibrated) {
      calibrated.push_back(&s);
    } else if (s.points.size() == 1) {
      refuse("session \"" + s.name +
             "\" has one point, and a factor of its own that takes all of it: leave it out");
    } else {
      groups.push_back({&s});
    }
  }
  if (!calibrated.empty()) groups.insert(groups.begin(), calibrated);
  return groups;
}

double mean_flux(const Group& group) {
  double sum = 0.0, count = 0.0;
  for (const light::LightCurve* s : group)
    for (const light::LightPoint& p : s->points) {
      sum += p.flux;
      count += 1.0;
    }
  if (!(sum > 0.0))
    refuse("the mean flux of session \"" + group.front()->name + "\" is " +
           polhode::detail::number_text(sum / count) + ": it must be positive");
  return sum / count;
}

void add(const Group& group, ScanQuantity quantity, double epoch, ScanTable& to) {
  const double scale = quantity == ScanQuantity::flux ? mean_flux(group) : 1.0;
  std::vector<double> values;
  const std::size_t begin = to.t.size();
  double weight = 0.0, mean = 0.0;
  for (const light::LightCurve* s : group)
    for (const light::LightPoint& p : s->points) {
      const bool of_flux = quantity == ScanQuantity::flux;
      const double sigma = p.sigma / (of_flux ? scale : p.flux);
      values.push_back(of_flux ? p.flux / scale : std::log(p.flux));
      to.t.push_back(p.t - epoch);
      to.weight.push_back(1.0 / (sigma * sigma));
      to.variance.push_back(sigma * sigma);
      weight += to.weight.back();
      mean += to.weight.back() * (values.back() - values.front());
    }
  mean = mean / weight + values.front();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = values[i] - mean;
    to.weighted.push_back(to.weight[begin + i] * off);
    to.total += to.weight[begin + i] * off * off;
  }
  to.starts.push_back(to.t.size());
  to.group_weight.push_back(weight);
}

}  // namespace

ScanPoints::ScanPoints(std::span<const light::LightCurve> sessions, ScanQuantity quantity) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const light::LightCurve& s : sessions) {
    check(s, quantity);
    for (const light::LightPoint& p : s.points) {
      first = std::min(first, p.t);
      last = std::max(last, p.t);
    }
  }
  const std::vector<Group> groups = groups_of(sessions);
  if (groups.empty()) refuse("there are no points");
  if (!(last > first))
    refuse("all points have the same time " + polhode::detail::number_text(first));
  epoch_ = 0.5 * first + 0.5 * last;
  time_base_ = last - first;

  auto table = std::make_shared<ScanTable>();
  table->starts = {0};
  for (const Group& g : groups) add(g, quantity, epoch_, *table);
  table->count = table->t.size();
  table->padded = (table->count + 7) / 8 * 8;
  for (std::vector<double>* column :
       {&table->t, &table->weight, &table->variance, &table->weighted})
    column->resize(table->padded, 0.0);
  if (!(table->total > 0.0) || !std::isfinite(table->total))
    refuse("the points do not vary, or their errors are beyond the range of numbers");
  table_ = std::move(table);
}

std::size_t ScanPoints::size() const { return table_->count; }
std::size_t ScanPoints::constants() const { return table_->groups(); }
double ScanPoints::total() const { return table_->total; }

namespace {

constexpr double least_height = 0.5;
constexpr std::size_t most_frequencies = 60000, most_peaks = 10;

std::vector<double> sorted_times(const light::LightCurve& session) {
  std::vector<double> t;
  for (const light::LightPoint& p : session.points) t.push_back(p.t);
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

ScanAdvice scan_advice(std::span<const light::LightCurve> sessions, std::size_t order) {
  const ScanPoints points(sessions);
  if (order == 0) throw DomainError("scan_advice: order 0: it must be positive");
  ScanAdvice advice{};
  std::vector<double> all, gaps;
  std::vector<std::pair<double, double>> spans;
  for (const light::LightCurve& s : sessions) {
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

}  // namespace fit
}  // namespace v0
}  // namespace polhode
