// SPDX-License-Identifier: MIT
// Uses the installed polhode::io, which brings its own libraries along: those of units and files,
// and the threads of a map.
#include <cstdio>

#include "polhode/run/map_run.hpp"
#include "polhode/text/units.hpp"

int main() {
  const polhode::io::Units units("h", "deg", "1");
  const polhode::io::ScenarioMap map(R"(schema = 1
body.moments = [1, 1.7, 2.2]
state.euler = { phi = 0.1, theta = 1, psi = 0.5, Phi = 0.8, Theta = 0.1, Psi = 0.9 }
time = { stop = 5, count = 2 }
map = { kind = "chaos", axis = [{ key = "state.euler.theta", from = 1, to = 1.5, count = 3 }] }
)",
                                     "map.toml");
  const polhode::io::MapReport report = polhode::io::MapRun(map, {}, {}).run();
  std::printf("%s %.17g %d\n", units.label(polhode::io::Dimension::rate).c_str(),
              units.from_core(units.to_core(27.38, polhode::io::Dimension::rate),
                              polhode::io::Dimension::rate),
              static_cast<int>(report.points));
  return 0;
}
