// SPDX-License-Identifier: MIT
// [[ensemble.fraction]] and [[ensemble.histogram]]: which members are counted.
#pragma once

#include <vector>

#include "polhode/detail/scenario/ensemble_plan.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct HistogramTable;
extern const Table<EnsembleFraction> fraction_description;
extern const Table<HistogramTable> histogram_description;

std::vector<EnsembleFraction> fractions_of(const FileValues& file);
std::vector<EnsembleHistogram> histograms_of(const FileValues& file);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
