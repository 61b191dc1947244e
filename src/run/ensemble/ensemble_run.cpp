// SPDX-License-Identifier: MIT
// The run of an ensemble into files, and that of a single member.
#include "polhode/run/ensemble_run.hpp"

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "polhode/ensemble/cells.hpp"
#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "polhode/trajectory/state_bytes.hpp"
#include "run/detail/checkpoint.hpp"
#include "run/ensemble/ensemble_cells.hpp"
#include "run/ensemble/ensemble_checkpoint.hpp"
#include "run/ensemble/ensemble_files.hpp"
#include "run/ensemble/statistics/statistics.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::EnsembleChunk;
using detail::RowStatistics;
using detail::StatisticsFrame;

constexpr std::size_t numbers_per_block = 65536;

// Ends the loop over the members, from within.
struct Stopped {};

}  // namespace

std::vector<ColumnGroup> ensemble_groups(const ScenarioEnsemble& ensemble) {
  return ensemble.plan().keep == EnsembleKeep::statistics ? StatisticsFrame(ensemble).groups()
                                                          : detail::row_groups_of(ensemble);
}

class EnsembleRun::Parts {
 public:
  Parts(const ScenarioEnsemble& ensemble, const std::vector<std::string>& paths,
        EnsembleOptions options)
      : ensemble_(ensemble),
        options_(std::move(options)),
        threads_(options_.threads > 0 ? options_.threads : hardware_threads()),
        cells_(ensemble, options_.any_machine, detail::ChunkFiles::pattern(ensemble, paths)),
        frame_(cells_.frame()),
        groups_(frame_               ? frame_->groups()
                : cells_.has_files() ? detail::ChunkFiles::index_groups()
                                     : detail::row_groups_of(ensemble)),
        origin_(detail::provenance_of(ensemble, frame_)),
        outputs_(
            detail::setup_of_ensemble(ensemble, groups_, detail::ChunkFiles::kept(paths), options_),
            origin_),
        histograms_(detail::histogram_paths(ensemble, paths)),
        drawn_(ensemble.plan().keys().size(), NumberMoments(1)) {
    if (cells_.has_files()) origin_.row_dimension = "chunk";
    require_work_for_all();
    if (outputs_.is_complete()) {
      detail::require_there(histograms_, options_.words);
      detail::require_there(cells_.files_before(ensemble.size()), options_.words);
      return;
    }
    if (outputs_.continues()) {
      StateBytes bytes(outputs_.state());
      transfer(bytes);
      detail::require_there(cells_.files_before(report_.members), options_.words);
    }
    outputs_.with_remedy([&] { open(); });
    members_before_ = report_.members;
  }

  EnsembleReport run() {
    if (outputs_.is_complete()) return std::move(report_);
    outputs_.with_remedy([&] {
      compute();
      if (report_.failed == report_.members) fail();
      if (frame_) waiting_ = statistics_->rows();
      if (frame_) report_.statistics.assign(waiting_.end() - width(), waiting_.end());
      if (frame_) report_.events = statistics_->first_times();
      if (frame_) report_.histograms = statistics_->histograms();
      detail::write_histograms(report_.histograms, histograms_, ensemble_.scenario().output.formats,
                               origin_);
      push_waiting();
      for (const std::unique_ptr<Sink>& sink : sinks_) {
        detail::say_failures(*sink, report_.failures, report_.failed, report_.members);
        sink->finish();
      }
      outputs_.forget();
    });
    for (const NumberMoments& key : drawn_)
      report_.drawn.push_back(
          {key.mean(0), key.deviation(0), key.least(0).value, key.greatest(0).value});
    return std::move(report_);
  }

  const detail::KeptOutputs& outputs() const { return outputs_; }
  const std::vector<ColumnGroup>& groups() const { return groups_; }
  std::int64_t members() const { return members_before_; }

 private:
  std::ptrdiff_t width() const { return static_cast<std::ptrdiff_t>(row_width(groups_)); }

