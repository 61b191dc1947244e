// SPDX-License-Identifier: MIT
#include "text/word_list.hpp"

#include <algorithm>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t longest_own_name = 60;

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

}  // namespace

std::string one_of(std::span<const std::string_view> words, std::string_view quote) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += quote;
    text += words[i];
    text += quote;
  }
  return text;
}

std::string sets_in_words(std::string_view sets) {
  std::string words;
  for (const char c : sets) {
    if (c == '|')
      words += ", ";
    else if (c == '+')
      words += " with ";
    else
      words += c;
  }
  return words;
}

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= longest_own_name &&
         std::all_of(text.begin(), text.end(), is_name_character);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
