// SPDX-License-Identifier: MIT
// The values of one table by the keys of its kind.
#include "polhode/text/key_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include "polhode/text/detail/key_form.hpp"
#include "polhode/text/separated.hpp"
#include "text/value_access.hpp"
#include "text/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

const detail::Value& KeyValues::at(std::string_view key) const {
  return detail::value_at(values_, key_path(key));
}

detail::FileValues KeyValues::file_values() const { return {values_, units_, file_}; }

bool KeyValues::has(std::string_view key) const { return detail::has(values_, key_path(key)); }
bool KeyValues::is_explicit(std::string_view key) const {
  return detail::is_explicit(values_, key_path(key));
}
double KeyValues::number(std::string_view key) const { return at(key).numbers.at(0); }
Vec3 KeyValues::vector(std::string_view key) const {
  const std::vector<double>& n = numbers(key);
  return {n.at(0), n.at(1), n.at(2)};
}
const std::vector<double>& KeyValues::numbers(std::string_view key) const {
  return at(key).numbers;
}
const std::string& KeyValues::word(std::string_view key) const { return at(key).words.at(0); }
const std::vector<std::string>& KeyValues::words(std::string_view key) const {
  return at(key).words;
}
std::size_t KeyValues::choice(std::string_view key) const { return choices(key).at(0); }
std::vector<std::size_t> KeyValues::choices(std::string_view key) const {
  const std::vector<std::string_view> allowed = separated(at(key).key->allowed, '|');
  std::vector<std::size_t> places;
  for (const std::string& word : words(key))
    places.push_back(static_cast<std::size_t>(std::ranges::find(allowed, word) - allowed.begin()));
  return places;
}
bool KeyValues::flag(std::string_view key) const { return at(key).whole == 1; }
std::int64_t KeyValues::integer(std::string_view key) const { return at(key).whole; }

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

namespace detail {

Mat3 KeyForm<Mat3>::read(const KeyValues& at, std::string_view key) {
  const std::vector<double>& n = at.numbers(key);
  return {{{n.at(0), n.at(1), n.at(2)}, {n.at(3), n.at(4), n.at(5)}, {n.at(6), n.at(7), n.at(8)}}};
}

void KeyForm<Mat3>::tell(const Mat3& x, KeyValue& value) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) value.numbers.push_back(x(i, k));
}

SquareMatrix KeyForm<SquareMatrix>::read(const KeyValues& at, std::string_view key) {
  const std::vector<double>& n = at.numbers(key);
  return {n, static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(n.size()))))};
}

LinearMap KeyForm<LinearMap>::read(const KeyValues& at, std::string_view key) {
  const std::vector<double>& n = at.numbers(key);
  if (n.size() == 3) return {Mat3{{{n[0], 0.0, 0.0}, {0.0, n[1], 0.0}, {0.0, 0.0, n[2]}}}, true};
  return {KeyForm<Mat3>::read(at, key), false};
}

void KeyForm<LinearMap>::tell(const LinearMap& x, KeyValue& value) {
  if (!x.is_diagonal) return KeyForm<Mat3>::tell(x.matrix, value);
  value.numbers = {x.matrix(0, 0), x.matrix(1, 1), x.matrix(2, 2)};
}

void require_allowed(const KeyValues& at, const Key& key) {
  if (!at.has(key.path)) return;
  const std::string path = at.key_path(key.path);
  if (at.is_explicit(key.path) && is_unused(at.values(), value_at(at.values(), path), path))
    at.refuse(key.path, "expected it to be left out with " + std::string(key.unused_with));
  require_range(at.values(), path, at.file());
  if (key.type != KeyType::integer) return;
  const std::int64_t n = at.integer(key.path);
  const WholeRange& whole = key.whole;
  if (n < whole.least || n > whole.most)
    at.refuse(key.path,
              "expected a whole number from " + std::to_string(whole.least) + " to " +
                  (whole.shown.empty() ? std::to_string(whole.most) : std::string(whole.shown)));
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
