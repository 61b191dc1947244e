// SPDX-License-Identifier: MIT
// What the processes and threads of an ensemble compute, by cells of some members each: the first
// members, from which bins and references come, then all of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "polhode/run/ensemble_run.hpp"
#include "run/detail/source.hpp"
#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// The result of one cell of members: rows or statistics.
struct EnsembleChunk {
  std::vector<std::vector<double>> drawn;
  std::vector<EnsembleReport::Failure> failures;
  std::vector<double> rows;
  std::optional<RowStatistics> statistics;

  // Statistics need the frame to be read.
  void serialize(Archive& bytes, const StatisticsFrame* frame);
};

using Pilots = std::vector<EnsembleMember>;

class EnsembleCells final : public SourceWork {
 public:
  // With a file for each chunk where `chunk_files` is not empty (ChunkFiles). DomainError where
  // statistics would not fit into memory.
  EnsembleCells(const ScenarioEnsemble& ensemble, bool any_machine, std::string chunk_files = {});

  // Null if rows are kept.
  StatisticsFrame* frame() const { return frame_.get(); }
  bool has_files() const { return !chunk_files_.empty(); }
  // The files of the chunks before this member; none if chunks have no files.
  std::vector<std::string> files_before(std::int64_t member) const;
  // Whether a cell is a chunk of the plan.
  bool is_by_chunks() const { return frame_ || has_files(); }
  // The first members.
  Source<Pilots> pilots();
  // The members from this one on, which begins a chunk if cells are chunks.
  Source<EnsembleChunk> members(std::int64_t from);

 private:
  // In another process, to which the leader sends its frame before the members.
  void begin_stage(const CellRange& range, Archive& bytes) override;
  template <class Result>
  Source<Result> source(const CellRange& range,
                        Result (EnsembleCells::*made)(std::int64_t begin, std::int64_t end,
                                                      const Progress& look) const);
  std::int64_t members_at_a_time() const;
  Pilots members_of(std::int64_t begin, std::int64_t end, const Progress& look) const;
  EnsembleChunk chunk_of(std::int64_t begin, std::int64_t end, const Progress& look) const;
  void append_rows(std::int64_t index, const EnsembleMember& member, std::vector<double>& to) const;

  const ScenarioEnsemble& ensemble_;
  std::string chunk_files_;
  std::unique_ptr<StatisticsFrame> frame_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
