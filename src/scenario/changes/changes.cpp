// SPDX-License-Identifier: MIT
// Changes of single keys in the text of a scenario; everything else in it stays.
#include "polhode/scenario/changes.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/error.hpp"
#include "scenario/detail/toml.hpp"
#include "scenario/values.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

// A name or an index.
using KeyStep = std::variant<std::string, std::size_t>;
using KeyPath = std::vector<KeyStep>;

// Bytes from begin on, end not included.
struct TextSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
};

// From lines and code points, as toml++ counts, to bytes.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  std::size_t place(const toml::source_position& at) const;
  TextSpan span(const toml::source_region& region) const {
    return {place(region.begin), place(region.end)};
  }
  // The start of the line of a byte, and that of the next one.
  std::size_t line_start(std::size_t at) const;
  std::size_t next_line(std::size_t at) const;

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;
};

// A header [a.b] of a table.
struct TomlHeader {
  std::size_t begin;  // byte of its first bracket
  KeyPath path;
};
// Tables made by dots or by the header of one inside them begin where that does: the longest path
// of a place is that of its header.
void add_headers(const toml::node& node, const KeyPath& path, std::string_view text,
                 const TextLines& lines, std::vector<TomlHeader>& headers) {
  const auto add = [&](const toml::node& inner, KeyStep step) {
    if (!inner.is_table() && !inner.is_array()) return;
    KeyPath longer = path;
    longer.push_back(std::move(step));
    const std::size_t begin = lines.place(inner.source().begin);
    if (inner.is_table() && begin < text.size() && text[begin] == '[')
      headers.push_back({begin, longer});
    add_headers(inner, longer, text, lines, headers);
  };
  if (const toml::table* const table = node.as_table()) {
    for (const auto& [name, inner] : *table) add(inner, std::string(name.str()));
  } else if (const toml::array* const array = node.as_array(); array->is_array_of_tables()) {
    for (std::size_t i = 0; i < array->size(); ++i) add(*array->get(i), i);
  }
}

std::string printed(const toml::node& node) {
  std::ostringstream out;
  out << toml::node_view<const toml::node>(&node);
  return out.str();
}

TextLines::TextLines(std::string_view text) : text_(text), starts_{0} {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') starts_.push_back(i + 1);
}

std::size_t TextLines::place(const toml::source_position& at) const {
  const std::size_t line = std::clamp<std::size_t>(at.line, 1, starts_.size());
  std::size_t place = starts_[line - 1];
  const auto continues = [&](std::size_t i) {
    return i < text_.size() && (static_cast<unsigned char>(text_[i]) & 0xc0) == 0x80;
  };
  for (std::size_t column = 1; column < at.column && place < text_.size(); ++column) {
    ++place;
    while (continues(place)) ++place;
  }
  return place;
}

std::size_t TextLines::line_start(std::size_t at) const {
  return *std::prev(std::upper_bound(starts_.begin(), starts_.end(), at));
}

std::size_t TextLines::next_line(std::size_t at) const {
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), at);
  return next == starts_.end() ? text_.size() : *next;
}

// Null if there is none.
const toml::node* node_at(const toml::table& file, const KeyPath& path) {
  const toml::node* node = &file;
  for (const KeyStep& step : path) {
    if (const auto* const index = std::get_if<std::size_t>(&step)) {
      const toml::array* const array = node->as_array();
      node = array == nullptr ? nullptr : array->get(*index);
    } else {
      const toml::table* const table = node->as_table();
      node = table == nullptr ? nullptr : table->get(std::get<std::string>(step));
    }
    if (node == nullptr) return nullptr;
  }
  return node;
}

// In the order of the text.
std::vector<TomlHeader> toml_headers(const toml::table& file, std::string_view text,
                                     const TextLines& lines) {
  std::vector<TomlHeader> headers;
  add_headers(file, {}, text, lines, headers);
  std::stable_sort(headers.begin(), headers.end(), [](const auto& a, const auto& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.path.size() > b.path.size();
  });
  const auto same = [](const auto& a, const auto& b) { return a.begin == b.begin; };
  headers.erase(std::unique(headers.begin(), headers.end(), same), headers.end());
  return headers;
}

