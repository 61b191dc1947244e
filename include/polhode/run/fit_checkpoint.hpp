// SPDX-License-Identifier: MIT
// FitCheckpoint: what a fit has found so far, kept in FIRST_OUTPUT.checkpoint, so that a fit that
// was stopped or killed continues, as runs do (polhode/run/scenario_run.hpp).
//
// Domain      starts, scans and fits that are done are not computed again; those that were begun
//             are. Without an output that is a file there is no checkpoint. Two fits must not write
//             the same outputs at the same time.
// Accuracy    a fit that was interrupted and continued finds what a fit in one go finds, to the
//             last bit (same build of polhode).
// Errors      the constructor as there.
// Cost        the bytes of all results, chi-square of each pair of a scan included, held in memory
//             and written as a whole; at most a twentieth of the time of the fit.
#pragma once

#include <string>
#include <vector>

#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/run/resumable_run.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {

class FitCheckpoint : public ResumableRun {
 public:
  // `outputs` are the files that the fit will write, the first of which gives the checkpoint its
  // name; of the options begin, words and checkpoint_seconds count. `scenario` must outlive it.
  FitCheckpoint(const Scenario& scenario, const std::vector<std::string>& outputs,
                RunOptions options);

  // For the options of the fit. Checkpoints are written while it gets results.
  CellJournal& journal();
  // Writes a checkpoint; false if this fit has none.
  bool keep();
  // Removes the checkpoint: the fit is complete, or has no solution.
  void forget();

 private:
  class Parts;
  Parts& parts();
};

}  // namespace v0
}  // namespace polhode
