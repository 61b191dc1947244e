// SPDX-License-Identifier: MIT
#include "tables/detail/table_notes.hpp"

#include <charconv>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::string_view first_word(std::string_view text) { return text.substr(0, text.find(' ')); }

}  // namespace

// "# units: t [h], phi [deg], ...", "# serret: sign_g1 1, sign_g3 -1", "# sadov: region LAM, lobe
// -1".
bool TableNotes::read(std::string_view comment) {
  const std::size_t colon = comment.find(": ");
  const std::string_view subject = comment.substr(0, colon);
  const bool units = subject == "# units";
  if (!units && subject != "# serret" && subject != "# sadov") return false;
  std::string_view rest = comment.substr(colon + 2);
  while (!rest.empty()) {
    const std::size_t comma = rest.find(", ");
    const std::string_view entry = rest.substr(0, comma);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 2);
    const std::string_view name = first_word(entry);
    if (name.size() + 1 >= entry.size()) continue;
    const std::string_view value = entry.substr(name.size() + 1);
    double number = 0.0;
    if (units && value.size() > 2)
      units_.emplace(name, value.substr(1, value.size() - 2));
    else if (entry == "region SAM")
      constants_.emplace("lobe", 0.0);
    else if (std::from_chars(value.data(), value.data() + value.size(), number).ec == std::errc())
      constants_.emplace(name, number);
  }
  return true;
}

std::string_view TableNotes::unit(std::string_view column) const {
  const auto found = units_.find(column);
  return found == units_.end() ? std::string_view() : found->second;
}

std::optional<double> TableNotes::constant(std::string_view column) const {
  const auto found = constants_.find(column);
  if (found == constants_.end()) return std::nullopt;
  return found->second;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
