// SPDX-License-Identifier: MIT
// What a kind of torque asks of the parts of the rotation that stand before it, and terms that a
// program makes.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "polhode/scenario/perturbation_kind.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

TermParts parts_of(const Rotation& rotation) {
  return {.body = &rotation.body,
          .q_FB = rotation.q_file,
          .surface = rotation.surface.get(),
          .orbits = &rotation.orbits};
}

const Body& TermContext::body() const {
  uses_.body = true;
  uses_.body_with_arguments = uses_.arguments != nullptr;
  if (parts_.body == nullptr) refuse("body", "expected the body, since the term needs it");
  return *parts_.body;
}

const Quaternion& TermContext::q_FB() const {
  uses_.file_axes = true;
  return parts_.q_FB;
}

bool TermContext::has_principal_axes() const { return q_FB() == Quaternion{}; }

Vec3 TermContext::principal(const Vec3& x_F) const { return rotate(conj(q_FB()), x_F); }

Mat3 TermContext::principal(const Mat3& m_F) const {
  const Mat3 R = rotation_matrix(q_FB());  // v_F = R v_B
  const Mat3 m = has_principal_axes() ? m_F : transpose(R) * m_F * R;
  Mat3 even = m;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) even(i, k) = 0.5 * (m(i, k) + m(k, i));
  return even;
}

const Surface& TermContext::surface() const {
  uses_.surface = true;
  if (parts_.surface == nullptr)
    refuse("kind", "expected a table [[surface]], since it acts on facets");
  return *parts_.surface;
}

const ScenarioOrbit& TermContext::orbit(std::string_view key) const {
  if (!has(key)) refuse(key, "expected the name of a table [orbit.NAME]");
  const ScenarioOrbit& found = detail::orbit_named(*parts_.orbits, values(), key_path(key), file());
  uses_.orbits.push_back(static_cast<std::size_t>(&found - parts_.orbits->data()));
  return found;
}

double TermContext::gm(std::string_view key, std::string_view orbit_key) const {
  if (has(key)) {
    if (!(number(key) > 0.0)) refuse(key, "expected a positive gravitational parameter");
    return number(key);
  }
  const std::optional<double> of_orbit = orbit(orbit_key).gm;
  if (!of_orbit)
    refuse(orbit_key, "expected a key " + std::string(key) + " as well, since this orbit has none");
  if (!(*of_orbit > 0.0))
    refuse(orbit_key, "expected an orbit of a positive gravitational parameter");
  return *of_orbit;
}

namespace {

// "GravityGradient: gm: got -1.0; expected ..." of what a kind says of its table.
std::string said_of(const std::string& label, std::string text) {
  const std::string table = label + ": kind: got nothing; ";
  if (text.starts_with(table)) text.erase(0, table.size());
  return text.starts_with(label + ":") ? text : label + ": " + text;
}

}  // namespace

std::vector<KeyValue> defaults_of(const PerturbationKind& kind) {
  std::vector<KeyValue> all;
  for (const Key& key : kind.keys) {
    if (key.fallback.empty()) continue;
    detail::Value value = detail::value_of(key, key.fallback);
    all.push_back({key.path, std::move(value.numbers), std::move(value.words), value.whole,
                   std::move(value.shown)});
  }
  return all;
}

TermsOfProgram made_terms(const PerturbationKind& kind, std::span<const KeyValue> given,
                          std::span<const KeyValue> defaults, const TermParts& parts,
                          const std::string& label) {
  detail::Values values;
  for (const Key& key : kind.keys) {
    const KeyValue* said = nullptr;
    const auto look_in = [&](std::span<const KeyValue> all) {
      const auto found = std::ranges::find(all, key.path, &KeyValue::key);
      if (found != all.end()) said = &*found;
    };
    look_in(given);
    const bool is_given = said != nullptr;
    if (!is_given) look_in(defaults);
    if (said != nullptr)
      values.emplace(key.path, detail::Value{.key = &key,
                                             .where = detail::nowhere,
                                             .is_explicit = is_given,
                                             .shown = said->shown,
                                             .numbers = said->numbers,
                                             .units = {},
                                             .words = said->words,
                                             .whole = said->whole});
  }
  static const Units units;
  TermUses uses;
  const TermContext at(KeyValues(values, units, "", label), parts, uses);
  try {
    MadeTerms made = kind.made(at);
    return {std::move(made), std::move(uses)};
  } catch (const DomainError& error) {  // a ScenarioError too
    throw DomainError(said_of(label, error.what()));
  }
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
