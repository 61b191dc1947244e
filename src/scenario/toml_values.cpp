// SPDX-License-Identifier: MIT
// A TOML document against the table of keys. Other sources that know toml++: changes/.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/scenario/document.hpp"
#include "polhode/text/units.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/misplaced_keys.hpp"
#include "scenario/detail/other_names.hpp"
#include "scenario/detail/toml_nodes.hpp"
#include "scenario/values.hpp"
#include "text/dates.hpp"
#include "text/value_access.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::size_t longest_description = 200;
constexpr double largest_angle = 1e10;  // a double of this size has lost six of its digits

class Reader {
 public:
  Reader(const Schema& schema, Diagnostics& diagnostics)
      : schema_(schema), diagnostics_(diagnostics) {}

  ReadFile read(const toml::table& file);
  Value read_alone(const Key& key, const toml::node& node);

 private:
  std::string expected(const Key& key) const {
    const bool is_table = key.type == KeyType::table && !key.path.ends_with("[]");
    return is_table ? table_in_words(schema_, key) : expectation(key, units_);
  }
  void read_units(const toml::table& file);
  void read_table(const toml::table& table, std::string_view pattern, const std::string& path);
  void read_named(const toml::table& table, const Key& key, const std::string& path);
  std::string_view kind_of(const std::string& path) const;
  bool is_foreign(const Key& key, const toml::table& table, const std::string& path);
  Unknown unknown_keys(const toml::table& table, std::string_view pattern,
                       const std::vector<const Key*>& known, const std::string& path);
  void check_alternatives(const toml::table& table, std::string_view pattern,
                          const std::string& path, bool misspelt);
  void read_key(const Key& key, const toml::node& node, const std::string& path, Position where,
                bool given);
  void read_tables(const Key& key, const toml::array& array, const std::string& path);
  void read_fallback(const Key& key, const std::string& path, Position where);
  bool read_leaf(const Key& key, const toml::node& node, Value& value);
  bool read_text(const Key& key, const toml::node& node, Value& value);
  bool read_words(const Key& key, const toml::node& node, Value& value);
  bool read_word(const Key& key, const toml::node& node, Value& value);
  bool read_columns(const toml::node& node, Value& value);
  bool read_numbers(const Key& key, const toml::node& node, std::size_t length, Value& value,
                    std::optional<std::string_view> unit = std::nullopt);
  bool read_matrix(const Key& key, const toml::node& node, Value& value);
  bool read_map(const Key& key, const toml::node& node, Value& value);
  std::optional<double> number(const Key& key, const toml::node& node);
  std::optional<double> with_unit(const Key& key, const toml::node& node,
                                  std::optional<double> value, std::string_view unit);
  std::optional<double> in_range(const Key& key, const toml::node& node, double core);
  bool wrong(const toml::node& node, const std::string& reason = {});

  const Schema& schema_;
  Diagnostics& diagnostics_;
  Values values_;
  Units units_;
  std::vector<std::string_view> top_;  // the tables that this kind of file may have
  // What read_leaf is reading: messages name it.
  const Key* key_ = nullptr;
  std::string path_;
  const toml::node* with_unit_ = nullptr;  // a table of a value and its unit, to quote as a whole
  std::string own_unit_;                   // of the number read last
};

// One message: got VALUE; expected ...; reason.
bool Reader::wrong(const toml::node& node, const std::string& reason) {
  diagnostics_.add(position(node.source()), path_,
                   "got " + shown(node) + "; expected " + expected(*key_) +
                       (reason.empty() ? "" : "; " + reason));
  return false;
}

std::optional<double> Reader::in_range(const Key& key, const toml::node& node, double core) {
  if (std::isfinite(core) &&
      (key.dimension != Dimension::angle || std::fabs(core) <= largest_angle))
    return core;
  wrong(node, std::isfinite(core) ? "angles go up to 1e10 rad" : "numbers must be finite");
  return std::nullopt;
}

