// SPDX-License-Identifier: MIT
// RowDates: what files write in the column date of a row, whose number is t.
//
// Equations   none of its own; scales as in polhode/ephemeris/date.hpp.
// Units       t in that of the rows.
// Domain      an epoch in UTC, TAI, TT or TDB; years 0 to 9999, in UTC from 1972. ISO 8601 in the
//             scale of the epoch, "2029-04-13T21:46:00" or with six digits behind the point; a leap
//             second is the 60th.
// Accuracy    half a microsecond, and what a double holds of t.
// Errors      DomainError for an epoch that is not there, UT1, which does not run evenly, and dates
//             beyond those years.
// Cost        0.3 us a date; 8 us in TDB.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "polhode/output/sink.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

class RowDates {
 public:
  // Of rows of these columns: the first and the last date are tried.
  RowDates(const std::vector<ColumnGroup>& groups, const RunFacts& run);

  // Whether there is such a column, and whether it is number `column` of a row.
  bool any() const { return clock_ != nullptr; }
  bool is_date(std::size_t column) const { return any() && dates_[column]; }
  // The date of a row; any() must hold.
  std::string text(double t) const;

 private:
  struct Clock;
  std::vector<bool> dates_;
  std::shared_ptr<const Clock> clock_;
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
