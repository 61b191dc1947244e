// SPDX-License-Identifier: MIT
// What the torques in a magnetic field share: the dipole of what the body goes round.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

enum class FieldSource { coefficients, earth };

struct DipoleArguments {
  std::string orbit;
  FieldSource field;
  std::optional<Vec3> gauss;
  std::optional<double> reference_radius;
  Vec3 pole;
  std::optional<double> rotation_rate;
  std::optional<double> meridian;
  double meridian_epoch;
};

inline constexpr std::string_view earth = "field = \"earth\"";

// Of arguments A that derive from these.
template <class A>
inline constexpr std::array<KindKey<A>, 8> dipole_keys = {
    orbit_key<&DipoleArguments::orbit, A>(),
    choice_key<&DipoleArguments::field, A, FieldSource::coefficients, FieldSource::earth>(
        "field", "coefficients|earth",
        "earth: the dipole of the IGRF and the orientation of the Earth at state.epoch, in place "
        "of the keys gauss to meridian_epoch.")
        .otherwise("\"coefficients\""),
    quantity_key<&DipoleArguments::gauss, A>(
        "gauss", Dimension::magnetic_field,
        "Gauss coefficients g10, g11, h11 of the dipole field, as the IGRF lists them.")
        .example("{ value = [-29442.0, -1501.0, 4797.1], unit = \"nT\" }")
        .shown()
        .unused_with(earth),
    quantity_key<&DipoleArguments::reference_radius, A>("reference_radius", Dimension::length,
                                                        "The radius that belongs to them.")
        .example("\"6371.2 km\"")
        .positive()
        .shown()
        .unused_with(earth),
    pole_key<&DipoleArguments::pole, A>().unused_with(earth),
    quantity_key<&DipoleArguments::rotation_rate, A>(
        "rotation_rate", Dimension::rate,
        "How fast it turns; may be left out if g11 and h11 are 0.")
        .example("\"360.98564736629 deg/d\"")
        .shown()
        .unused_with(earth),
    quantity_key<&DipoleArguments::meridian, A>(
        "meridian", Dimension::angle,
        "Where the meridian of longitude 0 is at the time `meridian_epoch`: from inertial axis 1, "
        "or, where the pole is not axis 3, from the ascending node of its equator. May be left out "
        "if g11 and h11 are 0.")
        .example("\"0 deg\"")
        .shown()
        .unused_with(earth),
    quantity_key<&DipoleArguments::meridian_epoch, A>("meridian_epoch", Dimension::time,
                                                      "The time t that the meridian belongs to.")
        .otherwise("0")
        .unused_with(earth),
};

// The dipole, and what a summary says of it.
struct NamedDipole {
  DipoleField field;
  std::string text;  // empty, or ", ..."
};
NamedDipole dipole_of(const DipoleArguments& a, const TermContext& at);

inline Citation dipole_citation() {
  return {"thebault2015",
          "Thebault, E., et al. (2015). International Geomagnetic Reference Field: the 12th "
          "generation. Earth, Planets and Space 67, 79.",
          "the dipole field and its Gauss coefficients"};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
