// SPDX-License-Identifier: MIT
// What is said of members that failed.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "polhode/output/sink.hpp"
#include "polhode/run/ensemble_run.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline constexpr std::size_t failures_named = 20;

// Behind the rows of an output, before it finishes: "38 of 400 members", "member 7: why", the first
// of them; nothing where none failed.
void say_failures(Sink& sink, std::span<const EnsembleReport::Failure> failures,
                  std::int64_t failed, std::int64_t members);

// Of an ensemble of which no member is left, with the first reasons.
std::string all_failed_text(const std::string& name,
                            std::span<const EnsembleReport::Failure> failures,
                            std::int64_t members);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
