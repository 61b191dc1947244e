// SPDX-License-Identifier: MIT
// Many states together: those of an even grid of times, Sadov's variables and Serret's elements.
#include "charts/many_states.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "charts/states.hpp"
#include "polhode/error.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

constexpr std::size_t most_together = 64;

// Positions of a broadcast shape in lanes, block by block: together(k, count, out) of some, where
// it fails alone(k) of each, which says why; with the index of the first that it is.
template <class To, class Together, class Alone>
Batch<To> in_blocks(const Shape& shape, int threads, const Together& together, const Alone& alone) {
  const auto one = [&](std::size_t k) {
    try {
      return alone(k);
    } catch (const DomainError& e) {
      if (shape.empty()) throw;
      throw DomainError(e.what() + index_text(k, shape));
    }
  };
  const auto part = [&](To* out, std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += most_together) {
      const std::size_t count = std::min(most_together, end - first);
      try {
        together(first, std::span(out + first, count));
      } catch (const DomainError&) {
        for (std::size_t k = first; k < first + count; ++k) out[k] = one(k);
      }
    }
  };
  return Batch<To>::filled(shape, [&](To* out) {
    constexpr std::size_t least = 1024;  // of some 50 to 100 ns each
    for_each_part(
        size_of(shape), [&](std::size_t begin, std::size_t end) { part(out, begin, end); }, threads,
        least);
  });
}

// Some of many, side by side.
template <class From, class At>
auto gathered(std::size_t first, std::size_t count, const At& at) {
  std::array<From, most_together> some;
  for (std::size_t k = 0; k < count; ++k) some[k] = at(first + k);
  return some;
}

// What a state is does not depend on the time of its epoch.
Batch<SadovState> sadov_of_states(const Body& body, const Rotors& states, nb::handle t,
                                  int threads) {
  Numbers times(t, "t");
  const Shape shape = broadcast(states.shape(), times.shape(), "states", "t");
  times.broadcast(shape);
  const Lane lane(states.shape(), shape);
  const auto state = [&](std::size_t k) -> const RotorState& {
    if (!std::isfinite(times[k])) FreeRotation(body, states[lane(k)], times[k]);  // says so
    return states[lane(k)];
  };
  return in_blocks<SadovState>(
      shape, threads,
      [&](std::size_t first, std::span<SadovState> out) {
        const auto some = gathered<RotorState>(first, out.size(), state);
        to_sadov(body, std::span(some).first(out.size()), out);
      },
      [&](std::size_t k) { return to_sadov(body, state(k)); });
}

Batch<SerretState> serret_of_states(const Body& body, const Rotors& states, nb::handle t,
                                    int threads) {
  Numbers times(t, "t");
  const Shape shape = broadcast(states.shape(), times.shape(), "states", "t");
  times.broadcast(shape);
  const Lane lane(states.shape(), shape);
  const auto state = [&](std::size_t k) -> const RotorState& { return states[lane(k)]; };
  const auto time = [&](std::size_t k) { return times[k]; };
  return in_blocks<SerretState>(
      shape, threads,
      [&](std::size_t first, std::span<SerretState> out) {
        const auto some = gathered<RotorState>(first, out.size(), state);
        const auto at = gathered<double>(first, out.size(), time);
        to_serret(body, std::span(some).first(out.size()), std::span(at).first(out.size()), out);
      },
      [&](std::size_t k) { return to_serret(FreeRotation(body, state(k), time(k)), time(k)); });
}

Rotors rotors_of_sadov(const Body& body, const Batch<SadovState>& states, int threads) {
  const auto state = [&](std::size_t k) -> const SadovState& { return states[k]; };
  return in_blocks<RotorState>(
      states.shape(), threads,
      [&](std::size_t first, std::span<RotorState> out) {
        const auto some = gathered<SadovState>(first, out.size(), state);
        to_rotor(body, std::span(some).first(out.size()), out);
      },
      [&](std::size_t k) { return to_rotor(body, state(k)); });
}

