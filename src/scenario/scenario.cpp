// SPDX-License-Identifier: MIT
#include "polhode/scenario/scenario.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include "polhode/scenario/schema.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/schema_table.hpp"
#include "scenario/map_plan.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/value_reader.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::Diagnostics;
using detail::has;
using detail::Values;

constexpr std::size_t largest_file = std::size_t{16} << 20;

struct CloseFile {
  void operator()(std::FILE* file) const {
    if (file != stdin) std::fclose(file);
  }
};

std::string file_text(const std::string& path) {
  const std::string shown = detail::printable(path, largest_file);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw DomainError(shown + ": is a folder; expected a scenario file");
  errno = 0;
  const std::unique_ptr<std::FILE, CloseFile> file(path == "-" ? stdin
                                                               : std::fopen(path.c_str(), "rb"));
  if (!file) throw DomainError(shown + ": cannot be read: " + std::strerror(errno));
  std::string text(largest_file + 1, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  if (std::ferror(file.get()) != 0)
    throw DomainError(shown + ": cannot be read: " + std::strerror(errno));
  return text;
}

detail::ReadFile read_file(std::string_view text, const std::string& path,
                           const OutputFormats& formats) {
  Diagnostics diagnostics(path);
  if (text.size() > largest_file) {
    diagnostics.add({}, "file", "got more than 16 MB; expected a scenario of at most 16 MB");
    diagnostics.raise();
  }
  const auto table =
      std::make_shared<const detail::SchemaTable>(detail::experiment_kinds(), formats);
  detail::ReadFile read = detail::read_values(text, table->schema(), diagnostics);
  read.table = table;
  diagnostics.raise();
  return read;
}

// The checked values are given to it when what they describe is made.
Document document_of(std::string_view text, const std::string& path, const detail::ReadFile& read) {
  const Values& values = read.values;
  // first: what changes while it is read differs from what is noted here
  std::vector<ScenarioFile> files = detail::files_of(values, path);
  const std::filesystem::path file(path);
  return {.path = path,
          .name = file.filename().string(),
          .folder = file.parent_path().string(),
          .text = std::string(text),
          .title = has(values, "title") ? detail::word(values, "title") : "",
          .kind = detail::word(values, "kind"),
          .units = read.units,
          .files = std::move(files),
          .checked = nullptr};
}

// But for the options of formats: what is wrong in them comes after what is wrong in the state.
OutputPlan output_of(const Values& values, const OutputFormats& formats) {
  return {.columns = detail::value_at(values, "output.columns").words, .formats = formats};
}

}  // namespace

Scenario scenario_from_text(std::string_view text, const std::string& path,
                            const OutputFormats& formats) {
  detail::ReadFile read = read_file(text, path, formats);
  Document document = document_of(text, path, read);
  OutputPlan output = output_of(read.values, formats);
  const auto made = std::make_shared<const detail::MadeExperiment>(
      detail::kind_of(read.values).make({read.values, document.units, output, path}));
  output.options = detail::format_options_of(read.values, formats, path);
  std::optional<MapPlan> map;
  if (has(read.values, "map"))
    map =
        detail::map_plan({read.values, document.units, path}, detail::subject_of(made->experiment));
  read.made = made;
  document.checked = std::make_shared<const detail::ReadFile>(std::move(read));
  return {std::move(document), made->experiment, std::move(output), std::move(map)};
}

Scenario read_scenario(const std::string& path, const OutputFormats& formats) {
  return scenario_from_text(file_text(path), path == "-" ? "<stdin>" : path, formats);
}

}  // namespace v0
}  // namespace polhode
