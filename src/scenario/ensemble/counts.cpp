// SPDX-License-Identifier: MIT
#include "scenario/ensemble/counts.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>

#include "scenario/scenario_parts.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct HistogramTable {
  std::string name;
  std::vector<std::string> columns;
  std::int64_t bins = 1;
  std::optional<std::vector<double>> low, high;
  bool at_all_times = false;
};

namespace {

constexpr std::array keys_of_fraction = {
    name_key<&EnsembleFraction::name>("name", "What outputs call it.")
        .required()
        .example("\"librating\""),
    text_key<&EnsembleFraction::column>("column", "A column of the rows of a member.")
        .required()
        .example("\"g\""),
    quantity_key<&EnsembleFraction::low>(
        "low", Dimension::number,
        "In the unit of the column; left out: none. An angle with both bounds lies between "
        "them if it does so whole turns apart; with one, as its row has it.")
        .example("-90"),
    quantity_key<&EnsembleFraction::high>("high", Dimension::number, "As low.").example("90"),
};

constexpr std::array keys_of_histogram = {
    name_key<&HistogramTable::name>("name", "In the name of its file.")
        .required()
        .example("\"periods\""),
    columns_key<&HistogramTable::columns>(
        "columns", "One or two columns of the rows of a member, or keys that vary.")
        .required()
        .example("[\"P_phi\", \"body.moments[0]\"]"),
    integer_key<&HistogramTable::bins>("bins", "Between low and high of each column, up to 1e4.")
        .from_to(1, 10'000, "1e4")
        .otherwise("40"),
    quantity_key<&HistogramTable::low>(
        "low", Dimension::number,
        "Of each column, in its unit. Left out with high: the range of the members, or, where "
        "there are too many to keep their numbers, that of the first 1024 at most and a tenth of "
        "it on either side.")
        .example("[200, 0.5]"),
    quantity_key<&HistogramTable::high>("high", Dimension::number, "As low.").example("[320, 0.7]"),
    choice_key<&HistogramTable::at_all_times, false, true>(
        "times", "last|all", "Of the last time of [time], or of each of them.")
        .otherwise("\"last\""),
};

}  // namespace

constexpr Table<EnsembleFraction> fraction_description = {
    {.path = "ensemble.fraction[]",
     .help = "Statistics, and no other keep, have a column NAME_part: which part of the members "
             "whose column is a number has it from low on and below high."},
    keys_of_fraction};
constexpr Table<HistogramTable> histogram_description = {
    {.path = "ensemble.histogram[]",
     .help = "Beside statistics, and no other keep, how many members have a column, or two, in "
             "each of even bins: a file of its own, OUT.NAME.csv or .h5 next to the first output "
             "OUT.csv or .h5."},
    keys_of_histogram};

namespace {

// No two tables of one sort are called the same.
template <class A, class Plan>
void require_new_name(const Placed<A>& one, const std::vector<Plan>& before) {
  if (std::ranges::find(before, one->name, &Plan::name) != before.end())
    one.template refuse<&A::name>(
        "expected a name of its own, since another table before it has this one");
}

template <auto member>
const std::vector<double>& bounds_of(const Placed<HistogramTable>& from) {
  const std::optional<std::vector<double>>& all = (*from).*member;
  if (!all) from.refuse<member>("expected low and high, or neither of them");
  if (all->size() != from->columns.size())
    from.refuse<member>(from->columns.size() == 1
                            ? "expected one number, for the one column"
                            : "expected two numbers, one for each of columns");
  return *all;
}

EnsembleHistogram histogram_of(const Placed<HistogramTable>& from) {
  const std::vector<std::string>& columns = from->columns;
  if (columns.size() > 2 || (columns.size() == 2 && columns[0] == columns[1]))
    from.refuse<&HistogramTable::columns>("expected one column or two different ones");
  EnsembleHistogram made{from->name, {}, from->at_all_times};
  for (const std::string& column : columns) made.axes.push_back({column, from->bins, std::nullopt});
  if (!from->low && !from->high) return made;
  const std::vector<double>& low = bounds_of<&HistogramTable::low>(from);
  const std::vector<double>& high = bounds_of<&HistogramTable::high>(from);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!(low[i] < high[i])) from.refuse<&HistogramTable::low>("expected less than high");
    made.axes[i].bounds = {low[i], high[i]};
  }
  return made;
}

std::vector<std::string> known_names(std::span<const ColumnGroup> rows) {
  std::vector<std::string> names;
  for (const ColumnGroup& group : rows)
    for (const Column& column : group.columns)
      if (group.name != "t" && !column.is_date) names.push_back(column.name);
  return names;
}

template <auto member, class A>
void require_known(const Placed<A>& from, const std::string& name,
                   std::span<const std::string> known, std::string_view expected) {
  if (std::ranges::find(known, name) != known.end()) return;
  const std::vector<std::string_view> words(known.begin(), known.end());
  from.template refuse<member>(std::string(expected) + "; " + name + " is none" +
                               did_you_mean(name, words));
}

}  // namespace

std::vector<EnsembleFraction> fractions_of(const FileValues& file) {
  std::vector<EnsembleFraction> all;
  for (const Placed<EnsembleFraction>& one : placed_tables(fraction_description, file)) {
    require_new_name(one, all);
    if (!one->low && !one->high) one.refuse("expected low, high or both");
    if (one->low && one->high && !(*one->low < *one->high))
      one.refuse<&EnsembleFraction::low>("expected less than high");
    all.push_back(*one);
  }
  return all;
}

std::vector<EnsembleHistogram> histograms_of(const FileValues& file) {
  std::vector<EnsembleHistogram> all;
  for (const Placed<HistogramTable>& one : placed_tables(histogram_description, file)) {
    require_new_name(one, all);
    all.push_back(histogram_of(one));
  }
  return all;
}

}  // namespace detail

void require_ensemble_columns(const Scenario& scenario, std::span<const ColumnGroup> rows,
                              std::span<const std::string> events) {
  using namespace detail;
  const FileValues file = file_values(scenario.document);
  std::vector<std::string> known = known_names(rows);
  for (const Placed<EnsembleFraction>& one : placed_tables(fraction_description, file)) {
    require_known<&EnsembleFraction::column>(one, one->column, known,
                                             "expected a column of [output] columns");
    if (std::ranges::find(events, one->name) != events.end())
      one.refuse<&EnsembleFraction::name>(
          "expected a name of its own, since an event has this one");
    const auto has_this_name = [&](const ColumnGroup& group) {
      return group.name == one->name ||
             std::ranges::find(group.columns, one->name, &Column::name) != group.columns.end();
    };
    if (std::ranges::any_of(rows, has_this_name))
      one.refuse<&EnsembleFraction::name>(
          "expected a name of its own, since a column has this one");
  }
  std::ranges::copy(scenario.ensemble->keys(), std::back_inserter(known));
  for (const Placed<HistogramTable>& one : placed_tables(histogram_description, file))
    for (const std::string& column : one->columns)
      require_known<&HistogramTable::columns>(
          one, column, known, "expected columns of [output] columns, or keys that vary");
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
