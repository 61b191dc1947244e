// SPDX-License-Identifier: MIT
// The program `polhode` with two kinds of [orbit.NAME] of its own, "sun-synchronous" and "spiral".
#include <cmath>
#include <numbers>
#include <span>

#include "polhode/cli/command_line.hpp"
#include "spiral.hpp"

namespace {

using polhode::io::Dimension;
using polhode::io::KindKey;

struct Arguments {
  double gm;
  double radius;
  double J2;
  double altitude;
  double year;
  double node = 0.0;
};

constexpr KindKey<Arguments> keys[] = {
    polhode::io::quantity_key<&Arguments::gm>("gm", Dimension::gm, "Of the planet.")
        .required()
        .example("\"398600.4418 km3/s2\"")
        .positive(),
    polhode::io::quantity_key<&Arguments::radius>("radius", Dimension::length, "Of its equator.")
        .required()
        .example("\"6378.137 km\"")
        .positive(),
    polhode::io::quantity_key<&Arguments::J2>("J2", Dimension::number, "Its oblateness.")
        .required()
        .example("1.0826e-3")
        .positive(),
    polhode::io::quantity_key<&Arguments::altitude>("altitude", Dimension::length,
                                                    "Of the circle above the equator.")
        .required()
        .example("\"700 km\"")
        .positive(),
    polhode::io::quantity_key<&Arguments::year>("year", Dimension::time,
                                                "In which the node turns once.")
        .otherwise("\"365.2422 d\"")
        .positive(),
    polhode::io::quantity_key<&Arguments::node>("node", Dimension::angle, "At t = 0.")
        .otherwise("0"),
};

// The inclination at which J2 turns the node as the Sun moves: -3/2 n J2 (R/a)^2 cos i.
polhode::io::ScenarioOrbit made(const Arguments& a, const polhode::io::OrbitContext& at) {
  const double axis = a.radius + a.altitude, n = std::sqrt(a.gm / (axis * axis * axis));
  const double ratio = a.radius / axis, wanted = 2.0 * std::numbers::pi / a.year;
  const double cosine = -wanted / (1.5 * n * a.J2 * ratio * ratio);
  if (cosine < -1.0) at.refuse("altitude", "expected a lower orbit, whose node turns fast enough");
  const polhode::KeplerElements circle{.gm = a.gm,
                                       .pericentre = axis,
                                       .eccentricity = 0.0,
                                       .inclination = std::acos(cosine),
                                       .node = a.node};
  return {.motion = polhode::PrecessingKeplerOrbit(circle, j2_rates(circle, a.J2, a.radius)),
          .gm = a.gm};
}

polhode::io::OrbitKind sun_synchronous() {
  return polhode::io::orbit_kind<Arguments>(
      "sun-synchronous", "A circle whose plane follows the Sun.", keys, made,
      {{"author2026", "A. Author (2026). On dawn and dusk. Journal of Examples 1, 5-6.",
        "the orbit that follows the Sun"}});
}

}  // namespace

int main(int argc, char** argv) {
  const polhode::io::Kinds kinds =
      polhode::io::default_kinds().with(sun_synchronous()).with(spiral());
  return polhode::command_line(argc, argv, kinds);
}