Rotors rotors_of_serret(const Body& body, const Batch<SerretState>& states, nb::handle t,
                        int threads) {
  Numbers times(t, "t");
  const Shape shape = broadcast(states.shape(), times.shape(), "states", "t");
  times.broadcast(shape);
  const Lane lane(states.shape(), shape);
  const auto state = [&](std::size_t k) -> const SerretState& { return states[lane(k)]; };
  const auto time = [&](std::size_t k) { return times[k]; };
  return in_blocks<RotorState>(
      shape, threads,
      [&](std::size_t first, std::span<RotorState> out) {
        const auto some = gathered<SerretState>(first, out.size(), state);
        const auto at = gathered<double>(first, out.size(), time);
        to_rotor(body, std::span(some).first(out.size()), std::span(at).first(out.size()), out);
      },
      [&](std::size_t k) { return to_rotor(body, state(k), time(k)); });
}

}  // namespace

Rotors states_of_grid(const FreeRotation& f, double start, double step, std::int64_t count,
                      std::int64_t first, int threads) {
  for (const auto& [name, value] : {std::pair("count", count), std::pair("first", first)})
    if (value < 0)
      throw nb::value_error((std::string("at_grid: got ") + name + " = " + std::to_string(value) +
                             "; expected 0 or more")
                                .c_str());
  const auto n = static_cast<std::size_t>(count);
  return Rotors::filled({n}, [&](RotorState* states) {
    constexpr std::size_t least = 65536;  // 3.5 MiB: such parts go past the caches
    const auto some = [&](std::size_t begin, std::size_t end) {
      f.at(TimeGrid{start, step}, {states + begin, end - begin},
           static_cast<std::uint64_t>(first) + begin);
    };
    for_each_part(n, some, checked_threads(threads), least);
  });
}

void bind_to_sadov(nb::module_& m) {
  m.def(
      "to_sadov",
      [](const FreeRotation& motion, ArrayLike t, int threads) {
        const Numbers times(t, "t");
        return mapped(
            times, [&](double at) { return to_sadov(motion, at); }, checked_threads(threads));
      },
      "body"_a, "t"_a, nb::kw_only(), "threads"_a = 1,
      "Action-angle variables of a motion at time t, or of any states.");
  m.def(
      "to_sadov",
      [](const Body& body, const Rotors& states, ArrayLike t, int threads) {
        return sadov_of_states(body, states, t, checked_threads(threads));
      },
      "body"_a, "state"_a, "t"_a = 0.0, nb::kw_only(), "threads"_a = 1,
      "Action-angle variables of a motion at time t, or of any states.");
}

void bind_to_serret(nb::module_& m) {
  constexpr const char* doc =
      "Serret's elements of a motion at time t, or of states at times t of the motion through "
      "each.";
  m.def(
      "to_serret",
      [](const FreeRotation& motion, ArrayLike t, int threads) {
        const Numbers times(t, "t");
        return mapped(
            times, [&](double at) { return to_serret(motion, at); }, checked_threads(threads));
      },
      "body"_a, "t"_a, nb::kw_only(), "threads"_a = 1, doc);
  m.def(
      "to_serret",
      [](const Body& body, const Rotors& states, ArrayLike t, int threads) {
        return serret_of_states(body, states, t, checked_threads(threads));
      },
      "body"_a, "state"_a, "t"_a = 0.0, nb::kw_only(), "threads"_a = 1, doc);
}

void bind_rotor_of_serret(nb::module_& m) {
  m.def(
      "to_rotor",
      [](const Body& body, const Batch<SerretState>& states, ArrayLike t, int threads) {
        return rotors_of_serret(body, states, t, checked_threads(threads));
      },
      "body"_a, "state"_a, "t"_a, nb::kw_only(), "threads"_a = 1,
      "The hub state at time t of Serret's elements.");
}

void bind_rotor_of_sadov(nb::module_& m) {
  m.def(
      "to_rotor",
      [](const Body& body, const Batch<SadovState>& states, int threads) {
        return rotors_of_sadov(body, states, checked_threads(threads));
      },
      "body"_a, "state"_a, nb::kw_only(), "threads"_a = 1,
      "The hub state of action-angle variables. ValueError for actions outside the region.");
}

}  // namespace polhode::python
