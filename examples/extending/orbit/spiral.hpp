// SPDX-License-Identifier: MIT
// An orbit of your own from positions: a circle that shrinks at a constant rate, as by drag.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "polhode/scenario/orbit_kind.hpp"

struct SpiralArguments {
  double gm;
  double start;
  double descent;
};

inline constexpr polhode::io::KindKey<SpiralArguments> spiral_keys[] = {
    polhode::io::quantity_key<&SpiralArguments::gm>("gm", polhode::io::Dimension::gm,
                                                    "Of the planet.")
        .required()
        .example("\"398600.4418 km3/s2\"")
        .positive(),
    polhode::io::quantity_key<&SpiralArguments::start>("start", polhode::io::Dimension::length,
                                                       "Its radius at t = 0.")
        .required()
        .example("\"7000 km\"")
        .positive(),
    polhode::io::quantity_key<&SpiralArguments::descent>("descent", polhode::io::Dimension::speed,
                                                         "By how much the radius shrinks.")
        .required()
        .example("{ value = 0.1, unit = \"km/d\" }")
        .positive(),
};

// Where it is at t; the angle is the integral of sqrt(gm / r^3) over a radius r = start - descent
// t.
inline polhode::Vec3 position(const SpiralArguments& a, double t) {
  const double r = a.start - a.descent * t;
  const double angle =
      2.0 * std::sqrt(a.gm) * t / (std::sqrt(r * a.start) * (std::sqrt(r) + std::sqrt(a.start)));
  return {r * std::cos(angle), r * std::sin(angle), 0.0};
}

inline polhode::io::ScenarioOrbit made_spiral(const SpiralArguments& a,
                                              const polhode::io::OrbitContext& at) {
  const std::optional<polhode::io::TimeSpan> span = at.run_span();
  if (!span) at.refuse("start", "expected a table [time], whose rows the positions are to cover");
  const double lowest = a.start - a.descent * span->last;
  if (!(lowest > 0.0)) at.refuse("descent", "expected less: a radius above 0 to the last row");
  // forty rows a turn, and one beyond the run at either end
  const double step = 2.0 * std::numbers::pi / 40.0 * std::sqrt(lowest * lowest * lowest / a.gm);
  polhode::PositionTable table;
  for (double t = span->first - step; t < span->last + 2.0 * step; t += step) {
    table.times.push_back(t);
    table.positions.push_back(position(a, t));
  }
  return {.motion = polhode::TableOrbit(std::move(table)), .gm = a.gm, .text = "a spiral"};
}

inline polhode::io::OrbitKind spiral() {
  return polhode::io::orbit_kind<SpiralArguments>(
      "spiral", "A circle that shrinks at a constant rate.", spiral_keys, made_spiral);
}
