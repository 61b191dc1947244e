// SPDX-License-Identifier: MIT
// Every public header of polhode::polhode. polhode::io has its own (polhode/io/...).
//
// Equations   none.
// Units       any consistent units: the library is scale-free. Angles in radians.
// Domain      see each header.
// Accuracy    see each header.
// Errors      DomainError, from constructors and factories only.
// Cost        compile time; include the headers you use instead where that matters.
#pragma once

#include "polhode/error.hpp"
#include "polhode/math/matrix6.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "polhode/version.hpp"
