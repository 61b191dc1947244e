// SPDX-License-Identifier: MIT
// From the values of a file to gravity of every degree, tides and friction inside the body.
#include <algorithm>
#include <array>
#include <optional>

#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/higher_gravity.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/oblate_gravity.hpp"
#include "polhode/perturb/tidal_torque.hpp"
#include "scenario/detail/perturbation_kinds.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

template <std::size_t count>
std::array<double, count> array_at(const TermContext& at, const char* own) {
  std::array<double, count> out{};
  if (!has(at.values, at.key(own))) return out;
  const std::vector<double>& numbers = value_at(at.values, at.key(own)).numbers;
  for (std::size_t i = 0; i < count; ++i) out[i] = numbers.at(i);
  return out;
}

// None where the table has no moments; along principal axes.
std::optional<MassMoments> moments_at(const TermContext& at) {
  if (!has(at.values, at.key("third_moments")) && !has(at.values, at.key("fourth_moments")))
    return std::nullopt;
  const MassMoments in_file_axes{array_at<10>(at, "third_moments"),
                                 array_at<15>(at, "fourth_moments")};
  const Quaternion& q_FB = at.q_FB();
  if (q_FB == Quaternion{}) return in_file_axes;
  return rotated(in_file_axes, rotation_matrix(conj(q_FB)));
}

OrbitOf orbit_of_at(const TermContext& at) {
  const std::string key = at.key("orbit_of");
  if (has(at.values, at.key("third_moments")) && !is_explicit(at.values, key))
    refuse(at.values, at.key("third_moments"), at.name,
           "expected a key orbit_of as well, \"body\" or \"attractor\": whose path the orbit is as "
           "seen from the other, since gravity of degree 3 changes sign with it");
  return word(at.values, key) == "body" ? OrbitOf::body : OrbitOf::attractor;
}

std::optional<Oblateness> oblateness_at(const TermContext& at) {
  const bool any = has(at.values, at.key("J2"));
  for (const char* own : {"primary_radius", "pole"})
    if (!any && is_explicit(at.values, at.key(own)))
      refuse(at.values, at.key(own), at.name, "expected a key J2 as well");
  if (!any) return std::nullopt;
  if (!has(at.values, at.key("primary_radius")))
    refuse(at.values, at.key("J2"), at.name,
           "expected a key primary_radius as well, the equatorial radius that J2 belongs to");
  Oblateness of{number(at.values, at.key("J2")), number(at.values, at.key("primary_radius"))};
  if (has(at.values, at.key("pole"))) of.pole = vector(at.values, at.key("pole"));
  return of;
}

}  // namespace

// Degree 2 once, and what else the table has.
std::vector<AnyPerturbation> gravity_terms(const TermContext& at) {
  const ScenarioOrbit& orbit = orbit_at(at);
  const double gm = gm_at(at);
  const std::optional<MassMoments> moments = moments_at(at);
  const OrbitOf of = orbit_of_at(at);
  const std::optional<Oblateness> oblate = oblateness_at(at);
  const std::string of_orbit = ", orbit " + orbit.name;
  // of the orbit's own type: nothing is called through a pointer in the inner loop
  return std::visit(
      [&](const auto& motion) {
        std::vector<AnyPerturbation> terms;
        terms.emplace_back("gravity gradient" + of_orbit, GravityGradient(gm, motion));
        if (moments)
          terms.emplace_back("gravity of degrees 3 and 4" + of_orbit,
                             HigherGravity(gm, motion, *moments, of));
        if (oblate)
          terms.push_back(built(at.values, at.key("J2"), at.name, [&]() -> AnyPerturbation {
            return {"gravity of J2" + of_orbit, OblateGravity(gm, motion, *oblate)};
          }));
        return terms;
      },
      orbit.motion);
}

AnyPerturbation tide_term(const TermContext& at) {
  const ScenarioOrbit& orbit = orbit_at(at);
  const double gm = gm_at(at), mass = number(at.values, at.key("mass"));
  const TidalBody of{number(at.values, at.key("k2")), number(at.values, at.key("time_lag")),
                     number(at.values, at.key("radius"))};
  return built(at.values, at.key("kind"), at.name, [&] {
    return std::visit(
        [&](const auto& motion) -> AnyPerturbation {
          return {"tide, orbit " + orbit.name, TidalTorque(gm, mass, motion, of)};
        },
        orbit.motion);
  });
}

AnyPerturbation internal_damping_term(const TermContext& at) {
  const bool grows = value_at(at.values, at.key("grows")).whole == 1;
  if (has(at.values, at.key("k")))
    return built(at.values, at.key("k"), at.name, [&]() -> AnyPerturbation {
      return {"internal damping", InternalDamping(vector(at.values, at.key("k")), grows)};
    });
  if (grows) refuse(at.values, at.key("grows"), at.name, "expected a key k as well");
  const Vec3& I = at.body().moments();
  const double rate = positive_at(at, "rate"), time = positive_at(at, "wobble_time");
  return built(at.values, at.key("kind"), at.name, [&]() -> AnyPerturbation {
    return {"internal damping",
            InternalDamping::of_wobble(at.body(), time, rate * std::max({I.x, I.y, I.z}))};
  });
}

AnyPerturbation anelastic_damping_term(const TermContext& at) {
  const auto value = [&](const char* own) { return positive_at(at, own); };
  return built(at.values, at.key("kind"), at.name, [&]() -> AnyPerturbation {
    return {"internal damping",
            InternalDamping::of_material(
                at.body(), {value("rigidity"), value("quality_factor"), value("body_density"),
                            value("radius"), value("shape_factor")})};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