// Nothing if the text cannot be parsed.
std::optional<toml::table> parsed_toml(std::string_view text) {
  if (refusal(text)) return std::nullopt;
  try {
    return toml::parse(text);
  } catch (const toml::parse_error&) {
    return std::nullopt;
  } catch (const TomlAssertion&) {
    return std::nullopt;
  }
}

// Equal in type and value.
bool are_equal(const toml::node& a, const toml::node& b) {
  return a.type() == b.type() && printed(a) == printed(b);
}

}  // namespace
}  // namespace detail

namespace {

using detail::KeyPath;
using detail::KeyStep;
using detail::TextLines;
using detail::TextSpan;
using detail::TomlHeader;

constexpr std::size_t shown = 100;  // characters of a value

[[noreturn]] void refuse(std::string_view key, const std::string& why) {
  throw ChangeError(detail::printable(key, shown) + ": " + why);
}

// "event[0].value" or "event.0.value".
KeyPath path_of(std::string_view key) {
  KeyPath path;
  std::string part;
  const auto take = [&] {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (!path.empty() && error == std::errc() && end == part.data() + part.size())
      path.emplace_back(index);
    else if (detail::is_name(part))
      path.emplace_back(part);
    else
      refuse(key,
             "got no key; expected names with dots, such as state.tumbler.mode, and tables of "
             "an array by index, such as event.0.value");
    part.clear();
  };
  for (std::size_t i = 0; i < key.size(); ++i) {
    const char c = key[i];
    if (c != '.' && c != '[' && c != ']') {
      part += c;
      continue;
    }
    const bool behind_index = c == '.' && i > 0 && key[i - 1] == ']';
    const bool at_end = c == ']' && i + 1 == key.size();
    if (!behind_index && !at_end) take();
  }
  take();
  return path;
}

// As it stands in front of a value below a table.
std::string dotted(std::span<const KeyStep> steps) {
  std::string text;
  for (const KeyStep& step : steps) {
    const auto* const name = std::get_if<std::string>(&step);
    if (name == nullptr) return {};
    text += (text.empty() ? "" : ".") + *name;
  }
  return text;
}

bool begins_with(const KeyPath& path, const KeyPath& start) {
  return path.size() >= start.size() && std::equal(start.begin(), start.end(), path.begin());
}

// One change of a text: the candidates for its new text are tried until one holds what is wanted.
class Edit {
 public:
  Edit(std::string text, const ScenarioChange& change)
      : text_(std::move(text)), change_(change), path_(path_of(change.key)) {}

  std::string made() {
    if (!look()) return text_;
    const std::string value = change_.value.empty() ? std::string() : toml_value();
    if (value.empty()) {
      take_out();
      return text_;
    }
    if (const toml::node* const old = detail::node_at(*file_, path_); old != nullptr) {
      const TextSpan at = lines_->span(old->source());
      if (try_text(replaced(at, value))) return text_;
      take_out();
    }
    put_in(value);
    return text_;
  }

 private:
  // Parses the text; whether it is TOML.
  bool look() {
    file_ = detail::parsed_toml(text_);
    lines_.emplace(text_);
    return file_.has_value();
  }

  std::string replaced(const TextSpan& at, const std::string& by) const {
    return text_.substr(0, at.begin) + by + text_.substr(at.end);
  }

  // The value as TOML; a bare word in quotes.
  std::string toml_value() {
    if (want(change_.value)) return change_.value;
    std::string text = '"' + change_.value + '"';
    if (is_bare(change_.value) && want(text)) return text;
    refuse(change_.key, "got " + detail::printable(change_.value, shown) +
                            "; expected a value as TOML has it, such as 5, \"27.38 h\" or [1, 2]");
  }

  bool want(const std::string& value) {
    std::optional<toml::table> parsed = detail::parsed_toml("x = " + value);
    if (!parsed || parsed->size() != 1 || !parsed->contains("x")) return false;
    wanted_ = std::move(parsed);
    return true;
  }

