// SPDX-License-Identifier: MIT
#include "scenario/fit/light_curve_keys.hpp"

#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void take_format(Observation& o, const KeyValues& table) {
  if (o.light_format == Observation::LightFormat::columns) return;
  if (!table.is_explicit("time_format")) o.time_format = Observation::TimeFormat::julian;
  if (o.light_format == Observation::LightFormat::alcdef && !o.time_scale)
    o.time_scale = TimeScale::UTC;
}

void require_light_curve(const Observation& o, const KeyValues& table) {
  if (o.session_column.size() > 1) table.refuse("session_column", "expected one column");
  if (!o.sun_columns.empty() && o.sun_columns.size() != 3)
    table.refuse("sun_columns", "expected three columns");
  if (!o.observer_columns.empty() && o.observer_columns.size() != 3)
    table.refuse("observer_columns", "expected three columns");
  if (o.orbit.empty() != o.observer_orbit.empty())
    table.refuse(
        o.orbit.empty() ? "observer_orbit" : "orbit",
        o.orbit.empty() ? "expected a key orbit as well" : "expected a key observer_orbit as well");
  for (const char* const key : {"sun_columns", "observer_columns", "to_sun", "to_observer"})
    if (!o.orbit.empty() && table.has(key))
      table.refuse(key, "expected none: orbits give the vectors");
  if (!o.orbit.empty() && table.units().length() == "1")
    table.refuse("orbit", "expected units.length as well, such as \"au\": light takes its time");
  const bool is_alcdef = o.light_format == Observation::LightFormat::alcdef;
  if (!o.sigma && o.sigma_columns.empty() && !is_alcdef)
    table.refuse("kind", o.light_format == Observation::LightFormat::lc
                             ? "expected a key sigma as well: lc has no errors"
                             : "expected a key sigma or sigma_columns as well");
  if (o.light_format == Observation::LightFormat::columns) return;
  if (o.time_format != Observation::TimeFormat::julian)
    table.refuse("format", "expected time_format = \"JD\", which its files have");
  for (const char* const key :
       {"sigma_columns", "session_column", "sun_columns", "observer_columns"})
    if (table.has(key)) table.refuse(key, "expected none: the format has its own columns");
  if (is_alcdef) {
    if (*o.time_scale != TimeScale::UTC)
      table.refuse("time_scale", "expected \"UTC\", as dates of ALCDEF are");
    return;
  }
  if (o.times != LightTime::at_body)
    table.refuse("times", "expected \"at-body\", as those of lc are");
  if (!o.orbit.empty()) table.refuse("orbit", "expected none: lc has vectors");
  if (word(table.values(), "state.axes") == "inertial")
    table.refuse("format", "expected axes of the sky in state.axes, since vectors of lc have such");
  if (o.axes && *o.axes != Observation::Axes::ecliptic)
    table.refuse("axes", "expected \"ecliptic-J2000\", as those of lc are");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
