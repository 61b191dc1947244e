// SPDX-License-Identifier: MIT
// Place: the place of a value in its file, which plans keep so that a later stage can reject the
// value.
//
// Errors      refuse and built throw a ScenarioError "FILE:LINE:COLUMN: KEY: got VALUE; MESSAGE".
// Cost        two strings.
#pragma once

#include <string>
#include <string_view>

#include "polhode/error.hpp"
#include "polhode/text/key_values.hpp"

namespace polhode {
inline namespace v0 {

struct Place {
  std::string key;  // "FILE:LINE:COLUMN: KEY"
  std::string got;  // "got VALUE; "; empty for a table

  std::string message(std::string_view expected) const;
  // "expected ..."
  [[noreturn]] void refuse(std::string_view expected) const;

  // Turns a DomainError of the library into a ScenarioError at this place.
  template <class Build>
  auto built(const Build& build) const {
    try {
      return build();
    } catch (const ScenarioError&) {
      throw;
    } catch (const DomainError& error) {
      refuse(error.what());
    }
  }
};

}  // namespace v0
}  // namespace polhode
