// SPDX-License-Identifier: MIT
// The kinds of [[perturbation]]: for each a function that makes the term from the values of a file.
// Their keys are in schema_perturbations.cpp. A kind is one function here and one row of the table.
#pragma once

#include <string>
#include <vector>

#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Where a term is made: everything of the scenario that stands before it, and its own table.
struct TermPlace {
  const Scenario& scenario;  // body, frame and orbits are there
  const Values& values;
  const std::string& path;  // "perturbation[0]"
  const std::string& name;  // of the file, for messages

  std::string key(const char* own) const { return path + "." + own; }
};

// What a table stands for: one term; of gravity one for each part of it that the table has.
// Throws a ScenarioError at the place of what is wrong.
std::vector<AnyPerturbation> perturbations_of(const std::string& kind, const TermPlace& at);

// The orbit that the table names, and the gm of what attracts: its own key, else the orbit's.
const ScenarioOrbit& orbit_at(const TermPlace& at);
double gm_at(const TermPlace& at);
// A number of the table that has to be above zero.
double positive_at(const TermPlace& at, const char* own);
// Components along the body axes of the file, which are those of its tensor, as principal ones.
Vec3 principal_components(const TermPlace& at, const Vec3& x_F);
// A matrix of the table, and a symmetric one along those axes as one along principal axes.
Mat3 matrix_at(const TermPlace& at, const char* own);
Mat3 principal_matrix(const TermPlace& at, const Mat3& m_F);

// [[perturbation]] of kind "kane-damper", which is no term: a scenario has one at most.
inline constexpr const char* kane_damper_kind = "kane-damper";
void add_kane_damper(Scenario& scenario, const Values& values, const std::string& path,
                     const std::string& name);

std::vector<AnyPerturbation> gravity_terms(const TermPlace& at);
AnyPerturbation constant_torque_term(const TermPlace& at);
AnyPerturbation damping_term(const TermPlace& at);
AnyPerturbation tide_term(const TermPlace& at);
AnyPerturbation internal_damping_term(const TermPlace& at);
AnyPerturbation anelastic_damping_term(const TermPlace& at);
AnyPerturbation torque_table_term(const TermPlace& at);
AnyPerturbation solar_pressure_term(const TermPlace& at);
AnyPerturbation drag_term(const TermPlace& at);
AnyPerturbation residual_dipole_term(const TermPlace& at);
AnyPerturbation eddy_currents_term(const TermPlace& at);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
