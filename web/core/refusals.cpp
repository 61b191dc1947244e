// SPDX-License-Identifier: MIT
#include "refusals.hpp"

#include <string>

#include "polhode_web.h"

namespace polhode::web {
namespace {

std::string& last() {
  static std::string sentence;
  return sentence;
}

}  // namespace

void keep_refusal(std::string_view sentence) { last() = sentence; }

}  // namespace polhode::web

const char* polhode_refusal() { return polhode::web::last().c_str(); }

#if defined(__EMSCRIPTEN__)
// What the C++ runtime says before it gives up; with its printf it would be a tenth of the module.
extern "C" [[noreturn]] void abort_message(const char* /*format*/, ...) { __builtin_trap(); }
#endif
