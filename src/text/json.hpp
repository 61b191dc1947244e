// SPDX-License-Identifier: MIT
// A JSON document written front to back, two spaces per level; arrays stay on one line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace detail {

class JsonWriter {
 public:
  JsonWriter& begin_object();
  JsonWriter& end_object();
  JsonWriter& begin_array();
  JsonWriter& end_array();
  JsonWriter& key(std::string_view name);
  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(double number);  // JSON has no infinity and no NaN: null
  JsonWriter& value(std::int64_t number);
  JsonWriter& value(bool truth);
  JsonWriter& raw(std::string_view json);  // a value that is JSON already

  // The document, ended by a new line.
  std::string text() const { return text_ + "\n"; }

 private:
  struct Level {
    bool array;
    bool empty;
  };
  void separate();

  std::string text_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
