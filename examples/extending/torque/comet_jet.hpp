// SPDX-License-Identifier: MIT
// A torque of your own that follows an orbit: the jet of a comet. Gas from one place of the surface
// pushes, most where the Sun stands above it, and less the further away the Sun is.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "polhode/perturb/directed_path.hpp"
#include "polhode/scenario/perturbation_kind.hpp"

class CometJet {
 public:
  // The torque is that with the Sun above the place, at the distance.
  CometJet(polhode::DirectedPath sun, const polhode::Vec3& normal, const polhode::Vec3& torque,
           double distance)
      : sun_(std::move(sun)),
        normal_((1.0 / norm(normal)) * normal),
        torque_((distance * distance) * torque) {}

  // A quarter of a turn where the orbit is fastest: no step of Adaptive passes over a pericentre.
  double time_scale() const { return sun_.time_scale(); }

  template <polhode::Real T>
  polhode::BasicEffect<T> effect(const polhode::BasicSetting<T>& at) const {
    using std::sqrt;
    const polhode::BasicVec3<T> x = body_from_inertial(at, sun_.position(at));
    const T r2 = dot(x, x);
    const T along = T(normal_.x) * x.x + T(normal_.y) * x.y + T(normal_.z) * x.z;
    const T light = T(0.5) * (T(1.0) + along / sqrt(r2));  // 1 at noon, 0 at midnight
    const T strength = light * light / r2;
    return {{}, {strength * T(torque_.x), strength * T(torque_.y), strength * T(torque_.z)}};
  }

 private:
  polhode::DirectedPath sun_;  // as seen from the comet
  polhode::Vec3 normal_;
  polhode::Vec3 torque_;
};

struct JetArguments {
  std::string orbit;
  polhode::Vec3 normal;
  polhode::Vec3 torque;
};

inline constexpr polhode::io::KindKey<JetArguments> jet_keys[] = {
    polhode::io::name_key<&JetArguments::orbit>("orbit",
                                                "The name of a table [orbit.NAME]: the path "
                                                "of the body round the Sun.")
        .required()
        .example("\"comet\""),
    polhode::io::quantity_key<&JetArguments::normal>(
        "normal", polhode::io::Dimension::number, "Of the surface, outwards, along the body axes.")
        .required()
        .example("[1.0, 0.0, 0.0]"),
    polhode::io::quantity_key<&JetArguments::torque>(
        "torque", polhode::io::Dimension::torque, "At the pericentre at noon, along the body axes.")
        .required()
        .example("[0.0, 0.0, 0.01]"),
};

inline polhode::io::MadeTerms made_jet(const JetArguments& a, const polhode::io::TermContext& at) {
  const polhode::io::ScenarioOrbit& orbit = at.orbit("orbit");
  const polhode::KeplerElements* elements = kepler_elements(orbit);
  if (elements == nullptr) at.refuse("orbit", "expected an orbit with elements");
  if (a.normal == polhode::Vec3{}) at.refuse("normal", "expected a vector that has a direction");
  const polhode::DirectedPath sun{any_orbit(orbit), true};  // from the comet, not from the Sun
  return polhode::AnyPerturbation(
      "jet, orbit " + orbit.name,
      CometJet(sun, at.principal(a.normal), at.principal(a.torque), elements->pericentre));
}

inline polhode::io::PerturbationKind comet_jet() {
  return polhode::io::perturbation_kind<JetArguments>(
      "comet-jet", "The jet of one place of a comet, which the Sun drives.", jet_keys, made_jet);
}
