// SPDX-License-Identifier: MIT
// Paths of further files in a scenario that is written to another folder.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/changes.hpp"
#include "polhode/scenario/document.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where paths in a scenario that is written to `path` start; on standard output those of this one.
std::string folder_of(const Document& document, const std::string& path);
// A path of the scenario as a scenario in `folder` has to name it; the same where that is the
// folder of this one, and where it begins at the root.
std::string moved_path(const Document& document, const std::string& path,
                       const std::string& folder);
// The changes of every key that names a file; none where `folder` is that of the scenario.
std::vector<ScenarioChange> moved_files(const Document& document, const std::string& folder);
// "found.obj" as a text of TOML.
std::string quoted_path(std::string_view path);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
