// SPDX-License-Identifier: MIT
// The table of the kinds of [[perturbation]], and what several of them ask.
#include "io/detail/perturbation_kinds.hpp"

#include <stdexcept>
#include <string_view>

#include "io/detail/scenario_parts.hpp"
#include "io/detail/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct PerturbationKind {
  std::string_view name;
  AnyPerturbation (*term)(const TermPlace&);
};

constexpr PerturbationKind kinds[] = {
    {"gravity-gradient", gravity_gradient_term},
    {"constant-torque", constant_torque_term},
    {"damping", damping_term},
    {"tide", tide_term},
    {"internal-damping", internal_damping_term},
    {"anelastic-damping", anelastic_damping_term},
    {"torque-table", torque_table_term},
};

}  // namespace

AnyPerturbation perturbation_of(const std::string& kind, const TermPlace& at) {
  for (const PerturbationKind& known : kinds)
    if (known.name == kind) return known.term(at);
  throw std::logic_error("perturbation: the schema allows a kind that has no row: " + kind);
}

const ScenarioOrbit& orbit_at(const TermPlace& at) {
  return orbit_named(at.scenario.orbits, at.values, at.key("orbit"), at.name);
}

double gm_at(const TermPlace& at) {
  const std::string key = at.key("gm");
  const bool own = there(at.values, key);
  const std::optional<double> gm = own ? number(at.values, key) : orbit_at(at).gm;
  if (!gm)
    refuse(at.values, at.key("orbit"), at.name,
           "expected a key gm beside it, since this orbit tells none");
  if (!(*gm > 0.0)) refuse(at.values, key, at.name, "expected a positive gravitational parameter");
  return *gm;
}

Vec3 principal_components(const TermPlace& at, const Vec3& x_F) {
  return rotate(conj(at.scenario.body.q_FB()), x_F);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
