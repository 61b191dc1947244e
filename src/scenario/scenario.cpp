// SPDX-License-Identifier: MIT
// From a scenario file to what it describes: its text, the files that it names, recognised by their
// bytes, and its outputs.
#include "polhode/scenario/scenario.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/schema_table.hpp"
#include "scenario/ensemble/ensemble_plan.hpp"
#include "scenario/fit/fit_plan.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/head.hpp"
#include "scenario/tables/map.hpp"
#include "scenario/values.hpp"
#include "text/file_bytes.hpp"
#include "text/value_access.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

// As it is on the disk, packed or not. Never a pipe: it could be read once alone.
std::optional<ScenarioFile> noted(const std::filesystem::path& folder, const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(folder / path, ignored)) return std::nullopt;
  std::ifstream file(folder / path, std::ios::binary);
  ScenarioFile result{path, 0, fingerprint({})};
  std::array<char, 65536> block;
  while (file) {
    file.read(block.data(), block.size());
    const std::string_view bytes(block.data(), static_cast<std::size_t>(file.gcount()));
    result.fingerprint = fingerprint(bytes, result.fingerprint);
    result.bytes += file.gcount();
  }
  if (!file.eof()) return std::nullopt;
  return result;
}

}  // namespace

std::vector<ScenarioFile> files_of(const Values& values, const std::string& name) {
  std::set<std::string> paths;
  for (const auto& [path, value] : values)
    if (value.key->is_file) paths.insert(value.words.at(0));
  const std::filesystem::path folder = std::filesystem::path(name).parent_path();
  std::vector<ScenarioFile> files;
  for (const std::string& path : paths)
    if (const std::optional<ScenarioFile> file = noted(folder, path)) files.push_back(*file);
  return files;
}

}  // namespace detail

std::string file_note(const ScenarioFile& file) {
  return detail::printable(file.path, 500) + ": " + std::to_string(file.bytes) + " bytes, mark " +
         std::to_string(file.fingerprint);
}

namespace detail {

namespace {

std::any options_of(const KeyValues& table, const OutputFormat& format) {
  if (!format.options) return {};
  return built(table.values(), table.path(), table.file(), [&] { return format.options(table); });
}

}  // namespace

FormatOptions format_options_of(const FileValues& file, const OutputFormats& formats) {
  FormatOptions options;
  for (const OutputFormat& format : formats.all()) {
    const KeyValues table(file.values, file.units, "output." + format.name, file.name);
    if (has(file.values, table.path())) options.emplace(format.name, options_of(table, format));
  }
  return options;
}

}  // namespace detail

namespace {

using detail::Diagnostics;
using detail::has;
using detail::Values;

constexpr std::size_t largest_file = std::size_t{16} << 20;

std::string file_text(const std::string& path) {
  const std::string shown = detail::printable(path, largest_file);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw DomainError(shown + ": is a folder; expected a scenario file");
  std::optional<std::string> text = path == "-" ? detail::file_bytes(stdin, largest_file + 1)
                                                : detail::file_bytes(path, largest_file + 1);
  if (!text) throw DomainError(shown + ": cannot be read: " + std::strerror(errno));
  return *std::move(text);
}

// The checked values are given to it when what they describe is made.
Document document_of(std::string_view text, const std::string& path, const Kinds& kinds,
                     const detail::ReadFile& read) {
  const Values& values = read.values;
  // first: what changes while it is read differs from what is noted here
  std::vector<ScenarioFile> files = detail::files_of(values, path);
  const std::filesystem::path file(path);
  const detail::Placed<detail::HeadTable> head = detail::head_table({values, read.units, path});
  return {.path = path,
          .name = file.filename().string(),
          .folder = file.parent_path().string(),
          .text = std::string(text),
          .title = head->title.value_or(""),
          .kind = head->kind,
          .units = read.units,
          .files = std::move(files),
          .kinds = std::make_shared<const Kinds>(kinds),
          .checked = nullptr};
}

// But for the options of formats: what is wrong in them comes after what is wrong in the state.
OutputPlan output_of(const detail::FileValues& file, const OutputFormats& formats) {
  return {.columns = detail::output_table(file)->columns, .formats = formats};
}

// Variables of a chart that are left out and equal another one: "H = G".
void add_equal_variables(const Values& values, const ChartKind& chart,
                         std::vector<TableValues>& all) {
  const std::string table = "state." + std::string(chart.name);
  const auto found = std::ranges::find(all, table, &TableValues::table);
  if (found == all.end()) return;
  for (const ChartVariable& variable : chart.variables)
    if (!variable.otherwise.empty() && !has(values, table + "." + std::string(variable.name)))
      found->defaults += (found->defaults.empty() ? "" : ", ") + std::string(variable.name) +
                         " = " + std::string(variable.otherwise);
}

}  // namespace

