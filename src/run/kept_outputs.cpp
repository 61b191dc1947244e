// SPDX-License-Identifier: MIT
#include "run/detail/kept_outputs.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/trajectory/state_bytes.hpp"
#include "run/detail/own_files.hpp"
#include "run/detail/sized.hpp"
#include "text/file_bytes.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::string_view format = "polhode outputs 2";
constexpr std::size_t hash_bytes = 8;

}  // namespace

// The file of a checkpoint: a line for people, then these.
struct CheckpointFile {
  std::string kind;
  Identity identity;
  KeptState state;
  std::vector<SinkPosition> positions;

  void transfer(StateBytes& bytes) {
    bytes(kind);
    sized(bytes, identity, [&](IdentityPart& part) { bytes.all(part.name, part.text); });
    bytes.all(state.bytes, state.reached, state.goes_on);
    sized(bytes, positions, [&](SinkPosition& p) { bytes.all(p.bytes, p.rows); });
  }
};

namespace {

std::string bytes_of(CheckpointFile file) {
  StateBytes body, head;
  file.transfer(body);
  std::string title(format);
  std::uint64_t hash = fingerprint(body.bytes());
  head.all(title, hash);
  return file.state.reached + "\n" + head.bytes() + body.bytes();
}

// None of a text that is not a checkpoint of this format, or was damaged.
std::optional<CheckpointFile> file_in(const std::string& text) {
  const std::size_t line = text.find('\n');
  const std::string bytes = line == std::string::npos ? "" : text.substr(line + 1);
  StateBytes reader(bytes);
  CheckpointFile file;
  try {
    std::string title;
    std::uint64_t hash = 0;
    reader.all(title, hash);
    const std::size_t head = sizeof(std::uint64_t) + title.size() + hash_bytes;
    if (title != format || fingerprint(std::string_view(bytes).substr(head)) != hash)
      return std::nullopt;
    file.transfer(reader);
  } catch (const DomainError&) {
    return std::nullopt;
  }
  return file;
}

}  // namespace

KeptOutput kept_output(Sink& sink) {
  return {[&sink] { return sink.position(); }, [&sink] { sink.kept(); }};
}

KeptOutputs::KeptOutputs(KeptSetup setup, const Provenance& provenance)
    : setup_(std::move(setup)), pace_(setup_.seconds) {
  for (const PlannedOutput& output : setup_.outputs) paths_.push_back(output.path);
  find(provenance);
}

bool KeptOutputs::are_files() const {
  return !paths_.empty() && std::all_of(paths_.begin(), paths_.end(), is_file);
}

std::string KeptOutputs::remedy() const {
  if (!are_files()) return {};
  return is_safe_ ? setup_.words.resume + " goes on " + state_.goes_on : "run it again";
}

void KeptOutputs::find(const Provenance& provenance) {
  if (setup_.begin == RunBegin::restart) return;  // open() removes them
  const BeginWords& words = setup_.words;
  const std::string& kind = setup_.kind.name;
  const std::string found = checkpoint_among(paths_, words);
  const std::string text = found.empty() ? std::string() : file_bytes(found).value_or("");
  std::optional<CheckpointFile> file = file_in(text);
  if (!found.empty())
    for (const std::string& path : paths_) require_not_in_use(path);
  if (file && file->kind != kind)
    throw DomainError(shown_path(found) + ": an unfinished " + file->kind +
                      " is there; expected another file for the " + kind + ", or " + words.restart +
                      ", which loses the " + file->kind);
  if (setup_.begin == RunBegin::anew) {
    if (found.empty()) return;
    refuse_unfinished(found, kind, text.substr(0, text.find('\n')), words);
  }
  if (!are_files())
    throw DomainError(kind + ": " + words.resume + " needs outputs that are files, which a " +
                      kind + " leaves behind");
  if (!found.empty()) return take_up(found, std::move(file));
  complete_ = are_complete(setup_.outputs, setup_.formats, provenance, words);
  if (complete_) forget_checkpoints(paths_);  // of a kill at the very end
}

