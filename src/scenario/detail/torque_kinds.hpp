// SPDX-License-Identifier: MIT
// The kinds of [[perturbation]] that polhode has: one source of kinds/torques/ each. A new one is a
// source there, a line here and one in kinds.cpp.
#pragma once

#include "polhode/scenario/perturbation_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

PerturbationKind gravity_gradient_kind();
PerturbationKind constant_torque_kind();
PerturbationKind damping_kind();
PerturbationKind tide_kind();
PerturbationKind internal_damping_kind();
PerturbationKind anelastic_damping_kind();
PerturbationKind torque_table_kind();
PerturbationKind solar_pressure_kind();
PerturbationKind drag_kind();
PerturbationKind residual_dipole_kind();
PerturbationKind eddy_currents_kind();
PerturbationKind kane_damper_kind();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
