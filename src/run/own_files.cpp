// SPDX-License-Identifier: MIT
#include "run/detail/own_files.hpp"

#include <filesystem>

#include "polhode/error.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code none;
  if (fs::equivalent(a, b, none)) return true;
  const fs::path one = fs::weakly_canonical(a, none), other = fs::weakly_canonical(b, none);
  return !one.empty() && one == other;
}

}  // namespace

bool is_file(const std::string& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  return path != "-" && (!fs::exists(status) || fs::is_regular_file(status));
}

void require_own_files(const Document& document, std::span<const std::string> paths) {
  const fs::path folder = document.folder;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!is_file(paths[i])) continue;
    const std::string path = printable(paths[i], longest_path);
    if (is_same_file(paths[i], document.path))
      throw DomainError(path + ": is the scenario itself; expected another file to write");
    for (const ScenarioFile& file : document.files)
      if (is_same_file(paths[i], folder / file.path))
        throw DomainError(path + ": is a file that the scenario reads, " +
                          printable(file.path, longest_path) + "; expected another to write");
    for (std::size_t k = 0; k < i; ++k)
      if (is_file(paths[k]) && is_same_file(paths[i], paths[k]))
        throw DomainError(path + ": is the same file as " + printable(paths[k], longest_path) +
                          "; expected another to write");
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
