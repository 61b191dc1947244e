// SPDX-License-Identifier: MIT
#include "run/detail/spin_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "polhode/free/tumbler.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

struct Pole {
  double longitude;
  double latitude;
};

// Of the momentum in inertial axes; |G| > 0.
Pole pole_of(const System& system, double t, const RotorState& state) {
  const Vec3 k = inertial_momentum(inertial_state(system, t, state));
  const double longitude = std::atan2(k.y, k.x);
  return {longitude < 0.0 ? longitude + turn : longitude, std::atan2(k.z, std::hypot(k.x, k.y))};
}

// What the two angles of a pole are called.
std::string pole_label(const Rotation& rotation) {
  if (rotation.axes == "equator-J2000") return "pole (RA, Dec)";
  return rotation.axes == "ecliptic-J2000" ? "pole (ecliptic longitude, latitude)"
                                           : "pole (longitude, latitude)";
}

std::string mode_text(Regime regime) {
  switch (regime) {
    case Regime::rest:
      return "at rest";
    case Regime::steady:
      return "steady spin";
    case Regime::short_axis:
      return "SAM";
    case Regime::long_axis:
      return "LAM";
    case Regime::separatrix:
      return "separatrix";
  }
  return {};
}

// "SAM, P_phi 30.56 h, P_psi 263 h, pole 250, -75 deg"
std::string spin_text(const System& system, const Units& units, double t, const RotorState& s) {
  const FreeRotation motion(system.body(), s, t);
  std::string text = mode_text(motion.regime());
  if (motion.regime() == Regime::rest) return text;
  const auto period = [&](double core) {
    return fmt::format("{:.8g} {}", units.from_core(core, Dimension::time), units.time());
  };
  const bool tumbles =
      motion.regime() == Regime::short_axis || motion.regime() == Regime::long_axis;
  text += (tumbles ? ", P_phi " : ", period ") + period(turn / motion.precession_rate_long());
  if (tumbles) text += ", P_psi " + period(motion.polhode_period());
  const Pole pole = pole_of(system, t, s);
  return text + fmt::format(", pole {:.7g}, {:.7g} {}",
                            units.from_core(pole.longitude, Dimension::angle),
                            units.from_core(pole.latitude, Dimension::angle), units.angle());
}

// Radius and GM of the Sun, the planets and the Moon: report of the IAU working group on
// cartographic coordinates (Archinal et al. 2018), DE440.
struct KnownBody {
  const char* name;
  double gm;      // km3/s2
  double radius;  // km, mean
};
constexpr KnownBody known_bodies[] = {
    {"the Sun", 132712440041.3, 695700.0}, {"Mercury", 22031.87, 2439.4},
    {"Venus", 324858.59, 6051.8},          {"the Earth", 398600.44, 6371.0084},
    {"the Moon", 4902.8, 1737.4},          {"Mars", 42828.37, 3389.5},
    {"Jupiter", 126686531.9, 69911.0},     {"Saturn", 37931206.2, 58232.0},
    {"Uranus", 5793951.3, 25362.0},        {"Neptune", 6835099.97, 24622.0},
};
constexpr double same_gm = 1e-3;  // relative

// The least in a run, which begins at t = 0; the eccentricity changes evenly.
double least_pericentre(const ScenarioOrbit& orbit, const std::optional<SaveAt>& rows) {
  const KeplerElements& elements = *kepler_elements(orbit);
  const auto* const moving = std::get_if<PrecessingKeplerOrbit>(&orbit.motion);
  double least = elements.pericentre;
  if (moving == nullptr || moving->rates().eccentricity == 0.0 || !rows) return least;
  const double axis = elements.pericentre / (1.0 - elements.eccentricity);
  for (const double t : {0.0, (*rows)[0], (*rows)[rows->size() - 1]})
    least = std::min(least, axis * (1.0 - moving->eccentricity(t)));
  return least;
}

void add_low_orbit(Lines& lines, const ScenarioOrbit& orbit, const std::optional<SaveAt>& rows,
                   const Units& units) {
  const KeplerElements* const elements = kepler_elements(orbit);
  if (elements == nullptr || units.length() == "1") return;
  const Units of_bodies("s", "rad", "1", "km");
  const double km = units.from_core(least_pericentre(orbit, rows), Dimension::length) *
                    of_bodies.to_core(1.0, units.length(), Dimension::length);
  const double gm = units.from_core(elements->gm, Dimension::gm) *
                    of_bodies.to_core(1.0, units.label(Dimension::gm), Dimension::gm);
  for (const KnownBody& body : known_bodies) {
    if (!(std::fabs(gm - body.gm) < same_gm * body.gm) || !(km < body.radius)) continue;
    lines.text("orbit_" + orbit.name + "_note", "of the orbit " + orbit.name,
               fmt::format("its pericentre, {:.6g} km from the centre, is inside {} ({:.0f} km): "
                           "semi_major_axis is no altitude",
                           km, body.name, body.radius));
  }
}

}  // namespace

void add_spin(Lines& lines, const Rotation& rotation, const FreeRotation& motion) {
  if (motion.regime() == Regime::rest) return;
  const Vec3& I = motion.body().moments();
  const double G = motion.momentum();
  // T/G twice: G^2 may be out of range
  lines.number("energy_ratio", "E/E0 (1: least energy for this G)",
               2.0 * (motion.energy() / G) * (std::max({I.x, I.y, I.z}) / G), Dimension::number);
  const TumblingAngles angles = tumbling_angles(motion);
  if (std::isfinite(angles.long_least)) {
    lines.numbers("long_axis_angles", "long axis from momentum, least, most",
                  {angles.long_least, angles.long_most}, Dimension::angle);
    lines.numbers("short_axis_angles", "short axis from momentum, least, most",
                  {angles.short_least, angles.short_most}, Dimension::angle);
  }
  if (motion.regime() == Regime::steady)
    lines.number("wobble_period", "period of a small wobble (limit)", motion.polhode_period(),
                 Dimension::time);
  const Pole pole = pole_of(rotor_system(rotation), 0.0, initial_state(rotation));
  lines.numbers("pole", pole_label(rotation), {pole.longitude, pole.latitude}, Dimension::angle);
}

void add_change(Lines& lines, const Rotation& rotation, const Units& units,
                const DampedSample& end) {
  const System system = rotor_system(rotation);
  lines.text("before", "at t = 0", spin_text(system, units, 0.0, initial_state(rotation)));
  lines.text(
      "after",
      fmt::format("at t = {:.10g} {}", units.from_core(end.t, Dimension::time), units.time()),
      spin_text(system, units, end.t, end.s.rotor));
}

void add_doubts(Lines& lines, const Rotation& rotation, const Scenario& scenario) {
  constexpr double nearly_all = 0.99;
  const auto* const given = std::get_if<AttitudeRate>(&rotation.state);
  if (given != nullptr && std::fabs(given->q.z) > nearly_all)
    lines.text("quaternion_note", "of the quaternion",
               "a turn of nearly 180 deg about axis 3, or one that has its scalar last: it is "
               "[w, x, y, z] here");
  const std::vector<std::string>& columns = scenario.output.columns;
  if (rotation.frame.is_inertial() &&
      std::find(columns.begin(), columns.end(), "roll_pitch_yaw") != columns.end())
    lines.text("roll_pitch_yaw_note", "of roll, pitch and yaw",
               "they count from the inertial axes; [frame.local-vertical] makes them those of an "
               "orbit");
  for (const ScenarioOrbit& orbit : rotation.orbits)
    add_low_orbit(lines, orbit, rotation.time, scenario.units());
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
