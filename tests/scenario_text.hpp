// SPDX-License-Identifier: MIT
// The text of a scenario of a body with moments 1, 2 and 2.5.
#pragma once

#include <string>

namespace polhode::test {

// Whole lines, but for the quaternion.
struct ScenarioParts {
  std::string units{}, state{};
  std::string quaternion = "[1, 0, 0, 0]";
  std::string rate = "omega_body = [0.1, 0.2, 1]\n";
};

inline std::string scenario_text(const std::string& rest, const ScenarioParts& with = {}) {
  return "schema = 1\n" + with.units + "[body]\nmoments = [1, 2, 2.5]\n" + with.state +
         "[state.attitude-rate]\nquaternion = " + with.quaternion + "\n" + with.rate + rest;
}

}  // namespace polhode::test
