// SPDX-License-Identifier: MIT
#include "interface/arrays.hpp"

#include <nanobind/ndarray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <utility>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace polhode::python {

namespace {

using Array = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

std::size_t product(std::span<const std::size_t> shape) {
  std::size_t n = 1;
  for (const std::size_t extent : shape) n *= extent;
  return n;
}

// "(..., 3, 3)"
std::string expected_shape(const Shape& inner) {
  std::string text = "(...";
  for (const std::size_t extent : inner) text += ", " + std::to_string(extent);
  return text + ")";
}

nb::object numpy(const char* function) { return nb::module_::import_("numpy").attr(function); }

nb::object array_that_owns(std::unique_ptr<double[]> numbers, const Shape& shape) {
  double* data = numbers.get();
  nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<double*>(p); });
  numbers.release();
  return nb::cast(nb::ndarray<nb::numpy, double>(data, shape.size(), shape.data(), owner));
}

template <class V>
nb::object small_array(const V& value, std::initializer_list<std::size_t> shape) {
  Result result({}, shape);
  put(result.at(0), value);
  return result.take();
}

// A scipy Rotation has the scalar last.
nb::object scalar_first(nb::handle rotation) {
  return numpy("roll")(rotation.attr("as_quat")(), 1, "axis"_a = -1);
}

}  // namespace

std::size_t size_of(const Shape& shape) { return product(shape); }

int checked_threads(int threads) {
  if (threads < 1)
    throw nb::value_error(
        ("threads: got " + std::to_string(threads) + "; expected a whole number from 1").c_str());
  return threads;
}

bool is_size_of(const Shape& shape, std::size_t size) {
  if (std::find(shape.begin(), shape.end(), 0) != shape.end()) return size == 0;
  for (const std::size_t extent : shape) {
    if (size % extent != 0) return false;
    size /= extent;
  }
  return size == 1;
}

Typed<"tuple[int, ...]"> shape_tuple(const Shape& shape) { return nb::tuple(nb::cast(shape)); }

std::string text_of(const Shape& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

FloatArray real_array(nb::handle value, const char* name) {
  require_plain_within(value, name);
  nb::object array;
  try {
    array = numpy("asarray")(value);
  } catch (nb::python_error& e) {
    if (!e.matches(PyExc_ValueError) && !e.matches(PyExc_TypeError)) throw;
    refuse_not_real("a ragged or mixed " + class_name(value), name);
  }
  // an object array may hold numbers: Python integers beyond 64 bits
  const nb::object dtype = array.attr("dtype");
  const auto kind = nb::cast<std::string>(dtype.attr("kind"));
  const bool is_list = PyList_Check(value.ptr()) || PyTuple_Check(value.ptr());
  if (kind == "O" && !is_list && !nb::hasattr(value, "dtype"))  // an iterator, a timedelta
    refuse_not_real("a " + class_name(value), name);
  if (!is_real_kind(kind)) refuse_not_real(text_with(dtype, value), name);
  // not ascontiguousarray: it makes one dimension of none
  return numpy("asarray")(array, "dtype"_a = "float64", "order"_a = "C");
}

Numbers::Numbers(nb::handle value, const char* name, std::initializer_list<std::size_t> inner)
    : name_(name), inner_(inner), step_(product(inner_)) {
  if (inner_.empty() && read_number(value)) return;
  if (read_sequence(value)) return;
  nb::object array;
  // only these are read where they lie: the buffer of a datetime64 has a format that is no number's
  if (is_plain_array(value) && nb::isinstance<Array>(value)) {
    array = nb::borrow(value);
  } else if (inner_ == Shape{4} && nb::hasattr(value, "as_quat")) {
    array = numpy("ascontiguousarray")(scalar_first(value));
  } else {
    array = real_array(value, name_);
  }
  read(array);
}

void Numbers::read(nb::handle array) {
  const Array view = nb::cast<Array>(array);
  const std::size_t ndim = view.ndim(), inner = inner_.size();
  bool fits = ndim >= inner;
  for (std::size_t i = 0; fits && i < inner; ++i) fits = view.shape(ndim - inner + i) == inner_[i];
  if (!fits) {
    Shape got;
    for (std::size_t i = 0; i < ndim; ++i) got.push_back(view.shape(i));
    throw nb::value_error((std::string(name_) + ": got shape " + text_of(got) + "; expected " +
                           expected_shape(inner_))
                              .c_str());
  }
  for (std::size_t i = 0; i + inner < ndim; ++i) shape_.push_back(view.shape(i));
  array_ = nb::cast(view);
  first_ = view.data();
}

bool Numbers::read_number(nb::handle value) {
  if (!is_plain_scalar(value)) return false;
  const double number = PyFloat_AsDouble(value.ptr());
  if (number == -1.0 && PyErr_Occurred() != nullptr) throw nb::python_error();
  few_ = {number};
  first_ = few_.data();
  return true;
}

// A list or tuple of as many floats as the inner vector: not worth an array.
bool Numbers::read_sequence(nb::handle value) {
  if (inner_.size() != 1 || !(PyTuple_Check(value.ptr()) || PyList_Check(value.ptr())))
    return false;
  if (nb::len(value) != inner_[0]) return false;
  few_.reserve(inner_[0]);
  for (const nb::handle item : value) {
    if (!is_plain_scalar(item) || PyLong_CheckExact(item.ptr())) return false;
    few_.push_back(PyFloat_AsDouble(item.ptr()));
  }
  first_ = few_.data();
  return true;
}

void Numbers::broadcast(const Shape& shape) {
  if (shape_ == shape) return;
  if (product(shape_) == 1) {
    step_ = 0;
  } else {
    Shape whole = shape, own = shape_;
    whole.insert(whole.end(), inner_.begin(), inner_.end());
    const nb::object wide = numpy("broadcast_to")(array_, shape_tuple(whole));
    shape_.clear();
    read(numpy("ascontiguousarray")(wide));
  }
  shape_ = shape;
}

Shape broadcast(const Shape& a, const Shape& b, const char* name_a, const char* name_b) {
  Shape out(std::max(a.size(), b.size()), 1);
  for (std::size_t i = 0; i < out.size(); ++i) {  // from the last axis
    const std::size_t x = i < a.size() ? a[a.size() - 1 - i] : 1;
    const std::size_t y = i < b.size() ? b[b.size() - 1 - i] : 1;
    if (x != y && x != 1 && y != 1)
      throw nb::value_error((std::string(name_a) + " of shape " + text_of(a) + " and " + name_b +
                             " of shape " + text_of(b) + " do not broadcast")
                                .c_str());
    out[out.size() - 1 - i] = x == 1 ? y : x;
  }
  return out;
}

Shape broadcast(std::span<Numbers> all) {
  Shape shape;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Numbers& n = all[i];
    if (n.shape().empty() || n.shape() == shape) continue;
    // each with each: the message names the two that disagree, with the shapes that they have
    for (const Numbers& other : all.first(i))
      broadcast(other.shape(), n.shape(), other.name(), n.name());
    shape = broadcast(shape, n.shape(), "", n.name());
  }
  for (Numbers& n : all) n.broadcast(shape);
  return shape;
}

