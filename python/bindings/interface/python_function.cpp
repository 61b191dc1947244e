// SPDX-License-Identifier: MIT
#include "interface/python_function.hpp"

#include <stdexcept>

namespace polhode::python {

namespace {

// An object as it prints, on one line, cut where a sentence would drown in it.
std::string short_repr(nb::handle value) {
  constexpr std::size_t longest = 80;
  const nb::object words = nb::repr(value).attr("split")();
  const auto text = nb::cast<std::string>(nb::str(" ").attr("join")(words));
  return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

}  // namespace

PythonFunction::PythonFunction(nb::handle function, std::string label)
    : function_(function.ptr()), label_(std::move(label)) {
  if (PyCallable_Check(function_) == 0)
    throw nb::type_error(
        (label_ + ": got " + short_repr(function) + "; expected a function").c_str());
  Py_INCREF(function_);
}

PythonFunction::~PythonFunction() {
  if (function_ == nullptr || Py_IsInitialized() == 0) return;
  const WithGil acquired;
  clear();
}

nb::object PythonFunction::alive() const {
  if (function_ == nullptr)
    throw std::runtime_error(label_ + ": the function was garbage collected");
  return nb::borrow(function_);
}

void PythonFunction::refuse(nb::handle returned, const char* expected) const {
  const std::string text =
      label_ + ": the function returned " + short_repr(returned) + "; expected " + expected;
  if (nb::isinstance<nb::sequence>(returned)) throw nb::value_error(text.c_str());
  throw nb::type_error(text.c_str());
}

Vec3 PythonFunction::three_numbers(nb::handle returned, const char* expected) const {
  try {
    return vec3(returned, "");
  } catch (const nb::builtin_exception&) {
    refuse(returned, expected);
  }
}

int PythonFunction::traverse(visitproc visit, void* arg) const {
  Py_VISIT(function_);
  return 0;
}

void PythonFunction::clear() {
  PyObject* const function = std::exchange(function_, nullptr);
  Py_XDECREF(function);
}

}  // namespace polhode::python
