// SPDX-License-Identifier: MIT
#include "text/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