std::optional<double> Reader::with_unit(const Key& key, const toml::node& node,
                                        std::optional<double> value, std::string_view unit) {
  if (key.dimension == Dimension::number || !value) {
    wrong(node);
    return std::nullopt;
  }
  if (!std::isfinite(*value)) return in_range(key, node, *value);
  own_unit_ = unit;
  try {
    return in_range(key, node, units_.to_core(*value, unit, key.dimension));
  } catch (const DomainError& error) {
    wrong(with_unit_ != nullptr ? *with_unit_ : node, error.what());
    return std::nullopt;
  }
}

std::optional<double> Reader::number(const Key& key, const toml::node& node) {
  own_unit_.clear();
  if (is_listed(node.value_or(std::string()), key.allowed)) return 0.0;  // "auto"
  if (const std::optional<double> value = real(&node))
    return in_range(key, node, units_.to_core(*value, key.dimension));
  if (const toml::table* table = node.as_table())
    return with_unit(key, node, own_unit(*table) ? real(table->get("value")) : std::nullopt,
                     own_unit(*table).value_or(""));
  const std::optional<std::string> date = key.takes_date ? date_text(node) : std::nullopt;
  if (!date && (!node.is_string() || key.dimension == Dimension::number)) {
    wrong(node);
    return std::nullopt;
  }
  try {
    if (date)
      return in_range(key, node, time_of_date({values_, units_, diagnostics_.name()}, *date));
    const Quantity quantity = quantity_from_text(*node.value<std::string_view>());
    return with_unit(key, node, quantity.value, quantity.unit);
  } catch (const DomainError& error) {
    wrong(node, error.what());
    return std::nullopt;
  }
}

bool Reader::read_numbers(const Key& key, const toml::node& node, std::size_t length, Value& value,
                          std::optional<std::string_view> unit) {
  const toml::array* array = items(node);
  if (!array || array->empty() || (length > 0 && array->size() != length)) return wrong(node);
  if (node.is_table()) unit = own_unit(*node.as_table());
  for (const toml::node& item : *array) {
    const auto found = unit ? with_unit(key, item, real(&item), *unit) : number(key, item);
    if (!found) return false;
    value.numbers.push_back(*found);
    value.units.push_back(own_unit_);
  }
  return true;
}

bool Reader::read_matrix(const Key& key, const toml::node& node, Value& value) {
  const toml::array* rows = items(node);
  const std::size_t size = rows != nullptr && key.type == KeyType::square ? rows->size() : 3;
  if (rows == nullptr || rows->empty() || rows->size() != size) return wrong(node);
  const auto unit = node.is_table() ? own_unit(*node.as_table()) : std::nullopt;
  for (const toml::node& row : *rows)
    if (!row.is_array() || !read_numbers(key, row, size, value, unit))
      return row.is_array() ? false : wrong(node);
  return true;
}

bool Reader::read_map(const Key& key, const toml::node& node, Value& value) {
  const toml::array* array = items(node);
  const bool rows = array != nullptr && array->get_as<toml::array>(0) != nullptr;
  return rows ? read_matrix(key, node, value) : read_numbers(key, node, 3, value);
}

bool Reader::read_word(const Key& key, const toml::node& node, Value& value) {
  const std::vector<std::string_view> allowed = separated(key.allowed, '|');
  const auto word = node.value<std::string_view>();
  if (!node.is_string() || !word) return wrong(node);
  if (std::find(allowed.begin(), allowed.end(), *word) == allowed.end())
    return wrong(node, meaning_of(*word, allowed));
  if (std::find(value.words.begin(), value.words.end(), *word) != value.words.end())
    return wrong(node, "it is there twice");
  value.words.emplace_back(*word);
  return true;
}

bool Reader::read_words(const Key& key, const toml::node& node, Value& value) {
  const toml::array* const array = nonempty(node);
  if (array == nullptr) return wrong(node);
  return std::all_of(array->begin(), array->end(),
                     [&](const toml::node& item) { return read_word(key, item, value); });
}

bool Reader::read_columns(const toml::node& node, Value& value) {
  const toml::array* const array = nonempty(node);
  if (array == nullptr) return wrong(node);
  for (const toml::node& item : *array) {
    const bool is_number = item.is_integer() && key_->type != KeyType::key_list;
    const std::int64_t number = is_number ? *item.value<std::int64_t>() : 0;
    const std::string word = number > 0 ? std::to_string(number) : item.value_or(std::string());
    if (word.empty()) return wrong(node);
    value.words.push_back(word);
  }
  return true;
}

