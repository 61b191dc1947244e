// SPDX-License-Identifier: MIT
// Gauss collocation (Butcher 1964) solved by iteration: steps of order 24 for equations y' = f(t,
// y) in which y hardly matters to f, as constants of a motion do to their own rates. There each
// iteration gains a factor of h |df/dy|, and a step costs 12 calls of f a time instead of the 150
// that an explicit method of order 9 takes for as long a step at 1e-14.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "math/finite.hpp"
#include "polhode/detail/ode/adaptive_runge_kutta.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr std::size_t gauss_nodes = 12;

struct GaussTableau {
  std::array<double, gauss_nodes> c;                           // nodes in [0, 1]
  std::array<double, gauss_nodes> b;                           // weights
  std::array<std::array<double, gauss_nodes>, gauss_nodes> a;  // integrals from 0 to c_i
  // The last two coefficients of a function in Legendre polynomials, from its values at the nodes.
  std::array<std::array<double, gauss_nodes>, 2> last;
  std::array<std::array<double, gauss_nodes>, gauss_nodes> all;  // every coefficient
};
const GaussTableau& gauss_tableau();

// f inside a step: its coefficients in Legendre polynomials.
template <std::size_t N>
using CollocationSeries = std::array<std::array<double, N>, gauss_nodes>;

template <std::size_t N>
struct CollocationStep {
  enum class Status { made, diverged, not_finite };
  Status status = Status::diverged;
  std::array<double, N> increment;
  std::array<double, N> last;     // h times the larger of the last two coefficients of f
  std::array<double, N> largest;  // h times the largest f
  int iterations;
  std::int64_t evaluations;
};

// `size` measures a change of y; iteration stops when a change is below `enough`, or as small as
// rounding lets it be. `series`: where f inside the step is kept.
template <std::size_t N, class F, class Size>
CollocationStep<N> collocation_step(const F& f, const Size& size, const DoubleDouble& t,
                                    const std::array<double, N>& y, double h, double enough,
                                    CollocationSeries<N>* series = nullptr) {
  using Values = std::array<double, N>;
  using Status = typename CollocationStep<N>::Status;
  constexpr int most_iterations = 16;
  const GaussTableau& g = gauss_tableau();
  const auto weighted = [](const auto& weights, const std::array<Values, gauss_nodes>& k) {
    Values sum{};
    for (std::size_t j = 0; j < gauss_nodes; ++j) accumulate(sum, weights[j], k[j]);
    return sum;
  };
  std::array<Values, gauss_nodes> k{};
  CollocationStep<N> step{};
  double before = std::numeric_limits<double>::infinity();
  while (step.iterations < most_iterations) {
    for (std::size_t i = 0; i < gauss_nodes; ++i) {
      const Values y_i = moved(y, h, weighted(g.a[i], k));
      k[i] = f(DoubleDouble::sum(t.hi, t.lo + g.c[i] * h), y_i);  // later nodes see it at once
    }
    ++step.iterations;
    step.evaluations += static_cast<std::int64_t>(gauss_nodes);
    Values change = moved(Values{}, h, weighted(g.b, k));
    for (std::size_t n = 0; n < N; ++n) std::swap(change[n], step.increment[n]);
    for (std::size_t n = 0; n < N; ++n) change[n] = step.increment[n] - change[n];
    const double moved_by = size(change, y, step.increment);
    if (!std::isfinite(moved_by)) {
      step.status = Status::not_finite;
      return step;
    }
    if (moved_by <= enough) break;
    if (moved_by > 0.5 * before) {
      // Rounding alone is left, or it does not converge.
      if (moved_by <= 8.0 * epsilon<double>() * size(step.increment, y, step.increment)) break;
      return step;
    }
    before = moved_by;
  }
  step.status = Status::made;
  if (series != nullptr)
    for (std::size_t m = 0; m < gauss_nodes; ++m) (*series)[m] = weighted(g.all[m], k);
  for (std::size_t n = 0; n < N; ++n) {
    double largest = 0.0, last[2] = {0.0, 0.0};
    for (std::size_t j = 0; j < gauss_nodes; ++j) {
      largest = larger(largest, std::abs(k[j][n]));
      for (std::size_t m = 0; m < 2; ++m) last[m] += g.last[m][j] * k[j][n];
    }
    step.largest[n] = h * largest;
    step.last[n] = h * larger(std::abs(last[0]), std::abs(last[1]));
  }
  return step;
}

