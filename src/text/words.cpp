// SPDX-License-Identifier: MIT
// Words: split at separators, made printable, listed, and found by the nearest spelling.
#include "text/words.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

#include "polhode/text/separated.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

std::vector<std::string_view> separated(std::string_view joined, char separator) {
  std::vector<std::string_view> parts;
  if (joined.empty()) return parts;
  for (;;) {
    const std::size_t end = joined.find(separator);
    parts.push_back(joined.substr(0, end));
    if (end == std::string_view::npos) return parts;
    joined.remove_prefix(end + 1);
  }
}

namespace detail {

std::string printable(std::string_view text, std::size_t longest) {
  constexpr char digits[] = "0123456789abcdef";
  std::string result;
  for (const char c : text) {
    if (result.size() >= longest) return result + "...";
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      result += c;
    } else {
      result += "\\x";
      result += digits[byte >> 4];
      result += digits[byte & 15];
    }
  }
  return result;
}

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

namespace {

constexpr std::size_t longest_word = 64;  // longer words are noise, not slips

int lower(char c) { return std::tolower(static_cast<unsigned char>(c)); }

int replacement_cost(char a, char b) {
  if (a == b) return 0;
  return lower(a) == lower(b) ? 1 : 2;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = 2 * static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = 2 * static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min(
          {last[j] + 2, row[j - 1] + 2, last[j - 1] + replacement_cost(a[i - 1], b[j - 1])});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 2);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> known) {
  if (word.empty() || word.size() > longest_word) return {};
  constexpr std::size_t telling = 4;  // "equator" for "equator-J2000"
  if (word.size() >= telling)
    for (const std::string_view candidate : known)
      if (candidate.starts_with(word)) return candidate;
  std::string_view best;
  int best_distance = std::max(3, 2 * (static_cast<int>(word.size()) + 2) / 3);
  for (const std::string_view candidate : known) {
    const int distance = edit_distance(word, candidate);
    const int whole = 2 * static_cast<int>(std::min(word.size(), candidate.size()));
    if (distance >= whole || distance >= best_distance) continue;  // nothing in common, or worse
    best = candidate;
    best_distance = distance;
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view near = nearest(word, known);
  return near.empty() ? "" : "; did you mean " + std::string(near) + "?";
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
