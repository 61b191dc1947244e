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

#include "polhode/dynamics/event.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/carlson_rf_rd.hpp"
#include "polhode/elliptic/heuman.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/elliptic/nome.hpp"
#include "polhode/error.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/free/cayley_klein.hpp"
#include "polhode/free/free_kernel.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/math/error_free.hpp"
#include "polhode/math/matrix6.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/trigonometry.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/orbit/kepler_equation.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/orbit.hpp"
#include "polhode/orbit/planar_kepler.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/effect.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "polhode/rotor/polar_factor.hpp"
#include "polhode/rotor/rate_jacobian.hpp"
#include "polhode/rotor/rotor_state.hpp"
#include "polhode/system/system.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"
#include "polhode/version.hpp"
