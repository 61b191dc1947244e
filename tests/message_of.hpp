// SPDX-License-Identifier: MIT
// What a call refuses with.
#pragma once

#include <string>

#include "polhode/error.hpp"

namespace polhode::test {

// The message of its DomainError; empty where it throws none.
template <class F>
std::string message_of(const F& f) {
  try {
    f();
  } catch (const DomainError& error) {
    return error.what();
  }
  return "";
}

}  // namespace polhode::test
