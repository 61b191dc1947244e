// SPDX-License-Identifier: MIT
// The sweeps of several rotors by collocation, the bodies as lanes. Compiled once for each set of
// instructions.
#pragma once

#include "dynamics/collocation/lanes/lost_by_product.hpp"
#include "dynamics/collocation/lanes/of_stages.hpp"
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
  // The effects go from where terms add them to where the rates take them from; nothing is left
  // there for the next sweep.
  [[gnu::always_inline]] static void take(double* row, double* to, std::size_t lane) {
    for (std::size_t i = 0; i < stages; ++i) {
      put(to, i, lane, at(row, i, lane));
      put(row, i, lane, T(0.0));
    }
  }
  [[gnu::always_inline]] static void take_effects(BodyLanes& b, std::size_t lane) {
    for (std::size_t n = 0; n < 3; ++n) take(b.u(n), b.drive(n), lane);
    if (!b.has_rate) return;
    for (std::size_t n = 0; n < 3; ++n) take(b.v(n), b.drive(3 + n), lane);
  }
  [[gnu::always_inline]] static void set_rate(BodyLanes& b, std::size_t n, std::size_t stage,
                                              std::size_t lane, const T& f) {
    put(b.F(n), stage, lane, f);
    put(b.L(n), stage, lane, at(b.hb(), stage, lane) * f);
  }

  // The product of matrix[j][i] with numbers j of a row.
  template <class Matrix>
  [[gnu::always_inline]] static T product(const Matrix& matrix, const T* from, std::size_t i) {
    T sum = matrix(0, i) * from[0], odd = matrix(1, i) * from[1];
    for (std::size_t j = 2; j < stages; j += 2) {
      sum = sum + matrix(j, i) * from[j];
      odd = odd + matrix(j + 1, i) * from[j + 1];
    }
    return sum + odd;
  }
  [[gnu::always_inline]] static void load(const double* row, std::size_t lane, T* to) {
    for (std::size_t j = 0; j < stages; ++j) to[j] = at(row, j, lane);
  }
  // to = matrix * from, of one matrix for all bodies.
  [[gnu::always_inline]] static void transform(const StageMatrix& matrix, const double* from,
                                               double* to, std::size_t lane) {
    T x[stages];
    load(from, lane, x);
    const auto of_all = [&](std::size_t j, std::size_t i) { return T(matrix[j][i]); };
    for (std::size_t i = 0; i < stages; ++i) put(to, i, lane, product(of_all, x, i));
  }

  // Y of one number from L; the largest change, where it is asked for.
  template <bool asked = true>
  [[gnu::always_inline]] static T moved(const GaussScheme& scheme, BodyLanes& b, std::size_t n,
                                        std::size_t lane, T change) {
    T L[stages];
    load(b.L(n), lane, L);
    const T y = in(b.y[n], lane), carry = in(b.carry[n], lane);
    const auto mu = [&](std::size_t j, std::size_t i) { return T(scheme.mu[j][i]); };
    for (std::size_t i = 0; i < stages; ++i) {
      const T next = y + (product(mu, L, i) + carry);
      if constexpr (asked) {
        const T by = abs(next - at(b.Y(n), i, lane));
        change = select(change > by, change, by);  // NaN stays until the next number
      }
      put(b.Y(n), i, lane, next);
    }
    return change;
  }

  [[gnu::always_inline]] static void momentum_rates(BodyLanes& b, std::size_t i, std::size_t lane) {
    const auto Y = [&](std::size_t n) { return at(b.Y(n), i, lane); };
    const auto u = [&](std::size_t n) { return at(b.drive(n), i, lane); };
    const BasicVec3<T> g{Y(4), Y(5), Y(6)};
    const BasicVec3<T> euler{in(b.euler[0], lane), in(b.euler[1], lane), in(b.euler[2], lane)};
    BasicVec3<T> f = momentum_rate(euler, g, {u(0), u(1), u(2)});
    if (b.has_rate) {
      const auto v = [&](std::size_t n) { return at(b.drive(3 + n), i, lane); };
      f = f + cross(g, BasicVec3<T>{v(0), v(1), v(2)});
    }
    set_rate(b, 4, i, lane, f.x);
    set_rate(b, 5, i, lane, f.y);
    set_rate(b, 6, i, lane, f.z);
  }
  [[gnu::always_inline]] static void attitude_rates(BodyLanes& b, std::size_t i, std::size_t lane) {
    const auto Y = [&](std::size_t n) { return at(b.Y(n), i, lane); };
    const auto v = [&](std::size_t n) { return at(b.drive(3 + n), i, lane); };
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

  // F from Y, and Y from F: q at the rates of the g of the pass before, and the next g; but no g
  // after the last q.
  template <std::size_t numbers, bool asked>
  [[gnu::always_inline]] static T pass(const GaussScheme& scheme, BodyLanes& b, std::size_t lane) {
    for (std::size_t i = 0; i < stages; ++i) {
      attitude_rates(b, i, lane);
      if constexpr (numbers == 7) momentum_rates(b, i, lane);
    }
    T dq(0.0);
    for (std::size_t n = 0; n < 4; ++n) dq = moved<asked>(scheme, b, n, lane, dq);
    for (std::size_t n = 4; n < numbers; ++n) moved<false>(scheme, b, n, lane, dq);
    return dq;
  }
  [[gnu::flatten]] static void sweep(const GaussScheme& scheme, BodyLanes& b) {
    for (std::size_t lane = 0; lane < body_lanes; lane += T::width) {
      take_effects(b, lane);
      for (std::size_t i = 0; i < stages; ++i) momentum_rates(b, i, lane);
      T dg(0.0);
      for (std::size_t n = 4; n < 7; ++n) dg = moved(scheme, b, n, lane, dg);
      dg = dg * in(b.inverse_momentum, lane);
      const T dq = pass<7, true>(scheme, b, lane);
      for (int k = 2; k < passes_of_sweep; ++k) pass<7, false>(scheme, b, lane);
      pass<4, false>(scheme, b, lane);
      select(dq <= dg, dg, dq).store(b.change.data() + lane);
    }
  }

  // Y from the last step of each body.
  [[gnu::flatten]] static void place(const GaussScheme& scheme, BodyLanes& b) {
    for (std::size_t lane = 0; lane < body_lanes; lane += T::width) {
      const auto of_body = [&](std::size_t j, std::size_t i) {
        return T::loaded(b.at_stages(j, i) + lane);
      };
      for (std::size_t n = 0; n < 7; ++n) {
        T before[stages];
        load(b.kept(n), lane, before);
        for (std::size_t i = 0; i < stages; ++i)
          put(b.L(n), i, lane, at(b.hb(), i, lane) * product(of_body, before, i));
        moved<false>(scheme, b, n, lane, T(0.0));
      }
    }
  }

  // F and what it was made of, where the mark is not 0.
  [[gnu::flatten]] static void keep(const BodyLine& mark, BodyLanes& b) {
    for (std::size_t lane = 0; lane < body_lanes; lane += T::width) {
      const typename T::Mask marked = in(mark, lane) != T(0.0);
      const auto take = [&](const double* from, double* to) {
        for (std::size_t i = 0; i < stages; ++i)
          put(to, i, lane, select(marked, at(from, i, lane), at(to, i, lane)));
      };
      for (std::size_t n = 0; n < 7; ++n) take(b.F(n), b.kept(n));
      for (std::size_t n = 0; n < 6; ++n) take(b.drive(n), b.kept_drive(n));
    }
  }

  // Of what was kept: the end of the step, and the polynomials, in F and in `drive`.
  [[gnu::flatten]] static void finish(const GaussScheme& scheme, BodyLanes& b) {
    for (std::size_t lane = 0; lane < body_lanes; lane += T::width) {
      for (std::size_t n = 0; n < 7; ++n) {
        T y = in(b.y[n], lane), low = in(b.carry[n], lane);
        for (std::size_t j = 0; j < stages; ++j) {
          const T hb = at(b.hb(), j, lane), F = at(b.kept(n), j, lane);
          const TwoTerms<T> sum = two_sum(y, hb * F);
          y = sum.hi;
          low = low + (sum.lo + lost_by_product<T>(hb, F));
        }
        const T end = y + low;
        end.store(b.end[n].data() + lane);
        ((y - end) + low).store(b.end_carry[n].data() + lane);
        transform(scheme.coefficient, b.kept(n), b.F(n), lane);
      }
      for (std::size_t n = 0; n < 6; ++n)
        transform(scheme.coefficient, b.kept_drive(n), b.drive(n), lane);
    }
  }
};

template <InstructionSet isa>
BodyKernels body_kernels_of(std::size_t stages) {
  return of_stages<16>(stages, []<std::size_t s>() {
    using K = BodiesKernel<isa, s>;
    return BodyKernels{&K::place, &K::sweep, &K::keep, &K::finish};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
