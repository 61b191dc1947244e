// SPDX-License-Identifier: MIT
// Shared by the gauges of rotational and orbital elements: the convective term of a user's
// function, and the linear system of the rates to which it leads.
//
// The unperturbed motion through the present position q has the momentum gamma = y - I Phi(C, t),
// with y the momentum of the true velocity and I the inertia by which velocities are multiplied.
// With B^-1 = dC/d(q, gamma): dC/dt = B^-1 (dq/dt, dy/dt - I (dPhi/dt + dPhi/dC dC/dt)).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/system/element_rates.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

using ElementNumbers = std::array<double, 6>;

inline Vec3 by_inertia(const Vec3& I, const Vec3& x) { return {I.x * x.x, I.y * x.y, I.z * x.z}; }

inline ElementNumbers tangent(const Vec3& position, const Vec3& momentum) {
  return {position.x, position.y, position.z, momentum.x, momentum.y, momentum.z};
}

inline double determinant(const std::array<Vec3, 3>& columns) {
  return dot(columns[0], cross(columns[1], columns[2]));
}

// x with x_0 columns[0] + x_1 columns[1] + x_2 columns[2] = right, by Cramer's rule.
template <Real T>
BasicVec3<T> solve_columns(const std::array<Vec3, 3>& columns, const BasicVec3<T>& right) {
  const auto& [a, b, c] = columns;
  const double det = determinant(columns);
  const auto along = [&](const Vec3& normal) {
    return (right.x * T(normal.x) + right.y * T(normal.y) + right.z * T(normal.z)) / T(det);
  };
  return {along(cross(b, c)), along(cross(c, a)), along(cross(a, b))};
}

// Phi with its derivatives; 0 for the osculating gauge.
struct Convection {
  Vec3 value;
  std::array<Vec3, 6> by_elements;
  Vec3 by_time;
};
inline Convection convection_of(const rates::Gauge& gauge, const ElementNumbers& z, double t) {
  if (!gauge.phi()) return {};
  rates::Gauge::Elements C;
  for (std::size_t k = 0; k < 6; ++k) C[k] = Tangent::variable(z[k], static_cast<int>(k));
  const BasicVec3<Tangent> phi = gauge.phi()(C, Tangent(t));
  Convection out{{phi.x.value, phi.y.value, phi.z.value}, {}, {}};
  for (std::size_t k = 0; k < 6; ++k) {
    out.by_elements[k] = {phi.x.derivative[k], phi.y.derivative[k], phi.z.derivative[k]};
    C[k] = Tangent(z[k]);
  }
  const BasicVec3<Tangent> later = gauge.phi()(C, Tangent::variable(t, 0));
  out.by_time = {later.x.derivative[0], later.y.derivative[0], later.z.derivative[0]};
  return out;
}

// 1 + I dPhi/dC dC/dgamma, by columns.
class GaugeMatrix {
 public:
  GaugeMatrix(const Vec3& I, const Convection& phi, const Matrix6& inverse) {
    for (int j = 0; j < 3; ++j) {
      Vec3 sum;
      for (int k = 0; k < 6; ++k)
        sum = sum + inverse(k, j + 3) * phi.by_elements[static_cast<std::size_t>(k)];
      Vec3& column = columns_[static_cast<std::size_t>(j)];
      column = by_inertia(I, sum);
      size_ = std::fmax(size_, norm(column));
      column[j] += 1.0;
    }
  }
  bool is_singular() const {
    const double scale = 1.0 + size_;
    return !(std::fabs(determinant(columns_)) > 1e-12 * scale * scale * scale);
  }
  Vec3 solved(const Vec3& right) const { return solve_columns(columns_, right); }

 private:
  std::array<Vec3, 3> columns_{};
  double size_ = 0.0;
};

[[noreturn]] inline void singular_gauge(const std::string& function, const ElementNumbers& z) {
  throw DomainError(function + ": the gauge function Phi at the elements " +
                    tuple_text({z[0], z[1], z[2], z[3], z[4], z[5]}) +
                    " leaves the linear system of their rates singular; choose a Phi that depends "
                    "less on the elements, or the canonical or osculating gauge");
}

// dC/dt of elements z: the rates of the unperturbed motion, and those caused by additions to it,
// `velocity` to dq/dt and `force` to dy/dt.
inline ElementNumbers gauge_rates(const rates::Gauge& gauge, const Vec3& I, const ElementNumbers& z,
                                  const Convection& phi, const Matrix6& inverse,
                                  const ElementNumbers& unperturbed, const Vec3& velocity,
                                  const Vec3& force) {
  ElementNumbers rates = inverse * tangent(velocity, force - by_inertia(I, phi.by_time));
  for (std::size_t k = 0; k < 6; ++k) rates[k] += unperturbed[k];
  if (!gauge.phi()) return rates;
  // (1 + B^-1 (0, I dPhi/dC)) dC/dt = rates, of rank 3
  const GaugeMatrix S(I, phi, inverse);
  if (S.is_singular()) singular_gauge("element_rates", z);
  Vec3 moved;
  for (std::size_t k = 0; k < 6; ++k) moved = moved + rates[k] * phi.by_elements[k];
  const ElementNumbers back = inverse * tangent({}, S.solved(by_inertia(I, moved)));
  for (std::size_t k = 0; k < 6; ++k) rates[k] -= back[k];
  return rates;
}

// The momentum gamma with gamma + I Phi(C(gamma), t) = y, by Newton's method. `numbers_of(gamma)`
// gives the elements, `inverse_of(gamma)` B^-1.
template <class NumbersOf, class InverseOf>
Vec3 unperturbed_momentum(const rates::Gauge& gauge, double t, const Vec3& I, const Vec3& y,
                          const NumbersOf& numbers_of, const InverseOf& inverse_of) {
  Vec3 gamma = y;
  if (!gauge.phi()) return gamma;
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 50; ++step) {
    const ElementNumbers z = numbers_of(gamma);
    const Convection phi = convection_of(gauge, z, t);
    const Vec3 missing = y - gamma - by_inertia(I, phi.value);
    if (!(norm(missing) < last)) {
      const double size = norm(y) + norm(gamma);
      // as near as rounding lets it come; a step that went astray is no solution
      if (std::isnan(norm(missing)) || last <= 1e-8 * size) return gamma;
      break;
    }
    last = norm(missing);
    const GaugeMatrix S(I, phi, inverse_of(gamma));
    if (S.is_singular()) singular_gauge("elements_of_state", z);
    gamma = gamma + S.solved(missing);
  }
  throw DomainError(
      "elements_of_state: no elements found for the gauge function Phi, nearest misses by " +
      number_text(last) + ": Phi changes too fast with the elements");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
