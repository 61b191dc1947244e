// SPDX-License-Identifier: MIT
// The stages of a rotor with a damper: to the rotor the damper is one more term, a rate, and its
// own state are three more numbers.
#pragma once

#include <cmath>
#include <utility>

#include "dynamics/adaptive/damper_field.hpp"
#include "dynamics/collocation/augmented_stages.hpp"
#include "dynamics/collocation/gauss_scheme.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A decay that is part of the rate of a number, s' = r - d s: solved within each sweep, so that
// sweeps converge however fast it is. S = P - d mu (hb S), P the stages by r alone.
class StageDecay {
 public:
  // For steps of weights hb: the inverse of 1 + d mu hb, by elimination with pivots. Its worst loop
  // has 32^3 trips, once for each length of steps.
  void prepare(const GaussScheme& scheme, const StageRow& hb, double d) {
    count_ = scheme.stages;
    StageMatrix a{};
    for (std::size_t j = 0; j < count_; ++j) {
      inverse_[j] = {};
      inverse_[j][j] = 1.0;
      for (std::size_t i = 0; i < count_; ++i)
        a[j][i] = (i == j ? 1.0 : 0.0) + d * hb[j] * scheme.mu[j][i];
    }
    for (std::size_t k = 0; k < count_; ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < count_; ++i)
        if (std::abs(a[k][i]) > std::abs(a[k][pivot])) pivot = i;
      for (std::size_t j = 0; j < count_; ++j) {
        std::swap(a[j][k], a[j][pivot]);
        std::swap(inverse_[j][k], inverse_[j][pivot]);
      }
      const double scale = 1.0 / a[k][k];
      for (std::size_t j = 0; j < count_; ++j) {
        a[j][k] *= scale;
        inverse_[j][k] *= scale;
      }
      for (std::size_t i = 0; i < count_; ++i) {
        const double factor = a[k][i];
        if (i == k || factor == 0.0) continue;
        for (std::size_t j = 0; j < count_; ++j) {
          a[j][i] -= factor * a[j][k];
          inverse_[j][i] -= factor * inverse_[j][k];
        }
      }
    }
  }

  StageRow solved(const StageRow& P) const {
    StageRow S{};
    for (std::size_t j = 0; j < count_; ++j)
      for (std::size_t i = 0; i < count_; ++i) S[i] += inverse_[j][i] * P[j];
    return S;
  }

 private:
  std::size_t count_ = 0;
  StageMatrix inverse_{};  // by columns
};

class SweptDamper : public DamperField<double> {
 public:
  // The system has a damper.
  explicit SweptDamper(const System& system)
      : DamperField(system), rotor_(system), kernel_(system.body(), *system.damper()) {}

  const RotorField<double>& rotor_alone() const { return rotor_; }
  const DamperKernel<double>& kernel() const { return kernel_; }

 private:
  RotorField<double> rotor_;
  DamperKernel<double> kernel_;
};

class DamperStages : public AugmentedStages<SweptDamper, 3> {
 public:
  DamperStages(std::shared_ptr<const Field> field, std::size_t stages, InstructionSet set)
      : AugmentedStages(std::move(field), stages, set), friction_(*this) {
    rotor_.add(friction_);
  }

  void begin(const DoubleDouble& t, const State& start, double h, const SwitchSides* sides) {
    AugmentedStages::begin(t, start, h, sides);
    if (h == h_) return;
    for (std::size_t n = 0; n < 3; ++n)
      decays_[n].prepare(scheme(), rotor_.weights(), field_->kernel().decay(n));
    h_ = h;
  }

  // The largest change of any stage, in the measure of the field. The friction that the damper's
  // own rate meets is solved for: where it is strong sweeps would not converge.
  double sweep() {
    const double rotor = rotor_.sweep();
    const std::size_t count = scheme().stages;
    const DamperKernel<double>& damper = field_->kernel();
    std::array<StageRow, 3> before;
    std::copy_n(rest_.Y.begin(), 3, before.begin());
    double scale = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 s = damper_rate(i), g{at_stage(i, 4), at_stage(i, 5), at_stage(i, 6)};
      const Vec3 dg{rotor_.rates()[4][i], rotor_.rates()[5][i], rotor_.rates()[6][i]};
      const Vec3 free = field_->rotor_alone().equations().free_rate(g);
      const Vec3 ds = damper.acceleration(free + damper.rate_of_body(s), dg, s);
      for (std::size_t n = 0; n < 3; ++n) {
        const int k = static_cast<int>(n);
        rest_.F[n][i] = ds[k] + damper.decay(n) * s[k];
        scale = larger(scale, std::abs(free[k]), std::abs(s[k]));
      }
    }
    move(0, 3);
    double moved = 0.0;
    for (std::size_t n = 0; n < 3; ++n) {
      rest_.Y[n] = decays_[n].solved(rest_.Y[n]);
      for (std::size_t i = 0; i < count; ++i) {
        rest_.F[n][i] -= damper.decay(n) * rest_.Y[n][i];
        moved = larger(moved, std::abs(rest_.Y[n][i] - before[n][i]));
      }
    }
    return moved == 0.0 ? rotor : larger(rotor, moved / scale);
  }
  std::array<double, 6> effects(const DoubleDouble& t, const Values& y,
                                const SwitchSides* sides) const {
    std::array<double, 6> found = AugmentedStages::effects(t, y, sides);
    const Vec3 v = field_->kernel().rate_of_body({y[7], y[8], y[9]});
    for (int n = 0; n < 3; ++n) found[3 + static_cast<std::size_t>(n)] += v[n];
    return found;
  }
  State finished() {
    for (std::size_t n = 0; n < 3; ++n)  // as the sums take them
      for (std::size_t i = 0; i < scheme().stages; ++i)
        rest_.L[n][i] = rotor_.weights()[i] * rest_.F[n][i];
    return AugmentedStages::finished();
  }

 private:
  class Friction final : public StageTerm {
   public:
    explicit Friction(const DamperStages& of) : of_(of) {}
    void begin(const StageTimes&, std::span<const double>) override {}
    void add_to(StageEffects& effects, const StageStates&) override {
      for (std::size_t i = 0; i < of_.scheme().stages; ++i) {
        const Vec3 v = of_.field_->kernel().rate_of_body(of_.damper_rate(i));
        for (int n = 0; n < 3; ++n) effects.v[static_cast<std::size_t>(n)][i] += v[n];
      }
    }
    bool adds_rate() const override { return true; }

   private:
    const DamperStages& of_;
  };

  Vec3 damper_rate(std::size_t i) const { return {rest_.Y[0][i], rest_.Y[1][i], rest_.Y[2][i]}; }

  Friction friction_;
  std::array<StageDecay, 3> decays_;
  double h_ = 0.0;  // that they are made for
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
