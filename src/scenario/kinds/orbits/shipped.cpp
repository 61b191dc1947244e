// SPDX-License-Identifier: MIT
// [orbit.NAME] that the library brings along.
#include <string>

#include "polhode/secular/orbit_history.hpp"
#include "scenario/detail/history_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct Arguments {
  std::string name;
};

constexpr KindKey<Arguments> keys[] = {
    word_key<&Arguments::name>(
        "name", "earth|mars",
        "Whose orbit, ecliptic-J2000, t = 0 at J2000, over 20 million years on either side; of the "
        "Earth, that of its barycentre with the Moon (docs/guide/obliquity.md).")
        .required()
        .example("\"mars\""),
};

ScenarioHistory history(const Arguments& a, const OrbitContext& at) {
  const double year = at.units().to_core(1.0, "yr", Dimension::time);
  return {secular::OrbitHistory(secular::shipped_orbit(a.name, year)), "shipped, " + a.name};
}

}  // namespace

OrbitKind shipped_kind() {
  return history_kind<Arguments>(
      "shipped",
      "The orbit of the Earth or Mars over ages that polhode brings along: for kind obliquity.",
      keys, history, nullptr,
      {{"rein2015",
        "Rein, H., Tamayo, D. (2015). WHFast: a fast and unbiased implementation "
        "of a symplectic Wisdom-Holman integrator for long-term gravitational "
        "simulations. Monthly Notices of the Royal Astronomical Society 452, "
        "376-388.",
        "the orbits of the planets over ages"},
       {"park2021",
        "Park, R. S., Folkner, W. M., Williams, J. G., Boggs, D. H. (2021). The "
        "JPL planetary and lunar ephemerides DE440 and DE441. The Astronomical "
        "Journal 161, 105.",
        "where the planets are at J2000"}});
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
