// SPDX-License-Identifier: MIT
// The version of polhode. These three numbers are its only source: CMake reads them from here.
//
// Domain      semantic versioning; while the major number is 0, a minor number may break the API.
#pragma once

#if __cplusplus < 202002L
#error "polhode needs C++20: compile with -std=c++20 or later"
#endif

#define POLHODE_VERSION_MAJOR 0
#define POLHODE_VERSION_MINOR 1
#define POLHODE_VERSION_PATCH 0

namespace polhode {
inline namespace v0 {

// "MAJOR.MINOR.PATCH" of the library that was linked (the macros tell which headers were included).
const char* version() noexcept;

}  // namespace v0
}  // namespace polhode
