// SPDX-License-Identifier: MIT
// The run of an ensemble into files, and that of a single member.
#include "polhode/run/ensemble_run.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/run/run.hpp"
#include "run/detail/machine.hpp"
#include "run/detail/sweep.hpp"
#include "run/ensemble/ensemble_cells.hpp"
#include "run/ensemble/ensemble_files.hpp"
#include "run/ensemble/statistics/statistics.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::EnsembleCells;
using detail::EnsembleChunk;
using detail::RowStatistics;
using detail::StatisticsFrame;

constexpr std::size_t longest_message_path = 1000;

// A format of the rows of one motion, which those of an ensemble are not.
void require_tables(const OutputFormats& formats, const std::vector<std::string>& paths) {
  const auto is_table = [](const OutputFormat& format) { return !format.needs.dates; };
  std::vector<OutputFormat> tables;
  std::ranges::copy_if(formats.all(), std::back_inserter(tables), is_table);
  const OutputFormats of_tables(std::move(tables));
  for (const std::string& path : paths) {
    const OutputFormat* const format = formats.of_extension(path);
    if (format == nullptr) static_cast<void>(of_tables.of_output(path));  // says what there is
    if (format != nullptr && format->needs.dates)
      throw DomainError(detail::printable(path, longest_message_path) + ": " + format->label +
                        " holds one motion; expected " + paths_in_words(formats, is_table));
  }
}

std::vector<ColumnGroup> groups_of(const ScenarioEnsemble& ensemble, const EnsembleCells& cells) {
  return cells.frame() != nullptr ? cells.frame()->groups()
         : cells.has_files()      ? detail::ChunkFiles::index_groups()
                                  : detail::row_groups_of(ensemble);
}

// DomainError for a path that is no table.
detail::CheckpointSetup setup_of(const ScenarioEnsemble& ensemble, const EnsembleCells& cells,
                                 const std::vector<std::string>& paths, const RunOptions& options) {
  require_tables(ensemble.scenario().output.formats, paths);
  return detail::with_machine(
      detail::setup_of_tables({"ensemble", "runs this one anew"}, ensemble.scenario(),
                              groups_of(ensemble, cells), paths),
      options);
}

}  // namespace

std::vector<ColumnGroup> ensemble_groups(const ScenarioEnsemble& ensemble) {
  return ensemble.plan().keep == EnsembleKeep::statistics ? StatisticsFrame(ensemble).groups()
                                                          : detail::row_groups_of(ensemble);
}

class EnsembleRun::Parts final : public detail::Sweep {
 public:
  Parts(const ScenarioEnsemble& ensemble, const std::vector<std::string>& paths,
        std::unique_ptr<EnsembleCells> cells, RunOptions options)
      : Sweep(ensemble.scenario(),
              setup_of(ensemble, *cells, detail::ChunkFiles::kept(paths), options),
              groups_of(ensemble, *cells), detail::provenance_of(ensemble, cells->frame()),
              std::move(options)),
        ensemble_(ensemble),
        cells_(std::move(cells)),
        frame_(cells_->frame()),
        histograms_(detail::histogram_paths(ensemble, paths)),
        drawn_(ensemble.plan().keys().size(), ensemble::NumberMoments(1)) {
    if (cells_->has_files()) origin_.row_dimension = "chunk";
    require_cells_for_all(cells_->members(0).range.end_cell(), "ensemble", "chunks of members",
                          "chunk", cells_->is_by_chunks() ? ", or a smaller ensemble.chunk" : "");
    if (outputs_.is_complete()) {
      detail::require_there(histograms_, options_.words);
      detail::require_there(cells_->files_before(ensemble.size()), options_.words);
      return;
    }
    resume();
    detail::require_there(cells_->files_before(report_.members), options_.words);
    open();
  }

  EnsembleReport run() {
    if (outputs_.is_complete()) return std::move(report_);
    outputs_.with_remedy([&] {
      if (frame_ && !statistics_) prepare();
      compute(cells_->members(report_.members),
              [&](std::int64_t, const EnsembleChunk& chunk) { reduce(chunk); });
      if (report_.failed == report_.members) fail();
      if (frame_) {
        const std::vector<double> rows = statistics_->rows();
        add_rows(rows);
        report_.statistics.assign(rows.end() - width(), rows.end());
        report_.events = statistics_->first_times();
        report_.histograms = statistics_->histograms();
      }
      detail::write_histograms(report_.histograms, histograms_, scenario_.output.formats, origin_);
      push_rows();
      for (const std::unique_ptr<Sink>& sink : sinks_) {
        detail::say_failures(*sink, report_.failures, report_.failed, report_.members);
        sink->finish();
      }
      outputs_.forget();
    });
    for (const ensemble::NumberMoments& key : drawn_)
      report_.drawn.push_back(
          {key.mean(0), key.deviation(0), key.least(0).value, key.greatest(0).value});
    return std::move(report_);
  }

