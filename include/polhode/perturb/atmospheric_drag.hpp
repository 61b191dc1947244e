// SPDX-License-Identifier: MIT
// AtmosphericDrag: the torque of a thin atmosphere on the facets of a body in orbit.
//
// Equations   rho v^2 times the law of molecules of FacetStream, v = dx/dt - rotation x x the
//             velocity against the air (Schaaf & Chambre 1961 in the limit of molecules that are
//             slow against the body; Hughes 1986, chapter 8). rho = rho_0 exp(-(|x| - r_0) / H).
//             Both accommodations 1 and no exit speed: F = -rho v^2 A c e, a drag coefficient of 2.
// Units       rho in moment per length^5, lengths, speeds and rates in those of the orbit.
// Domain      free-molecular flow: mean free path long against the body. Molecules that are slow
//             against it: facets within some 1/S of edge-on, S the ratio of the speeds, get less
//             than in truth (docs/guide/torques/sunlight-and-air.md). Facets do not shade each
//             other. The exit speed of molecules from a wall of temperature T is sqrt(pi R T / 2),
//             R the gas constant over the molar mass. The surface is along the principal axes; the
//             orbit is in inertial axes, so that its velocity is the body's. An orbit that gives
//             NaN makes the torque NaN.
// Accuracy    a few roundings of the sum of the moduli. Position and velocity are those of double
//             for every number type.
// Errors      DomainError for a density that is negative, a radius or scale height that is not
//             positive, an exit speed below 0, an orbit that has no velocity.
// Cost        one position, one velocity and some 3 ns per facet.
#pragma once

#include <limits>

#include "polhode/detail/perturb/facet_stream.hpp"
#include "polhode/perturb/directed_path.hpp"

namespace polhode {
inline namespace v0 {

struct Atmosphere {
  double density;                                                 // at `radius` from the centre
  double radius = 1.0;                                            // r_0
  double scale_height = std::numeric_limits<double>::infinity();  // infinite: the same everywhere
  Vec3 rotation = {};  // angular velocity of the air, in the axes of the orbit

  constexpr bool operator==(const Atmosphere&) const = default;
};

class AtmosphericDrag {
 public:
  static constexpr bool kick = true;
  using Law = FacetStream::Law;

  // `path` is the body as seen from the centre of the atmosphere.
  AtmosphericDrag(const Surface& surface_B, const Atmosphere& air, DirectedPath path,
                  double exit_speed = 0.0);

  const Surface& surface() const { return stream_.surface(); }
  const Atmosphere& air() const { return air_; }
  const DirectedPath& path() const { return path_; }
  double time_scale() const { return path_.time_scale(); }
  double exit_speed() const { return exit_speed_; }

  Law law() const { return {&stream_}; }
  template <Real T>
  Law::OfTime<T> of_time(const BasicSetting<T>& at) const {
    return of_flow(at, flow_at(to_double(at.t), to_double(at.t_rest)));
  }
  // Position and velocity.
  static constexpr std::size_t vectors_of_time = 2;
  void vectors_at(const TimeRows& times, const std::array<VectorRows, 2>& to,
                  InstructionSet set) const {
    path_.motions(times, to[0], to[1], set);
  }
  Law::OfTime<double> of_vectors(const Setting& at, const std::array<Vec3, 2>& motion) const {
    return of_flow(at, flow_of(motion[0], motion[1]));
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const Law::OfTime<T> flow = of_time(at);
    if (flow.pressure == T(0.0)) return {};
    return law().effect(flow, pose_of(at));
  }
  // The facets that turn edge-on.
  std::vector<double> switches(const Setting& at) const;
  // Of a surface of many facets.
  bool has_unnamed_kinks() const { return stream_.has_unnamed_kinks(); }

 private:
  struct Flow {
    Vec3 from;  // unit vector that the air comes from
    double speed;
    double pressure;  // rho v^2
  };
  Flow flow_at(double t, double rest) const;
  Flow flow_of(const Vec3& position, const Vec3& velocity) const;
  template <Real T>
  Law::OfTime<T> of_flow(const BasicSetting<T>& at, const Flow& flow) const {
    if (flow.speed == 0.0) return {{}, T(1.0), T(0.0)};  // NaN goes on
    const BasicVec3<T> from{T(flow.from.x), T(flow.from.y), T(flow.from.z)};
    return {reference_from_space(at, SpaceAxes::inertial, from), T(exit_speed_ / flow.speed),
            T(flow.pressure)};
  }

  FacetStream stream_;
  Atmosphere air_;
  DirectedPath path_;
  double exit_speed_;
};

}  // namespace v0
}  // namespace polhode
