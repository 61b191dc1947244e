// SPDX-License-Identifier: MIT
// What a checkpoint of an ensemble must agree in, the functions of the C library included.
#include "run/ensemble/ensemble_checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/trajectory/state_bytes.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

const std::string name = "elementary functions of the machine";

}  // namespace

IdentityPart elementary_functions() {
  StateBytes bytes;
  for (int k = 1; k <= 1000; ++k) {
    const double x = 0.003 * k;
    for (double value : {std::sin(x), std::cos(x), std::tan(x), std::atan2(x, 1.7), std::exp(-x),
                         std::log(x), std::asin(x / 4.0), std::pow(x, 1.3)})
      bytes(value);
  }
  return {name, "mark " + std::to_string(fingerprint(bytes.bytes()))};
}

void take_elementary_functions(Identity& theirs, const Identity& ours) {
  const auto part_of = [](auto& identity, const std::string& of) {
    return std::find_if(identity.begin(), identity.end(),
                        [&](const IdentityPart& part) { return part.name == of; });
  };
  const auto here = part_of(ours, name);
  const auto there = part_of(theirs, name);
  if (here == ours.end() || there == theirs.end() || here->text == there->text) return;
  there->text = here->text;
  const auto numbers = part_of(theirs, surroundings_part);
  const auto own_numbers = part_of(ours, surroundings_part);
  if (numbers != theirs.end() && own_numbers != ours.end()) numbers->text = own_numbers->text;
}

bool differs_in_elementary_functions(const std::string& difference) {
  return difference.starts_with(name);
}

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
