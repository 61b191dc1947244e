// SPDX-License-Identifier: MIT
// What a kind of torque asks of the parts of the rotation that stand before it.
#include <string>

#include "polhode/scenario/perturbation_kind.hpp"
#include "scenario/scenario_parts.hpp"

namespace polhode {
inline namespace v0 {

const Body& TermContext::body() const {
  uses_.body = true;
  return rotation_.body;
}

const Quaternion& TermContext::q_FB() const {
  uses_.file_axes = true;
  return rotation_.q_file;
}

bool TermContext::has_principal_axes() const { return q_FB() == Quaternion{}; }

Vec3 TermContext::principal(const Vec3& x_F) const { return rotate(conj(q_FB()), x_F); }

Mat3 TermContext::principal(const Mat3& m_F) const {
  const Mat3 R = rotation_matrix(q_FB());  // v_F = R v_B
  const Mat3 m = has_principal_axes() ? m_F : transpose(R) * m_F * R;
  Mat3 even = m;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) even(i, k) = 0.5 * (m(i, k) + m(k, i));
  return even;
}

const Surface& TermContext::surface() const {
  uses_.surface = true;
  if (rotation_.surface == nullptr)
    refuse("kind", "expected a table [[surface]], since it acts on facets");
  return *rotation_.surface;
}

const ScenarioOrbit& TermContext::orbit(std::string_view key) const {
  if (!has(key)) refuse(key, "expected the name of a table [orbit.NAME]");
  const ScenarioOrbit& found =
      detail::orbit_named(rotation_.orbits, values(), key_path(key), file());
  uses_.orbits.push_back(static_cast<std::size_t>(&found - rotation_.orbits.data()));
  return found;
}

double TermContext::gm(std::string_view key, std::string_view orbit_key) const {
  if (has(key)) {
    if (!(number(key) > 0.0)) refuse(key, "expected a positive gravitational parameter");
    return number(key);
  }
  const std::optional<double> of_orbit = orbit(orbit_key).gm;
  if (!of_orbit)
    refuse(orbit_key, "expected a key " + std::string(key) + " as well, since this orbit has none");
  if (!(*of_orbit > 0.0))
    refuse(orbit_key, "expected an orbit of a positive gravitational parameter");
  return *of_orbit;
}

}  // namespace v0
}  // namespace polhode
