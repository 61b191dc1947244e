// SPDX-License-Identifier: MIT
#include "polhode/scenario/schema.hpp"

#include <algorithm>

#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

std::string quantity(const Key& key, const Units& units) {
  if (key.dimension == Dimension::number) return "a number";
  const std::string unit = units.label(key.dimension);
  const std::string kind(dimension_name(key.dimension));
  if (unit == "1") return kind + ": a number";
  return kind + ": a number (of " + unit + "), \"1 " + unit + "\" or { value = 1, unit = \"" +
         unit + "\" }" + (key.takes_date ? ", or a date such as \"2013-02-04T12:00:00\"" : "") +
         (key.allowed.empty() ? "" : ", or " + detail::one_of(separated(key.allowed, '|'), "\""));
}

bool is_word_of(std::string_view word, std::string_view joined) {
  const std::vector<std::string_view> words = separated(joined, '|');
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string each(const Key& key, const Units& units) {
  return key.dimension == Dimension::number ? "" : ", each " + quantity(key, units);
}

}  // namespace

std::vector<const Key*> keys_of(const Schema& schema, std::string_view table) {
  std::vector<const Key*> result;
  for (const Key& key : schema.keys)
    if (key_table(key.path) == table) result.push_back(&key);
  return result;
}

bool belongs(const Key& key, std::string_view kind) {
  return key.kinds.empty() || is_word_of(kind, key.kinds);
}
bool belongs(const Alternatives& row, std::string_view kind) {
  return row.kinds.empty() || is_word_of(kind, row.kinds);
}
bool is_required(const Key& key, std::string_view kind) {
  if (key.presence == Presence::required) return belongs(key, kind);
  return is_word_of(kind, key.needed_by);
}

std::string expectation(const Key& key, const Units& units) {
  switch (key.type) {
    case KeyType::table:
      return key.path.ends_with("[]") ? "tables [[" + std::string(key_name(key.path)) + "]]"
                                      : "a table";
    case KeyType::integer:
      return key.allowed.empty() ? "a whole number" : detail::one_of(separated(key.allowed, '|'));
    case KeyType::number:
      return quantity(key, units) +
             (key.path.starts_with("ensemble.vary[]") ? " in the unit of the key that varies" : "");
    case KeyType::numbers: {
      const std::string many = key.length > 0 ? std::to_string(key.length) : "one or more";
      return "an array of " + many + " numbers" + each(key, units);
    }
    case KeyType::matrix:
      return "an array of 3 arrays of 3 numbers" + each(key, units);
    case KeyType::linear_map:
      return "an array of 3 numbers (a diagonal) or of 3 arrays of 3 numbers" + each(key, units);
    case KeyType::square:
      return "a square matrix, [[a, b], [b, c]]: an array of as many rows as each row has numbers" +
             each(key, units);
    case KeyType::boolean:
      return "true or false";
    case KeyType::text:
      return "text in quotes";
    case KeyType::name:
      return "a name of letters, digits, - and _ in quotes";
    case KeyType::unit:
      return std::string("a unit in quotes") + (key.example.empty() ? "" : " such as ") +
             std::string(key.example);
    case KeyType::choice:
      return detail::one_of(separated(key.allowed, '|'), "\"");
    case KeyType::choices:
      return "an array of different words out of " +
             detail::one_of(separated(key.allowed, '|'), "\"");
    case KeyType::columns:
      return "an array of names of columns of the file, or of their numbers from 1";
    case KeyType::units:
      return "an array of units, one for each column";
    case KeyType::key_list:
      return "an array of keys of this file";
    case KeyType::epoch:
      return "a date with its scale (UTC, TAI, TT, TDB or UT1) such as "
             "\"2013-01-05T00:00:00 UTC\" or \"JD 2456297.5 TDB\"";
  }
  return {};
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