bool Reader::read_leaf(const Key& key, const toml::node& node, Value& value) {
  switch (key.type) {
    case KeyType::table:
      return false;
    case KeyType::integer: {
      if (!node.is_integer()) return wrong(node);
      value.whole = *node.value<std::int64_t>();
      return key.allowed.empty() || is_listed(std::to_string(value.whole), key.allowed) ||
             wrong(node);
    }
    case KeyType::number: {
      const std::optional<double> found = number(key, node);
      if (found) value.numbers = {*found};
      const std::string word = node.value_or(std::string());
      if (is_listed(word, key.allowed)) value.words = {word};
      value.units = {own_unit_};
      return found.has_value();
    }
    case KeyType::numbers:
      return read_numbers(key, node, static_cast<std::size_t>(key.length), value);
    case KeyType::matrix:
    case KeyType::square:
      return read_matrix(key, node, value);
    case KeyType::linear_map:
      return read_map(key, node, value);
    case KeyType::boolean:
      if (!node.is_boolean()) return wrong(node);
      value.whole = *node.value<bool>() ? 1 : 0;
      return true;
    case KeyType::choice:
      return read_word(key, node, value);
    case KeyType::choices:
      return read_words(key, node, value);
    case KeyType::columns:
    case KeyType::units:
    case KeyType::key_list:
      return read_columns(node, value);
    default:
      return read_text(key, node, value);
  }
}

bool Reader::read_text(const Key& key, const toml::node& node, Value& value) {
  const std::optional<std::string> text = text_in(node, key.type == KeyType::epoch);
  if (!text) return wrong(node);
  value.words.push_back(*text);
  if (key.type == KeyType::name && !is_name(value.words[0])) return wrong(node);
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (std::any_of(value.words[0].begin(), value.words[0].end(), control))
    return wrong(node, "it must be one line without control characters");
  try {
    if (key.type == KeyType::epoch) epoch_date(value.words[0]);
  } catch (const DomainError& error) {
    return wrong(node, error.what());
  }
  return true;
}

void Reader::read_tables(const Key& key, const toml::array& array, const std::string& path) {
  std::size_t i = 0;
  for (const toml::node& item : array) {
    const std::string one = path + "[" + std::to_string(i++) + "]";
    Value& value = values_[one];
    value.key = &key;
    value.where = position(item.source());
    read_table(*item.as_table(), key.path, one);
  }
}

void Reader::read_key(const Key& key, const toml::node& node, const std::string& path,
                      Position where, bool given) {
  key_ = &key;
  path_ = path;
  with_unit_ = node.is_table() && own_unit(*node.as_table()) ? &node : nullptr;
  Value value;
  value.key = &key;
  value.where = where;
  value.is_explicit = given;
  value.shown = shown(node);
  if (key.type != KeyType::table) {
    if (read_leaf(key, node, value)) values_.insert_or_assign(path, std::move(value));
    return;
  }
  const bool array = key.path.ends_with("[]");
  const bool fits = array ? node.is_array_of_tables() : node.is_table();
  if (!fits) {
    wrong(node, !array && node.is_array_of_tables() ? "it stands in one pair of brackets" : "");
    return;
  }
  values_.insert_or_assign(path, std::move(value));
  if (array)
    read_tables(key, *node.as_array(), path);
  else
    read_table(*node.as_table(), key.path, path);
}

void Reader::read_fallback(const Key& key, const std::string& path, Position where) {
  const toml::table parsed = toml::parse("x = " + std::string(key.fallback));
  read_key(key, *parsed.get("x"), path, where, false);
}

