// SPDX-License-Identifier: MIT
// What most programs need: bodies, states and their conversions, free rotation, frames, orbits,
// terms, systems, methods, runs. Everything else has headers of its own.
//
// Units       any consistent units: the library is scale-free. Angles in radians.
// Errors      DomainError, from constructors and factories only.
// Cost        compile time: about 1.2 times that of the standard headers that it includes.
#pragma once

#include "polhode/dynamics/event.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/dynamics/problem.hpp"
#include "polhode/error.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/fukushima_ishizaki.hpp"
#include "polhode/free/kinoshita.hpp"
#include "polhode/free/propagate.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/kane_damper.hpp"
#include "polhode/perturb/magnetic_field.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/perturb/tidal_torque.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "polhode/shape/surface.hpp"
#include "polhode/system/system.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"
#include "polhode/version.hpp"
