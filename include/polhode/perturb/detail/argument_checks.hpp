// SPDX-License-Identifier: MIT
// What the constructors of terms refuse, as a DomainError.
#pragma once

#include "polhode/math/vector.hpp"
#include "polhode/shape/mass_properties.hpp"

namespace polhode {
inline namespace v0 {
class AnyOrbit;
struct Oblateness;
struct TidalBody;
namespace detail {

void require_gravity(double gm);
void require_higher_gravity(double gm, const shape::MassMoments& moments);
// gm J2 R^2.
double checked_strength(double gm, const Oblateness& of);
// 3 k2 gm M R^5 lag.
double tidal_strength(double gm, double mass, const TidalBody& of);
void require_velocity(const AnyOrbit& orbit);
void require_dipole(const Vec3& m_B);
Mat3 checked_magnetic_tensor(const Mat3& M_B);
void require_field_rate(bool has_rate);
[[noreturn]] void field_without_rate();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
