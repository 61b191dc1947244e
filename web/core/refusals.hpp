// SPDX-License-Identifier: MIT
// What the library refuses, said through an interface that knows no exceptions.
#pragma once

#include <exception>
#include <string_view>

namespace polhode::web {

// Kept until the next refusal: polhode_refusal().
void keep_refusal(std::string_view sentence);

inline constexpr int done = 0, refused = 1;

// Calls it; whether it was refused.
template <class F>
int guarded(const F& call) {
  try {
    call();
    return done;
  } catch (const std::exception& error) {
    keep_refusal(error.what());
    return refused;
  }
}

}  // namespace polhode::web
