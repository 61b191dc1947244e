// SPDX-License-Identifier: MIT
// The control of steps by collocation: the sweeps that solve one, the estimate of its error, and
// the length of the next.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/finite.hpp"
#include "polhode/detail/ode/step_control.hpp"
#include "polhode/detail/perturb/stages.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What steps by collocation keep to, and the sweeps that solve one.
struct CollocationControl {
  StepControl step;
  bool is_fixed = false;  // every step is step.first_step long but where something ends it
};

enum class SweepsEnd { converged, diverging, not_finite };

// Sweeps go on until rounding alone changes the stages, or what a term has of noise: its changes
// may be `enough`.
class SweepJudge {
 public:
  // `settled`: a change so small that none is looked for.
  explicit SweepJudge(double enough = 0.0, double settled = 0.0)
      : enough_(enough), settled_(settled) {}

  bool goes_on() const { return goes_on_; }
  std::int64_t sweeps() const { return sweeps_; }
  // Of a sweep, its largest change.
  void see(double change) {
    ++sweeps_;
    if (change == 0.0) {
      ends(SweepsEnd::converged);
    } else if (!std::isfinite(change)) {
      // sweeps that lead away from any solution overflow, too
      ends(sweeps_ > 1 && before_ >= 1.0 ? SweepsEnd::diverging : SweepsEnd::not_finite);
    } else if (sweeps_ >= least_sweeps && !(change < before_)) {
      ends(judged());
    } else {
      before_ = change;
      if (change <= settled_) {
        ends(SweepsEnd::converged);
      } else if (sweeps_ == most_sweeps) {
        ends(judged());
      }
    }
  }
  // Once they do not go on.
  SweepsEnd end() const { return end_; }

 private:
  static constexpr std::int64_t most_sweeps = 60, least_sweeps = 3;

  SweepsEnd judged() const {
    constexpr double largest_rounding = 256.0 * std::numeric_limits<double>::epsilon();
    return before_ <= std::max(enough_, largest_rounding) ? SweepsEnd::converged
                                                          : SweepsEnd::diverging;
  }
  void ends(SweepsEnd end) {
    end_ = end;
    goes_on_ = false;
  }

  double enough_, settled_;
  double before_ = std::numeric_limits<double>::infinity();
  std::int64_t sweeps_ = 0;
  bool goes_on_ = true;
  SweepsEnd end_ = SweepsEnd::diverging;
};

// Stages may say how small a change their sweeps need not look for.
template <class Stages>
SweepJudge judge_of(double enough) {
  if constexpr (requires { Stages::settled; })
    return SweepJudge(enough, Stages::settled);
  else
    return SweepJudge(enough);
}

template <class Stages>
SweepsEnd swept(Stages& stages, double enough, std::int64_t& sweeps) {
  SweepJudge judge = judge_of<Stages>(enough);
  while (judge.goes_on()) judge.see(stages.sweep());
  sweeps += judge.sweeps();
  return judge.end();
}

// How long the next step by collocation is.
class StepChoice {
 public:
  StepChoice(const CollocationControl& control, std::size_t stages)
      : h(control.step.first_step), control_(control), stages_(stages) {}

  double h;  // wanted, without its sign

  // Towards an end at `rest`. Of fixed steps no sliver is left for it.
  double towards(double rest) const {
    if (control_.is_fixed) return h * (1.0 + 1e-9) < rest ? h : rest;
    return step_towards(rest, h, control_.step);
  }
  double largest_step() const { return control_.step.largest_step; }
  // No later step is longer.
  void limit(double largest) { control_.step.largest_step = largest; }

