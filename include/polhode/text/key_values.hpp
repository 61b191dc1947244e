// SPDX-License-Identifier: MIT
// KeyValues: the values of one table of a scenario, by the names of its keys: [[perturbation]],
// [method]. What a kind of thing is made from.
//
// Units       core units (polhode/text/units.hpp).
// Domain      names of keys of the kind. What is asked for with number, vector, ... is there: the
//             reader has seen to required keys and defaults; ask has() of others.
// Errors      refuse and built throw a ScenarioError at the place of the key in the file.
// Cost        a lookup in a map for each value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/text/detail/values_fwd.hpp"
#include "polhode/text/units.hpp"
#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace io {

// Every mistake of a file; what() holds one line for each.
class ScenarioError : public DomainError {
 public:
  using DomainError::DomainError;
};

class KeyValues {
 public:
  // `path` is that of the table, "perturbation[0]"; `file` stands for the scenario in messages, and
  // paths of files start at its folder. Values, units and file must outlive this.
  KeyValues(const detail::Values& values, const Units& units, std::string path,
            const std::string& file)
      : values_(values), units_(units), path_(std::move(path)), file_(file) {}

  // Whether the file or a default has a value, and whether the file has it.
  bool has(std::string_view key) const;
  bool is_explicit(std::string_view key) const;

  double number(std::string_view key) const;
  Vec3 vector(std::string_view key) const;
  const std::vector<double>& numbers(std::string_view key) const;
  // Text, a name, a unit or a choice; the words of an array.
  const std::string& word(std::string_view key) const;
  const std::vector<std::string>& words(std::string_view key) const;
  // The place of the word of a choice among those allowed; of each word of several.
  std::size_t choice(std::string_view key) const;
  std::vector<std::size_t> choices(std::string_view key) const;
  bool flag(std::string_view key) const;
  std::int64_t integer(std::string_view key) const;
  // Where the file is that the key names.
  std::string file_at(std::string_view key) const;
  // What one unit of the quantity is, by a key that holds a unit; 1 where the key is left out.
  double unit(std::string_view key, Dimension dimension) const;

  // "expected ..." at the place of a key; the message is completed by what the file has there.
  [[noreturn]] void refuse(std::string_view key, std::string_view message) const;

  // A message at the same place, for a warning.
  std::string noted(std::string_view key, std::string_view message) const;

  // What a constructor of the library refuses becomes a message at the place of the key.
  template <class Build>
  auto built(std::string_view key, const Build& build) const {
    try {
      return build();
    } catch (const ScenarioError&) {
      throw;
    } catch (const DomainError& error) {
      refuse(key, error.what());
    }
  }

  const Units& units() const { return units_; }
  const std::string& path() const { return path_; }
  const std::string& file() const { return file_; }
  std::string key_path(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  }
  const detail::Values& values() const { return values_; }
  detail::FileValues file_values() const;

 private:
  const detail::Value& at(std::string_view key) const;

  const detail::Values& values_;
  const Units& units_;
  std::string path_;
  const std::string& file_;
};

// KeyValue: the value of one key, apart from any file: what a table says of it, or a program.
//
// Units       numbers are in core units (polhode/text/units.hpp).
// Domain      which of the members hold the value is said by the type of its key.
// Cost        a plain value.

struct KeyValue {
  std::string_view key;              // its name
  std::vector<double> numbers = {};  // a matrix row by row
  std::vector<std::string> words = {};
  std::int64_t whole = 0;  // of a flag 0 or 1
  std::string shown = {};  // as messages quote it

  bool operator==(const KeyValue&) const = default;
};

// Place: the place of a value in its file, which plans keep so that a later stage can reject the
// value.
//
// Errors      refuse and built throw a ScenarioError "FILE:LINE:COLUMN: KEY: got VALUE; MESSAGE".
// Cost        two strings.

struct Place {
  std::string key;  // "FILE:LINE:COLUMN: KEY"
  std::string got;  // "got VALUE; "; empty for a table

  std::string message(std::string_view expected) const;
  // "expected ..."
  [[noreturn]] void refuse(std::string_view expected) const;

  // Turns a DomainError of the library into a ScenarioError at this place.
  template <class Build>
  auto built(const Build& build) const {
    try {
      return build();
    } catch (const ScenarioError&) {
      throw;
    } catch (const DomainError& error) {
      refuse(error.what());
    }
  }
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
