// SPDX-License-Identifier: MIT
// Normal form of the free triaxial rotor, from the axisymmetric one: actions, frequencies and the
// maps between mean and osculating Andoyer variables as series in the triaxiality.
//
// Equations   H = (G^2 - L^2)/2 (sin^2 l/A + cos^2 l/B) + L^2/(2 C) [SA 3.2] is a G^2/2 + b h with
//             h = -L^2/2 - e/2 (G^2 - L^2) cos 2l, a = (1/A + 1/B)/2, b = a - 1/C and the
//             triaxiality e = (1/A - 1/B)/(2 b): one series for all bodies. A Lie transform removes
//             l, exactly in rationals. The mean L and G are Sadov's actions I_l and I_g, the mean
//             angles his phi_l + pi/2 and phi_g [SA 5].
// Units       those of the body and the state.
// Domain      short-axis rotation of a body with its axes sorted, A <= B < C; order 1 to 16. The
//             series converge as those of 1/(1 - r): from osculating variables r = e (G^2 + (G^2 -
//             L^2) |cos 2l|)/L^2, from mean ones r = e (2 - k)/k, k = sin^2(pi L/(2 G)), which is 1
//             on the separatrix. NaN where r >= 1, and at L = 0.
// Accuracy    error r^(order + 1) of the maps, the next even power of frequencies and energy
//             (tests/unit/secular/triaxial_normal_form.cpp). mean_error, osculating_error and
//             frequency_error estimate it by the last terms: rad, parts of G, relative.
// Errors      DomainError for moments that are not sorted, or C no larger than B; for the order;
//             for the mean of a state in long-axis mode.
// Cost        to make: 14 ms at order 8, 50 at 10; then 1 us for frequencies, some for a map
//             (benchmarks/perturbation_theory.cpp).
#pragma once

#include <span>

#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/series/compiled_series.hpp"
#include "polhode/series/series.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {

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
  const series::Series<series::Rational>& series() const { return series_; }

  // Of mean L and G.
  double energy(double L, double G) const;
  RotorFrequencies frequencies(double L, double G) const;

  AndoyerState mean(const AndoyerState& osculating) const;
  AndoyerState osculating(const AndoyerState& mean) const;

  // What the truncation of the series leaves, estimated.
  double mean_error(const AndoyerState& osculating) const;
  double osculating_error(const AndoyerState& mean) const;
  double frequency_error(double L, double G) const;

 private:
  // A series, and its parts of the two highest orders.
  struct Expansion {
    series::CompiledSeries sum, last, last_but_one;
    double remainder(std::span<const double> at, double ratio) const;
  };
  struct Map {
    Expansion l, g, L;
  };
  struct Parts;
  TriaxialNormalForm(const Body& body, const Parts& parts);
  AndoyerState displaced(const AndoyerState& s, const Map& by, double ratio) const;
  double remainder(const AndoyerState& s, const Map& of, double ratio) const;
  double ratio_of_osculating(const AndoyerState& s) const;
  double ratio_of_mean(double L, double G) const;

  double a_, b_, e_;
  series::Series<series::Rational> series_;
  series::CompiledSeries h_;
  Expansion dh_dL_, dh_dG_;
  Map to_mean_, to_osculating_;
};

}  // namespace secular
}  // namespace v0
}  // namespace polhode
