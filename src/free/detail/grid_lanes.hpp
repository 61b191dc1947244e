// SPDX-License-Identifier: MIT
// One free arc on an even grid of times, as many states at a time as a register holds; compiled
// once for each set of instructions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "free/detail/lanes_declared.hpp"
#include "free/detail/state_lanes.hpp"
#include "math/line_stream.hpp"
#include "math/pack_functions.hpp"
#include "math/pack_rows.hpp"
#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/detail/free/states_on_grid.hpp"
#include "polhode/detail/math/pack.hpp"
#include "polhode/free/detail/phase_arithmetic.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// States 64 n, ..., 64 n + 63 of a grid share the angles that are reduced for the first of them.
inline constexpr std::size_t tile = 64;

template <InstructionSet isa>
BasicQuaternion<Pack<isa>> in_all_lanes(const Quaternion& q) {
  using T = Pack<isa>;
  return {T(q.w), T(q.x), T(q.y), T(q.z)};
}

// Time of the grid's state i since the epoch, in the kernel's units. `i` may be anything below
// 2^53.
template <class Arithmetic, Number T>
class ElapsedTime {
 public:
  ElapsedTime(const BasicFreeKernel<T>& k, const TimeGrid& grid)
      : step_(k.time_scale * T(grid.step)) {
    const TwoTerms<T> since = Arithmetic::sum(T(grid.start), T(-k.epoch));
    start_ = {k.time_scale * since.hi, k.time_scale * since.lo};
  }
  [[gnu::always_inline]] TwoTerms<T> since_start(const T& i) const {
    return Arithmetic::product(step_, i);
  }
  [[gnu::always_inline]] TwoTerms<T> operator()(const T& i) const {
    const TwoTerms<T> p = since_start(i), s = Arithmetic::sum(start_.hi, p.hi);
    return quick_two_sum(s.hi, T(s.lo + (start_.lo + p.lo)));
  }

 private:
  T step_;
  TwoTerms<T> start_;
};

// `first`, `first` + each, ... of a pack.
template <InstructionSet isa>
[[gnu::always_inline]] inline Pack<isa> indices_from(double first, double each) {
  Pack<isa> i(first);
  for (std::size_t j = 1; j < Pack<isa>::width; ++j)
    i.lanes[j] = first + each * static_cast<double>(j);
  return i;
}

// The numbers of a tile's states: attitude and momentum are sums of products of sines at the
// tile's start and sines of what has passed since, both phases apart.
template <InstructionSet isa, class Arithmetic>
class TrigonometricGrid {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t tiles = 16;  // that reduce their phases at a time

  TrigonometricGrid(const FreeKernel& kernel, const GridFrame& frame, const TimeGrid& grid)
      : k_(in_all_lanes<isa>(kernel)), time_(k_, grid) {
    turned_[0] = in_all_lanes<isa>(frame.now);
    turned_[1] = in_all_lanes<isa>(frame.quarter_turn_on);
    set_axes(kernel);
    const TwoPartPhase<T> zero{T(0.0), T(0.0)};
    for (std::size_t j = 0; j < tile; j += T::width) {
      const Phases p =
          phases(time_.since_start(indices_from<isa>(static_cast<double>(j), 1.0)), zero);
      p.x.sin.store(since_[0] + j);
      p.x.cos.store(since_[1] + j);
      p.turn.sin.store(since_[2] + j);
      p.turn.cos.store(since_[3] + j);
    }
  }

  // Phases of tiles `first`, ..., first + tiles - 1.
  [[gnu::flatten]] void start_tiles(std::uint64_t first) {
    for (std::size_t i = 0; i < tiles; i += T::width) {
      const T index = indices_from<isa>(static_cast<double>(tile) * static_cast<double>(first + i),
                                        static_cast<double>(tile));
      const Phases p = phases(time_(index), k_.phase0);
      p.x.sin.store(x_[0] + i);
      p.x.cos.store(x_[1] + i);
      const BasicQuaternion<T> along = combined(p.turn), across = quarter_on(p.turn);
      const T* const parts[] = {&along.w,  &along.x,  &along.y,  &along.z,
                                &across.w, &across.x, &across.y, &across.z};
      for (std::size_t j = 0; j < 8; ++j) parts[j]->store(frame_[j] + i);
    }
  }

  // States begin, ..., end - 1 of the tile that is `which` of those started, in whole packs: those
  // of lanes beyond are written too. In stages, as TrigonometricBlock.
  void write(std::size_t which, std::size_t begin, std::size_t end, double* to) {
    const std::size_t packs = (end - begin + T::width - 1) / T::width;
    switch (k_.series.terms) {
      case 1:
        sum_series<1>(which, begin, packs);
        break;
      case 2:
        sum_series<2>(which, begin, packs);
        break;
      case 3:
        sum_series<3>(which, begin, packs);
        break;
      case 4:
        sum_series<4>(which, begin, packs);
        break;
      default:
        sum_series<0>(which, begin, packs);
    }
    assemble(which, begin, packs, to);
  }

