// SPDX-License-Identifier: MIT
// Checkpoints: what a run must agree in, the files of an earlier run, and outputs that continue.
#include "run/detail/checkpointed_outputs.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <ranges>
#include <sstream>
#include <string_view>
#include <utility>
#include <variant>

#include "output/part_file.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/error.hpp"
#include "polhode/version.hpp"
#include "run/detail/experiments.hpp"
#include "run/detail/output_checks.hpp"
#include "text/file_bytes.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// The part of a checkpoint in front of the state.
struct CheckpointHead {
  std::string kind;
  Identity identity;
  CheckpointPlace place;
  std::vector<SinkPosition> positions;

  void serialize(Archive& bytes) {
    bytes(kind);
    serialize_identity(bytes, identity);
    bytes.all(place.reached, place.goes_on);
    bytes.list(positions, [&](SinkPosition& p) { bytes.all(p.bytes, p.rows); });
  }
};

namespace {

namespace fs = std::filesystem;

constexpr std::string_view checkpoint_format = "polhode outputs 3";
constexpr std::string_view pointer_head = "the checkpoint is\n";
constexpr std::size_t hash_bytes = 8;

std::string fingerprint_text(std::string_view bytes) {
  return "mark " + std::to_string(fingerprint(bytes));
}

// The same text and files may mean something else to another build.
std::string surroundings_of(const Rotation& rotation) {
  const System system = at_damper_rate(rotor_system(rotation), rotation.damper_rate);
  const double stop = rotation.time ? rotation.time->end() : 0.0;  // a fit may have no rows
  Archive bytes;
  for (int i = 0; i < 16; ++i) {
    const double t = stop * (i / 15.0);
    try {
      Effect e = effect(system, t, initial_state(rotation));
      bytes.all(e.v, e.u);
    } catch (const std::exception&) {  // the run will say so
      double none = t;
      bytes(none);
    }
  }
  return fingerprint_text(bytes.bytes());
}
std::string surroundings_of(const Obliquity& of) {
  Archive bytes;
  with_problem(of, [&](const auto& problem) {
    auto start = problem.system.template values<double>(problem.initial);
    for (double& x : start) bytes(x);
    for (int i = 0; i < 16; ++i) {
      auto rates = problem.system.rates(DoubleDouble(problem.stop * (i / 15.0)), start);
      for (double& x : rates) bytes(x);
    }
  });
  return fingerprint_text(bytes.bytes());
}
std::string surroundings_of(const CustomExperiment& own) { return fingerprint_text(own.identity); }

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

bool is_there(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// The file next to an output itself, or the checkpoint that it points to.
std::string followed(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string head(pointer_head.size(), '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!stream || head != pointer_head) return file;
  std::ostringstream rest;
  rest << stream.rdbuf();
  std::string target = rest.str();
  if (target.ends_with('\n')) target.pop_back();
  return (fs::path(file).parent_path() / target).string();
}

// A line for people, the format, a hash of what follows, the head and the state.
std::string text_of(CheckpointHead head, const std::function<void(Archive&)>& serialize) {
  Archive body, title;
  head.serialize(body);
  serialize(body);
  std::string format(checkpoint_format);
  std::uint64_t hash = fingerprint(body.bytes());
  title.all(format, hash);
  return head.place.reached + "\n" + title.bytes() + body.bytes();
}

// Leaves `reader` at the state. Nothing if the text is no checkpoint of this format, or was
// damaged.
std::optional<CheckpointHead> head_in(std::string_view text, Archive& reader) {
  const std::size_t line = text.find('\n');
  const std::string_view bytes =
      line == std::string_view::npos ? std::string_view() : text.substr(line + 1);
  reader = Archive(bytes);
  CheckpointHead head;
  try {
    std::string format;
    std::uint64_t hash = 0;
    reader.all(format, hash);
    const std::size_t title = sizeof(std::uint64_t) + format.size() + hash_bytes;
    if (format != checkpoint_format || fingerprint(bytes.substr(title)) != hash)
      return std::nullopt;
    head.serialize(reader);
  } catch (const DomainError&) {
    return std::nullopt;
  }
  return head;
}

std::string shown_path(const std::string& path) { return printable(path, 500); }

std::string checkpoint_path(const std::string& output) { return output + ".checkpoint"; }

// The checkpoint of the unfinished run that an output belongs to: next to it, or next to the first
// output of that run. Empty: there is none. DomainError when there should be one.
std::string checkpoint_among(std::span<const std::string> outputs, const BeginWords& words) {
  for (const std::string& output : outputs) {
    const std::string own = checkpoint_path(output);
    if (output == "-" || !is_there(own)) continue;
    std::string checkpoint = followed(own);
    if (is_there(checkpoint)) return checkpoint;
    throw DomainError(shown_path(own) +
                      ": an unfinished run or map is there; expected its checkpoint " +
                      shown_path(checkpoint) + ", which is gone: put it back, or " + words.restart +
                      " begins anew");
  }
  return {};
}

// A renamed file is on the disk when its folder is.
void sync_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // a folder that cannot be synced is none of a local disk
  ::close(descriptor);
}

// Leaves next to an output where the checkpoint of its run is.
void point_to_checkpoint(const std::string& output, const std::string& checkpoint) {
  const fs::path folder = fs::absolute(output).parent_path();
  std::error_code failed;
  fs::path target = fs::proximate(fs::absolute(checkpoint), folder, failed);
  if (failed) target = fs::absolute(checkpoint);
  replace_file(checkpoint_path(output), std::string(pointer_head) + target.string() + "\n");
  sync_folder_of(output);
}

// That of the first output last: what points to it does not outlive it. Then the files that only a
// resume needs.
void forget_checkpoints(std::span<const std::string> outputs) {
  std::error_code ignored;
  for (const std::string& output : outputs | std::views::reverse)
    if (output != "-") fs::remove(checkpoint_path(output), ignored);
  for (const std::string& output : outputs) {
    if (output == "-") continue;
    fs::remove(checkpoint_path(output) + ".part", ignored);
    fs::remove(undo_path(output + ".part"), ignored);
  }
}

// "FILE: an unfinished run is there (REACHED); resume continues it, ..."
[[noreturn]] void refuse_unfinished(const std::string& file, const std::string& kind,
                                    const std::string& progress, const BeginWords& words) {
  throw DomainError(shown_path(file) + ": an unfinished " + kind + " is there (" +
                    printable(progress, 500) + "); " + words.resume + " continues it, " +
                    words.restart + " begins anew and loses what it has done");
}

// True if all outputs are complete and none is being written. Throws DomainError for an output of
// another scenario, of other data files or with other columns, and for one that does not name them.
bool are_complete(std::span<const PlannedOutput> outputs, const OutputFormats& formats,
                  const Provenance& provenance, const BeginWords& words) {
  if (std::any_of(outputs.begin(), outputs.end(), [](const PlannedOutput& output) {
        return output.path == "-" || !is_there(output.path) || is_there(output.path + ".part");
      }))
    return false;
  for (const auto& [path, groups] : outputs) {
    const OutputFormat& format = formats.of_output(path);
    const std::string why = format.difference ? format.difference(path, groups, provenance)
                                              : "and does not say of which scenario";
    if (!why.empty())
      throw DomainError(shown_path(path) + ": is there, " + why + "; " + words.restart +
                        " runs this one anew");
  }
  return true;
}

}  // namespace

Identity identity_of(const Scenario& scenario, const IdentityOutputs& outputs) {
  const Document& document = scenario.document;
  std::string files, columns;
  for (const ScenarioFile& file : document.files)
    files += (files.empty() ? "" : "; ") + file_note(file);
  for (const std::string& column : outputs.columns)
    columns += (columns.empty() ? "" : " ") + column;
  Identity identity = {
      {"version of polhode", std::string(version())},
      {"columns", columns},
      {"scenario", document.name + " " + std::to_string(document.text.size()) + " bytes, " +
                       fingerprint_text(document.text)},
      {"files of the scenario", files},
      {"method",  // the default of an older build may have been another
       std::visit([&](const auto& kind) { return propagation_text(kind, scenario.units()); },
                  scenario.experiment)},
      {surroundings_part,
       std::visit([](const auto& kind) { return surroundings_of(kind); }, scenario.experiment)}};
  for (const std::string& path : outputs.paths) identity.push_back({"outputs", file_name(path)});
  if (!outputs.events.empty())
    identity.push_back({"outputs", "events " + file_name(outputs.events)});
  return identity;
}

std::string difference(const Identity& theirs, const Identity& ours) {
  for (std::size_t i = 0; i < theirs.size() || i < ours.size(); ++i) {
    const IdentityPart was = i < theirs.size() ? theirs[i] : IdentityPart{ours[i].name, ""};
    const IdentityPart is = i < ours.size() ? ours[i] : IdentityPart{was.name, ""};
    if (was.name != is.name) return is.name + " was not kept, is \"" + is.text + "\"";
    if (was.text != is.text) return is.name + " was \"" + was.text + "\", is \"" + is.text + "\"";
  }
  return {};
}

CheckpointedOutput checkpointed_output(Sink& sink) {
  return {[&sink] { return sink.position(); }, [&sink] { sink.kept(); }};
}

CheckpointedOutputs::CheckpointedOutputs(CheckpointSetup setup, const RunOptions& options,
                                         const Provenance& provenance)
    : setup_(std::move(setup)), options_(options), timer_(options.checkpoint_seconds) {
  for (const PlannedOutput& output : setup_.outputs) paths_.push_back(output.path);
  find(provenance);
}

bool CheckpointedOutputs::are_files() const {
  return !paths_.empty() && std::all_of(paths_.begin(), paths_.end(), is_file);
}

std::string CheckpointedOutputs::remedy() const {
  if (!are_files()) return {};
  return is_safe_ ? options_.words.resume + " goes on " + goes_on_ : "run it again";
}

void CheckpointedOutputs::find(const Provenance& provenance) {
  if (options_.begin == RunBegin::restart) return;  // open() removes them
  const BeginWords& words = options_.words;
  const std::string& kind = setup_.kind.name;
  const std::string found = checkpoint_among(paths_, words);
  if (!found.empty()) found_ = file_bytes(found).value_or("");
  std::optional<CheckpointHead> head = head_in(found_, state_);
  if (!found.empty())
    for (const std::string& path : paths_) require_not_in_use(path);
  if (head && head->kind != kind)
    throw DomainError(shown_path(found) + ": an unfinished " + head->kind +
                      " is there; expected another file for the " + kind + ", or " + words.restart +
                      ", which loses the " + head->kind);
  if (options_.begin == RunBegin::anew) {
    if (found.empty()) return;
    refuse_unfinished(found, kind, found_.substr(0, found_.find('\n')), words);
  }
  if (!are_files())
    throw DomainError(kind + ": " + words.resume + " needs outputs that are files, which a " +
                      kind + " leaves behind");
  if (!found.empty()) return take_up(found, head ? &*head : nullptr);
  complete_ =
      setup_.can_be_complete && are_complete(setup_.outputs, setup_.formats, provenance, words);
  if (complete_) forget_checkpoints(paths_);  // of a kill at the very end
}

void CheckpointedOutputs::take_up(const std::string& found, CheckpointHead* head) {
  const std::string remedy = options_.words.restart + " " + setup_.kind.again;
  if (head == nullptr)
    throw DomainError(shown_path(found) +
                      ": is not a checkpoint of this version of polhode, or was damaged; " +
                      remedy);
  if (setup_.forgive) setup_.forgive(head->identity, setup_.identity);
  const std::string differs = difference(head->identity, setup_.identity);
  if (!differs.empty())
    throw DomainError(shown_path(found) + ": is of another " + setup_.kind.name + ": " + differs +
                      (setup_.advice ? setup_.advice(differs) : "") + "; " + remedy);
  goes_on_ = head->place.goes_on;
  positions_ = std::move(head->positions);
  is_safe_ = true;
  continues_ = true;
}

void CheckpointedOutputs::open(const Open& open) {
  try {
    for (std::size_t i = 0; i < paths_.size(); ++i)
      outputs_.push_back(
          open(paths_[i], continues_ ? std::optional(positions_.at(i)) : std::nullopt));
  } catch (const FileInUse&) {
    throw;
  } catch (const DomainError& error) {
    if (!continues_) throw;
    throw DomainError(std::string(error.what()) + "; put it back, or " + options_.words.restart +
                      " " + setup_.kind.again);
  }
  // Now they are ours alone.
  if (options_.begin == RunBegin::restart) forget_checkpoints(paths_);
  keeps_ = are_files();
}

void CheckpointedOutputs::keep(CheckpointPlace place,
                               const std::function<void(Archive&)>& serialize) {
  if (!keeps_) return;
  const CheckpointTimer::Clock::time_point begun = CheckpointTimer::Clock::now();
  std::vector<SinkPosition> positions;
  for (const CheckpointedOutput& output : outputs_) {
    const std::optional<SinkPosition> position = output.position();
    keeps_ = keeps_ && position.has_value();
    if (position) positions.push_back(*position);
  }
  if (!keeps_) return;
  const std::string checkpoint = checkpoint_path(paths_.front());
  replace_file(checkpoint,
               text_of({setup_.kind.name, setup_.identity, place, positions}, serialize));
  sync_folder_of(checkpoint);  // before what the checkpoint of before needs is gone
  for (const CheckpointedOutput& output : outputs_) output.kept();
  goes_on_ = std::move(place.goes_on);
  is_safe_ = true;
  for (std::size_t i = 1; i < paths_.size() && !pointed_; ++i)
    point_to_checkpoint(paths_[i], checkpoint);
  pointed_ = true;
  timer_.made(begun);
}

void CheckpointedOutputs::forget() {
  forget_checkpoints(paths_);
  for (const CheckpointedOutput& output : outputs_) output.kept();
}

CheckpointSetup setup_of_tables(CheckpointKind kind, const Scenario& scenario,
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

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
