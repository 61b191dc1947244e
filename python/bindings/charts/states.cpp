// SPDX-License-Identifier: MIT
#include "charts/states.hpp"

#include <cmath>

namespace polhode::python {

namespace {

std::size_t width_of(const Field& field) {
  return field.kind == Kind::vector ? 3 : (field.kind == Kind::quaternion ? 4 : 1);
}

// Strides of an array in C order whose items are `item` bytes apart, in units of `unit` bytes.
std::vector<std::int64_t> strides_of(const Shape& shape, std::size_t item, std::size_t unit) {
  std::vector<std::int64_t> strides(shape.size());
  std::size_t step = item / unit;
  for (std::size_t i = shape.size(); i-- > 0;) {
    strides[i] = static_cast<std::int64_t>(step);
    step *= shape[i];
  }
  return strides;
}

// A read-only view: leading shape, then `inner` numbers that lie together where it is not 1.
template <class T>
nb::object view_of(const StateMemory& states, std::size_t offset, std::size_t inner) {
  Shape shape = states.shape;
  std::vector<std::int64_t> strides = strides_of(shape, states.stride, sizeof(T));
  if (inner != 1) {
    shape.push_back(inner);
    strides.push_back(1);
  }
  return nb::cast(nb::ndarray<nb::numpy, const T>(states.first + offset, shape.size(), shape.data(),
                                                  keeper(states.owner), strides.data()));
}

template <class T>
T value_at(const StateMemory& states, const Field& field) {
  T value;
  std::memcpy(&value, states.first + field.offset, sizeof(T));
  return value;
}

nb::object numpy() { return nb::module_::import_("numpy"); }

// Stays where it is as long as the array lives.
const std::byte* first_byte_of(const nb::object& array) {
  Py_buffer buffer;
  if (PyObject_GetBuffer(array.ptr(), &buffer, PyBUF_STRIDES) != 0) throw nb::python_error();
  const auto* first = static_cast<const std::byte*>(buffer.buf);
  PyBuffer_Release(&buffer);
  return first;
}

}  // namespace

nb::object field_of(const StateMemory& states, const Field& field) {
  const bool one = states.shape.empty();
  if (field.kind == Kind::integer) {
    if (!one) return view_of<std::int32_t>(states, field.offset, 1);
    const int value = value_at<std::int32_t>(states, field);
    return field.member != nullptr ? field.member(value) : nb::object(nb::int_(value));
  }
  if (one && field.kind == Kind::real) return nb::float_(value_at<double>(states, field));
  return view_of<double>(states, field.offset, width_of(field));
}

nb::object table_of(const StateMemory& states, std::size_t columns) {
  return view_of<double>(states, 0, columns);
}

nb::object as_asked(const nb::object& table, nb::handle dtype, nb::handle copy) {
  if (!copy.is_none() && nb::cast<bool>(copy))
    return numpy().attr("array")(table, "dtype"_a = dtype);
  nb::object array = numpy().attr("asarray")(table, "dtype"_a = dtype);
  if (!copy.is_none() && !array.is(table))
    throw nb::value_error("an array of another dtype cannot be made without a copy");
  return array;
}

// Opaque items, because NumPy then indexes the leading axes and nothing else.
nb::object items_of(const StateMemory& states, std::size_t item) {
  const nb::object bytes = view_of<std::uint8_t>(states, 0, item);
  const nb::str opaque(("V" + std::to_string(item)).c_str());
  return bytes.attr("view")(opaque)[nb::make_tuple(nb::ellipsis(), 0)];
}

Items memory_of(nb::handle items, std::size_t item) {
  // A new axis keeps a single item an array, and where it lies.
  nb::object array = numpy().attr("asarray")(items);
  Shape shape = nb::cast<Shape>(array.attr("shape"));
  auto strides = nb::cast<std::vector<std::int64_t>>(array.attr("strides"));
  bool regular = true;
  std::int64_t step = shape.empty() ? static_cast<std::int64_t>(item) : strides.back();
  for (std::size_t i = shape.size(); i-- > 0;) {
    regular = regular && strides[i] == step;
    step *= static_cast<std::int64_t>(shape[i]);
  }
  if (!regular || (!shape.empty() && strides.back() < 0)) {
    array = numpy().attr("array")(array, "order"_a = "C");
    strides = nb::cast<std::vector<std::int64_t>>(array.attr("strides"));
  }
  const std::size_t stride = shape.empty() ? item : static_cast<std::size_t>(strides.back());
  const std::byte* first = first_byte_of(array);
  return {std::move(array), first, stride, std::move(shape)};
}

std::shared_ptr<const void> kept_alive(nb::object object) {
  PyObject* const pointer = object.release().ptr();
  return std::shared_ptr<const void>(pointer, [](const void* p) {
    const WithGil acquired;
    Py_DECREF(static_cast<PyObject*>(const_cast<void*>(p)));
  });
}

// RotorState(q=array([...]), g=...) of one; one line with the shape and the first state of many.
std::string repr_of(const char* name, const StateMemory& states, std::span<const Field> fields) {
  std::string text = name;
  const bool one = states.shape.empty();
  if (!one) text += " of shape " + text_of(states.shape);
  if (!one && size_of(states.shape) == 0) return "<" + text + ">";
  const Shape single;
  const StateMemory first{single, states.first, states.stride, states.owner};
  std::string inside;
  for (const Field& field : fields) {
    nb::object value = field_of(first, field);
    if (nb::hasattr(value, "tolist")) value = value.attr("tolist")();
    inside += (inside.empty() ? "" : ", ") + std::string(field.name) + "=";
    if (nb::hasattr(value, "name"))  // an enum's member: "Pole.zero"
      inside += class_name(value) + "." + nb::cast<std::string>(value.attr("name"));
    else
      inside += nb::cast<std::string>(nb::repr(value));
  }
  return one ? text + "(" + inside + ")" : "<" + text + ", first: " + inside + ">";
}

std::string field_signature(const Field& field) {
  const std::string array = "numpy.typing.NDArray[";
  std::string type;
  if (field.kind == Kind::real) type = "float | " + array + "numpy.float64]";
  if (field.kind == Kind::integer)
    type = std::string(field.annotation != nullptr ? field.annotation : "int") + " | " + array +
           "numpy.int32]";
  if (type.empty()) type = array + "numpy.float64]";
  return std::string("def ") + field.name + "(self) -> " + type;
}

Numbers numbers_for(const Field& field, nb::handle value) {
  switch (field.kind) {
    case Kind::vector:
      return Numbers(value, field.name, {3});
    case Kind::quaternion:
      return Numbers(value, field.name, {4});
    default:
      if (field.named != nullptr && nb::isinstance<nb::str>(value))
        return Numbers(nb::int_(field.named(value, field.name)), field.name);
      return Numbers(value, field.name);
  }
}

namespace {

template <std::size_t Width>
void copy_numbers(const Numbers& from, std::size_t n, std::byte* to, std::size_t stride) {
  for (std::size_t k = 0; k < n; ++k, to += stride)
    std::memcpy(to, from.at(k), Width * sizeof(double));
}

// What is no small integer becomes one that no chart allows.
std::int32_t small_integer(double x) {
  const bool small = -100.0 < x && x < 100.0 && x == static_cast<int>(x);
  return small ? static_cast<std::int32_t>(x) : 1000;
}

}  // namespace

void store(const Field& field, const Numbers& from, std::size_t n, std::byte* states,
           std::size_t stride) {
  std::byte* const to = states + field.offset;
  switch (field.kind) {
    case Kind::real:
      return copy_numbers<1>(from, n, to, stride);
    case Kind::vector:
      return copy_numbers<3>(from, n, to, stride);
    case Kind::quaternion:
      return copy_numbers<4>(from, n, to, stride);
    case Kind::integer:
      for (std::size_t k = 0; k < n; ++k) {
        const std::int32_t value = small_integer(from[k]);
        std::memcpy(to + k * stride, &value, sizeof value);
      }
  }
}

nb::object class_itself() {
  const nb::object function = nb::cpp_function([](nb::object self, nb::handle) { return self; });
  return nb::module_::import_("builtins").attr("classmethod")(function);
}

void require_finite(const char* what, std::initializer_list<double> values) {
  for (const double x : values) {
    if (std::isfinite(x)) continue;
    const std::string shown = std::isnan(x) ? "nan" : (x < 0.0 ? "-inf" : "inf");
    throw DomainError(std::string(what) + ": got " + shown + "; expected finite numbers");
  }
}

std::string index_text(std::size_t k, const Shape& shape) {
  Shape index(shape.size());
  for (std::size_t i = shape.size(); i-- > 0;) {
    index[i] = k % shape[i];
    k /= shape[i];
  }
  return " (at index " + text_of(index) + ")";
}

}  // namespace polhode::python
