// SPDX-License-Identifier: MIT
// Conversion of tables from one chart to another.
#include "polhode/tables/convert.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/text/separated.hpp"
#include "tables/detail/gzip_file.hpp"
#include "tables/detail/line_reader.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// What the comments of a table that `polhode run` wrote say of its columns: units, and the options
// of charts, which their numbers do not hold.
class TableNotes {
 public:
  // That the charts outlive.
  explicit TableNotes(std::span<const ChartKind> charts) : charts_(charts) {}

  // True for a line that was a note; it speaks of the columns of this table alone, so a converted
  // table must not repeat it.
  bool read(std::string_view comment);

  // The unit of a column, where the table says it.
  std::string_view unit(std::string_view column) const;
  // An option of a chart, where the table says it.
  std::optional<double> option(std::string_view chart, std::string_view name) const;

 private:
  void read_option(const ChartKind& chart, std::string_view name, std::string_view word);

  std::map<std::string, std::string, std::less<>> units_;
  std::map<std::pair<std::string_view, std::string_view>, double> options_;
  std::span<const ChartKind> charts_;
};

namespace {

std::string_view first_word(std::string_view text) { return text.substr(0, text.find(' ')); }

}  // namespace

// "# units: t [h], phi [deg], ...", "# serret: sign_g1 1, sign_g3 -1", "# sadov: region LAM, lobe
// -1".
bool TableNotes::read(std::string_view comment) {
  if (!comment.starts_with("# ")) return false;
  const std::size_t colon = comment.find(": ");
  const std::string_view subject =
      comment.substr(2, colon == std::string_view::npos ? colon : colon - 2);
  const bool units = subject == "units";
  const ChartKind* const chart = chart_named(subject, charts_);
  if (!units && (chart == nullptr || chart->options.empty())) return false;
  std::string_view rest = colon == std::string_view::npos ? "" : comment.substr(colon + 2);
  while (!rest.empty()) {
    const std::size_t comma = rest.find(", ");
    const std::string_view entry = rest.substr(0, comma);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 2);
    const std::string_view name = first_word(entry);
    if (name.size() + 1 >= entry.size()) continue;
    const std::string_view value = entry.substr(name.size() + 1);
    if (units && value.size() > 2)
      units_.emplace(name, value.substr(1, value.size() - 2));
    else if (!units)
      read_option(*chart, name, value);
  }
  return true;
}

void TableNotes::read_option(const ChartKind& chart, std::string_view name, std::string_view word) {
  for (const ChartOption& option : chart.options)
    if (option.name == name)
      if (const double number = option_number(option, word); !std::isnan(number))
        options_.emplace(std::pair(chart.name, option.name), number);
}

std::string_view TableNotes::unit(std::string_view column) const {
  const auto found = units_.find(column);
  return found == units_.end() ? std::string_view() : found->second;
}

std::optional<double> TableNotes::option(std::string_view chart, std::string_view name) const {
  const auto found = options_.find({chart, name});
  if (found == options_.end()) return std::nullopt;
  return found->second;
}

}  // namespace detail

namespace {

constexpr int passes = -1;              // the field goes through
constexpr int replaced = -2;            // the new chart has a column of this name
constexpr int is_time = -3;             // goes through, and is the time of the row
constexpr double largest_angle = 1e10;  // a double beyond it has lost six of its digits
constexpr std::size_t flush_size = std::size_t{1} << 18;

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

// The end of the field that starts at `begin`: its comma or the end of the line. Null for a quote
// that does not close.
const char* field_end(const char* begin, const char* end) {
  const char* p = begin;
  while (p != end && (*p == ' ' || *p == '\t')) ++p;
  if (p == end || *p != '"') {
    const void* comma = std::memchr(p, ',', static_cast<std::size_t>(end - p));
    return comma == nullptr ? end : static_cast<const char*>(comma);
  }
  for (++p; p != end; ++p) {
    if (*p != '"') continue;
    if (p + 1 != end && p[1] == '"') {  // "" is a quote inside quotes
      ++p;
      continue;
    }
    const void* comma = std::memchr(p, ',', static_cast<std::size_t>(end - p));
    return comma == nullptr ? end : static_cast<const char*>(comma);
  }
  return nullptr;
}

class Converter {
 public:
  Converter(const Conversion& conversion, const std::string& name, const ByteSink& sink,
            std::span<const ChartKind> charts);
  void line(std::string_view line);
  // After the last line, or the first that is too long.
  void finish(bool too_long);

