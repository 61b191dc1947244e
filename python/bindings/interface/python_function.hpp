// SPDX-License-Identifier: MIT
// A Python function that C++ keeps, calls from any thread, and shows to Python's garbage collector.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "interface/arrays.hpp"

namespace polhode::python {

// Shared by every copy of the C++ value that calls it. It owns one reference, which the Python
// object that the value was made for reports and drops (recipe.hpp).
class PythonFunction {
 public:
  // `label` names the function in messages: "TorqueTerm "drag"". TypeError unless callable.
  PythonFunction(nb::handle function, std::string label);
  PythonFunction(const PythonFunction&) = delete;
  PythonFunction& operator=(const PythonFunction&) = delete;
  ~PythonFunction();

  const std::string& label() const { return label_; }

  // With the GIL.
  template <class... A>
  nb::object operator()(A&&... arguments) const {
    return staying_put([&] { return alive()(std::forward<A>(arguments)...); });
  }

  // What it returned is not what is expected: TypeError or ValueError with both.
  [[noreturn]] void refuse(nb::handle returned, const char* expected) const;
  Vec3 three_numbers(nb::handle returned, const char* expected) const;

  int traverse(visitproc visit, void* arg) const;
  void clear();

 private:
  nb::object alive() const;

  PyObject* function_;
  std::string label_;
};

using SharedFunction = std::shared_ptr<PythonFunction>;

}  // namespace polhode::python