 private:
  struct Phases {
    SinCos<T> x, turn;
  };
  [[gnu::always_inline]] Phases phases(const TwoTerms<T>& elapsed,
                                       const TwoPartPhase<T>& phase0) const {
    const T& t = elapsed.hi;
    const TwoTerms<T> turn =
        bounded(phase_at<Arithmetic>(k_.half_precession, elapsed, TwoTerms<T>{T(0.0), T(0.0)}), t);
    const TwoTerms<T> x = bounded(phase_at<Arithmetic>(k_.phase_rate, elapsed, phase0), t);
    return {
        Arithmetic::sincos(reduced<Arithmetic>(x, k_.phase_period, k_.inverse_phase_period).rest),
        sincos_of_turn<Arithmetic>(turn)};
  }
  // left qz(turn) right, and the same a quarter of a turn of `turn` later.
  [[gnu::always_inline]] BasicQuaternion<T> combined(const SinCos<T>& t) const {
    const auto &a = turned_[0], &b = turned_[1];
    return {a.w * t.cos + b.w * t.sin, a.x * t.cos + b.x * t.sin, a.y * t.cos + b.y * t.sin,
            a.z * t.cos + b.z * t.sin};
  }
  [[gnu::always_inline]] BasicQuaternion<T> quarter_on(const SinCos<T>& t) const {
    return combined(SinCos<T>{t.cos, T(-t.sin)});
  }
  template <int terms>
  [[gnu::flatten]] void sum_series(std::size_t which, std::size_t begin, std::size_t packs) {
    const T sin0(x_[0][which]), cos0(x_[1][which]), G = k_.G;
    for (std::size_t n = 0; n < packs; ++n) {
      const T s = T::loaded(since_[0] + begin + n * T::width);
      const T c = T::loaded(since_[1] + begin + n * T::width);
      const T sin_x = sin0 * c + cos0 * s, cos_x = cos0 * c - sin0 * s;
      const T twice = sin_x + sin_x;
      const T y = T(1.0) - twice * sin_x;
      const SeriesValues<T> at_y = polynomials<terms>(y);
      const T w = at_y.A, x = sin_x * at_y.C, z = twice * cos_x * at_y.B, v = cos_x * at_y.D;
      const T ww = w * w + z * z, xx = x * x + v * v;
      p_[0][n] = x;
      p_[1][n] = v;
      p_[2][n] = z;
      w_[n] = w;
      const T inverse = T(1.0) / (ww + xx);
      const T scale = G * inverse;
      f_[n] = sqrt(inverse);
      scale_[n] = scale;
      along_[n] = scale * (ww - xx);
    }
  }
  template <int terms>
  [[gnu::always_inline]] SeriesValues<T> polynomials(const T& y) const {
    const CayleyKleinSeries<T>& s = k_.series;
    if constexpr (terms == 0) {
      return polynomials_at(s, y);
    } else {
      SeriesValues<T> r{s.A[terms - 1], s.B[terms - 1], s.C[terms - 1], s.D[terms - 1]};
#pragma GCC unroll 8
      for (int j = terms - 2; j >= 0; --j) {
        const auto i = static_cast<std::size_t>(j);
        r = {r.A * y + s.A[i], r.B * y + s.B[i], r.C * y + s.C[i], r.D * y + s.D[i]};
      }
      return r;
    }
  }
  [[gnu::flatten]] void assemble(std::size_t which, std::size_t begin, std::size_t packs,
                                 double* to) {
    T f[8];
    for (std::size_t j = 0; j < 8; ++j) f[j] = T(frame_[j][which]);
    const T flip0 = flip_[0], flip1 = flip_[1], flip2 = flip_[2];
    for (std::size_t n = 0; n < packs; ++n) {
      const std::size_t i = begin + n * T::width;
      const T ts = T::loaded(since_[2] + i) * f_[n], tc = T::loaded(since_[3] + i) * f_[n];
      const BasicQuaternion<T> m{f[0] * tc + f[4] * ts, f[1] * tc + f[5] * ts,
                                 f[2] * tc + f[6] * ts, f[3] * tc + f[7] * ts};
      const BasicQuaternion<T> q =
          m * BasicQuaternion<T>{w_[n], flip0 * p_[from_[0]][n], flip1 * p_[from_[1]][n],
                                 flip2 * p_[from_[2]][n]};
      const T w = w_[n], x = p_[0][n], y = p_[1][n], z = p_[2][n];
      const T twice = scale_[n] + scale_[n];
      g_[0] = twice * (x * z - w * y);
      g_[1] = twice * (y * z + w * x);
      g_[2] = along_[n];
      store_rows<7, isa>(
          {q.w, q.x, q.y, q.z, flip0 * g_[from_[0]], flip1 * g_[from_[1]], flip2 * g_[from_[2]]},
          to + 7 * n * T::width);
    }
  }
  void set_axes(const FreeKernel& kernel) {
    const auto& order = kernel.to_body;
    for (std::size_t i = 0; i < 3; ++i) {
      from_[i] = order.first[i] ? 0 : order.second[i] ? 1 : 2;
      flip_[i] = T(order.sign[static_cast<int>(i)]);
    }
  }