namespace {

void require_one(const Numbers& n) {
  if (!n.shape().empty())
    throw nb::value_error(
        (std::string(n.name()) + ": got shape " + text_of(n.shape()) + " of them; expected one")
            .c_str());
}

}  // namespace

double number(nb::handle value, const char* name) {
  const Numbers n(value, name);
  require_one(n);
  return n[0];
}

Vec3 vec3(nb::handle value, const char* name) {
  const Numbers n(value, name, {3});
  require_one(n);
  const double* x = n.at(0);
  return {x[0], x[1], x[2]};
}

Quaternion quaternion(nb::handle value, const char* name) {
  const Numbers n(value, name, {4});
  require_one(n);
  const double* q = n.at(0);
  return {q[0], q[1], q[2], q[3]};
}

Mat3 mat3(nb::handle value, const char* name) {
  const Numbers n(value, name, {3, 3});
  require_one(n);
  const double* m = n.at(0);
  return {{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}};
}

nb::object keeper(std::shared_ptr<const void> memory) {
  using Memory = std::shared_ptr<const void>;
  auto kept = std::make_unique<Memory>(std::move(memory));
  nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<Memory*>(p); });
  kept.release();
  return owner;
}

Result::Result(Shape shape, std::initializer_list<std::size_t> inner)
    : shape_(std::move(shape)), step_(product({inner.begin(), inner.size()})) {
  shape_.insert(shape_.end(), inner.begin(), inner.end());
  numbers_ = std::make_unique_for_overwrite<double[]>(product(shape_));
}

FloatArray Result::take() {
  if (shape_.empty()) return nb::float_(numbers_[0]);
  return array_that_owns(std::move(numbers_), shape_);
}

FloatArray array_of(const Vec3& v) { return small_array(v, {3}); }
FloatArray array_of(const Quaternion& q) { return small_array(q, {4}); }
FloatArray array_of(const Mat3& m) { return small_array(m, {3, 3}); }
FloatArray array_of(const Matrix6& m) { return small_array(m, {6, 6}); }
FloatArray array_of(std::span<const double> row) {
  Result result({row.size()});
  for (std::size_t k = 0; k < row.size(); ++k) *result.at(k) = row[k];
  return result.take();
}

void put(double* out, const Mat3& m) {
  for (int i = 0; i < 3; ++i) put(out + 3 * i, m.row[i]);
}

void put(double* out, const Matrix6& m) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) *out++ = m(i, j);
}

std::shared_ptr<void> room_for(std::size_t bytes) {
#ifdef __linux__
  constexpr std::size_t page = std::size_t{1} << 21;
  if (bytes >= 2 * page) {
    const std::size_t whole = (bytes + page - 1) / page * page;
    void* const first = std::aligned_alloc(page, whole);
    if (first == nullptr) throw std::bad_alloc();
    madvise(first, whole, MADV_HUGEPAGE);  // a wish: what it returns does not matter
    return {first, [](void* p) { std::free(p); }};
  }
#endif
  return {::operator new(bytes), [](void* p) { ::operator delete(p); }};
}

}  // namespace polhode::python
