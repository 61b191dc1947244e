// SPDX-License-Identifier: MIT
// Paths of a scenario that is written into another folder.
#include <filesystem>

#include "polhode/scenario/changes.hpp"
#include "polhode/scenario/document.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

namespace fs = std::filesystem;

fs::path or_here(const std::string& folder) { return folder.empty() ? "." : fs::path(folder); }

}  // namespace

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string moved_path(const Document& document, const std::string& path,
                       const std::string& folder) {
  std::error_code none;
  const fs::path from = or_here(document.folder), to = or_here(folder);
  if (fs::path(path).is_absolute() || fs::equivalent(from, to, none)) return path;
  // links are followed, as ".." follows them
  const fs::path moved = fs::relative(from / path, to, none);
  return (moved.empty() ? fs::absolute(from / path) : moved).generic_string();
}

std::vector<ScenarioChange> relocated_paths(const Document& document, const std::string& folder) {
  std::vector<ScenarioChange> changes;
  for (const auto& [key, value] : document.checked->values) {
    if (!value.key->is_file && key != "light.mesh") continue;
    const std::string& path = value.words.at(0);
    const std::string moved = moved_path(document, path, folder);
    if (moved != path) changes.push_back({key, toml_text(moved)});
  }
  return changes;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
