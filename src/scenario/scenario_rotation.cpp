// SPDX-License-Identifier: MIT
// Makes the orbits of a rotation from the values of a file, its state and the problem that
// its run solves.
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "polhode/orbit/any_orbit.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/state.hpp"
#include "scenario/values.hpp"
#include "text/value_access.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
const KeplerElements* kepler_elements(const ScenarioOrbit& orbit) {
  if (const auto* fixed = std::get_if<KeplerOrbit>(&orbit.motion)) return &fixed->elements();
  if (const auto* moving = std::get_if<PrecessingKeplerOrbit>(&orbit.motion))
    return &moving->elements();
  return nullptr;
}

AnyOrbit any_orbit(const ScenarioOrbit& orbit) {
  if (const AnyOrbit* any = std::get_if<AnyOrbit>(&orbit.motion)) return *any;
  return std::visit([&](const auto& motion) { return AnyOrbit(orbit.name, motion); }, orbit.motion);
}

std::string OrbitContext::state_axes() const { return detail::state_table(file_values())->axes; }

std::optional<TimeSpan> OrbitContext::run_span() const {
  uses_.time = true;
  if (!rows_) return std::nullopt;
  TimeSpan span;
  const SaveAt& rows = *rows_;
  const bool listed = rows.is_list();  // in any order
  for (std::int64_t k = 0; k < rows.size(); k = listed ? k + 1 : k + rows.size() - 1) {
    span = {std::min(span.first, rows[k]), std::max(span.last, rows[k])};
    if (rows.size() == 1) break;
  }
  if (!listed) span = {std::min(span.first, rows.end()), std::max(span.last, rows.end())};
  return span;
}

namespace detail {

const ScenarioOrbit& orbit_named(const std::vector<ScenarioOrbit>& orbits, const Values& values,
                                 const std::string& path, const std::string& name) {
  const std::string& wanted = word(values, path);
  std::vector<std::string_view> known;
  for (const ScenarioOrbit& orbit : orbits) {
    if (orbit.name == wanted) return orbit;
    known.push_back(orbit.name);
  }
  if (known.empty()) refuse(values, path, name, "expected a table [orbit." + wanted + "]");
  refuse(
      values, path, name,
      "expected the name of an orbit of this file: " + one_of(known) + did_you_mean(wanted, known));
}

std::vector<std::string> orbit_paths(const Values& values) {
  std::vector<std::string> paths;
  for (const auto& [path, value] : values)
    if (value.key->path == "orbit.*") paths.push_back(path);
  return paths;
}

ScenarioOrbit orbit_of(const OrbitsContext& at, const std::string& path, OrbitUses& uses) {
  const std::string& name = word(at.values, path + ".kind");
  const OrbitKind* const kind = at.kinds.orbit(name);
  if (kind == nullptr)
    throw std::logic_error("orbit: the schema allows a kind without a description: " + name);
  const KeyValues table(at.values, at.units, path, at.name);
  ScenarioOrbit made =
      table.built("kind", [&] { return kind->made(OrbitContext(table, at.time, uses)); });
  made.name = key_name(path);
  made.kind = name;
  return made;
}

}  // namespace detail

namespace {

// From the chart of a rotation to the quaternion-momentum state.
struct ToMotion {
  const Body& body;
  const Quaternion& q_file;
  FrameMotion frame;        // at t = 0
  Vec3 momentum_of_damper;  // in addition to I w, body axes

  FreeRotation operator()(const TumblerState& s) const {
    return FreeRotation(body, to_rotor(body, s));
  }
  FreeRotation operator()(const AttitudeRate& s) const { return FreeRotation(body, hub_state(s)); }
  FreeRotation operator()(const ChartState& s) const { return free_rotation(body, s); }

