// SPDX-License-Identifier: MIT
// A scenario file after the checks that its table of keys can make, and the reader of its text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/document.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/units.hpp"
#include "text/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

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
};
inline FileValues file_values(const Document& of) {
  return {of.checked->values, of.units, of.path};
}
// Everything wrong goes to `diagnostics`; what is right is in the result.
ReadFile read_values(std::string_view text, const Schema& schema, Diagnostics& diagnostics);

// The value of a key that a text of TOML is; its numbers in units of their own dimension, or of
// core. ScenarioError for another text.
Value value_of(const Key& key, std::string_view toml);
// Why a text of TOML is no value of a key, in one line; nothing where it is one.
std::optional<std::string> why_not(const Key& key, std::string_view toml);

}  // namespace detail

}  // namespace io
}  // namespace v0
}  // namespace polhode
