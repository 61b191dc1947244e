// SPDX-License-Identifier: MIT
// The zeros of a function of time, from looks at it: values and slopes at times so close that the
// function turns around at most once between two of them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {

using TimeFunction = std::function<double(double t)>;

struct Look {
  double t;
  double value;
  double slope;  // df/dt, on the side of the interval where it is one-sided; NaN: not known
};

struct Zero {
  double t;
  int direction;  // of the function as the search goes on: +1 rises, -1 falls, 0 touches zero
};

// Goes from look to look, either way in time. Between two looks it finds
//  - a change of sign;
//  - two, where the function turns around beyond zero: its slopes point at zero from both sides;
//  - a touch, where it turns around at zero to rounding (`touching` of the values around, and of
//  the
//    time).
// A look that is zero is a zero as its neighbours say: they are on different sides (or it is where
// the search begins or ends), or it is a touch. A stretch of zeros is none, unless the function
// changes its sign over it: then the last of them. Where f is NaN it stops: zeros up to there.
class ZeroSearch {
 public:
  static constexpr double touching = 1e-14;

  // Of an angle folded into a period, a jump of more than half of it is no zero. 0: none.
  explicit ZeroSearch(double period = 0.0) : period_(period) {}

  // `reports`: whether a zero at the very start counts.
  void begin(double t, double value, bool reports = true);
  // What lies in (a.t, b.t), and zeros up to a.t that b decides about; in order. a is where the
  // last call ended.
  void between(const TimeFunction& f, Look a, Look b, std::vector<Zero>& found);
  // The zero at the last look, which no other look will decide about.
  void end(std::vector<Zero>& found);
  // When the zero is that other looks will decide about.
  std::optional<double> undecided() const {
    return at_zero_ ? std::optional(t_zero_) : std::nullopt;
  }

  // Every number that the search depends on.
  template <class Visit>
  void transfer(Visit& visit) {
    visit.all(sign_, at_zero_, stretch_, t_zero_);
  }

 private:
  void leave_zero(int sign, std::vector<Zero>& found);
  void reach_zero(double t, bool stays);
  void cross(double t, int sign, std::vector<Zero>& found);
  void turn_around(const TimeFunction& f, const Look& a, const Look& b, std::vector<Zero>& found);

  double period_;
  int sign_ = 0;          // of the last value that was not zero; 0: none yet
  bool at_zero_ = false;  // since
  double t_zero_ = 0.0;
  bool stretch_ = false;  // for longer than a look, or a zero that does not count
};

// A zero between a and b, whose values have different signs: the first time in the direction of b
// at which the sign is that of b, to rounding. Nothing for the jump of a folded angle, or where f
// is NaN.
std::optional<double> crossing_between(const TimeFunction& f, Look a, Look b, double period = 0.0);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
