// SPDX-License-Identifier: MIT
// Dual numbers of every kind that C++ evaluates a user's function on, as one Python class.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "bindings.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode::python {

// One derivative: times of frames. Six: states; six of six: second derivatives. Seven: variables
// and time of Andoyer's method. Each in the arithmetic of the run.
struct PythonDual {
  using Number = std::variant<Dual<double, 1>, Tangent, Dual<double, 7>, Dual<Tangent, 6>,
                              Dual<DoubleDouble, 1>, Dual<DoubleDouble, 6>>;
  Number x;
};

template <class T>
inline constexpr bool is_dual = false;
template <Real T, int N>
inline constexpr bool is_dual<Dual<T, N>> = true;

// A float, np.float64(3.0), 3: any real scalar that is not a Dual.
bool is_real_scalar(nb::handle value);
double real_scalar(nb::handle value);

// What an object array of no dimension holds, as numpy.where makes it; null for anything else.
nb::object item_of(nb::handle value);

// What a user's function is called with. A double-double without derivatives becomes a Dual that
// has them, all zero: Python has no such number.
inline nb::object to_python(double x) { return nb::float_(x); }
inline nb::object to_python(const DoubleDouble& x) {
  return nb::cast(PythonDual{Dual<DoubleDouble, 1>(x)});
}
template <Real T, int N>
nb::object to_python(const Dual<T, N>& x) {
  return nb::cast(PythonDual{x});
}

// And what it returned: a number of the same kind, or a constant. False for anything else.
template <class T>
bool from_python(nb::handle value, T& out) {
  if (is_real_scalar(value)) {
    out = T(real_scalar(value));
    return true;
  }
  if (!nb::isinstance<PythonDual>(value)) {
    const nb::object item = item_of(value);
    return item.is_valid() && from_python(item, out);
  }
  const PythonDual::Number& x = nb::cast<const PythonDual&>(value).x;
  if constexpr (is_dual<T>) {
    if (const T* same = std::get_if<T>(&x)) {
      out = *same;
      return true;
    }
  } else if constexpr (std::same_as<T, DoubleDouble>) {
    if (const auto* same = std::get_if<Dual<DoubleDouble, 1>>(&x)) {
      out = same->value;
      return true;
    }
  }
  return false;
}

// An object array (n,) of what `items` holds.
nb::object object_array(const nb::list& items);

template <class T>
nb::object to_python(const BasicVec3<T>& v) {
  nb::list items;
  for (const T& x : {v.x, v.y, v.z}) items.append(to_python(x));
  return object_array(items);
}
template <class T>
nb::object to_python(const BasicQuaternion<T>& q) {
  nb::list items;
  for (const T& x : {q.w, q.x, q.y, q.z}) items.append(to_python(x));
  return object_array(items);
}

// R of [SA (2)] for a quaternion of which at least one component is a Dual: (3, 3) of them. None
// for anything else.
nb::object dual_attitude_matrix(nb::handle q);
// And the quaternion (4,) of a rotation matrix of Duals.
nb::object dual_attitude(nb::handle R);

}  // namespace polhode::python
