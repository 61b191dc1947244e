// SPDX-License-Identifier: MIT
// A motion with its deviation, carried from one time to the next by a method.
#pragma once

#include <memory>
#include <string>

#include "analysis/detail/growth.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Why a run with a deviation ends at a jump of a torque that the state decides.
inline constexpr const char* unknown_jump =
    "how a deviation crosses that is not known; take differences of runs";

class DeviationRun {
 public:
  virtual ~DeviationRun() = default;
  // One step towards t, ending there or before; empty, or why there is none.
  virtual std::string advance(double t) = 0;
  virtual double time() const = 0;
  virtual ChaosSample sample() const = 0;  // at time()
  virtual Statistics statistics() const = 0;
};

// `options` have a scale of momentum, and a deviation that is not zero.
std::unique_ptr<DeviationRun> deviation_run(const Problem& problem, const Adaptive& method,
                                            const ChaosOptions& options, DeviationBy by);
std::unique_ptr<DeviationRun> deviation_run(const Problem& problem, const Splitting& method,
                                            const ChaosOptions& options, DeviationBy by);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
