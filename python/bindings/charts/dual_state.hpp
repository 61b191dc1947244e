// SPDX-License-Identifier: MIT
// A state whose numbers are Duals. Chart classes make one of Duals, and conversions between charts
// take and return such states, so that a perturbation can be written in any chart.
#pragma once

#include <span>
#include <string>

#include "interface/dual_number.hpp"

namespace polhode::python {

struct Field;

struct DualState {
  std::string chart;  // the name of its class: "AndoyerState"
  nb::dict fields;    // by name; vectors are object arrays
};

// A RotorState of Duals.
template <class T>
DualState dual_rotor(const BasicQuaternion<T>& q, const BasicVec3<T>& g) {
  DualState s{"RotorState", {}};
  s.fields["q"] = to_python(q);
  s.fields["g"] = to_python(g);
  return s;
}

// The state of the arguments of a chart class; null if none of them is a Dual. TypeError if a
// vector among them has another length.
nb::object dual_state_of(const char* chart, std::span<const Field> fields, const nb::args& args,
                         const nb::kwargs& named);

void bind_dual_state(nb::module_& m);

}  // namespace polhode::python
