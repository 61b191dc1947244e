// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "tide".
#include <optional>
#include <string>
#include <variant>

#include "polhode/perturb/tidal_torque.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct Arguments {
  std::string orbit;
  std::optional<double> gm;
  double mass;
  double k2;
  double time_lag;
  double radius;
};

constexpr KindKey<Arguments> keys[] = {
    orbit_key<&Arguments::orbit>(),
    gm_key<&Arguments::gm>(),
    quantity_key<&Arguments::mass>(
        "mass", Dimension::mass,
        "Of the perturber, as gm is: their product is G times the square of the mass.")
        .required()
        .example("0.02")
        .positive(),
    quantity_key<&Arguments::k2>("k2", Dimension::number,
                                 "Love number of degree 2 of the rotating body.")
        .required()
        .example("0.024")
        .not_negative(),
    quantity_key<&Arguments::time_lag>("time_lag", Dimension::time, "Time by which its bulge lags.")
        .required()
        .example("\"600 s\"")
        .not_negative(),
    body_radius_key<&Arguments::radius>(),
};

Arguments principal(Arguments a, const TermContext& at) {
  at.orbit("orbit");  // named first if both are wrong
  a.gm = at.gm("gm", "orbit");
  return a;
}

MadeTerms made(const Arguments& a, const TermContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  const TidalBody of{a.k2, a.time_lag, a.radius};
  return at.built("kind", [&] {
    return std::visit(
        [&](const auto& motion) -> AnyPerturbation {
          return {at.name("tide, orbit " + orbit.name), TidalTorque(*a.gm, a.mass, motion, of)};
        },
        orbit.motion);
  });
}

}  // namespace

PerturbationKind tide_kind() {
  PerturbationKind kind = perturbation_kind<Arguments>(
      "tide", "The tide that a point mass raises on the body, with a constant time lag.", keys,
      made,
      {{"mignard1979",
        "Mignard, F. (1979). The evolution of the lunar orbit revisited. I. The Moon and the "
        "Planets 20, 301-315.",
        "tides with a constant time lag"},
       {"hut1981",
        "Hut, P. (1981). Tidal evolution in close binary systems. Astronomy and Astrophysics 99, "
        "126-140.",
        "tides with a constant time lag"}},
      principal);
  kind.needs_velocity = true;
  kind.class_name = "TidalTorque";
  kind.equations = "u = 3 k2 gm M R^5 lag / r^8 ((r.w) r - r^2 w + r x dr/dt), w = I^-1 g.";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
