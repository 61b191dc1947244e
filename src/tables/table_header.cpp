// SPDX-License-Identifier: MIT
// The lines above the rows of a table, and the first lines by which two-line elements are known.
#include "tables/table_header.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "tables/detail/gzip_file.hpp"
#include "tables/detail/line_reader.hpp"
#include "tables/detail/trimmed.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

using Note = TableHeader::Note;

constexpr std::array<std::string_view, 3> known_axes = {"inertial", "ecliptic-J2000",
                                                        "equator-J2000"};

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// What stands behind `lead`, in small or capital letters; nothing where the text does not begin so.
std::optional<std::string_view> behind(std::string_view text, std::string_view lead) {
  const bool begins =
      text.size() >= lead.size() && std::equal(lead.begin(), lead.end(), text.begin(),
                                               [](char a, char b) { return small(a) == small(b); });
  if (!begins) return std::nullopt;
  return trimmed(text.substr(lead.size()));
}

bool is_date(std::string_view text) {
  return text.starts_with("JD ") ||
         (!text.empty() && (text.front() == '-' || (text.front() >= '0' && text.front() <= '9')));
}

// "t [s], x [km], phi [deg]"
void read_units(TableHeader& header, std::string_view list, const std::string& at) {
  while (!list.empty()) {
    const std::size_t comma = list.find(", ");
    const std::string_view entry = trimmed(list.substr(0, comma));
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 2);
    const std::size_t open = entry.find(" [");
    if (open == std::string_view::npos || !entry.ends_with(']')) continue;
    const std::string_view unit = entry.substr(open + 2, entry.size() - open - 3);
    header.columns.insert_or_assign(std::string(entry.substr(0, open)),
                                    Note{std::string(unit), at});
  }
}

// One of the parts that "; " separates.
class Parts {
 public:
  Parts(TableHeader& header, std::string at) : header_(header), at_(std::move(at)) {}

  void read(std::string_view part) {
    if (const auto units = behind(part, "units: ")) return read_units(header_, *units, at_);
    if (const auto date = behind(part, "t counts from ")) return epoch(*date);
    if (const auto date = behind(part, "epoch: ")) return epoch(*date);
    if (const auto axes = behind(part, "axes: ")) {
      // One word is a name, known or not; more are a remark.
      if (axes->find(' ') == std::string_view::npos) header_.axes = note(*axes);
      return;
    }
    if (const auto rest = behind(part, "t in ")) return timed(*rest);
    if (!timed_) return;
    // of polhode.satellites: unit of lengths, then axes
    if (is_axes(part))
      header_.axes = note(part);
    else if (!header_.length)
      header_.length = note(part);
  }

 private:
  Note note(std::string_view text) const { return {std::string(text), at_}; }
  void epoch(std::string_view date) {
    if (is_date(date)) header_.epoch = note(date);
  }
  // "s after 2029-04-13T00:00:00.000 UTC"
  void timed(std::string_view text) {
    constexpr std::string_view after = " after ";
    const std::size_t word = text.find(after);
    if (word == std::string_view::npos || !is_date(text.substr(word + after.size()))) return;
    timed_ = true;
    header_.time = note(text.substr(0, word));
    epoch(text.substr(word + after.size()));
  }

  TableHeader& header_;
  std::string at_;
  bool timed_ = false;
};

void read_comment(TableHeader& header, std::string_view text, const std::string& at) {
  text = trimmed(text);
  if (text.starts_with('|')) return;  // the scenario of a run, word by word
  Parts parts(header, at);
  for (;;) {
    const std::size_t end = text.find("; ");
    parts.read(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 2);
  }
}

// "Output units    : KM-S", "Reference frame : Ecliptic of J2000.0"
void read_banner(TableHeader& header, std::string_view line, const std::string& at) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string_view key = trimmed(line.substr(0, colon)),
                         value = trimmed(line.substr(colon + 1));
  const auto note = [&](std::string_view text) { return Note{std::string(text), at}; };
  if (key == "Output units") {
    const bool au = value.starts_with("AU-"), km = value.starts_with("KM-");
    const bool per_day = value.substr(0, 4).ends_with("-D");
    if (!au && !km) return;
    header.length = note(au ? "au" : "km");
    header.speed = note(std::string(au ? "au" : "km") + (per_day ? "/d" : "/s"));
  } else if (key == "Reference frame" || key == "Coordinate systm") {
    const bool of_date = value.ends_with("of date") || value.ends_with("of-date");
    if (value.starts_with("Ecliptic") && !of_date)
      header.axes = note("ecliptic-J2000");
    else if (!header.axes)  // "Coordinate systm" may follow "Reference frame : ICRF"
      header.axes = note(value.starts_with("ICRF") ? "equator-J2000" : value);
  }
}

}  // namespace

bool is_axes(std::string_view text) {
  return std::find(known_axes.begin(), known_axes.end(), text) != known_axes.end();
}

TableHeader header_of(const NumberTable& table) {
  TableHeader header;
  for (const NumberTable::Comment& comment : table.comments) {
    const std::string at = table.file + ":" + std::to_string(comment.line) + ": ";
    if (comment.is_banner)
      read_banner(header, comment.text, at);
    else
      read_comment(header, comment.text, at);
  }
  return header;
}

std::optional<std::string_view> scale_of_column(std::string_view name) {
  struct Scale {
    std::string_view suffix;
    std::string_view scale;
  };
  constexpr Scale scales[] = {
      {"TDB", "TDB"}, {"TT", "TT"}, {"UTC", "UTC"}, {"UT", "UTC"}, {"TAI", "TAI"}};
  for (const Scale& known : scales)
    if (name == "JD" + std::string(known.suffix) || name == "MJD" + std::string(known.suffix) ||
        name.ends_with("(" + std::string(known.suffix) + ")"))
      return known.scale;
  return std::nullopt;
}

namespace {

// 69 characters, of which some may have been lost.
bool is_element_line(std::string_view line, char number) {
  return line.size() > 60 && line.size() < 75 && line[0] == number && line[1] == ' ' &&
         line.find(',') == std::string_view::npos;
}

}  // namespace

bool has_two_line_elements(const std::string& path) {
  constexpr int looked_at = 3;
  GzipFile file(path);
  const ByteSource source = [&file](std::span<char> bytes) { return file.read(bytes); };
  LineReader lines(source);
  bool first = false;
  for (int read = 0; read < looked_at;) {
    const std::optional<std::string_view> line = lines.next();
    if (!line) return false;
    if (line->empty() || line->starts_with('#')) continue;
    if (first) return is_element_line(*line, '2');
    first = is_element_line(*line, '1');
    ++read;
  }
  return false;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
