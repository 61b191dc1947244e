// SPDX-License-Identifier: MIT
// From [ensemble] to its plan: members, and the statistics that are wanted of them.
#include "scenario/ensemble/ensemble_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "scenario/ensemble/vary.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

constexpr std::int64_t most_histogram_bins = 10'000;  // along each of its columns

// Of tables of one sort: no two are called the same.
class Names {
 public:
  std::string of(const FileValues& at, const std::string& path) {
    const std::string& name = word(at.values, path + ".name");
    if (std::find(taken_.begin(), taken_.end(), name) != taken_.end())
      refuse(at.values, path + ".name", at.name,
             "expected a name of its own, since another table before it has this one");
    taken_.push_back(name);
    return name;
  }

 private:
  std::vector<std::string> taken_;
};

std::optional<double> bound_of(const FileValues& at, const std::string& path) {
  return has(at.values, path) ? std::optional(number(at.values, path)) : std::nullopt;
}

const std::vector<double>& bounds_of(const FileValues& at, const std::string& path,
                                     std::size_t columns) {
  if (!has(at.values, path))
    refuse(at.values, path, at.name, "expected low and high, or neither of them");
  const std::vector<double>& all = value_at(at.values, path).numbers;
  if (all.size() != columns)
    refuse(at.values, path, at.name,
           columns == 1 ? "expected one number, for the one column"
                        : "expected two numbers, one for each of columns");
  return all;
}

EnsembleHistogram histogram_of(const FileValues& at, const std::string& path, Names& names) {
  EnsembleHistogram made{names.of(at, path), {}, word(at.values, path + ".times") == "all"};
  const std::vector<std::string>& columns = value_at(at.values, path + ".columns").words;
  if (columns.size() > 2 || (columns.size() == 2 && columns[0] == columns[1]))
    refuse(at.values, path + ".columns", at.name, "expected one column or two different ones");
  const std::int64_t bins = value_at(at.values, path + ".bins").whole;
  if (bins < 1 || bins > most_histogram_bins)
    refuse(at.values, path + ".bins", at.name, "expected a whole number from 1 to 1e4");
  for (const std::string& column : columns) made.axes.push_back({column, bins, std::nullopt});
  if (!has(at.values, path + ".low") && !has(at.values, path + ".high")) return made;
  const std::vector<double>& low = bounds_of(at, path + ".low", columns.size());
  const std::vector<double>& high = bounds_of(at, path + ".high", columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!(low[i] < high[i])) refuse(at.values, path + ".low", at.name, "expected less than high");
    made.axes[i].bounds = {low[i], high[i]};
  }
  return made;
}

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
std::string without_indicators(const Obliquity&) {
  return "no indicators, which are those of a file of kind \"rotation\"";
}
std::string without_indicators(const CustomExperiment&) {
  return "no indicators, which are those of a file of kind \"rotation\"";
}

std::vector<EnsembleFraction> wanted_fractions(const FileValues& at) {
  std::vector<EnsembleFraction> all;
  Names names;
  for (const std::string& path : array_paths(at.values, "ensemble.fraction")) {
    EnsembleFraction one{names.of(at, path), word(at.values, path + ".column"),
                         bound_of(at, path + ".low"), bound_of(at, path + ".high")};
    if (!one.low && !one.high) refuse(at.values, path, at.name, "expected low, high or both");
    if (one.low && one.high && !(*one.low < *one.high))
      refuse(at.values, path + ".low", at.name, "expected less than high");
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<EnsembleHistogram> wanted_histograms(const FileValues& at) {
  std::vector<EnsembleHistogram> all;
  Names names;
  for (const std::string& path : array_paths(at.values, "ensemble.histogram"))
    all.push_back(histogram_of(at, path, names));
  return all;
}

std::vector<EnsembleIndicator> wanted_indicators(const FileValues& at,
                                                 const Experiment& experiment) {
  const std::string path = "ensemble.indicators";
  if (!has(at.values, path)) return {};
  const std::string why =
      std::visit([](const auto& of) { return without_indicators(of); }, experiment);
  if (!why.empty()) refuse(at.values, path, at.name, "expected " + why);
  std::vector<EnsembleIndicator> all;
  for (const std::string& one : value_at(at.values, path).words)
    all.push_back(one == "lyapunov" ? EnsembleIndicator::lyapunov : EnsembleIndicator::mean_megno);
  return all;
}

constexpr std::int64_t most_members = 1'000'000'000'000, most_bins = 1'000'000;
constexpr std::int64_t largest_chunk = 1024, chunks = 64;  // where the file names none

std::int64_t whole_in(const FileValues& at, const std::string& path, std::int64_t least,
                      std::int64_t most, const char* words) {
  const std::int64_t n = value_at(at.values, path).whole;
  if (n < least || n > most)
    refuse(at.values, path, at.name, std::string("expected a whole number ") + words);
  return n;
}

std::vector<double> quantiles_of(const FileValues& at) {
  const std::string path = "ensemble.quantiles";
  const std::vector<double>& all = value_at(at.values, path).numbers;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!(all[i] >= 0.0 && all[i] <= 1.0) || (i > 0 && !(all[i] > all[i - 1])))
      refuse(at.values, path, at.name, "expected numbers from 0 to 1, each above the one before");
  return all;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& one : words) text += (text.empty() ? "" : " ") + one;
  return text;
}

