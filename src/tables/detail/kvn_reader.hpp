// SPDX-License-Identifier: MIT
// The lines of a CCSDS message in keyword = value notation.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {

struct KvnLine {
  enum class Kind { pair, word, data, comment };
  Kind kind;
  std::string_view key;    // of a pair; the word; "COMMENT"
  std::string_view value;  // of a pair or comment; all of a data line
};

class KvnReader {
 public:
  KvnReader(std::string_view text, std::string name);

  // The next line that is not blank; nothing at the end of the text.
  std::optional<KvnLine> next();
  // Throws DomainError "NAME:LINE: text".
  [[noreturn]] void fail(const std::string& text) const;
  // That of the line last read, from 1.
  std::size_t line_number() const { return line_; }
  // The value of a pair, not empty.
  std::string value_of(const KvnLine& line) const;
  // The blank-separated fields of a data line.
  std::vector<std::string_view> fields(const KvnLine& line) const;
  // A field as a finite number.
  double number(std::string_view field, std::string_view what) const;

 private:
  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
