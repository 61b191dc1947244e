// SPDX-License-Identifier: MIT
// Breakpoints: the times at which a term of a system is not smooth, the smooth stretch around a
// step, and the rates on it.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "polhode/math/double_double.hpp"
#include "system/rotor_equations.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The open interval between two breakpoints. At the breakpoints themselves a term has one value,
// and a step needs that of its own side: times at the ends or beyond are moved inside, by the
// smallest double.
struct SmoothStretch {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();

  DoubleDouble inside(const DoubleDouble& t) const {
    if (from < t.hi && t.hi < to) return t;
    return t.hi <= from ? above_from() : below_to();
  }

 private:
  DoubleDouble above_from() const;
  DoubleDouble below_to() const;
};

// The rates of a field on one stretch and on one side of every switching function; no sides where a
// system has none. By shared pointers: steps that outlive a run share them.
template <class Field>
struct SmoothField {
  std::shared_ptr<const Field> field;
  SmoothStretch stretch = {};
  std::shared_ptr<const SwitchSides> sides = nullptr;

  template <class Values>
  Values operator()(const DoubleDouble& t, const Values& y) const {
    return (*field)(stretch.inside(t), y, sides.get());
  }
};

class Breakpoints {
 public:
  explicit Breakpoints(const System& system);

  // The end of the stretch that a step from t towards `stop` is in, or `stop` where that is nearer.
  double end(double t, double stop) const;
  SmoothStretch stretch(double t, double stop) const;

 private:
  std::vector<double> times_;  // of all terms, increasing
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