  RotorState hub_state(const AttitudeRate& s) const {
    // without a tensor the numbers of the file, bit for bit
    const bool principal = q_file == Quaternion{};
    const Quaternion q = principal ? s.q : s.q * q_file;
    const Vec3 along_B = principal ? s.vector : rotate(conj(q_file), s.vector);
    if (s.given == AttitudeRate::Given::momentum_body)
      return {unit_quaternion(q.w, q.x, q.y, q.z), along_B};
    return with_damper(s.given == AttitudeRate::Given::omega_inertial
                           ? rotor_state_inertial(body, q, rotate(conj(frame.q_IS), s.vector))
                       : s.given == AttitudeRate::Given::omega_body
                           ? rotor_state(body, q, along_B)
                           : rotor_state(body, q, along_B + rotate(conj(q), frame.mu_S)));
  }
  // g = I w + J s
  RotorState with_damper(RotorState s) const {
    if (momentum_of_damper != Vec3{}) s.g = s.g + momentum_of_damper;
    return s;
  }
};

}  // namespace

void detail::prepare_motion(Rotation& rotation, const FileValues& file) {
  const double J = rotation.damper ? rotation.damper->moment() : 0.0;
  const FreeRotation motion = built(file.values, "state." + rotation.chart, file.name, [&] {
    return std::visit(
        ToMotion{rotation.body, rotation.q_file, rotation.frame.at(0.0), J * rotation.damper_rate},
        rotation.state);
  });
  // Serret's elements have their own epoch; what others give is the state itself
  rotation.motion = std::make_shared<const PreparedMotion>(
      PreparedMotion{System(rotation.body, rotation.frame, rotation.terms, rotation.damper), motion,
                     motion.epoch() == 0.0 ? motion.initial_state() : motion.at(0.0)});
}

std::optional<Method> propagation_method(const Rotation& rotation) {
  if (rotation.method) return rotation.method;
  if (rotation.terms.empty() && !rotation.damper) return std::nullopt;
  return default_rotor_method;
}

const std::optional<SaveAt>& row_times(const Rotation& rotation) { return rotation.time; }
bool has_events(const Rotation& rotation) { return !rotation.events.empty(); }

Problem rotor_problem(const Rotation& rotation) {
  if (!rotation.time) throw DomainError("rotor_problem: got no [time]; expected its rows");
  const SaveAt& rows = *rotation.time;
  const RotorState& s = initial_state(rotation);
  return {rotor_system(rotation),
          {s.q, s.g, rotation.damper_rate},
          0.0,
          rows.end(),
          propagation_method(rotation).value_or(default_rotor_method)};
}

double initial_energy(const Problem& problem) {
  if (!problem.system.has_energy()) return 0.0;
  const SystemState& s = problem.initial;
  return energy(at_damper_rate(problem.system, s.damper_rate), problem.start, s);
}

const Rotation& detail::rotation_of(const Experiment& experiment) {
  if (const auto* own = std::get_if<CustomExperiment>(&experiment))
    throw DomainError("kind: got \"" + own->kind + "\"; expected \"rotation\"");
  if (std::holds_alternative<Obliquity>(experiment))
    throw DomainError("kind: got \"obliquity\"; expected \"rotation\"");
  return std::get<Rotation>(experiment);
}

const Rotation& Scenario::rotation() const { return detail::rotation_of(experiment); }

const std::optional<SaveAt>& detail::rows_of(const Experiment& experiment) {
  return std::visit([](const auto& kind) -> const auto& { return row_times(kind); }, experiment);
}
const std::optional<SaveAt>& row_times(const Scenario& scenario) {
  return detail::rows_of(scenario.experiment);
}
bool has_events(const Scenario& scenario) {
  return std::visit([](const auto& kind) { return has_events(kind); }, scenario.experiment);
}
std::optional<Method> propagation_method(const Scenario& scenario) {
  return std::visit([](const auto& kind) { return propagation_method(kind); }, scenario.experiment);
}
Problem problem(const Experiment& experiment) {
  return rotor_problem(detail::rotation_of(experiment));
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
