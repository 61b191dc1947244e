// SPDX-License-Identifier: MIT
#include "scenario/detail/kind_rows.hpp"

#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

// Without what says which kinds a row belongs to.
bool are_alike(Key a, const Key& b) {
  a.kinds = b.kinds;
  return a == b;
}

std::string joined(std::string_view words, std::string_view word) {
  return std::string(words) + (words.empty() ? "" : "|") + std::string(word);
}

}  // namespace

KindRows::KindRows(const Key& table, const Key& kind, std::span<const KindOfTable> kinds) {
  keys_ = {table, kind};
  std::string all;
  for (const KindOfTable& one : kinds) {
    all = joined(all, one.text.kind);
    for (const Key& key : one.keys) add(key, table.path, one.text.kind);
    if (!one.sets.empty()) alternatives_.push_back({table.path, one.sets, one.text.kind});
    texts_.push_back(one.text);
    texts_.back().table = table.path;
  }
  for (Key& key : keys_)
    if (key.kinds == all && kinds.size() > 1) key.kinds = {};
  keys_[1].allowed = words_.emplace_back(std::move(all));
}

TablesOfKinds::TablesOfKinds(const Key& table, std::span<const KindOfTable> kinds) {
  keys_ = {table};
  std::string all;
  for (const KindOfTable& one : kinds) {
    all = joined(all, one.text.kind);
    const std::string& path =
        words_.emplace_back(std::string(table.path) + "." + std::string(one.text.kind));
    keys_.push_back({.path = path, .presence = Presence::alternative, .help = one.text.text});
    for (const Key& key : one.keys) {
      keys_.push_back(key);
      keys_.back().path = words_.emplace_back(path + "." + std::string(key.path));
    }
    if (!one.sets.empty()) alternatives_.push_back({path, one.sets});
  }
  alternatives_.insert(alternatives_.begin(), {table.path, words_.emplace_back(std::move(all))});
}

void TableRows::add(const Key& row, std::span<const Key> keys, std::span<const Alternatives> sets,
                    std::span<const KindText> kinds) {
  const bool is_head = row.path.empty();  // of the file
  if (!is_head) keys_.push_back(row);
  for (const Key& key : keys) {
    keys_.push_back(key);
    if (!is_head)
      keys_.back().path = words_.emplace_back(std::string(row.path) + "." + std::string(key.path));
  }
  alternatives_.insert(alternatives_.end(), sets.begin(), sets.end());
  texts_.insert(texts_.end(), kinds.begin(), kinds.end());
}

void KindRows::add(const Key& key, std::string_view table, std::string_view kind) {
  Key row = key;
  const std::string path = std::string(table) + "." + std::string(key.path);
  row.path = path;
  for (Key& other : keys_) {
    if (!are_alike(row, other)) continue;
    other.kinds = words_.emplace_back(joined(other.kinds, kind));
    return;
  }
  row.path = words_.emplace_back(path);
  row.kinds = kind;
  keys_.push_back(row);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
