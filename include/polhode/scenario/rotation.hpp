// SPDX-License-Identifier: MIT
// Rotation: what a scenario of kind "rotation" describes: a real body, its state at an epoch, what
// acts on it and when rows are wanted. It knows no text and no output.
//
// Equations   none of its own; each chart is converted by its description.
// Units       core units (polhode/text/units.hpp): the unit of time of the file, radians, its unit
//             of moment.
// Domain      a full tensor gives principal axes; the body axes of the file (attitude-rate,
//             torques, columns of body components) stay those of the tensor. The state is that in
//             the reference frame S at t = 0.
// Accuracy    that of the charts.
// Errors      DomainError from rotor_problem without [time].
// Cost        copies share meshes, surfaces, tables, terms and the prepared motion.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "polhode/dynamics/event.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/dynamics/problem.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/shape/mass_properties.hpp"
#include "polhode/shape/surface.hpp"
#include "polhode/system/system.hpp"
#include "polhode/tables/convert.hpp"
#include "polhode/text/key_values.hpp"
#include "polhode/trajectory/save_at.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// [state.attitude-rate], in the body axes of the file.
struct AttitudeRate {
  Quaternion q;  // body axes of the file to inertial
  Vec3 vector;   // what `given` names
  enum class Given { omega_body, omega_inertial, omega_relative, momentum_body };
  Given given = Given::omega_body;
};

// [state.CHART]: observers' words and an attitude with a rate are more than numbers of a chart.
using InitialState = std::variant<TumblerState, AttitudeRate, ChartState>;

// [[surface]] shape = "FILE", in core units of length.
struct NamedMesh {
  std::string file;  // as the scenario names it
  shape::FacetShape mesh;
};

// [body] shape = "FILE"
struct ScenarioShape {
  std::string file;              // as the scenario names it
  shape::FacetShape mesh;        // in core units of length
  shape::MassProperties inside;  // at its density
};

// [orbit.NAME]
struct ScenarioOrbit {
  std::string name = {};
  // Files have the first four; a program may give a term any orbit.
  std::variant<KeplerOrbit, PrecessingKeplerOrbit, TableOrbit, TurnedKeplerOrbit, AnyOrbit> motion;
  std::optional<double> gm;               // of the attracting body, if the orbit has it
  std::vector<std::string> sources = {};  // of its positions: "ephemeris", "moon", "oem"
  std::string text = {};  // of a table: "table iss.csv.gz", "ephemeris, moon from earth"
  // Of a table of rows as they were given, between them: a part of the distance, estimated. NaN:
  // too few rows to tell.
  std::optional<double> interpolation_error = std::nullopt;
  std::vector<std::string> warnings = {};  // "FILE:LINE:COLUMN: ..."
  std::string kind = {};                   // "kepler", ...
};
// The elements of an orbit that has them.
const KeplerElements* kepler_elements(const ScenarioOrbit& orbit);
AnyOrbit any_orbit(const ScenarioOrbit& orbit);

// [frame.precessing]
struct Precession {
  Vec3 axis;
  double rate;
  double epoch;
};

// [[event]]
struct ScenarioEvent {
  std::string name;
  std::string column;
  double value;
  Crossing crossing;
  bool stops;
  double interval;  // 0: looks follow the rotation
};

// The arguments of a table [[perturbation]], along the principal axes, with everything that the
// file adds to them. `values` is null if the kind keeps none.
struct TermArguments {
  std::size_t terms = 0;  // number of terms that it made
  std::shared_ptr<const std::vector<KeyValue>> values = nullptr;
};

// The parts that runs and summaries of a rotation share, prepared once when its file is read.
struct PreparedMotion {
  System system;       // body, frame, terms and damper
  FreeRotation free;   // through the state of the file, in the axes of S
  RotorState initial;  // (q_SB, g_B) at t = 0
};

struct Rotation {
  Body body;
  Quaternion q_file;  // principal axes to those that the file gives vectors in: the tensor's
  std::string chart;  // "tumbler", ...: what `state` holds
  InitialState state;
  std::string epoch;  // "2013-01-05T00:00:00 UTC", or empty
  std::string axes;   // "inertial", "ecliptic-J2000", "equator-J2000"
  Frame frame = Frame::inertial();
  std::string frame_text = "inertial";                  // or "precessing", "plane of orbit moon"
  std::optional<Precession> precession = std::nullopt;  // of a precessing frame
  std::vector<ScenarioOrbit> orbits = {};
  std::shared_ptr<const ScenarioShape> shape = nullptr;  // where the body has one
  std::shared_ptr<const Surface> surface = nullptr;      // along the principal axes, or none
  std::vector<NamedMesh> surface_meshes = {};            // that it was made of, for summaries
  std::vector<AnyPerturbation> terms = {};
  std::optional<KaneDamper> damper = std::nullopt;
  Vec3 damper_rate = {};                        // at t = 0, relative to the body, principal axes
  std::vector<std::string> kinds = {};          // of all perturbations: "gravity-gradient"
  std::vector<TermArguments> arguments = {};    // one for each
  std::optional<Method> method = std::nullopt;  // left out: see propagation_method
  std::vector<ScenarioEvent> events = {};
  std::optional<SaveAt> time = std::nullopt;               // left out: nothing to run
  std::shared_ptr<const PreparedMotion> motion = nullptr;  // of what stands above
};

// Its prepared motion; they live as long as it does.
inline const System& rotor_system(const Rotation& rotation) { return rotation.motion->system; }
inline const RotorState& initial_state(const Rotation& rotation) {
  return rotation.motion->initial;
}
inline const FreeRotation& free_rotation(const Rotation& rotation) { return rotation.motion->free; }

// The method of the file. Left out: none where nothing acts, which means exact free rotation;
// otherwise default_rotor_method.
std::optional<Method> propagation_method(const Rotation& rotation);

const std::optional<SaveAt>& row_times(const Rotation& rotation);
bool has_events(const Rotation& rotation);

// From t = 0 to the last row, without its events; of exact free rotation as default_rotor_method
// would run it.
Problem rotor_problem(const Rotation& rotation);
// The energy at its start; 0 if a term has none.
double initial_energy(const Problem& problem);

}  // namespace io
}  // namespace v0
}  // namespace polhode
