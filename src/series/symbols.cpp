// SPDX-License-Identifier: MIT
#include "polhode/series/symbols.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/series/detail/words.hpp"

namespace polhode {
inline namespace v0 {

namespace {

using Names = std::vector<std::string>;

std::string listed(const char* what, const Names& names) {
  std::string text = names.empty() ? std::string("no ") + what : what;
  for (const std::string& name : names) text += (&name == names.data() ? " " : ", ") + name;
  return text;
}

int place(const Names& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool is_name(const std::string& name) {
  return !name.empty() && name != "cos" && name != "sin" && detail::is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), detail::is_name_character);
}

void require_names(const char* what, const Names& names, std::set<std::string>& seen) {
  if (names.size() > PackedFields::most)
    throw DomainError("Symbols: " + std::to_string(names.size()) + " " + what + ", at most " +
                      std::to_string(PackedFields::most));
  for (const std::string& name : names) {
    if (!is_name(name))
      throw DomainError("Symbols: " + detail::quoted(name) +
                        " is no name: a letter, then letters, digits, _ or '; not cos or sin");
    if (!seen.insert(name).second)
      throw DomainError("Symbols: " + name + " is there twice; every name needs to be its own");
  }
}

}  // namespace

Symbols::Symbols(Names variables, Names angles, std::vector<ConjugatePair> pairs) {
  std::set<std::string> seen;
  require_names("variables", variables, seen);
  require_names("angles", angles, seen);
  std::set<std::string> paired;
  for (const ConjugatePair& pair : pairs) {
    if (place(variables, pair.momentum) < 0)
      throw DomainError("Symbols: the momentum " + detail::quoted(pair.momentum) +
                        " of a pair is no variable; there are " + listed("variables", variables));
    if (!seen.contains(pair.coordinate))
      throw DomainError("Symbols: the coordinate " + detail::quoted(pair.coordinate) +
                        " of a pair is neither a variable nor an angle");
    for (const std::string& name : {pair.coordinate, pair.momentum})
      if (!paired.insert(name).second)
        throw DomainError("Symbols: " + name + " is in two pairs, or twice in one");
  }
  const PackedFields exponents(static_cast<int>(variables.size()));
  const PackedFields multipliers(static_cast<int>(angles.size()));
  table_ = std::make_shared<const Table>(
      Table{std::move(variables), std::move(angles), std::move(pairs), exponents, multipliers});
}

bool Symbols::has_variable(std::string_view name) const { return place(variables(), name) >= 0; }
bool Symbols::has_angle(std::string_view name) const { return place(angles(), name) >= 0; }

int Symbols::variable(std::string_view name) const {
  const int i = place(variables(), name);
  if (i < 0)
    throw DomainError("Symbols: no variable " + detail::quoted(name) + "; there are " + names());
  return i;
}

int Symbols::angle(std::string_view name) const {
  const int i = place(angles(), name);
  if (i < 0)
    throw DomainError("Symbols: no angle " + detail::quoted(name) + "; there are " + names());
  return i;
}

std::string Symbols::names() const {
  return listed("variables", variables()) + "; " + listed("angles", angles());
}

}  // namespace v0
}  // namespace polhode
