// SPDX-License-Identifier: MIT
// A scenario: a real body, its state at an epoch, what acts on it, and what to write, read from a
// TOML file and checked completely. The keys are in polhode/scenario/schema.hpp.
//
// Equations   none of its own; each chart is converted by its header in rotor/ and free/.
// Units       numbers are in core units (polhode/text/units.hpp): the unit of time of the file,
//             radians, its unit of moment.
// Domain      files of at most 16 MB, UTF-8. A full tensor gives principal axes; the body axes of
//             the file (attitude-rate, torques, columns of body components) stay those of the
//             tensor. The state is that in the reference frame S at t = 0.
// Accuracy    numbers are read to the nearest double; a unit costs at most two roundings.
//             Paths of further files are relative to the folder of the scenario.
// Errors      ScenarioError: one line per mistake, FILE:LINE:COLUMN: KEY: got VALUE; expected ...,
//             sorted by place, at most twenty. What a chart or body refuses is reported there too.
// Cost        milliseconds, of which one preparation of the motion.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "polhode/analysis/section.hpp"
#include "polhode/dynamics/event.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/precessing_kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/orbit/turned_kepler_orbit.hpp"
#include "polhode/output/aem_options.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/shape/mass_properties.hpp"
#include "polhode/shape/surface.hpp"
#include "polhode/system/system.hpp"
#include "polhode/text/units.hpp"
#include "polhode/trajectory/save_at.hpp"

namespace polhode {
inline namespace v0 {

// Every mistake of a file; what() holds one line for each.
class ScenarioError : public DomainError {
 public:
  using DomainError::DomainError;
};

// [state.attitude-rate], in the body axes of the file.
struct AttitudeRate {
  Quaternion q;  // body axes of the file to inertial
  Vec3 vector;   // what `given` names
  enum class Given { omega_body, omega_inertial, omega_relative, momentum_body };
  Given given = Given::omega_body;
};

using InitialState =
    std::variant<TumblerState, AttitudeRate, EulerState, AndoyerState, SerretState, SadovState>;

// [body] shape = "FILE"
struct ScenarioShape {
  std::string file;       // as the scenario names it
  FacetShape mesh;        // in core units of length
  MassProperties inside;  // at its density
};

// [orbit.NAME]
struct ScenarioOrbit {
  std::string name;
  std::variant<KeplerOrbit, PrecessingKeplerOrbit, TableOrbit, TurnedKeplerOrbit> motion;
  std::optional<double> gm;               // of what attracts, where the orbit tells
  std::vector<std::string> sources = {};  // of its positions: "ephemeris", "moon", "oem"
  std::string text = {};  // of a table: "table iss.csv.gz", "ephemeris, moon from earth"
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
  double value;  // core units
  Crossing crossing;
  bool stops;
  double interval;  // 0: looks follow the rotation
};

// [map]
enum class MapKind { chaos, column, andoyer_section, spin_orbit_section };
struct MapAxis {
  std::string key;
  double from;  // in the unit of the file, as `to` is
  double to;
  std::int64_t count;
  std::string unit;
};
struct MapPlan {
  MapKind kind;
  std::string column = {};         // of MapKind::column
  SectionSurface surface = {};     // of MapKind::andoyer_section
  std::string orbit = {};          // of MapKind::spin_orbit_section
  std::vector<MapAxis> axes = {};  // a section may have none: one start
};

// A file that the scenario names: a table, a mesh, an OEM. As it was when it was read.
struct ScenarioFile {
  std::string path;  // as the scenario names it
  std::int64_t bytes;
  std::uint64_t mark;  // FNV-1a of its bytes

  constexpr bool operator==(const ScenarioFile&) const = default;
};
// "moon.csv.gz: 12345 bytes, mark 1234567890123456789"
std::string file_note(const ScenarioFile& file);

struct Scenario {
  std::string name;    // of the file, without its folder: "apophis.toml"
  std::string folder;  // of the file: paths in it start there; empty is the working folder
  std::string text;    // the file itself
  std::string title;   // may be empty
  Units units;
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
  std::optional<ScenarioShape> shape = std::nullopt;  // where the body has one
  std::optional<Surface> surface = std::nullopt;      // along the principal axes
  std::vector<AnyPerturbation> terms = {};
  std::optional<KaneDamper> damper = std::nullopt;
  Vec3 damper_rate = {};                        // at t = 0, relative to the body, principal axes
  std::vector<std::string> kinds = {};          // of all perturbations: "gravity-gradient"
  std::optional<Method> method = std::nullopt;  // left out: see propagation_method
  std::vector<ScenarioEvent> events = {};
  std::optional<SaveAt> time;        // left out: nothing to run
  std::vector<std::string> columns;  // names of column groups
  AemOptions aem = {};               // [output.aem]
  bool writes_aem = false;           // whether the file has that table
  std::optional<MapPlan> map = std::nullopt;
  std::vector<ScenarioFile> files = {};  // each once, by path
};

// `name` stands for the file in messages and outputs.
Scenario scenario_from_text(std::string_view text, const std::string& name);
// "-" is standard input. DomainError when there is no such file, or it is a folder.
Scenario read_scenario(const std::string& path);

// Body, frame, terms and damper.
System rotor_system(const Scenario& scenario);
// The hub state (q_SB, g_B) at t = 0, and the free motion through it in the axes of S.
RotorState initial_state(const Scenario& scenario);
FreeRotation free_rotation(const Scenario& scenario);

// The method of the file. Left out: none where nothing acts, which means exact free rotation;
// otherwise Adaptive.
std::optional<Method> propagation_method(const Scenario& scenario);

}  // namespace v0
}  // namespace polhode
