// SPDX-License-Identifier: MIT
#include "run/ensemble/histogram_files.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "polhode/error.hpp"
#include "polhode/output/output_format.hpp"
#include "run/detail/own_files.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {}  // namespace

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
  for (std::size_t h = 0; h < histograms.size(); ++h) {
    histograms[h].path = paths[h];
    const std::unique_ptr<Sink> sink =
        open_sink(paths[h], histograms[h].groups, origin, std::nullopt, formats);
    sink->push(histograms[h].rows);
    sink->finish();
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
