// SPDX-License-Identifier: MIT
// OutputPlan: what the rows of a scenario hold and how they are written.
//
// Domain      groups of columns by their names (polhode/output/columns.hpp).
// Errors      none; a group that the experiment does not have is refused when the file is read.
#pragma once

#include <string>
#include <vector>

#include "polhode/output/output_format.hpp"

namespace polhode {
inline namespace v0 {

struct OutputPlan {
  std::vector<std::string> columns;  // names of column groups
  OutputFormats formats = default_output_formats();
  FormatOptions options = {};  // of the formats whose tables [output.NAME] the file has
};

}  // namespace v0
}  // namespace polhode
