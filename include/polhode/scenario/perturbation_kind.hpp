// SPDX-License-Identifier: MIT
// PerturbationKind: the description of one kind of [[perturbation]]: its keys, the function that
// makes its terms, its references and its class in Python. Readers, schema, pages, templates,
// summaries and citations use it; docs/extending/torque.md adds one.
//
// Equations   none of its own; the terms have theirs (polhode/perturb/).
// Units       core units (polhode/text/units.hpp).
// Domain      vectors of a file refer to its body axes, terms to principal axes: see
//             TermContext::principal. Arguments that a program gives are along principal axes.
// Accuracy    that of the terms.
// Errors      a builder throws a DomainError, or says by TermContext::refuse what it expected: both
//             become a ScenarioError at the place in the file. It may be called from any thread.
// Cost        that of the terms.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/perturb/any_perturbation.hpp"
#include "polhode/perturb/magnetic_field.hpp"
#include "polhode/scenario/rotation.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/text/kind_key.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// The parts of the rotation that a term depends on besides its own keys: it is made again when one
// of them changes.
struct TermUses {
  bool body = false;
  bool file_axes = false;
  bool surface = false;
  std::vector<std::size_t> orbits = {};  // by their numbers
  // Its arguments, as in TermArguments, and whether it asked for the body after they were noted.
  std::shared_ptr<const std::vector<KeyValue>> arguments = nullptr;
  bool body_with_arguments = false;
};

// The parts that a term may ask for; null if there are none.
struct TermParts {
  const Body* body = nullptr;
  Quaternion q_FB = {};
  const Surface* surface = nullptr;
  const std::vector<ScenarioOrbit>* orbits = nullptr;
  const FieldOfTime* field = nullptr;  // replaces the field that the keys describe
  std::string name = {};               // replaces the name that the kind gives
};
TermParts parts_of(const Rotation& rotation);

// The table of a term and the parts of the rotation that are made before it. It notes in `uses`
// what the kind asks for. All arguments must outlive it.
class TermContext : public KeyValues {
 public:
  TermContext(const KeyValues& table, const TermParts& parts, TermUses& uses)
      : KeyValues(table), parts_(parts), uses_(uses) {}

  // The name that a program gave the term, or that of its kind.
  std::string name(std::string of_kind) const {
    return parts_.name.empty() ? std::move(of_kind) : parts_.name;
  }
  // Notes what the keys say.
  void note(std::vector<KeyValue> arguments) const {
    uses_.arguments = std::make_shared<const std::vector<KeyValue>>(std::move(arguments));
  }

  const Body& body() const;
  // Files have vectors along the axes of their tensor, terms along principal axes. These return the
  // components along principal axes, of a matrix its symmetric part.
  Vec3 principal(const Vec3& x_F) const;
  Mat3 principal(const Mat3& m_F) const;
  bool has_principal_axes() const;  // whether the two are the same
  // Turns the file's vectors along principal axes.
  const Quaternion& q_FB() const;
  // The facets of the tables [[surface]]. ScenarioError if there are none.
  const Surface& surface() const;
  // The orbit that the key names.
  const ScenarioOrbit& orbit(std::string_view key) const;
  // The number of the key, else that of the orbit that `orbit` names; positive.
  double gm(std::string_view key, std::string_view orbit) const;
  // Null: that of the keys.
  const FieldOfTime* field() const { return parts_.field; }

 private:
  const TermParts& parts_;
  TermUses& uses_;
};

// The result of a table: a term, several, or a damper, which has a state of its own.
struct DamperAtStart {
  KaneDamper damper;
  Vec3 rate;  // relative to the body, principal axes
};
using MadeTerms = std::variant<AnyPerturbation, std::vector<AnyPerturbation>, DamperAtStart>;

// Texts are constant data: they outlive every kind.
struct PerturbationKind {
  std::string_view name;            // "residual-dipole"
  std::string_view help;            // one sentence that says what acts
  std::vector<Key> keys;            // paths are their own names
  std::string_view sets = {};       // exactly one of "times|file" is there; empty: none such
  std::vector<Citation> citations;  // what it rests on
  std::function<MadeTerms(const TermContext&)> made;
  bool on_surface = false;      // acts on the facets of [[surface]]
  bool on_body = false;         // may ask for the body
  bool in_field = false;        // acts in a magnetic field, that of its keys or any other
  bool needs_velocity = false;  // of its orbits
  bool has_terms = true;        // false: a damper
  // Of its class in Python: its name, if it is not that of the kind, and its equations.
  std::string_view class_name = {};  // "TidalTorque" of "tide"
  std::string_view equations = {};   // "u = m x B, H' = -m.B."
};

// A kind whose arguments are a plain struct A, filled by its keys. `principal` gives them along the
// principal axes, with all that files add to them; left out, they are so. What it returns is made
// again by `made` in a context of principal axes, to the same bits.
template <class A>
PerturbationKind perturbation_kind(std::string_view name, std::string_view help,
                                   std::span<const KindKey<A>> keys,
                                   MadeTerms (*made)(const A&, const TermContext&),
                                   const std::vector<Citation>& citations = {},
                                   A (*principal)(A, const TermContext&) = nullptr) {
  return {.name = name,
          .help = help,
          .keys = keys_of(keys),
          .citations = citations,
          .made = [all = std::vector<KindKey<A>>(keys.begin(), keys.end()), made,
                   principal](const TermContext& at) {
            A own = arguments<A>(all, at);
            if (principal != nullptr) own = principal(std::move(own), at);
            at.note(told<A>(all, own));
            return made(own, at);
          }};
}

// The defaults of its keys; none of a key without a default.
std::vector<KeyValue> defaults_of(const PerturbationKind& kind);
// Terms of a kind from values that a program gives, without a file, and from its defaults. `label`
// stands for the table in messages. DomainError for what the kind rejects.
struct TermsOfProgram {
  MadeTerms made;
  TermUses uses;
};
TermsOfProgram made_terms(const PerturbationKind& kind, std::span<const KeyValue> given,
                          std::span<const KeyValue> defaults, const TermParts& parts,
                          const std::string& label);

}  // namespace io
}  // namespace v0
}  // namespace polhode
