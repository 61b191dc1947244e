// SPDX-License-Identifier: MIT
#include "run/ensemble/ensemble_setup.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/output/output_format.hpp"
#include "run/ensemble/elementary_functions.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

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
      throw DomainError(printable(path, longest_message_path) + ": " + format->label +
                        " holds one motion; expected " + paths_in_words(formats, is_table));
  }
}

}  // namespace

KeptSetup setup_of_ensemble(const ScenarioEnsemble& ensemble,
                            const std::vector<ColumnGroup>& groups,
                            const std::vector<std::string>& paths, const EnsembleOptions& options) {
  require_tables(ensemble.scenario().output.formats, paths);
  KeptSetup setup =
      setup_of_tables({"ensemble", "runs this one anew"}, ensemble.scenario(), groups, paths);
  setup.begin = options.begin;
  setup.words = options.words;
  setup.seconds = options.checkpoint_seconds;
  setup.identity.insert(setup.identity.begin(), elementary_functions());
  if (options.any_machine) setup.forgive = take_elementary_functions;
  setup.advice = [words = options.words](const std::string& differs) {
    return differs_in_elementary_functions(differs)
               ? "; " + words.any_machine + " goes on with other last digits"
               : std::string();
  };
  return setup;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
