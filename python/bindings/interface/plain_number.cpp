// SPDX-License-Identifier: MIT
#include "interface/plain_number.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "bindings.hpp"

namespace polhode::python {

namespace {

// What stands after "got ".
struct Refusal {
  std::string why;
  bool of_value = false;  // a ValueError, not a TypeError
};
using MayRefuse = std::optional<Refusal>;

// Lists nest no deeper in what NumPy makes an array of.
constexpr int deepest = 64;

nb::object numpy(const char* name) { return nb::module_::import_("numpy").attr(name); }

// It lives with NumPy; null without.
PyObject* numpy_type(const char* name) noexcept {
  try {
    return numpy(name).release().ptr();
  } catch (...) {
    PyErr_Clear();
    return nullptr;
  }
}

// Names of attributes, made once: Python's cache of attributes keeps every string that it meets.
struct Names {
  PyObject* unit = PyUnicode_InternFromString("unit");
  PyObject* units = PyUnicode_InternFromString("units");
  PyObject* to = PyUnicode_InternFromString("to");
  PyObject* magnitude = PyUnicode_InternFromString("magnitude");
  PyObject* dtype = PyUnicode_InternFromString("dtype");
  PyObject* kind = PyUnicode_InternFromString("kind");
  PyObject* strides = PyUnicode_InternFromString("strides");
  PyObject* dims = PyUnicode_InternFromString("dims");
  PyObject* data = PyUnicode_InternFromString("data");
  PyObject* mask = PyUnicode_InternFromString("mask");
  PyObject* generic = numpy_type("generic");
  // How libraries call the way from a quantity to its number.
  std::array<PyObject*, 5> conversions = {
      PyUnicode_InternFromString("to_value"), PyUnicode_InternFromString("m_as"),
      PyUnicode_InternFromString("value_in_unit"), PyUnicode_InternFromString("in_units"),
      PyUnicode_InternFromString("rescale")};
};

const Names& names() {
  static const Names* const all = new Names;  // as long as Python
  return *all;
}

// Attributes of the type: those of the object may be columns of a table or notes of a file.
bool has(nb::handle type, PyObject* attribute) {
  return PyObject_HasAttr(type.ptr(), attribute) != 0;
}

nb::object attribute(nb::handle value, PyObject* name) {
  if (PyObject* const found = PyObject_GetAttr(value.ptr(), name)) return nb::steal(found);
  PyErr_Clear();
  return nb::none();
}

// Of a type whose numbers have nothing beside them but a dtype.
bool is_numpy_scalar(nb::handle value) {
  PyObject* const generic = names().generic;
  return generic != nullptr && PyObject_IsInstance(value.ptr(), generic) == 1;
}

// On one line, cut where a sentence would drown in it.
std::string short_text(nb::handle value) {
  constexpr std::size_t longest = 48;
  const nb::object words = nb::object(nb::str(value)).attr("split")();
  const auto text = nb::cast<std::string>(nb::str(" ").attr("join")(words));
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

// The name of the method that makes numbers of a quantity; none where there is no known one.
nb::object conversion_of(nb::handle type) {
  for (PyObject* name : names().conversions)
    if (has(type, name)) return nb::borrow(name);
  return nb::none();
}

// The unit of astropy, pint, unyt, openmm, quantities, scipp and their like; none for the rest.
nb::object unit_of(nb::handle value) {
  const nb::handle type = value.type();
  const nb::object conversion = conversion_of(type);
  if (conversion.is_none() && !has(type, names().to) && !has(type, names().magnitude))
    return nb::none();
  for (PyObject* name : {names().unit, names().units}) {
    if (conversion.is_none() && !has(type, name)) continue;
    nb::object unit = attribute(value, name);
    const std::string kind = class_name(unit);
    const bool is_method = kind == "method" || kind == "builtin_function_or_method";
    if (!unit.is_none() && !is_method) return unit;
  }
  return nb::none();
}

std::string unit_text(nb::handle unit) {
  const std::string text = short_text(unit);
  return text.empty() ? "dimensionless" : text;
}

Refusal refusal_of_unit(nb::handle value, nb::handle unit, const char* name) {
  const nb::object convert = conversion_of(value.type());
  const std::string_view whole = name, last = whole.substr(whole.rfind(' ') + 1);
  const std::string own = last.empty() ? "" : std::string(last) + ".";
  const std::string how = convert.is_none()
                              ? "convert it and pass its value"
                              : own + nb::cast<std::string>(convert) + "(unit) gives them";
  return {short_text(value) + ", a " + class_name(value) + " in " + unit_text(unit) +
          "; expected plain numbers, all in one set of units: " + how};
}

// A table or an array around a quantity: pandas with pint's dtype, xarray with pint inside.
MayRefuse refusal_of_wrapped(nb::handle value, const char* name) {
  const nb::handle type = value.type();
  if (has(type, names().dtype) && !has(type, names().strides)) {
    const nb::object unit = attribute(attribute(value, names().dtype), names().units);
    if (!unit.is_none()) return refusal_of_unit(value, unit, name);
  }
  if (has(type, names().dims) && has(type, names().data)) {
    const nb::object inside = attribute(value, names().data);
    if (const nb::object unit = unit_of(inside); !unit.is_none())
      return refusal_of_unit(inside, unit, name);
  }
  return {};
}

bool is_masked(nb::handle value) {
  if (!has(value.type(), names().mask)) return false;
  const nb::object mask = attribute(value, names().mask);
  if (mask.is_none() || PyCallable_Check(mask.ptr()) != 0) return false;
  return nb::cast<bool>(nb::bool_(numpy("any")(mask)));
}

Refusal refusal(const std::string& got) { return {got + "; expected real numbers"}; }

// What float() takes for no number.
bool is_no_number(PyObject* value) {
  return PyUnicode_Check(value) || PyBytes_Check(value) || Py_TYPE(value) == &PyComplex_Type;
}

// Python's own things that float() or NumPy would make a number of.
MayRefuse refusal_of_python(nb::handle value) {
  PyObject* const p = value.ptr();
  if (PyBool_Check(p)) return refusal("a bool");
  if (is_no_number(p)) return refusal("a " + class_name(value));
  return {};
}

// An array or a scalar of NumPy that is not real; one of objects is looked at elsewhere.
MayRefuse refusal_of_dtype(nb::handle value) {
  if (!has(value.type(), names().dtype)) return {};
  const nb::object dtype = attribute(value, names().dtype), kind = attribute(dtype, names().kind);
  if (!nb::isinstance<nb::str>(kind)) return {};
  const auto letter = nb::cast<std::string>(kind);
  if (letter == "O" || is_real_kind(letter)) return {};
  return refusal(text_with(dtype, value));
}

MayRefuse refusal_of(nb::handle value, const char* name) {
  if (is_plain_array(value) || is_numpy_scalar(value)) return refusal_of_dtype(value);
  if (auto why = refusal_of_python(value)) return why;
  if (const nb::object unit = unit_of(value); !unit.is_none())
    return refusal_of_unit(value, unit, name);
  if (auto why = refusal_of_wrapped(value, name)) return why;
  if (is_masked(value)) return Refusal{"masked values; expected numbers", true};
  return refusal_of_dtype(value);
}

// Looks at every item of nested lists; at one of each of NumPy's types of scalars, as the type says
// all.
class Walk {
 public:
  explicit Walk(const char* name) : name_(name) {}

  MayRefuse operator()(nb::handle value, int depth = 0) {
    PyObject* const p = value.ptr();
    if (is_plain_scalar(value) || Py_TYPE(p) == known_) return {};
    if (!PyList_Check(p) && !PyTuple_Check(p)) {
      // of texts and complex numbers in a list, the dtype of the whole says it
      if (depth > 0 && is_no_number(p)) return {};
      return of_item(value);
    }
    if (depth == deepest) return {};
    for (const nb::handle item : value)
      if (auto why = (*this)(item, depth + 1)) return why;
    return {};
  }

 private:
  MayRefuse of_item(nb::handle value) {
    auto why = refusal_of(value, name_);
    if (!why && is_numpy_scalar(value)) known_ = Py_TYPE(value.ptr());
    return why;
  }

  const char* name_;
  const PyTypeObject* known_ = nullptr;
};

[[noreturn]] void refuse(const Refusal& refusal, const char* name) {
  const std::string subject = name[0] == '\0' ? "" : std::string(name) + ": ";
  const std::string text = subject + "got " + refusal.why;
  if (refusal.of_value) throw nb::value_error(text.c_str());
  throw nb::type_error(text.c_str());
}

// Whether it was taken as `refused`.
bool takes_refused(nb::handle value, nb::handle& refused) noexcept {
  if (value.is_none() || is_plain_scalar(value) || is_no_number(value.ptr())) return false;
  try {
    if (is_refused(value)) refused = value;
  } catch (...) {
    PyErr_Clear();  // an object whose attributes fail is no number of any kind
  }
  return refused.is_valid();
}

bool had_no_error() noexcept {
  if (PyErr_Occurred() == nullptr) return true;
  PyErr_Clear();
  return false;
}

template <class T>
bool read_integer(nb::handle value, bool convert, T& number, nb::handle& refused,
                  T (*read)(PyObject*)) noexcept {
  if (!PyLong_CheckExact(value.ptr())) {
    if (!convert) return false;
    if (takes_refused(value, refused)) return true;
    if (PyIndex_Check(value.ptr()) == 0) return false;
  }
  PyObject* const index = PyNumber_Index(value.ptr());
  if (index == nullptr) return had_no_error();
  number = read(index);
  Py_DECREF(index);
  return number != static_cast<T>(-1) || had_no_error();
}

}  // namespace

std::string class_name(nb::handle value) {
  return nb::cast<std::string>(nb::handle(value.type()).attr("__name__"));
}

std::string text_with(nb::handle dtype, nb::handle value) {
  return class_name(value) + " of " + nb::cast<std::string>(nb::str(dtype));
}

bool is_real_kind(std::string_view kind) { return kind == "f" || kind == "i" || kind == "u"; }

void refuse_not_real(const std::string& got, const char* name) { refuse(refusal(got), name); }

bool is_plain_scalar(nb::handle value) noexcept {
  if (PyFloat_CheckExact(value.ptr()) || PyLong_CheckExact(value.ptr())) return true;
  static const PyObject* const float64 = numpy_type("float64");
  return value.type().ptr() == float64;
}

bool is_plain_array(nb::handle value) noexcept {
  static const PyObject* const ndarray = numpy_type("ndarray");
  return value.type().ptr() == ndarray;
}

bool is_refused(nb::handle value) { return Walk("")(value).has_value(); }

void require_plain(nb::handle value, const char* name) {
  if (const auto why = Walk(name)(value)) refuse(*why, name);
}

void require_plain_within(nb::handle value, const char* name) { require_plain(value, name); }

bool read_plain(nb::handle value, bool convert, double& number, nb::handle& refused) noexcept {
  if (!PyFloat_CheckExact(value.ptr())) {
    if (!convert) return false;
    if (takes_refused(value, refused)) return true;
  }
  number = PyFloat_AsDouble(value.ptr());
  return number != -1.0 || had_no_error();
}

bool read_plain(nb::handle value, bool convert, long long& number, nb::handle& refused) noexcept {
  return read_integer(value, convert, number, refused, PyLong_AsLongLong);
}

bool read_plain(nb::handle value, bool convert, unsigned long long& number,
                nb::handle& refused) noexcept {
  return read_integer(value, convert, number, refused, PyLong_AsUnsignedLongLong);
}

}  // namespace polhode::python
