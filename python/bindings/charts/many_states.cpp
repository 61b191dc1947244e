// SPDX-License-Identifier: MIT
// Many states together: those of an even grid of times, and Sadov's variables.
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

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

// Of states in the lanes of the processor: what a state is does not depend on the time of its
// epoch.
Batch<SadovState> sadov_of_states(const Body& body, const Rotors& states, nb::handle t) {
  Numbers times(t, "t");
  const Shape shape = broadcast(states.shape(), times.shape(), "states", "t");
  times.broadcast(shape);
  const Lane lane(states.shape(), shape);
  const auto require_time = [&](std::size_t k) {
    if (!std::isfinite(times[k])) FreeRotation(body, states[lane(k)], times[k]);  // says so
  };
  const auto one = [&](std::size_t k) {
    try {
      require_time(k);
      return to_sadov(body, states[lane(k)]);
    } catch (const DomainError& e) {
      if (shape.empty()) throw;
      throw DomainError(e.what() + index_text(k, shape));
    }
  };
  return Batch<SadovState>::filled(shape, [&](SadovState* out) {
    for_each_part(size_of(shape), [&](std::size_t begin, std::size_t end) {
      std::array<RotorState, 64> some;
      for (std::size_t first = begin; first < end; first += some.size()) {
        const std::size_t count = std::min(some.size(), end - first);
        try {
          for (std::size_t k = 0; k < count; ++k) {
            require_time(first + k);
            some[k] = states[lane(first + k)];
          }
          to_sadov(body, std::span<const RotorState>(some).first(count), {out + first, count});
        } catch (const DomainError&) {  // with the index of the one that it is
          for (std::size_t k = 0; k < count; ++k) out[first + k] = one(first + k);
        }
      }
    });
  });
}

}  // namespace

Rotors states_of_grid(const FreeRotation& f, double start, double step, std::int64_t count,
                      std::int64_t first) {
  for (const auto& [name, value] : {std::pair("count", count), std::pair("first", first)})
    if (value < 0)
      throw nb::value_error((std::string("at_grid: got ") + name + " = " + std::to_string(value) +
                             "; expected 0 or more")
                                .c_str());
  const auto n = static_cast<std::size_t>(count);
  return Rotors::filled({n}, [&](RotorState* states) {
    for_each_part(n, [&](std::size_t begin, std::size_t end) {
      f.at(TimeGrid{start, step}, {states + begin, end - begin},
           static_cast<std::uint64_t>(first) + begin);
    });
  });
}

void bind_to_sadov(nb::module_& m) {
  m.def(
      "to_sadov",
      [](const FreeRotation& motion, ArrayLike t) {
        const Numbers times(t, "t");
        return mapped(times, [&](double at) { return to_sadov(motion, at); });
      },
      "motion"_a, "t"_a, "Action-angle variables of a motion at time t, or of any states.");
  m.def(
      "to_sadov",
      [](const Body& body, const Rotors& states, ArrayLike t) {
        return sadov_of_states(body, states, t);
      },
      "body"_a, "state"_a, "t"_a = 0.0,
      "Action-angle variables of a motion at time t, or of any states.");
}

}  // namespace polhode::python
