// SPDX-License-Identifier: MIT
// What a description of a kind must be, before a file is read with it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "polhode/scenario/schema.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What is to be checked of a kind of any sort.
struct KindParts {
  std::string_view sort;  // "perturbation"
  std::string_view name;
  std::string_view help;
  std::span<const Key> keys;
  std::string_view sets;
  bool is_made;  // whether it has a function that makes it
};

// DomainError "Kinds: perturbation "push", key "radius": ..." unless its name is of letters, digits
// and -, its keys have plain names of their own and texts, its sets are of them, and what stands
// for them or shows them is TOML that they take.
void require_sound(const KindParts& kind);

// The same of keys alone; `shown` is what has them.
void require_keys(const std::string& shown, std::span<const Key> keys);

// "Kinds: perturbation "push"", for messages.
std::string shown_kind(std::string_view sort, std::string_view name);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
