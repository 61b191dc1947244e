// SPDX-License-Identifier: MIT
#include "tables/detail/table_notes.hpp"

#include <cmath>
#include <utility>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::string_view first_word(std::string_view text) { return text.substr(0, text.find(' ')); }

}  // namespace

// "# units: t [h], phi [deg], ...", "# serret: sign_g1 1, sign_g3 -1", "# sadov: region LAM, lobe
// -1".
bool TableNotes::read(std::string_view comment) {
  if (!comment.starts_with("# ")) return false;
  const std::size_t colon = comment.find(": ");
  const std::string_view subject =
      comment.substr(2, colon == std::string_view::npos ? colon : colon - 2);
  const bool units = subject == "units";
  const ChartKind* const chart = chart_named(subject, charts_);
  if (!units && (chart == nullptr || chart->options.empty())) return false;
  std::string_view rest = colon == std::string_view::npos ? "" : comment.substr(colon + 2);
  while (!rest.empty()) {
    const std::size_t comma = rest.find(", ");
    const std::string_view entry = rest.substr(0, comma);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 2);
    const std::string_view name = first_word(entry);
    if (name.size() + 1 >= entry.size()) continue;
    const std::string_view value = entry.substr(name.size() + 1);
    if (units && value.size() > 2)
      units_.emplace(name, value.substr(1, value.size() - 2));
    else if (!units)
      read_option(*chart, name, value);
  }
  return true;
}

void TableNotes::read_option(const ChartKind& chart, std::string_view name, std::string_view word) {
  for (const ChartOption& option : chart.options)
    if (option.name == name)
      if (const double number = option_number(option, word); !std::isnan(number))
        options_.emplace(std::pair(chart.name, option.name), number);
}

std::string_view TableNotes::unit(std::string_view column) const {
  const auto found = units_.find(column);
  return found == units_.end() ? std::string_view() : found->second;
}

std::optional<double> TableNotes::option(std::string_view chart, std::string_view name) const {
  const auto found = options_.find({chart, name});
  if (found == options_.end()) return std::nullopt;
  return found->second;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