  // LAM, 27.38 h, 1e-3 N m s: nothing that looks like the start of another value.
  static bool is_bare(const std::string& value) {
    return !value.empty() && std::string_view("[{\"'").find(value.front()) == std::string::npos &&
           value.find_first_of("\"\\\n\r") == std::string::npos;
  }

  bool try_text(std::string text) {
    std::optional<toml::table> parsed = detail::parsed_toml(text);
    if (!parsed) return false;
    const toml::node* const found = detail::node_at(*parsed, path_);
    if (wanted_ ? found == nullptr || !detail::are_equal(*found, *wanted_->get("x"))
                : found != nullptr)
      return false;
    text_ = std::move(text);
    return true;
  }

  // A key of a table in braces, with its comma.
  bool take_out_inline(const toml::table& table) {
    const auto key = table.find(std::get<std::string>(path_.back()));
    const TextSpan at{lines_->place(key->first.source().begin),
                      lines_->place(key->second.source().end)};
    const std::size_t next = text_.find_first_not_of(" \t", at.end);
    if (next < text_.size() && text_[next] == ',' && try_text(replaced({at.begin, next + 1}, "")))
      return true;
    const std::size_t before = text_.find_last_not_of(" \t", at.begin - 1);
    if (before < text_.size() && text_[before] == ',' && try_text(replaced({before, at.end}, "")))
      return true;
    return try_text(replaced(at, ""));
  }

  // Headers of tables below the path with all that follows them up to the next one.
  bool take_out_headers() {
    const std::vector<TomlHeader> headers = detail::toml_headers(*file_, text_, *lines_);
    std::string text;
    std::size_t from = 0;
    for (std::size_t i = 0; i < headers.size(); ++i) {
      if (!begins_with(headers[i].path, path_)) continue;
      const std::size_t begin = lines_->line_start(headers[i].begin);
      const std::size_t end =
          i + 1 < headers.size() ? lines_->line_start(headers[i + 1].begin) : text_.size();
      text += text_.substr(from, begin - from);
      from = end;
    }
    if (from == 0) return false;
    text_ = text + text_.substr(from);
    return look();
  }

  // The lines of one key with a value; of a table made by dots, those of its keys.
  bool take_out_lines(const toml::node& node) {
    if (const toml::table* const table = node.as_table(); table != nullptr && !table->is_inline()) {
      if (table->empty()) return false;
      return take_out_lines(table->begin()->second);
    }
    const TextSpan at = lines_->span(node.source());
    const std::size_t begin = lines_->line_start(at.begin);
    const std::size_t last = at.end > at.begin ? at.end - 1 : at.end;
    text_ = replaced({begin, lines_->next_line(last)}, "");
    return look();
  }

  void take_out() {
    const std::optional<toml::table> wanted = std::exchange(wanted_, std::nullopt);
    while (const toml::node* const node = detail::node_at(*file_, path_)) {
      const KeyPath above(path_.begin(), path_.end() - 1);
      const toml::table* const table = detail::node_at(*file_, above)->as_table();
      if (take_out_headers()) continue;
      if (!file_ || table == nullptr ||
          !(table->is_inline() ? take_out_inline(*table) && look() : take_out_lines(*node)))
        refuse(change_.key, "cannot be taken out of the file");
    }
    wanted_ = wanted;
  }

  // Where keys of the table at the head of the path may stand: behind its header, in its braces,
  // among the first lines of the file.
  std::vector<std::string> candidates(std::size_t depth, const std::string& value) const {
    const KeyPath above(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(depth));
    const std::string name = dotted(std::span(path_).subspan(depth));
    const toml::node* const node = detail::node_at(*file_, above);
    if (name.empty() || node == nullptr || !node->is_table()) return {};
    const std::string line = name + " = " + value;
    if (depth == 0) return {with_line(end_of_top(), line)};
    const TextSpan at = lines_->span(node->source());
    if (at.begin >= text_.size()) return {};
    if (text_[at.begin] == '{')
      return {replaced({at.begin + 1, at.begin + 1}, " " + line + ","),
              replaced({at.begin + 1, at.begin + 1}, " " + line + " ")};
    if (text_[at.begin] == '[') return {with_line(lines_->next_line(at.begin), line)};
    return {};
  }

