// SPDX-License-Identifier: MIT
// SolarPressure: the torque of sunlight on the facets of a body, with the shadow of what it orbits.
//
// Equations   p = P (d / r)^2, P the pressure at the distance d, r that to the Sun, times what
//             Shadow leaves of the light; on each facet the law of light of FacetStream (Wertz
//             1978, section 17.2; Montenbruck & Gill 2000, section 3.4).
// Units       P in torque per length^3, d and orbits in length; the surface in the same.
// Domain      `path` is the body as seen from what it orbits; without `sun` that is the Sun itself,
//             and nothing throws a shadow. Otherwise `sun` is the Sun as seen from what the body
//             orbits. Both in inertial or in reference-frame axes. The surface is along the
//             principal axes. Facets do not shade each other. No energy: light is no potential. An
//             orbit that gives NaN makes the torque NaN.
// Accuracy    a few roundings of the sum of the moduli over the facets.
// Errors      DomainError for a pressure or a distance that is not positive; a shadow without a
//             sun.
// Cost        two positions and some 3 ns per facet. For Tangent the orbits are evaluated in
//             double.
#pragma once

#include <optional>

#include "polhode/detail/perturb/facet_stream.hpp"
#include "polhode/perturb/directed_path.hpp"
#include "polhode/perturb/shadow.hpp"

namespace polhode {
inline namespace v0 {

// Sunlight: its pressure on what absorbs it, at one distance from the Sun.
struct Sunlight {
  double pressure;
  double distance;

  constexpr bool operator==(const Sunlight&) const = default;
};

class SolarPressure {
 public:
  static constexpr bool kick = true;
  using Law = FacetStream::Law;

  // The body orbits the Sun.
  SolarPressure(const Surface& surface_B, const Sunlight& light, DirectedPath path,
                SpaceAxes axes = SpaceAxes::inertial);
  SolarPressure(const Surface& surface_B, const Sunlight& light, DirectedPath path,
                DirectedPath sun, std::optional<Shadow> shadow = std::nullopt,
                SpaceAxes axes = SpaceAxes::inertial);

  const Surface& surface() const { return stream_.surface(); }
  const Sunlight& light() const { return light_; }
  const DirectedPath& path() const { return path_; }
  double time_scale() const { return path_.time_scale(); }
  const std::optional<DirectedPath>& sun() const { return sun_; }
  const std::optional<Shadow>& shadow() const { return shadow_; }
  SpaceAxes axes() const { return axes_; }

  Law law() const { return {&stream_, borders()}; }
  template <Real T>
  Law::OfTime<T> of_time(const BasicSetting<T>& at) const {
    if (!sun_) return of_vectors<T>(at, {path_.position(at), {}});
    return of_vectors<T>(at, {path_.position(at), sun_->position(at)});
  }
  // The body and the Sun as seen from the centre.
  static constexpr std::size_t vectors_of_time = 2;
  void vectors_at(const TimeRows& times, const std::array<VectorRows, 2>& to,
                  InstructionSet set) const {
    path_.positions(times, to[0], set);
    if (sun_) return sun_->positions(times, to[1], set);
    for (std::size_t i = 0; i < times.count; ++i) to[1].set(i, {});
  }
  template <Real T>
  Law::OfTime<T> of_vectors(const BasicSetting<T>& at,
                            const std::array<BasicVec3<T>, 2>& places) const {
    const BasicVec3<T>& from_centre = places[0];
    BasicVec3<T> to_sun = -from_centre;
    T visible(1.0);
    if (sun_) {
      to_sun = places[1] - from_centre;
      if (shadow_) visible = shadow_->visible(to_sun, -from_centre, at.sides);
    }
    if (visible == T(0.0)) return {{}, T(1.0), T(0.0)};  // NaN goes on
    const T r = norm(to_sun), ratio = T(light_.distance) / r;
    return {reference_from_space(at, axes_, (T(1.0) / r) * to_sun), T(1.0),
            visible * (T(light_.pressure) * (ratio * ratio))};
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const Law::OfTime<T> light = of_time(at);
    if (light.pressure == T(0.0)) return {};
    return law().effect(light, pose_of(at));
  }
  // The borders of the shadow, then the facets that turn edge-on.
  std::vector<double> switches(const Setting& at) const;
  // Of a surface of many facets.
  bool has_unnamed_kinks() const { return stream_.has_unnamed_kinks(); }
  // In a penumbra.
  bool fades_at_switches() const { return shadow_ && shadow_->shape() == ShadowShape::cone; }

 private:
  std::size_t borders() const {
    if (!shadow_) return 0;
    return shadow_->shape() == ShadowShape::cylinder ? 1 : 2;
  }

  FacetStream stream_;
  Sunlight light_;
  DirectedPath path_;
  std::optional<DirectedPath> sun_;
  std::optional<Shadow> shadow_;
  SpaceAxes axes_;
};

}  // namespace v0
}  // namespace polhode
