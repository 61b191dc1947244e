// SPDX-License-Identifier: MIT
// ExperimentKind: all that there is to say of a kind of experiment from outside: its word for the
// key `kind` of a file, the keys of its own table [NAME], how it is made from them, what it rests
// on. It shares [time] and [method] with a rotation; docs/extending/experiment.md adds one.
//
// Equations   none of its own; its model has them (polhode/dynamics/model.hpp).
// Units       core units (polhode/text/units.hpp).
// Domain      names of letters, digits and -, other than the tables that every file may have.
// Accuracy    that of the experiment.
// Errors      a builder throws a DomainError, or says by KeyValues::refuse what it expected: both
//             become a ScenarioError at the place in the file.
// Cost        that of the experiment.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "polhode/scenario/custom_experiment.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/text/kind_key.hpp"

namespace polhode {
inline namespace v0 {

// Where an experiment is made: the values of its table, and what it shares with others.
class ExperimentContext : public KeyValues {
 public:
  ExperimentContext(const KeyValues& table, const SaveAt& rows, const Method& method)
      : KeyValues(table), rows_(rows), method_(method) {}

  const SaveAt& rows() const { return rows_; }      // of [time]
  const Method& method() const { return method_; }  // of [method], or the default
  // Refuses, at its place, a method that does not move the model; `is_frozen`: Splitting does.
  void require_method(bool is_frozen) const;

 private:
  const SaveAt& rows_;
  const Method& method_;
};

// Texts are constant data: they outlive every kind.
struct ExperimentKind {
  std::string_view name;  // "gyrostat"
  std::string_view help;  // one sentence: what it is
  std::vector<Key> keys;  // of the table [gyrostat]; paths are their own names
  std::function<CustomExperiment(const ExperimentContext&)> made;
  std::vector<Citation> citations = {};
  // Of its template; empty: that of the first example that has one, and degrees.
  std::string_view time_unit = {}, angle_unit = {};
};

// A kind whose arguments are a plain struct A, filled by its keys.
template <class A>
ExperimentKind experiment_kind(std::string_view name, std::string_view help,
                               std::span<const KindKey<A>> keys,
                               CustomExperiment (*made)(const A&, const ExperimentContext&),
                               const std::vector<Citation>& citations = {}) {
  return {.name = name,
          .help = help,
          .keys = keys_of(keys),
          .made = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()),
                   made](const ExperimentContext& at) { return made(arguments<A>(all, at), at); },
          .citations = citations};
}

}  // namespace v0
}  // namespace polhode
