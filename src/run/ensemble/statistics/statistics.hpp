// SPDX-License-Identifier: MIT
// The statistics of an ensemble at each of its times, histograms included, of members that come in
// any number of chunks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ensemble/attitude_moments.hpp"
#include "ensemble/attitude_spread.hpp"
#include "ensemble/first_events.hpp"
#include "ensemble/fractions.hpp"
#include "ensemble/histogram.hpp"
#include "ensemble/number_moments.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/ensemble/bins.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "run/ensemble/member_columns.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Accumulators as bytes of a checkpoint or a message: for each how many numbers it has, then these.
template <class A>
void serialize_all(Archive& bytes, std::vector<A>& all) {
  for (A& one : all) {
    std::vector<double> numbers;
    if (!bytes.reads()) numbers = one.numbers();
    bytes(numbers);
    if (bytes.reads()) one = one.restored(numbers);
  }
}

// Even ones over a range and `margin` of it on either side, wide enough for doubles to lie between
// the edges.
ensemble::Bins bins_over(double least, double greatest, double margin, int count);

// An Accumulator of one or two numbers of each member: in bins that are known beforehand, or kept
// until their range is.
class MemberHistogram {
 public:
  // In the bins of one axis or two; without any, numbers of so many axes are kept.
  explicit MemberHistogram(std::span<const ensemble::Bins> bins);
  static MemberHistogram kept(std::size_t axes);

  std::size_t axes() const;
  // Numbers that are not finite are passed over.
  void add(std::int64_t member, std::span<const double> x);
  void merge(const MemberHistogram& later);

  // Rows of `time`, the edges of each axis, the count and the part of all: the cells of the first
  // bin of the first axis side by side; the first and the last bin are open. Numbers that were kept
  // go into `bins` of each axis over their range.
  void append_rows(double time, int bins, std::vector<double>& rows) const;

  std::vector<double> numbers() const;
  MemberHistogram restored(std::span<const double> numbers) const;

 private:
  struct Kept {
    std::size_t axes;
    std::vector<double> numbers;  // of one member after the other
  };
  using Of = std::variant<Kept, ensemble::Histogram, ensemble::Histogram2D>;
  explicit MemberHistogram(Of of) : of_(std::move(of)) {}

  Of of_;
};

// What is made of the columns of a row.
struct StatisticsColumns {
  struct Number {
    Column column;
    std::size_t place;  // in a row
    bool is_angle;
  };
  struct Attitude {
    std::string group;  // "q"
    std::size_t place;  // of its first component
  };
  std::vector<Number> numbers;
  std::vector<Attitude> attitudes;
  std::vector<Number> modes;   // of the regimes of free rotation
  std::vector<Number> events;  // when each first happened

  std::vector<MemberNumber> fractions;                // of the plan
  std::vector<std::vector<MemberNumber>> histograms;  // the axes of each
  explicit StatisticsColumns(const ScenarioEnsemble& ensemble);
};

// What all chunks share: it depends on the file alone.
class StatisticsFrame {
 public:
  // Nothing is known of the members yet. DomainError where statistics would not fit into memory.
  explicit StatisticsFrame(const ScenarioEnsemble& ensemble);

  const ScenarioEnsemble& ensemble() const { return ensemble_; }
  const StatisticsColumns& columns() const { return columns_; }
  std::size_t epochs() const { return times_.size(); }
  std::size_t width() const { return width_; }
  double time(std::size_t epoch) const { return times_[epoch]; }
  // How many rows of a member stand at these times: an event that stops it has a row of its own.
  std::size_t epochs_of(const EnsembleMember& member) const;
  // A number of a row; an angle within half a turn of that of the base.
  double number(const StatisticsColumns::Number& of, std::size_t epoch, double x) const;

  // Any number of a member of which `rows` stand at these times; NaN where it has none then. When
  // an event first happened it has on after its end, too.
  double number(const MemberNumber& of, const EnsembleMember& member, std::size_t rows,
                std::size_t epoch) const;
  // Whether a number lies in a fraction of the plan.
  bool is_in(std::size_t fraction, double x) const;

