// SPDX-License-Identifier: MIT
#include "terms/date_of_instant.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "interface/choice.hpp"
#include "polhode/error.hpp"
#include "polhode/text/units.hpp"

namespace polhode::python {

namespace {

using MayScale = std::optional<ephemeris::TimeScale>;

std::string text_of(nb::handle value) { return nb::cast<std::string>(nb::repr(value)); }

[[noreturn]] void refuse(nb::handle got, const std::string& why) {
  throw nb::value_error(("Date: instant: got " + text_of(got) + why).c_str());
}

bool is_a(nb::handle value, const char* module, const char* type) {
  return nb::isinstance(value, nb::module_::import_(module).attr(type));
}

bool has_julian_date(nb::handle value) {
  return nb::hasattr(value, "jd1") && nb::hasattr(value, "jd2") && nb::hasattr(value, "scale");
}

bool has_zone(nb::handle datetime) { return !datetime.attr("utcoffset")().is_none(); }

// A day and the seconds since it began.
struct Day {
  int year, month, day;
  double seconds;
};

ephemeris::Date date_of_day(ephemeris::TimeScale scale, const Day& d) {
  const int whole = static_cast<int>(std::floor(d.seconds));
  const double second = whole % 60 + (d.seconds - whole);
  return ephemeris::calendar_date(scale,
                                  {d.year, d.month, d.day, whole / 3600, whole / 60 % 60, second});
}

int integer(nb::handle value, const char* name) { return nb::cast<int>(value.attr(name)); }

ephemeris::Date date_of_datetime(nb::handle given, MayScale scale) {
  nb::object instant = nb::borrow(given);
  if (has_zone(given)) {
    if (scale.value_or(ephemeris::TimeScale::UTC) != ephemeris::TimeScale::UTC)
      refuse(given, ", which has a time zone and hence is UTC; expected no scale: Date(...).to(\"" +
                        std::string(ephemeris::name(*scale)) + "\") converts it");
    scale = ephemeris::TimeScale::UTC;
    const nb::object utc = nb::module_::import_("datetime").attr("timezone").attr("utc");
    instant = given.attr("astimezone")(utc);
  } else if (!scale) {
    refuse(given,
           ", which has no time zone; expected tzinfo=datetime.timezone.utc, or a scale: "
           "Date(instant, \"UTC\")");
  }
  double second = integer(instant, "second") + 1e-6 * integer(instant, "microsecond");
  if (nb::hasattr(instant, "nanosecond"))  // of pandas
    second += 1e-9 * integer(instant, "nanosecond");
  return ephemeris::calendar_date(
      *scale, {integer(instant, "year"), integer(instant, "month"), integer(instant, "day"),
               integer(instant, "hour"), integer(instant, "minute"), second});
}

ephemeris::Date date_of_datetime64(nb::handle instant, MayScale scale) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  if (nb::cast<bool>(nb::bool_(numpy.attr("isnat")(instant)))) refuse(instant, "; expected a date");
  if (!scale) refuse(instant, ", which has no scale; expected one: Date(instant, \"UTC\")");
  const auto in = [&](const char* unit) {
    return nb::object(instant.attr("astype")(nb::str(unit)));
  };
  const auto count = [](const nb::object& value) {
    return nb::cast<long>(nb::object(value.attr("astype")("int64")));
  };
  const nb::object year = in("datetime64[Y]"), month = in("datetime64[M]");
  const nb::object day = in("datetime64[D]");
  const long years = 1970 + count(year);
  if (std::abs(years) > 9999) refuse(instant, "; expected a year from -4799 to 9999");
  const nb::object of_day = instant - day, second = numpy.attr("timedelta64")(1, "s");
  return date_of_day(
      *scale,
      {static_cast<int>(years),
       static_cast<int>(count(month) - count(nb::object(year.attr("astype")("datetime64[M]")))) + 1,
       static_cast<int>(count(nb::object(day - month.attr("astype")("datetime64[D]")))) + 1,
       nb::cast<double>(nb::float_(of_day / second))});
}

ephemeris::Date date_of_time(nb::handle instant, MayScale scale) {
  if (nb::hasattr(instant, "shape") && nb::len(nb::object(instant.attr("shape"))) != 0)
    refuse(instant, ", an array; expected one instant");
  auto word = nb::cast<std::string>(nb::str(nb::object(instant.attr("scale")).attr("upper")()));
  const MayScale own = ephemeris::time_scale(word);
  if (!own) {
    std::transform(word.begin(), word.end(), word.begin(), [](char c) {
      return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    refuse(instant,
           " in the scale " + word + "; expected utc, tai, tt, tdb or ut1: convert it first");
  }
  if (scale && *scale != *own)
    refuse(instant, ", whose scale is " + std::string(ephemeris::name(*own)) +
                        "; expected no other scale: Date(...).to(\"" +
                        std::string(ephemeris::name(*scale)) + "\") converts it");
  const auto part = [&](const char* which) {
    return nb::cast<double>(nb::float_(nb::object(instant.attr(which))));
  };
  const ephemeris::Date date{*own, part("jd1"), part("jd2")};
  if (!std::isfinite(date.day) || !std::isfinite(date.fraction))
    refuse(instant, "; expected a date");
  return date;
}

ephemeris::Date date_of_text(nb::handle instant, MayScale scale) {
  auto text = nb::cast<std::string>(instant);
  if (scale) text += " " + std::string(ephemeris::name(*scale));
  try {
    return io::epoch_date(text);
  } catch (const DomainError& error) {
    throw DomainError("Date: got \"" + text + "\"; " + error.what());
  }
}

}  // namespace

ephemeris::Date date_of_instant(nb::handle given, nb::handle scale_given) {
  MayScale scale;
  if (!scale_given.is_none()) scale = choice<ephemeris::TimeScale>(scale_given, "scale");
  if (nb::isinstance<nb::str>(given)) return date_of_text(given, scale);
  if (is_a(given, "datetime", "datetime")) return date_of_datetime(given, scale);
  if (has_julian_date(given)) return date_of_time(given, scale);
  if (is_a(given, "numpy", "datetime64")) return date_of_datetime64(given, scale);
  throw nb::type_error(("Date: instant: got " + text_of(given) +
                        "; expected a text, a datetime.datetime, a numpy.datetime64, a Time of "
                        "astropy, or a scale and a Julian date")
                           .c_str());
}

bool is_whole_instant(nb::handle value) noexcept {
  try {
    return has_julian_date(value) || (is_a(value, "datetime", "datetime") && has_zone(value));
  } catch (...) {  // a time zone of the user's that fails
    return false;
  }
}

}  // namespace polhode::python
