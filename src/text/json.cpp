// SPDX-License-Identifier: MIT
#include "text/json.hpp"

#include <cmath>

#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

void append_quoted(std::string& out, std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  out += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      out += "\\u00";
      out += digits[byte >> 4];
      out += digits[byte & 15];
    } else {
      out += c;
    }
  }
  out += '"';
}

// Appended, not put together first: g++ 12 sees an overlap in "\n" + std::string at -O3.
void append_line_break(std::string& out, std::size_t levels) {
  out += '\n';
  out.append(2 * levels, ' ');
}

}  // namespace

void JsonWriter::separate() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (levels_.empty()) return;
  Level& level = levels_.back();
  if (!level.empty) text_ += level.array ? ", " : ",";
  level.empty = false;
  if (!level.array) append_line_break(text_, levels_.size());
}

JsonWriter& JsonWriter::begin_object() {
  separate();
  text_ += '{';
  levels_.push_back({false, true});
  return *this;
}

JsonWriter& JsonWriter::end_object() {
  const bool empty = levels_.back().empty;
  levels_.pop_back();
  if (!empty) append_line_break(text_, levels_.size());
  text_ += '}';
  return *this;
}

JsonWriter& JsonWriter::begin_array() {
  separate();
  text_ += '[';
  levels_.push_back({true, true});
  return *this;
}

JsonWriter& JsonWriter::end_array() {
  levels_.pop_back();
  text_ += ']';
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  separate();
  append_quoted(text_, name);
  text_ += ": ";
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
  separate();
  append_quoted(text_, text);
  return *this;
}

JsonWriter& JsonWriter::value(double number) {
  return raw(std::isfinite(number) ? polhode::detail::number_text(number) : "null");
}

JsonWriter& JsonWriter::raw(std::string_view json) {
  separate();
  text_ += json;
  return *this;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
