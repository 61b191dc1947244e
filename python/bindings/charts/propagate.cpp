// SPDX-License-Identifier: MIT
// Free rotation of many bodies in one call: bodies, states and times that broadcast.
#include "charts/propagate.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "charts/states.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/propagate.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

// Objects, or moments of bodies that are yet to be made.
struct Bodies {
  Shape shape;
  std::vector<Body> all = {};
  std::optional<Numbers> moments = {};

  Body operator[](std::size_t k) const {
    if (!moments) return all[k];
    const double* const I = moments->at(k);
    return Body(I[0], I[1], I[2]);
  }
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

// What an array of objects holds, as lists.
nb::object listed(nb::handle value) {
  const bool has_objects = nb::hasattr(value, "tolist") && nb::hasattr(value, "dtype") &&
                           value.attr("dtype").equal(nb::str("O"));
  return has_objects ? nb::object(value.attr("tolist")()) : nb::borrow(value);
}

Numbers moments_of(nb::handle items) {
  if (!nb::hasattr(items, "__len__") && !nb::hasattr(items, "__array__"))
    throw nb::type_error(("bodies: got a " + class_name(items) +
                          "; expected a Body, a sequence of them or moments (..., 3)")
                             .c_str());
  return Numbers(items, "bodies", {3});
}

Bodies bodies_of(nb::handle items) {
  Bodies found;
  if (is_body_within(items)) {
    Walk walk(found);
    walk(items);
    return found;
  }
  found.moments = moments_of(items);
  found.shape = found.moments->shape();
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

// The bodies of one call that failed, gathered from its threads.
class Failures {
 public:
  void add(std::vector<FailedBody> some, std::size_t offset) {
    if (some.empty()) return;
    const std::scoped_lock lock(mutex_);
    for (FailedBody& one : some) all_.push_back({offset + one.index, std::move(one.reason)});
  }

  // One state fails as an error; of an array `errors` has the reasons, or a warning the first.
  void report(const Shape& shape, nb::handle errors) {
    std::sort(all_.begin(), all_.end(),
              [](const FailedBody& a, const FailedBody& b) { return a.index < b.index; });
    if (!all_.empty() && shape.empty()) throw DomainError(all_[0].reason);
    if (!errors.is_none()) return fill(errors);
    if (all_.empty()) return;
    const std::string text =
        "propagate: " + std::to_string(all_.size()) + " of " + std::to_string(size_of(shape)) +
        " states are NaN; the first: " + all_[0].reason + index_text(all_[0].index, shape);
    constexpr Py_ssize_t caller = 2;  // of the wrapper (python/polhode/_signatures.py)
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), caller) != 0) throw nb::python_error();
  }

  static void require(nb::handle errors, const Shape& shape) {
    if (errors.is_none()) return;
    const bool objects = nb::hasattr(errors, "dtype") && nb::hasattr(errors, "shape") &&
                         errors.attr("dtype").equal(nb::str("O"));
    if (!objects)
      throw nb::type_error(("errors: got a " + class_name(errors) +
                            "; expected an array of objects, numpy.empty(shape, object)")
                               .c_str());
    const nb::object got = errors.attr("shape"), expected = shape_tuple(shape);
    const auto text = [](const nb::object& x) { return nb::cast<std::string>(nb::repr(x)); };
    if (!got.equal(expected))
      throw nb::value_error(
          ("errors: got shape " + text(got) + "; expected that of the result, " + text(expected))
              .c_str());
  }

 private:
  void fill(nb::handle errors) const {
    errors.attr("fill")(nb::none());
    const nb::object flat = errors.attr("flat");
    for (const FailedBody& one : all_)
      flat.attr("__setitem__")(one.index, nb::str(one.reason.c_str()));
  }

  std::mutex mutex_;
  std::vector<FailedBody> all_;
};

constexpr RotorState nowhere = [] {
  constexpr double x = std::numeric_limits<double>::quiet_NaN();
  return RotorState{{x, x, x, x}, {x, x, x}};
}();

// Of one motion at a time: between two looks at signals.
constexpr std::size_t most_times = 512;

Rotors propagated_as_short_arcs(const Bodies& of, const Rotors& states, Numbers times,
                                Numbers epochs, int threads, Failures& failures) {
  const Shape pairs = broadcast(of.shape, states.shape(), "bodies", "states");
  const Shape motions = broadcast(pairs, epochs.shape(), "bodies and states", "t0");
  const Shape whole = broadcast(motions, times.shape(), "bodies and states", "t");
  epochs.broadcast(motions);
  times.broadcast(whole);
  const Lane body_at(of.shape, motions), state_at(states.shape(), motions);
  const Grid grid = grid_of(motions, whole);
  const auto prepared = [&](std::size_t k) {
    return FreeRotation::short_arc(of[body_at(k)], states[state_at(k)], epochs[k]);
  };
  return Rotors::filled(whole, [&](RotorState* out) {
    const std::size_t n = grid.times.size(), parts = (n + most_times - 1) / most_times;
    // all times of one motion, then the next
    const auto some = [&](std::size_t begin, std::size_t end) {
      std::optional<FreeRotation> motion;
      std::vector<double> asked(std::min(n, most_times));
      std::vector<RotorState> found(asked.size());
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t part = k % parts, first = part * most_times;
        const std::size_t count = std::min(most_times, n - first);
        const auto place = [&](std::size_t i) {
          return grid.motions[k / parts] + grid.times[first + i];
        };
        try {
          if (part == 0 || k == begin || !motion) motion.emplace(prepared(k / parts));
        } catch (const DomainError& e) {
          motion.reset();
          std::vector<FailedBody> failed;
          for (std::size_t i = 0; i < count; ++i) {
            out[place(i)] = nowhere;
            failed.push_back({place(i), e.what()});
          }
          failures.add(std::move(failed), 0);
          continue;
        }
        for (std::size_t i = 0; i < count; ++i) asked[i] = times[place(i)];
        motion->at(std::span(asked).first(count), std::span(found).first(count));
        for (std::size_t i = 0; i < count; ++i) out[place(i)] = found[i];
      }
    };
    for_each_part(grid.motions.size() * parts, some, threads);
  });
}

