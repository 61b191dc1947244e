// SPDX-License-Identifier: MIT
#include "polhode/io/run.hpp"

#include <algorithm>

#include "io/detail/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/io/citations.hpp"
#include "polhode/version.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::int64_t rows_per_block = 1024;

}  // namespace

Provenance provenance(const Scenario& scenario) {
  Provenance result;
  result.version = version();
  result.title = scenario.title;
  result.scenario_name = scenario.name;
  result.scenario_text = scenario.text;
  const std::string since = scenario.epoch.empty() ? "the epoch" : scenario.epoch;
  result.notes.push_back("t counts from " + since + "; axes: " + scenario.axes);
  const Quaternion& q = scenario.body.q_FB();
  if (!(q == Quaternion{}))
    result.notes.push_back(
        "q, omega and g refer to the axes of the tensor, charts to principal axes, q_FB = [" +
        detail::number_text(q.w) + ", " + detail::number_text(q.x) + ", " +
        detail::number_text(q.y) + ", " + detail::number_text(q.z) + "]");
  for (const Citation& citation : citations(scenario)) result.citations.push_back(citation.text);
  return result;
}

void run(const Scenario& scenario, const RowLayout& layout,
         std::span<const std::unique_ptr<Sink>> sinks) {
  if (!scenario.time) throw DomainError(scenario.name + ": time: got nothing; expected [time]");
  const FreeRotation motion = free_rotation(scenario);
  const SaveAt& times = *scenario.time;
  std::vector<double> block;
  for (std::int64_t first = 0; first < times.size(); first += rows_per_block) {
    const std::int64_t last = std::min(times.size(), first + rows_per_block);
    block.resize(static_cast<std::size_t>(last - first) * layout.width());
    const std::span<double> numbers(block);
    for (std::int64_t k = first; k < last; ++k)
      layout.write_row(
          motion, times[k],
          numbers.subspan(static_cast<std::size_t>(k - first) * layout.width(), layout.width()));
    for (const std::unique_ptr<Sink>& sink : sinks) sink->push(block);
  }
  for (const std::unique_ptr<Sink>& sink : sinks) sink->finish();
}

}  // namespace v0
}  // namespace polhode
