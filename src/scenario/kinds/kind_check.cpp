// SPDX-License-Identifier: MIT
#include "scenario/detail/kind_check.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include "polhode/error.hpp"
#include "scenario/value_reader.hpp"
#include "text/printable.hpp"
#include "text/word_list.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::string quoted(std::string_view text) { return '"' + printable(text) + '"'; }

bool is_plain(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  });
}

bool has_key(const KindParts& kind, std::string_view name) {
  return std::any_of(kind.keys.begin(), kind.keys.end(),
                     [&](const Key& key) { return key.path == name; });
}

void require_value(const std::string& where, const Key& key, const char* what,
                   std::string_view toml) {
  if (toml.empty()) return;
  if (const std::optional<std::string> wrong = why_not(key, toml))
    throw DomainError(where + ": " + what + " " + printable(toml) + ": " + *wrong);
}

void require_key(const std::string& where, const Key& key) {
  if (!is_name(key.path) || key.path == "kind")
    throw DomainError(where + "; expected letters, digits, - and _, and not \"kind\"");
  if (key.help.empty()) throw DomainError(where + ": got no text; expected one sentence");
  require_value(where, key, "what stands for it,", key.fallback);
  require_value(where, key, "its example", key.example);
}

}  // namespace

std::string shown_kind(std::string_view sort, std::string_view name) {
  return "Kinds: " + std::string(sort) + " " + quoted(name);
}

void require_keys(const std::string& shown, std::span<const Key> keys) {
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    const std::string where = shown + ", key " + quoted(key->path);
    require_key(where, *key);
    if (std::any_of(keys.begin(), key, [&](const Key& other) { return other.path == key->path; }))
      throw DomainError(where + " is there twice; expected another name");
  }
}

void require_sound(const KindParts& kind) {
  const std::string shown = shown_kind(kind.sort, kind.name);
  if (!is_plain(kind.name)) throw DomainError(shown + "; expected letters, digits and -");
  if (kind.help.empty()) throw DomainError(shown + ": got no text; expected one sentence");
  if (!kind.is_made) throw DomainError(shown + ": got no function that makes it; expected one");
  require_keys(shown, kind.keys);
  for (const std::string_view set : separated(kind.sets, '|'))
    for (const std::string_view name : separated(set, '+'))
      if (!has_key(kind, name))
        throw DomainError(shown + ": got " + quoted(name) +
                          " in its sets; expected one of its keys");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