// Reports keys that the table does not know.
Unknown Reader::unknown_keys(const toml::table& table, std::string_view pattern,
                             const std::vector<const Key*>& known, const std::string& path) {
  Unknown unknown;
  const KnownTable own = known_table(pattern, kind_in(table, known), known);
  if (pattern.empty()) top_ = own.keys;
  if (own.knows("*")) return unknown;
  std::vector<StrayKey> strays;
  for (const auto& [name, node] : table) {
    if (own.knows(name.str())) continue;
    if (strays.size() > most_diagnostics) break;
    const bool section = node.is_table() && !node.as_table()->is_inline();
    strays.push_back(stray_key(schema_, top_, own, {name.str(), position(name.source()), section}));
    unknown.meant.push_back(leads_to(own, strays.back()));
  }
  unknown.any = !strays.empty();
  report(std::move(strays), own, path, diagnostics_);
  return unknown;
}

// `misspelt`: some key of the table is unknown, so a missing one may be that.
void Reader::check_alternatives(const toml::table& table, std::string_view pattern,
                                const std::string& path, bool misspelt) {
  for (const Alternatives& row : schema_.alternatives) {
    if (row.table != pattern || misspelt || !belongs(row, kind_of(path))) continue;
    const std::vector<std::string_view> present = present_keys(table, row.sets);
    const auto matches = [&](std::string_view set) {
      const std::vector<std::string_view> names = separated(set, '+');
      return names.size() == present.size() &&
             std::all_of(names.begin(), names.end(),
                         [&](std::string_view name) { return table.contains(name); });
    };
    const std::vector<std::string_view> sets = separated(row.sets, '|');
    if (std::any_of(sets.begin(), sets.end(), matches)) continue;
    std::string got;
    for (const std::string_view name : present)
      got += (got.empty() ? "" : ", ") + std::string(name);
    const toml::node& where = present.empty() ? table : *table.get(present.back());
    diagnostics_.add(position(where.source()), path,
                     "got " + (got.empty() ? "none of them" : got) + "; expected exactly one of " +
                         sets_in_words(row.sets));
  }
}

// Tables whose names the file chooses.
void Reader::read_named(const toml::table& table, const Key& key, const std::string& path) {
  for (const auto& [own, node] : table) {
    if (diagnostics_.full()) return;
    if (is_name(own.str()))
      read_key(key, node, joined(path, own.str()), position(own.source()), true);
    else
      diagnostics_.add(position(own.source()), joined(path, printable(own.str())),
                       "a name; expected up to 60 letters, digits, - and _");
  }
}

// The word of a table's own key `kind`, when it is a good one.
std::string_view Reader::kind_of(const std::string& path) const {
  const auto found = values_.find(joined(path, "kind"));
  return found == values_.end() || found->second.words.empty()
             ? std::string_view()
             : std::string_view(found->second.words[0]);
}

// Keys of another kind are refused, and not missed.
bool Reader::is_foreign(const Key& key, const toml::table& table, const std::string& path) {
  if (key.kinds.empty()) return false;
  const std::string_view kind = kind_of(path);
  if (belongs(key, kind)) return false;
  const std::string_view name = key_name(key.path);
  if (kind.empty() || !table.contains(name)) return true;
  std::vector<std::string_view> own, kinds;
  const Key* first = nullptr;  // of the rows of several kinds: one of them reports
  for (const Key* other : keys_of(schema_, key_table(key.path))) {
    if (belongs(*other, kind)) own.push_back(key_name(other->path));
    if (other->path != key.path) continue;
    if (first == nullptr) first = other;
    for (const std::string_view one : separated(other->kinds, '|')) kinds.push_back(one);
  }
  if (first != &key || std::find(own.begin(), own.end(), name) != own.end()) return true;
  diagnostics_.add(position(table.find(name)->first.source()), joined(path, name),
                   "a key of kind " + one_of(kinds, "\"") + "; expected with kind = \"" +
                       std::string(kind) + "\" only " + one_of(own));
  return true;
}

