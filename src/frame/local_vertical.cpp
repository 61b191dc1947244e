// SPDX-License-Identifier: MIT
#include "polhode/frame/local_vertical.hpp"

#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>

#include "frame/detail/orbit_normal.hpp"
#include "frame/detail/whole_turns.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

// The attitude as a function of time. The argument of latitude comes from the position, its whole
// turns from the mean motion, so that the quaternion does not change its sign.
template <class O>
class LocalVertical {
 public:
  LocalVertical(const O& orbit, const KeplerElements& elements, const SecularRates& rates)
      : orbit_(orbit),
        elements_(elements),
        rates_(rates),
        mean_rate_(elements.eccentricity < 1.0 ? mean_motion(elements) + rates.mean_anomaly : 0.0),
        mean_start_(elements.eccentricity < 1.0 ? elements.mean_anomaly : 0.0) {}

  template <class T>
  BasicQuaternion<T> operator()(const T& t) const {
    using std::atan2;
    const T elapsed = t - T(elements_.epoch);
    const T node = T(elements_.node) + T(rates_.node) * elapsed;
    const T i = T(elements_.inclination) + T(rates_.inclination) * elapsed;
    const auto [sin_node, cos_node] = sincos(node);
    const auto [sin_i, cos_i] = sincos(i);
    const BasicVec3<T> x = orbit_.position(t);
    const T along = x.x * cos_node + x.y * sin_node;
    const T across = (x.y * cos_node - x.x * sin_node) * cos_i + x.z * sin_i;
    const T u = atan2(across, along);
    const T half(has_odd_turns(to_double(elapsed.value), to_double(u.value)) ? -0.5 : 0.5);
    const BasicQuaternion<T> axes{half, -half, -half, half};
    return rotation_z(node) * rotation_x(i) * rotation_z(u) * axes;
  }

 private:
  // True anomaly and mean anomaly are less than half a turn apart.
  bool has_odd_turns(double elapsed, double u) const {
    const double mean =
        mean_start_ + mean_rate_ * elapsed + elements_.argument + rates_.argument * elapsed;
    return std::fmod(std::rint((mean - u) / turn), 2.0) != 0.0;
  }

  O orbit_;
  KeplerElements elements_;
  SecularRates rates_;
  double mean_rate_, mean_start_;
};

// Of a table. From axes of a plane, which the shortest turn from axis 3 gives, or from -axis 3
// where the orbit is retrograde, so that it stays far from half a turn.
class VerticalOfTable {
 public:
  explicit VerticalOfTable(const TableOrbit& orbit) : orbit_(orbit) {
    const std::vector<double>& times = orbit.table().times;
    Vec3 sum{};
    for (const double t : times) {
      const Vec3 n = detail::normal_of(orbit.position(t), orbit.velocity(t));
      if (std::isfinite(n.z)) sum = sum + n;
    }
    retrograde_ = sum.z < 0.0;
    turns_ = detail::WholeTurns::along(times, [this](double t) { return in_plane(t).angle; });
  }

  template <class T>
  BasicQuaternion<T> operator()(const T& t) const {
    const InPlane<T> at = in_plane(t);
    const T half(turns_.odd(to_double(t), to_double(at.angle)) ? -0.5 : 0.5);
    const BasicQuaternion<T> axes{half, -half, -half, half};
    return at.plane * rotation_z(at.angle) * axes;
  }

 private:
  template <class T>
  struct InPlane {
    BasicQuaternion<T> plane;
    T angle;  // of the position, from axis 1 of the plane
  };
  template <class T>
  InPlane<T> in_plane(const T& t) const {
    using std::atan2;
    const BasicVec3<T> x = orbit_.position(t);
    BasicVec3<T> n = detail::normal_of(x, orbit_.velocity(t));
    // half a turn about axis 1 first: (x, y, z) to (x, -y, -z)
    if (retrograde_) n = {n.x, -n.y, -n.z};
    BasicQuaternion<T> plane = detail::shortest_turn_to(n);
    if (retrograde_) plane = BasicQuaternion<T>{T(0.0), T(1.0), T(0.0), T(0.0)} * plane;
    const BasicVec3<T> own = rotate(conj(plane), x);
    return {plane, atan2(own.y, own.x)};
  }

  TableOrbit orbit_;
  bool retrograde_ = false;
  detail::WholeTurns turns_;
};

}  // namespace

Frame local_vertical_frame(const TableOrbit& orbit) {
  detail::require_curved(orbit);
  return Frame::from_attitude(VerticalOfTable(orbit));
}

Frame local_vertical_frame(const KeplerOrbit& orbit) {
  return Frame::from_attitude(LocalVertical<KeplerOrbit>(orbit, orbit.elements(), {}));
}

Frame local_vertical_frame(const PrecessingKeplerOrbit& orbit) {
  return Frame::from_attitude(
      LocalVertical<PrecessingKeplerOrbit>(orbit, orbit.elements(), orbit.rates()));
}

Frame local_vertical_frame(const TurnedKeplerOrbit& orbit) {
  const LocalVertical<PrecessingKeplerOrbit> own(orbit.orbit(), orbit.orbit().elements(),
                                                 orbit.orbit().rates());
  return Frame::from_attitude([own, angle = orbit.angle()](const auto& t) {
    using T = std::remove_cvref_t<decltype(t)>;
    return rotation_x(T(-angle)) * own(t);
  });
}

}  // namespace v0
}  // namespace polhode
