// SPDX-License-Identifier: MIT
// read_time_series: columns of an output of polhode, or of any table, and the times of their rows.
//
// Units       those that the file names, as it names them.
// Domain      .h5 and .hdf5: an output of polhode; any other file: a table
//             (tables/number_table.hpp), whose units stand in a comment,
//             "# units: t [s], obliquity [deg]", as in outputs of polhode.
// Accuracy    that of the file.
// Errors      DomainError "FILE: ..." for what cannot be read, for a column that is not there, for
//             columns of different lengths.
// Cost        that of a table; the columns asked for are held.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace io {

struct TimeSeries {
  std::string file;                          // as messages show it
  std::vector<std::vector<double>> columns;  // in the order in which they were asked for
  std::vector<std::string> units;            // of each; empty where the file does not say
};

TimeSeries read_time_series(const std::string& path, std::span<const std::string> columns);

}  // namespace io
}  // namespace v0
}  // namespace polhode
