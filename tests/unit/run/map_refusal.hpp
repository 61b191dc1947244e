// SPDX-License-Identifier: MIT
// What is said of a text that is no map; empty where it is one.
#pragma once

#include <string>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/run/map_run.hpp"

namespace polhode::test {

inline std::string refusal(const std::string& text) {
  return message_of<io::ScenarioError>([&] { const io::ScenarioMap map(text, "m.toml"); });
}

}  // namespace polhode::test
