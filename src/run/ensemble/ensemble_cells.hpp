// SPDX-License-Identifier: MIT
// What the processes and threads of an ensemble compute, by cells of some members each: the first
// members, from which bins and references come, then all of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "polhode/ensemble/team.hpp"
#include "polhode/run/ensemble.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "run/detail/checkpoint.hpp"
#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Members begin to end - 1 of all: how a stage cuts them into cells.
struct CellsOfMembers {
  std::int64_t first = 0;  // of the cell 0
  std::int64_t each = 1;
  std::int64_t end = 0;  // after the last member

  std::int64_t count() const { return (end - first + each - 1) / each; }
  std::int64_t begin_of(std::int64_t cell) const { return first + cell * each; }
  std::int64_t end_of(std::int64_t cell) const { return std::min(end, begin_of(cell + 1)); }
};

// What one cell of the members gives: rows, or statistics.
struct EnsembleChunk {
  std::vector<std::vector<double>> drawn;
  std::vector<EnsembleReport::Failure> failures;
  std::vector<double> rows;
  std::optional<RowStatistics> statistics;

  // Statistics need the frame to be read.
  void transfer(StateBytes& bytes, const StatisticsFrame* frame);
};

using Pilots = std::vector<EnsembleMember>;
void transfer(StateBytes& bytes, Pilots& pilots);

class EnsembleCells final : public TeamWork {
 public:
  // With a file for each chunk where `chunk_files` is not empty (ChunkFiles). DomainError where
  // statistics would not fit into memory.
  EnsembleCells(const ScenarioEnsemble& ensemble, bool any_machine, std::string chunk_files = {});

  // None where rows are kept.
  StatisticsFrame* frame() const { return frame_.get(); }
  bool has_files() const { return !chunk_files_.empty(); }
  // Of the chunks before this member, if each has one.
  std::vector<std::string> files_before(std::int64_t member) const;
  // Whether a cell is a chunk of the plan.
  bool is_by_chunks() const { return frame_ || has_files(); }
  CellsOfMembers pilot_cells() const;
  // From this member on, which begins a chunk where cells are chunks.
  CellsOfMembers member_cells(std::int64_t from) const;

  Pilots pilots(const CellsOfMembers& cells, std::int64_t cell, const Progress& look) const;
  EnsembleChunk chunk(const CellsOfMembers& cells, std::int64_t cell, const Progress& look) const;

  // The same by bytes. The frame of the leader goes along where members are computed.
  std::string pilot_stage() const;
  std::string member_stage(std::int64_t from) const;
  void begin(const std::string& stage) override;
  std::string cell(std::int64_t index, const std::function<void()>& look) const override;

 private:
  struct Stage {
    bool pilots = false;
    CellsOfMembers cells;
    Identity identity;  // of the ensemble
    std::string chunk_files;
    std::string frame;

    void transfer(StateBytes& bytes);
  };
  std::string stage_bytes(bool pilots, const CellsOfMembers& cells) const;
  std::int64_t members_at_a_time() const;
  std::vector<EnsembleMember> members(std::int64_t begin, std::int64_t end,
                                      const Progress& look) const;
  void append_rows(std::int64_t index, const EnsembleMember& member, std::vector<double>& to) const;

  const ScenarioEnsemble& ensemble_;
  bool any_machine_;
  std::string chunk_files_;
  Identity identity_;  // of the ensemble
  std::unique_ptr<StatisticsFrame> frame_;
  Stage stage_;  // the last one begun
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
