// SPDX-License-Identifier: MIT
// What the processes and threads of an ensemble compute, by cells of some members each: the first
// members, from which bins and references come, then all of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "polhode/run/ensemble.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "run/detail/sweep.hpp"
#include "run/ensemble/statistics/statistics.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Whether two machines compute alike to the last bit: polhode's own kernels do; sines and
// logarithms are those of the C library, which has several of each and takes one that the processor
// can run. A mark of what they give for some arguments.
IdentityPart elementary_functions();
// Makes theirs those of ours, for a comparison in which they do not matter; if they differ, also
// the numbers of orbits and torques, which are made with them.
void take_elementary_functions(Identity& theirs, const Identity& ours);
// True for a difference() in this part.
bool differs_in_elementary_functions(const std::string& difference);

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

class EnsembleCells final : public ExecutorWork {
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

  // The same in another process, to which the leader sends its frame before the members.
  void begin(const std::string& stage) override;
  std::string cell(std::int64_t index, const std::function<void()>& look) const override;

 private:
  struct Stage {
    bool pilots = false;
    std::int64_t first = 0, each = 1, end = 0;  // members; so many a cell
    Identity identity;                          // of the ensemble
    std::string chunk_files;

    void serialize(Archive& bytes);
    std::int64_t begin_of(std::int64_t cell) const { return first + cell * each; }
  };
  template <class Result>
  Source<Result> source(Stage stage,
                        Result (EnsembleCells::*made)(std::int64_t begin, std::int64_t end,
                                                      const Progress& look) const);
  std::int64_t members_at_a_time() const;
  Pilots members_of(std::int64_t begin, std::int64_t end, const Progress& look) const;
  EnsembleChunk chunk_of(std::int64_t begin, std::int64_t end, const Progress& look) const;
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