  // All that the checkpoint holds, between two chunks.
  void transfer(StateBytes& bytes) {
    bytes.all(report_.members, report_.failed);
    bytes.list(report_.failures, [&](EnsembleReport::Failure& f) { bytes.all(f.member, f.why); });
    detail::transfer_all(bytes, drawn_);
    bytes(waiting_);
    if (!frame_) return;
    frame_->transfer(bytes);
    if (bytes.reads()) statistics_.emplace(*frame_);
    statistics_->transfer(bytes);
  }

  void open() {
    sinks_ = detail::opened_tables(outputs_, ensemble_.scenario(), groups_, origin_);
    if (options_.extra_sink) sinks_.push_back(std::move(options_.extra_sink));
  }

  bool is_stopped() const { return options_.stop && options_.stop(); }

  // More processes than cells of all the members would wait for nothing.
  void require_work_for_all() const {
    if (options_.team == nullptr) return;
    const std::int64_t cells = cells_.member_cells(0).count();
    const int processes = options_.team->processes();
    if (processes <= cells) return;
    throw DomainError(ensemble_.scenario().document.name + ": ensemble: " +
                      std::to_string(processes) + " processes for " + std::to_string(cells) +
                      " chunks of members; expected a chunk for each at least: fewer processes" +
                      (cells_.is_by_chunks() ? ", or a smaller ensemble.chunk" : ""));
  }

  void compute() {
    // a member without steps looks once
    const Progress look = [this](double) {
      if (is_stopped()) throw Stopped();
    };
    try {
      if (frame_ && !statistics_) prepare(look);
      const detail::CellsOfMembers cells = cells_.member_cells(report_.members);
      each_cell<EnsembleChunk>(
          cells.count(), look, [&] { return cells_.member_stage(cells.first); },
          [&](std::int64_t cell) { return cells_.chunk(cells, cell, look); },
          [&](StateBytes& bytes, EnsembleChunk& chunk) { chunk.transfer(bytes, frame_); },
          [&](std::int64_t, const EnsembleChunk& chunk) { take(chunk); });
    } catch (const TeamError&) {  // of another process: what this one has is whole
      if (report_.members > members_before_) keep();
      throw;
    } catch (const Stopped&) {
      if (statistics_ || !frame_) keep();
      if (raised_) std::rethrow_exception(raised_);
      throw EnsembleInterrupted(
          ensemble_.scenario().document.name + ": stopped after " + done_text(), report_.members,
          outputs_.keeps());
    }
  }

  // The base, and the first members where bins and references come from these.
  void prepare(const Progress& look) {
    frame_->set_base(ensemble_.base(look));
    const detail::CellsOfMembers cells = cells_.pilot_cells();
    each_cell<detail::Pilots>(
        cells.count(), look, [&] { return cells_.pilot_stage(); },
        [&](std::int64_t cell) { return cells_.pilots(cells, cell, look); },
        [](StateBytes& bytes, detail::Pilots& pilots) { detail::transfer(bytes, pilots); },
        [&](std::int64_t cell, const detail::Pilots& done) {
          for (std::size_t m = 0; m < done.size(); ++m)
            frame_->add_pilot(cells.begin_of(cell) + static_cast<std::int64_t>(m), done[m]);
        });
    frame_->finish_pilots();
    statistics_.emplace(*frame_);
  }

  // take(k, compute(k)) in order: on the threads of this process, or by bytes on those of a team.
  template <class Result, class Stage, class Compute, class Transfer, class Take>
  void each_cell(std::int64_t count, const Progress& look, const Stage& stage,
                 const Compute& compute, const Transfer& transfer_result, const Take& take) {
    if (options_.team == nullptr) return run_cells(0, count, threads_, compute, take);
    options_.team->run(
        cells_, {stage(), 0, count},
        [&](std::int64_t cell, const std::string& from) {
          StateBytes bytes(from);
          Result result;
          transfer_result(bytes, result);
          take(cell, result);
        },
        [&] { look(0.0); });
  }