detail::ReadFile detail::read_file(std::string_view text, const std::string& path,
                                   const Kinds& kinds) {
  Diagnostics diagnostics(path);
  if (text.size() > largest_file) {
    diagnostics.add({}, "file", "got more than 16 MB; expected a scenario of at most 16 MB");
    diagnostics.raise();
  }
  ReadFile read = read_values(text, kinds.schema(), diagnostics);
  diagnostics.raise();
  return read;
}

Scenario detail::scenario_of(Document document, ReadFile read,
                             const std::function<MadeExperiment(const KindContext&)>& make) {
  const Kinds& kinds = *document.kinds;
  const FileValues file{read.values, document.units, document.path};
  OutputPlan output = output_of(file, kinds.formats());
  const auto made = std::make_shared<const MadeExperiment>(make({file, kinds, output}));
  output.options = format_options_of(file, kinds.formats());
  std::optional<MapPlan> map = map_plan(file, kinds.columns(), made->experiment);
  std::optional<EnsemblePlan> ensemble = ensemble_plan(file, made->experiment);
  std::shared_ptr<const FitPlan> fit;
  if (document.kind == "fit")
    fit = std::make_shared<const FitPlan>(fit_plan(file, kinds, rotation_of(made->experiment)));
  read.made = made;
  document.checked = std::make_shared<const ReadFile>(std::move(read));
  return {std::move(document), made->experiment,    std::move(output),
          std::move(map),      std::move(ensemble), std::move(fit)};
}

Scenario scenario_from_text(std::string_view text, const std::string& path, const Kinds& kinds) {
  detail::ReadFile read = detail::read_file(text, path, kinds);
  Document document = document_of(text, path, kinds, read);
  return detail::scenario_of(std::move(document), std::move(read), detail::made_experiment);
}

Scenario with_ensemble(const Scenario& scenario, std::string_view tables) {
  Document document = scenario.document;
  std::string text = changed_text(document.text, std::vector<ScenarioChange>{{"ensemble", ""}});
  text.erase(text.find_last_not_of('\n') + 1);
  document.text = text + "\n\n" + std::string(tables) + "\n";
  Diagnostics diagnostics(document.path);
  detail::ReadFile read = detail::read_values(document.text, document.kinds->schema(), diagnostics);
  diagnostics.leave_out_places("ensemble");
  diagnostics.raise();
  for (auto& [path, value] : read.values)
    if (detail::is_below(path, "ensemble")) value.where = detail::nowhere;
  return detail::scenario_of(std::move(document), std::move(read), [&](const detail::KindContext&) {
    return *scenario.document.checked->made;
  });
}

std::vector<TableValues> model_values(const Scenario& scenario) {
  const std::string_view tables[] = {"body",     "state.",       "planet",
                                     "orbit.",   "frame.",       "perturbation[",
                                     "surface[", "observation[", scenario.document.kind};
  std::vector<TableValues> all;
  for (const std::string_view wanted : tables) {
    const std::size_t first = all.size();
    for (const auto& [path, value] : scenario.document.checked->values) {
      const std::string_view table = key_table(path);
      if (!table.starts_with(wanted) || value.key->type == KeyType::table) continue;
      if (detail::is_unused(scenario.document.checked->values, value, path)) continue;
      auto found = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
                                [&](const TableValues& one) { return one.table == table; });
      if (found == all.end()) found = all.insert(all.end(), {std::string(table), "", ""});
      std::string& text = value.is_explicit ? found->given : found->defaults;
      text += (text.empty() ? "" : ", ") + std::string(key_name(path)) + " = " + value.shown;
    }
  }
  for (const ChartKind& chart : scenario.document.kinds->charts())
    add_equal_variables(scenario.document.checked->values, chart, all);
  return all;
}

std::vector<std::string> warnings(const Scenario& scenario) {
  std::vector<std::string> all;
  const auto add = [&](const std::vector<std::string>& some) {
    all.insert(all.end(), some.begin(), some.end());
  };
  if (const auto* const rotation = std::get_if<Rotation>(&scenario.experiment))
    for (const ScenarioOrbit& orbit : rotation->orbits) add(orbit.warnings);
  if (const auto* const of = std::get_if<Obliquity>(&scenario.experiment)) add(of->warnings);
  return all;
}

Scenario read_scenario(const std::string& path, const Kinds& kinds,
                       std::span<const ScenarioChange> changes) {
  const std::string text = file_text(path);
  return scenario_from_text(changes.empty() ? text : changed_text(text, changes),
                            path == "-" ? "<stdin>" : path, kinds);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
