// SPDX-License-Identifier: MIT
// The exceptions of the library. Constructors and factories throw DomainError; evaluation never
// throws.
#pragma once

#include <stdexcept>
#include <string>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

// An argument outside the domain of a function. The message names the function, the argument, its
// value and the requirement, in one line: "Body: moments (1, 1, 3) break I3 <= I1 + I2".
class DomainError : public std::invalid_argument {
 public:
  explicit DomainError(const std::string& message) : std::invalid_argument(message) {}
};

}  // namespace v0
}  // namespace polhode
