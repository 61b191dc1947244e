// SPDX-License-Identifier: MIT
// The files of histograms, OUT.NAME.csv next to the first output OUT.csv of an ensemble.
#pragma once

#include <string>
#include <vector>

#include "polhode/run/ensemble_run.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Of each histogram of the plan; none where there are no outputs, or no statistics. DomainError
// where no output is a file, and for files that the scenario reads or another output is.
std::vector<std::string> histogram_paths(const ScenarioEnsemble& ensemble,
                                         const std::vector<std::string>& outputs);

// Files that an earlier part has completed, these or those of chunks, and that are not written
// again: DomainError for one that is gone.
void require_there(const std::vector<std::string>& paths, const BeginWords& words);

// Written as PATH.part, then renamed; each says its path. OutputError.
void write_histograms(std::vector<EnsembleReport::Histogram>& histograms,
                      const std::vector<std::string>& paths, const OutputFormats& formats,
                      Provenance origin);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
