// SPDX-License-Identifier: MIT
#include "polhode/scenario/scenario.hpp"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "polhode/rotor/attitude.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/map_plan.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/value_reader.hpp"
#include "scenario/values.hpp"
#include "tables/sadov_region.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::built;
using detail::Diagnostics;
using detail::given;
using detail::number;
using detail::sign;
using detail::there;
using detail::value_at;
using detail::Values;
using detail::vector;
using detail::word;

constexpr std::size_t largest_file = std::size_t{16} << 20;

Body body_of(const Values& values, const std::optional<ScenarioShape>& shape,
             const std::string& name) {
  if (there(values, "body.column_axes") && !there(values, "body.moments"))
    detail::refuse(values, "body.column_axes", name, "expected a key moments as well");
  if (shape) return built(values, "body.shape", name, [&] { return polhode::body(shape->inside); });
  if (there(values, "body.moments"))
    return built(values, "body.moments", name, [&] {
      const Vec3 I = vector(values, "body.moments");
      if (!there(values, "body.column_axes")) return Body(I.x, I.y, I.z);
      const std::vector<double>& q = value_at(values, "body.column_axes").numbers;
      return Body::with_axes(I, unit_quaternion(q.at(0), q.at(1), q.at(2), q.at(3)));
    });
  return built(values, "body.tensor", name, [&] {
    const std::vector<double>& n = value_at(values, "body.tensor").numbers;
    return Body::from_tensor(Mat3{
        {{n.at(0), n.at(1), n.at(2)}, {n.at(3), n.at(4), n.at(5)}, {n.at(6), n.at(7), n.at(8)}}});
  });
}

Vec3 direction(double longitude, double latitude) {
  return {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
          std::sin(latitude)};
}

// The pole in the axes of the state. Ecliptic and equator of J2000 share axis 1, the equinox.
Vec3 pole_of(const Values& values, const std::string& name) {
  const bool equatorial = there(values, "state.tumbler.pole.ra");
  const std::string path = "state.tumbler.pole.";
  const std::string latitude_key = path + (equatorial ? "dec" : "latitude");
  const double latitude = number(values, latitude_key);
  const std::string& axes = word(values, "state.axes");
  built(values, latitude_key, name, [&] {
    if (std::fabs(latitude) > 0.5 * std::numbers::pi * (1.0 + 1e-15))
      throw DomainError("expected an angle from -90 to 90 deg");
    if (equatorial && axes == "inertial")
      throw DomainError("ra and dec need axes = \"ecliptic-J2000\" or \"equator-J2000\"");
    return 0;
  });
  const Vec3 p = direction(number(values, path + (equatorial ? "ra" : "longitude")), latitude);
  if (axes == "inertial" || equatorial == (axes == "equator-J2000")) return p;
  return equatorial ? detail::ecliptic_from_equator(p) : detail::equator_from_ecliptic(p);
}

TumblerState tumbler_of(const Values& values, const std::string& name) {
  for (const char* period : {"state.tumbler.precession_period", "state.tumbler.rotation_period"})
    built(values, period, name, [&] {
      if (!(number(values, period) > 0.0)) throw DomainError("expected a positive time");
      return 0;
    });
  const bool short_axis = word(values, "state.tumbler.mode") == "SAM";
  return {.precession_period = number(values, "state.tumbler.precession_period"),
          .rotation_period = number(values, "state.tumbler.rotation_period"),
          .pole = pole_of(values, name),
          .mode = short_axis ? Regime::short_axis : Regime::long_axis,
          .phi0 = number(values, "state.tumbler.phi0"),
          .psi0 = number(values, "state.tumbler.psi0"),
          .branch = sign(values, "state.tumbler.branch"),
          .sense = sign(values, "state.tumbler.sense")};
}

// Whether the description has a state. Why not is said elsewhere.
bool has_state(const Body& body, const TumblerState& s) {
  try {
    static_cast<void>(to_rotor(body, s));
    return true;
  } catch (const DomainError&) {
    return false;
  }
}

