// SPDX-License-Identifier: MIT
// A JSON document written front to back, two spaces per level; arrays stay on one line.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
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
  template <std::integral T>
  JsonWriter& value(T number) {
    if constexpr (std::same_as<T, bool>)
      return raw(number ? "true" : "false");
    else
      return raw(std::to_string(number));
  }
  JsonWriter& value(const Vec3& v) { return value(std::vector{v.x, v.y, v.z}); }
  JsonWriter& value(const Quaternion& q) { return value(std::vector{q.w, q.x, q.y, q.z}); }
  template <class T>
  JsonWriter& value(const std::vector<T>& all) {
    return array(all, [this](const T& one) { value(one); });
  }
  // An array of what `write(element)` writes.
  template <class Range, class Write>
  JsonWriter& array(const Range& range, const Write& write) {
    begin_array();
    for (const auto& one : range) write(one);
    return end_array();
  }
  // Keys of an object with their values: members("a", 1, "b", "two").
  template <class T, class... More>
  JsonWriter& members(std::string_view name, const T& one, const More&... more) {
    key(name).value(one);
    if constexpr (sizeof...(more) > 0) members(more...);
    return *this;
  }
  template <class... More>
  JsonWriter& object(const More&... more) {
    return begin_object().members(more...).end_object();
  }
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
}  // namespace io
}  // namespace v0
}  // namespace polhode
