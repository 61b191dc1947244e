// SPDX-License-Identifier: MIT
// Names what a scenario holds after its checks, for headers that refer to it.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct Value;
struct FileValues;
// By path as the file has it: "body.moments", "orbit.moon.period", "perturbation[0].kind". Tables
// have an entry too.
using Values = std::map<std::string, Value, std::less<>>;

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
