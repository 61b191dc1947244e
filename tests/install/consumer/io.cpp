// SPDX-License-Identifier: MIT
// Uses the installed polhode::io, which brings its own libraries along.
#include <cstdio>

#include "polhode/text/units.hpp"

int main() {
  const polhode::Units units("h", "deg", "1");
  std::printf(
      "%s %.17g\n", units.label(polhode::Dimension::rate).c_str(),
      units.from_core(units.to_core(27.38, polhode::Dimension::rate), polhode::Dimension::rate));
  return 0;
}
