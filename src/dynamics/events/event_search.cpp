// SPDX-License-Identifier: MIT
// The search for events: where to look along a motion of a System.
#include "dynamics/events/event_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/dynamics/detail/event_watch.hpp"
#include "polhode/error.hpp"

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

// |I^-1 g|^2 is linear in the squares of the components, and so are G^2 and 2 T: along a polhode it
// is linear in the square of the middle component, and largest at an end of its range.
double fastest_rate(const Body& body, const Vec3& g) {
  Vec3 I = body.moments(), w{g.x / I.x, g.y / I.y, g.z / I.z};
  const auto order = [&](int i, int j) {
    if (!(I[i] > I[j])) return;
    std::swap(I[i], I[j]);
    std::swap(w[i], w[j]);
  };
  order(0, 1), order(1, 2), order(0, 1);
  const double now = std::hypot(w.x, w.y, w.z);
  if (!(I.z > I.x) || !(now > 0.0) || !std::isfinite(now)) return now;
  // in units of now: squares w1^2 + c1 w2^2 and w3^2 + c3 w2^2 are constants of the motion
  const double x = w.x / now, y = w.y / now, z = w.z / now;
  const double c1 = I.y * (I.z - I.y) / (I.x * (I.z - I.x));
  const double c3 = I.y * (I.y - I.x) / (I.z * (I.z - I.x));
  const double most = std::fmin((x * x + c1 * y * y) / c1, (z * z + c3 * y * y) / c3);
  const double slope = 1.0 - c1 - c3, rest = 1.0 - slope * y * y;
  return now * std::sqrt(std::fmax(1.0, std::fmax(rest, rest + slope * most)));
}

namespace {

std::variant<RotorField<double>, DamperField<double>> field_of(const System& system) {
  if (system.damper()) return DamperField<double>(system);
  return RotorField<double>(system);
}

}  // namespace

SystemMotion::SystemMotion(const System& system) : field_(field_of(system)), breakpoints_(system) {}

// On the side of s that is asked for.
DoubleDouble SystemMotion::time_of_rates(const Sample& s, bool forward) const {
  ++evaluations_;
  const double far = (forward ? 1.0 : -1.0) * std::numeric_limits<double>::infinity();
  return breakpoints_.stretch(s.t, far).inside(s.t);
}

Sample SystemMotion::moved(const Sample& s, double time) const {
  const DoubleDouble t = time_of_rates(s, time > 0.0);
  const auto moved_in = [&]<class Field>(const Field& field) -> Sample {
    typename Field::Values y = Field::values(s.s);
    const typename Field::Values r = field(t, y);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = y[i] + time * r[i];
    return {s.t + time, Field::state(y)};
  };
  return std::visit(moved_in, field_);
}

double SystemMotion::turning_rate(const Sample& s, bool forward) const {
  const DoubleDouble t = time_of_rates(s, forward);
  const auto rate_in = [&]<class Field>(const Field& field) {
    const System& system = field.system();
    const typename Field::Values r = field(t, Field::values(s.s));
    const double relative = 2.0 * std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
    const double frame = system.frame().is_inertial() ? 0.0 : norm(system.frame().at(s.t).mu_S);
    return std::fmax(relative, fastest_rate(system.body(), s.s.g)) + frame;
  };
  return std::visit(rate_in, field_);
}

template class EventWatch<SystemMotion>;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
