// SPDX-License-Identifier: MIT
// A rotor under torques with its derivatives by six unknowns: what integrate() asks of a model.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "polhode/dynamics/model.hpp"
#include "polhode/perturb/effect.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// (q, g), then the same of each of six columns.
struct SensitivityState {
  static constexpr std::size_t size = 49;
  std::array<double, size> y{};

  bool operator==(const SensitivityState&) const = default;
};
template <class Visit>
void each_number(SensitivityState& s, Visit&& visit) {
  for (double& x : s.y) visit(x);
}

using TangentRotor = BasicRotorState<Tangent>;
TangentRotor tangent_rotor(const SensitivityState& s);
SensitivityState sensitivity_state(const TangentRotor& s);

// What an unknown does to the rates, beside what it did to the state.
struct SensitivityTerm {
  // The terms with a parameter one step on; empty: none.
  std::vector<AnyPerturbation> stepped = {};
  double step = 1.0;
  // The principal moment that grows with the unknown, and how fast.
  std::optional<int> moment = std::nullopt;
  double moment_rate = 0.0;
};

class SensitivityModel {
 public:
  using State = SensitivityState;
  using Values = std::array<double, SensitivityState::size>;
  static constexpr std::string_view name = "a rotor with derivatives by what drives it";

  SensitivityModel(System system, std::array<SensitivityTerm, 6> terms);

  template <Real T>
  static std::array<T, SensitivityState::size> values(const State& s) {
    std::array<T, SensitivityState::size> y;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = T(s.y[i]);
    return y;
  }
  State state(const Values& y) const;
  Values rates(const DoubleDouble& t, const Values& y) const;
  double error_size(const Values& error, const Values& y, const Values& increment) const;
  double time_scale(double) const { return time_scale_; }

  // The inertial rate of the body, with its derivatives.
  BasicVec3<Tangent> rate(double t, const State& s) const;

 private:
  struct Motion {
    TangentRotor s;
    BasicVec3<Tangent> w0;
    BasicEffect<Tangent> e;
  };
  Motion motion(const DoubleDouble& t, const Values& y) const;
  // The derivative of the effects by a moment at a fixed rate of the body.
  Effect by_moment(int k, const Setting& at, const Vec3& w) const;

  System system_;
  std::array<SensitivityTerm, 6> terms_;
  // A sphere, and bodies with half as much more of a moment.
  Body sphere_;
  std::array<Body, 3> grown_;
  double time_scale_ = std::numeric_limits<double>::infinity();
};

// The effect of the terms on a body at a rate w: of one that has other moments, too.
Effect effect_at_rate(const std::vector<AnyPerturbation>& terms, const Body& body,
                      const Setting& at, const Vec3& w);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
