// SPDX-License-Identifier: MIT
// Tables of numbers in text files, row by row.
#include "tables/number_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "polhode/error.hpp"
#include "tables/detail/gzip_file.hpp"
#include "tables/detail/line_reader.hpp"
#include "tables/detail/trimmed.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using Fields = std::vector<std::string_view>;

constexpr std::string_view blanks = " \t";
constexpr std::size_t most_comments = 10000;

std::string_view unquoted(std::string_view field) {
  field = detail::trimmed(field);
  const bool quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return quoted ? detail::trimmed(field.substr(1, field.size() - 2)) : field;
}

// What separates fields: semicolons, unless there are more commas, or blanks.
char separator_of(std::string_view line) {
  const auto commas = std::count(line.begin(), line.end(), ',');
  const auto semicolons = std::count(line.begin(), line.end(), ';');
  if (commas == 0 && semicolons == 0) return ' ';
  return semicolons >= commas ? ';' : ',';
}

void split(std::string_view line, char separator, Fields& fields) {
  fields.clear();
  line = detail::trimmed(line);
  const bool is_blank = separator == ' ';
  while (!line.empty()) {
    const std::size_t end = is_blank ? line.find_first_of(blanks) : line.find(separator);
    fields.push_back(unquoted(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
    if (is_blank)
      line = detail::trimmed(line);
    else if (line.empty())
      fields.emplace_back();
  }
}

// A separator at the end of a line begins no column.
void drop_empty_end(Fields& fields) {
  if (fields.size() > 1 && fields.back().empty()) fields.pop_back();
}

// The number at the front of a field, finite or not; nothing where the field is something else.
std::optional<double> number_of(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  std::array<char, 64> copy{};
  if (field.empty() || field.size() > copy.size()) return std::nullopt;
  std::transform(field.begin(), field.end(), copy.begin(),
                 [](char c) { return c == 'D' || c == 'd' ? 'e' : c; });
  double value = 0.0;
  const char* const end = copy.data() + field.size();
  const auto [stop, error] = std::from_chars(copy.data(), end, value);
  if (stop != end) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

bool is_number(std::string_view field) { return number_of(field).has_value(); }

// A line of names: no field is a number, nor a date.
bool is_header(const Fields& fields) {
  return std::none_of(fields.begin(), fields.end(), is_number) &&
         std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
           return field.empty() || field.front() < '0' || field.front() > '9';
         });
}

// How what JPL's Horizons sends begins; rows are between $$SOE and $$EOE.
bool is_banner(std::string_view line) {
  return line.starts_with("***") || line.starts_with("API VERSION");
}

// Rows of a file one by one, with the names that stand above them.
class TableReader {
 public:
  explicit TableReader(const std::string& path)
      : shown_(detail::printable(path, detail::longest_name)),
        file_(path),
        source_([this](std::span<char> bytes) { return file_.read(bytes); }),
        lines_(source_) {}

  // Whether there is one; it is then in fields().
  bool next() {
    std::string above;  // the comment right above
    for (;;) {
      const std::optional<std::string_view> line = lines_.next();
      if (!line) {
        if (lines_.too_long()) fail("is longer than 1 MiB", number_ + 1);
        return false;
      }
      ++number_;
      const std::size_t hash = line->find('#');
      const std::string_view text = detail::trimmed(line->substr(0, hash));
      if (!has_rows_ && hash != std::string_view::npos) keep(line->substr(hash + 1), false);
      if (text.empty()) {
        if (hash != std::string_view::npos) above = line->substr(hash + 1);
        continue;
      }
      if (!started_ && is_banner(text)) {
        skip_banner();
        continue;
      }
      if (text == "$$EOE") return false;
      if (!separator_) separator_ = separator_of(text);
      split(text, *separator_, fields_);
      if (started_) return has_rows_ = true;
      started_ = true;
      if (is_header(fields_)) {
        drop_empty_end(fields_);
        names_.assign(fields_.begin(), fields_.end());
        separator_.reset();
        continue;
      }
      name_by_comment(above);
      return has_rows_ = true;
    }
  }

  // The fields of a row; the last is empty if the line ends with a separator.
  const Fields& fields() const { return fields_; }
  std::size_t count_of_columns() const {
    const bool ends_empty = fields_.size() > 1 && fields_.back().empty();
    return fields_.size() - (ends_empty ? 1 : 0);
  }
  const std::vector<std::string>& names() const { return names_; }
  const std::string& shown() const { return shown_; }
  std::size_t line() const { return number_; }
  const std::vector<NumberTable::Comment>& comments() const { return comments_; }
  [[noreturn]] void fail(const std::string& what) const { fail(what, number_); }

 private:
  // To the first row of Horizons; the names are in the last line above that is no rule of stars.
  void skip_banner() {
    std::string above;
    while (const std::optional<std::string_view> line = lines_.next()) {
      ++number_;
      const std::string_view text = detail::trimmed(*line);
      keep(text, true);
      if (text == "$$SOE") {
        if (above.find(',') == std::string::npos)
          fail("names no columns above; expected what Horizons sends with CSV_FORMAT = YES");
        split(above, ',', fields_);
        drop_empty_end(fields_);
        names_.assign(fields_.begin(), fields_.end());
        started_ = true;
        return;
      }
      if (!text.empty() && !text.starts_with("***")) above = text;
    }
    fail("the file ends before $$SOE, where rows of Horizons begin");
  }
  void keep(std::string_view text, bool is_banner) {
    if (comments_.size() < most_comments)
      comments_.push_back({std::string(text), static_cast<std::uint32_t>(number_), is_banner});
  }
  [[noreturn]] void fail(const std::string& what, std::size_t line) const {
    throw DomainError(shown_ + ":" + std::to_string(line) + ": " + what);
  }
  void name_by_comment(std::string_view comment) {
    Fields words;
    split(comment, separator_of(comment), words);
    drop_empty_end(words);
    const bool fits = words.size() == fields_.size() || words.size() == count_of_columns();
    if (fits && is_header(words)) names_.assign(words.begin(), words.end());
  }

  std::string shown_;
  detail::GzipFile file_;
  ByteSource source_;
  detail::LineReader lines_;
  Fields fields_;
  std::vector<std::string> names_;
  std::optional<char> separator_;
  std::vector<NumberTable::Comment> comments_;
  bool started_ = false;  // names or rows
  bool has_rows_ = false;
  std::size_t number_ = 0;
};

std::optional<std::size_t> column_number(std::string_view text) {
  std::size_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && number > 0 ? std::optional(number) : std::nullopt;
}

// Where a column stands, from 0.
std::size_t column_index(const TableReader& reader, const std::string& column) {
  const std::vector<std::string>& names = reader.names();
  const auto found = std::find(names.begin(), names.end(), column);
  if (found != names.end()) {
    if (std::find(found + 1, names.end(), column) != names.end())
      reader.fail("two columns are called " + detail::printable(column) + "; expected its number");
    return static_cast<std::size_t>(found - names.begin());
  }
  const std::string shown = detail::printable(column);
  if (const auto number = column_number(column)) {
    if (*number <= reader.fields().size()) return *number - 1;
    reader.fail("has " + std::to_string(reader.count_of_columns()) +
                " columns; expected one of number " + shown);
  }
  if (names.empty())
    reader.fail("no line names the columns; expected the number of column " + shown +
                " in place of its name");
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string_view near = detail::nearest(column, known);
  reader.fail("there is no column " + shown + "; expected one of " +
              detail::printable(detail::one_of(known), 300) +
              (near.empty() ? "" : "; did you mean " + detail::printable(near) + "?"));
}

// What a field of the row holds.
double value_in(const TableReader& reader, std::size_t index, const std::string& column,
                const FieldReader& read) {
  if (index >= reader.fields().size())
    reader.fail("has " + std::to_string(reader.fields().size()) +
                " fields; expected one in column " + detail::printable(column));
  const std::string_view field = reader.fields()[index];
  try {
    return read(field);
  } catch (const DomainError& error) {
    reader.fail("column " + detail::printable(column) + ": \"" + detail::printable(field) + "\" " +
                error.what());
  }
}

}  // namespace

