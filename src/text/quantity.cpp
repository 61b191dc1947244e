// SPDX-License-Identifier: MIT
// A number with its unit, as files write it.
#include <charconv>
#include <cmath>

#include "polhode/error.hpp"
#include "polhode/text/units.hpp"

namespace polhode {
inline namespace v0 {

Quantity quantity_from_text(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  std::string_view number = text;
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error == std::errc::result_out_of_range) throw DomainError("a number beyond double range");
  if (error != std::errc() || !std::isfinite(value))
    throw DomainError("no number at the start of the text");
  std::string_view unit(end, static_cast<std::size_t>(number.data() + number.size() - end));
  while (!unit.empty() && blank(unit.front())) unit.remove_prefix(1);
  if (unit.empty()) throw DomainError("a number without its unit; a bare number needs no quotes");
  return {value, std::string(unit)};
}

}  // namespace v0
}  // namespace polhode
