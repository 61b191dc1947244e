// SPDX-License-Identifier: MIT
// The kinds of [[perturbation]]: for each a function that makes the term from the values of a file.
// Their keys are in schema_perturbations.cpp. A kind is one function here and one row of the table.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "polhode/scenario/scenario.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Which parts of the rotation a term was made of, next to its own keys: it is made again when one
// of them changes.
struct TermUses {
  bool body = false;
  bool file_axes = false;
  bool surface = false;
  std::vector<std::size_t> orbits;  // by their numbers
};

// Where a term is made: its own table, and the parts of the rotation that stand before it. What is
// asked for is noted.
class TermContext {
 public:
  TermContext(const Rotation& rotation, const Values& all_values, const Units& all_units,
              const std::string& of_term, const std::string& file, TermUses& noted)
      : values(all_values),
        units(all_units),
        path(of_term),
        name(file),
        rotation_(rotation),
        uses_(noted) {}

  const Values& values;
  const Units& units;
  const std::string& path;  // "perturbation[0]"
  const std::string& name;  // of the file, for messages

  std::string key(const char* own) const { return path + "." + own; }
  const Body& body() const {
    uses_.body = true;
    return rotation_.body;
  }
  // Principal axes to those of the file.
  const Quaternion& q_FB() const {
    uses_.file_axes = true;
    return rotation_.q_file;
  }
  const Surface* surface() const {
    uses_.surface = true;
    return rotation_.surface.get();
  }
  // The orbit that the key `own` of the table names.
  const ScenarioOrbit& orbit(const char* own) const;

 private:
  const Rotation& rotation_;
  TermUses& uses_;
};

// What a table stands for: one term; of gravity one for each part of it that the table has.
// Throws a ScenarioError at the place of what is wrong.
std::vector<AnyPerturbation> perturbations_of(const std::string& kind, const TermContext& at);

// The orbit that the table names, and the gm of what attracts: its own key, else the orbit's.
const ScenarioOrbit& orbit_at(const TermContext& at);
double gm_at(const TermContext& at);
// A number of the table that has to be above zero.
double positive_at(const TermContext& at, const char* own);
// Components along the body axes of the file, which are those of its tensor, as principal ones.
Vec3 principal_components(const TermContext& at, const Vec3& x_F);
// A matrix of the table, and a symmetric one along those axes as one along principal axes.
Mat3 matrix_at(const TermContext& at, const char* own);
Mat3 principal_matrix(const TermContext& at, const Mat3& m_F);

// [[perturbation]] of kind "kane-damper", which is no term: a scenario has one at most.
inline constexpr const char* kane_damper_kind = "kane-damper";
struct DamperAtStart {
  KaneDamper damper;
  Vec3 rate;  // relative to the body, principal axes
};
DamperAtStart kane_damper(const TermContext& at);

std::vector<AnyPerturbation> gravity_terms(const TermContext& at);
AnyPerturbation constant_torque_term(const TermContext& at);
AnyPerturbation damping_term(const TermContext& at);
AnyPerturbation tide_term(const TermContext& at);
AnyPerturbation internal_damping_term(const TermContext& at);
AnyPerturbation anelastic_damping_term(const TermContext& at);
AnyPerturbation torque_table_term(const TermContext& at);
AnyPerturbation solar_pressure_term(const TermContext& at);
AnyPerturbation drag_term(const TermContext& at);
AnyPerturbation residual_dipole_term(const TermContext& at);
AnyPerturbation eddy_currents_term(const TermContext& at);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
