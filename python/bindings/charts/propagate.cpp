// SPDX-License-Identifier: MIT
// Free rotation of many bodies in one call: bodies, states and times that broadcast.
#include "charts/propagate.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "charts/states.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

struct Bodies {
  Shape shape;
  std::vector<Body> all;
};

// Nested lists of Body, of one shape.
class Walk {
 public:
  explicit Walk(Bodies& found) : found_(found) {}

  void operator()(nb::handle value) {
    if (nb::isinstance<Body>(value)) {
      if (index_.size() != found_.shape.size()) refuse("a ragged list", "lists of one length");
      found_.all.push_back(nb::cast<const Body&>(value));
      return;
    }
    const bool list = PyList_Check(value.ptr()) || PyTuple_Check(value.ptr());
    if (!list) refuse("a " + class_name(value), "a Body");
    const std::size_t depth = index_.size();
    if (found_.all.empty() && depth == found_.shape.size()) found_.shape.push_back(nb::len(value));
    if (depth >= found_.shape.size() || found_.shape[depth] != nb::len(value))
      refuse("a ragged list", "lists of one length");
    index_.push_back(0);
    for (const nb::handle item : value) {
      (*this)(item);
      ++index_.back();
    }
    index_.pop_back();
  }

 private:
  [[noreturn]] void refuse(const std::string& got, const char* expected) const {
    const std::string at = index_.empty() ? "" : " (at index " + text_of(index_) + ")";
    throw nb::type_error(("bodies: got " + got + "; expected " + expected + at).c_str());
  }

  Bodies& found_;
  Shape index_;
};

bool is_body_within(nb::handle value) {
  nb::object first = nb::borrow(value);
  while ((PyList_Check(first.ptr()) || PyTuple_Check(first.ptr())) && nb::len(first) > 0)
    first = nb::object(first[0]);
  return nb::isinstance<Body>(first);
}

Bodies bodies_of_moments(nb::handle value) {
  const Numbers moments(value, "bodies", {3});
  Bodies found{moments.shape(), {}};
  const std::size_t n = size_of(found.shape);
  found.all.reserve(n);
  for_each(n, [&](std::size_t k) {
    const double* const I = moments.at(k);
    try {
      found.all.emplace_back(I[0], I[1], I[2]);
    } catch (const DomainError& e) {
      if (found.shape.empty()) throw;
      throw DomainError(e.what() + index_text(k, found.shape));
    }
  });
  return found;
}

Bodies bodies_of(nb::handle value) {
  const bool has_objects = nb::hasattr(value, "tolist") && nb::hasattr(value, "dtype") &&
                           value.attr("dtype").equal(nb::str("O"));
  const nb::object items = has_objects ? nb::object(value.attr("tolist")()) : nb::borrow(value);
  if (!is_body_within(items)) {
    if (!nb::hasattr(items, "__len__") && !nb::hasattr(items, "__array__"))
      throw nb::type_error(("bodies: got a " + class_name(items) +
                            "; expected a Body, a sequence of them or moments (..., 3)")
                               .c_str());
    return bodies_of_moments(items);
  }
  Bodies found;
  Walk walk(found);
  walk(items);
  return found;
}

// Distances, in items, that one step along each axis of `whole` takes in an array of `own` shape;
// 0 along axes that it is repeated along.
std::vector<std::size_t> steps_of(const Shape& own, const Shape& whole) {
  std::vector<std::size_t> steps(whole.size(), 0);
  std::size_t step = 1;
  for (std::size_t i = own.size(); i-- > 0;) {
    if (own[i] != 1) steps[whole.size() - own.size() + i] = step;
    step *= own[i];
  }
  return steps;
}

// Where the motions' own axes and the axes of the times alone lie in the result: position
// (motion, time) is motions[motion] + times[time].
struct Grid {
  std::vector<std::size_t> motions, times;
};

