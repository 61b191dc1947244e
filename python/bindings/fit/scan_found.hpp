// SPDX-License-Identifier: MIT
// A scan and its minima, as Python holds them.
#pragma once

#include <vector>

#include "polhode/fit/scan_minima.hpp"

namespace polhode::python {

struct ScanFound {
  Landscape landscape;
  std::vector<ScanMinimum> minima;
};

}  // namespace polhode::python
