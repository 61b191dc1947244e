// SPDX-License-Identifier: MIT
// Rows of an ensemble in one file for each chunk, which whoever computes the chunk writes, and an
// index of them: no row goes through the process that leads.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "polhode/output/sink.hpp"
#include "polhode/run/ensemble.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class ChunkFiles {
 public:
  // The path that has "{chunk}" in it; empty: none has. DomainError where there are others beside
  // it, or no rows to be kept.
  static std::string pattern(const ScenarioEnsemble& ensemble,
                             const std::vector<std::string>& paths);
  // The files that the leader writes: of a pattern, its index.
  static std::vector<std::string> kept(const std::vector<std::string>& paths);
  // A row of it for each chunk.
  static std::vector<ColumnGroup> index_groups();

  ChunkFiles(const ScenarioEnsemble& ensemble, std::string pattern);
  // Of the file of the chunk that begins with this member.
  std::string path(std::int64_t first) const;
  // The file of members `first` to `end` - 1, complete when it is finished.
  std::unique_ptr<Sink> open(std::int64_t first, std::int64_t end) const;

 private:
  const ScenarioEnsemble& ensemble_;
  std::string pattern_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
