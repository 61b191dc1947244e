// SPDX-License-Identifier: MIT
// Changes of a scenario before it is read: other values of some keys, in its text, so that comments
// stay and outputs hold what was run.
//
// Units       those of the text: a value is what the file could hold.
// Domain      keys with dots, tables of arrays by index, from 0: "event.0.value" or
//             "event[0].value". A value is TOML; a bare word or quantity (LAM, 27.38 h) is a text.
//             An empty one takes the key or table out. A key that is not there comes into its
//             table, a table in braces ({ at = [1, 2] }) in place of one that is there.
// Accuracy    the text outside of the keys stays, byte for byte.
// Errors      ChangeError, naming the key, for a key that can have no place and a value that is not
//             TOML. Whether the scenario knows the key, and the value is a good one, is said when
//             it is read.
// Cost        a reading of the text for each change.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
struct Document;

// What cannot be changed.
class ChangeError : public DomainError {
 public:
  using DomainError::DomainError;
};

struct ScenarioChange {
  std::string key;
  std::string value;  // TOML; empty: without the key
};

// "KEY=VALUE"
ScenarioChange change_of(std::string_view text);

// A text as TOML has it: "moon.csv".
std::string toml_text(std::string_view text);

// A path of a scenario as another one in `folder` has to name it: unchanged if both are in the same
// folder or the path is absolute.
std::string moved_path(const Document& document, const std::string& path,
                       const std::string& folder);
// The changes of every key that names a file; none if `folder` is that of the scenario.
std::vector<ScenarioChange> relocated_paths(const Document& document, const std::string& folder);

// One after the other. A text that is not TOML stays: those who read it say why.
std::string changed_text(std::string_view text, std::span<const ScenarioChange> changes);

}  // namespace io
}  // namespace v0
}  // namespace polhode
