// SPDX-License-Identifier: MIT
// Jacobi's functions of many arguments, one instantiation in src/elliptic/lanes for each set of
// instructions.
#pragma once

#include <cstddef>

#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {

// Columns of as many numbers as there are arguments; m and m1 of one where there is one modulus.
struct JacobiColumns {
  const double *u, *m, *m1;
  double *sn, *cn, *dn;
};

template <InstructionSet isa, bool one_modulus>
void jacobi_in_lanes(const JacobiColumns& columns, std::size_t count);

// One by one: any argument, any modulus.
void jacobi_alone(double u, double m, double m1, double& sn, double& cn, double& dn);

}  // namespace detail
}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
