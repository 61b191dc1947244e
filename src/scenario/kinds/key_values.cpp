// SPDX-License-Identifier: MIT
#include "polhode/scenario/key_values.hpp"

#include <algorithm>
#include <filesystem>

#include "polhode/scenario/schema.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {

const detail::Value& KeyValues::at(std::string_view key) const {
  return detail::value_at(values_, key_path(key));
}

bool KeyValues::has(std::string_view key) const { return detail::has(values_, key_path(key)); }
bool KeyValues::is_explicit(std::string_view key) const {
  return detail::is_explicit(values_, key_path(key));
}
double KeyValues::number(std::string_view key) const { return at(key).numbers.at(0); }
Vec3 KeyValues::vector(std::string_view key) const {
  return detail::vector(values_, key_path(key));
}
const std::vector<double>& KeyValues::numbers(std::string_view key) const {
  return at(key).numbers;
}
const std::string& KeyValues::word(std::string_view key) const { return at(key).words.at(0); }
const std::vector<std::string>& KeyValues::words(std::string_view key) const {
  return at(key).words;
}
std::size_t KeyValues::choice(std::string_view key) const {
  const std::vector<std::string_view> words = separated(at(key).key->allowed, '|');
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), word(key)) - words.begin());
}
bool KeyValues::flag(std::string_view key) const { return at(key).whole == 1; }

std::string KeyValues::file_at(std::string_view key) const {
  return (std::filesystem::path(file_).parent_path() / word(key)).string();
}

double KeyValues::unit(std::string_view key, Dimension dimension) const {
  if (!has(key)) return 1.0;
  return built(key, [&] { return units_.to_core(1.0, word(key), dimension); });
}

void KeyValues::refuse(std::string_view key, std::string_view message) const {
  detail::refuse(values_, key_path(key), file_, message);
}
std::string KeyValues::noted(std::string_view key, std::string_view message) const {
  return detail::message_at(values_, key_path(key), file_, message);
}

}  // namespace v0
}  // namespace polhode
