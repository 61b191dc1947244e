// SPDX-License-Identifier: MIT
// The rows of the table of keys for a table with a key `kind`, from the descriptions of its kinds.
#pragma once

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/schema.hpp"
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// A kind of a table: paths of its keys are their own names.
struct KindOfTable {
  KindText text;
  std::span<const Key> keys;
  std::string_view sets;
};

class KindRows {
 public:
  // `table` is the row of the table itself and `kind` that of its key, without its words. A key
  // that several kinds have alike is one row; one that all have says nothing of kinds.
  KindRows(const Key& table, const Key& kind, std::span<const KindOfTable> kinds);
  KindRows(const KindRows&) = delete;
  KindRows& operator=(const KindRows&) = delete;

  SchemaPart part() const { return {keys_, alternatives_, texts_}; }

 private:
  void add(const Key& key, std::string_view table, std::string_view kind);

  std::deque<std::string> words_;  // that the rows refer to
  std::vector<Key> keys_;
  std::vector<Alternatives> alternatives_;
  std::vector<KindText> texts_;
};

// The rows of a table that holds one of several tables, [frame.NAME], each of one kind.
class TablesOfKinds {
 public:
  TablesOfKinds(const Key& table, std::span<const KindOfTable> kinds);
  TablesOfKinds(const TablesOfKinds&) = delete;
  TablesOfKinds& operator=(const TablesOfKinds&) = delete;

  SchemaPart part() const { return {keys_, alternatives_}; }

 private:
  std::deque<std::string> words_;
  std::vector<Key> keys_;
  std::vector<Alternatives> alternatives_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
