// SPDX-License-Identifier: MIT
// AttitudeMoments: the second moments of the quaternions of many attitudes, which do not know the
// sign of a quaternion; hence a mean attitude, and how far the attitudes gather about it.
//
// Equations   M = (1/n) sum of q q^T / |q|^2. Its eigenvectors are attitudes, its eigenvalues l1 >=
//             l2 >= l3 >= l4 of sum 1 the mean squares of cos(half the angle to them). The mean is
//             the first: it makes the mean of sin^2(half the angle) least, 1 - l1.
// Domain      any quaternions but 0; those that are 0 or not finite are left out and named. Uniform
//             attitudes have l = 1/4 each; turning evenly about an axis, l1 = l2 = 1/2. Such clouds
//             have no mean: it is told where r = (l1 - l2)/(l1 + l2) is 0.9 or more, or exp(-n r^2)
//             below 1/1000, about the chance that as many attitudes without a mean show such an r.
//             The axes are told in any case.
// Accuracy    budget attitude_moments_eps: each sum is a plain one in the order of members, tens of
//             eps in thousands; n eps at the very worst. So 1 - l1 of a cloud of angles below 1e-7
//             has no digits: AttitudeSpread has. The bits do not depend on how many are added at a
//             time, by which function, or on the set of instructions.
// Errors      DomainError for rows that do not fit, for a set that this processor lacks, and as an
//             Accumulator.
// Cost        benchmarks/statistics.cpp; eleven numbers, and those of LeftOut.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "polhode/ensemble/bins.hpp"
#include "polhode/math/instruction_set.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {
struct AttitudeSums;
}  // namespace detail

// Eigenvalues from the greatest on, and the unit quaternions that belong to them, w >= 0.
struct PrincipalAttitudes {
  std::array<double, 4> values;
  std::array<Quaternion, 4> axes;
};

class AttitudeMoments {
 public:
  AttitudeMoments() = default;

  void add(std::int64_t member, const Quaternion& q);
  // Members first, first + 1, ...
  void add(std::int64_t first, std::span<const RotorState> states);
  void merge(const AttitudeMoments& later);

  std::int64_t count() const { return count_; }  // without those left out
  const LeftOut& left_out() const { return left_out_; }

  // M_ij of the components w, x, y, z; NaN of no attitude, as what follows.
  double moment(int i, int j) const;
  PrincipalAttitudes principal() const;
  std::optional<Quaternion> mean() const;
  // (4 l1 - 1)/3: 1 where all attitudes are the same, 0 where they are uniform.
  double concentration() const;

  std::vector<double> numbers() const;
  AttitudeMoments restored(std::span<const double> numbers) const;

 private:
  friend struct detail::AttitudeSums;

  double sums_[10] = {};  // ww wx wy wz xx xy xz yy yz zz
  std::int64_t count_ = 0;
  LeftOut left_out_;
};

// Members first, first + 1, ... at every epoch: states[m * epochs.size() + e] is member first + m
// at epoch e. The bits of adding them one by one; fastest for 64 members at a time, or more.
void add_rows(std::span<AttitudeMoments> epochs, std::int64_t first,
              std::span<const RotorState> states, InstructionSet set = widest_instruction_set());

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
