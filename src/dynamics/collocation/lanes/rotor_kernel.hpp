// SPDX-License-Identifier: MIT
// The sweeps of a rotor by collocation, the stages as lanes. Compiled once for each set of
// instructions.
#pragma once

#include <limits>

#include "dynamics/collocation/gauss_scheme.hpp"
#include "dynamics/collocation/lanes/dispatch_stage_count.hpp"
#include "dynamics/collocation/lanes/product_error.hpp"
#include "dynamics/collocation/lanes/rotor_rates.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <InstructionSet isa, std::size_t stages>
struct RotorKernel {
  using T = Pack<isa>;
  static constexpr std::size_t filled = filled_stages(stages);

  [[gnu::always_inline]] static T loaded(const StageRow& row, std::size_t i) {
    return T::loaded(row.data() + i);
  }
  [[gnu::always_inline]] static void store(const T& x, StageRow& row, std::size_t i) {
    x.store(row.data() + i);
  }

  // The effects go from where terms add them to where the rates take them from; nothing is left
  // there for the next sweep.
  [[gnu::always_inline]] static void take(StageRow& row, StageRow& to) {
    for (std::size_t i = 0; i < filled; i += T::width) {
      store(loaded(row, i), to, i);
      store(T(0.0), row, i);
    }
  }
  [[gnu::always_inline]] static void take_effects(RotorStep& s) {
    for (std::size_t n = 0; n < 3; ++n) take(s.effects.u[n], s.drive[n]);
    if (!s.has_rate) return;
    for (std::size_t n = 0; n < 3; ++n) take(s.effects.v[n], s.drive[3 + n]);
  }

  // Rows i, i + 1, ... of matrix * from, for numbers `first` to `last` of a state. In two sums, of
  // half the length: a sweep waits for them.
  template <std::size_t first, std::size_t last>
  [[gnu::always_inline]] static void product(const StageMatrix& matrix,
                                             const std::array<StageRow, 7>& from, std::size_t i,
                                             T* sum) {
    T odd[7];
    for (std::size_t n = first; n < last; ++n) {
      sum[n] = loaded(matrix[0], i) * T(from[n][0]);
      odd[n] = loaded(matrix[1], i) * T(from[n][1]);
    }
    for (std::size_t j = 2; j < stages; j += 2) {
      const T column = loaded(matrix[j], i), next = loaded(matrix[j + 1], i);
      for (std::size_t n = first; n < last; ++n) {
        sum[n] = sum[n] + column * T(from[n][j]);
        odd[n] = odd[n] + next * T(from[n][j + 1]);
      }
    }
    for (std::size_t n = first; n < last; ++n) sum[n] = sum[n] + odd[n];
  }

  template <std::size_t first, std::size_t last>
  [[gnu::always_inline]] static void weigh(RotorStep& s) {
    for (std::size_t i = 0; i < filled; i += T::width)
      for (std::size_t n = first; n < last; ++n)
        store(loaded(s.hb, i) * loaded(s.F[n], i), s.L[n], i);
  }
  // Y from L; the largest change of those before `asked`.
  template <std::size_t first, std::size_t last, std::size_t asked = last>
  [[gnu::always_inline]] static T moved(const GaussScheme& scheme, RotorStep& s) {
    T change(0.0);
    for (std::size_t i = 0; i < filled; i += T::width) {
      T sum[7];
      product<first, last>(scheme.mu, s.L, i, sum);
      for (std::size_t n = first; n < last; ++n) {
        const T next = T(s.y[n]) + (sum[n] + T(s.carry[n]));
        if (n < asked) {
          const T by = abs(next - loaded(s.Y.rows[n], i));
          change = select(change > by, change, by);  // NaN stays until the next number
        }
        store(next, s.Y.rows[n], i);
      }
    }
    return change;
  }
  [[gnu::always_inline]] static double largest(const T& x) {
    double r[T::width];
    x.store(r);
    for (std::size_t half = T::width / 2; half > 0; half /= 2)
      for (std::size_t i = 0; i < half; ++i) r[i] = r[i + half] <= r[i] ? r[i] : r[i + half];
    return r[0];
  }

  // A rate, and what it contributes to the step.
  [[gnu::always_inline]] static void set_rate(RotorStep& s, std::size_t n, std::size_t i,
                                              const T& f) {
    store(f, s.F[n], i);
    store(loaded(s.hb, i) * f, s.L[n], i);
  }

  [[gnu::flatten]] static void place(const GaussScheme& scheme, RotorStep& s) {
    weigh<0, 7>(s);
    moved<0, 7, 0>(scheme, s);
  }
  [[gnu::flatten]] static void measure(RotorStep& s) {
    T most(std::numeric_limits<double>::min());
    for (std::size_t i = 0; i < filled; i += T::width)
      for (std::size_t n = 4; n < 7; ++n) {
        const T g = abs(loaded(s.Y.rows[n], i));
        most = select(g <= most, most, g);
      }
    s.inverse_momentum = 1.0 / largest(most);
  }