 private:
  struct Field {
    std::string name;
    int role;  // column of the old chart, or one of the constants above
    double largest = std::numeric_limits<double>::max();
    std::string_view text = {};
  };
  void flush();
  [[noreturn]] void fail(const std::string& text);
  void read_header(std::string_view line);
  void assign_roles();
  void assign_role(std::size_t field, std::size_t column);
  std::size_t field_of(std::size_t column) const;
  void require_radians(const std::string& column);
  void write_header();
  void read_fields(std::string_view line);
  const char* read_number(Field& field, const char* begin, const char* end);
  void convert_row();
  ChartNumbers state_numbers(const ChartPlace& place) const;
  void write_row(const ChartNumbers& row);

  std::string name_;
  const ByteSink& sink_;
  std::optional<Body> body_;
  const ChartKind& from_;
  const ChartKind& to_;
  std::vector<std::string_view> old_columns_;
  std::vector<std::string_view> columns_;  // of the new chart
  std::vector<Field> fields_;
  std::size_t place_ = 0;  // the field before which the new columns are written
  bool header_done_ = false;
  std::size_t line_number_ = 0;
  detail::TableNotes notes_;
  ChartNumbers numbers_{};
  double time_ = 0.0;
  std::string out_;
};

std::vector<std::string_view> column_names(const ChartKind& chart) {
  std::vector<std::string_view> names;
  for (const ChartVariable& variable : chart.variables) names.push_back(variable.name);
  for (const std::string_view name : branch_columns(chart)) names.push_back(name);
  return names;
}

// "l,g,h,L,G,H": those that a table must have.
std::string needed_columns(const ChartKind& chart) {
  std::string names;
  for (const ChartVariable& variable : chart.variables)
    names += (names.empty() ? "" : ",") + std::string(variable.name);
  return names;
}

const ChartKind& chart_of(const std::string& name, const char* option,
                          std::span<const ChartKind> charts) {
  if (const ChartKind* const chart = chart_named(name, charts)) return *chart;
  std::vector<std::string_view> names;
  for (const ChartKind& chart : charts) names.push_back(chart.name);
  const std::string_view near = detail::nearest(name, names);
  throw DomainError(std::string("convert: ") + option + ": unknown chart \"" + name +
                    "\"; expected " + detail::one_of(names) +
                    (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
}

Converter::Converter(const Conversion& conversion, const std::string& name, const ByteSink& sink,
                     std::span<const ChartKind> charts)
    : name_(name),
      sink_(sink),
      body_(conversion.body),
      from_(chart_of(conversion.from, "--from", charts)),
      to_(chart_of(conversion.to, "--to", charts)),
      old_columns_(column_names(from_)),
      columns_(column_names(to_)),
      notes_(charts) {
  for (const ChartKind* chart : {&from_, &to_})
    if (chart->needs_body && !body_)
      throw DomainError("convert: chart " + std::string(chart->name) +
                        " needs the moments of inertia (--moments I1,I2,I3)");
  out_.reserve(2 * flush_size);
}

void Converter::fail(const std::string& text) {
  flush();
  throw DomainError(name_ + ":" + std::to_string(line_number_) + ": " + text);
}

void Converter::flush() {
  if (!out_.empty()) sink_(out_);
  out_.clear();
}

void Converter::finish(bool too_long) {
  ++line_number_;
  if (too_long) fail("a line of more than 1 MiB");
  if (!header_done_)
    fail("got no header line; expected one with the columns " + needed_columns(from_));
  flush();
}

void Converter::line(std::string_view line) {
  ++line_number_;
  if (line.starts_with('#')) {
    if (header_done_ || !notes_.read(line)) out_.append(line).push_back('\n');
  } else if (without_blanks(line).empty()) {
    return;
  } else if (header_done_) {
    read_fields(line);
    convert_row();
  } else {
    read_header(line);
  }
  if (out_.size() >= flush_size) flush();
}

void Converter::read_header(std::string_view line) {
  const char* end = line.data() + line.size();
  for (const char* begin = line.data();;) {
    const char* stop = field_end(begin, end);
    if (stop == nullptr) fail("a quote does not close");
    std::string_view name = without_blanks({begin, static_cast<std::size_t>(stop - begin)});
    if (name.size() > 1 && name.starts_with('"') && name.ends_with('"'))
      name = name.substr(1, name.size() - 2);
    fields_.push_back({std::string(name), passes});
    if (stop == end) break;
    begin = stop + 1;
  }
  assign_roles();
  write_header();
  header_done_ = true;
}

// By its name in the chart, else by that in rows; fields_.size() where there is none.
std::size_t Converter::field_of(std::size_t column) const {
  const auto named = [&](std::string_view name) {
    return static_cast<std::size_t>(
        std::find_if(fields_.begin(), fields_.end(),
                     [&](const Field& field) { return field.name == name; }) -
        fields_.begin());
  };
  const std::size_t own = named(old_columns_[column]);
  const bool other = own == fields_.size() && column < from_.variables.size();
  return other ? named(from_.variables[column].column) : own;
}

void Converter::assign_role(std::size_t index, std::size_t column) {
  Field& field = fields_[index];
  for (std::size_t i = index + 1; i < fields_.size(); ++i)
    if (fields_[i].name == field.name) fail("column " + field.name + " is named twice");
  require_radians(field.name);
  field.role = static_cast<int>(column);
  if (column < from_.variables.size() && from_.variables[column].dimension == Dimension::angle)
    field.largest = largest_angle;
  place_ = std::min(place_, index);
}

void Converter::assign_roles() {
  place_ = fields_.size();
  for (std::size_t i = 0; i < old_columns_.size(); ++i) {
    const std::size_t index = field_of(i);
    if (index < fields_.size()) {
      assign_role(index, i);
    } else if (i >= from_.variables.size()) {
      numbers_[i] = std::numeric_limits<double>::quiet_NaN();
    } else {
      std::vector<std::string_view> names;
      for (const Field& field : fields_) names.push_back(field.name);
      const std::string_view near = detail::nearest(old_columns_[i], names);
      fail("column " + std::string(old_columns_[i]) + " is missing; chart " +
           std::string(from_.name) + " needs " + needed_columns(from_) +
           (near.empty() ? "" : "; did you mean it by " + detail::printable(near) + "?"));
    }
  }
  for (Field& field : fields_) {
    if (field.role != passes) continue;
    if (std::find(columns_.begin(), columns_.end(), field.name) != columns_.end())
      field.role = replaced;
    else if (field.name == "t" && (from_.is_constant || to_.is_constant))
      field.role = is_time;
  }
}

// A table of `polhode run` says its units.
void Converter::require_radians(const std::string& column) {
  const std::string_view unit = notes_.unit(column);
  for (const char* angle : {"deg", "arcmin", "arcsec", "mas", "uas", "rev"})
    if (unit == angle || unit.starts_with(std::string(angle) + "/"))
      fail("column " + column + " is in " + std::string(unit) +
           "; expected radians (angle = \"rad\" in the [units] of the run)");
}

void Converter::write_header() {
  std::string header;
  const auto add = [&](const std::string& name) {
    const bool quote = name.find_first_of(",\"") != std::string::npos;
    header += (header.empty() ? "" : ",") + (quote ? '"' + name + '"' : name);
  };
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (i == place_)
      for (const std::string_view name : columns_) add(std::string(name));
    if (fields_[i].role == passes || fields_[i].role == is_time) add(fields_[i].name);
  }
  out_ += header + "\n";
}

// A number and the blanks around it; returns where its field ends.
const char* Converter::read_number(Field& field, const char* begin, const char* end) {
  const char* p = begin;
  while (p != end && (*p == ' ' || *p == '\t')) ++p;
  if (p != end && *p == '+' && p + 1 != end && p[1] != '-') ++p;
  double value = 0.0;
  const auto [stop, error] = std::from_chars(p, end, value);
  const char* after = stop;
  while (after != end && (*after == ' ' || *after == '\t')) ++after;
  if (error != std::errc() || (after != end && *after != ',') ||
      !(std::fabs(value) <= field.largest)) {
    const char* wrong_end = std::find(begin, end, ',');
    fail(field.name + ": got \"" +
         detail::printable({begin, static_cast<std::size_t>(wrong_end - begin)}) +
         "\"; expected a finite number" +
         (field.largest == largest_angle ? ", angles up to 1e10" : ""));
  }
  if (field.role >= 0)
    numbers_[static_cast<std::size_t>(field.role)] = value;
  else
    time_ = value;
  return after;
}

void Converter::read_fields(std::string_view line) {
  const char* p = line.data();
  const char* end = p + line.size();
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    Field& field = fields_[i];
    const char* begin = p;
    const bool numeric = field.role >= 0 || field.role == is_time;
    p = numeric ? read_number(field, p, end) : field_end(p, end);
    if (p == nullptr) fail("a quote does not close");
    field.text = {begin, static_cast<std::size_t>(p - begin)};
    const bool last = i + 1 == fields_.size();
    if ((p == end) != last)
      fail("got " + std::string(last ? "more" : "fewer") + " fields than the " +
           std::to_string(fields_.size()) + " of the header");
    ++p;
  }
}

// What the columns leave out of the options, a note of the table may say.
ChartNumbers Converter::state_numbers(const ChartPlace& place) const {
  if (from_.options.empty()) return numbers_;
  ChartNumbers numbers = from_columns(from_, numbers_);
  for (std::size_t i = 0; i < from_.options.size(); ++i) {
    double& number = numbers[from_.variables.size() + i];
    if (std::isnan(number))
      number = notes_.option(from_.name, from_.options[i].name).value_or(number);
  }
  return completed(from_, numbers, place);
}

void Converter::convert_row() {
  try {
    const ChartPlace place{body_ ? &*body_ : nullptr, time_};
    write_row(to_columns(to_, to_.from_hub(from_.to_hub(state_numbers(place), place), place)));
  } catch (const DomainError& error) {
    fail(error.what());
  }
}

void Converter::write_row(const ChartNumbers& row) {
  char text[most_chart_numbers * detail::longest_number];
  char* end = text;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (!std::isfinite(row[i]))
      throw DomainError(std::string(columns_[i]) + " is beyond double range");
    end = detail::write_number(end, row[i]);
    *end++ = ',';
  }
  const std::string_view chart(text, static_cast<std::size_t>(end - text));
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (i == place_) out_ += chart;
    if (fields_[i].role != passes && fields_[i].role != is_time) continue;
    out_ += fields_[i].text;
    out_ += ',';
  }
  out_.back() = '\n';
}

}  // namespace

ByteSource file_source(const std::string& path) {
  return [file = std::make_shared<detail::GzipFile>(path)](std::span<char> bytes) {
    return file->read(bytes);
  };
}

void convert(const Conversion& conversion, const std::string& name, const ByteSource& source,
             const ByteSink& sink, std::span<const ChartKind> charts) {
  Converter converter(conversion, detail::printable(name, name.size()), sink, charts);
  detail::LineReader reader(source);
  while (const std::optional<std::string_view> line = reader.next()) converter.line(*line);
  converter.finish(reader.too_long());
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
