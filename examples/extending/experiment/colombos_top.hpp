// SPDX-License-Identifier: MIT
// A motion of your own, Colombo's top: the spin axis s of a planet precesses about the normal n of
// its orbit, ds/dt = alpha (s.n) s x n, while n turns about axis 3 at the rate of the node.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "polhode/math/vector.hpp"
#include "polhode/run/custom_experiment.hpp"

struct SpinAxis {
  polhode::Vec3 s;

  bool operator==(const SpinAxis&) const = default;
};

template <class Visit>
void each_number(SpinAxis& axis, Visit&& visit) {
  for (double* x : {&axis.s.x, &axis.s.y, &axis.s.z}) visit(*x);
}

struct ColombosTop {
  using State = SpinAxis;
  using Values = std::array<double, 3>;
  static constexpr std::string_view name = "Colombo's top";

  double alpha;  // precession constant
  double inclination;
  double node_rate;

  polhode::Vec3 normal(double t) const {
    const double node = node_rate * t, sine = std::sin(inclination);
    return {sine * std::sin(node), -sine * std::cos(node), std::cos(inclination)};
  }
  // Of the motion in axes that turn with the node; constant.
  double energy(double t, const polhode::Vec3& s) const {
    const double cosine = dot(s, normal(t));
    return 0.5 * alpha * cosine * cosine + node_rate * s.z;
  }

  // What integrate() asks of a model. Templates on the number type would give double-double too.
  template <class T>
    requires std::is_same_v<T, double>
  Values values(const State& axis) const {
    return {axis.s.x, axis.s.y, axis.s.z};
  }
  State state(const Values& y) const {
    const polhode::Vec3 s{y[0], y[1], y[2]};
    return {(1.0 / norm(s)) * s};
  }
  Values rates(const polhode::DoubleDouble& t, const Values& y) const {
    const polhode::Vec3 s{y[0], y[1], y[2]}, n = normal(t.hi);
    const polhode::Vec3 rate = alpha * dot(s, n) * cross(s, n);
    return {rate.x, rate.y, rate.z};
  }
  double error_size(const Values& error, const Values&, const Values&) const {
    return std::hypot(error[0], error[1], error[2]);
  }
  // While the orbit stands still the axis turns about its normal. With this, Splitting moves it
  // too.
  State frozen(const polhode::DoubleDouble& t, const State& axis, double h) const {
    const polhode::Vec3 n = normal(t.hi), across = cross(n, axis.s);
    const double angle = -alpha * dot(axis.s, n) * h;
    const polhode::Vec3 s =
        axis.s + std::sin(angle) * across + (1.0 - std::cos(angle)) * cross(n, across);
    return {(1.0 / norm(s)) * s};
  }
};
