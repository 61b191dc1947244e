// SPDX-License-Identifier: MIT
// What an earlier run has left next to its outputs, and what is said of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "output/part_file.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/run/scenario_run.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// As messages name it.
std::string shown_path(const std::string& path);
// PATH.checkpoint
std::string checkpoint_path(const std::string& output);
// The checkpoint of the unfinished run that an output belongs to: next to it, or next to the first
// output of that run. Empty: there is none. DomainError when there should be one.
std::string checkpoint_among(std::span<const std::string> outputs, const BeginWords& words);
// Leaves next to an output where the checkpoint of its run is.
void point_to_checkpoint(const std::string& output, const std::string& checkpoint);
// Also removes what a kill can leave beside them: PATH.checkpoint.part and PATH.part-undo.
void forget_checkpoints(std::span<const std::string> outputs);
// A renamed file is on the disk when its folder is.
void sync_folder_of(const std::string& path);

// "FILE: an unfinished run is there (TOLD); resume continues it, ..."
[[noreturn]] void refuse_unfinished(const std::string& file, const std::string& kind,
                                    const std::string& progress, const BeginWords& words);

// Where an output is to be, and its columns.
struct PlannedOutput {
  std::string path;
  std::vector<ColumnGroup> groups;
};
// Whether all outputs are there, with none on its way. DomainError for one of another scenario, of
// other files that the scenario names or with other columns, and for one that does not say.
bool are_complete(std::span<const PlannedOutput> outputs, const OutputFormats& formats,
                  const Provenance& provenance, const BeginWords& words);

// A disk that was full says what to do: make space, and what `next` says. Empty: nothing helps.
template <class F, class Next>
void with_remedy(const F& f, const Next& next) {
  try {
    f();
  } catch (const NoSpace& full) {
    const std::string then = next();
    if (then.empty()) throw;
    throw OutputError(std::string(full.what()) + "; " + full.remedy + ", then " + then);
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
