// SPDX-License-Identifier: MIT
// Tolerances of tests: how bright a body looks.
#pragma once

namespace polhode::budget {}  // namespace polhode::budget
