// SPDX-License-Identifier: MIT
#include "run/ensemble/chunk_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/output/output_format.hpp"
#include "run/ensemble/ensemble_origin.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::string_view mark = "{chunk}";

bool is_pattern(const std::string& path) { return path.find(mark) != std::string::npos; }

std::string with(std::string pattern, const std::string& chunk) {
  return pattern.replace(pattern.find(mark), mark.size(), chunk);
}

}  // namespace

std::string ChunkFiles::pattern(const ScenarioEnsemble& ensemble,
                                const std::vector<std::string>& paths) {
  const auto found = std::find_if(paths.begin(), paths.end(), is_pattern);
  if (found == paths.end()) return {};
  const std::string& name = ensemble.scenario().document.name;
  if (paths.size() > 1)
    throw DomainError(name + ": ensemble: got " + *found + " and " +
                      std::to_string(paths.size() - 1) +
                      " more outputs; expected no other where each chunk has a file of its own");
  if (ensemble.plan().keep == EnsembleKeep::statistics)
    throw DomainError(name + ": ensemble: got " + *found +
                      " for statistics, which are of all chunks; expected ensemble.keep = \"rows\" "
                      "or \"final\"");
  return *found;
}

std::vector<std::string> ChunkFiles::kept(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths)
    files.push_back(is_pattern(path) ? with(path, "index") : path);
  return files;
}

std::vector<ColumnGroup> ChunkFiles::index_groups() {
  return {{"chunk", {{"chunk", "1"}}},
          {"first_member", {{"first_member", "1"}}},
          {"members", {{"members", "1"}}},
          {"failed", {{"failed", "1"}}},
          {"rows", {{"rows", "1"}}}};
}

ChunkFiles::ChunkFiles(const ScenarioEnsemble& ensemble, std::string pattern)
    : ensemble_(ensemble), pattern_(std::move(pattern)) {}

std::string ChunkFiles::path(std::int64_t first) const {
  const std::int64_t each = ensemble_.plan().chunk, last = (ensemble_.size() - 1) / each;
  const std::size_t digits = std::to_string(last).size();  // names in the order of the chunks
  return with(pattern_, fmt::format("{:0{}}", first / each, digits));
}

std::unique_ptr<Sink> ChunkFiles::open(std::int64_t first, std::int64_t end) const {
  Provenance origin = provenance_of(ensemble_, nullptr);
  origin.notes.push_back(
      fmt::format("chunk {}: members {} to {}", first / ensemble_.plan().chunk, first, end - 1));
  return open_sink(path(first), row_groups_of(ensemble_), origin, std::nullopt,
                   ensemble_.scenario().output.formats);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
