// SPDX-License-Identifier: MIT
// [[ensemble.fraction]] and [[ensemble.histogram]]: which members are counted.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "polhode/output/columns.hpp"
#include "polhode/scenario/ensemble_plan.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct HistogramTable;
extern const Table<EnsembleFraction> fraction_description;
extern const Table<HistogramTable> histogram_description;

std::vector<EnsembleFraction> fractions_of(const FileValues& file);
std::vector<EnsembleHistogram> histograms_of(const FileValues& file);
// ScenarioError at the place of a column that neither the rows of a member nor the keys that vary
// have, and of a name that one of the rows or an event has.
void require_columns(const FileValues& file, const EnsemblePlan& plan,
                     std::span<const ColumnGroup> rows, std::span<const std::string> events);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