// Items of so many numbers in an array of a shape of its own, and where those of the result are.
class Rows {
 public:
  Rows(const void* first, std::size_t stride, std::size_t width, const Shape& own,
       const Shape& whole)
      : first_(static_cast<const double*>(first)),
        step_(stride / sizeof(double)),
        width_(width),
        lane_(own, whole),
        one_(size_of(own) == 1),
        direct_(one_ || own == whole) {}

  // Those of positions begin .. end: where they lie, or copied to `copies`.
  NumberRows part(std::size_t begin, std::size_t end, std::vector<double>& copies) const {
    if (one_) return {first_, 0};
    if (direct_) return {first_ + begin * step_, step_};
    copies.resize((end - begin) * width_);
    for (std::size_t k = begin; k < end; ++k)
      std::copy_n(first_ + lane_(k) * step_, width_, &copies[(k - begin) * width_]);
    return {copies.data(), width_};
  }

 private:
  const double* first_;
  std::size_t step_, width_;
  Lane lane_;
  bool one_, direct_;
};

Rows rows_of(Numbers& numbers, std::size_t width, const Shape& whole) {
  const Shape own = numbers.shape();
  numbers.broadcast(own);
  return Rows(numbers.at(0), width * sizeof(double), width, own, whole);
}

// So many bodies of some 60 ns each are worth a thread.
constexpr std::size_t least_bodies = 1024;

Rotors propagated(const Rows& moments, const Rows& at_epochs, const Rows& times, const Rows& epochs,
                  const Shape& whole, int threads, Failures& failures) {
  return Rotors::filled(whole, [&](RotorState* out) {
    const auto some = [&](std::size_t begin, std::size_t end) {
      std::vector<double> copies[4];
      const BodyRows rows{moments.part(begin, end, copies[0]),
                          at_epochs.part(begin, end, copies[1]), times.part(begin, end, copies[2]),
                          epochs.part(begin, end, copies[3])};
      failures.add(propagate(rows, {out + begin, end - begin}), begin);
    };
    for_each_part(size_of(whole), some, threads, least_bodies);
  });
}

Rotors propagated(nb::handle bodies, const Rotors& states, nb::handle t, nb::handle t0,
                  bool short_arc, int threads, nb::handle errors) {
  Numbers times(t, "t"), epochs(t0, "t0");
  Bodies of = bodies_of(listed(bodies));
  const Shape pairs = broadcast(of.shape, states.shape(), "bodies", "states");
  const Shape motions = broadcast(pairs, epochs.shape(), "bodies and states", "t0");
  const Shape whole = broadcast(motions, times.shape(), "bodies and states", "t");
  Failures::require(errors, whole);
  Failures failures;
  const auto reported = [&](Rotors found) {
    failures.report(whole, errors);
    return found;
  };
  if (short_arc)
    return reported(propagated_as_short_arcs(of, states, std::move(times), std::move(epochs),
                                             threads, failures));
  if (size_of(whole) == 0) return Rotors::filled(whole, [](RotorState*) {});
  const Rows of_states(states.first(), states.stride(), 7, states.shape(), whole);
  const Rows of_moments = of.moments
                              ? rows_of(*of.moments, 3, whole)
                              : Rows(&of.all[0].moments().x, sizeof(Body), 3, of.shape, whole);
  return reported(propagated(of_moments, of_states, rows_of(times, 1, whole),
                             rows_of(epochs, 1, whole), whole, threads, failures));
}

}  // namespace

void bind_propagate(nb::module_& m) {
  m.def(
      "propagate",
      [](Typed<"Body | collections.abc.Sequence[Body] | numpy.typing.ArrayLike"> bodies,
         const Rotors& states, ArrayLike t, ArrayLike t0, bool short_arc, int threads,
         Typed<"numpy.ndarray | None"> errors) {
        return propagated(bodies, states, t, t0, short_arc, checked_threads(threads), errors);
      },
      "bodies"_a, "states"_a, "t"_a, "t0"_a = 0.0, nb::kw_only(), "short_arc"_a = false,
      "threads"_a = 1, "errors"_a = nb::none(),
      R"(The exact torque-free motion of many bodies: their states at times t.

Parameters
----------
bodies : a Body, a sequence of Body (nested: more axes), or moments (..., 3).
states : RotorState, one or an array: at the times t0.
t, t0 : times (...).
short_arc : one by one, to the last bit FreeRotation.short_arc: for a few turns.
threads : how many parts at a time, from 1: as many processors. No bit depends on it.
errors : an array of objects of the result's shape, to be filled with the reason why a state is
    NaN, or None.

Returns
-------
RotorState, of the shape to which bodies, states, t0 and t broadcast. A body that fails, because its
moments are no body's or its rate is beyond double range, is NaN, and the others are computed: a
RuntimeWarning names the first, unless `errors` is given. So is the state at a time that is not
finite, without a warning.

Raises
------
ValueError if the only state of the call fails, or for shapes that do not broadcast.

Notes
-----
Bodies are computed in SIMD, about fifty times as fast as FreeRotation(body, state, t0).at(t), from
which a state may differ in its last digits: it is within 4e-15 rad of the exact attitude. It
depends on its own body, state, t0 and t alone. For one body at very many times FreeRotation is
faster. The GIL is released; Ctrl-C ends the call.)");
}

}  // namespace polhode::python
