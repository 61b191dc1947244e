// SPDX-License-Identifier: MIT
#include "interface/dual_number.hpp"

#include <algorithm>
#include <array>

#include "polhode/rotor/attitude.hpp"

namespace polhode::python {

bool is_real_scalar(nb::handle value) {
  if (is_plain_scalar(value)) return true;
  if (nb::isinstance<PythonDual>(value) || is_refused(value)) return false;
  if (PyFloat_Check(value.ptr()) || PyLong_Check(value.ptr())) return true;
  const nb::module_ numpy = nb::module_::import_("numpy");
  if (PyObject_IsInstance(value.ptr(), numpy.attr("ndarray").ptr()) == 1)
    return nb::cast<int>(value.attr("ndim")) == 0 &&
           nb::cast<std::string>(value.attr("dtype").attr("kind")).find_first_of("fiu") !=
               std::string::npos;
  return PyObject_IsInstance(value.ptr(), numpy.attr("floating").ptr()) == 1 ||
         PyObject_IsInstance(value.ptr(), numpy.attr("integer").ptr()) == 1;
}

double real_scalar(nb::handle value) {
  const double x = PyFloat_AsDouble(value.ptr());
  if (x == -1.0 && PyErr_Occurred() != nullptr) throw nb::python_error();
  return x;
}

nb::object item_of(nb::handle value) {
  // a quantity of pint has ndim and item, and no dtype
  for (const char* own : {"ndim", "item", "dtype"})
    if (!nb::hasattr(value, own)) return {};
  const bool object = nb::cast<std::string>(value.attr("dtype").attr("kind")) == "O";
  if (!object || nb::cast<int>(value.attr("ndim")) != 0) return {};
  nb::object item = value.attr("item")();
  return nb::isinstance(item, value.type()) ? nb::object() : item;
}

nb::object object_array(const nb::list& items) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  // not numpy.array(items): it would look into every item for a sequence
  nb::object array = numpy.attr("empty")(nb::len(items), "dtype"_a = "object");
  array.attr("__setitem__")(nb::ellipsis(), items);
  return array;
}

namespace {

// The items of an object array of a shape, or of a list of the items themselves, where at least one
// is a Dual; else none.
std::vector<nb::object> items_with_duals(nb::handle array, std::size_t size, const char* shape) {
  std::vector<nb::object> items;
  nb::object flat;
  if (nb::hasattr(array, "dtype")) {
    if (nb::cast<std::string>(array.attr("dtype").attr("kind")) != "O") return items;
    if (nb::cast<std::string>(nb::str(nb::object(array.attr("shape")))) != shape) return items;
    flat = array.attr("ravel")();
  } else if (PyList_Check(array.ptr()) || PyTuple_Check(array.ptr())) {
    flat = nb::borrow(array);
  }
  if (!flat.is_valid() || nb::len(flat) != size) return items;
  bool has_dual = false;
  for (std::size_t i = 0; i < size; ++i) {
    items.emplace_back(flat[i]);
    has_dual = has_dual || nb::isinstance<PythonDual>(items.back());
  }
  if (!has_dual) items.clear();
  return items;
}

// All of the kind D of the first Dual among them, for f(std::array<D, N>).
template <std::size_t N, class F>
nb::object on_duals(const std::vector<nb::object>& items, const char* what, F f) {
  const auto first = std::find_if(items.begin(), items.end(), [](const nb::object& item) {
    return nb::isinstance<PythonDual>(item);
  });
  return std::visit(
      [&](const auto& of_kind) -> nb::object {
        std::array<std::decay_t<decltype(of_kind)>, N> x;
        for (std::size_t i = 0; i < N; ++i)
          if (!from_python(items[i], x[i]))
            throw nb::type_error(
                (std::string(what) + ": expected floats and Duals of one kind").c_str());
        return f(x);
      },
      nb::cast<const PythonDual&>(*first).x);
}

template <class D>
nb::object matrix_of(const std::array<D, 4>& q) {
  const BasicMat3<D> R = attitude_matrix(BasicQuaternion<D>{q[0], q[1], q[2], q[3]});
  nb::list items;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) items.append(to_python(R(i, j)));
  return object_array(items).attr("reshape")(3, 3);
}

// The largest component first: the others are quotients by it.
template <class D>
nb::object quaternion_of(const std::array<D, 9>& R) {
  const auto at = [&](std::size_t i, std::size_t j) -> const D& { return R[3 * i + j]; };
  const D one(1.0), half(0.5);
  const std::array<D, 4> squares{
      one + at(0, 0) + at(1, 1) + at(2, 2), one + at(0, 0) - at(1, 1) - at(2, 2),
      one - at(0, 0) + at(1, 1) - at(2, 2), one - at(0, 0) - at(1, 1) + at(2, 2)};
  std::size_t k = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (squares[i] > squares[k]) k = i;
  const D root = sqrt(squares[k]);  // twice the component
  const D by = half / root;
  // v_B = R v_I: R is the transpose of the matrix that turns body vectors into space
  const D wx = by * (at(1, 2) - at(2, 1)), wy = by * (at(2, 0) - at(0, 2)),
          wz = by * (at(0, 1) - at(1, 0));
  const D xy = by * (at(0, 1) + at(1, 0)), xz = by * (at(0, 2) + at(2, 0)),
          yz = by * (at(1, 2) + at(2, 1));
  const D own = half * root;
  switch (k) {
    case 0:
      return to_python(BasicQuaternion<D>{own, wx, wy, wz});
    case 1:
      return to_python(BasicQuaternion<D>{wx, own, xy, xz});
    case 2:
      return to_python(BasicQuaternion<D>{wy, xy, own, yz});
    default:
      return to_python(BasicQuaternion<D>{wz, xz, yz, own});
  }
}

}  // namespace

nb::object dual_attitude_matrix(nb::handle q) {
  const std::vector<nb::object> items = items_with_duals(q, 4, "(4,)");
  if (items.empty()) return nb::none();
  return on_duals<4>(items, "attitude_matrix: q", [](const auto& x) { return matrix_of(x); });
}

nb::object dual_attitude(nb::handle R) {
  const std::vector<nb::object> items = items_with_duals(R, 9, "(3, 3)");
  if (items.empty()) return nb::none();
  return on_duals<9>(items, "attitude: R", [](const auto& x) { return quaternion_of(x); });
}

}  // namespace polhode::python
