// SPDX-License-Identifier: MIT
// Checkpoints: what a run must agree in, the files of an earlier run, and outputs that continue.
#include "run/detail/checkpoint.hpp"

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
#include "polhode/error.hpp"
#include "polhode/trajectory/state_bytes.hpp"
#include "polhode/version.hpp"
#include "run/detail/experiments.hpp"
#include "run/detail/output_checks.hpp"
#include "text/file_bytes.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The contents of a checkpoint, behind a line for people.
struct CheckpointFile {
  std::string kind;
  Identity identity;
  KeptState state;
  std::vector<SinkPosition> positions;

  void transfer(StateBytes& bytes) {
    bytes(kind);
    bytes.list(identity, [&](IdentityPart& part) { bytes.all(part.name, part.text); });
    bytes.all(state.bytes, state.reached, state.goes_on);
    bytes.list(positions, [&](SinkPosition& p) { bytes.all(p.bytes, p.rows); });
  }
};

namespace {

namespace fs = std::filesystem;

constexpr std::string_view checkpoint_format = "polhode outputs 2";
constexpr std::string_view pointer_head = "the checkpoint is\n";
constexpr std::size_t hash_bytes = 8;

std::string fingerprint_text(std::string_view bytes) {
  return "mark " + std::to_string(fingerprint(bytes));
}

// The same text and files may mean something else to another build.
std::string surroundings_of(const Rotation& rotation) {
  const System system = at_damper_rate(rotor_system(rotation), rotation.damper_rate);
  const double stop = rotation.time ? rotation.time->end() : 0.0;  // a fit may have no rows
  StateBytes bytes;
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
  StateBytes bytes;
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

std::string bytes_of(CheckpointFile file) {
  StateBytes body, head;
  file.transfer(body);
  std::string title(checkpoint_format);
  std::uint64_t hash = fingerprint(body.bytes());
  head.all(title, hash);
  return file.state.reached + "\n" + head.bytes() + body.bytes();
}

// Nothing if the text is no checkpoint of this format, or was damaged.
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
    if (title != checkpoint_format || fingerprint(std::string_view(bytes).substr(head)) != hash)
      return std::nullopt;
    file.transfer(reader);
  } catch (const DomainError&) {
    return std::nullopt;
  }
  return file;
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

std::string shown_path(const std::string& path) { return printable(path, 500); }

std::string checkpoint_path(const std::string& output) { return output + ".checkpoint"; }

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

void sync_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // a folder that cannot be synced is none of a local disk
  ::close(descriptor);
}

void refuse_unfinished(const std::string& file, const std::string& kind,
                       const std::string& progress, const BeginWords& words) {
  throw DomainError(shown_path(file) + ": an unfinished " + kind + " is there (" +
                    printable(progress, 500) + "); " + words.resume + " continues it, " +
                    words.restart + " begins anew and loses what it has done");
}

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
  complete_ =
      setup_.can_be_complete && are_complete(setup_.outputs, setup_.formats, provenance, words);
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
