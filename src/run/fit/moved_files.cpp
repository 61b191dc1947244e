// SPDX-License-Identifier: MIT
#include "run/detail/moved_files.hpp"

#include <filesystem>

#include "polhode/text/key.hpp"
#include "scenario/value_reader.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

namespace fs = std::filesystem;

fs::path or_here(const std::string& folder) { return folder.empty() ? "." : fs::path(folder); }

}  // namespace

std::string folder_of(const Document& document, const std::string& path) {
  return path == "-" ? document.folder : fs::path(path).parent_path().string();
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

std::vector<ScenarioChange> moved_files(const Document& document, const std::string& folder) {
  std::vector<ScenarioChange> changes;
  for (const auto& [key, value] : document.checked->values) {
    if (!value.key->is_file && key != "light.mesh") continue;
    const std::string& path = value.words.at(0);
    const std::string moved = moved_path(document, path, folder);
    if (moved != path) changes.push_back({key, quoted_path(moved)});
  }
  return changes;
}

std::string quoted_path(std::string_view path) {
  std::string text = "\"";
  for (const char c : path) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