  // A histogram is of so many times; the epoch of each.
  std::size_t histogram_times(std::size_t histogram) const;
  std::size_t histogram_epoch(std::size_t histogram, std::size_t time) const {
    return times_.size() - histogram_times(histogram) + time;
  }
  // A number of a member on an axis: an angle whole turns apart, so that it lies in the bins, or
  // else next to that of the base.
  double on_axis(std::size_t histogram, std::size_t axis, const EnsembleMember& member,
                 std::size_t rows, std::size_t epoch) const;
  MemberHistogram empty_histogram(std::size_t histogram, std::size_t time) const;
  // The columns of its file.
  std::vector<ColumnGroup> histogram_groups(std::size_t histogram) const;

  // Whether every number is kept.
  bool is_exact() const { return exact_ > 0; }
  // The first members, from which bins and references are taken; 0: none are needed.
  std::int64_t pilots() const;
  void set_base(const EnsembleMember& base);
  // Member after member, then once.
  void add_pilot(std::int64_t index, const EnsembleMember& member);
  void finish_pilots();

  ensemble::Quantiles empty_quantiles(std::size_t number, std::size_t epoch) const;
  // Of times as they come along a run: see first_time.
  ensemble::FirstEvents empty_events() const;
  // When an event first happened to a member, and the first epoch by which it had; none: never.
  struct FirstTime {
    double along;  // in the direction of the run: -t backwards
    std::size_t epoch;
  };
  std::optional<FirstTime> first_time(const StatisticsColumns::Number& event,
                                      const EnsembleMember& member) const;
  bool is_backwards() const { return times_.back() < times_.front(); }
  const Quaternion& reference(std::size_t attitude, std::size_t epoch) const {
    return references_[attitude * epochs() + epoch];
  }
  // What the rows of the statistics are, and what outputs say of them.
  std::vector<ColumnGroup> groups() const;
  std::vector<std::string> notes() const;
  // References and ranges, for a checkpoint.
  void serialize(Archive& bytes);

 private:
  struct Range {
    double least, greatest;
  };
  void require_room() const;
  double histogram_bytes() const;
  // Of all histograms and their times; where one begins.
  std::size_t histogram_axes() const;
  std::size_t first_axis(std::size_t histogram, std::size_t time) const;
  void add_to_axes(const EnsembleMember& member);

  const ScenarioEnsemble& ensemble_;
  StatisticsColumns columns_;
  std::size_t width_;
  std::vector<double> times_;       // as rows have them
  double turn_;                     // in the unit of angles
  std::int64_t exact_;              // numbers that quantiles keep; 0: bins from the start
  std::vector<double> base_;        // angles of the base, by number and epoch
  std::vector<Range> ranges_;       // of pilots, by number and epoch
  std::vector<Range> axis_ranges_;  // of pilots, by histogram, time and axis
  std::vector<ensemble::AttitudeMoments> pilot_attitudes_;
  std::vector<Quaternion> references_;  // by attitude and epoch
  std::vector<ensemble::Bins> bins_;    // by number and epoch; one of all while all is exact
};

class RowStatistics {
 public:
  explicit RowStatistics(const StatisticsFrame& frame);

  // Members first, first + 1, ...; those that failed are passed over.
  void add(std::int64_t first, std::span<const EnsembleMember> members);
  void merge(const RowStatistics& later);
  // One row of groups() for each epoch.
  std::vector<double> rows() const;
  // When the events came, over all members.
  std::vector<EnsembleReport::FirstTimes> first_times() const;
  std::vector<EnsembleReport::Histogram> histograms() const;
  void serialize(Archive& bytes);

 private:
  void add_attitudes(std::int64_t first, std::span<const EnsembleMember> members,
                     std::span<const std::size_t> rows);
  void add_fractions(std::int64_t first, std::span<const EnsembleMember> members,
                     std::span<const std::size_t> rows);
  void add_events(std::int64_t first, std::span<const EnsembleMember> members);
  void add_to_histograms(std::int64_t first, std::span<const EnsembleMember> members,
                         std::span<const std::size_t> rows);

  const StatisticsFrame* frame_;
  std::vector<std::int64_t> counts_;  // members at each epoch
  std::vector<ensemble::NumberMoments> moments_;
  std::vector<ensemble::Quantiles> quantiles_;
  std::vector<ensemble::AttitudeSpread> attitudes_;
  std::vector<ensemble::Fractions> modes_;
  std::vector<ensemble::Fractions> parts_;  // without and within
  std::vector<ensemble::FirstEvents> events_;
  std::vector<std::int64_t> happened_;  // by event and epoch: since the epoch before
  std::vector<std::vector<MemberHistogram>> histograms_;  // by time
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