  std::string with_line(std::size_t at, const std::string& line) const {
    const bool open = at > 0 && text_[at - 1] != '\n';
    return text_.substr(0, at) + (open ? "\n" : "") + line + "\n" + text_.substr(at);
  }

  // Behind the last value that stands before all headers.
  std::size_t end_of_top() const {
    const std::vector<TomlHeader> headers = detail::toml_headers(*file_, text_, *lines_);
    const std::size_t first = headers.empty() ? text_.size() : headers.front().begin;
    std::size_t end = 0;
    add_ends(*file_, first, end);
    return end;
  }
  void add_ends(const toml::table& table, std::size_t first, std::size_t& end) const {
    for (const auto& [name, node] : table) {
      const toml::table* const inner = node.as_table();
      const TextSpan at = lines_->span(node.source());
      if (inner != nullptr && !inner->is_inline())
        add_ends(*inner, first, end);
      else if (at.end > at.begin && at.begin < first)
        end = std::max(end, lines_->next_line(at.end - 1));
    }
  }

  void put_in(const std::string& value) {
    for (std::size_t depth = path_.size(); depth-- > 0;)
      for (std::string& text : candidates(depth, value))
        if (try_text(std::move(text))) return;
    const std::string table = dotted(std::span(path_).first(path_.size() - 1));
    const std::string name = dotted(std::span(path_).last(1));
    if (!table.empty() && !name.empty() &&
        try_text(with_line(text_.size(), "\n[" + table + "]\n" + name + " = " + value)))
      return;
    refuse_place();
  }

  // Says how far the path leads.
  [[noreturn]] void refuse_place() const {
    for (std::size_t depth = 0; depth < path_.size(); ++depth) {
      const KeyPath above(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(depth));
      const toml::node* const node = detail::node_at(*file_, above);
      const auto* const index = std::get_if<std::size_t>(&path_[depth]);
      if (node == nullptr || index == nullptr) continue;
      const toml::array* const array = node->as_array();
      if (array != nullptr && *index < array->size()) continue;
      const std::string count = array == nullptr ? "none" : std::to_string(array->size());
      refuse(change_.key, "got index " + std::to_string(*index) + " of " + count +
                              (count == "1" ? " element" : " elements") + ", counted from 0");
    }
    for (std::size_t depth = 1; depth < path_.size(); ++depth) {
      const KeyPath above(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(depth));
      if (std::holds_alternative<std::size_t>(path_[depth]) &&
          detail::node_at(*file_, above) == nullptr)
        refuse(change_.key, "the file has no " + dotted(above) +
                                "; expected a key that it has, or " +
                                "one that its tables may have");
    }
    refuse(change_.key, "has no place in the file");
  }

  std::string text_;
  const ScenarioChange& change_;
  KeyPath path_;
  std::optional<toml::table> file_;
  std::optional<TextLines> lines_;
  std::optional<toml::table> wanted_;  // with the value as x; none: the key is taken out
};

}  // namespace

ScenarioChange change_of(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw ChangeError("got \"" + detail::printable(text, shown) +
                      "\"; expected KEY=VALUE, such as state.tumbler.mode=LAM");
  const auto trimmed = [](std::string_view part) {
    const std::size_t begin = std::min(part.find_first_not_of(" \t"), part.size());
    part.remove_prefix(begin);
    return std::string(part.substr(0, part.find_last_not_of(" \t") + 1));
  };
  return {trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))};
}

std::string changed_text(std::string_view text, std::span<const ScenarioChange> changes) {
  std::string changed(text);
  for (const ScenarioChange& change : changes) changed = Edit(std::move(changed), change).made();
  return changed;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