// The library says it too, but in radians.
void require_psi(const Values& values, const Body& body, TumblerState s, const Units& units,
                 const std::string& name) {
  if (s.mode != Regime::short_axis || s.psi0 == 0.0 || has_state(body, s)) return;
  const double psi0 = std::exchange(s.psi0, 0.0);
  const double limit = built(values, "state.tumbler", name,
                             [&] { return psi_max(FreeRotation(body, to_rotor(body, s))); });
  built(values, "state.tumbler.psi0", name, [&] {
    if (std::fabs(psi0) > limit * (1.0 + 1e-15))
      throw DomainError("expected at most psi_max = " +
                        detail::number_text(units.from_core(limit, Dimension::angle)) + " " +
                        units.angle() + " on either side");
    return 0;
  });
}

AttitudeRate attitude_rate_of(const Values& values, const std::string& name) {
  const std::string path = "state.attitude-rate.";
  const auto attitude_of = [&]() -> Quaternion {
    if (!there(values, path + "quaternion"))
      return attitude(EulerAngles{number(values, path + "euler.phi"),
                                  number(values, path + "euler.theta"),
                                  number(values, path + "euler.psi")});
    return built(values, path + "quaternion", name, [&] {
      const std::vector<double>& n = value_at(values, path + "quaternion").numbers;
      return unit_quaternion(n.at(0), n.at(1), n.at(2), n.at(3));
    });
  };
  using enum AttitudeRate::Given;
  if (there(values, path + "omega_body"))
    return {attitude_of(), vector(values, path + "omega_body"), omega_body};
  if (there(values, path + "omega_inertial"))
    return {attitude_of(), vector(values, path + "omega_inertial"), omega_inertial};
  if (there(values, path + "omega_relative"))
    return {attitude_of(), vector(values, path + "omega_relative"), omega_relative};
  return {attitude_of(), vector(values, path + "momentum_body"), momentum_body};
}

SadovState sadov_of(const Values& values, const Body& body) {
  const auto value = [&](const char* key) {
    return number(values, std::string("state.sadov.") + key);
  };
  const double I_l = value("I_l"), I_g = value("I_g");
  const bool is_given = there(values, "state.sadov.region");
  const SadovRegion region =
      is_given ? (word(values, "state.sadov.region") == "SAM" ? SadovRegion::short_axis
                                                              : SadovRegion::long_axis)
               : detail::sadov_region(body, I_l, I_g);
  return {value("phi_l"),
          value("phi_g"),
          value("phi_h"),
          I_l,
          I_g,
          value("I_h"),
          region,
          sign(values, "state.sadov.lobe")};
}

InitialState state_of(const Values& values, const std::string& chart, const Body& body,
                      const std::string& name) {
  const std::string path = "state." + chart;
  const auto value = [&](const char* key) { return number(values, path + "." + key); };
  if (chart == "tumbler") return tumbler_of(values, name);
  if (chart == "attitude-rate") return attitude_rate_of(values, name);
  return built(values, path, name, [&]() -> InitialState {
    if (chart == "euler")
      return euler_state(value("phi"), value("theta"), value("psi"), value("Phi"), value("Theta"),
                         value("Psi"));
    if (chart == "andoyer")
      return andoyer_state(value("l"), value("g"), value("h"), value("L"), value("G"), value("H"));
    if (chart == "serret")
      return SerretState{value("g0"),
                         value("h"),
                         value("t0"),
                         value("G"),
                         value("H"),
                         value("T"),
                         sign(values, path + ".sign_g1"),
                         sign(values, path + ".sign_g3")};
    return sadov_of(values, body);
  });
}