Grid grid_of(const Shape& motions, const Shape& whole) {
  const std::vector<std::size_t> own = steps_of(motions, whole);
  const std::vector<std::size_t> all = steps_of(whole, whole);
  Grid grid{{0}, {0}};
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::vector<std::size_t>& axes = own[i] != 0 ? grid.motions : grid.times;
    const std::vector<std::size_t> before = std::move(axes);
    axes.clear();
    axes.reserve(before.size() * whole[i]);
    for (const std::size_t at : before)
      for (std::size_t k = 0; k < whole[i]; ++k) axes.push_back(at + k * all[i]);
  }
  return grid;
}

// Of one motion at a time: between two looks at signals.
constexpr std::size_t most_times = 512;

Rotors propagated(nb::handle bodies, const Rotors& states, nb::handle t, nb::handle t0,
                  bool short_arc) {
  const Bodies of = bodies_of(bodies);
  Numbers times(t, "t"), epochs(t0, "t0");
  const Shape pairs = broadcast(of.shape, states.shape(), "bodies", "states");
  const Shape motions = broadcast(pairs, epochs.shape(), "bodies and states", "t0");
  const Shape whole = broadcast(motions, times.shape(), "bodies and states", "t");
  epochs.broadcast(motions);
  times.broadcast(whole);
  const Lane body_at(of.shape, motions), state_at(states.shape(), motions);
  const Grid grid = grid_of(motions, whole);
  const auto prepared = [&](std::size_t k) {
    const Body& body = of.all[body_at(k)];
    const RotorState& s = states[state_at(k)];
    try {
      return short_arc ? FreeRotation::short_arc(body, s, epochs[k])
                       : FreeRotation(body, s, epochs[k]);
    } catch (const DomainError& e) {
      if (motions.empty()) throw;
      throw DomainError(e.what() + index_text(k, motions));
    }
  };
  return Rotors::filled(whole, [&](RotorState* out) {
    const std::size_t n = grid.times.size(), parts = (n + most_times - 1) / most_times;
    std::optional<FreeRotation> motion;
    std::vector<double> asked(std::min(n, most_times));
    std::vector<RotorState> found(asked.size());
    // all times of one motion, then the next
    for_each(grid.motions.size() * parts, [&](std::size_t k) {
      const std::size_t part = k % parts, first = part * most_times;
      const std::size_t count = std::min(most_times, n - first);
      if (part == 0) motion.emplace(prepared(k / parts));
      const auto place = [&](std::size_t i) {
        return grid.motions[k / parts] + grid.times[first + i];
      };
      for (std::size_t i = 0; i < count; ++i) asked[i] = times[place(i)];
      motion->at(std::span(asked).first(count), std::span(found).first(count));
      for (std::size_t i = 0; i < count; ++i) out[place(i)] = found[i];
    });
  });
}

}  // namespace

void bind_propagate(nb::module_& m) {
  m.def(
      "propagate",
      [](Typed<"Body | collections.abc.Sequence[Body] | numpy.typing.ArrayLike"> bodies,
         const Rotors& states, ArrayLike t, ArrayLike t0,
         bool short_arc) { return propagated(bodies, states, t, t0, short_arc); },
      "bodies"_a, "states"_a, "t"_a, "t0"_a = 0.0, nb::kw_only(), "short_arc"_a = false,
      R"(The exact torque-free motion of many bodies: their states at times t.

Parameters
----------
bodies : a Body, a sequence of Body (nested: more axes), or moments (..., 3).
states : RotorState, one or an array: at the times t0.
t, t0 : times (...).
short_arc : prepare in double precision throughout, as FreeRotation.short_arc: for a few turns.

The shapes of bodies, states, t0 and t broadcast, and are that of the result. Each item is, to the
last bit, FreeRotation(body, state, t0).at(t): a motion is prepared once for all of its times.
ValueError for what is no body or has a rate beyond double range, with its index. NaN for a time
that is not finite. Without the GIL; Ctrl-C ends it.)");
}

}  // namespace polhode::python
