// SPDX-License-Identifier: MIT
// A rotor with an Extra, which is carried along its motion: tangent vectors, integrals. One state
// of a run, and one array of numbers for Adaptive and Collocation.
#pragma once

#include <algorithm>
#include <array>

#include "dynamics/adaptive/rotor_field.hpp"

namespace polhode {
inline namespace v0 {

template <class Extra>
struct Augmented {
  RotorState rotor;
  Extra extra;

  constexpr bool operator==(const Augmented&) const = default;
};

template <class Extra, class Visit>
void each_number(Augmented<Extra>& s, Visit&& visit) {
  each_number(s.rotor, visit);
  each_number(s.extra, visit);
}

namespace detail {

template <std::size_t N>
RotorValues<double> rotor_at(const std::array<double, N>& y, std::size_t first = 0) {
  RotorValues<double> r{};
  std::copy_n(y.begin() + static_cast<std::ptrdiff_t>(first), 7, r.begin());
  return r;
}

// The common part of fields of a rotor with `more` numbers after it. A field adds
//   State state(y)                           what all numbers stand for
//   double error_size(error, y, increment)   the measure of an error, in all numbers
// and for the methods that carry it
//   Values operator()(t, y, sides) const     Adaptive: the rates of all numbers
//   const RotorJacobian& jacobian() const    Collocation: of its columns (variational_stages.hpp)
//   rescale(CompensatedState&) const         Collocation: rescales columns after a step
template <class S, std::size_t more>
class AugmentedField {
 public:
  using Number = double;
  using Values = std::array<double, 7 + more>;
  using State = S;

  explicit AugmentedField(const System& system) : rotor_(system) {}

  const System& system() const { return rotor_.system(); }
  const RotorField<double>& rotor_alone() const { return rotor_; }
  // The field that names the term of a failed step.
  const RotorField<double>& watched() const { return rotor_; }
  static RotorState rotor(const Values& y) { return rounded(rotor_state<double>(y)); }
  // q is not normalised here, because its columns would have to be as well.
  static void settle(CompensatedState<double, 7 + more>&) {}

 private:
  RotorField<double> rotor_;
};

// A rotor with derivatives by six variables as plain numbers: behind the rotor the six derivatives
// of each number in turn, as NumberLanes multiply them.
using ColumnValues = std::array<double, 49>;

constexpr std::size_t column_place(std::size_t number, std::size_t column) {
  return 7 + 6 * number + column;
}
inline ColumnValues column_values(const RotorValues<Tangent>& x) {
  ColumnValues y;
  for (std::size_t n = 0; n < 7; ++n) {
    y[n] = x[n].value;
    std::copy_n(x[n].derivative.begin(), 6, y.begin() + column_place(n, 0));
  }
  return y;
}
inline RotorValues<Tangent> dual_values(const ColumnValues& y) {
  RotorValues<Tangent> x;
  for (std::size_t n = 0; n < 7; ++n) {
    x[n].value = y[n];
    std::copy_n(y.begin() + column_place(n, 0), 6, x[n].derivative.begin());
  }
  return x;
}
// The quaternion is normalised, and its derivatives are those of the unit quaternion.
inline BasicRotorState<Tangent> dual_state(const ColumnValues& y) {
  BasicRotorState<Tangent> s = rotor_state<Tangent>(dual_values(y));
  s.q = normalized(s.q);
  return s;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
