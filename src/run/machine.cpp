// SPDX-License-Identifier: MIT
#include "run/detail/machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "polhode/detail/trajectory/archive.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr char functions_part[] = "elementary functions of the machine";

}  // namespace

IdentityPart elementary_functions() {
  Archive bytes;
  for (int k = 1; k <= 1000; ++k) {
    const double x = 0.003 * k;
    for (double value : {std::sin(x), std::cos(x), std::tan(x), std::atan2(x, 1.7), std::exp(-x),
                         std::log(x), std::asin(x / 4.0), std::pow(x, 1.3)})
      bytes(value);
  }
  return {functions_part, "mark " + std::to_string(fingerprint(bytes.bytes()))};
}

void take_elementary_functions(Identity& theirs, const Identity& ours) {
  const auto part_of = [](auto& identity, const std::string& of) {
    return std::find_if(identity.begin(), identity.end(),
                        [&](const IdentityPart& part) { return part.name == of; });
  };
  const auto here = part_of(ours, functions_part);
  const auto there = part_of(theirs, functions_part);
  if (here == ours.end() || there == theirs.end() || here->text == there->text) return;
  there->text = here->text;
  const auto numbers = part_of(theirs, surroundings_part);
  const auto own_numbers = part_of(ours, surroundings_part);
  if (numbers != theirs.end() && own_numbers != ours.end()) numbers->text = own_numbers->text;
}

bool differs_in_elementary_functions(const std::string& difference) {
  return difference.starts_with(functions_part);
}

CheckpointSetup with_machine(CheckpointSetup setup, const RunOptions& options) {
  setup.identity.insert(setup.identity.begin(), elementary_functions());
  if (options.any_machine) setup.forgive = take_elementary_functions;
  setup.advice = [words = options.words](const std::string& differs) {
    return differs_in_elementary_functions(differs)
               ? "; " + words.any_machine + " goes on with other last digits"
               : std::string();
  };
  return setup;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
