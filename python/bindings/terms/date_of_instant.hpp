// SPDX-License-Identifier: MIT
// A Date from what other libraries of Python call an instant: datetime, NumPy's datetime64, the
// Time of astropy (or any other object with jd1, jd2 and scale).
#pragma once

#include "bindings.hpp"
#include "polhode/ephemeris/date.hpp"

namespace polhode::python {

// `scale`: a TimeScale, its name, or None. A datetime with a time zone is UTC, a Time knows its own
// scale; a datetime without a time zone, datetime64 and a text without a scale need one. TypeError
// and ValueError say what to write.
ephemeris::Date date_of_instant(nb::handle instant, nb::handle scale);

// Has all that a Date is made of: a datetime with a time zone, or a Time.
bool is_whole_instant(nb::handle value) noexcept;

}  // namespace polhode::python
