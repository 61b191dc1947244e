// SPDX-License-Identifier: MIT
// Dates in the scales of astronomy, and where Sun, Moon and planets are.
#include <cmath>

#include "interface/arrays.hpp"
#include "interface/choice.hpp"
#include "interface/value.hpp"
#include "polhode/ephemeris/ephemeris.hpp"
#include "polhode/error.hpp"
#include "terms/date_of_instant.hpp"
#include "terms/orbit_value.hpp"

namespace polhode::python {

namespace {

nb::tuple arguments_of(const ephemeris::Date& d) {
  return nb::make_tuple(d.scale, d.day, d.fraction);
}

ephemeris::Planetary body_of(nb::handle value, const char* name) {
  return choice<ephemeris::Planetary>(value, name);
}

void make_date(ephemeris::Date* self, const OneOf<ephemeris::TimeScale>& scale, double day,
               double fraction) {
  if (!std::isfinite(day) || !std::isfinite(fraction))
    throw DomainError("Date: day " + number_text(day) + " and fraction " + number_text(fraction) +
                      " must be finite");
  new (self) ephemeris::Date{choice<ephemeris::TimeScale>(scale, "scale"), day, fraction};
}

// A datetime with a time zone or a Time of astropy, where a Date is expected.
class WholeInstant : public nb::object {
  NB_OBJECT_DEFAULT(WholeInstant, nb::object, "datetime.datetime", is_one)
  static bool is_one(PyObject* value) { return is_whole_instant(value); }
};

// The scale of an instant: no number, which is the day of a Julian date.
class ScaleOfInstant : public nb::object {
  NB_OBJECT_DEFAULT(ScaleOfInstant, nb::object, "TimeScale | str", is_one)
  static bool is_one(PyObject* value) {
    return PyUnicode_Check(value) || nb::isinstance<ephemeris::TimeScale>(value);
  }
};

void bind_dates(nb::module_& m) {
  nb::enum_<ephemeris::TimeScale>(m, "TimeScale", "A time scale of astronomy.")
      .value("UTC", ephemeris::TimeScale::UTC)
      .value("TAI", ephemeris::TimeScale::TAI)
      .value("TT", ephemeris::TimeScale::TT)
      .value("TDB", ephemeris::TimeScale::TDB)
      .value("UT1", ephemeris::TimeScale::UT1);
  nb::class_<ephemeris::Date> c(m, "Date",
                                R"(An instant: a Julian date in two parts, in a time scale.

Parameters
----------
scale : TimeScale, or its name: UTC, TAI, TT, TDB, UT1.
day, fraction : days; their sum is the Julian date. Of UTC it is the quasi-JD of ERFA, in which a
    day with a leap second is stretched.
instant : instead of these, a date as the `epoch` of a scenario: "2013-01-05T18:30:00 UTC",
    "2013-01-05T18:30:00Z", "JD 2456297.5 TDB"; a datetime.datetime, which is UTC if it has a time
    zone; a numpy.datetime64; a Time of astropy, in its own scale. What has no scale needs one:
    Date(instant, "TDB").

Functions that take a Date take such an instant too, if it has a scale. ValueError for others.)");
  c.def("__init__", make_date, "scale"_a, "day"_a, "fraction"_a = 0.0)
      .def(
          "__init__",
          [](ephemeris::Date* self,
             const Typed<"str | datetime.datetime | numpy.datetime64 | typing.Any">& instant,
             const std::optional<ScaleOfInstant>& scale) {
            new (self) ephemeris::Date(
                date_of_instant(instant, scale ? nb::object(*scale) : nb::object(nb::none())));
          },
          "instant"_a, "scale"_a = nb::none())
      .def_ro("scale", &ephemeris::Date::scale, "Its time scale.")
      .def_ro("day", &ephemeris::Date::day, "The first part, days.")
      .def_ro("fraction", &ephemeris::Date::fraction, "The second part, days.")
      .def_prop_ro("is_dubious", &ephemeris::is_dubious,
                   "Whether the leap seconds of this UTC date are a guess.")
      .def(
          "to",
          [](const ephemeris::Date& d, OneOf<ephemeris::TimeScale> scale,
             std::optional<double> dut1) {
            return ephemeris::converted(d, choice<ephemeris::TimeScale>(scale, "scale"), dut1);
          },
          "scale"_a, "dut1"_a = nb::none(),
          "The same instant in another scale. UT1 needs dut1 = UT1 - UTC in s. ValueError without.")
      .def_prop_ro(
          "calendar",
          [](const ephemeris::Date& d) {
            const ephemeris::CalendarTime t = ephemeris::calendar_time(d);
            return std::make_tuple(t.year, t.month, t.day, t.hour, t.minute, t.second);
          },
          "Year, month, day, hour, minute, second; 60 and more in a leap second.")
      .def("__repr__", [](const ephemeris::Date& d) {
        return "Date('" + std::string(ephemeris::name(d.scale)) + "', " + number_text(d.day) +
               ", " + number_text(d.fraction) + ")";
      });
  def_value(c, [](const ephemeris::Date& d) { return arguments_of(d); });
  nb::implicitly_convertible<nb::str, ephemeris::Date>();
  nb::implicitly_convertible<WholeInstant, ephemeris::Date>();
}

void bind_time(nb::module_& m) {
  m.def(
      "calendar_date",
      [](OneOf<ephemeris::TimeScale> scale, int year, int month, int day, int hour, int minute,
         double second) {
        return ephemeris::calendar_date(choice<ephemeris::TimeScale>(scale, "scale"),
                                        {year, month, day, hour, minute, second});
      },
      "scale"_a, "year"_a, "month"_a, "day"_a, "hour"_a = 0, "minute"_a = 0, "second"_a = 0.0,
      "The Date of a time of the Gregorian calendar. 23:59:60 is one where UTC had a leap second. "
      "ValueError for a time that is not there.");
  m.def(
      "seconds_between",
      [](const ephemeris::Date& from, const ephemeris::Date& to, std::optional<double> dut1) {
        return ephemeris::seconds_between(from, to, dut1);
      },
      "start"_a, "end"_a, "dut1"_a = nb::none(),
      "SI seconds of TT from one Date to another, whatever their scales.");
  m.def(
      "date_after",
      [](const ephemeris::Date& date, double seconds, std::optional<double> dut1) {
        return ephemeris::date_after(date, seconds, dut1);
      },
      "date"_a, "seconds"_a, "dut1"_a = nb::none(),
      "The Date, in TT, so many seconds of TT later.");
}

void bind_planets(nb::module_& m) {
  nb::enum_<ephemeris::Planetary>(m, "Planetary", "A body whose positions are known.")
      .value("sun", ephemeris::Planetary::sun)
      .value("mercury", ephemeris::Planetary::mercury)
      .value("venus", ephemeris::Planetary::venus)
      .value("earth", ephemeris::Planetary::earth)
      .value("moon", ephemeris::Planetary::moon)
      .value("mars", ephemeris::Planetary::mars)
      .value("jupiter", ephemeris::Planetary::jupiter)
      .value("saturn", ephemeris::Planetary::saturn)
      .value("uranus", ephemeris::Planetary::uranus)
      .value("neptune", ephemeris::Planetary::neptune);
  m.def(
      "planetary_gm",
      [](OneOf<ephemeris::Planetary> body) {
        return ephemeris::planetary_gm(body_of(body, "body"));
      },
      "body"_a, "Gravitational parameter, km^3/s^2 (DE440); from Mars on of planet and moons.");
  m.def(
      "planetary_position",
      [](OneOf<ephemeris::Planetary> target, OneOf<ephemeris::Planetary> centre,
         const ephemeris::Date& date) {
        return array_of(ephemeris::planetary_position(body_of(target, "target"),
                                                      body_of(centre, "centre"), date));
      },
      "target"_a, "centre"_a, "date"_a,
      "(3,), km, along equator and equinox of J2000 (ICRS), without light time; by ERFA. "
      "ValueError for dates outside 1000 to 3000; planetary_error says how good it is.");
  m.def(
      "planetary_error",
      [](OneOf<ephemeris::Planetary> target, OneOf<ephemeris::Planetary> centre,
         const ephemeris::Date& date) {
        return ephemeris::planetary_error(body_of(target, "target"), body_of(centre, "centre"),
                                          date);
      },
      "target"_a, "centre"_a, "date"_a,
      "How far such a position may be off across the line of sight, arcsec, at the distance of the "
      "date: at most, in the best years of the theories, an estimate in others "
      "(docs/guide/orbits.md). Errors along the radius from the Sun, which are smaller, are left "
      "out. NaN outside 1000 to 3000; ValueError for a body seen from itself.");
  m.def(
      "planetary_orbit",
      [](OneOf<ephemeris::Planetary> target, OneOf<ephemeris::Planetary> centre,
         const ephemeris::Date& epoch, double first, double last, double tolerance) {
        const ephemeris::Planetary of = body_of(target, "target"), from = body_of(centre, "centre");
        ephemeris::EphemerisTable table{};
        {
          const WithoutGil released;
          table = ephemeris::planetary_table(of, from, epoch, first, last, tolerance);
        }
        return TableOrbit(std::move(table.rows), table.order);
      },
      "target"_a, "centre"_a, "epoch"_a, "first"_a, "last"_a, "tolerance"_a = 1e-10,
      "Such positions (km) as a TableOrbit from `first` to `last`, s of TT after `epoch`. Between "
      "its rows it is right to `tolerance` of the distance.");
  m.def(
      "j2000_from_teme",
      [](const ephemeris::Date& date) { return array_of(ephemeris::j2000_from_teme(date)); },
      "date"_a,
      "(3, 3): turns components along TEME, the axes of SGP4, into those along equator and equinox "
      "of J2000.");
}

}  // namespace

void bind_ephemeris(nb::module_& m) {
  bind_dates(m);
  bind_time(m);
  bind_planets(m);
}

}  // namespace polhode::python
