// SPDX-License-Identifier: MIT
// The table of the kinds of [[perturbation]], and what several of them ask.
#include "scenario/detail/perturbation_kinds.hpp"

#include <stdexcept>
#include <string_view>

#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct PerturbationKind {
  std::string_view name;
  AnyPerturbation (*term)(const TermContext&);
};

constexpr PerturbationKind kinds[] = {
    {"constant-torque", constant_torque_term},
    {"damping", damping_term},
    {"tide", tide_term},
    {"internal-damping", internal_damping_term},
    {"anelastic-damping", anelastic_damping_term},
    {"torque-table", torque_table_term},
    {"solar-pressure", solar_pressure_term},
    {"drag", drag_term},
    {"residual-dipole", residual_dipole_term},
    {"eddy-currents", eddy_currents_term},
};

}  // namespace

std::vector<AnyPerturbation> perturbations_of(const std::string& kind, const TermContext& at) {
  if (kind == "gravity-gradient") return gravity_terms(at);
  for (const PerturbationKind& known : kinds)
    if (known.name == kind) return {known.term(at)};
  throw std::logic_error("perturbation: the schema allows a kind that has no row: " + kind);
}

const ScenarioOrbit& TermContext::orbit(const char* own) const {
  const ScenarioOrbit& found = orbit_named(rotation_.orbits, values, key(own), name);
  uses_.orbits.push_back(static_cast<std::size_t>(&found - rotation_.orbits.data()));
  return found;
}

const ScenarioOrbit& orbit_at(const TermContext& at) { return at.orbit("orbit"); }

double gm_at(const TermContext& at) {
  const std::string key = at.key("gm");
  const bool own = has(at.values, key);
  const std::optional<double> gm = own ? number(at.values, key) : orbit_at(at).gm;
  if (!gm)
    refuse(at.values, at.key("orbit"), at.name,
           "expected a key gm as well, since this orbit has none");
  if (!(*gm > 0.0)) refuse(at.values, key, at.name, "expected a positive gravitational parameter");
  return *gm;
}

double positive_at(const TermContext& at, const char* own) {
  const std::string key = at.key(own);
  const double x = number(at.values, key);
  if (x > 0.0) return x;
  std::string what(dimension_name(value_at(at.values, key).key->dimension));
  what.erase(0, what.find(' ') + 1);
  refuse(at.values, key, at.name,
         "expected a positive " + (what == "pure number" ? "number" : what));
}

Vec3 principal_components(const TermContext& at, const Vec3& x_F) {
  return rotate(conj(at.q_FB()), x_F);
}

Mat3 matrix_at(const TermContext& at, const char* own) {
  const std::vector<double>& n = value_at(at.values, at.key(own)).numbers;
  if (n.size() == 3) return {{{n[0], 0.0, 0.0}, {0.0, n[1], 0.0}, {0.0, 0.0, n[2]}}};
  return {{{n.at(0), n.at(1), n.at(2)}, {n.at(3), n.at(4), n.at(5)}, {n.at(6), n.at(7), n.at(8)}}};
}

Mat3 principal_matrix(const TermContext& at, const Mat3& m_F) {
  const Quaternion& q_FB = at.q_FB();
  if (q_FB == Quaternion{}) return m_F;
  const Mat3 R = rotation_matrix(q_FB);  // v_F = R v_B
  const Mat3 m = transpose(R) * m_F * R;
  Mat3 even = m;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) even(i, k) = 0.5 * (m(i, k) + m(k, i));
  return even;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