  // A step of `length` that went beyond an edge, of which it is to be made anew.
  void cut(double length) {
    h = length;
    is_cut_ = true;
  }
  // A step of `length` that erred too much.
  void shorten(double length, double error) { h = length * std::min(wanted(error), 0.9); }
  // Steps of one length keep their weights and their guess; and their errors, those of a symmetric
  // method, cancel, where those of steps of many lengths add up. So a step grows
  // after a while, and by what the largest error of that while allows.
  void made(double length, double error, bool repeated, bool is_slow) {
    constexpr int while_of_steps = 32;
    constexpr double least_growth = 1.2;
    // A step cut short by an end says little of the next one.
    if (!repeated && length < h) return;
    if (repeated) {
      patience_ = while_of_steps;
      h = length;
      is_cut_ = false;
    }
    largest_error_ = repeated ? error : std::max(largest_error_, error);
    since_ = repeated ? 1 : since_ + 1;
    kept_ = length == kept_length_ ? kept_ + 1 : 1;
    kept_length_ = length;
    if (kept_ >= while_of_steps) lasting_ = length;
    // What an edge has cut short was smooth before, and is so beyond.
    is_cut_ = is_cut_ && length < 0.5 * lasting_;
    if (since_ < (is_cut_ ? 1 : patience_)) return;
    const double factor = is_slow ? 0.9 : wanted(largest_error_);
    if (factor < 1.0 || factor >= least_growth) {
      h = length * factor;
    } else if (!is_cut_) {
      patience_ = while_of_steps;
    }
    since_ = 0;
    largest_error_ = 0.0;
  }

  template <class Visit>
  void serialize(Visit& visit) {
    visit.all(largest_error_, since_, patience_, kept_, kept_length_, lasting_, is_cut_);
  }

 private:
  static constexpr double safety = 0.9;

  double wanted(double error) const {
    const double ratio = std::max(error / control_.step.tolerance, 1e-300);
    if (!std::isfinite(ratio)) return 0.3;
    const double order = 2.0 * static_cast<double>(stages_);
    return std::clamp(safety * std::pow(ratio, -1.0 / order), 0.3, 2.0);
  }

  CollocationControl control_;
  std::size_t stages_;
  // Since the length of steps was looked at: the largest error, how many steps, and how many it
  // takes.
  double largest_error_ = 0.0;
  int since_ = 0;
  int patience_ = 1;
  // For how many steps their length has been the same, and the last that was for a while.
  int kept_ = 0;
  double kept_length_ = 0.0, lasting_ = 0.0;
  bool is_cut_ = false;
};

// As many numbers, all 0.
template <class Values>
Values zeros_like(Values y) {
  std::fill(y.begin(), y.end(), 0.0);
  return y;
}

// The first `numbers` values at the part x of a step of h from `start`, of which rate(n, m) is the
// coefficient of P_m in the rate of number n: the integral of P_m is (P_(m+1) - P_(m-1)) / (2m +
// 1).
template <class State, class Rate>
auto values_inside(std::size_t numbers, std::size_t stages, const State& start, double h, double x,
                   const Rate& rate) {
  const double z = 2.0 * x - 1.0;
  auto sum = zeros_like(start.y);
  const auto add = [&](double weight, std::size_t m) {
    for (std::size_t n = 0; n < numbers; ++n) sum[n] += weight * rate(n, m);
  };
  double before = 1.0, P = z;
  add(x, 0);
  for (std::size_t m = 1; m < stages; ++m) {
    const double k = static_cast<double>(m);
    const double next = ((2.0 * k + 1.0) * z * P - k * before) / (k + 1.0);
    add((next - before) / (2.0 * (2.0 * k + 1.0)), m);
    before = P;
    P = next;
  }
  auto y = start.y;
  for (std::size_t n = 0; n < numbers; ++n) y[n] += h * sum[n] + start.carry[n];
  return y;
}

// The rates inside a step as a polynomial, and where it began.
template <class Stages>
struct StepPolynomial {
  DoubleDouble t;
  typename Stages::State start;
  double h = 0.0;  // 0: none
  typename Stages::Rows rates{};

  typename Stages::Values at(std::size_t stages, double x) const {
    return values_inside(rates.size(), stages, start, h, x,
                         [this](std::size_t n, std::size_t m) { return rates[n][m]; });
  }
};

// The effects of the terms of a System, u and then v, in Legendre polynomials; the last row is 0.
using DriveRows = std::array<StageRow, 7>;

