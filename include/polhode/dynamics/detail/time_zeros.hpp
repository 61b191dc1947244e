// SPDX-License-Identifier: MIT
// The zeros of a function of time, from looks at it: values and slopes at times so close that the
// function turns around at most once between two of them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

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

// From where a function is zero to where it is not any more: one instant, as a rule.
struct ZeroSpan {
  double first;
  double last;
};

// Goes from look to look, either way in time. Between two looks it finds
//  - a change of sign;
//  - two, where the function turns around beyond zero: its slopes point at zero from both sides;
//  - a touch, where it turns around at zero to rounding (`touching` of the values around, and of
//    the time), as a V or as an even power up to the 20th.
// A look that is zero is a zero as its neighbours say: they are on different sides (or it is where
// the search begins or ends), or it is a touch. A stretch of zeros is two: its first instant, with
// the direction in which the function came, and its last, with that in which it leaves; 0 where
// the stretch begins or ends with the search. A function that comes to zero but for roundings
// (`touching` of its largest value so far), at once, and stays there, is in such a stretch too.
// Where f is NaN it stops: zeros up to there.
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
  // The zero at the last look, which no other look will decide about; also one but for roundings,
  // if that is near enough.
  void end(std::vector<Zero>& found, bool is_near_enough = false);
  // When the zero is that other looks will decide about.
  std::optional<double> undecided() const {
    return at_zero_ || is_near_ ? std::optional(t_zero_) : std::nullopt;
  }
  // Whether it is in a stretch of them, whose beginning has been found.
  bool is_in_stretch() const { return stretch_; }

  // Every number that the search depends on.
  template <class Visit>
  void serialize(Visit& visit) {
    visit.all(sign_, at_zero_, stretch_, is_exact_, is_near_, counts_, t_zero_, scale_, floor_);
  }

 private:
  void see(double value, double before);
  bool stays(const TimeFunction& f, const Look& a, const Look& b, std::vector<Zero>& found);
  void begin_stretch(bool exactly, std::vector<Zero>& found);
  std::optional<Look> leave(const TimeFunction& f, const Look& a, const Look& b,
                            std::vector<Zero>& found);
  void cross(const TimeFunction& f, const Look& a, const Look& b, std::vector<Zero>& found);
  void turn_around(const TimeFunction& f, const Look& a, const Look& b, std::vector<Zero>& found);

  double period_;
  int sign_ = 0;           // of the last value that was not zero; 0: none yet
  bool at_zero_ = false;   // since
  bool stretch_ = false;   // for longer than a look
  bool is_exact_ = false;  // of a stretch: 0.0 at every look
  bool is_near_ = false;   // the last look is zero but for roundings
  bool counts_ = true;     // whether t_zero_ is still to be reported
  // The last look that is zero, or where a function that is near has come there.
  double t_zero_ = 0.0;
  double scale_ = 0.0;  // the largest value so far
  double floor_ = 0.0;  // up to here the last look is zero but for roundings
};

// A zero between a and b, whose values have different signs: to rounding, or until two tries are no
// farther apart than `close`.
struct Root {
  double t;       // the sign is that of b from here on, to rounding or to `close`
  bool is_exact;  // f is 0.0 there
};
// No value if f is NaN.
std::optional<Root> root_between(const TimeFunction& f, Look a, Look b, double close = 0.0);

// The lowest place of sign * f between a and b, or one where it is not above `enough`; nothing if
// the slopes at a and b show that it does not come near zero. At a and b it is above zero. Where it
// is convex, slopes may also be steeper than those of f.
std::optional<Look> dip_between(const TimeFunction& f, int sign, const Look& a, const Look& b,
                                double enough);

// A zero between a and b, whose values have different signs: the first time in the direction of b
// at which the sign is that of b, to rounding, and the stretch of zeros around it. Nothing for the
// jump of a folded angle, or where f is NaN.
std::optional<ZeroSpan> crossing_between(const TimeFunction& f, Look a, Look b,
                                         double period = 0.0);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