double number_from_field(std::string_view field) {
  const std::optional<double> value = number_of(field);
  if (!value) throw DomainError("is not a number");
  if (!std::isfinite(*value)) throw DomainError("is not a finite number");
  return *value;
}

std::vector<std::string> table_columns(const std::string& path) {
  TableReader reader(path);
  if (!reader.next()) return {};
  if (!reader.names().empty()) return reader.names();
  std::vector<std::string> numbers;
  for (std::size_t i = 1; i <= reader.count_of_columns(); ++i) numbers.push_back(std::to_string(i));
  return numbers;
}

NumberTable read_number_table(const std::string& path, std::span<const std::string> columns,
                              const FieldReader& first) {
  std::vector<FieldReader> readers(columns.size(), number_from_field);
  if (!readers.empty()) readers.front() = first;
  return read_number_table(path, columns, readers);
}

NumberTable read_number_table(const std::string& path, std::span<const std::string> columns,
                              std::span<const FieldReader> readers,
                              std::span<const std::size_t> unchecked) {
  TableReader reader(path);
  NumberTable table{reader.shown(), std::vector<std::vector<double>>(columns.size()), {}, {}, {}};
  std::vector<std::size_t> indices;
  while (reader.next()) {
    if (indices.empty())
      for (const std::string& column : columns) indices.push_back(column_index(reader, column));
    const bool is_checked = std::ranges::find(unchecked, reader.line()) == unchecked.end();
    for (std::size_t k = 0; k < indices.size(); ++k) {
      double value = std::numeric_limits<double>::quiet_NaN();
      try {
        value = value_in(reader, indices[k], columns[k], readers[k]);
      } catch (const DomainError&) {
        if (is_checked) throw;
      }
      table.columns[k].push_back(value);
    }
    table.lines.push_back(static_cast<std::uint32_t>(reader.line()));
  }
  table.names = reader.names();
  table.comments = reader.comments();
  return table;
}

void require_rising(const NumberTable& table, std::size_t column, std::string_view what) {
  const std::vector<double>& x = table.columns.at(column);
  for (std::size_t k = 1; k < x.size(); ++k) {
    if (x[k] > x[k - 1]) continue;
    const std::string at = table.file + ":" + std::to_string(table.lines[k]) + ": " +
                           std::string(what) + " " + polhode::detail::number_text(x[k]);
    throw DomainError(at +
                      (x[k] == x[k - 1] ? " stands twice, here and in line "
                                        : " comes after " + polhode::detail::number_text(x[k - 1]) +
                                              " of line ") +
                      std::to_string(table.lines[k - 1]) + "; expected rising values");
  }
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
