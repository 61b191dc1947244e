// SPDX-License-Identifier: MIT
// The gravity gradient on a freely turning body as a Poisson series, and its Lie transform.
#pragma once

#include <vector>

#include "polhode/free/sadov.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/secular/gravity_gradient_theory.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/taylor_coefficient.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {

// A function of I_l, I_g and I_h about chosen values.
constexpr int action_degree = 3;
using ActionTaylor = series::TaylorCoefficient<double, 3, action_degree>;

struct ActionVariables {
  ActionTaylor I_l, I_g, I_h;
  explicit ActionVariables(const SadovState& at)
      : I_l(ActionTaylor::variable(0, at.I_l)),
        I_g(ActionTaylor::variable(1, at.I_g)),
        I_h(ActionTaylor::variable(2, at.I_h)) {}
};

// The momentum's axes have x along the node of the plane normal to it, y across, z along it. There
// the tensor of inertia, its trace taken off, is d0 = I_zz, d1 exp(i phi_g) = I_xz + i I_yz and
// d2 exp(2 i phi_g) = (I_xx - I_yy)/2 + i I_xy. d0, d1 and d2 turn with phi_l alone and depend on
// the ratio I_l / I_g alone.
//
// (re + i im) exp(i multiple phi_l) of d0, d1 or d2.
struct TensorWave {
  int multiple;
  ActionTaylor re, im;
};
struct TurningTensor {
  ActionTaylor energy;               // H_0
  std::vector<TensorWave> waves[3];  // of d0, d1, d2
};
// How far I_l / I_g is from the ends of its region: the separatrix, and spin about an axis.
double distance_in_region(const Body& body, const SadovState& at);
// Waves below `least` of the largest are left out.
TurningTensor turning_tensor(const Body& body, const SadovState& at, double least);

// c exp(i multiple M), c real.
struct OrbitWave {
  int multiple;
  double c;
};
// a^3/r^3 and a^3/r^3 exp(2 i f): Hansen's coefficients X(-3, 0) and X(-3, 2).
struct OrbitWaves {
  std::vector<OrbitWave> even, turning;
};
OrbitWaves orbit_waves(const Eccentricity& e, double least);

// 3 gm/(2 a^3) times a^3/r^3 n.I n, in phi_l, phi_g, phi_h and M, times k.
series::Series<ActionTaylor> gradient_series(const series::Symbols& symbols,
                                             const TurningTensor& tensor, const OrbitWaves& orbit,
                                             const SadovState& at, double strength);

// What is asked for, and the actions to expand about.
struct GravityGradientRequest {
  Body body;
  double gm;
  KeplerOrbit orbit;
  SadovState at;
  GravityGradientOptions options;
};
void require_valid(const GravityGradientRequest& request);

struct GravityGradientTransform {
  LieTransform<ActionTaylor> transform;
  std::size_t term_count;  // of the gravity gradient
  double largest_angle;    // by which a term of the first order moves an angle, rad
  double left_out;         // of the mean rates, rad per rad of rotation
};
// In the variables I_l, I_g, I_h and k, and the angles phi_l, phi_g, phi_h and M. k counts orders.
GravityGradientTransform transformed(const GravityGradientRequest& request);
series::Truncation gradient_orders(int order);

// What GravityGradientTheory says when it refuses.
[[noreturn]] void refuse_theory(const std::string& why);

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
