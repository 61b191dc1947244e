// SPDX-License-Identifier: MIT
// The JSON Schema of scenario files, for editors that check and complete TOML as it is typed.
#include <algorithm>
#include <cstdint>
#include <set>
#include <string>

#include "polhode/scenario/schema.hpp"
#include "text/json.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::JsonWriter;

// Those of the keys, in the order of their kind.
std::set<Dimension> dimensions_of(const Schema& schema) {
  std::set<Dimension> dimensions = {Dimension::number};
  for (const Key& key : schema.keys) dimensions.insert(key.dimension);
  return dimensions;
}

constexpr std::string_view name_pattern = "^[A-Za-z0-9_-]{1,60}$";

std::string definition_name(Dimension dimension) {
  std::string name(dimension_name(dimension));
  name.erase(0, name.find(' ') + 1);
  for (char& c : name)
    if (c == ' ') c = '_';
  return name;
}

void write_definition(JsonWriter& json, Dimension dimension) {
  json.key(definition_name(dimension)).begin_object();
  json.key("description").value(dimension_name(dimension));
  if (dimension == Dimension::number) {
    json.key("type").value("number").end_object();
    return;
  }
  json.key("anyOf").begin_array();
  json.begin_object().key("type").value("number").end_object();
  json.begin_object().key("type").value("string");
  json.key("pattern").value("^[ \\t]*[-+]?[0-9.][0-9.eE+-]*[ \\t]*[A-Za-z1(].*$").end_object();
  json.begin_object().key("type").value("object").key("properties").begin_object();
  json.key("value").begin_object().key("type").value("number").end_object();
  json.key("unit").begin_object().key("type").value("string").end_object().end_object();
  json.key("required").begin_array().value("value").value("unit").end_array();
  json.key("additionalProperties").value(false).end_object();
  json.end_array().end_object();
}

void write_limit(JsonWriter& json, Range range) {
  if (range == Range::positive) json.key("exclusiveMinimum").value(std::int64_t{0});
  if (range == Range::not_negative) json.key("minimum").value(std::int64_t{0});
}

// A number or { value = .., unit = ".." } in its range. Of a text with a unit the reader says it.
void write_quantity(JsonWriter& json, Dimension dimension, Range range) {
  json.key("$ref").value("#/$defs/" + definition_name(dimension));
  write_limit(json, range);
  if (range == Range::any || dimension == Dimension::number) return;
  json.key("properties").begin_object().key("value").begin_object();
  write_limit(json, range);
  json.end_object().end_object();
}

void write_reference(JsonWriter& json, Dimension dimension, Range range) {
  json.begin_object();
  write_quantity(json, dimension, range);
  json.end_object();
}

void write_words(JsonWriter& json, const Key& key) {
  json.begin_array();
  for (const std::string_view word : separated(key.allowed, '|')) {
    if (key.type == KeyType::integer)
      json.raw(word);
    else
      json.value(word);
  }
  json.end_array();
}

void write_array(JsonWriter& json, int length, const auto& items) {
  json.key("type").value("array").key("items");
  items();
  json.key("minItems").value(std::int64_t{length > 0 ? length : 1});
  if (length > 0) json.key("maxItems").value(std::int64_t{length});
}

// `array` writes an array of a dimension; here also as { value = .., unit = ".." } of bare numbers.
void write_quantities(JsonWriter& json, const Key& key, const auto& array) {
  if (key.dimension == Dimension::number) {
    array(key.dimension);
    return;
  }
  json.key("anyOf").begin_array().begin_object();
  array(key.dimension);
  json.end_object().begin_object().key("type").value("object").key("properties").begin_object();
  json.key("value").begin_object();
  array(Dimension::number);
  json.end_object().key("unit").begin_object().key("type").value("string").end_object();
  json.end_object().key("required").begin_array().value("value").value("unit").end_array();
  json.key("additionalProperties").value(false).end_object().end_array();
}

// A number, a date or a word; of a date without quotes editors of JSON know nothing.
void write_dated(JsonWriter& json, const Key& key, Dimension dimension) {
  const bool dated = key.takes_date && dimension == key.dimension;
  if (!dated && key.allowed.empty()) return write_quantity(json, dimension, key.range);
  json.key("anyOf").begin_array();
  write_reference(json, dimension, key.range);
  if (dated) {
    json.begin_object().key("type").value("string");
    json.key("pattern").value("^(JD |[0-9]{4}-)").end_object();
  }
  if (!key.allowed.empty()) {
    json.begin_object().key("enum");
    write_words(json, key);
    json.end_object();
  }
  json.end_array();
}

