// SPDX-License-Identifier: MIT
#include "run/ensemble/ensemble_cells.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/run/run.hpp"
#include "run/ensemble/ensemble_files.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

void serialize_cell(Archive& bytes, Pilots& pilots, const StatisticsFrame*) {
  bytes.list(pilots, [&](EnsembleMember& one) { bytes.all(one.drawn, one.rows, one.failure); });
}
void serialize_cell(Archive& bytes, EnsembleChunk& chunk, const StatisticsFrame* frame) {
  chunk.serialize(bytes, frame);
}

constexpr std::size_t longest_reason = 1000;
constexpr std::int64_t most_at_a_time = 16;     // members whose rows one thread holds
constexpr double most_numbers_at_a_time = 1e6;  // in these rows
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void EnsembleChunk::serialize(Archive& bytes, const StatisticsFrame* frame) {
  bytes(drawn);
  bytes.list(failures, [&](EnsembleReport::Failure& f) { bytes.all(f.member, f.why); });
  bytes(rows);
  if (frame == nullptr) return;
  if (bytes.reads()) statistics.emplace(*frame);
  statistics->serialize(bytes);
}

EnsembleCells::EnsembleCells(const ScenarioEnsemble& ensemble, bool any_machine,
                             std::string chunk_files)
    : SourceWork(ensemble.scenario(), "ensemble", ensemble.row_groups(), any_machine),
      ensemble_(ensemble),
      chunk_files_(std::move(chunk_files)),
      frame_(ensemble.plan().keep == EnsembleKeep::statistics
                 ? std::make_unique<StatisticsFrame>(ensemble)
                 : nullptr) {}

std::vector<std::string> EnsembleCells::files_before(std::int64_t member) const {
  std::vector<std::string> paths;
  if (!has_files()) return paths;
  const ChunkFiles files(ensemble_, chunk_files_);
  for (std::int64_t first = 0; first < member; first += ensemble_.plan().chunk)
    paths.push_back(files.path(first));
  return paths;
}

std::int64_t EnsembleCells::members_at_a_time() const {
  const double numbers = static_cast<double>(row_times(ensemble_.scenario())->size()) *
                         static_cast<double>(row_width(ensemble_.row_groups()));
  const double fit = std::clamp(most_numbers_at_a_time / numbers, 1.0, double{most_at_a_time});
  return static_cast<std::int64_t>(fit);
}

template <class Result>
Source<Result> EnsembleCells::source(const CellRange& range,
                                     Result (EnsembleCells::*made)(std::int64_t, std::int64_t,
                                                                   const Progress&) const) {
  constexpr bool are_pilots = std::is_same_v<Result, Pilots>;
  return {.range = range,
          .members = [this, made](std::int64_t begin, std::int64_t end,
                                  const Progress& look) { return (this->*made)(begin, end, look); },
          .work = this,
          .stage =
              [this](Archive& bytes) {
                bool pilots = are_pilots;
                bytes.all(pilots, chunk_files_);
                if (!pilots && frame_) frame_->serialize(bytes);
              },
          .serialize = [this](Archive& bytes,
                              Result& result) { serialize_cell(bytes, result, frame_.get()); }};
}

Source<Pilots> EnsembleCells::pilots() {
  return source({0, frame_->pilots(), members_at_a_time()}, &EnsembleCells::members_of);
}

// Rows are whole after any member; statistics and files after a chunk.
Source<EnsembleChunk> EnsembleCells::members(std::int64_t from) {
  const std::int64_t each = is_by_chunks() ? ensemble_.plan().chunk : members_at_a_time();
  return source({from, ensemble_.size(), each}, &EnsembleCells::chunk_of);
}

Pilots EnsembleCells::members_of(std::int64_t begin, std::int64_t end, const Progress& look) const {
  look(0.0);  // a member without steps does not
  return ensemble_.members(begin, end, look);
}

EnsembleChunk EnsembleCells::chunk_of(std::int64_t begin, std::int64_t end,
                                      const Progress& look) const {
  EnsembleChunk chunk;
  if (frame_) chunk.statistics.emplace(*frame_);
  const std::int64_t each = members_at_a_time();
  std::unique_ptr<Sink> file;
  if (has_files()) file = ChunkFiles(ensemble_, chunk_files_).open(begin, end);
  std::size_t numbers = 0;  // in the file
  for (std::int64_t first = begin; first < end; first += each) {
    std::vector<EnsembleMember> some = members_of(first, std::min(end, first + each), look);
    if (frame_) chunk.statistics->add(first, some);
    for (std::size_t m = 0; m < some.size(); ++m) {
      const std::int64_t index = first + static_cast<std::int64_t>(m);
      if (!frame_) append_rows(index, some[m], chunk.rows);
      if (!some[m].failure.empty())
        chunk.failures.push_back({index, printable(some[m].failure, longest_reason)});
      chunk.drawn.push_back(std::move(some[m].drawn));
    }
    if (!file) continue;
    file->push(chunk.rows);
    numbers += chunk.rows.size();
    chunk.rows.clear();
  }
  if (!file) return chunk;
  say_failures(*file, chunk.failures, static_cast<std::int64_t>(chunk.failures.size()),
               end - begin);
  file->finish();
  const std::size_t rows = numbers / row_width(row_groups_of(ensemble_));
  const std::int64_t place = begin / ensemble_.plan().chunk;
  chunk.rows = {static_cast<double>(place), static_cast<double>(begin),
                static_cast<double>(end - begin), static_cast<double>(chunk.failures.size()),
                static_cast<double>(rows)};
  return chunk;
}

void EnsembleCells::append_rows(std::int64_t index, const EnsembleMember& member,
                                std::vector<double>& to) const {
  const auto width = static_cast<std::ptrdiff_t>(row_width(ensemble_.row_groups()));
  const auto row_at = [&](std::ptrdiff_t begin) {
    to.insert(to.end(), member.rows.begin() + begin, member.rows.begin() + begin + width);
  };
  const auto size = static_cast<std::ptrdiff_t>(member.rows.size());
  if (ensemble_.plan().keep == EnsembleKeep::rows) {
    for (std::ptrdiff_t k = 0; k < size; k += width) {
      to.push_back(static_cast<double>(index));
      row_at(k);
    }
    return;
  }
  to.push_back(static_cast<double>(index));
  to.insert(to.end(), member.drawn.begin(), member.drawn.end());
  if (member.failure.empty() && size > 0)
    row_at(size - width);
  else
    to.insert(to.end(), static_cast<std::size_t>(width), nan);
}

void EnsembleCells::begin_stage(const CellRange& range, Archive& bytes) {
  bool are_pilots = false;
  bytes.all(are_pilots, chunk_files_);
  if (are_pilots) return computes(source(range, &EnsembleCells::members_of));
  computes(source(range, &EnsembleCells::chunk_of));
  if (!frame_) return;
  // The leader's own: its bins stay those that it merges into, which are then alike at a glance.
  Archive own;
  frame_->serialize(own);
  std::string theirs;
  bytes.rest(theirs);
  if (own.bytes() == theirs) return;
  Archive frame(theirs);
  frame_->serialize(frame);
}

}  // namespace detail

std::unique_ptr<ensemble::ExecutorWork> ensemble_work(Scenario scenario, bool any_machine) {
  return detail::work_of<detail::EnsembleCells, ScenarioEnsemble>(std::move(scenario), any_machine);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
