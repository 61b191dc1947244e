// SPDX-License-Identifier: MIT
// Batches of bodies, in parts on threads.
#include "polhode/ensemble/batches.hpp"

#include <cstddef>
#include <string>

#include "polhode/ensemble/executor.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

namespace {

// So that the last ones to end are late by little.
constexpr std::size_t parts_per_thread = 16;

std::size_t quotient_up(std::size_t a, std::size_t b) { return a / b + (a % b != 0 ? 1 : 0); }

}  // namespace

Parts parts_for(std::size_t size, std::size_t least, int threads) {
  if (threads < 1)
    throw DomainError("run_parts: threads " + std::to_string(threads) + " must be at least 1");
  if (size == 0) return {0, 1, 0};
  const std::size_t blocks = threads == 1 ? 1 : std::max<std::size_t>(1, size / least);
  const std::size_t each =
      blocks == 1
          ? size
          : least * quotient_up(blocks, parts_per_thread * static_cast<std::size_t>(threads));
  return {size, each, static_cast<std::int64_t>(quotient_up(size, each))};
}

namespace {

// Fewer than these take less time than a thread takes to begin: a body some 60 ns, a state 10. Long
// grids go past the caches, if their parts are long, too.
constexpr std::size_t least_bodies = 1024, least_states = 8192, least_of_grid = 65536;

template <class T>
std::span<T> cut(std::span<T> all, std::size_t begin, std::size_t end) {
  return all.subspan(begin, end - begin);
}

// One for all stays one for all.
template <class T>
std::span<T> cut_if_many(std::span<T> all, std::size_t begin, std::size_t end) {
  return all.size() == 1 ? all : cut(all, begin, end);
}

// convert(states, results) of parts; of all where they do not fit, so that it says why.
template <class From, class To, class Convert>
void converted(std::span<const From> states, std::span<To> results, int threads,
               const Convert& convert) {
  if (states.size() != results.size()) return convert(states, results);
  run_parts(results.size(), least_states, threads, [&](std::size_t begin, std::size_t end) {
    convert(cut(states, begin, end), cut(results, begin, end));
  });
}

// convert(begin, end, results) of parts, of what may fail: a part says so with its own index, so
// then all again, with theirs.
template <class To, class Convert>
void converted_or_named(std::span<To> results, int threads, const Convert& convert) {
  try {
    run_parts(results.size(), least_bodies, threads,
              [&](std::size_t begin, std::size_t end) { convert(begin, end); });
  } catch (const DomainError&) {
    if (threads > 1) convert(std::size_t{0}, results.size());
    throw;
  }
}

// propagate(begin, end) of parts, with indices of the whole.
template <class Propagate>
std::vector<FailedBody> failed_bodies(std::size_t size, int threads, const Propagate& propagate) {
  std::vector<FailedBody> failed;
  run_parts(size, least_bodies, threads, propagate,
            [&](std::size_t begin, const std::vector<FailedBody>& of_part) {
              for (const FailedBody& body : of_part)
                failed.push_back({begin + body.index, body.reason});
            });
  return failed;
}

}  // namespace

std::vector<FailedBody> propagate(const BodyRows& rows, std::span<RotorState> results, int threads,
                                  InstructionSet set) {
  const auto from = [](const NumberRows& all, std::size_t i) {
    return NumberRows{all.first + i * all.step, all.step};
  };
  return failed_bodies(results.size(), threads, [&](std::size_t begin, std::size_t end) {
    const BodyRows of_part{from(rows.moments, begin), from(rows.states, begin),
                           from(rows.times, begin), from(rows.epochs, begin)};
    return polhode::propagate(of_part, cut(results, begin, end), set);
  });
}

std::vector<FailedBody> propagate(std::span<const Body> bodies, std::span<const RotorState> states,
                                  std::span<const double> times, double t0,
                                  std::span<RotorState> results, int threads, InstructionSet set) {
  const std::size_t n = results.size();
  for (const std::size_t given : {bodies.size(), states.size(), times.size()})
    if (given != n && given != 1)  // says which
      return polhode::propagate(bodies, states, times, t0, results, set);
  return failed_bodies(n, threads, [&](std::size_t begin, std::size_t end) {
    return polhode::propagate(cut_if_many(bodies, begin, end), cut_if_many(states, begin, end),
                              cut_if_many(times, begin, end), t0, cut(results, begin, end), set);
  });
}

