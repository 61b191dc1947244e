// SPDX-License-Identifier: MIT
#include "scenario/changes/toml_places.hpp"

#include <algorithm>
#include <sstream>

#include "scenario/value_reader.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

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

}  // namespace

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

bool are_equal(const toml::node& a, const toml::node& b) {
  return a.type() == b.type() && printed(a) == printed(b);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
