// SPDX-License-Identifier: MIT
// OrbitKind: all that there is to say of one kind of [orbit.NAME]: its keys, how an orbit is made
// from them, what it rests on. Readers, schema, pages, summaries and citations come from it;
// docs/extending/orbit.md adds one.
//
// Equations   none of its own; the orbits have theirs (polhode/orbit/).
// Units       core units (polhode/text/units.hpp).
// Domain      positions are along the inertial axes of the state (OrbitContext::state_axes).
// Accuracy    that of the orbit.
// Errors      a builder throws a DomainError, or says by OrbitContext::refuse what it expected:
//             both become a ScenarioError at the place in the file. It may be called from any
//             thread.
// Cost        that of the orbit.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/rotation.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/text/kind_key.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// What a run of the file goes through: t = 0 and all its rows.
struct TimeSpan {
  double first = 0.0;
  double last = 0.0;
};

// What an orbit was made of, next to its own keys and the epoch: it is made again when that
// changes.
struct OrbitUses {
  bool time = false;  // the rows of the run
};

// Where an orbit is made: its own table, and what stands before it. What is asked for is noted in
// `uses`, which must outlive this like all else.
class OrbitContext : public KeyValues {
 public:
  OrbitContext(const KeyValues& table, const std::optional<SaveAt>& rows, OrbitUses& uses)
      : KeyValues(table), rows_(rows), uses_(uses) {}

  // None without [time].
  std::optional<TimeSpan> run_span() const;
  // "inertial", "ecliptic-J2000" or "equator-J2000"
  std::string state_axes() const;

 private:
  const std::optional<SaveAt>& rows_;
  OrbitUses& uses_;
};

// Elements over ages, without positions: what the kind "obliquity" moves on.
struct ScenarioHistory {
  secular::OrbitHistory elements;
  std::string text;                        // "elements mars.csv, 5001 rows"
  std::vector<std::string> warnings = {};  // as those of a ScenarioOrbit
  bool is_inertial = false;                // along any inertial axes, not those of the ecliptic
};

// Texts are constant data: they outlive every kind.
struct OrbitKind {
  std::string_view name;                 // "kepler"
  std::string_view help;                 // one sentence: what the orbit is made from
  std::vector<Key> keys;                 // paths are their own names
  std::string_view sets = {};            // exactly one of "times|file" is there; empty: none such
  std::vector<Citation> citations = {};  // what it rests on
  // One of them, or both. Without name and kind, which are those of the file.
  std::function<ScenarioOrbit(const OrbitContext&)> made = {};
  std::function<ScenarioHistory(const OrbitContext&)> history = {};
  bool is_dated = false;  // needs state.epoch, and axes of the sky
};

// A kind whose arguments are a plain struct A, filled by its keys.
template <class A>
OrbitKind orbit_kind(std::string_view name, std::string_view help, std::span<const KindKey<A>> keys,
                     ScenarioOrbit (*made)(const A&, const OrbitContext&),
                     const std::vector<Citation>& citations = {}) {
  return {.name = name,
          .help = help,
          .keys = keys_of(keys),
          .citations = citations,
          .made = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()),
                   made](const OrbitContext& at) { return made(arguments<A>(all, at), at); }};
}
// A kind of elements over ages, which may also give positions.
template <class A>
OrbitKind history_kind(std::string_view name, std::string_view help,
                       std::span<const KindKey<A>> keys,
                       ScenarioHistory (*history)(const A&, const OrbitContext&),
                       ScenarioOrbit (*made)(const A&, const OrbitContext&) = nullptr,
                       const std::vector<Citation>& citations = {}) {
  OrbitKind kind = orbit_kind(name, help, keys, made, citations);
  if (made == nullptr) kind.made = {};
  kind.history = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()),
                  history](const OrbitContext& at) { return history(arguments<A>(all, at), at); };
  return kind;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