void write_numbers(JsonWriter& json, const Key& key) {
  write_quantities(json, key, [&](Dimension dimension) {
    write_array(json, key.length, [&] {
      json.begin_object();
      write_dated(json, key, dimension);
      json.end_object();
    });
  });
}

void write_matrix(JsonWriter& json, const Key& key) {
  write_quantities(json, key, [&](Dimension dimension) {
    write_array(json, 3, [&] {
      json.begin_object();
      write_array(json, 3, [&] { write_reference(json, dimension, key.range); });
      json.end_object();
    });
  });
}

void write_value(JsonWriter& json, const Key& key) {
  switch (key.type) {
    case KeyType::table:
      break;  // write_key
    case KeyType::integer:
      json.key("type").value("integer");
      if (!key.allowed.empty()) break;
      if (key.whole.least != WholeRange{}.least) json.key("minimum").value(key.whole.least);
      if (key.whole.most != WholeRange{}.most) json.key("maximum").value(key.whole.most);
      break;
    case KeyType::number:
      write_dated(json, key, key.dimension);
      break;
    case KeyType::numbers:
      write_numbers(json, key);
      break;
    case KeyType::matrix:
      write_matrix(json, key);
      break;
    case KeyType::linear_map:
      json.key("anyOf").begin_array().begin_object();
      write_numbers(json, key);
      json.end_object().begin_object();
      write_matrix(json, key);
      json.end_object().end_array();
      break;
    case KeyType::square:
      json.key("type").value("array").key("items").begin_object();
      write_numbers(json, key);
      json.end_object().key("minItems").value(std::int64_t{1});
      break;
    case KeyType::key_list:
      json.key("type").value("array").key("items").begin_object().key("type").value("string");
      json.end_object().key("minItems").value(std::int64_t{1});
      break;
    case KeyType::boolean:
      json.key("type").value("boolean");
      break;
    case KeyType::name:
      json.key("type").value("string").key("pattern").value(name_pattern);
      break;
    case KeyType::columns:
    case KeyType::units:
      json.key("type").value("array").key("items").begin_object().key("type").begin_array();
      json.value("string").value("integer").end_array().end_object();
      json.key("minItems").value(std::int64_t{1});
      break;
    case KeyType::text:
    case KeyType::unit:
    case KeyType::epoch:
      json.key("type").value("string");
      break;
    case KeyType::choice:
      break;  // the enum below says all
    case KeyType::choices:
      write_array(json, 0, [&] {
        json.begin_object().key("enum");
        write_words(json, key);
        json.end_object();
      });
      json.key("uniqueItems").value(true);
      return;
  }
  if (!key.allowed.empty() && key.type != KeyType::number) {
    json.key("enum");
    write_words(json, key);
  }
}

// One set of alternatives holds, and none of the keys of the others is there.
void write_alternative(JsonWriter& json, std::string_view sets, std::string_view chosen) {
  const std::vector<std::string_view> own = separated(chosen, '+');
  json.begin_object().key("required").begin_array();
  for (const std::string_view name : own) json.value(name);
  json.end_array().key("not").begin_object().key("anyOf").begin_array();
  for (const std::string_view set : separated(sets, '|'))
    for (const std::string_view name : separated(set, '+'))
      if (std::find(own.begin(), own.end(), name) == own.end())
        json.begin_object().key("required").begin_array().value(name).end_array().end_object();
  json.end_array().end_object().end_object();
}

void write_alternatives(JsonWriter& json, const Alternatives& row) {
  json.key("oneOf").begin_array();
  for (const std::string_view set : separated(row.sets, '|'))
    write_alternative(json, row.sets, set);
  json.end_array();
}

// Of the rows that several kinds have under one name.
bool is_first(const std::vector<const Key*>& keys, const Key& key) {
  return *std::find_if(keys.begin(), keys.end(),
                       [&](const Key* other) { return other->path == key.path; }) == &key;
}

bool always_required(const Key& key) {
  return key.kinds.empty() && key.presence == Presence::required;
}