  const std::vector<ColumnGroup>& groups() const { return groups_; }

 private:
  void serialize(Archive& bytes) override {
    bytes.all(report_.members, report_.failed);
    bytes.list(report_.failures, [&](EnsembleReport::Failure& f) { bytes.all(f.member, f.why); });
    detail::serialize_all(bytes, drawn_);
    serialize_rows(bytes);
    if (!frame_) return;
    frame_->serialize(bytes);
    if (bytes.reads()) statistics_.emplace(*frame_);
    statistics_->serialize(bytes);
  }
  double reached() const override { return static_cast<double>(report_.members); }
  detail::CheckpointPlace place() const override {
    return place_among(ensemble_.size(), "members");
  }
  bool has_state() const override { return !frame_ || statistics_; }

  // The base, and the first members where bins and references come from these.
  void prepare() {
    const detail::Source<EnsembleMember> base{
        .range = {0, 1, 1}, .members = [&](std::int64_t, std::int64_t, const Progress& look) {
          return ensemble_.base(look);
        }};
    compute(
        base, [&](std::int64_t, const EnsembleMember& one) { frame_->set_base(one); },
        Stage::preparation);
    compute(
        cells_->pilots(),
        [&](std::int64_t first, const detail::Pilots& done) {
          for (std::size_t m = 0; m < done.size(); ++m)
            frame_->add_pilot(first + static_cast<std::int64_t>(m), done[m]);
        },
        Stage::preparation);
    frame_->finish_pilots();
    statistics_.emplace(*frame_);
  }

  void reduce(const EnsembleChunk& chunk) {
    if (chunk.statistics) statistics_->merge(*chunk.statistics);
    add_rows(chunk.rows);
    for (const std::vector<double>& drawn : chunk.drawn) {
      for (std::size_t i = 0; i < drawn.size(); ++i) drawn_[i].add(report_.members, {&drawn[i], 1});
      ++report_.members;
    }
    for (const EnsembleReport::Failure& failure : chunk.failures) {
      ++report_.failed;
      if (report_.failures.size() < detail::failures_named) report_.failures.push_back(failure);
    }
  }

  // Nobody is left to say anything of: what would be there has no name of a complete file.
  [[noreturn]] void fail() {
    push_rows();
    outputs_.forget();
    throw EnsembleFailed(
        detail::all_failed_text(scenario_.document.name, report_.failures, report_.members));
  }

  const ScenarioEnsemble& ensemble_;
  std::unique_ptr<EnsembleCells> cells_;
  StatisticsFrame* frame_;               // where statistics are kept
  std::vector<std::string> histograms_;  // paths of their files
  EnsembleReport report_;
  std::vector<ensemble::NumberMoments> drawn_;  // by key
  std::optional<RowStatistics> statistics_;
};

EnsembleRun::EnsembleRun(const ScenarioEnsemble& ensemble, const std::vector<std::string>& outputs,
                         RunOptions options)
    : ResumableRun(std::make_unique<Parts>(
          ensemble, outputs,
          std::make_unique<EnsembleCells>(ensemble, options.any_machine,
                                          detail::ChunkFiles::pattern(ensemble, outputs)),
          std::move(options))) {}
const std::vector<ColumnGroup>& EnsembleRun::groups() const {
  return static_cast<const Parts&>(*sweep_).groups();
}
EnsembleReport EnsembleRun::run() { return static_cast<Parts&>(*sweep_).run(); }

// Opened when the rows are there: a member that cannot be leaves no file.
MemberReport write_member(const ScenarioEnsemble& ensemble, std::int64_t index,
                          const Scenario& alone, const std::vector<std::string>& outputs,
                          const RunOptions& options) {
  const Provenance origin = provenance(alone);
  const std::vector<ColumnGroup>& groups = ensemble.row_groups();
  detail::CheckpointedOutputs files(
      detail::setup_of_tables({"run", "runs the member anew"}, alone, groups, outputs), options,
      origin);
  if (files.is_complete()) return {.was_complete = true};
  const EnsembleMember member = ensemble.member(index);
  files.with_remedy([&] {
    std::vector<std::unique_ptr<Sink>> sinks;
    files.open([&](const std::string& path, const std::optional<SinkPosition>& from) {
      sinks.push_back(open_sink(path, groups, origin, from, alone.output.formats));
      return detail::checkpointed_output(*sinks.back());
    });
    for (const std::unique_ptr<Sink>& sink : sinks) {
      sink->push(member.rows);
      if (member.failure.empty()) sink->finish();
    }
    files.forget();  // which asks the sinks
  });
  return {.failure = member.failure};
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
