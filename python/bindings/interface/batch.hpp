// SPDX-License-Identifier: MIT
// Batch<S>: one state of a chart, or an array of states of any shape: what RotorState, AndoyerState
// and their like are in Python. The states lie one after the other, as C++ holds them, so that a
// conversion is a loop and a field is a strided NumPy view. Immutable; shares its memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "interface/arrays.hpp"

namespace polhode::python {

template <class S>
class Batch {
  static_assert(std::is_trivially_copyable_v<S> && std::is_trivially_destructible_v<S>);

 public:
  // States that live elsewhere, `stride` bytes apart, for as long as `owner` does.
  Batch(Shape shape, std::shared_ptr<const void> owner, const void* first, std::size_t stride)
      : shape_(std::move(shape)),
        owner_(std::move(owner)),
        first_(static_cast<const std::byte*>(first)),
        stride_(stride) {}

  // Room for states, to be filled by `fill(S* out)`.
  template <class Fill>
  static Batch filled(Shape shape, Fill fill) {
    const std::size_t n = size_of(shape);
    const std::shared_ptr<void> room = room_for(n * sizeof(S));
    fill(static_cast<S*>(room.get()));
    return Batch(std::move(shape), room, room.get(), sizeof(S));
  }
  static Batch one(const S& s) {
    return filled({}, [&](S* out) { *out = s; });
  }

  const Shape& shape() const { return shape_; }
  std::size_t size() const { return size_of(shape_); }
  std::size_t stride() const { return stride_; }
  const std::byte* first() const { return first_; }
  const std::shared_ptr<const void>& owner() const { return owner_; }

  const S& operator[](std::size_t k) const {
    return *reinterpret_cast<const S*>(first_ + k * stride_);
  }

 private:
  Shape shape_;
  std::shared_ptr<const void> owner_;
  const std::byte* first_;
  std::size_t stride_;
};

// f of every state: a batch of the same shape.
template <class S, class F>
auto mapped(const Batch<S>& states, F f, int threads = 1) {
  using To = std::decay_t<decltype(f(states[0]))>;
  return Batch<To>::filled(states.shape(), [&](To* out) {
    for_each(
        states.size(), [&](std::size_t k) { out[k] = f(states[k]); }, threads);
  });
}

// So many states of some 10 ns each are worth a thread.
constexpr std::size_t least_states = 8192;

// f(states, results) of many states at a time, which lie side by side: a batch of the same shape.
template <class To, class S, class F>
Batch<To> mapped_together(const Batch<S>& states, F f, int threads = 1) {
  const auto part = [&](To* out, std::size_t begin, std::size_t end) {
    if (states.stride() == sizeof(S)) {
      f(std::span(&states[begin], end - begin), std::span(out + begin, end - begin));
      return;
    }
    std::array<S, 256> some;
    for (std::size_t done = begin; done < end; done += some.size()) {
      const std::size_t count = std::min(some.size(), end - done);
      for (std::size_t k = 0; k < count; ++k) some[k] = states[done + k];
      f(std::span<const S>(some).first(count), std::span(out + done, count));
    }
  };
  return Batch<To>::filled(states.shape(), [&](To* out) {
    for_each_part(
        states.size(), [&](std::size_t begin, std::size_t end) { part(out, begin, end); }, threads,
        least_states);
  });
}

// f of every state: an array of the same shape with an inner shape; a float for one number.
template <class S, class F>
FloatArray mapped_numbers(const Batch<S>& states, std::initializer_list<std::size_t> inner, F f) {
  Result result(states.shape(), inner);
  for_each(states.size(), [&](std::size_t k) { put(result.at(k), f(states[k])); });
  return result.take();
}

// Where position k of the broadcast shape is in a batch of shape `own`.
class Lane {
 public:
  Lane(const Shape& own, const Shape& whole) : own_(own), whole_(whole) {
    kind_ = own == whole ? Kind::same : (size_of(own) == 1 ? Kind::one : Kind::some);
  }
  std::size_t operator()(std::size_t k) const {
    if (kind_ == Kind::same) return k;
    if (kind_ == Kind::one) return 0;
    std::size_t at = 0, step = 1;
    for (std::size_t i = 0; i < own_.size(); ++i) {  // from the last axis
      const std::size_t extent = own_[own_.size() - 1 - i], all = whole_[whole_.size() - 1 - i];
      if (extent != 1) at += step * (k % all);
      step *= extent;
      k /= all;
    }
    return at;
  }

 private:
  enum class Kind { same, one, some };
  Shape own_, whole_;
  Kind kind_;
};

// f(state, t) of states and times that broadcast: a batch, or an array with an inner shape.
template <class S, class F>
auto mapped(const Batch<S>& states, Numbers& t, F f, int threads = 1) {
  using To = std::decay_t<decltype(f(states[0], 0.0))>;
  const Shape shape = broadcast(states.shape(), t.shape(), "states", t.name());
  t.broadcast(shape);
  const Lane lane(states.shape(), shape);
  return Batch<To>::filled(shape, [&](To* out) {
    for_each(
        size_of(shape), [&](std::size_t k) { out[k] = f(states[lane(k)], t[k]); }, threads);
  });
}

template <class S, class F>
FloatArray mapped_numbers(const Batch<S>& states, Numbers& t,
                          std::initializer_list<std::size_t> inner, F f) {
  const Shape shape = broadcast(states.shape(), t.shape(), "states", t.name());
  t.broadcast(shape);
  const Lane lane(states.shape(), shape);
  Result result(shape, inner);
  for_each(size_of(shape), [&](std::size_t k) { put(result.at(k), f(states[lane(k)], t[k])); });
  return result.take();
}

// The same for functions of times alone.
template <class F>
auto mapped(const Numbers& t, F f, int threads = 1) {
  using To = std::decay_t<decltype(f(0.0))>;
  return Batch<To>::filled(t.shape(), [&](To* out) {
    for_each(
        size_of(t.shape()), [&](std::size_t k) { out[k] = f(t[k]); }, threads);
  });
}

template <class F>
FloatArray mapped_numbers(const Numbers& t, std::initializer_list<std::size_t> inner, F f) {
  Result result(t.shape(), inner);
  for_each(size_of(t.shape()), [&](std::size_t k) { put(result.at(k), f(t[k])); });
  return result.take();
}

}  // namespace polhode::python
