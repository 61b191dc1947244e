// SPDX-License-Identifier: MIT
// Frames of an orbit: the local vertical and the orbital plane, of elements or of a table.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/orbit/table_orbit.hpp"

namespace polhode {
inline namespace v0 {

namespace {

// The rate of a frame along a table takes the second derivative of its path.
void require_curved(const TableOrbit& orbit) {
  if (orbit.order() < 4)
    throw DomainError("a frame along a table of order " + std::to_string(orbit.order()) +
                      "; expected 4 or more, for a path with a curvature");
}

// Of position and velocity.
template <class T>
BasicVec3<T> normal_of(const BasicVec3<T>& x, const BasicVec3<T>& v) {
  const BasicVec3<T> h = cross(x, v);
  return (T(1.0) / norm(h)) * h;
}

// The shortest turn from axis 3 to a unit vector other than -axis 3.
template <class T>
BasicQuaternion<T> shortest_turn_to(const BasicVec3<T>& n) {
  using std::sqrt;
  const T one(1.0), half(0.5);
  const T c = sqrt(half * (one + n.z));
  return {c, -(half * n.y / c), half * n.x / c, T(0.0)};
}

// The whole turns of an angle that is known between -pi and pi: half of it turns quaternions, whose
// sign would change from one turn to the next.
class WholeTurns {
 public:
  // None.
  WholeTurns() = default;
  // Counted along rising times at which less than half a turn lies between neighbours.
  template <class Angle>
  static WholeTurns along(const std::vector<double>& times, const Angle& angle) {
    Rows rows;
    double last = 0.0;
    for (const double t : times) {
      const double now = angle(t);
      if (!std::isfinite(now)) continue;
      const double unwrapped = now - turn * std::rint((now - last) / turn);
      last = rows.times.empty() ? now : unwrapped;
      rows.times.push_back(t);
      rows.angles.push_back(last);
    }
    WholeTurns result;
    if (rows.times.size() > 1) result.rows_ = std::make_shared<const Rows>(std::move(rows));
    return result;
  }

  // Whether an odd number of turns belongs to the angle at a time.
  bool odd(double t, double angle) const {
    if (!rows_ || !std::isfinite(t)) return false;
    const auto& times = rows_->times;
    const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, t);
    const auto k = static_cast<std::size_t>(after - times.begin());
    const double share = (t - times[k - 1]) / (times[k] - times[k - 1]);
    const double expected =
        rows_->angles[k - 1] + share * (rows_->angles[k] - rows_->angles[k - 1]);
    return std::fmod(std::rint((expected - angle) / turn), 2.0) != 0.0;
  }

 private:
  static constexpr double turn = 2.0 * std::numbers::pi;
  struct Rows {
    std::vector<double> times;
    std::vector<double> angles;
  };
  std::shared_ptr<const Rows> rows_;
};

// The whole turns of the node of a plane that precesses, on inertial axes that are tilted against
// those in which it does.
//
// The node on the tilted axes is the direction (cos(tilt) sin(i) cos(node) - sin(tilt) cos(i),
// sin(i) sin(node)). It goes round with the node, or, where i is smaller than the tilt, to and fro:
// in each case there is an angle that follows the node and stays less than half a turn away. Where
// i passes from one case to the other the turns are carried over.
class TurnedNode {
 public:
  // Tilted about axis 1 by -tilt; node and inclination advance from `epoch`.
  struct Motion {
    double epoch, node, node_rate, inclination, inclination_rate;
  };
  TurnedNode(const Motion& motion, double tilt) : motion_(motion), tilt_(tilt) {
    const double r = std::remainder(tilt, std::numbers::pi);
    bound_ = std::fabs(r);
    first_ = piece(motion.inclination);
  }

  // Whether an odd number of turns belongs to the node `on_tilted` at a time.
  bool odd(double t, double on_tilted) const {
    if (!std::isfinite(t) || !std::isfinite(on_tilted)) return false;
    const std::int64_t now = piece(inclination(t));
    double turns = between(now, t, on_tilted);
    const std::int64_t step = now > first_ ? 1 : -1;
    if (std::abs(now - first_) > most_pieces) return false;
    for (std::int64_t k = first_; k != now; k += step) {
      const double i = start_of(step > 0 ? k + 1 : k);
      const double passed = motion_.epoch + (i - motion_.inclination) / motion_.inclination_rate;
      const double there = direction(i, node(passed));
      turns += between(k, passed, there) - between(k + step, passed, there);
    }
    return std::fmod(turns, 2.0) != 0.0;
  }

 private:
  static constexpr double pi = std::numbers::pi;
  static constexpr std::int64_t most_pieces = 1000;

  double node(double t) const { return motion_.node + motion_.node_rate * (t - motion_.epoch); }
  double inclination(double t) const {
    return motion_.inclination + motion_.inclination_rate * (t - motion_.epoch);
  }
  double direction(double i, double node) const {
    return std::atan2(std::sin(i) * std::sin(node), std::cos(tilt_) * std::sin(i) * std::cos(node) -
                                                        std::sin(tilt_) * std::cos(i));
  }

  // Pieces of the inclinations, which half turns plus or minus the tilt separate: those with an
  // even number have a multiple of pi in their middle.
  std::int64_t piece(double i) const {
    const double halves = std::rint(i / pi), r = i - pi * halves;
    if (!(std::fabs(halves) < 1e15)) return first_;
    return 2 * static_cast<std::int64_t>(halves) + (r > bound_ ? 1 : r < -bound_ ? -1 : 0);
  }
  double start_of(std::int64_t piece) const {
    const double below = std::floor(static_cast<double>(piece) / 2.0);
    return piece % 2 == 0 ? pi * below - bound_ : pi * below + bound_;
  }

  // From `on_tilted` to the angle that follows it.
  double between(std::int64_t piece, double t, double on_tilted) const {
    const double i = 0.5 * (start_of(piece) + start_of(piece + 1));
    const bool ahead_at_0 = std::sin(i - tilt_) > 0.0, behind_at_pi = std::sin(i + tilt_) > 0.0;
    double follows = ahead_at_0 ? 0.0 : pi;
    if (ahead_at_0 == behind_at_pi)
      follows += ahead_at_0 == (std::sin(i) > 0.0) ? node(t) : -node(t);
    return std::rint((follows - on_tilted) / (2.0 * pi));
  }

  Motion motion_;
  double tilt_;
  double bound_ = 0.0;
  std::int64_t first_ = 0;
};

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
      const Vec3 n = normal_of(orbit.position(t), orbit.velocity(t));
      if (std::isfinite(n.z)) sum = sum + n;
    }
    retrograde_ = sum.z < 0.0;
    turns_ = WholeTurns::along(times, [this](double t) { return in_plane(t).angle; });
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
    BasicVec3<T> n = normal_of(x, orbit_.velocity(t));
    // half a turn about axis 1 first: (x, y, z) to (x, -y, -z)
    if (retrograde_) n = {n.x, -n.y, -n.z};
    BasicQuaternion<T> plane = shortest_turn_to(n);
    if (retrograde_) plane = BasicQuaternion<T>{T(0.0), T(1.0), T(0.0), T(0.0)} * plane;
    const BasicVec3<T> own = rotate(conj(plane), x);
    return {plane, atan2(own.y, own.x)};
  }

  TableOrbit orbit_;
  bool retrograde_ = false;
  WholeTurns turns_;
};

}  // namespace

Frame local_vertical_frame(const TableOrbit& orbit) {
  require_curved(orbit);
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
    return normal_of(orbit_.position(t), orbit_.velocity(t));
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
    return shortest_turn_to<T>(plane.normal(t));
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
  const TurnedNode turns(
      {k.epoch, k.node, orbit.rates().node, k.inclination, orbit.rates().inclination},
      turned.angle());
  return Frame::from_attitude(ByNode(plane, turns));
}

Frame orbit_plane_frame(const TableOrbit& orbit, PlaneOrigin origin) {
  require_curved(orbit);
  const PlaneOfTable plane(orbit);
  if (origin == PlaneOrigin::shortest_turn) return by_turn(plane);
  const auto node = [&](double t) { return node_of(plane.normal(t)); };
  return Frame::from_attitude(ByNode(plane, WholeTurns::along(orbit.table().times, node)));
}

}  // namespace v0
}  // namespace polhode
