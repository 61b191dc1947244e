// SPDX-License-Identifier: MIT
// The whole turns of the node of a plane that precesses, on inertial axes that are tilted against
// those in which it does.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace polhode {
inline namespace v0 {
namespace detail {

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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
