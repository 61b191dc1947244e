// SPDX-License-Identifier: MIT
// Files of an ensemble: columns and provenance, chunks, histograms, members that failed.
#include "run/ensemble/ensemble_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "output/output_notes.hpp"
#include "polhode/error.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/run/run.hpp"
#include "run/detail/output_checks.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr std::size_t longest_text = 1000;

std::vector<std::string> notes_of(const ScenarioEnsemble& ensemble) {
  const EnsemblePlan& plan = ensemble.plan();
  std::vector<std::string> notes = {"ensemble: " + std::to_string(plan.size) + " members, seed " +
                                    std::to_string(plan.seed) + ", chunks of " +
                                    std::to_string(plan.chunk)};
  for (const EnsembleVaried& one : plan.varied) {
    std::string keys;
    for (const std::string& key : one.keys) keys += (keys.empty() ? "" : ", ") + key;
    notes.push_back("varied: " + keys + ": " + printable(one.text, longest_text));
  }
  return notes;
}

// A note of a branch, constant along a free motion, is of the file's own.
void add_branches(const Scenario& scenario, std::vector<std::string>& notes) {
  const std::size_t own = notes.size();
  for (const std::string& group : scenario.output.columns)
    if (const ColumnKind* const kind = scenario.document.kinds->columns().group(group);
        kind != nullptr && kind->branch &&
        std::any_of(notes.begin(), notes.begin() + static_cast<std::ptrdiff_t>(own),
                    [&](const std::string& note) { return note.starts_with(group + ": "); }))
      notes.push_back("the branch of " + group +
                      " is that of the file's own run; those of members may be others");
}

}  // namespace

std::vector<ColumnGroup> row_groups_of(const ScenarioEnsemble& ensemble) {
  std::vector<ColumnGroup> groups = {{"member", {{"member", "1"}}}};
  const std::vector<std::string> keys = ensemble.plan().keys(), units = ensemble.plan().units();
  if (ensemble.plan().keep == EnsembleKeep::final)
    for (std::size_t i = 0; i < keys.size(); ++i)
      groups.push_back({keys[i], {{keys[i], units[i]}}});
  const std::vector<ColumnGroup>& rows = ensemble.row_groups();
  groups.insert(groups.end(), rows.begin(), rows.end());
  return groups;
}

Provenance provenance_of(const ScenarioEnsemble& ensemble, const StatisticsFrame* frame) {
  Provenance origin = provenance(ensemble.scenario());
  std::vector<std::string> notes = notes_of(ensemble);
  add_branches(ensemble.scenario(), origin.notes);
  if (frame != nullptr)
    for (std::string& note : frame->notes()) notes.push_back(std::move(note));
  origin.notes.insert(origin.notes.end(), notes.begin(), notes.end());
  if (ensemble.plan().keep == EnsembleKeep::final) origin.row_dimension = "member";
  return origin;
}

namespace {

constexpr std::string_view mark = "{chunk}";

bool is_pattern(const std::string& path) { return path.find(mark) != std::string::npos; }

std::string with(std::string pattern, const std::string& chunk) {
  return pattern.replace(pattern.find(mark), mark.size(), chunk);
}

}  // namespace

std::string ChunkFiles::pattern(const ScenarioEnsemble& ensemble,
                                const std::vector<std::string>& paths) {
  const auto found = std::find_if(paths.begin(), paths.end(), is_pattern);
  if (found == paths.end()) return {};
  const std::string& name = ensemble.scenario().document.name;
  if (paths.size() > 1)
    throw DomainError(name + ": ensemble: got " + *found + " and " +
                      std::to_string(paths.size() - 1) +
                      " more outputs; expected no other where each chunk has a file of its own");
  if (ensemble.plan().keep == EnsembleKeep::statistics)
    throw DomainError(name + ": ensemble: got " + *found +
                      " for statistics, which are of all chunks; expected ensemble.keep = \"rows\" "
                      "or \"final\"");
  return *found;
}

std::vector<std::string> ChunkFiles::kept(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths)
    files.push_back(is_pattern(path) ? with(path, "index") : path);
  return files;
}

std::vector<ColumnGroup> ChunkFiles::index_groups() {
  return {{"chunk", {{"chunk", "1"}}},
          {"first_member", {{"first_member", "1"}}},
          {"members", {{"members", "1"}}},
          {"failed", {{"failed", "1"}}},
          {"rows", {{"rows", "1"}}}};
}

