// SPDX-License-Identifier: MIT
// Gauss-Legendre collocation: its schemes, their kernels for the instructions of the processor, and
// the stepper of a rotor.
#include <memory>

#include "dynamics/collocation/collocation_stepper.hpp"
#include "dynamics/collocation/gauss_scheme.hpp"
#include "dynamics/steppers.hpp"
#include "math/gauss_legendre.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

using DD = DoubleDouble;

template <std::size_t s>
std::unique_ptr<const GaussScheme> made() {
  const GaussNodes<DD, s> nodes;
  const auto& [x, w, P] = nodes;
  auto g = std::make_unique<GaussScheme>();
  g->stages = s;
  for (std::size_t i = 0; i < s; ++i) {
    g->c[i] = (0.5 * (1.0 + x[i])).hi;
    g->b[i] = (0.5 * w[i]).hi;
    for (std::size_t m = 0; m < s; ++m)
      g->coefficient[i][m] = ((static_cast<double>(m) + 0.5) * (w[i] * P[i][m])).hi;
  }
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j) {
      const double mu = (0.5 * nodes.integral(i, j)).hi;
      // the larger of a pair is rounded, so that the other is its difference from 1 exactly
      if (i != j && mu >= 0.5) {
        g->mu[j][i] = mu;
        g->mu[i][j] = 1.0 - mu;
      }
    }
    g->mu[i][i] = 0.5;
  }
  return g;
}

// P_0 to P_(n-1) at z.
void legendre_row(StageMatrix& to, std::size_t n, std::size_t i, double z) {
  double before = 1.0, P = z;
  to[0][i] = 1.0;
  for (std::size_t m = 1; m < n; ++m) {
    to[m][i] = P;
    const double k = static_cast<double>(m);
    const double next = ((2.0 * k + 1.0) * z * P - k * before) / (k + 1.0);
    before = P;
    P = next;
  }
}

}  // namespace

const GaussScheme& gauss_scheme(std::size_t stages) {
  // never destroyed: a thread may still step when the process ends
  static const GaussScheme* const four = made<4>().release();
  static const GaussScheme* const eight = made<8>().release();
  static const GaussScheme* const sixteen = made<16>().release();
  static const GaussScheme* const most = made<32>().release();
  switch (stages) {
    case 4:
      return *four;
    case 8:
      return *eight;
    case 16:
      return *sixteen;
    default:
      return *most;
  }
}

double power_error(const GaussScheme& scheme) {
  double error = -0.4;
  for (std::size_t i = 0; i < scheme.stages; ++i)
    error += scheme.b[i] * (scheme.c[i] * std::sqrt(scheme.c[i]));
  return std::abs(error) / (1.0 - std::sqrt(0.5));
}

StepWeights step_weights(const GaussScheme& scheme, double h) {
  StepWeights w;
  for (std::size_t i = 0; i < scheme.stages; ++i) {
    w.hb[i] = h * scheme.b[i];
    w.length += w.hb[i];
  }
  return w;
}

StageMatrix continuation(const GaussScheme& scheme, double ratio) {
  StageMatrix P{};
  for (std::size_t i = 0; i < scheme.stages; ++i)
    legendre_row(P, scheme.stages, i, 1.0 + 2.0 * ratio * scheme.c[i]);
  return P;
}

StageMatrix refinement(const GaussScheme& scheme, const GaussScheme& fine) {
  StageMatrix P{};
  for (std::size_t i = 0; i < fine.stages; ++i)
    legendre_row(P, scheme.stages, i, 2.0 * fine.c[i] - 1.0);
  return P;
}

// src/dynamics/collocation/lanes, one source for each set.
template <InstructionSet isa>
RotorLanes rotor_kernels(std::size_t stages);

RotorLanes rotor_lanes(std::size_t stages, [[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return rotor_kernels<InstructionSet::avx512>(stages);
  if (set == InstructionSet::avx2) return rotor_kernels<InstructionSet::avx2>(stages);
#endif
  return rotor_kernels<InstructionSet::baseline>(stages);
}

// src/dynamics/collocation/lanes, one source for each set.
template <InstructionSet isa>
NumberLanes number_kernels(std::size_t stages);

NumberLanes number_lanes(std::size_t stages, [[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return number_kernels<InstructionSet::avx512>(stages);
  if (set == InstructionSet::avx2) return number_kernels<InstructionSet::avx2>(stages);
#endif
  return number_kernels<InstructionSet::baseline>(stages);
}

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Collocation& method) {
  require_valid(method);
  return collocation_stepper<RotorStages>(
      std::make_shared<const RotorStages::Field>(problem.system), problem.start,
      RotorStages::Field::start(problem.initial), method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
