// SPDX-License-Identifier: MIT
// The YORP effect: the torque of sunlight on a body that spins about one of its axes, averaged over
// its rotation and its orbit.
//
// Equations   the law of light of FacetStream averaged over rotation (in closed form: each facet is
//             lit for one arc of a turn) and over the orbit (numerically). On an ellipse the mean
//             of 1 / r^2 is 1 / (a^2 sqrt(1 - e^2)), and the mean over time with that weight is
//             one over the true anomaly: the eccentricity enters through the mean pressure alone.
//             Torque along the spin axis s; along the direction in which the obliquity grows, (cos
//             o s - N) / sin o, N the normal of the orbit; along s x N / sin o. Then C dw/dt =
//             spin, C w do/dt = obliquity, C w sin o dpsi/dt = precession (Vokrouhlicky & Capek
//             2002). With diffuse = 1, or emitted = 1, this is Rubincam's (2000) model without
//             thermal inertia, and the normal emission of Scheeres (2007). A series in Legendre's
//             polynomials of cos o (Breiter & Michalska 2008) is its oracle in the tests.
// Units       surface in length; torque per pressure is length^3. Angles in rad.
// Domain      any surface along any axes, spin about `axis` of it; any obliquity. Facets do not
//             shade each other: for concave bodies the result is that of a body that is
//             transparent to its own light. The rotation is taken as fast against the orbit and
//             not in resonance with it.
// Accuracy    budgets yorp_quadrature, yorp_series, relative to area times size.
// Errors      DomainError for an axis without direction, numbers that are not finite, an orbit that
//             is no ellipse.
// Cost        some 8 us per facet and obliquity (benchmarks/surface.cpp).
#pragma once

#include "polhode/detail/perturb/facet_stream.hpp"
#include "polhode/perturb/solar_pressure.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

struct YorpTorque {
  double spin;
  double obliquity;
  double precession;

  constexpr bool operator==(const YorpTorque&) const = default;
};

// At mean pressure 1.
YorpTorque yorp_torque(const Surface& surface, double obliquity, const Vec3& axis = {0, 0, 1});

// P d^2 / (a^2 sqrt(1 - e^2)): what to multiply it with.
double mean_pressure(const Sunlight& light, double semi_major_axis, double eccentricity);

}  // namespace secular
}  // namespace v0
}  // namespace polhode
