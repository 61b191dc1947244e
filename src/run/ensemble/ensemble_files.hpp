// SPDX-License-Identifier: MIT
// Files of an ensemble: columns and provenance, rows in one file for each chunk, histograms, and
// the lines about members that failed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/output/sink.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// Where rows are kept, all or the last.
std::vector<ColumnGroup> row_groups_of(const ScenarioEnsemble& ensemble);
// No frame where rows are kept.
Provenance provenance_of(const ScenarioEnsemble& ensemble, const StatisticsFrame* frame);

// Rows of an ensemble in one file for each chunk, which whoever computes the chunk writes, and an
// index of them: no row goes through the process that leads.
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

// Paths OUT.NAME.csv of the histograms of a plan, next to the first output OUT.csv; none without
// outputs or statistics. DomainError if no output is a file, or a path is also that of an input or
// output.
std::vector<std::string> histogram_paths(const ScenarioEnsemble& ensemble,
                                         const std::vector<std::string>& outputs);

// Files that an earlier part has completed, these or those of chunks, and that are not written
// again: DomainError for one that is gone.
void require_there(const std::vector<std::string>& paths, const BeginWords& words);

// Written as PATH.part, then renamed; each says its path. OutputError.
void write_histograms(std::vector<EnsembleReport::Histogram>& histograms,
                      const std::vector<std::string>& paths, const OutputFormats& formats,
                      Provenance origin);

inline constexpr std::size_t failures_named = 20;

// Behind the rows of an output, before it finishes: "38 of 400 members", "member 7: why", the first
// of them; nothing where none failed.
void say_failures(Sink& sink, std::span<const EnsembleReport::Failure> failures,
                  std::int64_t failed, std::int64_t members);

// Text when every member failed, with the first reasons.
std::string all_failed_text(const std::string& name,
                            std::span<const EnsembleReport::Failure> failures,
                            std::int64_t members);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
