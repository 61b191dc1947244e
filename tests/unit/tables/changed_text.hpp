// SPDX-License-Identifier: MIT
// A text with one part of it changed.
#pragma once

#include <string>

namespace polhode::test {

inline std::string changed_text(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) return "the test changes nothing";
  return text.replace(at, old.size(), by);
}

}  // namespace polhode::test
