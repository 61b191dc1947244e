// SPDX-License-Identifier: MIT
// Normal form of the free triaxial rotor, from the axisymmetric one: actions, frequencies and the
// maps between mean and osculating Andoyer variables as series in the triaxiality.
//
// Equations   H = (G^2 - L^2)/2 (sin^2 l/A + cos^2 l/B) + L^2/(2 C) [SA 3.2] is a G^2/2 + b h with
//             h = -L^2/2 - e/2 (G^2 - L^2) cos 2l, a = (1/A + 1/B)/2, b = a - 1/C and the
//             triaxiality e = (1/A - 1/B)/(2 b): one series for all bodies. A Lie transform removes
//             l, exactly in rationals. The mean L and G are Sadov's actions I_l and I_g, the mean
//             angles his phi_l + pi/2 and phi_g [SA 5].
// Corrections none.
// Units       those of the body and the state.
// Domain      short-axis rotation of a body with its axes sorted, A <= B < C; order 1 to 16. Series
//             in e (G^2 - L^2)/L^2: for small J, well inside the separatrix. L = 0 gives NaN.
// Accuracy    error e^(order + 1) of the maps, the next even power of frequencies and energy, times
//             powers of tan J (tests/unit/secular/triaxial_normal_form.cpp).
// Errors      DomainError for moments that are not sorted, or C no larger than B; for the order.
// Cost        to make: 14 ms at order 8, 50 at 10; then 1 us for frequencies, some for a map
//             (benchmarks/perturbation_theory.cpp).
#pragma once

#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/series/compiled_series.hpp"
#include "polhode/series/rational.hpp"
#include "polhode/series/series.hpp"

namespace polhode {
inline namespace v0 {

struct RotorFrequencies {
  double n_l, n_g;

  bool operator==(const RotorFrequencies&) const = default;
};

class TriaxialNormalForm {
 public:
  TriaxialNormalForm(const Body& body, int order);

  // e.
  double triaxiality() const { return e_; }
  // h in mean variables L, G and e: the same of every body.
  const Series<Rational>& series() const { return series_; }

  // Of mean L and G.
  double energy(double L, double G) const;
  RotorFrequencies frequencies(double L, double G) const;

  AndoyerState mean(const AndoyerState& osculating) const;
  AndoyerState osculating(const AndoyerState& mean) const;

 private:
  struct Map {
    CompiledSeries l, g, L;
  };
  struct Parts;
  TriaxialNormalForm(const Body& body, const Parts& parts);
  AndoyerState displaced(const AndoyerState& s, const Map& by) const;

  double a_, b_, e_;
  Series<Rational> series_;
  CompiledSeries h_, dh_dL_, dh_dG_;
  Map to_mean_, to_osculating_;
};

}  // namespace v0
}  // namespace polhode
