// SPDX-License-Identifier: MIT
// MethodKind: all that there is to say of one kind of [method]: its keys, how a method is made from
// them, what it rests on. Readers, schema, pages, citations and Python come from it;
// docs/extending/method.md adds one.
//
// Equations   none of its own; the methods have theirs (polhode/dynamics/).
// Units       core units (polhode/text/units.hpp).
// Domain      the method that is made has the name of the kind (MethodTraits::kind).
// Accuracy    that of the method.
// Errors      a builder throws a DomainError, or says by KeyValues::refuse what it expected: both
//             become a ScenarioError at the place in the file. It may be called from any thread.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "polhode/dynamics/method.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/text/kind_key.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// Texts are constant data: they outlive every kind.
struct MethodKind {
  std::string_view name;  // "splitting"
  std::string_view help;  // one sentence: what it does
  std::vector<Key> keys;  // paths are their own names
  std::function<Method(const KeyValues&)> made;
  // What one of its methods rests on; none where empty.
  std::function<std::vector<Citation>(const Method&)> cited = {};
};

// A kind whose arguments are a plain struct A, filled by its keys: the method itself, where it is
// one of polhode's.
template <class A>
MethodKind method_kind(std::string_view name, std::string_view help,
                       std::span<const KindKey<A>> keys, Method (*made)(const A&, const KeyValues&),
                       const std::function<std::vector<Citation>(const Method&)>& cited = {}) {
  return {.name = name,
          .help = help,
          .keys = keys_of(keys),
          .made = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()),
                   made](const KeyValues& at) { return made(arguments<A>(all, at), at); },
          .cited = cited};
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
