// SPDX-License-Identifier: MIT
#include "polhode/version.hpp"

#define POLHODE_TEXT_OF(x) #x
#define POLHODE_TEXT(x) POLHODE_TEXT_OF(x)

namespace polhode {
inline namespace v0 {

const char* version() noexcept {
  return POLHODE_TEXT(POLHODE_VERSION_MAJOR) "." POLHODE_TEXT(
      POLHODE_VERSION_MINOR) "." POLHODE_TEXT(POLHODE_VERSION_PATCH);
}

}  // namespace v0
}  // namespace polhode
