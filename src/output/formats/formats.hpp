// SPDX-License-Identifier: MIT
// Our formats, each in its own source.
#pragma once

#include <string>
#include <vector>

#include "polhode/output/output_format.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

OutputFormat csv_format();
OutputFormat hdf5_format();
OutputFormat aem_format();

// The lines of a CSV file before its rows.
std::string csv_head(const std::vector<ColumnGroup>& groups, const Provenance& provenance);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
