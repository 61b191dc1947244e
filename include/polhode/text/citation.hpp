// SPDX-License-Identifier: MIT
// Citation: a work that something rests on, and what is taken from it.
//
// Equations   none.
// Units       none.
// Domain      none.
// Accuracy    none.
// Errors      none.
// Cost        none.
#pragma once

#include <string>

namespace polhode {
inline namespace v0 {

struct Citation {
  std::string key;     // "sadov1970"
  std::string text;    // authors, year, title, place
  std::string reason;  // what is taken from it
};

}  // namespace v0
}  // namespace polhode