void states_at(const FreeKernel& kernel, std::span<const double> times,
               std::span<RotorState> states, int threads, InstructionSet set) {
  converted(times, states, threads,
            [&](auto some, auto results) { states_at(kernel, some, results, set); });
}

void states_on_grid(const FreeKernel& kernel, const TimeGrid& grid, std::uint64_t first,
                    std::span<RotorState> states, int threads, InstructionSet set) {
  constexpr std::uint64_t most = std::uint64_t{1} << 53;
  if (first > most || states.size() > most - first)  // says so
    return polhode::states_on_grid(kernel, grid, first, states, set);
  run_parts(states.size(), least_of_grid, threads, [&](std::size_t begin, std::size_t end) {
    polhode::states_on_grid(kernel, grid, first + begin, cut(states, begin, end), set);
  });
}

void to_andoyer(std::span<const RotorState> states, std::span<AndoyerState> results, int threads,
                InstructionSet set) {
  converted(states, results, threads, [&](auto some, auto found) { to_andoyer(some, found, set); });
}
void to_euler(std::span<const RotorState> states, std::span<EulerState> results, int threads,
              InstructionSet set) {
  converted(states, results, threads, [&](auto some, auto found) { to_euler(some, found, set); });
}
void to_rotor(std::span<const AndoyerState> states, std::span<RotorState> results, int threads,
              InstructionSet set) {
  converted(states, results, threads, [&](auto some, auto found) { to_rotor(some, found, set); });
}
void to_rotor(std::span<const EulerState> states, std::span<RotorState> results, int threads,
              InstructionSet set) {
  converted(states, results, threads, [&](auto some, auto found) { to_rotor(some, found, set); });
}

void to_poincare(std::span<const RotorState> states, Pole pole_J, Pole pole_I,
                 std::span<PoincareState> results, int threads, InstructionSet set) {
  converted(states, results, threads,
            [&](auto some, auto found) { to_poincare(some, pole_J, pole_I, found, set); });
}
void nearest_poincare(std::span<const RotorState> states, std::span<PoincareState> results,
                      int threads, InstructionSet set) {
  converted(states, results, threads,
            [&](auto some, auto found) { nearest_poincare(some, found, set); });
}
void to_rotor(std::span<const PoincareState> states, std::span<RotorState> results, int threads,
              InstructionSet set) {
  converted(states, results, threads, [&](auto some, auto found) { to_rotor(some, found, set); });
}

void to_sadov(const Body& body, std::span<const RotorState> states, std::span<SadovState> results,
              int threads, InstructionSet set) {
  if (states.size() != results.size())
    return polhode::to_sadov(body, states, results, set);  // says so
  converted_or_named(results, threads, [&](std::size_t begin, std::size_t end) {
    polhode::to_sadov(body, cut(states, begin, end), cut(results, begin, end), set);
  });
}
void to_rotor(const Body& body, std::span<const SadovState> states, std::span<RotorState> results,
              int threads, InstructionSet set) {
  if (states.size() != results.size()) return polhode::to_rotor(body, states, results, set);
  converted_or_named(results, threads, [&](std::size_t begin, std::size_t end) {
    polhode::to_rotor(body, cut(states, begin, end), cut(results, begin, end), set);
  });
}
void to_serret(const Body& body, std::span<const RotorState> states, std::span<const double> times,
               std::span<SerretState> results, int threads, InstructionSet set) {
  const std::size_t n = results.size();
  if (states.size() != n || (times.size() != n && times.size() != 1))
    return polhode::to_serret(body, states, times, results, set);
  converted_or_named(results, threads, [&](std::size_t begin, std::size_t end) {
    polhode::to_serret(body, cut(states, begin, end), cut_if_many(times, begin, end),
                       cut(results, begin, end), set);
  });
}
void to_rotor(const Body& body, std::span<const SerretState> states, std::span<const double> times,
              std::span<RotorState> results, int threads, InstructionSet set) {
  const std::size_t n = results.size();
  if (states.size() != n || (times.size() != n && times.size() != 1))
    return polhode::to_rotor(body, states, times, results, set);
  converted_or_named(results, threads, [&](std::size_t begin, std::size_t end) {
    polhode::to_rotor(body, cut(states, begin, end), cut_if_many(times, begin, end),
                      cut(results, begin, end), set);
  });
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