ChunkFiles::ChunkFiles(const ScenarioEnsemble& ensemble, std::string pattern)
    : ensemble_(ensemble), pattern_(std::move(pattern)) {}

std::string ChunkFiles::path(std::int64_t first) const {
  const std::int64_t each = ensemble_.plan().chunk, last = (ensemble_.size() - 1) / each;
  const std::size_t digits = std::to_string(last).size();  // names in the order of the chunks
  return with(pattern_, fmt::format("{:0{}}", first / each, digits));
}

std::unique_ptr<Sink> ChunkFiles::open(std::int64_t first, std::int64_t end) const {
  Provenance origin = provenance_of(ensemble_, nullptr);
  origin.notes.push_back(
      fmt::format("chunk {}: members {} to {}", first / ensemble_.plan().chunk, first, end - 1));
  return open_sink(path(first), row_groups_of(ensemble_), origin, std::nullopt,
                   ensemble_.scenario().output.formats);
}

std::vector<std::string> histogram_paths(const ScenarioEnsemble& ensemble,
                                         const std::vector<std::string>& outputs) {
  const EnsemblePlan& plan = ensemble.plan();
  if (outputs.empty() || plan.histograms.empty() || plan.keep != EnsembleKeep::statistics)
    return {};
  const Document& file = ensemble.scenario().document;
  const OutputFormats& formats = ensemble.scenario().output.formats;
  const std::string& first = outputs.front();
  const OutputFormat* const format = formats.of_extension(first);
  if (format == nullptr || !is_file(first))
    throw DomainError(file.name + ": ensemble.histogram: got " + printable(first, longest_path) +
                      " as the first output; expected a file, PATH.csv or PATH.h5, since "
                      "histograms are files of their own next to it");
  const std::string stem = first.substr(0, first.size() - format->extension.size());
  std::vector<std::string> paths, all = outputs;
  for (const EnsembleHistogram& one : plan.histograms)
    paths.push_back(stem + "." + one.name + format->extension);
  for (const std::string& path : paths)
    if (!is_file(path))
      throw DomainError(printable(path, longest_path) +
                        ": is no file; expected a place for a histogram");
  all.insert(all.end(), paths.begin(), paths.end());
  require_own_files(file, all);
  return paths;
}

void require_there(const std::vector<std::string>& paths, const BeginWords& words) {
  for (const std::string& path : paths)
    if (std::error_code failed; !std::filesystem::exists(path, failed))
      throw DomainError(printable(path, longest_path) +
                        ": is not there, and what it belongs to is done with it; put it back, or " +
                        words.restart + " runs this one anew");
}

void write_histograms(std::vector<EnsembleReport::Histogram>& histograms,
                      const std::vector<std::string>& paths, const OutputFormats& formats,
                      Provenance origin) {
  if (paths.empty()) return;
  origin.notes.emplace_back(
      "histogram: a bin has its low edge and not its high one, but the last before the open bin "
      "has "
      "both; the first and the last bin of a column are open; part: of the members that have these "
      "numbers then");
  origin.row_dimension = "bin";
  for (std::size_t h = 0; h < histograms.size(); ++h) {
    histograms[h].path = paths[h];
    const std::unique_ptr<Sink> sink =
        open_sink(paths[h], histograms[h].groups, origin, std::nullopt, formats);
    sink->push(histograms[h].rows);
    sink->finish();
  }
}

namespace {

constexpr std::size_t reasons_shown = 3;

std::string text_of(const EnsembleReport::Failure& failure) {
  return "member " + std::to_string(failure.member) + ": " + failure.why;
}

}  // namespace

void say_failures(Sink& sink, std::span<const EnsembleReport::Failure> failures,
                  std::int64_t failed, std::int64_t members) {
  if (failed == 0) return;
  std::vector<std::string> notes = {std::to_string(failed) + " of " + std::to_string(members) +
                                    " members"};
  for (const EnsembleReport::Failure& failure :
       failures.first(std::min(failures.size(), failures_named)))
    notes.push_back(text_of(failure));
  close_with(sink, "failed", notes);
}

std::string all_failed_text(const std::string& name,
                            std::span<const EnsembleReport::Failure> failures,
                            std::int64_t members) {
  std::string text =
      name + ": " +
      (members == 1 ? "the one member" : "all " + std::to_string(members) + " members") +
      " failed, so that there are no results";
  const std::size_t shown = std::min(failures.size(), reasons_shown);
  for (std::size_t i = 0; i < shown; ++i) text += "\n  " + text_of(failures[i]);
  return failures.size() > shown ? text + "\n  ..." : text;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
