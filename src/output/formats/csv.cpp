// SPDX-License-Identifier: MIT
// CSV: `#` lines with provenance, one header line, shortest round-trip numbers.
#include <charconv>
#include <fstream>
#include <limits>

#include "output/formats/formats.hpp"
#include "polhode/error.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/text/separated.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr CommentStyle csv_comments{"# "};

// With dates among the numbers.
void append_dated_row(std::string& out, std::span<const double> row, const RowDates& dates) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (dates.is_date(i)) {
      out += dates.text(row[i]);
    } else {
      char digits[longest_number];
      out.append(digits, write_number(digits, row[i]));
    }
    out += i + 1 < row.size() ? ',' : '\n';
  }
}

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

std::vector<double> csv_rows(const std::string& path, const std::vector<ColumnGroup>& groups,
                             std::int64_t count) {
  std::vector<bool> is_date;
  for (const ColumnGroup& group : groups)
    for (const Column& column : group.columns) is_date.push_back(column.is_date);
  const std::size_t width = is_date.size();
  std::ifstream file(path, std::ios::binary);
  std::string line;
  while (std::getline(file, line) && line.starts_with('#')) {
  }
  std::vector<double> rows;
  for (std::int64_t row = 0; row < count && std::getline(file, line); ++row) {
    const std::size_t first = rows.size();
    for (const std::string_view field : separated(line, ',')) {
      double number = std::numeric_limits<double>::quiet_NaN();
      std::from_chars(field.data(), field.data() + field.size(), number);
      const std::size_t column = rows.size() - first;
      rows.push_back(column < width && is_date[column] ? rows[first] : number);  // t
    }
  }
  if (rows.size() == width * static_cast<std::size_t>(count)) return rows;
  throw DomainError(printable(path, path.size()) + ": expected " + std::to_string(count) +
                    " rows of " + std::to_string(width) + " numbers");
}

}  // namespace

void append_csv_row(std::string& text, std::span<const double> row, const RowDates& dates) {
  if (dates.any()) return append_dated_row(text, row, dates);
  append_row(text, row);
}

RowDates dates_of(const SinkRequest& request) {
  try {
    return RowDates(request.groups, request.provenance.run);
  } catch (const DomainError& error) {
    throw DomainError(printable(request.path, request.path.size()) + ": " + error.what());
  }
}

std::string csv_head(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  std::string out;
  append_origin(out, csv_comments, provenance);
  std::string names, units;
  for (const ColumnGroup& group : groups)
    for (const Column& column : group.columns) {
      names += (names.empty() ? "" : ",") + column.name;
      units += (units.empty() ? "" : ", ") + column.name + " [" + column.unit + "]";
    }
  append_comment(out, csv_comments, "units: ", units);
  return out + names + "\n";
}

OutputFormat csv_format() {
  OutputFormat format("csv", ".csv", "Comma-separated values: a line for each row.",
                      [](const SinkRequest& request) {
                        const RowDates dates = dates_of(request);
                        return text_sink(
                            request, csv_head(request.groups, request.provenance),
                            [dates](std::string& text, std::span<const double> row) {
                              append_csv_row(text, row, dates);
                            },
                            {}, csv_comments);
                      });
  format.label = "CSV";
  format.number_bytes = {2, 18};  // a digit and a comma; some 17 digits
  format.difference = [](const std::string& path, const std::vector<ColumnGroup>& groups,
                         const Provenance& provenance) {
    return text_difference(path, csv_comments, csv_head(groups, provenance));
  };
  format.rows = csv_rows;
  return format;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
