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
