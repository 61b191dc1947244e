// SPDX-License-Identifier: MIT
// What a handle of a motion points to.
#pragma once

#include "polhode/free/free_rotation.hpp"
#include "polhode_web.h"

struct polhode_motion {
  polhode::FreeRotation rotation;
};
