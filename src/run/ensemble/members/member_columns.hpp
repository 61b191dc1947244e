// SPDX-License-Identifier: MIT
// What rows of a member have behind the columns of its run: when each event first happened, and
// indicators of chaos.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "polhode/run/ensemble.hpp"
#include "polhode/run/run.hpp"

namespace polhode {
inline namespace v0 {
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
  // Rows of the run become rows of the member. The first time of an event is NaN in those before;
  // indicators take a run of their own, which may fail.
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
