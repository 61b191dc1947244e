// SPDX-License-Identifier: MIT
// Numbers of a member of an ensemble: columns behind those of its run (first times of events and
// indicators of chaos), and the number that a name stands for.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/run/ensemble_run.hpp"
#include "polhode/run/run.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// "flip_first": the column of an event.
std::string first_time_name(const std::string& event);

class MemberColumns {
 public:
  explicit MemberColumns(const Scenario& scenario);

  bool is_empty() const { return events_.empty() && indicators_.empty(); }
  // Of the events, in the order of the file.
  const std::vector<std::string>& events() const { return events_; }
  std::vector<ColumnGroup> groups() const;
  // Rows of the run become rows of the member. The first time of an event is NaN in the rows before
  // it; the last row has every event up to the end of the run. Indicators take a run of their own,
  // which may fail.
  void add(const Experiment& experiment, const RunReport& report, const Progress& progress,
           EnsembleMember& member) const;

 private:
  std::vector<double> first_times(std::span<const RunEvent> met) const;
  std::vector<double> indicators(const Rotation& rotation, std::vector<double> times,
                                 const Progress& progress, EnsembleMember& member) const;

  std::vector<std::string> events_;
  std::vector<EnsembleIndicator> indicators_;
  Units units_;
  std::size_t run_width_;
  bool backwards_;
};

struct MemberNumber {
  enum class From { row, event, drawn };
  From from;
  std::size_t place;  // in a row, or among what was drawn
  Column column;
  bool is_angle;  // of a row
};

// Of a column but t and dates, of q too, or of a key; none where nothing is called so.
std::optional<MemberNumber> member_number(const ScenarioEnsemble& ensemble,
                                          const std::string& name);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