  // The next one, in order.
  void take(const EnsembleChunk& chunk) {
    if (chunk.statistics) statistics_->merge(*chunk.statistics);
    waiting_.insert(waiting_.end(), chunk.rows.begin(), chunk.rows.end());
    for (const std::vector<double>& drawn : chunk.drawn) {
      for (std::size_t i = 0; i < drawn.size(); ++i) drawn_[i].add(report_.members, {&drawn[i], 1});
      ++report_.members;
    }
    for (const EnsembleReport::Failure& failure : chunk.failures) {
      ++report_.failed;
      if (report_.failures.size() < detail::failures_named) report_.failures.push_back(failure);
    }
    if (waiting_.size() >= numbers_per_block) push_waiting();
    try {
      if (options_.progress) options_.progress(report_.members);
    } catch (...) {
      raised_ = std::current_exception();
      throw Stopped();
    }
    if (report_.members == ensemble_.size()) return;
    if (is_stopped()) throw Stopped();
    if (outputs_.is_due()) keep();
  }

  // Nobody is left to say anything of: what would be there has no name of a complete file.
  [[noreturn]] void fail() {
    push_waiting();
    outputs_.forget();
    throw EnsembleFailed(detail::all_failed_text(ensemble_.scenario().document.name,
                                                 report_.failures, report_.members));
  }

  void push_waiting() {
    if (waiting_.empty()) return;
    for (const std::unique_ptr<Sink>& sink : sinks_) sink->push(waiting_);
    waiting_.clear();
  }

  std::string done_text() const {
    return std::to_string(report_.members) + " of " + std::to_string(ensemble_.size()) + " members";
  }

  void keep() {
    StateBytes bytes;
    transfer(bytes);
    outputs_.keep({bytes.bytes(), done_text(), "after " + done_text()});
  }

  const ScenarioEnsemble& ensemble_;
  EnsembleOptions options_;
  int threads_;
  detail::EnsembleCells cells_;
  StatisticsFrame* frame_;  // where statistics are kept
  std::vector<ColumnGroup> groups_;
  Provenance origin_;
  detail::KeptOutputs outputs_;
  std::vector<std::string> histograms_;  // paths of their files
  EnsembleReport report_;
  std::vector<NumberMoments> drawn_;  // by key
  std::vector<double> waiting_;       // rows that are not in the outputs
  std::optional<RowStatistics> statistics_;
  std::int64_t members_before_ = 0;
  std::vector<std::unique_ptr<Sink>> sinks_;
  std::exception_ptr raised_;  // by `progress`
};

EnsembleRun::EnsembleRun(const ScenarioEnsemble& ensemble, const std::vector<std::string>& outputs,
                         EnsembleOptions options)
    : parts_(std::make_unique<Parts>(ensemble, outputs, std::move(options))) {}
EnsembleRun::~EnsembleRun() = default;
const std::vector<ColumnGroup>& EnsembleRun::groups() const { return parts_->groups(); }
bool EnsembleRun::continues() const { return parts_->outputs().continues(); }
bool EnsembleRun::is_complete() const { return parts_->outputs().is_complete(); }
std::int64_t EnsembleRun::members() const { return parts_->members(); }
EnsembleReport EnsembleRun::run() { return parts_->run(); }

// Opened when the rows are there: a member that cannot be leaves no file.
MemberReport write_member(const ScenarioEnsemble& ensemble, std::int64_t index,
                          const Scenario& alone, const std::vector<std::string>& outputs,
                          RunBegin begin, const BeginWords& words) {
  const Provenance origin = provenance(alone);
  const std::vector<ColumnGroup>& groups = ensemble.row_groups();
  detail::KeptSetup setup =
      detail::setup_of_tables({"run", "runs the member anew"}, alone, groups, outputs);
  setup.begin = begin;
  setup.words = words;
  detail::KeptOutputs kept(std::move(setup), origin);
  if (kept.is_complete()) return {.was_complete = true};
  const EnsembleMember member = ensemble.member(index);
  kept.with_remedy([&] {
    const std::vector<std::unique_ptr<Sink>> sinks =
        detail::opened_tables(kept, alone, groups, origin);
    for (const std::unique_ptr<Sink>& sink : sinks) {
      sink->push(member.rows);
      if (member.failure.empty()) sink->finish();
    }
    kept.forget();  // which asks the sinks
  });
  return {.failure = member.failure};
}

}  // namespace v0
}  // namespace polhode
