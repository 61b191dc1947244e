// SPDX-License-Identifier: MIT
// The sweeps of several rotors by collocation, the bodies as lanes. Compiled once for each set of
// instructions.
#pragma once

#include "dynamics/collocation/lanes/rotor_rates.hpp"
#include "dynamics/collocation/lockstep/body_lanes.hpp"
#include "polhode/math/pack.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Every sum in the order of RotorKernel.
template <InstructionSet isa, std::size_t stages>
struct BodiesKernel {
  using T = Pack<isa>;

  [[gnu::always_inline]] static T at(const double* row, std::size_t stage, std::size_t lane) {
    return T::loaded(row + (stage * body_lanes + lane));
  }
  [[gnu::always_inline]] static void put(double* row, std::size_t stage, std::size_t lane,
                                         const T& x) {
    x.store(row + (stage * body_lanes + lane));
  }
  [[gnu::always_inline]] static T in(const BodyLine& line, std::size_t lane) {
    return T::loaded(line.data() + lane);
  }
  // An effect, kept in `to`: nothing is left of it for the next sweep.
  [[gnu::always_inline]] static T taken(double* row, double* to, std::size_t stage,
                                        std::size_t lane) {
    const T x = at(row, stage, lane);
    put(to, stage, lane, x);
    put(row, stage, lane, T(0.0));
    return x;
  }
  [[gnu::always_inline]] static void set_rate(BodyLanes& b, std::size_t n, std::size_t stage,
                                              std::size_t lane, const T& f) {
    put(b.F(n), stage, lane, f);
    put(b.L(n), stage, lane, at(b.hb(), stage, lane) * f);
  }

  // Y of one number from L; the largest change.
  [[gnu::always_inline]] static T moved(const GaussScheme& scheme, BodyLanes& b, std::size_t n,
                                        std::size_t lane, T change) {
    T L[stages];
    for (std::size_t j = 0; j < stages; ++j) L[j] = at(b.L(n), j, lane);
    const T y = in(b.y[n], lane), carry = in(b.carry[n], lane);
    for (std::size_t i = 0; i < stages; ++i) {
      T sum = T(scheme.mu[0][i]) * L[0], odd = T(scheme.mu[1][i]) * L[1];
      for (std::size_t j = 2; j < stages; j += 2) {
        sum = sum + T(scheme.mu[j][i]) * L[j];
        odd = odd + T(scheme.mu[j + 1][i]) * L[j + 1];
      }
      const T next = y + ((sum + odd) + carry);
      const T by = abs(next - at(b.Y(n), i, lane));
      change = select(by <= change, change, by);  // NaN stays until the next number
      put(b.Y(n), i, lane, next);
    }
    return change;
  }

  [[gnu::always_inline]] static void momentum_rates(BodyLanes& b, std::size_t i, std::size_t lane) {
    const auto Y = [&](std::size_t n) { return at(b.Y(n), i, lane); };
    const auto u = [&](std::size_t n) { return taken(b.u(n), b.drive(n), i, lane); };
    const BasicVec3<T> g{Y(4), Y(5), Y(6)};
    const BasicVec3<T> euler{in(b.euler[0], lane), in(b.euler[1], lane), in(b.euler[2], lane)};
    BasicVec3<T> f = momentum_rate(euler, g, {u(0), u(1), u(2)});
    if (b.has_rate) {
      const auto v = [&](std::size_t n) { return at(b.v(n), i, lane); };
      f = f + cross(g, BasicVec3<T>{v(0), v(1), v(2)});
    }
    set_rate(b, 4, i, lane, f.x);
    set_rate(b, 5, i, lane, f.y);
    set_rate(b, 6, i, lane, f.z);
  }
  [[gnu::always_inline]] static void attitude_rates(BodyLanes& b, std::size_t i, std::size_t lane) {
    const auto Y = [&](std::size_t n) { return at(b.Y(n), i, lane); };
    const auto v = [&](std::size_t n) { return taken(b.v(n), b.drive(3 + n), i, lane); };
    const auto half = [&](std::size_t n) {
      const T w =
          half_rate(in(b.half_inverse[n], lane), in(b.half_inverse_rest[n], lane), Y(4 + n));
      return b.has_rate ? w + T(0.5) * v(n) : w;
    };
    const BasicQuaternion<T> q{Y(0), Y(1), Y(2), Y(3)};
    BasicQuaternion<T> f = attitude_rate(q, {half(0), half(1), half(2)});
    if (b.has_frame) {
      const auto half_mu = [&](std::size_t n) { return T(0.5) * at(b.mu_S(n), i, lane); };
      f = seen_in_frame(f, {half_mu(0), half_mu(1), half_mu(2)}, q);
    }
    set_rate(b, 0, i, lane, f.w);
    set_rate(b, 1, i, lane, f.x);
    set_rate(b, 2, i, lane, f.y);
    set_rate(b, 3, i, lane, f.z);
  }

  [[gnu::flatten]] static void sweep(const GaussScheme& scheme, BodyLanes& b) {
    for (std::size_t lane = 0; lane < body_lanes; lane += T::width) {
      for (std::size_t i = 0; i < stages; ++i) momentum_rates(b, i, lane);
      T dg(0.0), dq(0.0);
      for (std::size_t n = 4; n < 7; ++n) dg = moved(scheme, b, n, lane, dg);
      dg = dg * in(b.inverse_momentum, lane);
      for (std::size_t i = 0; i < stages; ++i) attitude_rates(b, i, lane);
      for (std::size_t n = 0; n < 4; ++n) dq = moved(scheme, b, n, lane, dq);
      select(dq <= dg, dg, dq).store(b.change.data() + lane);
    }
  }
};

template <InstructionSet isa>
BodySweep body_sweep_kernel(std::size_t stages) {
  switch (stages) {
    case 4:
      return &BodiesKernel<isa, 4>::sweep;
    case 8:
      return &BodiesKernel<isa, 8>::sweep;
    default:
      return &BodiesKernel<isa, 16>::sweep;
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
