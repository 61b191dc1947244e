// SPDX-License-Identifier: MIT
// From [ensemble] to what is wanted of its members beside their rows: fractions, histograms,
// indicators. Which columns there are is for whoever makes the rows to say.
#pragma once

#include <vector>

#include "scenario/ensemble/ensemble_plan.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

std::vector<EnsembleFraction> wanted_fractions(const EnsembleContext& at);
std::vector<EnsembleHistogram> wanted_histograms(const EnsembleContext& at);
std::vector<EnsembleIndicator> wanted_indicators(const EnsembleContext& at,
                                                 const Experiment& experiment);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
