// SPDX-License-Identifier: MIT
// Sadov's variables and Serret's elements of many states of a body.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "free/detail/sadov/constants.hpp"
#include "free/detail/sorted_state.hpp"
#include "polhode/error.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using DD = DoubleDouble;
using detail::SadovConstants;
using detail::TimesOfStates;

// Of moments with differences that have the rounding of their result alone.
struct Moments {
  Vec3 I;
  double I21, I31, I32;
};

void set_mode(SadovConstants& c, bool is_long, const Moments& m, const detail::AxisOrder& sorted) {
  const Quaternion right = detail::quaternion_of<double>(
      detail::composed(sorted, detail::primed_axes(is_long, 1.0, 1.0)));
  const Quaternion turned = detail::quaternion_of<double>(
      detail::composed(sorted, detail::primed_axes(is_long, 1.0, -1.0)));
  const Quaternion by_half = Quaternion{0.0, 1.0, 0.0, 0.0} * right;
  const bool same =
      by_half.w * turned.w + by_half.x * turned.x + by_half.y * turned.y + by_half.z * turned.z >
      0.0;
  c.half_turn[is_long] = same ? 1.0 : -1.0;
  const double axes[] = {right.w, -right.x, -right.y, -right.z};
  std::copy(axes, axes + 4, c.to_axes[is_long]);
  const double A = is_long ? m.I.z : m.I.x, B = m.I.y, C = is_long ? m.I.x : m.I.z;
  const double CB = is_long ? m.I21 : m.I32, BA = is_long ? m.I32 : m.I21;
  const double kap2 = C * BA / (A * CB);
  // where kappa leaves the theta function's shift in range, and the mode exists
  const bool usual = CB > 0.0 && kap2 > 1e-3 && kap2 < 1e6;
  c.usual[is_long] = usual ? 1.0 : 0.0;
  if (!usual) return;
  c.k2_per_DC[is_long] = BA / CB;
  c.kp2_per_D2[is_long] = m.I31 / (CB * (A * C));
  c.A_over_C[is_long] = A / C;
  c.kap2[is_long] = kap2;
  c.root_of_kap2[is_long] = std::sqrt(1.0 + kap2);
  c.cosine[is_long] = std::sqrt(m.I31 / A);
  c.sine[is_long] = std::sqrt(CB / B);
  const double kappa = std::sqrt(kap2);
  c.border[is_long] = std::atan2(1.0, kappa) / 1.5707963267948966;
  c.least[is_long] = kappa / c.root_of_kap2[is_long];
  c.most[is_long] = 1.0 / (c.root_of_kap2[is_long] * (c.root_of_kap2[is_long] + kappa));
  c.a2_over_a1[is_long] = c.cosine[is_long] / c.sine[is_long];
  c.rate_per_a3[is_long] = std::sqrt(CB * m.I31 / (A * B)) / C;
}

// What Serret's elements have units for; NaN, so that lanes leave them, where these are extreme.
void set_units(SadovConstants& c, const Body& body, const Vec3& scaled_moments) {
  const int e = detail::exponent_of_largest(body.moments());
  c.moment_unit = std::abs(e) < 300 ? std::ldexp(1.0, e) : std::nan("");
  for (int i = 0; i < 3; ++i) {
    c.moment[i] = scaled_moments[i];
    c.half_inverse[i] = DD(0.5) / DD(body.moments()[i]);
  }
}

SadovConstants constants_of(const Body& body) {
  SadovConstants c{};
  const detail::AxisOrder sorted = detail::ascending_order(body.moments());
  for (std::size_t i = 0; i < 3; ++i) {
    c.axis[i] = static_cast<std::size_t>(sorted.axis[i]);
    c.sign[i] = sorted.sign[i];
  }
  // scaled, which changes nothing that the variables are made of
  const Vec3 I = detail::scaled(detail::permuted(sorted, body.moments()),
                                detail::exponent_of_largest(body.moments()));
  if (!(I.x > 0x1p-100)) return c;
  const DD I21 = DD::sum(I.y, -I.x), I32 = DD::sum(I.z, -I.y);
  const Moments m{I, I21.hi, I.z - I.x, I32.hi};
  c.plus = I32 * I.x;
  c.minus = I21 * I.z;
  c.d1[0] = m.I21 / I.y;
  c.d1[1] = m.I31 / I.z;
  c.d3[0] = m.I31 / I.x;
  c.d3[1] = m.I32 / I.y;
  set_mode(c, false, m, sorted);
  set_mode(c, true, m, sorted);
  set_units(c, body, I);
  return c;
}

constexpr std::size_t block = 64;

// Of wide registers a single one takes longer.
void in_lanes([[maybe_unused]] InstructionSet set, const SadovConstants& c,
              const RotorState* states, std::size_t count, SadovState* results, bool* usual) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512 && count > 4)
    return detail::sadov_in_lanes<InstructionSet::avx512>(c, states, count, results, usual);
  if (set != InstructionSet::baseline)
    return detail::sadov_in_lanes<InstructionSet::avx2>(c, states, count, results, usual);
#endif
  detail::sadov_in_lanes<InstructionSet::baseline>(c, states, count, results, usual);
}

void rotors_in_lanes([[maybe_unused]] InstructionSet set, const SadovConstants& c,
                     const SadovState* sets, std::size_t count, RotorState* results, bool* usual) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return detail::rotors_of_sadov_in_lanes<InstructionSet::avx512>(c, sets, count, results, usual);
  if (set == InstructionSet::avx2)
    return detail::rotors_of_sadov_in_lanes<InstructionSet::avx2>(c, sets, count, results, usual);
