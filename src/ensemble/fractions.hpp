// SPDX-License-Identifier: MIT
// Fractions: which part of the members is in each of several classes: regimes of free rotation, yes
// or no of an indicator.
//
// Equations   Wilson's interval of a part k of n at z deviations: (k + z^2/2 -+ z sqrt(k (n - k)/n
//             + z^2/4))/(n + z^2).
// Domain      classes 0 to size - 1, which the caller names; those of regimes are the numbers of
//             the enum. A member without a class is left out and named.
// Accuracy    exact, in any order.
// Errors      DomainError for a class that is not there, a size outside 1 to 1e6, z below 0, and as
//             an Accumulator. Of no member fractions are NaN.
// Cost        one number a class.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "polhode/ensemble/bins.hpp"
#include "polhode/free/free_rotation.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

class Fractions {
 public:
  explicit Fractions(int size);
  static Fractions of_regimes() { return Fractions(static_cast<int>(Regime::separatrix) + 1); }

  void add(std::int64_t member, int in_class);
  void add(std::int64_t member, Regime regime) { add(member, static_cast<int>(regime)); }
  void leave_out(std::int64_t member) { left_out_.add(member); }
  void merge(const Fractions& later);

  int size() const { return static_cast<int>(counts_.size()); }
  std::int64_t count() const;  // without those left out
  std::int64_t count(int in_class) const;
  const LeftOut& left_out() const { return left_out_; }

  double fraction(int of_class) const;
  double fraction(Regime regime) const { return fraction(static_cast<int>(regime)); }
  // Where the part lies among what the members are drawn from, but for z deviations of chance.
  Bounds interval(int of_class, double z) const;

  std::vector<double> numbers() const;
  Fractions restored(std::span<const double> numbers) const;

 private:
  std::vector<std::int64_t> counts_;
  LeftOut left_out_;
};

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
