// SPDX-License-Identifier: MIT
// The law of a term at the stages of a step, or at those of several bodies, as many at a time as a
// register holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

#include "polhode/detail/math/pack.hpp"
#include "polhode/detail/perturb/stages.hpp"
#include "polhode/perturb/detail/rotate_inverse.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// How many numbers OfTime is made of.
template <class Law>
inline constexpr std::size_t numbers_of_time =
    std::is_empty_v<typename Law::template OfTime<double>>
        ? 0
        : sizeof(typename Law::template OfTime<double>) / sizeof(double);

// One row for each.
template <class Law>
using RowsOfTime = std::array<StageRow, numbers_of_time<Law>>;

// What a law is asked for and where it adds: rows of `count` numbers, a whole number of lanes, the
// next row `stride` behind the one before. Number i is of the body whose moments are in lane i %
// stage_lanes.
struct LawRows {
  std::size_t count;
  std::size_t stride;
  const double* of_time;
  const double* states;   // q_SB, g_B
  const double* moments;  // three rows of stage_lanes
  double* v;
  double* u;
};

// Compiled for a set of instructions where it is one of a processor's own.
template <InstructionSet isa, class Law>
[[gnu::flatten]] void law_on_stages(const Law& law, std::span<const double> sides,
                                    const LawRows& rows) {
  using T = Pack<isa>;
  using OfTime = typename Law::template OfTime<T>;
  constexpr std::size_t numbers = numbers_of_time<Law>;
  for (std::size_t i = 0; i < rows.count; i += T::width) {
    const auto state = [&](std::size_t n) {
      return T::loaded(rows.states + (n * rows.stride + i));
    };
    const auto moment = [&](std::size_t n) {
      return T::loaded(rows.moments + (n * stage_lanes + i % stage_lanes));
    };
    OfTime of_time;
    if constexpr (numbers > 0) {
      static_assert(sizeof(OfTime) == numbers * sizeof(T));
      T parts[numbers];
      for (std::size_t n = 0; n < numbers; ++n)
        parts[n] = T::loaded(rows.of_time + (n * rows.stride + i));
      std::memcpy(&of_time, parts, sizeof parts);
    }
    const BasicRotorState<T> s{{state(0), state(1), state(2), state(3)},
                               {state(4), state(5), state(6)}};
    const BasicPose<T> pose{{moment(0), moment(1), moment(2)}, s, sides};
    const BasicEffect<T> e = law.effect(of_time, pose);
    const auto add = [&](double* to, std::size_t n, const T& x) {
      double* at = to + (n * rows.stride + i);
      (T::loaded(at) + x).store(at);
    };
    if constexpr (Law::adds_rate) {
      add(rows.v, 0, e.v.x);
      add(rows.v, 1, e.v.y);
      add(rows.v, 2, e.v.z);
    }
    add(rows.u, 0, e.u.x);
    add(rows.u, 1, e.u.y);
    add(rows.u, 2, e.u.z);
  }
}

template <class Law>
using LawOnStages = void (*)(const Law&, std::span<const double> sides, const LawRows&);

// A law that gives its OfTime from the vectors of a TimewiseTogether term: law.of_vectors(vectors,
// in_S), in_S(x) the components of x along the reference frame.
template <class Law, std::size_t vectors>
concept LawOfVectors = requires(const Law& law, const std::array<Vec3, vectors>& x) {
  law.of_vectors(x, [](const Vec3& v) { return v; });
};

// Rows as in LawRows: the vectors; the attitude of the frame, null where there is nothing to turn;
// and what is made of them.
struct VectorsOfTime {
  std::size_t count;
  std::size_t stride;
  const double* vectors;
  const double* q_IS;
  double* of_time;
};

template <InstructionSet isa, class Law, std::size_t vectors>
[[gnu::flatten]] void vectors_on_stages(const Law& law, const VectorsOfTime& rows) {
  using T = Pack<isa>;
  constexpr std::size_t numbers = numbers_of_time<Law>;
  for (std::size_t i = 0; i < rows.count; i += T::width) {
    const auto loaded = [&](const double* from, std::size_t n) {
      return T::loaded(from + (n * rows.stride + i));
    };
    std::array<BasicVec3<T>, vectors> x;
    for (std::size_t k = 0; k < vectors; ++k)
      x[k] = {loaded(rows.vectors, 3 * k), loaded(rows.vectors, 3 * k + 1),
              loaded(rows.vectors, 3 * k + 2)};
    const auto store = [&](const auto& of_time) {
      static_assert(sizeof of_time == numbers * sizeof(T));
      T parts[numbers];
      std::memcpy(parts, &of_time, sizeof parts);
      for (std::size_t n = 0; n < numbers; ++n)
        parts[n].store(rows.of_time + (n * rows.stride + i));
    };
    if (rows.q_IS == nullptr) {
      store(law.of_vectors(x, [](const BasicVec3<T>& v) { return v; }));
    } else {
      const BasicQuaternion<T> q{loaded(rows.q_IS, 0), loaded(rows.q_IS, 1), loaded(rows.q_IS, 2),
                                 loaded(rows.q_IS, 3)};
      store(law.of_vectors(x, [&](const BasicVec3<T>& v) { return rotate_inverse(q, v); }));
    }
  }
}

template <class Law>
using VectorsOnStages = void (*)(const Law&, const VectorsOfTime&);

// Those of the library's own terms are compiled for every set (src/perturb/lanes).
template <class Law>
LawOnStages<Law> library_law(InstructionSet set);
template <class Law, std::size_t vectors>
VectorsOnStages<Law> library_law_of_vectors(InstructionSet set);
template <class Law>
concept LibraryLaw = requires { requires Law::in_library; };

template <class Law>
LawOnStages<Law> law_in_lanes(InstructionSet set) {
  if constexpr (LibraryLaw<Law>) {
    return library_law<Law>(set);
  } else {
    return &law_on_stages<InstructionSet::baseline, Law>;
  }
}

template <class Law, std::size_t vectors>
VectorsOnStages<Law> vectors_in_lanes(InstructionSet set) {
  if constexpr (LibraryLaw<Law>) {
    return library_law_of_vectors<Law, vectors>(set);
  } else {
    return &vectors_on_stages<InstructionSet::baseline, Law, vectors>;
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
