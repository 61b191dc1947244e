// SPDX-License-Identifier: MIT
#include "polhode/frame/orbit_plane.hpp"

#include <cmath>
#include <type_traits>
#include <utility>

#include "frame/detail/orbit_normal.hpp"
#include "frame/detail/turned_node.hpp"
#include "frame/detail/whole_turns.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Node and inclination of elements that advance, before a turn about axis 1 by -angle.
class PlaneOfElements {
 public:
  PlaneOfElements(const KeplerElements& elements, const SecularRates& rates, double angle)
      : elements_(elements), rates_(rates), angle_(angle) {}

  template <class T>
  T node(const T& t) const {
    return T(elements_.node) + T(rates_.node) * (t - T(elements_.epoch));
  }
  template <class T>
  T inclination(const T& t) const {
    return T(elements_.inclination) + T(rates_.inclination) * (t - T(elements_.epoch));
  }
  template <class T>
  BasicVec3<T> normal(const T& t) const {
    const auto [sin_node, cos_node] = sincos(node(t));
    const auto [sin_i, cos_i] = sincos(inclination(t));
    const BasicVec3<T> n{sin_i * sin_node, -(sin_i * cos_node), cos_i};
    const auto [s, c] = sincos(T(angle_));
    return {n.x, c * n.y + s * n.z, c * n.z - s * n.y};
  }

 private:
  KeplerElements elements_;
  SecularRates rates_;
  double angle_;
};

class PlaneOfTable {
 public:
  explicit PlaneOfTable(TableOrbit orbit) : orbit_(std::move(orbit)) {}

  template <class T>
  BasicVec3<T> normal(const T& t) const {
    return detail::normal_of(orbit_.position(t), orbit_.velocity(t));
  }

 private:
  TableOrbit orbit_;
};

// The longitude of the node, from -pi to pi.
template <class T>
T node_of(const BasicVec3<T>& n) {
  using std::atan2;
  return atan2(n.x, -n.y);
}

// By the node of a normal: half its whole turns count, so that the quaternion keeps its sign.
template <class Plane, class Turns>
class ByNode {
 public:
  ByNode(Plane plane, Turns turns) : plane_(std::move(plane)), turns_(std::move(turns)) {}

  template <class T>
  BasicQuaternion<T> operator()(const T& t) const {
    using std::atan2;
    using std::sqrt;
    const BasicVec3<T> n = plane_.normal(t);
    const T node = node_of(n), i = atan2(sqrt(n.x * n.x + n.y * n.y), n.z);
    const BasicQuaternion<T> q = rotation_z(node) * rotation_x(i);
    if (!turns_.odd(to_double(t), to_double(node))) return q;
    return {-q.w, -q.x, -q.y, -q.z};
  }

 private:
  Plane plane_;
  Turns turns_;
};

template <class Plane>
Frame by_turn(Plane plane) {
  return Frame::from_attitude([plane = std::move(plane)](const auto& t) {
    using T = std::remove_cvref_t<decltype(t)>;
    return detail::shortest_turn_to<T>(plane.normal(t));
  });
}

Frame of_elements(const KeplerElements& k, const SecularRates& rates, PlaneOrigin origin) {
  const PlaneOfElements plane(k, rates, 0.0);
  if (origin == PlaneOrigin::shortest_turn) return by_turn(plane);
  return Frame::orbit_plane([plane](const auto& t) { return plane.node(t); },
                            [plane](const auto& t) { return plane.inclination(t); });
}

}  // namespace

Frame orbit_plane_frame(const KeplerOrbit& orbit, PlaneOrigin origin) {
  return of_elements(orbit.elements(), {}, origin);
}

Frame orbit_plane_frame(const PrecessingKeplerOrbit& orbit, PlaneOrigin origin) {
  return of_elements(orbit.elements(), orbit.rates(), origin);
}

Frame orbit_plane_frame(const TurnedKeplerOrbit& turned, PlaneOrigin origin) {
  const PrecessingKeplerOrbit& orbit = turned.orbit();
  const PlaneOfElements plane(orbit.elements(), orbit.rates(), turned.angle());
  if (origin == PlaneOrigin::shortest_turn) return by_turn(plane);
  const KeplerElements& k = orbit.elements();
  const detail::TurnedNode turns(
      {k.epoch, k.node, orbit.rates().node, k.inclination, orbit.rates().inclination},
      turned.angle());
  return Frame::from_attitude(ByNode(plane, turns));
}

Frame orbit_plane_frame(const TableOrbit& orbit, PlaneOrigin origin) {
  detail::require_curved(orbit);
  const PlaneOfTable plane(orbit);
  if (origin == PlaneOrigin::shortest_turn) return by_turn(plane);
  const auto node = [&](double t) { return node_of(plane.normal(t)); };
  return Frame::from_attitude(ByNode(plane, detail::WholeTurns::along(orbit.table().times, node)));
}

}  // namespace v0
}  // namespace polhode
