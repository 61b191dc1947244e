// SPDX-License-Identifier: MIT
// The laws of the library's own terms, and what each source of this folder instantiates.
#pragma once

#include "polhode/detail/perturb/facet_stream.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/detail/law_on_stages.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/perturb/tidal_torque.hpp"

#define POLHODE_EACH_LAW(DO) \
  DO(GravityGradientLaw)     \
  DO(HigherGravityLaw)       \
  DO(OblateGravityLaw)       \
  DO(GivenTorqueLaw)         \
  DO(LinearDampingLaw)       \
  DO(InternalDampingLaw)     \
  DO(TidalTorqueLaw)         \
  DO(ResidualDipoleLaw)      \
  DO(EddyCurrentsLaw)        \
  DO(FacetStream::Law)
// Those that give their numbers from vectors, and from how many.
#define POLHODE_EACH_LAW_OF_VECTORS(DO) \
  DO(GravityGradientLaw, 1)             \
  DO(TidalTorqueLaw, 2)                 \
  DO(ResidualDipoleLaw, 1)              \
  DO(EddyCurrentsLaw, 2)
#define POLHODE_VECTORS_IN_LANES(isa, LAW, VECTORS)                                  \
  template void vectors_on_stages<InstructionSet::isa, LAW, VECTORS>(const LAW& law, \
                                                                     const VectorsOfTime& rows);
#define POLHODE_LAW_IN_LANES(isa, LAW)                   \
  template void law_on_stages<InstructionSet::isa, LAW>( \
      const LAW& law, std::span<const double> sides, const LawRows& rows);
