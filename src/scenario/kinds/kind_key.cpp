// SPDX-License-Identifier: MIT
#include "polhode/scenario/detail/key_form.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
LinearMap KeyForm<LinearMap>::read(const KeyValues& at, std::string_view key) {
  const std::vector<double>& n = at.numbers(key);
  if (n.size() == 3) return {Mat3{{{n[0], 0.0, 0.0}, {0.0, n[1], 0.0}, {0.0, 0.0, n[2]}}}, true};
  return {
      Mat3{{{n.at(0), n.at(1), n.at(2)}, {n.at(3), n.at(4), n.at(5)}, {n.at(6), n.at(7), n.at(8)}}},
      false};
}

void require_allowed(const KeyValues& at, const Key& key) {
  if (!at.has(key.path)) return;
  const std::string path = at.key_path(key.path);
  if (at.is_explicit(key.path) && is_unused(at.values(), value_at(at.values(), path), path))
    at.refuse(key.path, "expected it to be left out with " + std::string(key.unused_with));
  require_range(at.values(), path, at.file());
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
