// SPDX-License-Identifier: MIT
#include "polhode/scenario/detail/key_form.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// "gravitational parameter"; "number" of one without a dimension.
std::string quantity_name(Dimension dimension) {
  if (dimension == Dimension::number) return "number";
  std::string name(dimension_name(dimension));
  return name.erase(0, name.find(' ') + 1);
}

}  // namespace

LinearMap KeyForm<LinearMap>::read(const KeyValues& at, std::string_view key) {
  const std::vector<double>& n = at.numbers(key);
  if (n.size() == 3) return {Mat3{{{n[0], 0.0, 0.0}, {0.0, n[1], 0.0}, {0.0, 0.0, n[2]}}}, true};
  return {
      Mat3{{{n.at(0), n.at(1), n.at(2)}, {n.at(3), n.at(4), n.at(5)}, {n.at(6), n.at(7), n.at(8)}}},
      false};
}

void require_range(const KeyValues& at, std::string_view key, Range range) {
  if (range == Range::any || !at.has(key)) return;
  const Dimension dimension = value_at(at.values(), at.key_path(key)).key->dimension;
  for (const double x : at.numbers(key)) {
    if (range == Range::positive && !(x > 0.0))
      at.refuse(key, "expected a positive " + quantity_name(dimension));
    if (range == Range::not_negative && !(x >= 0.0))
      at.refuse(key, "expected " +
                         std::string(dimension == Dimension::number ? "a number"
                                                                    : dimension_name(dimension)) +
                         " that is not negative");
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
