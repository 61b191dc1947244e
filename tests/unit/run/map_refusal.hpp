// SPDX-License-Identifier: MIT
// What is said of a text that is no map; empty where it is one.
#pragma once

#include <string>

#include "polhode/error.hpp"
#include "polhode/run/map.hpp"

namespace polhode::test {

inline std::string refusal(const std::string& text) {
  try {
    const ScenarioMap map(text, "m.toml");
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

}  // namespace polhode::test
