// SPDX-License-Identifier: MIT
// Rows of terms in CSV, apart from the type of their coefficients.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

struct CsvRow {
  std::size_t line;
  std::string_view coefficient;
  TermKey key;
  std::string_view known;  // empty without that column
};

// Coefficients that are functions have a last column: the degree to which one is known.
std::string csv_header(const Symbols& symbols, bool has_known = false);
// What follows the coefficient, up to the end of the line.
std::string csv_row(const Symbols& symbols, const TermKey& key);
std::vector<CsvRow> csv_rows(const Symbols& symbols, std::string_view table,
                             bool has_known = false);
[[noreturn]] void refuse_row(std::size_t line, std::string_view value, const char* why);

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
