// SPDX-License-Identifier: MIT
// Derivatives of the canonical charts by central differences of the conversions at 100 digits: they
// share no line with the Jacobians of the library.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "property/chart_support.hpp"

namespace chart_test {

using Wide = boost::multiprecision::cpp_bin_float_100;
using WideNumbers = std::array<Wide, 6>;
using WideState = polhode::BasicRotorState<Wide>;

inline WideState widened(const RotorState& s) {
  return {{Wide(s.q.w), Wide(s.q.x), Wide(s.q.y), Wide(s.q.z)},
          {Wide(s.g.x), Wide(s.g.y), Wide(s.g.z)}};
}
inline WideNumbers widened(const Numbers& n) {
  return {Wide(n[0]), Wide(n[1]), Wide(n[2]), Wide(n[3]), Wide(n[4]), Wide(n[5])};
}

inline WideNumbers from_hub(const polhode::CanonicalChart& c, const WideState& s) {
  if (c.set == CanonicalSet::euler) {
    const auto e = to_euler(s);
    return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
  }
  if (c.set == CanonicalSet::andoyer) {
    const auto a = to_andoyer(s);
    return {a.l, a.g, a.h, a.L, a.G, a.H};
  }
  const auto p = to_poincare(s, c.pole_J, c.pole_I);
  return {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2};
}
inline WideState to_hub(const polhode::CanonicalChart& c, const WideNumbers& n) {
  if (c.set == CanonicalSet::euler) {
    return to_rotor(polhode::BasicEulerState<Wide>{n[0], n[1], n[2], n[3], n[4], n[5]});
  }
  if (c.set == CanonicalSet::andoyer) {
    return to_rotor(polhode::BasicAndoyerState<Wide>{n[0], n[1], n[2], n[3], n[4], n[5]});
  }
  return to_rotor(
      polhode::BasicPoincareState<Wide>{n[0], n[1], n[2], n[3], n[4], n[5], c.pole_J, c.pole_I});
}

// d(dtheta_B, dg_B) of a conversion f at n
template <class F>
Matrix6 differences(F f, const WideNumbers& n) {
  const Wide h("1e-45");
  Matrix6 B;
  for (int j = 0; j < 6; ++j) {
    WideNumbers up = n, down = n;
    up[static_cast<std::size_t>(j)] += h;
    down[static_cast<std::size_t>(j)] -= h;
    const WideState a = f(down), b = f(up);
    const auto turn = conj(normalized(a.q)) * normalized(b.q);  // 1 + dtheta_B h
    const Wide column[6] = {turn.x / h,
                            turn.y / h,
                            turn.z / h,
                            (b.g.x - a.g.x) / (2 * h),
                            (b.g.y - a.g.y) / (2 * h),
                            (b.g.z - a.g.z) / (2 * h)};
    for (int i = 0; i < 6; ++i) B(i, j) = static_cast<double>(column[i]);
  }
  return B;
}

// At the numbers of the chart that a state has.
inline Matrix6 wide_jacobian(const polhode::CanonicalChart& c, const RotorState& s) {
  return differences([&](const WideNumbers& n) { return to_hub(c, n); }, from_hub(c, widened(s)));
}

}  // namespace chart_test