  BasicFreeKernel<T> k_;
  ElapsedTime<Arithmetic, T> time_;
  BasicQuaternion<T> turned_[2];
  static constexpr std::size_t packs_ = tile / T::width + 1;
  T p_[3][packs_], w_[packs_], scale_[packs_], along_[packs_], f_[packs_], g_[3];
  T flip_[3];
  std::size_t from_[3];
  // room for the lanes of a pack that begins in the tile's last states
  alignas(64) double since_[4][tile + T::width]{};
  alignas(64) double x_[2][tiles];
  alignas(64) double frame_[8][tiles];
};

// The exponential of lanes in place of a call for each.
struct LaneExp {
  template <InstructionSet isa>
  [[gnu::always_inline]] Pack<isa> operator()(const Pack<isa>& x) const {
    return exp_of_negative(x);
  }
};
template <class Base>
struct GridArithmetic : Base {
  using Exp = LaneExp;
};

// Any form: each state's own phases.
template <InstructionSet isa, class Arithmetic>
class AnyGrid {
 public:
  using T = Pack<isa>;
  static constexpr std::size_t tiles = 16;

  AnyGrid(const FreeKernel& kernel, const TimeGrid& grid)
      : k_(in_all_lanes<isa>(kernel)), time_(k_, grid) {}
  void start_tiles(std::uint64_t first) { first_ = first; }
  [[gnu::flatten]] void write(std::size_t which, std::size_t begin, std::size_t end, double* to) {
    const double first = static_cast<double>(tile) * static_cast<double>(first_ + which);
    for (std::size_t i = begin; i < end; i += T::width) {
      const TwoTerms<T> elapsed = time_(indices_from<isa>(first + static_cast<double>(i), 1.0));
      const BasicRotorState<T> s = state_after<Arithmetic>(k_, elapsed, elapsed.hi);
      store_rows<7, isa>({s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z}, to + 7 * (i - begin));
    }
  }

 private:
  BasicFreeKernel<T> k_;
  ElapsedTime<Arithmetic, T> time_;
  std::uint64_t first_ = 0;
};

// States first, ..., first + count - 1 by a Grid of this kernel.
template <class Grid>
void write_grid(Grid grid, std::uint64_t first, std::size_t count, RotorState* states) {
  static_assert(sizeof(RotorState) == 7 * sizeof(double));
  constexpr std::size_t width = Grid::T::width;
  LineStream<Grid::T::set> to(reinterpret_cast<double*>(states), 7 * count);
  alignas(64) double rows[7 * (tile + width)];
  std::uint64_t started = 0;
  for (std::size_t done = 0; done < count;) {
    const std::uint64_t now = (first + done) / tile;
    if (done == 0 || now == started + Grid::tiles) grid.start_tiles(started = now);
    const std::size_t begin = (first + done) % tile, end = std::min(tile, begin + (count - done));
    const auto which = static_cast<std::size_t>(now - started);
    const std::size_t whole_packs = (end - begin + width - 1) / width * width;
    if (to.is_direct() && whole_packs <= count - done && begin + whole_packs <= tile) {
      grid.write(which, begin, end, to.place());
      to.skip(7 * (end - begin));
    } else {
      grid.write(which, begin, end, rows);
      to.put(rows, 7 * (end - begin));
    }
    done += end - begin;
  }
  to.finish();
}

// Instantiated in a source of its own for each set.
template <InstructionSet isa>
void grid_in_lanes(const FreeKernel& kernel, const GridFrame& frame, const TimeGrid& grid,
                   std::uint64_t first, std::size_t count, RotorState* states) {
  using Arithmetic =
      std::conditional_t<isa == InstructionSet::baseline, DekkerArithmetic, FmaArithmetic>;
  if (kernel.steady || kernel.series.hyperbolic)
    return write_grid(AnyGrid<isa, GridArithmetic<Arithmetic>>(kernel, grid), first, count, states);
  write_grid(TrigonometricGrid<isa, Arithmetic>(kernel, frame, grid), first, count, states);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
