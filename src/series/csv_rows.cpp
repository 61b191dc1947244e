// SPDX-License-Identifier: MIT
#include "polhode/series/detail/csv_rows.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/series/detail/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    found.push_back(line.substr(0, comma));
    if (comma != std::string_view::npos) line.remove_prefix(comma + 1);
  }
  return found;
}

int integer(std::size_t line, std::string_view cell) {
  int n = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), n);
  if (error != std::errc{} || end != cell.data() + cell.size())
    refuse_row(line, cell, "is no exponent or multiplier: an integer");
  return n;
}

CsvRow row_of(const Symbols& symbols, std::size_t line, std::string_view text) {
  const std::vector<std::string_view> found = cells(text);
  const std::size_t variables = symbols.variables().size(), angles = symbols.angles().size();
  if (found.size() != 2 + variables + angles)
    refuse_row(line, text, "has another number of columns than the header");
  if (found[1] != "cos" && found[1] != "sin") refuse_row(line, found[1], "is neither cos nor sin");
  std::vector<std::pair<std::string, int>> powers, multiples;
  for (std::size_t i = 0; i < variables; ++i)
    powers.emplace_back(symbols.variables()[i], integer(line, found[2 + i]));
  for (std::size_t i = 0; i < angles; ++i)
    multiples.emplace_back(symbols.angles()[i], integer(line, found[2 + variables + i]));
  const Trigonometric function = found[1] == "cos" ? Trigonometric::cosine : Trigonometric::sine;
  return {line, found[0], packed(symbols, powers, multiples, function)};
}

}  // namespace

void refuse_row(std::size_t line, std::string_view value, const char* why) {
  throw DomainError("series: line " + std::to_string(line) + ": " + quoted(value) + " " + why);
}

std::string csv_header(const Symbols& symbols) {
  std::string header = "coefficient,function";
  for (const std::string& name : symbols.variables()) header += "," + name + "^";
  for (const std::string& name : symbols.angles()) header += "," + name;
  return header + "\n";
}

std::string csv_row(const Symbols& symbols, const TermKey& key) {
  std::string row = key.function() == Trigonometric::sine ? ",sin" : ",cos";
  for (int i = 0; i < symbols.exponents().count(); ++i)
    row += "," + std::to_string(exponent(symbols, key, i));
  for (int i = 0; i < symbols.multipliers().count(); ++i)
    row += "," + std::to_string(multiplier(symbols, key, i));
  return row + "\n";
}

std::vector<CsvRow> csv_rows(const Symbols& symbols, std::string_view table) {
  std::vector<CsvRow> rows;
  std::string header = csv_header(symbols);
  header.pop_back();
  for (std::size_t line = 1; line == 1 || !table.empty(); ++line) {
    const std::size_t end = table.find('\n');
    std::string_view text = table.substr(0, end);
    table.remove_prefix(end == std::string_view::npos ? table.size() : end + 1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    if (line == 1) {
      if (text != header) refuse_row(line, text, ("is not the header " + header).c_str());
    } else if (!text.empty()) {
      rows.push_back(row_of(symbols, line, text));
    }
  }
  return rows;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
