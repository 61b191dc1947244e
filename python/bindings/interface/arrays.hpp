// SPDX-License-Identifier: MIT
// Numbers on their way in and out of Python: array-likes of any leading shape become doubles in C
// order, and results become NumPy arrays without a copy.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "interface/gil.hpp"
#include "interface/typed.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode::python {

using Shape = std::vector<std::size_t>;

std::size_t size_of(const Shape& shape);
// Whether it is `size`, of a shape from anywhere: the product may be beyond all numbers.
bool is_size_of(const Shape& shape, std::size_t size);
// As Python writes a tuple.
Typed<"tuple[int, ...]"> shape_tuple(const Shape& shape);
// "(3, 4)", as Python writes a tuple.
std::string text_of(const Shape& shape);

// An ndarray of doubles in C order. TypeError for what is not real (plain_number.hpp).
FloatArray real_array(nb::handle value, const char* name);

// Real numbers given as a Python number, a sequence or an array: leading shape x inner shape. An
// array of doubles in C order is read where it lies; everything else is converted once.
class Numbers {
 public:
  // `name` stands for the argument in messages. TypeError for what is not real, ValueError for
  // another inner shape.
  Numbers(nb::handle value, const char* name, std::initializer_list<std::size_t> inner = {});
  Numbers(Numbers&&) = default;  // not copied: it points into itself
  Numbers& operator=(Numbers&&) = default;

  // Leading shape: () for one number, one vector, one matrix.
  const Shape& shape() const { return shape_; }
  const char* name() const { return name_; }

  // The inner block at position k of the broadcast shape; after broadcast().
  const double* at(std::size_t k) const { return first_ + k * step_; }
  double operator[](std::size_t k) const { return *at(k); }

  // Makes at(k) run over `shape`, which the leading shape must broadcast to.
  void broadcast(const Shape& shape);

 private:
  void read(nb::handle array);
  bool read_number(nb::handle value);
  bool read_sequence(nb::handle value);

  const char* name_;
  Shape inner_;
  Shape shape_;
  std::vector<double> few_;  // what did not come as an array
  nb::object array_;         // keeps an array alive
  const double* first_ = nullptr;
  std::size_t step_ = 0;
};

// The shape that all of these broadcast to, by NumPy's rules; each is made to run over it.
Shape broadcast(std::span<Numbers> all);
// The same for shapes alone: `name_a`, `name_b` stand for them in the message.
Shape broadcast(const Shape& a, const Shape& b, const char* name_a, const char* name_b);

// One vector, quaternion (a scipy Rotation too) or matrix.
Vec3 vec3(nb::handle value, const char* name);
Quaternion quaternion(nb::handle value, const char* name);
Mat3 mat3(nb::handle value, const char* name);
double number(nb::handle value, const char* name);

// An object that keeps `memory` alive: the owner of arrays that look at it, and at nothing else.
nb::object keeper(std::shared_ptr<const void> memory);

// Room for results. The first touch of a page of 4 KiB costs as much as dozens of states, so large
// results ask for pages of 2 MiB, as NumPy does for its arrays.
std::shared_ptr<void> room_for(std::size_t bytes);

// Room for the result of a function, then a NumPy array that owns it. With shape () and inner ()
// a Python float.
class Result {
 public:
  Result(Shape shape, std::initializer_list<std::size_t> inner = {});
  double* at(std::size_t k) { return numbers_.get() + k * step_; }
  FloatArray take();

 private:
  Shape shape_;
  std::size_t step_ = 1;
  std::unique_ptr<double[]> numbers_;
};

FloatArray array_of(const Vec3& v);
FloatArray array_of(const Quaternion& q);
FloatArray array_of(const Mat3& m);
FloatArray array_of(const Matrix6& m);
FloatArray array_of(std::span<const double> row);

inline void put(double* out, const Vec3& v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}
inline void put(double* out, const Quaternion& q) {
  out[0] = q.w;
  out[1] = q.x;
  out[2] = q.y;
  out[3] = q.z;
}
void put(double* out, const Mat3& m);
void put(double* out, const Matrix6& m);
inline void put(double* out, double number) { *out = number; }
template <std::size_t N>
void put(double* out, const std::array<double, N>& numbers) {
  std::copy(numbers.begin(), numbers.end(), out);
}

// f(begin, end) for parts of 0 .. size, without the GIL where it is worth it, with a look at
// signals every few milliseconds whatever f costs: so that Ctrl-C ends a conversion of any length.
template <class F>
void for_each_part(std::size_t size, F f) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t few = 32;
  if (size <= few) {
    f(std::size_t{0}, size);
    return;
  }
  std::size_t chunk = 512;
  for (std::size_t begin = 0; begin < size;) {
    const std::size_t end = std::min(size, begin + chunk);
    const Clock::time_point start = Clock::now();
    {
      WithoutGil released;
      f(begin, end);
    }
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (Clock::now() - start < std::chrono::milliseconds(5)) chunk *= 2;
    begin = end;
  }
}

// The argument `threads` of a function: ValueError below 1.
int checked_threads(int threads);

// The same on so many threads: f runs on each of them, for parts of `least` items or more, and of
// what it throws the first in order passes through. Threads begin anew for each look at signals,
// which takes them some ten microseconds.
template <class F>
void for_each_part(std::size_t size, F f, int threads, std::size_t least = 64) {
  using Clock = std::chrono::steady_clock;
  if (threads == 1 || size <= least) return for_each_part(size, f);
  constexpr std::chrono::milliseconds often(20);
  std::size_t chunk = 2 * least * static_cast<std::size_t>(threads);
  for (std::size_t begin = 0; begin < size;) {
    const std::size_t end = std::min(size, begin + chunk);
    const Clock::time_point start = Clock::now();
    {
      WithoutGil released;
      ensemble::run_parts(end - begin, least, threads, [&](std::size_t first, std::size_t last) {
        f(begin + first, begin + last);
      });
    }
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    const Clock::duration taken = Clock::now() - start;
    if (taken < often / 4) chunk *= 2;
    if (taken < often) chunk *= 2;
    begin = end;
  }
}

// f(k) for every k.
template <class F>
void for_each(std::size_t size, F f) {
  for_each_part(size, [&f](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) f(k);
  });
}
template <class F>
void for_each(std::size_t size, F f, int threads) {
  const auto part = [&f](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) f(k);
  };
  for_each_part(size, part, threads);
}

}  // namespace polhode::python
