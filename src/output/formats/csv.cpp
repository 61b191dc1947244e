// SPDX-License-Identifier: MIT
// CSV: `#` lines with provenance, one header line, shortest round-trip numbers.
#include <charconv>
#include <fstream>
#include <limits>

#include "output/formats/formats.hpp"
#include "polhode/error.hpp"
#include "polhode/output/text_sink.hpp"
#include "polhode/text/separated.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr CommentStyle comments{"# "};

void append_row(std::string& out, std::span<const double> row) {
  const std::size_t before = out.size();
  out.resize(before + row.size() * static_cast<std::size_t>(longest_number));
  char* end = out.data() + before;
  for (const double number : row) {
    end = write_number(end, number);
    *end++ = ',';
  }
  end[-1] = '\n';
  out.resize(static_cast<std::size_t>(end - out.data()));
}

std::vector<double> rows_of(const std::string& path, const std::vector<ColumnGroup>& groups,
                            std::int64_t count) {
  std::size_t width = 0;
  for (const ColumnGroup& group : groups) width += group.columns.size();
  std::ifstream file(path, std::ios::binary);
  std::string line;
  while (std::getline(file, line) && line.starts_with('#')) {
  }
  std::vector<double> rows;
  for (std::int64_t row = 0; row < count && std::getline(file, line); ++row)
    for (const std::string_view field : separated(line, ',')) {
      double number = std::numeric_limits<double>::quiet_NaN();
      std::from_chars(field.data(), field.data() + field.size(), number);
      rows.push_back(number);
    }
  if (rows.size() == width * static_cast<std::size_t>(count)) return rows;
  throw DomainError(printable(path, path.size()) + ": expected " + std::to_string(count) +
                    " rows of " + std::to_string(width) + " numbers");
}

}  // namespace

std::string csv_head(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  std::string out;
  append_origin(out, comments, provenance);
  std::string names, units;
  for (const ColumnGroup& group : groups)
    for (const Column& column : group.columns) {
      names += (names.empty() ? "" : ",") + column.name;
      units += (units.empty() ? "" : ", ") + column.name + " [" + column.unit + "]";
    }
  append_comment(out, comments, "units: ", units);
  return out + names + "\n";
}

OutputFormat csv_format() {
  OutputFormat format("csv", ".csv", "Comma-separated values: a line for each row.",
                      [](const SinkRequest& request) {
                        return text_sink(request, csv_head(request.groups, request.provenance),
                                         append_row);
                      });
  format.label = "CSV";
  format.number_bytes = {2, 18};  // a digit and a comma; some 17 digits
  format.difference = [](const std::string& path, const std::vector<ColumnGroup>& groups,
                         const Provenance& provenance) {
    return text_difference(path, comments, csv_head(groups, provenance));
  };
  format.rows = rows_of;
  return format;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
