// SPDX-License-Identifier: MIT
#include "scenario/tables/time.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "math/finite.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::array keys_of_time = {
    quantity_key<&TimeTable::start>("start", Dimension::time, "First row, counted from the epoch.")
        .otherwise("0")
        .or_date(),
    quantity_key<&TimeTable::stop>("stop", Dimension::time,
                                   "Where the run ends. No row lies beyond it.")
        .alternative()
        .example("720")
        .or_date(),
    quantity_key<&TimeTable::step>(
        "step", Dimension::time,
        "Rows at start + k step, each rounded once; negative where stop is before start. In files "
        "of kind obliquity either sign will do. \"auto\": even rows from start to stop, as many as "
        "error asks for and at most a radian of rotation apart.")
        .alternative()
        .example("0.5"),
    quantity_key<&TimeTable::error>(
        "error", Dimension::angle,
        "With step = \"auto\": how far the attitude may be from a rotation about a fixed axis at a "
        "fixed rate between two rows, which is how SPICE interpolates. Left out, 0.01 degrees.")
        .example("\"0.01 deg\"")
        .positive(),
    integer_key<&TimeTable::count>("count",
                                   "Number of rows, evenly from start to stop, both included.")
        .alternative()
        .example("1441"),
    quantity_key<&TimeTable::at>("at", Dimension::time,
                                 "Exactly these times, in this order; leave start out.")
        .alternative()
        .example("[0.0, 1.0, 10.0]")
        .or_date(),
};
constexpr Alternatives sets_of_time[] = {{"time", "stop+step|stop+count|at"}};
constexpr Table<TimeTable> time_description = {
    {.path = "time", .help = "When to write rows; needed by `polhode run`."},
    keys_of_time,
    sets_of_time};

}  // namespace

SchemaPart time_keys() { return part_of<time_description>(); }

Placed<TimeTable> time_table(const FileValues& file) { return {time_description, file}; }

std::optional<SaveAt> times_of(const Placed<TimeTable>& time, bool any_sign) {
  if (!time.is_there()) return std::nullopt;
  if (time->is_automatic())
    time.refuse<&TimeTable::step>("expected a number: automatic rows are those of a rotation");
  if (time->error) time.refuse<&TimeTable::error>("expected step = \"auto\" together with it");
  if (time->at) {
    if (time.is_explicit<&TimeTable::start>())
      time.refuse<&TimeTable::start>("expected no start together with at, which lists every time");
    return SaveAt::times(*time->at);
  }
  const double start = time->start, stop = *time->stop;
  if (!time->step)
    return time.built<&TimeTable::count>([&] { return SaveAt::count(start, stop, time->count); });
  const double step = time->step->number;
  if (!any_sign && time.is_explicit<&TimeTable::start>() && start > stop && step > 0.0)
    time.refuse<&TimeTable::start>("expected a time before stop, since step is positive");
  return time.built<&TimeTable::step>([&] {
    return SaveAt::steps(start, stop, any_sign ? std::copysign(step, stop - start) : step);
  });
}

SaveAt automatic_span(const Placed<TimeTable>& time) {
  return time.built<&TimeTable::stop>([&] { return SaveAt::count(time->start, *time->stop, 2); });
}

// The attitude in the middle of two rows, a time h apart, is h^2/8 times the angular acceleration
// away from a rotation about a fixed axis. The largest one is looked for along the free rotation,
// with the torques there. Rows are at most a radian of rotation apart: a polynomial through 8 of
// them is off by less than 0.01 degrees, and none hides a whole turn.
SaveAt automatic_times(const Rotation& rotation, const Placed<TimeTable>& time) {
  constexpr double usual = 0.01 * std::numbers::pi / 180.0;
  constexpr double margin = 0.9, largest_turn = 1.0, most_rows = 1e8;
  constexpr int looks = 128;
  const double start = time->start, stop = *time->stop, error = time->error.value_or(usual);
  const Problem problem = rotor_problem(rotation);
  const System& system = problem.system;
  const FreeRotation motion(rotation.body, inertial_state(system, 0.0, problem.initial));
  const double span = stop - start, period = std::fabs(motion.polhode_period());
  double acceleration = 0.0, rate = 0.0;
  const auto look = [&](double t) {
    const RotorState s = reference_state(system, t, motion.at(t));
    const Vec3 w = angular_velocity(system, t, s).inertial;
    const Effect e = terms_effect(system, Setting{system.body(), t, s, system.frame().at(t).q_IS});
    const Vec3 moment = cross(s.g, w) + e.u;
    const Vec3& I = system.body().moments();
    acceleration = polhode::detail::larger(
        acceleration, norm(Vec3{moment.x / I.x, moment.y / I.y, moment.z / I.z}));
    rate = polhode::detail::larger(rate, norm(w));
  };
  for (int k = 0; k < looks; ++k) {
    const double part = static_cast<double>(k) / looks;
    look(start + part * span);
    if (period < std::fabs(span)) look(start + std::copysign(part * period, span));
  }
  const double step = std::min(margin * std::sqrt(8.0 * error / acceleration), largest_turn / rate);
  if (std::isnan(acceleration))
    time.refuse<&TimeTable::step>("expected torques that are numbers along the free rotation");
  const double steps = std::isnan(step) ? 1.0 : std::max(std::ceil(std::fabs(span) / step), 1.0);
  if (!(steps < most_rows))
    time.refuse<&TimeTable::step>("it takes " + polhode::detail::number_text(steps) +
                                  " rows; expected an error that 1e8 rows can keep");
  return time.built<&TimeTable::step>(
      [&] { return SaveAt::count(start, stop, static_cast<std::int64_t>(steps) + 1); });
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