// The change of y from the start of a step of length h to its part x: the integral of P_m is
// (P_(m+1) - P_(m-1)) / (2m + 1).
template <std::size_t N>
std::array<double, N> collocation_increment(const CollocationSeries<N>& series, double h,
                                            double x) {
  const double z = 2.0 * x - 1.0;
  std::array<double, N> sum{};
  accumulate(sum, x, series[0]);
  double before = 1.0, P = z;
  for (std::size_t m = 1; m < gauss_nodes; ++m) {
    const double n = static_cast<double>(m);
    const double next = ((2.0 * n + 1.0) * z * P - n * before) / (n + 1.0);
    accumulate(sum, (next - before) / (2.0 * (2.0 * n + 1.0)), series[m]);
    before = P;
    P = next;
  }
  return moved(std::array<double, N>{}, h, sum);
}

// Steps under control. The error of Gauss' quadrature of an analytic f is about the square of its
// last coefficient.
template <std::size_t N, class F, class Size>
class AdaptiveCollocation {
 public:
  using Values = std::array<double, N>;

  AdaptiveCollocation(F f, Size size, double t, const Values& y, const StepControl& control)
      : f_(std::move(f)),
        size_(std::move(size)),
        control_(control),
        h_(control.first_step),
        t_(t),
        state_{y} {}

  // One step towards `stop`, ending there or before.
  StepOutcome advance(double stop) {
    const DoubleDouble rest = DoubleDouble(stop) - t_;
    if (!(h_ > 0.0)) h_ = std::abs(rest.hi);
    StepOutcome why = StepOutcome::too_small;
    for (bool repeated = false;; repeated = true) {
      const double length = step_towards(std::abs(rest.hi), h_, control_);
      if (repeated && length < smallest_step(t_)) return why;
      trial_ = std::copysign(length, rest.hi);
      const auto step =
          collocation_step<N>(f_, size_, t_, state_.y, trial_, enough(control_.tolerance));
      evaluations_ += step.evaluations;
      const bool solved = step.status == CollocationStep<N>::Status::made;
      const double error = solved ? estimate(step) : 0.0;
      if (solved && error <= control_.tolerance) {
        const bool ends = length == std::abs(rest.hi);
        state_.add(step.increment);
        t_ = ends ? DoubleDouble(stop) : t_ + trial_;
        ++steps_;
        // A step cut short by the end says little of the next one.
        if (!ends || length > h_) h_ = length;
        const double factor = step.iterations > slow_iterations ? 0.8 : wanted(error);
        h_ *= repeated ? std::min(factor, 1.0) : factor;
        return StepOutcome::made;
      }
      ++rejected_;
      why = step.status == CollocationStep<N>::Status::not_finite ? StepOutcome::not_finite
                                                                  : StepOutcome::too_small;
      h_ = length * (solved ? std::min(wanted(error), 0.9) : 0.4);
    }
  }

  // The step that advance would try first, with its sign.
  double next_step(double stop) const {
    const double rest = (DoubleDouble(stop) - t_).hi;
    return std::copysign(h_ > 0.0 ? step_towards(std::abs(rest), h_, control_) : std::abs(rest),
                         rest);
  }
  static double enough(double tolerance) { return 0.01 * tolerance; }
  const DoubleDouble& time() const { return t_; }
  const CompensatedState<double, N>& state() const { return state_; }
  CompensatedState<double, N>& state() { return state_; }
  double trial() const { return trial_; }
  std::int64_t steps() const { return steps_; }
  std::int64_t rejected() const { return rejected_; }
  std::int64_t evaluations() const { return evaluations_; }

  // Every number that the steps to come depend on, by reference.
  template <class Visit>
  void serialize(Visit& visit) {
    visit.all(h_, t_, state_.y, state_.carry, trial_, steps_, rejected_, evaluations_);
  }

 private:
  static constexpr int slow_iterations = 10;

  double estimate(const CollocationStep<N>& step) const {
    const double last = size_(step.last, state_.y, step.increment);
    const double largest = size_(step.largest, state_.y, step.increment);
    return largest == 0.0 ? 0.0 : last * (last / largest);
  }
  double wanted(double error) const {
    const double ratio = std::max(error / control_.tolerance, 1e-30);
    if (!std::isfinite(ratio)) return 0.3;
    return std::clamp(0.9 * std::pow(ratio, -1.0 / (2.0 * gauss_nodes)), 0.3, 3.0);
  }

  F f_;
  Size size_;
  StepControl control_;
  double h_;
  DoubleDouble t_;
  CompensatedState<double, N> state_;
  double trial_ = 0.0;
  std::int64_t steps_ = 0;
  std::int64_t rejected_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