#endif
  detail::rotors_of_sadov_in_lanes<InstructionSet::baseline>(c, sets, count, results, usual);
}

void serret([[maybe_unused]] InstructionSet set, const SadovConstants& c, const RotorState* states,
            const TimesOfStates& times, std::size_t count, SerretState* results, bool* usual) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return detail::serret_in_lanes<InstructionSet::avx512>(c, states, times, count, results, usual);
  if (set == InstructionSet::avx2)
    return detail::serret_in_lanes<InstructionSet::avx2>(c, states, times, count, results, usual);
#endif
  detail::serret_in_lanes<InstructionSet::baseline>(c, states, times, count, results, usual);
}

void rotors([[maybe_unused]] InstructionSet set, const SadovConstants& c, const SerretState* sets,
            const TimesOfStates& times, std::size_t count, RotorState* results, bool* usual) {
  using detail::rotors_of_serret_in_lanes;
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return rotors_of_serret_in_lanes<InstructionSet::avx512>(c, sets, times, count, results, usual);
  if (set == InstructionSet::avx2)
    return rotors_of_serret_in_lanes<InstructionSet::avx2>(c, sets, times, count, results, usual);
#endif
  rotors_of_serret_in_lanes<InstructionSet::baseline>(c, sets, times, count, results, usual);
}

TimesOfStates times_of(const std::string& function, std::span<const double> times,
                       std::size_t states) {
  if (times.size() != states && times.size() != 1)
    throw DomainError(function + ": got " + std::to_string(times.size()) + " times of " +
                      std::to_string(states) + " states; expected as many, or one for all");
  return {times.data(), times.size() == states ? std::size_t{1} : std::size_t{0}};
}

void require_fitting(const std::string& function, std::size_t states, std::size_t results,
                     InstructionSet set) {
  if (results != states)
    throw DomainError(function + ": got room for " + std::to_string(results) + " results of " +
                      std::to_string(states) + " states; expected as many");
  if (!supports(set))
    throw DomainError(function + ": got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
}

// Blocks in lanes, then one by one what they left.
template <class To, class From, class InLanes, class Alone>
void converted(std::span<const From> states, std::span<To> results, const InLanes& in_lanes,
               const Alone& alone) {
  std::array<bool, block> usual;
  for (std::size_t first = 0; first < states.size(); first += block) {
    const std::size_t count = std::min(block, states.size() - first);
    in_lanes(states.data() + first, count, results.data() + first, usual.data());
    for (std::size_t i = first; i < first + count; ++i) {
      if (usual[i - first]) continue;
      try {
        results[i] = alone(states[i], i);
      } catch (const DomainError& e) {
        throw DomainError(std::string(e.what()) + " (state " + std::to_string(i) + ")");
      }
    }
  }
}

SadovState alone(const Body& body, const RotorState& state) {
  return to_sadov(FreeRotation(body, state), 0.0);
}

}  // namespace

void to_sadov(const Body& body, std::span<const RotorState> states, std::span<SadovState> results,
              InstructionSet set) {
  require_fitting("to_sadov", states.size(), results.size(), set);
  const SadovConstants constants = constants_of(body);
  converted(
      states, results,
      [&](const RotorState* some, std::size_t count, SadovState* found, bool* usual) {
        in_lanes(set, constants, some, count, found, usual);
      },
      [&](const RotorState& state, std::size_t) { return alone(body, state); });
}

void to_rotor(const Body& body, std::span<const SadovState> states, std::span<RotorState> results,
              InstructionSet set) {
  require_fitting("to_rotor", states.size(), results.size(), set);
  const SadovConstants constants = constants_of(body);
  converted(
      states, results,
      [&](const SadovState* some, std::size_t count, RotorState* found, bool* usual) {
        rotors_in_lanes(set, constants, some, count, found, usual);
      },
      [&](const SadovState& state, std::size_t) { return to_rotor(body, state); });
}

void to_serret(const Body& body, std::span<const RotorState> states, std::span<const double> times,
               std::span<SerretState> results, InstructionSet set) {
  require_fitting("to_serret", states.size(), results.size(), set);
  const TimesOfStates t = times_of("to_serret", times, states.size());
  const SadovConstants constants = constants_of(body);
  converted(
      states, results,
      [&](const RotorState* some, std::size_t count, SerretState* found, bool* usual) {
        const auto first = static_cast<std::size_t>(some - states.data());
        serret(set, constants, some, t.from(first), count, found, usual);
      },
      [&](const RotorState& state, std::size_t i) {
        return to_serret(FreeRotation(body, state, t[i]), t[i]);
      });
}

void to_rotor(const Body& body, std::span<const SerretState> states, std::span<const double> times,
              std::span<RotorState> results, InstructionSet set) {
  require_fitting("to_rotor", states.size(), results.size(), set);
  const TimesOfStates t = times_of("to_rotor", times, states.size());
  const SadovConstants constants = constants_of(body);
  converted(
      states, results,
      [&](const SerretState* some, std::size_t count, RotorState* found, bool* usual) {
        const auto first = static_cast<std::size_t>(some - states.data());
        rotors(set, constants, some, t.from(first), count, found, usual);
      },
      [&](const SerretState& state, std::size_t i) { return to_rotor(body, state, t[i]); });
}

SadovState to_sadov(const Body& body, const RotorState& state) {
  SadovState result{};
  bool usual = false;
  in_lanes(widest_instruction_set(), constants_of(body), &state, 1, &result, &usual);
  return usual ? result : alone(body, state);
}

}  // namespace v0
}  // namespace polhode