void KeptOutputs::take_up(const std::string& found, std::optional<CheckpointFile> file) {
  const std::string remedy = setup_.words.restart + " " + setup_.kind.again;
  if (!file)
    throw DomainError(shown_path(found) +
                      ": is not a checkpoint of this version of polhode, or was damaged; " +
                      remedy);
  if (setup_.forgive) setup_.forgive(file->identity, setup_.identity);
  const std::string differs = difference(file->identity, setup_.identity);
  if (!differs.empty())
    throw DomainError(shown_path(found) + ": is of another " + setup_.kind.name + ": " + differs +
                      (setup_.advice ? setup_.advice(differs) : "") + "; " + remedy);
  state_ = std::move(file->state);
  positions_ = std::move(file->positions);
  is_safe_ = true;
  continues_ = true;
}

void KeptOutputs::open(const Open& open) {
  try {
    for (std::size_t i = 0; i < paths_.size(); ++i)
      outputs_.push_back(
          open(paths_[i], continues_ ? std::optional(positions_.at(i)) : std::nullopt));
  } catch (const FileInUse&) {
    throw;
  } catch (const DomainError& error) {
    if (!continues_) throw;
    throw DomainError(std::string(error.what()) + "; put it back, or " + setup_.words.restart +
                      " " + setup_.kind.again);
  }
  // Now they are ours alone.
  if (setup_.begin == RunBegin::restart) forget_checkpoints(paths_);
  keeps_ = are_files();
}

void KeptOutputs::keep(KeptState state) {
  if (!keeps_) return;
  const Pace::Clock::time_point begun = Pace::Clock::now();
  std::vector<SinkPosition> positions;
  for (const KeptOutput& output : outputs_) {
    const std::optional<SinkPosition> position = output.position();
    keeps_ = keeps_ && position.has_value();
    if (position) positions.push_back(*position);
  }
  if (!keeps_) return;
  const std::string checkpoint = checkpoint_path(paths_.front());
  replace_file(checkpoint, bytes_of({setup_.kind.name, setup_.identity, state, positions}));
  sync_folder_of(checkpoint);  // before what the checkpoint of before needs is gone
  for (const KeptOutput& output : outputs_) output.kept();
  state_ = std::move(state);
  positions_ = std::move(positions);
  is_safe_ = true;
  for (std::size_t i = 1; i < paths_.size() && !pointed_; ++i)
    point_to_checkpoint(paths_[i], checkpoint);
  pointed_ = true;
  pace_.made(begun);
}

void KeptOutputs::forget() {
  forget_checkpoints(paths_);
  for (const KeptOutput& output : outputs_) output.kept();
}

KeptSetup setup_of_tables(KeptKind kind, const Scenario& scenario,
                          const std::vector<ColumnGroup>& groups,
                          const std::vector<std::string>& paths) {
  require_own_files(scenario.document, paths);
  std::vector<std::string> columns;
  for (const ColumnGroup& group : groups)
    for (const Column& column : group.columns) columns.push_back(column.name);
  std::vector<PlannedOutput> outputs;
  for (const std::string& path : paths) outputs.push_back({path, groups});
  return {.kind = std::move(kind),
          .identity = identity_of(scenario, {paths, {}, columns}),
          .outputs = std::move(outputs),
          .formats = scenario.output.formats};
}

std::vector<std::unique_ptr<Sink>> opened_tables(KeptOutputs& outputs, const Scenario& scenario,
                                                 const std::vector<ColumnGroup>& groups,
                                                 const Provenance& origin) {
  std::vector<std::unique_ptr<Sink>> sinks;
  outputs.open([&](const std::string& path, const std::optional<SinkPosition>& from) {
    sinks.push_back(open_sink(path, groups, origin, from, scenario.output.formats));
    return kept_output(*sinks.back());
  });
  return sinks;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
