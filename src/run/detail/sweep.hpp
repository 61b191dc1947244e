// SPDX-License-Identifier: MIT
// Sweep: the engine of runs, maps and ensembles. Cells of a source are computed on an executor,
// reduced in their order, written block by block, checkpointed, stopped and resumed. A run is a
// sweep of one cell, whose own state is in the checkpoint.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polhode/ensemble/executor.hpp"
#include "polhode/run/scenario_run.hpp"
#include "run/detail/checkpointed_outputs.hpp"
#include "run/detail/source.hpp"
#include "run/time_left.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class Sweep {
 public:
  virtual ~Sweep() = default;
  Sweep(const Sweep&) = delete;
  Sweep& operator=(const Sweep&) = delete;

  const CheckpointedOutputs& outputs() const { return outputs_; }
  // What earlier parts have done, as in ResumableRun.
  double reached_before() const { return reached_before_; }
  std::int64_t rows_before() const { return rows_before_; }

 protected:
  // Finds the files of an earlier part. `scenario` must outlive it.
  Sweep(const Scenario& scenario, CheckpointSetup setup, std::vector<ColumnGroup> groups,
        Provenance origin, RunOptions&& options);

  // Everything that the rest of the work depends on except the scenario.
  virtual void serialize(Archive& bytes) = 0;
  virtual double reached() const = 0;
  virtual CheckpointPlace place() const = 0;
  // False until it has a state from which it can be resumed.
  virtual bool has_state() const { return true; }

  // Reads the state of what is resumed.
  void resume();
  // Opens the outputs; `other` opens those that are not tables.
  using Other = std::function<std::optional<CheckpointedOutput>(
      const std::string& path, const std::optional<SinkPosition>& from)>;
  void open(const Other& other = {});

  bool is_stopped() const { return options_.stop && options_.stop(); }
  void keep();
  // Keeps the state, and throws what `progress` has thrown, or RunInterrupted.
  [[noreturn]] void interrupt();

  // reduce(first member, result) for all cells in order, on the threads of this process or an
  // executor. After each it calls `progress`, stops if asked to, and keeps the state if a
  // checkpoint is due. A preparation comes before the cells that `progress` is called for.
  enum class Stage { preparation, cells };
  template <class Result, class Reduce>
  void compute(const Source<Result>& source, const Reduce& reduce, Stage stage = Stage::cells);

  // DomainError for more processes than cells: some would be idle. `cells` are called
  // "chunks of members", one of them "chunk".
  void require_cells_for_all(std::int64_t cells, const std::string& kind, const std::string& called,
                             const std::string& one, const std::string& advice = "") const;

  // Rows wait for their block to fill, in checkpoints too: blocks do not depend on when these were
  // made.
  void add_rows(std::span<const double> rows);
  void push_rows();
  void serialize_rows(Archive& bytes) { bytes.all(rows_, waiting_); }
  std::ptrdiff_t width() const { return static_cast<std::ptrdiff_t>(row_width(groups_)); }
  // "7 of 143 cells"
  CheckpointPlace place_among(std::int64_t size, const std::string& things) const;

  const Scenario& scenario_;
  RunOptions options_;
  std::vector<ColumnGroup> groups_;
  Provenance origin_;
  CheckpointedOutputs outputs_;
  std::vector<std::unique_ptr<Sink>> sinks_;
  std::int64_t rows_ = 0;  // in the outputs

 private:
  struct Stopped {};  // ends the loop over the cells, from within
  int threads() const;
  // Cells that are computed at a time.
  int workers() const;
  // Called after a cell, with the number of cells left; a short last cell is a fraction.
  void took(double left, Stage stage);

  double reached_before_ = 0.0;
  std::int64_t rows_before_ = 0;
  std::vector<double> waiting_;  // rows that are not
  CellClock clock_;
  std::exception_ptr raised_;  // by `progress`
};

template <class Result, class Reduce>
void Sweep::compute(const Source<Result>& source, const Reduce& reduce, Stage stage) {
  const Progress look = [this](double) {
    if (is_stopped()) throw Stopped();
  };
  const CellRange& range = source.range;
  const auto take = [&](std::int64_t cell, const Result& result) {
    reduce(range.begin_of(cell), result);
    took(
        static_cast<double>(range.end - range.begin_of(cell + 1)) / static_cast<double>(range.each),
        stage);
  };
  clock_.begin(workers());
  try {
    if (options_.executor == nullptr || source.work == nullptr)
      return ensemble::ordered_parallel_for(
          range.first_cell(), range.end_cell(), threads(),
          [&](std::int64_t cell) { return source.cell(cell, look); }, take);
    options_.executor->run(
        *source.work,
        {source.work->stage(range, source.stage), range.first_cell(), range.end_cell()},
        [&](std::int64_t cell, const std::string& from) {
          Archive bytes(from);
          Result result;
          source.serialize(bytes, result);
          take(cell, result);
        },
        [&] { look(0.0); });
  } catch (const ensemble::ExecutorError&) {  // of another process: what this one has is whole
    if (reached() > reached_before_) keep();
    throw;
  } catch (const Stopped&) {
    interrupt();
  }
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
