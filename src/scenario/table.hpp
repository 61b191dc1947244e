// SPDX-License-Identifier: MIT
// Table<A>: a table of a scenario file, [time] or [[event]], as constant data: its row, its keys
// and the members of A that they fill. TableRows makes its part of the schema from it; Placed<A>
// reads it from the values of a file and knows where each member stands, for errors.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/text/kind_key.hpp"
#include "scenario/detail/schema_parts.hpp"
#include "scenario/values.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

template <class A>
struct Table {
  Key row;  // "time", "event[]"
  std::span<const KindKey<A>> keys;
  std::span<const Alternatives> sets = {};
  std::span<const KindText> kinds = {};
};

// The rows of tables, one after the other, for the schema.
class TableRows {
 public:
  template <class... A>
  explicit TableRows(const Table<A>&... tables) {
    (add(tables.row, keys_of(tables.keys), tables.sets, tables.kinds), ...);
  }
  TableRows(const TableRows&) = delete;
  TableRows& operator=(const TableRows&) = delete;

  // Paths of the keys are their own names.
  void add(const Key& row, std::span<const Key> keys, std::span<const Alternatives> sets = {},
           std::span<const KindText> kinds = {});

  SchemaPart part() const { return {keys_, alternatives_, texts_}; }

 protected:
  void add_set(const Alternatives& set) { alternatives_.push_back(set); }
  // Stores text that keys refer to.
  const std::string& own(std::string words) { return words_.emplace_back(std::move(words)); }

 private:
  std::deque<std::string> words_;  // that keys refer to
  std::vector<Key> keys_;
  std::vector<Alternatives> alternatives_;
  std::vector<KindText> texts_;
};

// The part of the schema that the descriptions of tables make, in this order.
template <const auto&... tables>
SchemaPart part_of() {
  static const TableRows rows(tables...);
  return rows.part();
}

template <class A>
class Placed {
 public:
  // `path` is that of the table in the file, "event[0]".
  Placed(const Table<A>& table, const FileValues& file, std::string path)
      : keys_(table.keys),
        at_(file.values, file.units, std::move(path), file.name),
        arguments_(arguments(table.keys, at_)) {}
  Placed(const Table<A>& table, const FileValues& file)
      : Placed(table, file, std::string(table.row.path)) {}

  const A* operator->() const { return &arguments_; }
  const A& operator*() const { return arguments_; }
  const KeyValues& at() const { return at_; }
  // True if the file has the table.
  bool is_there() const { return has(at_.values(), at_.path()); }

  // The name of the key that fills a member, "start".
  template <auto member>
  std::string_view name() const {
    for (const KindKey<A>& one : keys_)
      if (one.template is_of<member>()) return one.key().path;
    throw std::logic_error("no key of " + at_.path() + " fills the member");
  }
  // True if the file has the key.
  template <auto member>
  bool is_explicit() const {
    return at_.is_explicit(name<member>());
  }

  // The member, if the file has the key.
  template <auto member>
  std::optional<Member<member>> given() const {
    if (!is_explicit<member>()) return std::nullopt;
    return arguments_.*member;
  }

  template <auto member>
  std::string key_path() const {
    return at_.key_path(name<member>());
  }
  // The path of the file that the key names.
  template <auto member>
  std::string file_at() const {
    return at_.file_at(name<member>());
  }
  // The value of one unit in core units; 1 if the key is missing.
  template <auto member>
  double unit(Dimension dimension) const {
    return at_.unit(name<member>(), dimension);
  }

  template <auto member>
  Place place() const {
    return place_of(at_.values(), key_path<member>(), at_.file());
  }

  // "expected ..." at the place of a member, or of the table.
  template <auto member>
  [[noreturn]] void refuse(std::string_view message) const {
    at_.refuse(name<member>(), message);
  }
  // "expected none ..." at the place of the first of these members that the file has.
  template <auto... members>
  void refuse_any(std::string_view message) const {
    ((is_explicit<members>() ? refuse<members>(message) : void()), ...);
  }
  [[noreturn]] void refuse(std::string_view message) const {
    detail::refuse(at_.values(), at_.path(), at_.file(), message);
  }
  // Turns a DomainError of the library into a ScenarioError at the member, or at the table.
  template <auto member, class Build>
  auto built(const Build& build) const {
    return at_.built(name<member>(), build);
  }
  template <class Build>
  auto built(const Build& build) const {
    return detail::built(at_.values(), at_.path(), at_.file(), build);
  }

 private:
  std::span<const KindKey<A>> keys_;
  KeyValues at_;
  A arguments_;
};

// Reads all tables of an array, [[event]], in order.
template <class A>
std::vector<Placed<A>> placed_tables(const Table<A>& table, const FileValues& file) {
  std::vector<Placed<A>> all;
  const std::string_view path = table.row.path;
  for (std::string& own : array_paths(file.values, std::string(path.substr(0, path.size() - 2))))
    all.emplace_back(table, file, std::move(own));
  return all;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
