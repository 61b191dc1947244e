// SPDX-License-Identifier: MIT
#include "scenario/ensemble/ensemble_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "polhode/error.hpp"
#include "scenario/ensemble/direction_angles.hpp"
#include "scenario/ensemble/vary.hpp"
#include "scenario/ensemble/wanted.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::int64_t most_members = 1'000'000'000'000, most_bins = 1'000'000;
constexpr std::int64_t largest_chunk = 1024, chunks = 64;  // where the file names none

std::int64_t whole_in(const EnsembleContext& at, const std::string& path, std::int64_t least,
                      std::int64_t most, const char* words) {
  const std::int64_t n = value_at(at.values, path).whole;
  if (n < least || n > most)
    refuse(at.values, path, at.name, std::string("expected a whole number ") + words);
  return n;
}

std::vector<double> quantiles_of(const EnsembleContext& at) {
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
  explicit Tables(const EnsembleContext& at) : at_(at) {}

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

  const EnsembleContext& at_;
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

EnsemblePlan ensemble_plan(const EnsembleContext& at, const Experiment& experiment) {
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
