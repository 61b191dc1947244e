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

#include "polhode/perturb/detail/erased_term.hpp"
#include "polhode/perturb/effect.hpp"

namespace polhode {
inline namespace v0 {

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
        together_(detail::OnStages<P> || Timewise<P>),
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
  // Whether its effect begins and ends like a fractional power of the time at their zeros.
  bool fades_at_switches() const { return term_->fades_at_switches(); }
  // The time of a quarter of a turn of what it follows; infinite where it knows none.
  double time_scale() const { return term_->time_scale(); }
  AffineTorque affine_torque(const Setting& at) const { return term_->affine_torque(at); }
  // Whether it is asked for many states at a time; else on_stages asks it for one after the other.
  bool is_asked_together() const { return together_; }
  // For methods that ask for many states at a time (polhode/detail/perturb/stages.hpp): by the
  // instructions of a set that this processor has. The term and the body outlive it.
  std::unique_ptr<StageTerm> on_stages(const Body& body, InstructionSet set) const {
    return term_->on_stages(body, set);
  }

 private:
  std::string name_;
  bool energy_;
  bool flow_;
  bool kick_;
  bool affine_;
  bool switching_;
  bool together_;
  bool any_real_;
  std::shared_ptr<const detail::ErasedTerm> term_;
};

}  // namespace v0
}  // namespace polhode
