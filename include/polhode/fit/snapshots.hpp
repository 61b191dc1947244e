// SPDX-License-Identifier: MIT
// Snapshots: what was seen of the attitude and the rate of a body at some times, with errors.
//
// Equations   q: v_I = q v_F q*, body axes F (those of the shape model, not the principal ones) to
//             inertial axes I. The error of an attitude is a rotation vector in body axes: true
//             attitude q exp(dtheta_F / 2).
// Units       t any unit of time; errors of attitudes and directions rad; of rates rad per unit of
//             time; covariances the squares of these.
// Domain      times finite, in any order; several observations may have the same time, and are
//             independent. Quaternions and vectors of any length but 0.
// Accuracy    values are kept as given. Derivatives of measurements are central differences, to
//             about 1e-10.
// Errors      check: DomainError that names the observation (counted from 1), its value and what is
//             expected: finite numbers, covariances symmetric and positive definite.
// Cost        a few numbers each.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

struct ObservedAttitude {
  double t = 0.0;
  Quaternion q;
  Mat3 covariance = Mat3::identity();
};

// A body axis, seen along an inertial direction; sigma is that of each of two angles.
struct ObservedDirection {
  double t = 0.0;
  Vec3 axis_F{0.0, 0.0, 1.0};
  Vec3 direction_I{0.0, 0.0, 1.0};
  double sigma = 1.0;
};

// The angular velocity in body axes.
struct ObservedRate {
  double t = 0.0;
  Vec3 w_F;
  Mat3 covariance = Mat3::identity();
};

// Writes numbers of the motion at a time: q as that of attitudes, w in body axes.
using MotionFunction =
    std::function<void(double t, const Quaternion& q, const Vec3& w_F, std::span<double> numbers)>;

// Numbers that are any function of the motion, with independent errors.
struct Measurement {
  double t = 0.0;
  std::vector<double> seen;
  std::vector<double> sigmas;
  std::shared_ptr<const MotionFunction> function;
  std::vector<bool> are_angles = {};  // compared modulo a turn; empty: none is
};

struct Snapshots {
  std::vector<ObservedAttitude> attitudes;
  std::vector<ObservedDirection> directions;
  std::vector<ObservedRate> rates;
  std::vector<Measurement> measurements = {};

  // How many numbers they are.
  std::size_t numbers() const {
    std::size_t count = 3 * attitudes.size() + 2 * directions.size() + 3 * rates.size();
    for (const Measurement& one : measurements) count += one.seen.size();
    return count;
  }
};

// The times of attitudes, then directions, rates and measurements, each in its order.
std::vector<double> times_of(const Snapshots& seen);

// The covariance of three independent errors, and of three of one size.
Mat3 covariance_of(const Vec3& sigma);
Mat3 covariance_of(double sigma);

void check(const Snapshots& seen);

// A sentence for each observation that repeats an earlier one in every number.
std::vector<std::string> repeated(const Snapshots& seen);

}  // namespace fit
}  // namespace v0
}  // namespace polhode
