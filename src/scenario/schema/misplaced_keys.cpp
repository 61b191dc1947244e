// SPDX-License-Identifier: MIT
#include "scenario/detail/misplaced_keys.hpp"

#include <algorithm>

#include "scenario/detail/other_names.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::size_t most_places = 3;
constexpr std::size_t longest_key = 200;

// "[state.tumbler]", "[[perturbation]]", "[orbit.NAME]".
std::string header(std::string_view path) {
  std::string name(path);
  const bool repeated = name.ends_with("[]");
  if (repeated) name.resize(name.size() - 2);
  if (name.ends_with(".*")) name.replace(name.size() - 1, 1, "NAME");
  return repeated ? "[[" + name + "]]" : "[" + name + "]";
}

bool is_below(std::string_view path, std::string_view table) {
  return table.empty() || (path.starts_with(table) && path.substr(table.size()).starts_with("."));
}

// The first name of a path below a table.
std::string_view first_name(std::string_view path, std::string_view table) {
  std::string_view rest = path.substr(table.empty() ? 0 : table.size() + 1);
  rest = rest.substr(0, rest.find('.'));
  if (rest.ends_with("[]")) rest.remove_suffix(2);
  return rest;
}

// Where a key of a table belongs; a table is at home under its own name.
std::string home_of(const Key& key, bool is_section) {
  const std::string_view table = key_table(key.path);
  if (is_section || (table.empty() && key.type == KeyType::table)) return header(key.path);
  return table.empty() ? "the top of the file, above all tables" : header(table);
}

std::string place(const StrayKey& stray) {
  std::string text;
  for (const Key* key : stray.at)
    text += (text.empty() ? "" : " or ") + home_of(*key, stray.is_section);
  return text;
}

// "unknown key; it belongs in [state.tumbler], as do rotation_period, pole".
std::string belongs_in(const StrayKey& stray, const std::vector<std::string_view>& others) {
  if (stray.is_section) return "unknown table; did you mean " + place(stray) + "?";
  const bool is_top = key_table(stray.at[0]->path).empty() && stray.at[0]->type != KeyType::table;
  std::string text =
      std::string("unknown key; it belongs ") + (is_top ? "at " : "in ") + place(stray);
  for (std::size_t i = 0; i < others.size(); ++i)
    text += (i > 0               ? ", "
             : others.size() > 1 ? ", as do "
                                 : ", as does ") +
            printable(others[i], longest_key);
  return text;
}

std::string unknown(const StrayKey& stray, const KnownTable& table, const std::string& path) {
  return "unknown key; " +
         (stray.near.empty() ? "" : "did you mean " + std::string(stray.near) + "? ") +
         (table.kind.empty() ? "" : "with kind \"" + std::string(table.kind) + "\" ") +
         "expected " + one_of(table.keys) + meaning_of_key(path, stray.name);
}

}  // namespace

bool KnownTable::knows(std::string_view name) const {
  return std::find(all.begin(), all.end(), name) != all.end();
}

KnownTable known_table(std::string_view pattern, std::string_view kind,
                       const std::vector<const Key*>& known) {
  KnownTable table{pattern, {}, kind};
  for (const Key* key : known) {
    table.all.push_back(key_name(key->path));
    if (belongs(*key, kind)) table.keys.push_back(table.all.back());
  }
  return table;
}

StrayKey stray_key(const Schema& schema, const std::vector<std::string_view>& tables,
                   const KnownTable& table, StrayKey stray) {
  const std::string_view name = stray.name;
  const std::vector<std::string_view>& known = table.kind.empty() ? table.all : table.keys;
  stray.near = meant_key(name, known);
  if (stray.near.empty()) stray.near = nearest(name, known);
  if (!stray.near.empty()) return stray;
  std::vector<const Key*> below, elsewhere;
  for (const Key& key : schema.keys) {
    if (key_name(key.path) != name || key_table(key.path) == table.pattern) continue;
    if (stray.is_section && key.type != KeyType::table) continue;
    std::vector<const Key*>& found = is_below(key.path, table.pattern) ? below : elsewhere;
    const auto same = [&](const Key* other) { return other->path == key.path; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back(&key);
  }
  // tables that this kind of file, or this table, does not have
  const auto lacks = [](const std::vector<std::string_view>& names, std::string_view one) {
    return std::find(names.begin(), names.end(), one) == names.end();
  };
  std::erase_if(below, [&](const Key* key) {
    return lacks(table.keys, first_name(key->path, table.pattern));
  });
  std::erase_if(elsewhere,
                [&](const Key* key) { return lacks(tables, first_name(key->path, "")); });
  stray.at = below.empty() && !table.pattern.empty() ? elsewhere : below;
  if (stray.at.size() > most_places) stray.at.clear();
  return stray;
}

std::string_view leads_to(const KnownTable& table, const StrayKey& stray) {
  if (!stray.near.empty()) return stray.near;
  if (stray.at.empty() || !is_below(stray.at[0]->path, table.pattern)) return {};
  return first_name(stray.at[0]->path, table.pattern);
}

void report(std::vector<StrayKey> strays, const KnownTable& table, const std::string& path,
            Diagnostics& diagnostics) {
  std::sort(strays.begin(), strays.end(),
            [](const StrayKey& a, const StrayKey& b) { return a.where < b.where; });
  std::vector<std::string> told;
  for (const StrayKey& stray : strays) {
    if (diagnostics.full()) return;
    const std::string name = printable(stray.name, longest_key);
    const std::string at = path.empty() ? name : path + "." + name;
    if (stray.at.empty()) {
      diagnostics.add(stray.where, at, unknown(stray, table, path));
      continue;
    }
    const std::string home = place(stray);
    if (std::find(told.begin(), told.end(), home) != told.end()) continue;
    told.push_back(home);
    std::vector<std::string_view> others;
    for (const StrayKey& other : strays)
      if (&other != &stray && !other.at.empty() && place(other) == home)
        others.push_back(other.name);
    diagnostics.add(stray.where, at, belongs_in(stray, others));
  }
}

std::string table_in_words(const Schema& schema, const Key& key) {
  std::string text = "a table " + header(key.path);
  for (const Alternatives& row : schema.alternatives)
    if (row.table == key.path && row.kinds.empty())
      return text + " with one of " + sets_in_words(row.sets);
  return text;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
