// SPDX-License-Identifier: MIT
// Our formats, each in its own source.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "polhode/detail/output/row_dates.hpp"
#include "polhode/output/output_format.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

OutputFormat csv_format();
OutputFormat hdf5_format();
OutputFormat aem_format();

// The lines of a CSV file before its rows.
std::string csv_head(const std::vector<ColumnGroup>& groups, const Provenance& provenance);
// DomainError, naming the path, where dates cannot be written.
RowDates dates_of(const SinkRequest& request);
// One of its rows.
void append_csv_row(std::string& text, std::span<const double> row, const RowDates& dates);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