std::optional<SaveAt> times_of(const Values& values, const std::string& name) {
  if (!there(values, "time")) return std::nullopt;
  const double start = number(values, "time.start");
  if (there(values, "time.at")) {
    if (given(values, "time.start"))
      return built(values, "time.start", name, []() -> std::optional<SaveAt> {
        throw DomainError("expected no start together with at, which lists every time");
      });
    return SaveAt::times(value_at(values, "time.at").numbers);
  }
  const double stop = number(values, "time.stop");
  if (there(values, "time.step"))
    return built(values, "time.step", name, [&]() -> std::optional<SaveAt> {
      return SaveAt::steps(start, stop, number(values, "time.step"));
    });
  return built(values, "time.count", name, [&]() -> std::optional<SaveAt> {
    return SaveAt::count(start, stop, value_at(values, "time.count").whole);
  });
}

std::string chart_of(const Values& values) {
  for (const std::string_view chart : state_charts())
    if (there(values, "state." + std::string(chart))) return std::string(chart);
  return {};
}

struct CloseFile {
  void operator()(std::FILE* file) const {
    if (file != stdin) std::fclose(file);
  }
};

std::string file_text(const std::string& path) {
  const std::string shown = detail::printable(path, largest_file);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw DomainError(shown + ": is a folder; expected a scenario file");
  errno = 0;
  const std::unique_ptr<std::FILE, CloseFile> file(path == "-" ? stdin
                                                               : std::fopen(path.c_str(), "rb"));
  if (!file) throw DomainError(shown + ": cannot be read: " + std::strerror(errno));
  std::string text(largest_file + 1, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  if (std::ferror(file.get()) != 0)
    throw DomainError(shown + ": cannot be read: " + std::strerror(errno));
  return text;
}

}  // namespace

Scenario scenario_from_text(std::string_view text, const std::string& name) {
  Diagnostics diagnostics(name);
  if (text.size() > largest_file) {
    diagnostics.add({}, "file", "got more than 16 MB; expected a scenario of at most 16 MB");
    diagnostics.raise();
  }
  const auto [values, units] = detail::read_values(text, scenario_schema(), diagnostics);
  diagnostics.raise();
  // first: what changes while it is read differs from what is noted here
  std::vector<ScenarioFile> files = detail::files_of(values, name);
  Scenario scenario = detail::scenario_of(values, units, text, name);
  scenario.files = std::move(files);
  return scenario;
}

Scenario detail::scenario_of(const Values& values, const Units& units, std::string_view text,
                             const std::string& name) {
  const std::string chart = chart_of(values);
  std::optional<ScenarioShape> shape = detail::shape_of(values, name);
  const Body body = body_of(values, shape, name);
  const std::optional<SaveAt> time = times_of(values, name);
  Scenario scenario{.name = std::filesystem::path(name).filename().string(),
                    .folder = std::filesystem::path(name).parent_path().string(),
                    .text = std::string(text),
                    .title = there(values, "title") ? word(values, "title") : "",
                    .units = units,
                    .body = body,
                    .q_file = there(values, "body.moments") ? Quaternion{} : body.q_FB(),
                    .chart = chart,
                    .state = state_of(values, chart, body, name),
                    .epoch = there(values, "state.epoch") ? word(values, "state.epoch") : "",
                    .axes = word(values, "state.axes"),
                    .orbits = detail::orbits_of({values, units, time, name}),
                    .shape = std::move(shape),
                    .method = detail::method_of(values, name),
                    .events = detail::events_of(values, units, name),
                    .time = time,
                    .columns = value_at(values, "output.columns").words,
                    .aem = detail::aem_options_of(values, name),
                    .writes_aem = there(values, "output.aem")};
  detail::add_motion(scenario, values, name);
  if (const TumblerState* tumbler = std::get_if<TumblerState>(&scenario.state))
    require_psi(values, body, *tumbler, units, name);
  built(values, "state." + chart, name, [&] { return free_rotation(scenario); });
  detail::check_motion(scenario, values, name);
  if (there(values, "map")) scenario.map = detail::map_plan(values, units, scenario, name);
  return scenario;
}

Scenario read_scenario(const std::string& path) {
  return scenario_from_text(file_text(path), path == "-" ? "<stdin>" : path);
}

}  // namespace v0
}  // namespace polhode
