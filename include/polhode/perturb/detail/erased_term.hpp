// SPDX-License-Identifier: MIT
// A term of any type, as AnyPerturbation holds it.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/detail/perturb/affine_torque.hpp"
#include "polhode/perturb/detail/stage_terms.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

[[noreturn]] void term_cannot(const std::string& name, std::string_view what);

// The closed set of what is asked of a term at run time.
class ErasedTerm {
 public:
  virtual ~ErasedTerm() = default;
  virtual Effect effect(const Setting& at) const = 0;
  virtual BasicEffect<DoubleDouble> effect(const BasicSetting<DoubleDouble>& at) const = 0;
  virtual BasicEffect<Tangent> effect(const BasicSetting<Tangent>& at) const = 0;
  virtual double energy(const Setting& at) const = 0;
  virtual DoubleDouble energy(const BasicSetting<DoubleDouble>& at) const = 0;
  virtual RotorState flow(const Setting& at, double h) const = 0;
  virtual std::vector<double> breakpoints() const = 0;
  virtual std::vector<double> switches(const Setting& at) const = 0;
  virtual bool fades_at_switches() const = 0;
  virtual double time_scale() const = 0;
  virtual AffineTorque affine_torque(const Setting& at) const = 0;
  virtual std::unique_ptr<StageTerm> on_stages(const Body& body, InstructionSet set) const = 0;
};

template <Perturbation P>
class HeldTerm final : public ErasedTerm {
 public:
  HeldTerm(std::string name, P term) : name_(std::move(name)), term_(std::move(term)) {}

  const P& term() const { return term_; }

  Effect effect(const Setting& at) const override { return term_.effect(at); }
  BasicEffect<DoubleDouble> effect(const BasicSetting<DoubleDouble>& at) const override {
    return effect_on(at);
  }
  BasicEffect<Tangent> effect(const BasicSetting<Tangent>& at) const override {
    return effect_on(at);
  }
  double energy(const Setting& at) const override { return energy_on(at); }
  DoubleDouble energy(const BasicSetting<DoubleDouble>& at) const override { return energy_on(at); }
  RotorState flow(const Setting& at, double h) const override {
    if constexpr (Splittable<P>) {
      return term_.flow(at, h);
    } else if constexpr (Kick<P>) {
      return {at.s.q, at.s.g + h * term_.effect(at).u};
    } else if constexpr (AffineInMomentum<P>) {
      return {at.s.q, at.s.g + change_of_momentum(term_.affine_torque(at), at.s.g, h)};
    } else {
      term_cannot(name_, "has no exact flow: use a method that needs none (Collocation)");
    }
  }
  std::vector<double> breakpoints() const override {
    if constexpr (Piecewise<P>) {
      return term_.breakpoints();
    } else {
      return {};
    }
  }
  std::vector<double> switches(const Setting& at) const override {
    if constexpr (Switching<P>) {
      return term_.switches(at);
    } else {
      return {};
    }
  }
  bool fades_at_switches() const override {
    if constexpr (Fading<P>) {
      return term_.fades_at_switches();
    } else {
      return false;
    }
  }
  double time_scale() const override {
    if constexpr (Timed<P>) {
      return term_.time_scale();
    } else {
      return std::numeric_limits<double>::infinity();
    }
  }
  AffineTorque affine_torque(const Setting& at) const override {
    if constexpr (AffineInMomentum<P>) {
      return term_.affine_torque(at);
    } else if constexpr (Kick<P>) {
      return {term_.effect(at).u, {}};
    } else {
      term_cannot(name_, "is not said to have a torque that is affine in the momentum");
    }
  }
  std::unique_ptr<StageTerm> on_stages(const Body& body, InstructionSet set) const override {
    if constexpr (OnStages<P>) {
      return term_.on_stages(body);
    } else if constexpr (Timewise<P>) {
      return std::make_unique<TimewiseStages<P>>(term_, body, set);
    } else {
      return std::make_unique<SingleStages<P>>(term_, body);
    }
  }

 private:
  template <Real T>
  BasicEffect<T> effect_on(const BasicSetting<T>& at) const {
    if constexpr (PerturbationOn<P, T>) {
      return term_.effect(at);
    } else {
      term_cannot(name_, "works on double alone: write it as a template on the number type");
    }
  }
  template <Real T>
  T energy_on(const BasicSetting<T>& at) const {
    if constexpr (Hamiltonian<P, T>) {
      return term_.energy(at);
    } else if constexpr (Hamiltonian<P>) {
      term_cannot(name_,
                  "has an energy on double alone: write it as a template on the number type");
    } else {
      term_cannot(name_, "has no energy");
    }
  }

  std::string name_;
  P term_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
