// SPDX-License-Identifier: MIT
// The motion of a point about an oblate body by its force, and the ellipse of each instant: what
// secular rates and mean elements are measured on.
//
// Domain      bound motion. RK4 of even steps: some 1e-9 of the distance per radian with a thousand
//             steps a turn and a moderate eccentricity.
#pragma once

#include <array>
#include <cmath>

#include "polhode/math/vector.hpp"

namespace oracle {

using polhode::Vec3;

struct PointState {
  Vec3 x;
  Vec3 v;
};

// The angles that two-body motion keeps, and n t + M0.
struct Ellipse {
  double axis;
  double eccentricity;
  double node;
  double argument;
  double mean_anomaly;
};

class OblateMotion {
 public:
  OblateMotion(double gm, double J2, double radius)
      : gm_(gm), strength_(1.5 * gm * J2 * radius * radius) {}

  // The gradient of gm / r (1 - J2 (R / r)^2 P2(z / r)).
  Vec3 force(const Vec3& x) const {
    const double r = norm(x), r5 = r * r * r * r * r, s = 5.0 * (x.z / r) * (x.z / r);
    const double k = strength_ / r5, point = gm_ / (r * r * r);
    return {-(point + k * (1.0 - s)) * x.x, -(point + k * (1.0 - s)) * x.y,
            -(point + k * (3.0 - s)) * x.z};
  }

  PointState after(const PointState& s, double h) const {
    const auto rate = [&](const PointState& at) { return PointState{at.v, force(at.x)}; };
    const auto moved = [](const PointState& at, double by, const PointState& k) {
      return PointState{at.x + by * k.x, at.v + by * k.v};
    };
    const PointState a = rate(s), b = rate(moved(s, 0.5 * h, a)), c = rate(moved(s, 0.5 * h, b)),
                     d = rate(moved(s, h, c));
    return moved(moved(moved(moved(s, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, d);
  }

  // By the vectors of angular momentum and of Laplace.
  Ellipse ellipse(const PointState& s) const {
    const double r = norm(s.x);
    const Vec3 h = cross(s.x, s.v), e = (1.0 / gm_) * cross(s.v, h) - (1.0 / r) * s.x;
    const double node = std::atan2(h.x, -h.y);
    const Vec3 to_node{std::cos(node), std::sin(node), 0.0};
    const Vec3 across = (1.0 / norm(h)) * cross(h, to_node);
    const double eccentricity = norm(e), axis = 1.0 / (2.0 / r - dot(s.v, s.v) / gm_);
    // e cos E = 1 - r / a, e sin E = x.v / sqrt(gm a)
    const double sine = dot(s.x, s.v) / std::sqrt(gm_ * axis);
    const double anomaly = std::atan2(sine, 1.0 - r / axis);
    return {axis, eccentricity, node, std::atan2(dot(e, across), dot(e, to_node)), anomaly - sine};
  }

 private:
  double gm_;
  double strength_;
};

}  // namespace oracle
