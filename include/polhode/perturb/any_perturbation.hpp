// SPDX-License-Identifier: MIT
// AnyPerturbation: one term of any type, for lists made at run time.
//
// Equations   those of the term.
// Units       those of Effect.
// Domain      any Perturbation. What the term can do (energy, exact flow, other number types) is
//             found at compile time and asked for by the functions supports_*.
// Accuracy    that of the term.
// Errors      DomainError when something is asked that the term cannot do, naming it; what the term
//             throws passes through.
// Cost        one virtual call. Copies share the term, which is immutable.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
  virtual double time_scale() const = 0;
  virtual AffineTorque affine_torque(const Setting& at) const = 0;
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
      term_cannot(name_, "has no exact flow: use a method that needs none (Adaptive)");
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

class AnyPerturbation {
 public:
  // `name` stands for the term in messages and outputs.
  template <Perturbation P>
  AnyPerturbation(const std::string& name, P term)
      : name_(name),
        energy_(Hamiltonian<P>),
        flow_(Splittable<P> || Kick<P> || AffineInMomentum<P>),
        kick_(Kick<P>),
        affine_(Kick<P> || AffineInMomentum<P>),
        switching_(Switching<P>),
        any_real_(PerturbationOn<P, DoubleDouble> && PerturbationOn<P, Tangent>),
        term_(std::make_shared<const detail::HeldTerm<P>>(name, std::move(term))) {}

  const std::string& name() const { return name_; }
  // The term itself where it is a P, else nullptr.
  template <Perturbation P>
  const P* target() const {
    const auto* held = dynamic_cast<const detail::HeldTerm<P>*>(term_.get());
    return held == nullptr ? nullptr : &held->term();
  }
  bool supports_energy() const { return energy_; }
  bool supports_flow() const { return flow_; }
  // v = 0, and u depends on time and attitude alone.
  bool is_kick() const { return kick_; }
  // v = 0, and u is c - A g with c and A of time and attitude alone; A = 0 for a kick.
  bool is_affine() const { return affine_; }
  // DoubleDouble and Tangent in addition to double.
  bool supports_any_real() const { return any_real_; }

  // T = double, DoubleDouble or Tangent.
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return term_->effect(at);
  }
  // T = double or DoubleDouble.
  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    return term_->energy(at);
  }
  RotorState flow(const Setting& at, double h) const { return term_->flow(at, h); }
  // Where the term is not smooth in time, in increasing order; none for most terms.
  std::vector<double> breakpoints() const { return term_->breakpoints(); }
  // Whether it can name switching functions: it may still have none.
  bool supports_switches() const { return switching_; }
  // Its switching functions; none for most terms. at.sides is not looked at.
  std::vector<double> switches(const Setting& at) const { return term_->switches(at); }
  // The time of a quarter of a turn of what it follows; infinite where it knows none.
  double time_scale() const { return term_->time_scale(); }
  AffineTorque affine_torque(const Setting& at) const { return term_->affine_torque(at); }

 private:
  std::string name_;
  bool energy_;
  bool flow_;
  bool kick_;
  bool affine_;
  bool switching_;
  bool any_real_;
  std::shared_ptr<const detail::ErasedTerm> term_;
};

}  // namespace v0
}  // namespace polhode
