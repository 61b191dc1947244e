// SPDX-License-Identifier: MIT
#include "polhode/io/run.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/detail/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/io/citations.hpp"
#include "polhode/version.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::int64_t rows_per_block = 1024;

// What the numbers of a group do not say themselves: it is constant along the motion.
std::vector<std::string> branch_notes(const Scenario& scenario) {
  std::vector<std::string> notes;
  const FreeRotation motion = free_rotation(scenario);
  for (const std::string& group : scenario.columns) {
    if (group == "sadov") {
      const SadovState s = to_sadov(motion, 0.0);
      notes.push_back(s.region == SadovRegion::short_axis
                          ? "sadov: region SAM"
                          : "sadov: region LAM, lobe " + std::to_string(s.lobe));
    } else if (group == "serret") {
      const SerretState s = to_serret(motion, 0.0);
      notes.push_back("serret: sign_g1 " + std::to_string(s.sign_g1) + ", sign_g3 " +
                      std::to_string(s.sign_g3));
    }
  }
  return notes;
}

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
  for (std::string& note : branch_notes(scenario)) result.notes.push_back(std::move(note));
  for (const Citation& citation : citations(scenario)) result.citations.push_back(citation.text);
  return result;
}

void run(const Scenario& scenario, const RowLayout& layout,
         std::span<const std::unique_ptr<Sink>> sinks) {
  if (!scenario.time) throw DomainError(scenario.name + ": time: got nothing; expected [time]");
  const FreeRotation motion = free_rotation(scenario);
  const SaveAt& times = *scenario.time;
  std::vector<double> rows, numbers;
  for (std::int64_t first = 0; first < times.size(); first += rows_per_block) {
    const std::int64_t last = std::min(times.size(), first + rows_per_block);
    rows.clear();
    for (std::int64_t k = first; k < last; ++k) rows.push_back(times[k]);
    numbers.resize(rows.size() * layout.width());
    layout.write_rows(motion, rows, numbers);
    for (const std::unique_ptr<Sink>& sink : sinks) sink->push(numbers);
  }
  for (const std::unique_ptr<Sink>& sink : sinks) sink->finish();
}

}  // namespace v0
}  // namespace polhode
