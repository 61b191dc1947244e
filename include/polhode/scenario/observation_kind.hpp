// SPDX-License-Identifier: MIT
// ObservationKind: all that there is to say of one kind of [[observation]]: its keys, and what the
// rows of its files are. Readers, schema, pages, templates, fits and simulations come from it;
// docs/extending/observation.md adds one.
//
// Equations   none of its own.
// Units       core units (polhode/text/units.hpp).
// Domain      each table also has the keys of all kinds: name, file and those of the times. q and w
//             of a motion refer to the body axes of the file and to inertial axes.
// Accuracy    derivatives of a MeasuredRows are central differences, to about 1e-10.
// Errors      a builder throws a DomainError, or says by TermContext::refuse what it expected: both
//             become a ScenarioError at the place in the file. It may be called from any thread.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/fit/snapshots.hpp"
#include "polhode/scenario/observation.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/kind_key.hpp"

namespace polhode {
inline namespace v0 {

// Texts are constant data: they outlive every kind.
struct ObservationKind {
  std::string_view name;       // "attitude"
  std::string_view help;       // what its rows are
  std::vector<Key> keys;       // paths are their own names
  std::string_view sets = {};  // exactly one of "sigma|sigma_columns" is there; empty: none such
  // Fills in `rows`, or `light`; the keys of all kinds are there.
  std::function<void(Observation&, const TermContext&)> made = {};
  std::vector<Citation> citations = {};
};

// A kind whose arguments are a plain struct A, filled by its keys.
template <class A>
ObservationKind observation_kind(std::string_view name, std::string_view help,
                                 std::span<const KindKey<A>> keys,
                                 ObservedRows (*made)(const A&, const TermContext&)) {
  return {.name = name,
          .help = help,
          .keys = keys_of(keys),
          .made = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()), made](
                      Observation& of, const TermContext& at) {
            of.rows = made(arguments<A>(all, at), at);
          }};
}

// Numbers that are a function of the motion.
struct MeasuredColumn {
  std::string name;
  Dimension dimension;
};
struct MeasuredRows {
  std::vector<MeasuredColumn> columns;  // behind the time; angles are compared modulo a turn
  std::vector<double> sigmas;           // the standard error of each
  MotionFunction numbers;               // of each
};
// The rows of such a table: the columns have their own names, in the units of the file.
ObservedRows observed_rows(MeasuredRows measured, const TermContext& at);

}  // namespace v0
}  // namespace polhode
