// SPDX-License-Identifier: MIT
// From [ensemble] to its plan: members, and the statistics that are wanted of them.
#include "scenario/ensemble/ensemble_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "scenario/ensemble/counts.hpp"
#include "scenario/ensemble/vary.hpp"
#include "scenario/scenario_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr std::int64_t most_bins = 1'000'000;
constexpr std::int64_t largest_chunk = 1024, chunks = 64;  // where the file names none

struct EnsembleTable {
  std::int64_t size = 1;
  std::uint64_t seed = 1;
  ensemble::DrawSource draws = ensemble::DrawSource::random;
  EnsembleKeep keep = EnsembleKeep::statistics;
  std::vector<double> quantiles;
  std::int64_t bins = 1;
  std::optional<std::int64_t> chunk;
  std::vector<EnsembleIndicator> indicators;
};

constexpr std::array keys_of_ensemble = {
    integer_key<&EnsembleTable::size>("size", "How many members, up to 1e12.")
        .from_to(1, 1'000'000'000'000, "1e12")
        .required()
        .example("10000"),
    integer_key<&EnsembleTable::seed>("seed", "Another seed draws other members.").otherwise("1"),
    choice_key<&EnsembleTable::draws, ensemble::DrawSource::random, ensemble::DrawSource::sobol>(
        "draws", "random|sobol",
        "Random numbers, or Sobol's points, over which means settle faster.")
        .otherwise("\"random\""),
    choice_key<&EnsembleTable::keep, EnsembleKeep::statistics, EnsembleKeep::final,
               EnsembleKeep::rows>(
        "keep", "statistics|final|rows",
        "What is written: statistics of the members at each time of [time]; one row for each "
        "member, with what was drawn and its last row; or all rows of all members.")
        .otherwise("\"statistics\""),
    quantity_key<&EnsembleTable::quantiles>(
        "quantiles", Dimension::number,
        "Which quantiles of each column statistics have, from 0 to 1.")
        .otherwise("[0.05, 0.5, 0.95]"),
    integer_key<&EnsembleTable::bins>(
        "bins",
        "How many bins quantiles come from where there are too many numbers to keep "
        "(more than 8e6, members times rows times columns), up to 1e6.")
        .from_to(1, most_bins, "1e6")
        .otherwise("256"),
    integer_key<&EnsembleTable::chunk>(
        "chunk",
        "Members that are reduced together by one thread. The last digits of statistics "
        "depend on it, and on nothing else of how an ensemble is run. Left out: a 64th of "
        "size, 1 at least and 1024 at most.")
        .from_to(1, most_bins, "1e6")
        .example("1024"),
    choices_key<&EnsembleTable::indicators, EnsembleIndicator::mean_megno,
                EnsembleIndicator::lyapunov>(
        "indicators", "mean_megno|lyapunov",
        "Indicators of chaos, as those of [map]: columns of the rows of each member, from "
        "t = 0 up to the time of the row. They take two to five times as long as the rest of "
        "a run. Of kind \"rotation\" without a damper, rows on one side of t = 0.")
        .example("[\"mean_megno\", \"lyapunov\"]"),
};
constexpr Table<EnsembleTable> ensemble_description = {
    {.path = "ensemble",
     .help = "What `polhode ensemble` makes: many runs of this file, its members, with some of its "
             "numbers drawn. `polhode run` takes the file as it stands."},
    keys_of_ensemble};

// Why the motion of an experiment has no indicators of chaos, as "expected " continues; empty: it
// has.
std::string without_indicators(const Rotation& rotation) {
  if (rotation.damper)
    return "no indicators, since the state of a Kane damper has no indicator of chaos";
  const SaveAt& rows = *rotation.time;
  const double first = rows[0], last = rows[rows.size() - 1];
  if (last == 0.0 || first * last < 0.0)
    return "no indicators, or rows on one side of t = 0, where they start";
  for (std::int64_t k = 1; rows.is_list() && k < rows.size(); ++k)
    if (!(last > 0.0 ? rows[k] > rows[k - 1] : rows[k] < rows[k - 1]))
      return "no indicators, or times in order, away from t = 0, where they start";
  return {};
}
template <class Other>
std::string without_indicators(const Other&) {
  return "no indicators, which are those of a file of kind \"rotation\"";
}

void require_indicators(const Placed<EnsembleTable>& ensemble, const Experiment& experiment) {
  if (ensemble->indicators.empty()) return;
  const std::string why =
      std::visit([](const auto& of) { return without_indicators(of); }, experiment);
  if (!why.empty()) ensemble.refuse<&EnsembleTable::indicators>("expected " + why);
}

void require_quantiles(const Placed<EnsembleTable>& ensemble) {
  const std::vector<double>& all = ensemble->quantiles;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!(all[i] >= 0.0 && all[i] <= 1.0) || (i > 0 && !(all[i] > all[i - 1])))
      ensemble.refuse<&EnsembleTable::quantiles>(
          "expected numbers from 0 to 1, each above the one before");
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& one : words) text += (text.empty() ? "" : " ") + one;
  return text;
}