void Reader::read_table(const toml::table& table, std::string_view pattern,
                        const std::string& path) {
  const std::vector<const Key*> known = keys_of(schema_, pattern);
  const Unknown unknown = unknown_keys(table, pattern, known, path);
  const std::vector<std::string_view>& meant = unknown.meant;
  for (const Key* key : known) {
    if (diagnostics_.full()) return;
    const std::string_view name = key_name(key->path);
    if (name == "*") {
      read_named(table, *key, path);
      continue;
    }
    const std::string at = joined(path, name);
    if (values_.contains(at)) continue;  // [units], read first
    if (is_foreign(*key, table, path)) continue;
    if (const toml::node* node = table.get(name)) {
      read_key(*key, *node, at, position(node->source()), true);
    } else if (!key->fallback.empty()) {
      read_fallback(*key, at, position(table.source()));
    } else if (is_required(*key, kind_of(path)) &&
               std::find(meant.begin(), meant.end(), name) == meant.end()) {
      diagnostics_.add(position(table.source()), at, "got nothing; expected " + expected(*key));
    }
  }
  check_alternatives(table, pattern, path, unknown.any);
}

// Units come first: every number needs them. Each is tried alone: an error points at its own line.
void Reader::read_units(const toml::table& file) {
  if (const toml::node* node = file.get("units"); node != nullptr && !node->is_table()) return;
  const toml::table none;
  const toml::table* table = file["units"].as_table();
  std::string unit[] = {"s", "rad", "1", "1"};
  const std::string_view names[] = {"time", "angle", "moment", "length"};
  for (std::size_t i = 0; i < 4; ++i) {
    const toml::node* node = (table != nullptr ? *table : none).get(names[i]);
    if (node == nullptr || !node->is_string()) continue;
    std::string trial[] = {unit[0], unit[1], unit[2], unit[3]};
    trial[i] = *node->value<std::string>();
    try {
      const Units units(trial[0], trial[1], trial[2], trial[3]);
      unit[i] = trial[i];
    } catch (const DomainError& error) {
      diagnostics_.add(position(node->source()), "units." + std::string(names[i]),
                       "got " + shown(*node) + "; expected a unit; " + error.what());
    }
  }
  units_ = Units(unit[0], unit[1], unit[2], unit[3]);
}

// In units that every dimension has.
Value Reader::read_alone(const Key& key, const toml::node& node) {
  units_ = Units("s", "rad", "kg m2", "m");
  const std::string path(key.path);
  read_key(key, node, path, {}, true);
  diagnostics_.raise();
  require_range(values_, path, diagnostics_.name());
  return value_at(values_, path);
}

ReadFile Reader::read(const toml::table& file) {
  if (!keys_of(schema_, "units").empty()) read_units(file);
  read_table(file, "", "");
  return {.values = std::move(values_), .units = std::move(units_)};
}

}  // namespace

ReadFile read_values(std::string_view text, const Schema& schema, Diagnostics& diagnostics) {
  if (const std::optional<Refusal> refused = refusal(text)) {
    diagnostics.add(refused->where, "file", refused->text);
    return {.values = {}, .units = Units()};
  }
  try {
    const toml::table file = toml::parse(text);
    if (file.empty()) {
      diagnostics.add({}, "file",
                      "got no key at all; expected a scenario (polhode init prints one)");
      return {.values = {}, .units = Units()};
    }
    return Reader(schema, diagnostics).read(file);
  } catch (const toml::parse_error& error) {
    diagnostics.add(position(error.source()), "file",
                    "not TOML: " + printable(error.description(), longest_description) +
                        hint_for(error.description()));
  } catch (const TomlAssertion&) {
    diagnostics.add({}, "file", "not TOML");
  }
  return {.values = {}, .units = Units()};
}

Value value_of(const Key& key, std::string_view toml) {
  const toml::table parsed = toml::parse("x = " + std::string(toml));
  if (parsed.size() != 1) throw ScenarioError("more than one value");
  Diagnostics diagnostics("");
  return Reader({}, diagnostics).read_alone(key, *parsed.get("x"));
}

std::optional<std::string> why_not(const Key& key, std::string_view toml) {
  if (refusal(toml)) return "not TOML";
  try {
    value_of(key, toml);
  } catch (const ScenarioError& error) {
    const std::string_view text = error.what();
    const std::size_t got = text.find("got ");
    return std::string(text.substr(got == std::string_view::npos ? 0 : got));
  } catch (const toml::parse_error&) {
    return "not TOML";
  } catch (const TomlAssertion&) {
    return "not TOML";
  }
  return std::nullopt;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
