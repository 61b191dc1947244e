// SPDX-License-Identifier: MIT
// epoch_date: a date as scenarios write it, as an instant.
//
// Units       days.
// Domain      "2013-01-05 UTC", "2013-01-05T18:30:00.25 TT", "JD 2456297.5 TDB": a day of the
//             calendar, with or without time, or a Julian date, then the scale: UTC, TAI, TT, TDB,
//             UT1; "2013-01-05T18:30:00Z" is UTC. 23:59:60 where UTC had a leap second. "JD x UTC"
//             is the quasi-JD of Date: on a day with a leap second .0 is 12:00:00.5.
// Accuracy    that of Date.
// Errors      DomainError, saying what of the text is wrong.
// Cost        a microsecond.
#pragma once

#include <string_view>

#include "polhode/ephemeris/date.hpp"

namespace polhode {
inline namespace v0 {

Date epoch_date(std::string_view text);

}  // namespace v0
}  // namespace polhode