  [[gnu::always_inline]] static void momentum_rates(const RotorConstants& body, RotorStep& s,
                                                    std::size_t i) {
    const auto Y = [&](std::size_t n) { return loaded(s.Y.rows[n], i); };
    const auto u = [&](std::size_t n) { return loaded(s.drive[n], i); };
    const BasicVec3<T> g{Y(4), Y(5), Y(6)};
    const BasicVec3<T> euler{T(body.euler.x), T(body.euler.y), T(body.euler.z)};
    BasicVec3<T> f = momentum_rate(euler, g, {u(0), u(1), u(2)});
    if (s.has_rate) {
      const auto v = [&](std::size_t n) { return loaded(s.drive[3 + n], i); };
      f = f + cross(g, BasicVec3<T>{v(0), v(1), v(2)});
    }
    set_rate(s, 4, i, f.x);
    set_rate(s, 5, i, f.y);
    set_rate(s, 6, i, f.z);
  }
  [[gnu::always_inline]] static void attitude_rates(const RotorConstants& body, RotorStep& s,
                                                    std::size_t i) {
    const auto Y = [&](std::size_t n) { return loaded(s.Y.rows[n], i); };
    const auto v = [&](std::size_t n) { return loaded(s.drive[3 + n], i); };
    const auto half = [&](std::size_t n) {
      const DoubleDouble& c = body.half_inverse[n];
      const T w = half_rate(T(c.hi), T(c.lo), Y(4 + n));
      return s.has_rate ? w + T(0.5) * v(n) : w;
    };
    const BasicQuaternion<T> q{Y(0), Y(1), Y(2), Y(3)};
    BasicQuaternion<T> f = attitude_rate(q, {half(0), half(1), half(2)});
    if (s.has_frame) {
      const auto half_mu = [&](std::size_t n) { return T(0.5) * loaded(s.mu_S[n], i); };
      f = seen_in_frame(f, {half_mu(0), half_mu(1), half_mu(2)}, q);
    }
    set_rate(s, 0, i, f.w);
    set_rate(s, 1, i, f.x);
    set_rate(s, 2, i, f.y);
    set_rate(s, 3, i, f.z);
  }

  // F from Y, and Y from F: q at the rates of the g of the pass before, and the next g, so that
  // neither waits for the other; but no g after the last q.
  template <std::size_t numbers, std::size_t asked>
  [[gnu::always_inline]] static T pass(const GaussScheme& scheme, const RotorConstants& body,
                                       RotorStep& s) {
    for (std::size_t i = 0; i < filled; i += T::width) {
      attitude_rates(body, s, i);
      if constexpr (numbers == 7) momentum_rates(body, s, i);
    }
    return moved<0, numbers, asked>(scheme, s);
  }
  [[gnu::flatten]] static double sweep(const GaussScheme& scheme, const RotorConstants& body,
                                       RotorStep& s) {
    take_effects(s);
    for (std::size_t i = 0; i < filled; i += T::width) momentum_rates(body, s, i);
    const T dg = moved<4, 7>(scheme, s) * T(s.inverse_momentum);
    const T dq = s.passes > 1 ? pass<7, 4>(scheme, body, s) : pass<4, 4>(scheme, body, s);
    for (int k = 2; k < s.passes; ++k) pass<7, 0>(scheme, body, s);
    if (s.passes > 1) pass<4, 0>(scheme, body, s);
    return largest(select(dq <= dg, dg, dq));
  }

  // The sum of h b F with what each product and each sum loses: an increment that is rounded turns
  // the end of a long run by the integral of its error.
  [[gnu::flatten]] static void finish(RotorStep& s) {
    std::array<StageRow, 7> lost;
    for (std::size_t n = 0; n < 7; ++n)
      for (std::size_t i = 0; i < filled; i += T::width)
        store(product_error(loaded(s.hb, i), loaded(s.F[n], i)), lost[n], i);
    double low[7];
    for (std::size_t n = 0; n < 7; ++n) low[n] = s.carry[n];
    for (std::size_t j = 0; j < stages; ++j) {
      for (std::size_t n = 0; n < 7; ++n) {
        const TwoTerms<double> sum = two_sum(s.y[n], s.L[n][j]);
        s.y[n] = sum.hi;
        low[n] += sum.lo + lost[n][j];
      }
    }
    for (std::size_t n = 0; n < 7; ++n) {
      const double y = s.y[n] + low[n];
      s.carry[n] = (s.y[n] - y) + low[n];
      s.y[n] = y;
    }
  }

  [[gnu::flatten]] static void transform(const StageMatrix& matrix, std::size_t rows,
                                         const std::array<StageRow, 7>& from,
                                         std::array<StageRow, 7>& to) {
    for (std::size_t i = 0; i < filled_stages(rows); i += T::width) {
      T sum[7];
      product<0, 7>(matrix, from, i, sum);
      for (std::size_t n = 0; n < 7; ++n) store(sum[n], to[n], i);
    }
  }
};

template <InstructionSet isa>
RotorLanes rotor_kernels(std::size_t stages) {
  return dispatch_stage_count(stages, []<std::size_t s>() {
    using K = RotorKernel<isa, s>;
    return RotorLanes{&K::place, &K::measure, &K::sweep, &K::finish, &K::transform};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
