// SPDX-License-Identifier: MIT
// What the torques in a magnetic field share: the dipole of what the body goes round.
#pragma once

#include <array>
#include <string>

#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct DipoleArguments {
  std::string orbit;
  Vec3 gauss;
  double reference_radius;
  Vec3 pole;
  double rotation_rate;
  double meridian;
  double meridian_epoch;
};

// Of arguments A that derive from these.
template <class A>
inline constexpr std::array<KindKey<A>, 7> dipole_keys = {
    orbit_key<&DipoleArguments::orbit, A>(),
    quantity_key<&DipoleArguments::gauss, A>(
        "gauss", Dimension::magnetic_field,
        "Gauss coefficients g10, g11, h11 of the dipole field, as the IGRF lists them.")
        .required()
        .example("{ value = [-29442.0, -1501.0, 4797.1], unit = \"nT\" }"),
    quantity_key<&DipoleArguments::reference_radius, A>("reference_radius", Dimension::length,
                                                        "The radius that belongs to them.")
        .required()
        .example("\"6371.2 km\"")
        .positive(),
    pole_key<&DipoleArguments::pole, A>(),
    quantity_key<&DipoleArguments::rotation_rate, A>("rotation_rate", Dimension::rate,
                                                     "How fast it turns.")
        .otherwise("0")
        .example("\"360.98564736629 deg/d\""),
    quantity_key<&DipoleArguments::meridian, A>(
        "meridian", Dimension::angle,
        "Where the meridian of longitude 0 is at the time `meridian_epoch`: from inertial axis 1, "
        "or, where the pole is not axis 3, from the ascending node of its equator.")
        .otherwise("0"),
    quantity_key<&DipoleArguments::meridian_epoch, A>("meridian_epoch", Dimension::time,
                                                      "The time t that the meridian belongs to.")
        .otherwise("0"),
};

inline DipoleField dipole_of(const DipoleArguments& a, const TermContext& at) {
  const PrimaryRotation primary{
      .pole = a.pole, .rate = a.rotation_rate, .meridian = a.meridian, .epoch = a.meridian_epoch};
  if (primary.pole == Vec3{}) at.refuse("pole", "expected a vector that is not zero");
  return at.built("gauss", [&] {
    return DipoleField::from_gauss({a.gauss.x, a.gauss.y, a.gauss.z}, a.reference_radius, primary);
  });
}

inline Citation dipole_citation() {
  return {"thebault2015",
          "Thebault, E., et al. (2015). International Geomagnetic Reference Field: the 12th "
          "generation. Earth, Planets and Space 67, 79.",
          "the dipole field and its Gauss coefficients"};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
