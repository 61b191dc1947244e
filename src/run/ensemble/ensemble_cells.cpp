// SPDX-License-Identifier: MIT
#include "run/ensemble/ensemble_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "polhode/trajectory/archive.hpp"
#include "run/ensemble/ensemble_files.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

void serialize(Archive& bytes, Pilots& pilots) {
  bytes.list(pilots, [&](EnsembleMember& one) { bytes.all(one.drawn, one.rows, one.failure); });
}

constexpr std::size_t longest_reason = 1000;
constexpr std::int64_t most_at_a_time = 16;     // members whose rows one thread holds
constexpr double most_numbers_at_a_time = 1e6;  // in these rows
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr char functions_part[] = "elementary functions of the machine";

Identity identity_of_ensemble(const ScenarioEnsemble& ensemble) {
  std::vector<std::string> columns;
  for (const ColumnGroup& group : ensemble.row_groups()) columns.push_back(group.name);
  Identity identity = identity_of(ensemble.scenario(), {{}, {}, columns});
  identity.insert(identity.begin(), elementary_functions());
  return identity;
}

}  // namespace

IdentityPart elementary_functions() {
  Archive bytes;
  for (int k = 1; k <= 1000; ++k) {
    const double x = 0.003 * k;
    for (double value : {std::sin(x), std::cos(x), std::tan(x), std::atan2(x, 1.7), std::exp(-x),
                         std::log(x), std::asin(x / 4.0), std::pow(x, 1.3)})
      bytes(value);
  }
  return {functions_part, "mark " + std::to_string(fingerprint(bytes.bytes()))};
}

void take_elementary_functions(Identity& theirs, const Identity& ours) {
  const auto part_of = [](auto& identity, const std::string& of) {
    return std::find_if(identity.begin(), identity.end(),
                        [&](const IdentityPart& part) { return part.name == of; });
  };
  const auto here = part_of(ours, functions_part);
  const auto there = part_of(theirs, functions_part);
  if (here == ours.end() || there == theirs.end() || here->text == there->text) return;
  there->text = here->text;
  const auto numbers = part_of(theirs, surroundings_part);
  const auto own_numbers = part_of(ours, surroundings_part);
  if (numbers != theirs.end() && own_numbers != ours.end()) numbers->text = own_numbers->text;
}

bool differs_in_elementary_functions(const std::string& difference) {
  return difference.starts_with(functions_part);
}

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
    : ensemble_(ensemble),
      any_machine_(any_machine),
      chunk_files_(std::move(chunk_files)),
      identity_(identity_of_ensemble(ensemble)),
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
Source<Result> EnsembleCells::source(Stage stage,
                                     Result (EnsembleCells::*made)(std::int64_t, std::int64_t,
                                                                   const Progress&) const) {
  return {.members = stage.end - stage.first,
          .each = stage.each,
          .cell =
              [this, stage, made](std::int64_t cell, const Progress& look) {
                return (this->*made)(stage.begin_of(cell),
                                     std::min(stage.end, stage.begin_of(cell + 1)), look);
              },
          .work = this,
          .stage =
              [this, stage]() mutable {
                Archive bytes;
                stage.serialize(bytes);
                if (!stage.pilots && frame_) frame_->serialize(bytes);
                return bytes.bytes();
              },
          .serialize =
              [this](Archive& bytes, Result& result) {
                if constexpr (std::is_same_v<Result, Pilots>)
                  detail::serialize(bytes, result);
                else
                  result.serialize(bytes, frame_.get());
              }};
}

Source<Pilots> EnsembleCells::pilots() {
  return source(Stage{true, 0, members_at_a_time(), frame_->pilots(), identity_, chunk_files_},
                &EnsembleCells::members_of);
}

// Rows are whole after any member; statistics and files after a chunk.
Source<EnsembleChunk> EnsembleCells::members(std::int64_t from) {
  const std::int64_t each = is_by_chunks() ? ensemble_.plan().chunk : members_at_a_time();
  return source(Stage{false, from, each, ensemble_.size(), identity_, chunk_files_},
                &EnsembleCells::chunk_of);
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

void EnsembleCells::Stage::serialize(Archive& bytes) {
  bytes.all(pilots, first, each, end);
  bytes.list(identity, [&](IdentityPart& part) { bytes.all(part.name, part.text); });
  bytes(chunk_files);
}

void EnsembleCells::begin(const std::string& stage) {
  Archive bytes(stage);
  stage_.serialize(bytes);
  if (any_machine_) take_elementary_functions(stage_.identity, identity_);
  const std::string differs = difference(stage_.identity, identity_);
  if (!differs.empty())
    throw DomainError(ensemble_.scenario().document.name +
                      ": is not the ensemble that is run: " + differs +
                      (differs_in_elementary_functions(differs)
                           ? "; expected machines that are alike, or --any-machine "
                             "(any_machine=True from Python)"
                           : ""));
  chunk_files_ = stage_.chunk_files;
  if (stage_.pilots || !frame_) return;
  // The leader's own: its bins stay those that it merges into, which are then alike at a glance.
  Archive own;
  frame_->serialize(own);
  std::string theirs;
  bytes.rest(theirs);
  if (own.bytes() == theirs) return;
  Archive frame(theirs);
  frame_->serialize(frame);
}

std::string EnsembleCells::cell(std::int64_t index, const std::function<void()>& look) const {
  const Progress progress = [&](double) { look(); };
  const std::int64_t begin = stage_.begin_of(index),
                     end = std::min(stage_.end, stage_.begin_of(index + 1));
  Archive bytes;
  if (stage_.pilots) {
    Pilots some = members_of(begin, end, progress);
    serialize(bytes, some);
  } else {
    chunk_of(begin, end, progress).serialize(bytes, frame_.get());
  }
  return bytes.bytes();
}

}  // namespace detail

std::unique_ptr<ExecutorWork> ensemble_work(const ScenarioEnsemble& ensemble, bool any_machine) {
  return std::make_unique<detail::EnsembleCells>(ensemble, any_machine);
}

}  // namespace v0
}  // namespace polhode
