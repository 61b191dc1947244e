// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/tables/convert.hpp"
#include "polhode/text/separated.hpp"
#include "tables/detail/chart_families.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr double left_out = std::numeric_limits<double>::quiet_NaN();

double whole_number(std::string_view word) {
  int number = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  return error == std::errc() && stop == end ? number : left_out;
}

// Names that are keys of [state.CHART] and columns of tables: plain, and none twice.
bool are_names(std::vector<std::string_view> names) {
  std::sort(names.begin(), names.end());
  return std::all_of(names.begin(), names.end(), detail::is_name) &&
         std::adjacent_find(names.begin(), names.end()) == names.end();
}

bool has_names(const ChartKind& chart) {
  std::vector<std::string_view> keys, table = branch_columns(chart), rows = table;
  for (const ChartVariable& variable : chart.variables) {
    keys.push_back(variable.name);
    table.push_back(variable.name);
    rows.push_back(variable.column);
  }
  for (const ChartOption& option : chart.options) keys.push_back(option.name);
  return are_names(std::move(keys)) && are_names(std::move(table)) && are_names(std::move(rows));
}

// What stands for an option that is left out must be one of its words, or be found.
bool has_words(const ChartKind& chart, const ChartOption& option) {
  return option.fallback.empty() ? chart.completed != nullptr
                                 : !std::isnan(option_number(option, option.fallback));
}

std::string_view missing_part(const ChartKind& chart) {
  if (chart.help.empty()) return "help: one sentence";
  if (chart.to_hub == nullptr || chart.from_hub == nullptr) return "to_hub and from_hub";
  if (chart.variables.empty()) return "variables";
  if (!has_names(chart))
    return "names of letters, digits, - and _, none twice, of its numbers, options and columns";
  for (const ChartOption& option : chart.options)
    if (!has_words(chart, option)) return "one of its words for an option that is left out";
  for (std::size_t i = 0; i < chart.variables.size() && !chart.column_order.empty(); ++i)
    if (std::count(chart.column_order.begin(), chart.column_order.end(), i) != 1)
      return "each variable once in column_order";
  if (chart.column_order.size() > chart.variables.size())
    return "as many places in column_order as variables";
  if ((chart.to_columns == nullptr) != (chart.from_columns == nullptr) ||
      (chart.to_columns == nullptr) != chart.branch_columns.empty())
    return "branch_columns, to_columns and from_columns together";
  if (chart.is_constant && chart.from_motion == nullptr) return "from_motion where it is constant";
  return {};
}

}  // namespace

const std::vector<ChartKind>& default_charts() {
  static const std::vector<ChartKind> charts = [] {
    std::vector<ChartKind> all;
    for (const std::span<const ChartKind> family :
         {detail::rotor_charts(), detail::euler_charts(), detail::andoyer_charts(),
          detail::poincare_charts(), detail::serret_charts(), detail::sadov_charts()})
      all.insert(all.end(), family.begin(), family.end());
    return all;
  }();
  return charts;
}

std::vector<ChartKind> with_chart(std::span<const ChartKind> charts, const ChartKind& chart) {
  const std::string who = "chart \"" + std::string(chart.name) + "\": ";
  if (!detail::is_name(chart.name))
    throw DomainError(who + "expected a name of letters, digits, - and _");
  if (chart_named(chart.name, charts) != nullptr) throw DomainError(who + "the name is taken");
  const std::size_t behind = std::max(chart.options.size(), chart.branch_columns.size());
  if (chart.variables.size() + behind > most_chart_numbers)
    throw DomainError(who + "expected at most " + std::to_string(most_chart_numbers) + " numbers");
  if (const std::string_view missing = missing_part(chart); !missing.empty())
    throw DomainError(who + "expected " + std::string(missing));
  std::vector<ChartKind> all(charts.begin(), charts.end());
  all.push_back(chart);
  return all;
}

const ChartKind* chart_named(std::string_view name, std::span<const ChartKind> charts) {
  const auto found = std::find_if(charts.begin(), charts.end(),
                                  [&](const ChartKind& chart) { return chart.name == name; });
  return found == charts.end() ? nullptr : &*found;
}

std::vector<std::string_view> branch_columns(const ChartKind& chart) {
  std::vector<std::string_view> names(chart.branch_columns.begin(), chart.branch_columns.end());
  if (chart.to_columns != nullptr) return names;
  for (const ChartOption& option : chart.options) names.push_back(option.name);
  return names;
}

double option_number(const ChartOption& option, std::string_view word) {
  const std::vector<std::string_view> words = separated(option.words, '|');
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return left_out;
  const double number = whole_number(word);
  return std::isnan(number) ? static_cast<double>(found - words.begin()) : number;
}

std::string_view option_word(const ChartOption& option, double number) {
  for (const std::string_view word : separated(option.words, '|'))
    if (option_number(option, word) == number) return word;
  return {};
}

ChartNumbers completed(const ChartKind& chart, const ChartNumbers& numbers,
                       const ChartPlace& place) {
  ChartNumbers all = numbers;
  for (std::size_t i = 0; i < chart.options.size(); ++i) {
    const ChartOption& option = chart.options[i];
    double& number = all[chart.variables.size() + i];
    if (std::isnan(number) && !option.fallback.empty())
      number = option_number(option, option.fallback);
    if (!std::isnan(number) && option_word(option, number).empty())
      throw DomainError(option.words == "1|-1" ? "a column of signs must hold 1 or -1"
                                               : "a number that is no " + std::string(option.name));
  }
  return chart.completed == nullptr ? all : chart.completed(all, place);
}

ChartNumbers to_columns(const ChartKind& chart, const ChartNumbers& numbers) {
  return chart.to_columns == nullptr ? numbers : chart.to_columns(numbers);
}
ChartNumbers from_columns(const ChartKind& chart, const ChartNumbers& columns) {
  return chart.from_columns == nullptr ? columns : chart.from_columns(columns);
}

FreeRotation free_rotation(const Body& body, const ChartState& state) {
  if (state.chart.to_motion != nullptr) return state.chart.to_motion(body, state.numbers);
  return FreeRotation(body, state.chart.to_hub(state.numbers, {&body}));
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
