// SPDX-License-Identifier: MIT
#include "polhode/fit/scan_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fit/detail/scan_task.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/number.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::ScanTable;

[[noreturn]] void refuse(const std::string& what) { throw DomainError("ScanPoints: " + what); }

void check(const LightCurve& session, ScanQuantity quantity) {
  const auto refuse_point = [&](std::size_t i, const std::string& what) {
    refuse("point " + std::to_string(i + 1) + " of session \"" + session.name + "\" has " + what);
  };
  for (std::size_t i = 0; i < session.points.size(); ++i) {
    const LightPoint& p = session.points[i];
    if (!std::isfinite(p.t))
      refuse_point(i, "time " + detail::number_text(p.t) + ": it must be finite");
    if (!std::isfinite(p.flux))
      refuse_point(i, "flux " + detail::number_text(p.flux) + ": it must be finite");
    if (!(p.sigma > 0.0) || !std::isfinite(p.sigma))
      refuse_point(i, "sigma " + detail::number_text(p.sigma) + ": an error must be positive");
    if (quantity == ScanQuantity::log_flux && !(p.flux > 0.0))
      refuse_point(
          i, "flux " + detail::number_text(p.flux) + ", which has no logarithm: scan the flux");
  }
}

// The points of sessions that share a constant.
using Group = std::vector<const LightCurve*>;

std::vector<Group> groups_of(std::span<const LightCurve> sessions) {
  Group calibrated;
  std::vector<Group> groups;
  for (const LightCurve& s : sessions) {
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
  for (const LightCurve* s : group)
    for (const LightPoint& p : s->points) {
      sum += p.flux;
      count += 1.0;
    }
  if (!(sum > 0.0))
    refuse("the mean flux of session \"" + group.front()->name + "\" is " +
           detail::number_text(sum / count) + ": it must be positive");
  return sum / count;
}

void add(const Group& group, ScanQuantity quantity, double epoch, ScanTable& to) {
  const double scale = quantity == ScanQuantity::flux ? mean_flux(group) : 1.0;
  std::vector<double> values;
  const std::size_t begin = to.t.size();
  double weight = 0.0, mean = 0.0;
  for (const LightCurve* s : group)
    for (const LightPoint& p : s->points) {
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

ScanPoints::ScanPoints(std::span<const LightCurve> sessions, ScanQuantity quantity) {
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const LightCurve& s : sessions) {
    check(s, quantity);
    for (const LightPoint& p : s.points) {
      first = std::min(first, p.t);
      last = std::max(last, p.t);
    }
  }
  const std::vector<Group> groups = groups_of(sessions);
  if (groups.empty()) refuse("there are no points");
  if (!(last > first)) refuse("all points have the same time " + detail::number_text(first));
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

}  // namespace v0
}  // namespace polhode
