// SPDX-License-Identifier: MIT
// Plain numbers, and what must not be taken for one: a quantity would lose its unit, a masked value
// its mask, a complex number its imaginary part. nanobind converts every float and int argument
// through the casters below, and Numbers (arrays.hpp) every array: a new function refuses such
// things without a word of its own.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace polhode::python {

namespace nb = nanobind;

// "ndarray", of any Python object.
std::string class_name(nb::handle value);
// "ndarray of complex128".
std::string text_with(nb::handle dtype, nb::handle value);
// Whether a dtype of NumPy of this kind ("f", "c", "O") holds real numbers.
bool is_real_kind(std::string_view kind);
// TypeError: "t: got a bool; expected real numbers". `name` as for require_plain.
[[noreturn]] void refuse_not_real(const std::string& got, const char* name);

// A float or an int and nothing derived from them, or NumPy's own float64.
bool is_plain_scalar(nb::handle value) noexcept;
// An ndarray and nothing derived from it.
bool is_plain_array(nb::handle value) noexcept;

// TypeError for what is no plain number: "t: got 1.0 d, a Quantity in d; expected plain numbers,
// ..."; ValueError for masked values. Nothing for what may be numbers, or be none at all. `name`
// stands for the argument; "" for none, and the sentence begins with "got".
void require_plain(nb::handle value, const char* name);
// The same for lists and tuples, down to their last item.
void require_plain_within(nb::handle value, const char* name);
bool is_refused(nb::handle value);

// What nanobind's casters take, with and without conversion. What require_plain refuses is taken,
// too, as `refused`: the cast can say why, and from_python cannot. False for what is no number.
bool read_plain(nb::handle value, bool convert, double& number, nb::handle& refused) noexcept;
bool read_plain(nb::handle value, bool convert, long long& number, nb::handle& refused) noexcept;
bool read_plain(nb::handle value, bool convert, unsigned long long& number,
                nb::handle& refused) noexcept;

}  // namespace polhode::python

namespace nanobind::detail {

// Wide is what numbers are read as. A cast may throw, from_python may not; containers ask can_cast
// first.
template <class T, class Wide>
struct plain_caster {
  using Value = T;
  template <class T_>
  using Cast = movable_cast_t<T_>;
  static constexpr auto Name = const_name<std::is_integral_v<T>>("int", "float");

  template <class Flags>
  bool from_python(handle source, Flags flags, cleanup_list*) noexcept {
    const bool convert = (flags & static_cast<Flags>(cast_flags::convert)) != 0;
    Wide wide{};
    refused = handle();
    if (!polhode::python::read_plain(source, convert, wide, refused)) return false;
    value = static_cast<T>(wide);
    return !std::is_integral_v<T> || static_cast<Wide>(value) == wide;
  }
  static handle from_cpp(T number, rv_policy, cleanup_list*) noexcept {
    if constexpr (std::is_floating_point_v<T>)
      return PyFloat_FromDouble(number);
    else if constexpr (std::is_signed_v<T>)
      return PyLong_FromLongLong(number);
    else
      return PyLong_FromUnsignedLongLong(number);
  }
  static handle from_cpp(const T* number, rv_policy policy, cleanup_list* list) noexcept {
    return number == nullptr ? none().release() : from_cpp(*number, policy, list);
  }

  template <class T_>
  bool can_cast() const noexcept {
    return !refused.is_valid();
  }
  explicit operator T*() { return &checked(); }
  explicit operator T&() { return checked(); }
  explicit operator T&&() { return static_cast<T&&>(checked()); }

  T& checked() {
    if (refused.is_valid()) polhode::python::require_plain(refused, "");
    return value;
  }

  T value{};
  handle refused;
};

template <>
struct type_caster<double> : plain_caster<double, double> {};

// nanobind's own would say that no function takes what is refused, and not why.
template <>
struct type_caster<std::optional<double>> : optional_caster<std::optional<double>> {
  template <class Flags>
  bool from_python(handle source, Flags flags, cleanup_list* list) noexcept {
    refused = handle();
    value.reset();
    if (source.is_none()) return true;
    make_caster<double> number;
    if (!number.from_python(source, flags, list)) return false;
    value = number.value;
    refused = number.refused;
    return true;
  }
  template <class T_>
  bool can_cast() const noexcept {
    return !refused.is_valid();
  }
  explicit operator std::optional<double>*() { return &checked(); }
  explicit operator std::optional<double>&() { return checked(); }
  explicit operator std::optional<double>&&() { return std::move(checked()); }

  std::optional<double>& checked() {
    if (refused.is_valid()) polhode::python::require_plain(refused, "");
    return value;
  }

  handle refused;
};

template <>
struct type_caster<int> : plain_caster<int, long long> {};
template <>
struct type_caster<long> : plain_caster<long, long long> {};
template <>
struct type_caster<unsigned> : plain_caster<unsigned, unsigned long long> {};
template <>
struct type_caster<unsigned long> : plain_caster<unsigned long, unsigned long long> {};

}  // namespace nanobind::detail
