// SPDX-License-Identifier: MIT
// The words of an expression: numbers, names, and single characters.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

class Lexer {
 public:
  explicit Lexer(std::string_view text);

  // The word that comes next; empty at the end.
  std::string_view word() const { return word_; }
  bool is_number() const;
  bool is_name() const;
  void advance();
  // Whether the next word is this one, which is then taken.
  bool takes(std::string_view word);
  void expect(std::string_view word);
  // A sign and digits.
  int integer();
  [[noreturn]] void refuse(const std::string& expected) const;

 private:
  std::string_view text_, word_;
  std::size_t begin_ = 0;  // of the word
};

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
