// SPDX-License-Identifier: MIT
#include "scenario/ensemble/wanted.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

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
  std::string of(const EnsembleContext& at, const std::string& path) {
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

std::optional<double> bound_of(const EnsembleContext& at, const std::string& path) {
  return has(at.values, path) ? std::optional(number(at.values, path)) : std::nullopt;
}

const std::vector<double>& bounds_of(const EnsembleContext& at, const std::string& path,
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

EnsembleHistogram histogram_of(const EnsembleContext& at, const std::string& path, Names& names) {
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
std::string without_indicators(const OwnExperiment&) {
  return "no indicators, which are those of a file of kind \"rotation\"";
}

}  // namespace

std::vector<EnsembleFraction> wanted_fractions(const EnsembleContext& at) {
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

std::vector<EnsembleHistogram> wanted_histograms(const EnsembleContext& at) {
  std::vector<EnsembleHistogram> all;
  Names names;
  for (const std::string& path : array_paths(at.values, "ensemble.histogram"))
    all.push_back(histogram_of(at, path, names));
  return all;
}

std::vector<EnsembleIndicator> wanted_indicators(const EnsembleContext& at,
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
