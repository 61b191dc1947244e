// SPDX-License-Identifier: MIT
// The files that a scenario names, recognised by their bytes.
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "polhode/trajectory/state_bytes.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/values.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// As it is on the disk, packed or not. Never a pipe: it could be read once alone.
std::optional<ScenarioFile> noted(const std::filesystem::path& folder, const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(folder / path, ignored)) return std::nullopt;
  std::ifstream file(folder / path, std::ios::binary);
  ScenarioFile result{path, 0, fingerprint({})};
  std::array<char, 65536> block;
  while (file) {
    file.read(block.data(), block.size());
    const std::string_view bytes(block.data(), static_cast<std::size_t>(file.gcount()));
    result.fingerprint = fingerprint(bytes, result.fingerprint);
    result.bytes += file.gcount();
  }
  if (!file.eof()) return std::nullopt;
  return result;
}

}  // namespace

std::vector<ScenarioFile> files_of(const Values& values, const std::string& name) {
  std::set<std::string> paths;
  for (const auto& [path, value] : values)
    if (value.key->is_file) paths.insert(value.words.at(0));
  const std::filesystem::path folder = std::filesystem::path(name).parent_path();
  std::vector<ScenarioFile> files;
  for (const std::string& path : paths)
    if (const std::optional<ScenarioFile> file = noted(folder, path)) files.push_back(*file);
  return files;
}

}  // namespace detail

std::string file_note(const ScenarioFile& file) {
  return detail::printable(file.path, 500) + ": " + std::to_string(file.bytes) + " bytes, mark " +
         std::to_string(file.fingerprint);
}

}  // namespace v0
}  // namespace polhode