// All tables in their order; the first grid stands for all of them.
class Tables {
 public:
  explicit Tables(const FileValues& at) : at_(at) {}

  void add(const std::string& path) {
    const VariedNumbers numbers = varied_numbers(at_, path);
    require_new(numbers, path);
    VariedTable table = varied_table(at_, path, numbers);
    if (table.axis) return add_axis(std::move(table), path);
    names_.push_back({joined(numbers.keys), *std::move(table.distribution)});
    varied_.push_back(std::move(table.varied));
  }

  // The grid, with all of its axes.
  void finish(const std::string& path) {
    if (axes_.empty()) return;
    names_[grid_].name = joined(varied_[grid_].keys);
    built(at_.values, path, at_.name, [&] {
      names_[grid_].distribution = DrawGrid(axes_);
      return true;
    });
  }

  std::vector<Varied> names() { return std::move(names_); }
  std::vector<EnsembleVaried> varied() { return std::move(varied_); }

 private:
  void add_axis(VariedTable table, const std::string& path) {
    if (axes_.empty()) {
      grid_ = varied_.size();
      names_.push_back({path, DrawGrid({*table.axis})});
      varied_.push_back(std::move(table.varied));
    } else {
      EnsembleVaried& grid = varied_[grid_];
      grid.text += "; " + table.varied.text;
      grid.keys.push_back(table.varied.keys[0]);
      grid.units.push_back(table.varied.units[0]);
    }
    axes_.push_back(*table.axis);
  }

  void require_new(const VariedNumbers& numbers, const std::string& path) {
    for (const std::string& key : numbers.keys) {
      if (std::find(taken_.begin(), taken_.end(), key) != taken_.end())
        refuse(at_.values, path + (has(at_.values, path + ".keys") ? ".keys" : ".key"), at_.name,
               "expected keys that no other table varies; " + key + " comes twice");
      taken_.push_back(key);
    }
  }

  const FileValues& at_;
  std::vector<std::string> taken_;
  std::vector<Varied> names_;
  std::vector<EnsembleVaried> varied_;
  std::vector<DrawAxis> axes_;
  std::size_t grid_ = 0;
};

EnsembleKeep keep_of(const std::string& word) {
  return word == "final"  ? EnsembleKeep::final
         : word == "rows" ? EnsembleKeep::rows
                          : EnsembleKeep::statistics;
}

const std::optional<SaveAt>& rows_of(const Experiment& experiment) {
  return std::visit([](const auto& of) -> const std::optional<SaveAt>& { return row_times(of); },
                    experiment);
}

}  // namespace

EnsemblePlan ensemble_plan(const FileValues& at, const Experiment& experiment) {
  const Values& values = at.values;
  if (!rows_of(experiment)) refuse(values, "ensemble", at.name, "expected a table [time] as well");
  const std::int64_t size = whole_in(at, "ensemble.size", 1, most_members, "from 1 to 1e12");
  const std::int64_t seed = whole_in(at, "ensemble.seed", 0, INT64_MAX, "from 0 to 2^63 - 1");
  const std::int64_t chunk =
      has(values, "ensemble.chunk")
          ? whole_in(at, "ensemble.chunk", 1, most_bins, "from 1 to 1e6")
          : std::clamp<std::int64_t>((size + chunks - 1) / chunks, 1, largest_chunk);
  Tables tables(at);
  for (const std::string& path : array_paths(values, "ensemble.vary")) tables.add(path);
  tables.finish("ensemble.vary[0]");
  const DrawSource source =
      word(values, "ensemble.draws") == "sobol" ? DrawSource::sobol : DrawSource::random;
  std::vector<EnsembleVaried> varied = tables.varied();
  Draws draws = built(values, "ensemble", at.name, [&] {
    return Draws(tables.names(), static_cast<std::uint64_t>(seed), source);
  });
  if (static_cast<std::uint64_t>(size) > draws.most_members())
    refuse(values, "ensemble.size", at.name,
           "expected at most " + std::to_string(draws.most_members()) +
               ", the rows of the shortest table; with order = \"draws\" there may be more");
  return {size,
          static_cast<std::uint64_t>(seed),
          source,
          keep_of(word(values, "ensemble.keep")),
          chunk,
          quantiles_of(at),
          whole_in(at, "ensemble.bins", 1, most_bins, "from 1 to 1e6"),
          wanted_fractions(at),
          wanted_indicators(at, experiment),
          wanted_histograms(at),
          std::move(varied),
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

}  // namespace v0
}  // namespace polhode