// All tables [[ensemble.vary]] in their order; the first grid stands for all of them.
class AllVaried {
 public:
  explicit AllVaried(const FileValues& file) {
    const std::vector<Placed<VaryTable>> tables = placed_tables(vary_description, file);
    for (const Placed<VaryTable>& one : tables) add(one);
    if (!axes_.empty())
      distributions_[grid_] = tables.front().built([&] { return ensemble::DrawGrid(axes_); });
  }

  std::vector<ensemble::Varied> draws() const {
    std::vector<ensemble::Varied> all;
    for (std::size_t i = 0; i < varied_.size(); ++i)
      all.push_back({joined(varied_[i].keys), distributions_[i]});
    return all;
  }
  std::vector<EnsembleVaried> take() { return std::move(varied_); }

 private:
  void add(const Placed<VaryTable>& from) {
    const std::string_view name =
        from->keys.empty() ? from.name<&VaryTable::key>() : from.name<&VaryTable::keys>();
    const VariedNumbers numbers = varied_numbers(from.at(), name);
    for (const std::string& key : numbers.keys) {
      if (std::ranges::find(taken_, key) != taken_.end())
        from.at().refuse(name, "expected keys that no other table varies; " + key + " comes twice");
      taken_.push_back(key);
    }
    VariedTable table = varied_table(from, numbers);
    if (const auto* const grid = std::get_if<ensemble::DrawGrid>(&table.distribution)) {
      axes_.push_back(grid->axes().front());
      if (axes_.size() > 1) return add_axis(table.varied);
      grid_ = varied_.size();
    }
    varied_.push_back(std::move(table.varied));
    distributions_.push_back(std::move(table.distribution));
  }

  void add_axis(const EnsembleVaried& own) {
    EnsembleVaried& grid = varied_[grid_];
    grid.text += "; " + own.text;
    grid.keys.push_back(own.keys.front());
    grid.units.push_back(own.units.front());
  }

  std::vector<std::string> taken_;
  std::vector<EnsembleVaried> varied_;
  std::vector<ensemble::Distribution> distributions_;
  std::vector<ensemble::DrawAxis> axes_;
  std::size_t grid_ = 0;
};

}  // namespace

SchemaPart ensemble_keys() {
  return part_of<ensemble_description, fraction_description, histogram_description,
                 vary_description>();
}

std::optional<EnsemblePlan> ensemble_plan(const FileValues& file, const Experiment& experiment) {
  const Placed<EnsembleTable> table(ensemble_description, file);
  if (!table.is_there()) return std::nullopt;
  if (!rows_of(experiment)) table.refuse("expected a table [time] as well");
  const std::int64_t size = table->size;
  AllVaried varied(file);
  ensemble::Draws draws =
      table.built([&] { return ensemble::Draws(varied.draws(), table->seed, table->draws); });
  if (static_cast<std::uint64_t>(size) > draws.most_members())
    table.refuse<&EnsembleTable::size>(
        "expected at most " + std::to_string(draws.most_members()) +
        ", the rows of the shortest table; with order = \"draws\" there may be more");
  require_quantiles(table);
  std::vector<EnsembleFraction> fractions = fractions_of(file);
  require_indicators(table, experiment);
  return EnsemblePlan{
      size,
      table->seed,
      table->draws,
      table->keep,
      table->chunk.value_or(std::clamp((size + chunks - 1) / chunks, INT64_C(1), largest_chunk)),
      table->quantiles,
      table->bins,
      std::move(fractions),
      table->indicators,
      histograms_of(file),
      varied.take(),
      std::move(draws)};
}

}  // namespace detail

namespace {

// What is drawn, as the numbers of the file.
void put_in_shape(const EnsembleVaried& varied, std::vector<double>& x) {
  using enum EnsembleVaried::Shape;
  if (varied.shape == numbers) return;
  if (varied.shape == vector) {
    for (double& each : x) each *= varied.scale;
    return;
  }
  constexpr double turn = 2.0 * std::numbers::pi;
  const detail::DirectionAngles which = detail::direction_angles(varied.keys).value();
  const double longitude = std::atan2(x[1], x[0]), across = std::hypot(x[0], x[1]);
  const double tilt = which.from_pole ? std::atan2(across, x[2]) : std::atan2(x[2], across);
  x.resize(2);
  x[which.around] = (longitude < 0.0 ? longitude + turn : longitude) / varied.scale;
  x[1 - which.around] = tilt / varied.scale;
}

}  // namespace

std::vector<std::string> EnsemblePlan::keys() const {
  std::vector<std::string> all;
  for (const EnsembleVaried& one : varied) all.insert(all.end(), one.keys.begin(), one.keys.end());
  return all;
}

std::vector<std::string> EnsemblePlan::units() const {
  std::vector<std::string> all;
  for (const EnsembleVaried& one : varied)
    all.insert(all.end(), one.units.begin(), one.units.end());
  return all;
}

std::vector<double> EnsemblePlan::numbers(std::int64_t member) const {
  std::vector<double> all;
  for (std::size_t i = 0; i < varied.size(); ++i) {
    std::vector<double> x = draws.values(static_cast<std::uint64_t>(member), i);
    put_in_shape(varied[i], x);
    all.insert(all.end(), x.begin(), x.end());
  }
  return all;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
