// SPDX-License-Identifier: MIT
#include "polhode/detail/output/row_dates.hpp"

#include <cmath>

#include "polhode/ephemeris/date.hpp"
#include "polhode/error.hpp"
#include "polhode/text/units.hpp"
#include "text/dates.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr double day = 86400.0;
constexpr double micro = 1e6;      // in a second
constexpr double farthest = 3e11;  // in seconds: more than 9999 years

[[noreturn]] void refuse() { throw DomainError("date: expected the years 0 to 9999"); }

// TDB - TT in s, `seconds` of TT after the epoch.
double tdb_offset(const ephemeris::Date& epoch, double seconds) {
  const ephemeris::Date tt = ephemeris::date_after(epoch, seconds);
  const ephemeris::Date tdb = ephemeris::converted(tt, ephemeris::TimeScale::TDB);
  return day * ((tdb.day - tt.day) + (tdb.fraction - tt.fraction));
}

}  // namespace

struct RowDates::Clock {
  explicit Clock(const RunFacts& run)
      : scale(detail::scale_of_epoch(run.epoch)),
        epoch(detail::time_of_epoch(run.epoch)),
        date(epoch_date(run.epoch)),
        seconds(run.seconds),
        offset(scale == "TDB" ? tdb_offset(date, 0.0) : 0.0) {}

  // In the scale of the epoch, in whole microseconds: with none of a second there is no point.
  std::string text(double t) const {
    double elapsed = t * seconds;
    if (scale == "TDB") elapsed += tdb_offset(date, elapsed) - offset;
    elapsed = std::rint(elapsed * micro) / micro;
    if (!(std::fabs(elapsed) < farthest)) refuse();
    const detail::CivilTime time = detail::after(scale, epoch, elapsed);
    if (!detail::has_text(time)) refuse();
    const std::string full = detail::civil_text(time);  // ends in nine digits
    const std::size_t point = full.size() - 10;
    const bool whole = full.compare(point + 1, 6, "000000") == 0;
    return full.substr(0, whole ? point : point + 7);
  }

  std::string scale;
  detail::CivilTime epoch;
  ephemeris::Date date;
  double seconds;
  double offset;
};

RowDates::RowDates(const std::vector<ColumnGroup>& groups, const RunFacts& run) {
  bool found = false;
  for (const ColumnGroup& group : groups)
    for (const Column& column : group.columns) {
      dates_.push_back(column.is_date);
      found = found || column.is_date;
    }
  if (!found) return;
  if (run.epoch.empty()) throw DomainError("date: got no epoch; expected state.epoch");
  if (detail::scale_of_epoch(run.epoch) == "UT1")
    throw DomainError(
        "date: the epoch is in UT1, which does not run evenly; expected UTC, TAI, TT or TDB");
  clock_ = std::make_shared<const Clock>(run);
  static_cast<void>(text(run.first));
  static_cast<void>(text(run.last));
}

std::string RowDates::text(double t) const { return clock_->text(t); }

}  // namespace io
}  // namespace v0
}  // namespace polhode
