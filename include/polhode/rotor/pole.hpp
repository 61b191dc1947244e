// SPDX-License-Identifier: MIT
// Pole: the end of a polar angle that a chart is regular at.
//
// Domain      J or I near 0, or near pi.
// Accuracy    exact.
#pragma once

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

enum class Pole { zero, pi };

}  // namespace v0
}  // namespace polhode
