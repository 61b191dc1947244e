// SPDX-License-Identifier: MIT
#include "polhode/dynamics/detail/event_watch.hpp"

#include <limits>
#include <numbers>

#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// In the time of the fastest turn. With slopes a function is known by twice as many numbers: a sine
// of three times that frequency is still distinguished from its neighbours.
constexpr double looks_per_turn = 12.0;
// Over which a slope is taken, in intervals; and in roundings of the time, where these are coarse.
constexpr double short_while = 0x1p-16;
constexpr double roundings = 64.0 * std::numeric_limits<double>::epsilon();
// In one step, in which nobody can stop the run: minutes.
constexpr double most_looks = 1e8;

}  // namespace

double time_between_looks(double turning_rate) {
  return 2.0 * std::numbers::pi / turning_rate / looks_per_turn;
}

double time_of_slope(double from, double to, double n) {
  const double h = to - from;
  const double least = roundings * std::fmax(std::fabs(from), std::fabs(to));
  return std::copysign(std::fmax(short_while * std::fabs(h / n), least), h);
}

bool are_too_many_looks(double n) { return n > most_looks; }

std::string nan_event_text(const std::string& event, double t) {
  return "event \"" + event + "\" is NaN after t = " + number_text(t) +
         ": mend its function, or leave it out";
}

std::string too_many_looks_text(const std::string& event, double interval, double from, double to) {
  std::string text = "event \"" + event + "\" needs more than " + number_text(most_looks) +
                     " looks in the step from t = " + number_text(from) + " to " + number_text(to) +
                     ": ";
  if (interval > 0.0) text += "is its interval of " + number_text(interval) + " too short? ";
  return text + "Give the method a largest_step, or take free_events where the body is free";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
