// SPDX-License-Identifier: MIT
// Equations of motion of Delaunay's and Kepler's elements in any gauge.
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/system/satellite_system.hpp"
#include "system/gauge.hpp"

namespace polhode {
inline namespace v0 {
namespace satellites {
namespace {

using polhode::detail::Convection;
using polhode::detail::convection_of;
using std::sqrt;

constexpr Vec3 unit_inertia{1.0, 1.0, 1.0};

std::string text_of(const OrbitalElements& C) {
  return polhode::detail::tuple_text({C[0], C[1], C[2], C[3], C[4], C[5]});
}
const char* name_of(OrbitalSet set) {
  return set == OrbitalSet::delaunay ? "Delaunay's elements" : "Keplerian elements";
}
[[noreturn]] void not_bound(const char* function, const std::string& got) {
  throw DomainError(std::string(function) + ": got " + got +
                    ", not a bound orbit; expected 0 <= e < 1 (L > 0, 0 < G <= L, |H| <= G of "
                    "Delaunay's set), or integrate the state (r, p)");
}

// A Kepler orbit as both sets describe it.
template <Real T>
struct Ellipse {
  T a, e, eta;  // eta = sqrt(1 - e^2)
  T cos_i, sin_i;
  T node, argument, mean_anomaly;
};
template <Real T>
Ellipse<T> ellipse_of(OrbitalSet set, double gm, const std::array<T, 6>& C) {
  using std::cos;
  using std::sin;
  const T one(1.0);
  const auto conjugate = [&](const T& x) { return sqrt((one - x) * (one + x)); };
  if (set == OrbitalSet::keplerian)
    return {C[0], C[1], conjugate(C[1]), cos(C[2]), sin(C[2]), C[3], C[4], C[5]};
  const T eta = C[4] / C[3], cos_i = C[5] / C[4];
  return {C[3] * C[3] / T(gm), conjugate(eta), eta, cos_i, conjugate(cos_i), C[2], C[1], C[0]};
}
bool is_bound(const Ellipse<double>& orbit) {
  return orbit.a > 0.0 && orbit.e >= 0.0 && orbit.e < 1.0 && orbit.eta > 0.0 &&
         std::isfinite(orbit.mean_anomaly) && std::fabs(orbit.cos_i) <= 1.0;
}

// E - e sin E = M: the root in double, and a step of Newton's method for derivatives.
template <Real T>
T eccentric_anomaly_of(const T& M, const T& e) {
  using std::cos;
  using std::sin;
  T E(eccentric_anomaly(to_double(M), Eccentricity::of(to_double(e))).anomaly);
  for (std::size_t k = 0; k < derivative_order<T>; ++k)
    E = E - (E - e * sin(E) - M) / (T(1.0) - e * cos(E));
  return E;
}

// Position and velocity.
template <Real T>
BasicSatelliteState<T> kepler_state(double gm, const Ellipse<T>& orbit) {
  using std::cos;
  using std::sin;
  const T E = eccentric_anomaly_of(orbit.mean_anomaly, orbit.e);
  const T cos_E = cos(E), sin_E = sin(E);
  const T speed = sqrt(T(gm) / orbit.a) / (T(1.0) - orbit.e * cos_E);
  const T co = cos(orbit.argument), so = sin(orbit.argument);
  const T cn = cos(orbit.node), sn = sin(orbit.node);
  const auto placed = [&](const T& x, const T& y) {
    const T along = co * x - so * y, across = so * x + co * y;
    const T level = orbit.cos_i * across;
    return BasicVec3<T>{cn * along - sn * level, sn * along + cn * level, orbit.sin_i * across};
  };
  return {placed(orbit.a * (cos_E - orbit.e), orbit.a * orbit.eta * sin_E),
          placed(-speed * sin_E, speed * orbit.eta * cos_E)};
}

SatelliteState unperturbed_state(OrbitalSet set, double gm, const OrbitalElements& C,
                                 const char* function) {
  const Ellipse<double> orbit = ellipse_of(set, gm, C);
  // L and G below zero would give the ellipse of those above
  const bool is_set = set == OrbitalSet::keplerian || C[3] > 0.0;
  if (!is_set || !is_bound(orbit))
    not_bound(function, std::string(name_of(set)) + " " + text_of(C));
  return kepler_state(gm, orbit);
}

OrbitalElements elements_of_orbit(OrbitalSet set, double gm, const Vec3& r, const Vec3& u) {
  const Vec3 momentum = cross(r, u);
  const double G = norm(momentum);
  const double a = 1.0 / (2.0 / norm(r) - dot(u, u) / gm);
  if (!(a > 0.0) || !std::isfinite(a) || !(G > 0.0))
    not_bound("elements_of_state", "the position " + polhode::detail::tuple_text({r.x, r.y, r.z}) +
                                       " and the velocity " +
                                       polhode::detail::tuple_text({u.x, u.y, u.z}));
  const KeplerElements k = KeplerOrbit::from_state(r, u, gm).elements();
  if (set == OrbitalSet::keplerian)
    return {a, k.eccentricity, k.inclination, k.node, k.argument, k.mean_anomaly};
  return {k.mean_anomaly, k.argument, k.node, sqrt(gm * a), G, momentum.z};
}

// Poisson brackets {C_i, C_j}: 1 for Delaunay's pairs, those of Lagrange's planetary equations for
// Keplerian elements.
Matrix6 poisson_brackets(OrbitalSet set, double gm, const OrbitalElements& C) {
  Matrix6 P;
  const auto put = [&P](int i, int j, double bracket) {
    P(i, j) = bracket;
    P(j, i) = -bracket;
  };
  if (set == OrbitalSet::delaunay) {
    for (int k = 0; k < 3; ++k) put(k, k + 3, 1.0);
    return P;
  }
  const Ellipse<double> orbit = ellipse_of(set, gm, C);
  const double L = sqrt(gm * orbit.a), G = L * orbit.eta;
  put(5, 0, 2.0 * L / gm);
  put(5, 1, orbit.eta * orbit.eta / (orbit.e * L));
  put(4, 1, -orbit.eta / (orbit.e * L));
  put(4, 2, orbit.cos_i / (G * orbit.sin_i));
  put(3, 2, -1.0 / (G * orbit.sin_i));
  return P;
}

// dC/d(r, u) = P B^T J^-1, B = d(r, u)/dC.
Matrix6 inverse_jacobian(OrbitalSet set, double gm, const OrbitalElements& C) {
  std::array<Tangent, 6> variables;
  for (std::size_t k = 0; k < 6; ++k) variables[k] = Tangent::variable(C[k], static_cast<int>(k));
  const BasicSatelliteState<Tangent> s = kepler_state(gm, ellipse_of(set, gm, variables));
  Matrix6 turned;  // B^T J^-1
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 3; ++k) {
      turned(i, k) = s.p[k].derivative[static_cast<std::size_t>(i)];
      turned(i, k + 3) = -s.r[k].derivative[static_cast<std::size_t>(i)];
    }
  const Matrix6 inverse = poisson_brackets(set, gm, C) * turned;
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();  // of sin(pi)
  const bool is_level = std::fabs(ellipse_of(set, gm, C).sin_i) < rounding;
  for (const auto& row : inverse.a)
    for (const double x : row)
      if (is_level || !std::isfinite(x))
        throw DomainError("element_rates: the rates of " + text_of(C) +
                          " do not exist: a singularity of " + name_of(set) +
                          " (e = 0, or i is 0 or pi); integrate the state (r, p) instead");
  return inverse;
}

// v = dH'/dp - mu x r.
template <Real T>
BasicVec3<T> convection(const SatelliteSystem& system, const T& t,
                        const BasicSatelliteState<T>& s) {
  return perturbation_rates(system, t, s).r;
}

// The derivative of v along (dt, dr, dp) by central differences of order 4 in double-double.
Vec3 convection_slope(const SatelliteSystem& system, double t, const SatelliteState& s, double dt,
                      const Vec3& dr, const Vec3& dp, double h) {
  using DD = DoubleDouble;
  const auto v = [&](double step) {
    const DD x(step);
    const auto moved = [&x](const Vec3& from, const Vec3& by) {
      return BasicVec3<DD>{DD(from.x) + x * DD(by.x), DD(from.y) + x * DD(by.y),
                           DD(from.z) + x * DD(by.z)};
    };
    return convection<DD>(system, DD(t) + x * DD(dt), {moved(s.r, dr), moved(s.p, dp)});
  };
  const BasicVec3<DD> near = v(h) - v(-h), far = v(2.0 * h) - v(-2.0 * h);
  const BasicVec3<DD> slope = (DD(1.0) / DD(12.0 * h)) * (DD(8.0) * near - far);
  return {to_double(slope.x), to_double(slope.y), to_double(slope.z)};
}

// Solves p + v(t, r, p) = dr/dt for p by Newton's method.
Vec3 canonical_momentum(const SatelliteSystem& system, double t, const Vec3& r,
                        const Vec3& velocity) {
  constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
  SatelliteState s{r, velocity};
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 50; ++step) {
    const Vec3 v = convection(system, t, s);
    const Vec3 missing = velocity - s.p - v;
    const double size = norm(velocity) + norm(s.p) + norm(v);
    if (std::isnan(size)) return missing;
    if (norm(missing) <= rounding * size && !(norm(missing) < last)) return s.p;
    if (norm(missing) == 0.0) return s.p;
    last = norm(missing);
    const double h = std::ldexp(1.0, -30) * (size > 0.0 ? size : 1.0);
    std::array<Vec3, 3> columns;
    for (int j = 0; j < 3; ++j) {
      Vec3 unit;
      unit[j] = 1.0;
      columns[static_cast<std::size_t>(j)] =
          unit + convection_slope(system, t, s, 0.0, {}, unit, h);
    }
    s.p = s.p + polhode::detail::solve_columns(columns, missing);
  }
  throw DomainError("element_state: no canonical momentum found for the velocity " +
                    polhode::detail::tuple_text({velocity.x, velocity.y, velocity.z}) +
                    ": dH'/dp changes too fast with the momentum");
}

}  // namespace

SatelliteState element_state(const SatelliteSystem& system, double t,
                             const OrbitalElements& elements, OrbitalSet set,
                             const rates::Gauge& gauge) {
  const SatelliteState free = unperturbed_state(set, system.gm(), elements, "element_state");
  if (gauge.is_canonical()) return free;
  const Vec3 velocity = free.p + convection_of(gauge, elements, t).value;
  return {free.r, canonical_momentum(system, t, free.r, velocity)};
}

OrbitalElements elements_of_state(const SatelliteSystem& system, double t,
                                  const SatelliteState& canonical, OrbitalSet set,
                                  const rates::Gauge& gauge) {
  const double gm = system.gm();
  const auto elements = [&](const Vec3& u) { return elements_of_orbit(set, gm, canonical.r, u); };
  if (gauge.is_canonical()) return elements(canonical.p);
  const Vec3 velocity = satellite_rates(system, t, canonical).r;
  return elements(polhode::detail::unperturbed_momentum(
      gauge, t, unit_inertia, velocity, elements,
      [&](const Vec3& u) { return inverse_jacobian(set, gm, elements(u)); }));
}

Vec3 element_convective_term(const SatelliteSystem& system, double t,
                             const OrbitalElements& elements, OrbitalSet set,
                             const rates::Gauge& gauge) {
  const SatelliteState free =
      unperturbed_state(set, system.gm(), elements, "element_convective_term");
  return gauge.is_canonical() ? convection(system, t, free)
                              : convection_of(gauge, elements, t).value;
}

OrbitalElements element_rates(const SatelliteSystem& system, double t,
                              const OrbitalElements& elements, OrbitalSet set,
                              const rates::Gauge& gauge) {
  const SatelliteState free = unperturbed_state(set, system.gm(), elements, "element_rates");
  const Matrix6 inverse = inverse_jacobian(set, system.gm(), elements);
  const SatelliteState state = element_state(system, t, elements, set, gauge);
  const SatelliteState added = perturbation_rates(system, t, state);
  // not the rates of (p, -gm r/r^3), which cancel but for the mean motion
  OrbitalElements mean_motion{};
  const double a = ellipse_of(set, system.gm(), elements).a;
  mean_motion[set == OrbitalSet::delaunay ? 0 : 5] = sqrt(system.gm() / a) / a;
  if (gauge.is_canonical())
    return polhode::detail::gauge_rates(gauge, unit_inertia, elements, {}, inverse, mean_motion,
                                        added.r, added.p);
  const Convection phi = convection_of(gauge, elements, t);
  const SatelliteState rate = satellite_rates(system, t, state);
  const double fastest = norm(free.p) / norm(free.r) + norm(system.frame().at(t).mu_S);
  const Vec3 dv =
      convection_slope(system, t, state, 1.0, rate.r, rate.p, std::ldexp(1.0, -30) / fastest);
  return polhode::detail::gauge_rates(gauge, unit_inertia, elements, phi, inverse, mean_motion,
                                      phi.value, added.p + dv);
}

}  // namespace satellites
}  // namespace v0
}  // namespace polhode
