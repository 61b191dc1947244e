// SPDX-License-Identifier: MIT
// Evaluation of a FreeKernel in double, compiled for processors with FMA and for those without.
#include "polhode/detail/free/free_kernel.hpp"

#include "free/detail/evaluated_without_fma.hpp"
#include "free/evaluate.hpp"
#include "polhode/math/instruction_set.hpp"

namespace polhode {
inline namespace v0 {
namespace {

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) RotorState evaluated_with_fma(const FreeKernel& k, double t) {
  return detail::state_at<detail::FmaArithmetic>(k, t);
}
bool processor_has_fma() {
  static const bool has = supports(InstructionSet::avx2);
  return has;
}
#endif

}  // namespace

RotorState evaluate(const FreeKernel& k, double t) noexcept {
#if defined(__x86_64__)
  if (processor_has_fma()) return evaluated_with_fma(k, t);
#endif
  return detail::evaluated_without_fma(k, t);
}

namespace detail {

RotorState evaluated_without_fma(const FreeKernel& k, double t) noexcept {
  return state_at<DekkerArithmetic>(k, t);
}

}  // namespace detail

}  // namespace v0
}  // namespace polhode
