// SPDX-License-Identifier: MIT
#include "scenario/fit/time_words.hpp"

#include <charconv>
#include <cmath>

#include "polhode/error.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/values.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t longest_word = 100;

}  // namespace

double time_of_word(const Scenario& scenario, const std::string& word) {
  double number = 0.0;
  const char* const end = word.data() + word.size();
  const auto [after, error] = std::from_chars(word.data(), end, number);
  std::string why;
  if (error == std::errc() && after == end) {
    if (std::isfinite(number)) return scenario.units().to_core(number, Dimension::time);
  } else if (!word.empty()) {
    try {
      return time_of_date(file_values(scenario.document), word);
    } catch (const DomainError& no_date) {
      why = std::string(": ") + no_date.what();
    }
  }
  throw DomainError("got \"" + printable(word, longest_word) +
                    "\"; expected a time in the unit of the file, or a date" + why);
}

std::string date_of_time(const Scenario& scenario, double t) {
  const std::string text = time_and_date(file_values(scenario.document), t);
  const std::size_t comma = text.find(", ");
  return comma == std::string::npos ? "" : text.substr(comma + 2);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
