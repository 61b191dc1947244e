// SPDX-License-Identifier: MIT
// Units of a scenario file: what its bare numbers mean, what its "27.38 h" mean, and what its
// outputs carry. The only place of polhode that knows units; the library behind it is scale-free.
//
// Units       core units: time in the scenario's unit of time, angles in radians, moments in the
//             scenario's unit of moment, lengths in its unit of length; so rates are rad per unit
//             of time, momenta moment/time, energies and torques moment/time^2, GM length^3/time^2,
//             a mass moment/length^2; currents in A. The unit of angle touches angles and angular
//             rates, never momenta.
// Domain      a closed list (known_units) and its products and powers; nothing is read from disk or
//             from the environment.
// Accuracy    a unit that equals the core unit leaves a number bit for bit; a whole ratio either
//             way is rounded once; any other once in the factor and once in the product.
// Errors      DomainError in one line: unknown unit (with the nearest known one), wrong dimension.
// Cost        building parses four texts; a bare number costs one multiplication. What parses a
//             unit waits for other threads that do.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "polhode/ephemeris/date.hpp"
#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace io {

enum class Dimension {
  number,
  time,
  angle,
  rate,
  moment,
  momentum,
  energy,
  length,
  gm,       // a gravitational parameter
  torque,   // like an energy
  damping,  // a torque per angular rate: like a momentum
  mass,     // a moment over a length squared, as all that follows is made of core units
  area,
  speed,
  density,
  pressure,
  magnetic_field,
  magnetic_moment,  // of a dipole: current times area
  magnetic_tensor,  // a torque per angular rate and field squared
  moment3,          // a mass times a length cubed
  moment4,          // a mass times the fourth power of a length
  root_momentum,    // the square root of a momentum, with units like sqrt(kg m2/s)
  growth            // of a pure number, per time
};

// "a time", "an angular rate", ...: for messages and documents.
std::string_view dimension_name(Dimension dimension);

struct KnownUnit {
  std::string_view symbol;  // what a file writes: "h"
  std::string_view name;    // what it is: "hour"
  double factor;            // of the unit or product before it in the table
  std::string_view base;    // that unit, "min"; empty for a base unit
};
std::span<const KnownUnit> known_units();

class Units {
 public:
  explicit Units(std::string_view time = "s", std::string_view angle = "rad",
                 std::string_view moment = "1", std::string_view length = "1");

  const std::string& time() const { return time_; }
  const std::string& angle() const { return angle_; }
  const std::string& moment() const { return moment_; }
  const std::string& length() const { return length_; }

  // A number without a unit, as a file of these units means it, in core units.
  double to_core(double value, Dimension dimension) const;
  // A number with a unit of its own, in core units.
  double to_core(double value, std::string_view unit, Dimension dimension) const;
  // A core number in the units of the file: what outputs carry.
  double from_core(double value, Dimension dimension) const;
  // How an output names that unit: "deg/h"; "1" for pure numbers.
  std::string label(Dimension dimension) const;

 private:
  std::string time_;
  std::string angle_;
  std::string moment_;
  std::string length_;
  double angle_in_rad_ = 1.0;
  double rad_in_angle_ = 1.0;
};

// A number and the text behind it: "27.38 h" is {27.38, "h"}.
struct Quantity {
  double value;
  std::string unit;
};
// Throws DomainError unless the text is one finite number, then a unit.
Quantity quantity_from_text(std::string_view text);

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

ephemeris::Date epoch_date(std::string_view text);

}  // namespace io
}  // namespace v0
}  // namespace polhode