// With one word of `kind`: what is required, and no key of another kind. `fallback` is the word
// that a missing key stands for.
void write_kind(JsonWriter& json, const Schema& schema, std::string_view table,
                std::string_view kind, std::string_view fallback) {
  const std::vector<const Key*> keys = keys_of(schema, table);
  json.begin_object().key("if").begin_object().key("properties").begin_object();
  json.key("kind").begin_object().key("const").value(kind).end_object().end_object();
  if (!fallback.empty() && kind != fallback)
    json.key("required").begin_array().value("kind").end_array();
  json.end_object();
  json.key("then").begin_object().key("required").begin_array();
  for (const Key* key : keys)
    if (!always_required(*key) && is_required(*key, kind)) json.value(key_name(key->path));
  json.end_array().key("properties").begin_object();
  for (const Key* key : keys)
    if (is_first(keys, *key) && std::none_of(keys.begin(), keys.end(), [&](const Key* other) {
          return other->path == key->path && belongs(*other, kind);
        }))
      json.key(key_name(key->path)).value(false);
  json.end_object();
  for (const Alternatives& row : schema.alternatives)
    if (row.table == table && !row.kinds.empty() && belongs(row, kind))
      write_alternatives(json, row);
  json.end_object().end_object();
}

void write_conditions(JsonWriter& json, const Schema& schema, std::string_view table) {
  const std::vector<const Key*> keys = keys_of(schema, table);
  const auto kind = std::find_if(keys.begin(), keys.end(),
                                 [](const Key* key) { return key_name(key->path) == "kind"; });
  const bool by_kind =
      std::any_of(keys.begin(), keys.end(), [](const Key* key) { return !key->kinds.empty(); });
  const bool by_choice =
      std::any_of(schema.alternatives.begin(), schema.alternatives.end(),
                  [&](const Alternatives& row) { return row.table == table && row.kinds.empty(); });
  if (!by_kind && !by_choice) return;
  json.key("allOf").begin_array();
  for (const Alternatives& row : schema.alternatives) {
    if (row.table != table || !row.kinds.empty()) continue;
    json.begin_object();
    write_alternatives(json, row);
    json.end_object();
  }
  if (by_kind && kind != keys.end()) {
    std::string_view fallback = (*kind)->fallback;  // in quotes
    if (!fallback.empty()) fallback = fallback.substr(1, fallback.size() - 2);
    for (const std::string_view word : separated((*kind)->allowed, '|'))
      write_kind(json, schema, table, word, fallback);
  }
  json.end_array();
}

void write_table(JsonWriter& json, const Schema& schema, std::string_view table);

void write_key(JsonWriter& json, const Schema& schema, const Key& key) {
  json.begin_object().key("description").value(key.help);
  if (key.type != KeyType::table) {
    write_value(json, key);
    if (!key.fallback.empty()) json.key("default").raw(key.fallback);
  } else if (key.path.ends_with("[]")) {
    json.key("type").value("array").key("items").begin_object();
    write_table(json, schema, key.path);
    json.end_object();
  } else {
    write_table(json, schema, key.path);
  }
  json.end_object();
}

// One row, or those of several kinds.
void write_property(JsonWriter& json, const Schema& schema, const std::vector<const Key*>& keys,
                    const Key& key) {
  const auto is_row = [&](const Key* other) { return other->path == key.path; };
  if (std::count_if(keys.begin(), keys.end(), is_row) == 1) return write_key(json, schema, key);
  json.begin_object().key("anyOf").begin_array();
  for (const Key* row : keys)
    if (is_row(row)) write_key(json, schema, *row);
  json.end_array().end_object();
}

void write_table(JsonWriter& json, const Schema& schema, std::string_view table) {
  const std::vector<const Key*> keys = keys_of(schema, table);
  const Key* named = nullptr;
  json.key("type").value("object").key("properties").begin_object();
  for (const Key* key : keys) {
    if (key_name(key->path) == "*") {
      named = key;
      continue;
    }
    if (!is_first(keys, *key)) continue;
    json.key(key_name(key->path));
    write_property(json, schema, keys, *key);
  }
  json.end_object().key("additionalProperties");
  if (named == nullptr) {
    json.value(false);
  } else {
    write_key(json, schema, *named);
    json.key("propertyNames").begin_object();
    json.key("pattern").value(name_pattern).end_object();
  }
  json.key("required").begin_array();
  for (const Key* key : keys)
    if (always_required(*key)) json.value(key_name(key->path));
  json.end_array();
  write_conditions(json, schema, table);
}

}  // namespace

std::string json_schema(const Schema& schema) {
  JsonWriter json;
  json.begin_object();
  json.key("$schema").value("https://json-schema.org/draft/2020-12/schema");
  json.key("title").value("polhode scenario, schema 1");
  write_table(json, schema, "");
  json.key("$defs").begin_object();
  for (const Dimension dimension : dimensions_of(schema)) write_definition(json, dimension);
  json.end_object().end_object();
  return json.text();
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