// Of a step of h and s stages from y by `increment`, in the measure of a field.
template <class Field, class Values>
struct StepEstimate {
  const Field& field;
  std::size_t s;
  double h;
  const Values& y;
  const Values& increment;

  // Gauss' quadrature of a polynomial errs by its coefficient of degree 2 s. Those of an analytic
  // rate fall like powers, from the first to that of degree s - 1 and on.
  template <class Rows>
  double of_motion(const Rows& rates) const {
    Values last = zeros_like(y), largest = zeros_like(y);
    for (std::size_t n = 0; n < rates.size(); ++n) {
      last[n] = h * pair(rates[n], s - 1);
      largest[n] = h * (std::abs(rates[n][0]) + std::abs(rates[n][1]) + std::abs(rates[n][2]));
    }
    const double most = field.error_size(largest, y, increment);
    const double error = field.error_size(last, y, increment);
    const double n = static_cast<double>(s);
    return most == 0.0 ? error : most * std::pow(error / most, 2.0 * n / (n - 1.0));
  }
  // The effects by themselves, on the rotor that a state begins with: next to the free rotation the
  // last coefficients of a weak torque that no step resolves look like those of a motion that falls
  // fast. From the middle degrees to the last, and twice as far again, short of degree 2 s: so a
  // kink shows, whose coefficients hardly fall. Where kinks are many and small the first
  // coefficients fall fast all the same, and a tenth of the last is left: as measured on meshes of
  // 48 and 360 facets in sunlight.
  double of_effects(const DriveRows& drive, bool has_many_kinks) const {
    const double least = has_many_kinks ? 0.1 : 0.0;
    Values error = zeros_like(y);
    for (std::size_t n = 0; n < 6; ++n) {
      const double last = pair(drive[n], s - 1), middle = pair(drive[n], s / 2 - 1);
      const double fall = last < middle ? last / middle : 1.0;
      const double size = h * (last * larger(fall * fall, least));
      error[n < 3 ? 4 + n : n - 2] = n < 3 ? size : 0.5 * size;  // of g; of q, half a turn
    }
    return field.error_size(error, y, increment);
  }
  // What no stage sees: a jump or a kink between the outermost stages and the ends of the step, of
  // which they are `gap` apart. At the ends the effects are then not those of the polynomial.
  double of_ends(const DriveRows& drive, const std::array<double, 6>& first,
                 const std::array<double, 6>& last, double gap) const {
    constexpr double much = 16.0;  // times what an analytic effect leaves to further degrees
    Values error = zeros_like(y);
    for (std::size_t n = 0; n < 6; ++n) {
      double at_first = first[n], at_last = last[n];
      for (std::size_t m = 0; m < s; ++m) {
        at_first -= m % 2 == 0 ? drive[n][m] : -drive[n][m];
        at_last -= drive[n][m];
      }
      const double miss = larger(std::abs(at_first), std::abs(at_last));
      const double tail = larger(pair(drive[n], s - 1), pair(drive[n], s - 2));
      const double size = miss <= much * tail ? 0.0 : h * (gap * miss);
      error[n < 3 ? 4 + n : n - 2] = n < 3 ? size : 0.5 * size;
    }
    return field.error_size(error, y, increment);
  }
  // The same of rates of which nothing more is known. Coefficients that do not fall any more are
  // those of something that the step does not resolve, however little it is.
  template <class Rows>
  double of_tail(const Rows& rates) const {
    Values error = zeros_like(y);
    for (std::size_t n = 0; n < rates.size(); ++n) {
      const double last = pair(rates[n], s - 1), before = pair(rates[n], s - 3);
      const double fall = last < before ? (last / before) * (last / before) : 1.0;
      error[n] = h * (last * (fall * fall));
    }
    return field.error_size(error, y, increment);
  }

 private:
  // The larger of coefficients m and m - 1: in an even or an odd function every other one is 0.
  static double pair(const StageRow& row, std::size_t m) {
    return larger(std::abs(row[m]), std::abs(row[m - 1]));
  }
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
