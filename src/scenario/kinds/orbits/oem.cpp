// SPDX-License-Identifier: MIT
// [orbit.NAME] from a CCSDS Orbit Ephemeris Message.
#include "polhode/tables/oem.hpp"

#include <algorithm>
#include <utility>

#include "polhode/ephemeris/date.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"
#include "scenario/tables/state.hpp"
#include "text/dates.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::string_view equatorial[] = {"EME2000", "J2000", "ICRF", "GCRF"};
constexpr double gps_behind_tai = 19.0;  // s

// A date of the file; GPS as TAI, which is `gps_behind_tai` ahead.
ephemeris::Date date_of(std::string_view scale, const CivilTime& time) {
  constexpr std::int64_t second = 1'000'000'000;
  const std::string text = civil_text(time);
  const auto part = [&](std::size_t at, std::size_t digits) {
    return std::stoi(text.substr(at, digits));
  };
  const ephemeris::CalendarTime at{
      part(0, 4),  part(5, 2),  part(8, 2),
      part(11, 2), part(14, 2), part(17, 2) + static_cast<double>(time.nano % second) / second};
  return ephemeris::calendar_date(
      scale == "GPS" ? ephemeris::TimeScale::TAI : *ephemeris::time_scale(scale), at);
}

// Seconds from the state's epoch to a date of the file: exact where both have one scale.
double since_epoch(const OrbitContext& at, const std::string& file_scale, const CivilTime& date) {
  const std::string epoch = state_table(at.file_values())->epoch.value();
  if (scale_of_epoch(epoch) == file_scale)
    return seconds_between(file_scale, time_of_epoch(epoch), date);
  const Clock clock = clock_of(at.file_values(), at.key_path("file"));
  return ephemeris::seconds_between(clock.epoch, date_of(file_scale, date), clock.dut1) +
         (file_scale == "GPS" ? gps_behind_tai : 0.0);
}

// ICRF3 is the ICRF too.
bool is_equatorial(const std::string& frame) {
  return std::any_of(std::begin(equatorial), std::end(equatorial), [&](std::string_view name) {
    return frame.starts_with(name) &&
           frame.find_first_not_of("0123456789", name.size()) == std::string::npos;
  });
}

void require_keys(const OrbitContext& at) {
  for (const char* own : {"columns", "time_format", "time_scale", "time_unit", "length_unit",
                          "velocity_unit", "axes"})
    if (at.is_explicit(own)) at.refuse(own, "an OEM says this itself; expected none");
  if (!state_table(at.file_values())->epoch)
    at.refuse("file", "an OEM has dates; expected epoch in [state]");
  if (at.state_axes() == "inertial")
    at.refuse(
        "file",
        "an OEM has axes; expected axes = \"equator-J2000\" or \"ecliptic-J2000\" in [state]");
}

PositionTable table_of(const OrbitContext& at, const OemSegment& segment, double first) {
  const Units& units = at.units();
  const double time = units.to_core(1.0, "s", Dimension::time);
  const double length = units.to_core(1.0, "km", Dimension::length);
  const std::string axes = at.state_axes();
  PositionTable table;
  for (std::size_t k = 0; k < segment.t.size(); ++k) {
    const Vec3 x = in_other_axes(segment.position[k], "equator-J2000", axes);
    const Vec3 v = in_other_axes(segment.velocity[k], "equator-J2000", axes);
    table.times.push_back(time * (first + segment.t[k]));
    table.positions.push_back(length * x);
    table.velocities.push_back((length / time) * v);
  }
  return table;
}

// "OEM iss.oem (ISS from EARTH)"
std::string text_of(const std::string& file, const OemSegment& segment) {
  return "OEM " + printable(file) + " (" + printable(segment.object_name) + " from " +
         printable(segment.center) + ")";
}

}  // namespace

// The segment that covers the run; the last, for its message, where none does.
ScenarioOrbit oem_orbit(const OrbitContext& at, const std::string& file, std::optional<double> gm,
                        int order) {
  require_keys(at);
  return at.built("file", [&]() -> ScenarioOrbit {
    const std::string path = at.file_at("file");
    const OrbitEphemeris message = read_oem(path);
    const std::optional<TimeSpan> span = at.run_span();
    const std::string& scale = message.segments.front().time_system;
    const auto time = [&](const std::string& text) {
      return at.units().to_core(since_epoch(at, scale, *civil_time(text, true)), "s",
                                Dimension::time);
    };
    const double first =
        since_epoch(at, scale, *civil_time(message.segments.front().epochs.front(), true));
    std::string covered;
    for (const OemSegment& segment : message.segments) {
      if (!is_equatorial(segment.frame))
        throw DomainError(printable(path, path.size()) + ":" + std::to_string(segment.frame_line) +
                          ": REF_FRAME = " + printable(segment.frame) +
                          "; expected EME2000, ICRF or GCRF");
      PositionTable table = table_of(at, segment, first);
      const double overhang = overhang_of(at, table.times, true);
      const bool inside = !span || (time(segment.start) - overhang <= span->first &&
                                    span->last <= time(segment.stop) + overhang);
      if (inside)
        return {{},
                TableOrbit(std::move(table), order, overhang),
                positive_gm(at, gm),
                {"oem"},
                text_of(file, segment)};
      covered += (covered.empty() ? "" : ", ") + printable(segment.start) + " to " +
                 printable(segment.stop);
    }
    throw DomainError("its segments may be used from " + covered + " " + scale +
                      "; expected one with all of the run (t = 0 is part of it)");
  });
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
