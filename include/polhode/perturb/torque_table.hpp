// SPDX-License-Identifier: MIT
// TorqueTable: a torque given by rows of time: thrusters, wheels.
//
// Equations   between rows: the row before (step), a straight line (linear), or the cubic of
//             Fritsch and Carlson (1980) with the slopes of Fritsch and Butland (1984), which has
//             no extremum that the rows do not have (cubic).
// Units       time; momentum per time.
// Domain      times that increase. The components are those of body axes or of a space. At a row of
//             a step table the new value holds, until the next row's time: the last row is a torque
//             for longer than that moment only where outside = hold, and then the first one is
//             before its time too (one row: at all times). Where two pieces meet the torque is not
//             smooth: those times are breakpoints, where integrate ends a step, so that no pulse is
//             stepped over. It is no kick: a splitting of fixed steps could miss one.
// Accuracy    a few roundings of the largest row of a piece.
// Errors      DomainError for rows that are not finite, times that do not increase, no row; from
//             effect outside the table where that is `refuse`.
// Cost        a binary search and some 30 flops.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

struct TorqueRow {
  double t;
  Vec3 torque;

  constexpr bool operator==(const TorqueRow&) const = default;
};

class TorqueTable {
 public:
  using Law = GivenTorqueLaw;
  enum class Between { step, linear, cubic };
  // What holds before the first row and after the last: no torque, that row's, or an error.
  enum class Outside { zero, hold, refuse };
  struct Rules {
    Between between = Between::linear;
    Outside outside = Outside::zero;
    std::optional<SpaceAxes> axes = std::nullopt;  // none: body axes
  };

  TorqueTable(std::vector<TorqueRow> rows, const Rules& rules);

  const std::vector<TorqueRow>& rows() const { return *rows_; }
  const Rules& rules() const { return rules_; }
  // Where the torque is not smooth, in increasing order.
  const std::vector<double>& breakpoints() const { return *breaks_; }

  Law law() const { return {!rules_.axes}; }
  template <Real T>
  Law::OfTime<T> of_time(const BasicSetting<T>& at) const {
    const Piece p = piece(to_double(at.t));
    const T s = (at.t - T(p.t0)) + at.t_rest;
    BasicVec3<T> u;
    for (int i = 0; i < 3; ++i)
      u[i] = T(p.c[0][i]) + s * (T(p.c[1][i]) + s * (T(p.c[2][i]) + s * T(p.c[3][i])));
    return {rules_.axes ? reference_from_space(at, *rules_.axes, u) : u};
  }
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return law().effect(of_time(at), pose_of(at));
  }

 private:
  // c[0] + c[1] s + c[2] s^2 + c[3] s^3, s = t - t0
  struct Piece {
    double t0;
    Vec3 c[4];
  };
  Piece piece(double t) const;
  Piece inner_piece(std::size_t k) const;
  Vec3 slope(std::size_t k) const;

  std::shared_ptr<const std::vector<TorqueRow>> rows_;
  std::shared_ptr<const std::vector<double>> breaks_;
  Rules rules_;
};

}  // namespace v0
}  // namespace polhode
