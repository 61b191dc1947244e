// SPDX-License-Identifier: MIT
// Moments of quaternions and of rotation vectors: of one attitude, or of a register of epochs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ensemble/attitude_moments.hpp"
#include "ensemble/attitude_spread.hpp"
#include "math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

struct AttitudeSums {
  // A quaternion whose square is so near to 1 is taken as it is.
  static constexpr double unit_slack = 0x1p-49;  // 8 eps

  template <class T>
  struct Products {
    T p[10];
    T square;
  };
  template <class T>
  [[gnu::always_inline]] static Products<T> products(const T& w, const T& x, const T& y,
                                                     const T& z) {
    const T ww = w * w, xx = x * x, yy = y * y, zz = z * z;
    return {{ww, w * x, w * y, w * z, xx, x * y, x * z, yy, y * z, zz}, (ww + xx) + (yy + zz)};
  }

  [[gnu::always_inline]] static double* of(AttitudeMoments& moments) { return moments.sums_; }
  [[gnu::always_inline]] static void count(AttitudeMoments& moments, std::int64_t more) {
    moments.count_ += more;
  }
};

// add_rows in the lanes of a set; members * epochs states.
template <InstructionSet isa>
void add_attitude_rows(AttitudeMoments* moments, std::size_t epochs, std::int64_t first,
                       const RotorState* states, std::size_t members);

// Moments of rotation vectors about a reference: of one attitude, or of a register of epochs.
template <class T>
struct TurnFrom {
  T v[3];
  T angle, square;  // of v, and of the quaternion
  T bend;           // (1 - h) / |u|^2, u the vector part, or 0
  T u[3];
};

struct SpreadSums {
  // Squares of quaternions that nothing need be done about.
  static constexpr double least_square = 0x1p-400, most_square = 0x1p400;

  template <class T>
  struct Sums {
    T n, mean[3], products[6], bend[6], farthest, member;
  };

  // The turn from a unit quaternion r to q, q of either sign and any length.
  template <InstructionSet isa>
  [[gnu::always_inline]] static TurnFrom<Pack<isa>> turn(const Pack<isa>* r, const Pack<isa>* q) {
    using T = Pack<isa>;
    const T w = r[0] * q[0] + r[1] * q[1] + (r[2] * q[2] + r[3] * q[3]);
    TurnFrom<T> t;
    t.u[0] = (r[0] * q[1] - r[1] * q[0]) + (r[3] * q[2] - r[2] * q[3]);
    t.u[1] = (r[0] * q[2] - r[2] * q[0]) + (r[1] * q[3] - r[3] * q[1]);
    t.u[2] = (r[0] * q[3] - r[3] * q[0]) + (r[2] * q[1] - r[1] * q[2]);
    const T ss = t.u[0] * t.u[0] + t.u[1] * t.u[1] + t.u[2] * t.u[2];
    t.square = ss + w * w;
    const T s = sqrt(ss), c = abs(w);
    const T half = atan2(s, c);
    t.angle = half + half;
    const auto none = ss == T(0.0);
    const T over = T(1.0) / select(none, T(1.0), s);
    const T factor = negated(w < T(0.0), select(none, T(0.0), T(t.angle * over)));
    for (int i = 0; i < 3; ++i) t.v[i] = factor * t.u[i];
    t.bend = select(none, T(0.0), T((T(1.0) - half * c * over) * over * over));
    return t;
  }

  // One more in every lane: Welford, as in moment_sums.hpp.
  template <class T>
  [[gnu::always_inline]] static void add(Sums<T>& to, const TurnFrom<T>& t, const T& member) {
    to.n = to.n + T(1.0);
    const T part = T(1.0) / to.n;
    T d[3];
    for (int i = 0; i < 3; ++i) {
      d[i] = t.v[i] - to.mean[i];
      to.mean[i] = to.mean[i] + d[i] * part;
    }
    for (int i = 0, k = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j, ++k) {
        to.products[k] = to.products[k] + d[i] * (t.v[j] - to.mean[j]);
        to.bend[k] = to.bend[k] + (t.bend * t.u[i]) * t.u[j];
      }
    const auto farther = to.farthest < t.angle;
    to.farthest = select(farther, t.angle, to.farthest);
    to.member = select(farther, member, to.member);
  }

  // visit(number of the accumulator, number of the sums), for all.
  template <class T, class Visit>
  [[gnu::always_inline]] static void each(AttitudeSpread& a, Sums<T>& s, const Visit& visit) {
    visit(a.count_, s.n);
    for (int i = 0; i < 3; ++i) visit(a.mean_[i], s.mean[i]);
    for (int i = 0; i < 6; ++i) visit(a.products_[i], s.products[i]);
    for (int i = 0; i < 6; ++i) visit(a.bend_[i], s.bend[i]);
    visit(a.farthest_, s.farthest);
    visit(a.farthest_member_, s.member);
  }
  [[gnu::always_inline]] static const Quaternion& reference(const AttitudeSpread& a) {
    return a.reference_;
  }
};

// add_rows in the lanes of a set; members * epochs states.
template <InstructionSet isa>
void add_spread_rows(AttitudeSpread* spreads, std::size_t epochs, std::int64_t first,
                     const RotorState* states, std::size_t members);

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
