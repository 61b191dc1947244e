// SPDX-License-Identifier: MIT
// Whether the files of a run find room: their bytes, as far as rows and columns tell them, against
// what is free where they lie. ScenarioRun refuses a run that does not; a program may warn of one
// that may not.
//
// Equations   bytes = rows x numbers of a row x bytes of a number (OutputFormat::number_bytes).
// Units       bytes.
// Domain      regular files of formats that tell; all else, pipes and devices, takes nothing.
// Accuracy    HDF5 to some kB; of CSV the least, and what is usual.
// Errors      none: where the room cannot be told there is enough.
// Cost        a call of the system for each file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {

// Of the outputs on one disk.
struct DiskNeed {
  std::string paths;  // "a.csv, a.h5"
  double least = 0.0;
  double usual = 0.0;
  double available = 0.0;
};

// Of a run that has written `done` of its rows; files that it writes anew give up their room first.
std::vector<DiskNeed> disk_needs(const Scenario& scenario, std::span<const std::string> outputs,
                                 std::int64_t done = 0);
// Whether the run may end before its last row, by an event.
bool may_end_early(const Scenario& scenario);
// "a.h5: 80000000000 bytes needed for 1000000000 rows of 10 numbers, 5000000 bytes free there"
std::string disk_text(const Scenario& scenario, const DiskNeed& need, double bytes,
                      std::int64_t done = 0);

}  // namespace v0
}  // namespace polhode
