// SPDX-License-Identifier: MIT
// Sums over the stages of a step by collocation, for any numbers: the stages as lanes. Compiled
// once for each set of instructions.
#pragma once

#include "dynamics/collocation/gauss_scheme.hpp"
#include "dynamics/collocation/lanes/dispatch_stage_count.hpp"
#include "dynamics/collocation/lanes/product_error.hpp"
#include "polhode/detail/math/pack.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

template <InstructionSet isa, std::size_t stages>
struct NumberKernel {
  using T = Pack<isa>;
  static constexpr std::size_t filled = filled_stages(stages);

  [[gnu::always_inline]] static T loaded(const StageRow& row, std::size_t i) {
    return T::loaded(row.data() + i);
  }
  [[gnu::always_inline]] static void store(const T& x, StageRow& row, std::size_t i) {
    x.store(row.data() + i);
  }

  // `body` of as many numbers at a time as keep the registers busy.
  template <class Body>
  [[gnu::always_inline]] static void in_blocks(std::size_t first, std::size_t last,
                                               const Body& body) {
    std::size_t n = first;
    for (; n + 6 <= last; n += 6) body.template operator()<6>(n);
    for (; n + 3 <= last; n += 3) body.template operator()<3>(n);
    for (; n < last; ++n) body.template operator()<1>(n);
  }

  // Rows i, i + 1, ... of matrix * from. In two sums, of half the length: what follows waits.
  template <std::size_t numbers>
  [[gnu::always_inline]] static void product(const StageMatrix& matrix, const StageRow* from,
                                             std::size_t i, T* sum) {
    T odd[numbers];
    for (std::size_t n = 0; n < numbers; ++n) {
      sum[n] = loaded(matrix[0], i) * T(from[n][0]);
      odd[n] = loaded(matrix[1], i) * T(from[n][1]);
    }
    for (std::size_t j = 2; j < stages; j += 2) {
      const T column = loaded(matrix[j], i), next = loaded(matrix[j + 1], i);
      for (std::size_t n = 0; n < numbers; ++n) {
        sum[n] = sum[n] + column * T(from[n][j]);
        odd[n] = odd[n] + next * T(from[n][j + 1]);
      }
    }
    for (std::size_t n = 0; n < numbers; ++n) sum[n] = sum[n] + odd[n];
  }

  template <std::size_t numbers>
  [[gnu::always_inline]] static void moved(const GaussScheme& scheme, const StageRow& hb,
                                           NumberStep& s, std::size_t first, double* changes) {
    for (std::size_t i = 0; i < filled; i += T::width)
      for (std::size_t n = first; n < first + numbers; ++n)
        store(loaded(hb, i) * loaded(s.F[n], i), s.L[n], i);
    T change[numbers];
    for (std::size_t n = 0; n < numbers; ++n) change[n] = T(0.0);
    for (std::size_t i = 0; i < filled; i += T::width) {
      T sum[numbers];
      product<numbers>(scheme.mu, s.L.data() + first, i, sum);
      for (std::size_t n = 0; n < numbers; ++n) {
        const T next = T(s.y[first + n]) + (sum[n] + T(s.carry[first + n]));
        const T by = abs(next - loaded(s.Y[first + n], i));
        // a NaN of any rate is one of all stages
        change[n] = select(by <= change[n], change[n], by);
        store(next, s.Y[first + n], i);
      }
    }
    for (std::size_t n = 0; n < numbers; ++n) {
      double r = change[n].lanes[0];
      for (std::size_t i = 1; i < T::width; ++i)
        r = change[n].lanes[i] <= r ? r : change[n].lanes[i];
      changes[first + n] = r;
    }
  }
  [[gnu::flatten]] static void move(const GaussScheme& scheme, const StageRow& hb, NumberStep& s,
                                    std::size_t first, std::size_t last, double* changes) {
    in_blocks(first, last, [&]<std::size_t numbers>(std::size_t n) {
      moved<numbers>(scheme, hb, s, n, changes);
    });
  }

  [[gnu::flatten]] static void multiply(const StageJacobian& A, NumberStep& s, std::size_t columns,
                                        std::size_t from, std::size_t to) {
    for (std::size_t column = 0; column < columns; ++column) {
      const auto place = [&](std::size_t n) { return n * columns + column; };
      for (std::size_t i = 0; i < filled; i += T::width) {
        T y[7];
        for (std::size_t n = 0; n < 7; ++n) y[n] = loaded(s.Y[place(n)], i);
        for (std::size_t r = from; r < to; ++r) {
          T even = loaded(A[r][0], i) * y[0], odd = loaded(A[r][1], i) * y[1];
          for (std::size_t n = 2; n < 6; n += 2) {
            even = even + loaded(A[r][n], i) * y[n];
            odd = odd + loaded(A[r][n + 1], i) * y[n + 1];
          }
          store((even + loaded(A[r][6], i) * y[6]) + odd, s.F[place(r)], i);
        }
      }
    }
  }

  // The sum of h b F with what each product and each sum loses.
  template <std::size_t numbers>
  [[gnu::always_inline]] static void summed(const StageRow& hb, NumberStep& s, std::size_t first) {
    StageRow lost[numbers];
    double low[numbers];
    for (std::size_t n = 0; n < numbers; ++n) {
      low[n] = s.carry[first + n];
      for (std::size_t i = 0; i < filled; i += T::width) {
        store(product_error(loaded(hb, i), loaded(s.F[first + n], i)), lost[n], i);
      }
    }
    for (std::size_t j = 0; j < stages; ++j)
      for (std::size_t n = 0; n < numbers; ++n) {
        const TwoTerms<double> sum = two_sum(s.y[first + n], s.L[first + n][j]);
        s.y[first + n] = sum.hi;
        low[n] += sum.lo + lost[n][j];
      }
    for (std::size_t n = 0; n < numbers; ++n) {
      const double y = s.y[first + n] + low[n];
      s.carry[first + n] = (s.y[first + n] - y) + low[n];
      s.y[first + n] = y;
    }
  }
  [[gnu::flatten]] static void finish(const StageRow& hb, NumberStep& s) {
    in_blocks(0, s.y.size(),
              [&]<std::size_t numbers>(std::size_t n) { summed<numbers>(hb, s, n); });
  }

  [[gnu::flatten]] static void transform(const StageMatrix& matrix, std::size_t rows,
                                         const StageRow* from, std::size_t count, StageRow* to) {
    in_blocks(0, count, [&]<std::size_t numbers>(std::size_t first) {
      for (std::size_t i = 0; i < filled_stages(rows); i += T::width) {
        T sum[numbers];
        product<numbers>(matrix, from + first, i, sum);
        for (std::size_t n = 0; n < numbers; ++n) store(sum[n], to[first + n], i);
      }
    });
  }
};

template <InstructionSet isa>
NumberLanes number_kernels(std::size_t stages) {
  return dispatch_stage_count(stages, []<std::size_t s>() {
    using K = NumberKernel<isa, s>;
    return NumberLanes{&K::move, &K::multiply, &K::finish, &K::transform};
  });
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
