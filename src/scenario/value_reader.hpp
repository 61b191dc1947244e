// SPDX-License-Identifier: MIT
// From the text of a scenario to its values.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "scenario/diagnostics.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
struct FitPlan;
namespace detail {

struct Refusal {
  Position where;
  std::string text;
};
// Why a text must not reach the TOML parser: what it would crash on, or answer undefined.
std::optional<Refusal> refusal(std::string_view text);
// What to do about a complaint of the TOML parser: "; text stands in quotes". "" where we know no
// more than it does.
std::string hint_for(std::string_view complaint);

struct MadeExperiment;

struct ReadFile {
  Values values;
  Units units;
  // What was made of the values, for those who make it again with other numbers.
  std::shared_ptr<const MadeExperiment> made = nullptr;
  std::shared_ptr<const FitPlan> fit = nullptr;  // of kind "fit"
};
// Everything wrong goes to `diagnostics`; what is right is in the result.
ReadFile read_values(std::string_view text, const Schema& schema, Diagnostics& diagnostics);

// Why a text of TOML is no value of a key, in one line; nothing where it is one.
std::optional<std::string> why_not(const Key& key, std::string_view toml);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
