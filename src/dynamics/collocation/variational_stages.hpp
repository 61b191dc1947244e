// SPDX-License-Identifier: MIT
// The stages of a rotor with what becomes of small changes of it: the derivative of the step as it
// is.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "dynamics/augmented.hpp"
#include "dynamics/collocation/augmented_stages.hpp"
#include "dynamics/collocation/step_control.hpp"
#include "polhode/math/dual.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The derivatives of the rates of a rotor by each of its seven numbers.
class RotorJacobian {
 public:
  explicit RotorJacobian(const System& system)
      : whole_(system), momentum_(only_kicks(system) ? without_terms(system) : system) {}

  const RotorField<Tangent>& whole() const { return whole_; }

  // Into stage i.
  void put(StageJacobian& to, std::size_t i, const DoubleDouble& t, const RotorValues<Tangent>& at,
           const SwitchSides* sides) const {
    RotorValues<Tangent> y = at;
    for (std::size_t n = 0; n < 6; ++n) y[n].derivative[n] = 1.0;
    const RotorValues<Tangent> by_six = whole_(t, y, sides);
    y = at;
    y[6].derivative[0] = 1.0;
    const RotorValues<Tangent> by_last = momentum_(t, y, sides);
    for (std::size_t r = 0; r < 7; ++r) {
      for (std::size_t n = 0; n < 6; ++n) to[r][n][i] = by_six[r].derivative[n];
      to[r][6][i] = by_last[r].derivative[0];
    }
  }

 private:
  static bool only_kicks(const System& system) {
    return std::all_of(system.terms().begin(), system.terms().end(),
                       [](const AnyPerturbation& term) { return term.is_kick(); });
  }
  static System without_terms(const System& s) { return System(s.body(), s.frame()); }

  RotorField<Tangent> whole_;
  RotorField<Tangent> momentum_;  // the same by momenta
};

// Only the rates of the rotor, by which the first step is chosen.
template <class F>
struct RotorAlone : SmoothField<F> {
  typename F::Values operator()(const DoubleDouble& t, const typename F::Values& y) const {
    const RotorValues<double> f =
        this->field->rotor_alone()(this->stretch.inside(t), rotor_at(y), this->sides.get());
    typename F::Values r{};
    std::copy_n(f.begin(), 7, r.begin());
    return r;
  }
};

// `columns` small changes (dq, dg) of seven numbers, and numbers that follow from them. The first
// number of all columns comes first, then the second, and so on. `F` knows the Jacobian of its
// rotor.
template <class F, std::size_t columns, std::size_t following = 0>
class VariationalStages : public AugmentedStages<F, 7 * columns + following> {
 public:
  using Joined = AugmentedStages<F, 7 * columns + following>;
  using Rates = RotorAlone<F>;
  static constexpr std::size_t first_momentum = 4 * columns;
  static constexpr std::size_t end_of_columns = 7 * columns;

  using Joined::Joined;

  // The motion first; the changes then move by linear equations, which ask for no term.
  SweepsEnd solved(double enough, std::int64_t& sweeps) {
    const SweepsEnd end = swept(this->rotor_, enough, sweeps);
    if (end != SweepsEnd::converged) return end;
    differentiate();
    sweeps += 2;
    SweepJudge judge(enough);
    while (judge.goes_on()) judge.see(sweep_columns());
    return judge.end();
  }

 private:
  void differentiate() {
    momentum_ = 0.0;
    for (std::size_t i = 0; i < this->scheme().stages; ++i) {
      RotorValues<Tangent> y;
      for (std::size_t n = 0; n < 7; ++n) y[n] = Tangent(this->at_stage(i, n));
      this->field_->jacobian().put(A_, i, this->time(i), y, this->sides_);
      for (std::size_t n = 4; n < 7; ++n)
        momentum_ = larger(momentum_, std::abs(this->at_stage(i, n)));
    }
    for (std::size_t k = 0; k < columns; ++k) size_[k] = size(this->rest_.y.data(), k);
  }
  // First dg, then dq by the new ones. The largest change relative to its column.
  double sweep_columns() {
    this->lanes_.multiply(A_, this->rest_, columns, 4, 7);
    this->move(first_momentum, end_of_columns);
    this->lanes_.multiply(A_, this->rest_, columns, 0, 4);
    const auto& changes = this->move(0, first_momentum);
    double most = 0.0;
    for (std::size_t k = 0; k < columns; ++k) {
      const double change = size(changes.data(), k);
      most = larger(most, change == 0.0 ? 0.0 : change / size_[k]);
    }
    return most;
  }
  // The size of column k, with dg relative to the momentum.
  double size(const double* of, std::size_t k) const {
    double dq = 0.0, dg = 0.0;
    for (std::size_t n = 0; n < 4; ++n) dq = larger(dq, std::abs(of[n * columns + k]));
    for (std::size_t n = 4; n < 7; ++n) dg = larger(dg, std::abs(of[n * columns + k]));
    return larger(dq, momentum_ > 0.0 ? dg / momentum_ : dg);
  }

  StageJacobian A_{};
  double momentum_ = 0.0;
  std::array<double, columns> size_{};
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
