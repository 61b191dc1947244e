// SPDX-License-Identifier: MIT
#include "polhode/series/detail/lexer.hpp"

#include <charconv>

#include "polhode/error.hpp"
#include "polhode/series/detail/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

std::size_t digits(std::string_view text, std::size_t i) {
  while (i < text.size() && is_digit(text[i])) ++i;
  return i;
}

// Digits, perhaps a point and a power of ten. An e without digits after it is a name.
std::size_t end_of_number(std::string_view text, std::size_t i) {
  i = digits(text, i);
  if (i < text.size() && text[i] == '.') i = digits(text, i + 1);
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    const bool is_signed = i + 1 < text.size() && (text[i + 1] == '+' || text[i + 1] == '-');
    const std::size_t power = i + (is_signed ? 2 : 1);
    if (digits(text, power) > power) i = digits(text, power);
  }
  return i;
}

std::size_t end_of_word(std::string_view text, std::size_t i) {
  if (i == text.size()) return i;
  if (is_digit(text[i]) || (text[i] == '.' && digits(text, i + 1) > i + 1))
    return end_of_number(text, i);
  if (!is_letter(text[i])) return i + 1;
  while (i < text.size() && is_name_character(text[i])) ++i;
  return i;
}

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

Lexer::Lexer(std::string_view text) : text_(text) { advance(); }

bool Lexer::is_number() const {
  return !word_.empty() && (is_digit(word_[0]) || word_.size() > 1) && !is_letter(word_[0]);
}
bool Lexer::is_name() const { return !word_.empty() && is_letter(word_[0]); }

void Lexer::advance() {
  begin_ += word_.size();
  while (begin_ < text_.size() && is_space(text_[begin_])) ++begin_;
  word_ = text_.substr(begin_, end_of_word(text_, begin_) - begin_);
}

bool Lexer::takes(std::string_view word) {
  if (word_ != word) return false;
  advance();
  return true;
}

void Lexer::expect(std::string_view word) {
  if (!takes(word)) refuse(quoted(word));
}

int Lexer::integer() {
  const bool negative = takes("-");
  int n = 0;
  const auto [end, error] = std::from_chars(word_.data(), word_.data() + word_.size(), n);
  if (error != std::errc{} || end != word_.data() + word_.size()) refuse("an integer");
  advance();
  return negative ? -n : n;
}

void Lexer::refuse(const std::string& expected) const {
  throw DomainError("series: column " + std::to_string(begin_ + 1) + ": " +
                    (word_.empty() ? "the end" : quoted(word_)) + "; expected " + expected);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
