// SPDX-License-Identifier: MIT
// FrameKind: all that there is to say of one kind of reference frame, a table [frame.NAME]: its
// keys, and how a frame is made from them. Readers, schema and pages come from it;
// docs/extending/frame.md adds one.
//
// Equations   none of its own; frames have theirs (polhode/frame/frame.hpp).
// Units       core units (polhode/text/units.hpp).
// Domain      at most one table [frame.NAME] in a file.
// Accuracy    that of the frame.
// Errors      a builder throws a DomainError, or says by KeyValues::refuse what it expected: both
//             become a ScenarioError at the place in the file. It may be called from any thread.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/rotation.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/text/kind_key.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// Where a frame is made: its own table, and the orbits of the file.
class FrameContext : public KeyValues {
 public:
  FrameContext(const KeyValues& table, const std::vector<ScenarioOrbit>& orbits)
      : KeyValues(table), orbits_(orbits) {}

  // The orbit that the key names.
  const ScenarioOrbit& orbit(std::string_view key) const;

 private:
  const std::vector<ScenarioOrbit>& orbits_;
};

struct MadeFrame {
  Frame frame;
  std::string text;                                     // for outputs: "plane of orbit moon"
  std::optional<Precession> precession = std::nullopt;  // where the frame turns uniformly
};

// Texts are constant data: they outlive every kind.
struct FrameKind {
  std::string_view name;       // "orbit-plane"
  std::string_view help;       // what the frame is
  std::vector<Key> keys;       // paths are their own names
  std::string_view sets = {};  // exactly one of "rate|orbit+turns" is there; empty: none such
  std::function<MadeFrame(const FrameContext&)> made;
};

// A kind whose arguments are a plain struct A, filled by its keys.
template <class A>
FrameKind frame_kind(std::string_view name, std::string_view help, std::span<const KindKey<A>> keys,
                     MadeFrame (*made)(const A&, const FrameContext&)) {
  return {.name = name,
          .help = help,
          .keys = keys_of(keys),
          .made = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()),
                   made](const FrameContext& at) { return made(arguments<A>(all, at), at); }};
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
