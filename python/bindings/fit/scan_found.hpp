// SPDX-License-Identifier: MIT
// A scan and its minima, as Python holds them.
#pragma once

#include <vector>

#include "bindings.hpp"
#include "polhode/fit/fourier_fit.hpp"

namespace polhode::python {

struct ScanFound {
  fit::Landscape landscape;
  std::vector<fit::ScanMinimum> minima;
};

// As numbers, for pickles; and again from them.
nb::tuple scan_state(const ScanFound& scan);
ScanFound scan_of_state(const nb::tuple& state);

}  // namespace polhode::python
