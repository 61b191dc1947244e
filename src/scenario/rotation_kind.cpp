// SPDX-License-Identifier: MIT
// The experiment of kind "rotation" from the values of a file.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/rotor/attitude.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/made_experiments.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

Body body_of(const Values& values, const ScenarioShape* shape, const std::string& name) {
  if (has(values, "body.column_axes") && !has(values, "body.moments"))
    refuse(values, "body.column_axes", name, "expected a key moments as well");
  if (shape) return built(values, "body.shape", name, [&] { return polhode::body(shape->inside); });
  if (has(values, "body.moments"))
    return built(values, "body.moments", name, [&] {
      const Vec3 I = vector(values, "body.moments");
      if (!has(values, "body.column_axes")) return Body(I.x, I.y, I.z);
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
  const bool equatorial = has(values, "state.tumbler.pole.ra");
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
  return equatorial ? ecliptic_from_equator(p) : equator_from_ecliptic(p);
}

// P_phi of the long axis, which may be given by that of the short one.
double precession_period_of(const Values& values, const std::string& name) {
  const std::string path = "state.tumbler.";
  require_range(values, path + "rotation_period", name);
  if (has(values, path + "precession_period")) {
    require_range(values, path + "precession_period", name);
    return number(values, path + "precession_period");
  }
  const std::string own = path + "short_axis_period";
  require_range(values, own, name);
  return built(values, own, name, [&] {
    const double given = number(values, own), rotation = number(values, path + "rotation_period");
    if (!(given < rotation))
      throw DomainError(
          "expected a period shorter than rotation_period: the short axis goes round "
          "faster than the long one, by a turn in that time");
    return long_axis_period(given, rotation);
  });
}

TumblerState tumbler_of(const Values& values, const std::string& name) {
  const double precession = precession_period_of(values, name);
  const bool short_axis = word(values, "state.tumbler.mode") == "SAM";
  return {.precession_period = precession,
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
      throw DomainError(
          "expected at most psi_max = " + number_text(units.from_core(limit, Dimension::angle)) +
          " " + units.angle() + " on either side");
    return 0;
  });
}

AttitudeRate attitude_rate_of(const Values& values, const std::string& name) {
  const std::string path = "state.attitude-rate.";
  const auto attitude_of = [&]() -> Quaternion {
    if (!has(values, path + "quaternion"))
      return attitude(EulerAngles{number(values, path + "euler.phi"),
                                  number(values, path + "euler.theta"),
                                  number(values, path + "euler.psi")});
    return built(values, path + "quaternion", name, [&] {
      const std::vector<double>& n = value_at(values, path + "quaternion").numbers;
      return unit_quaternion(n.at(0), n.at(1), n.at(2), n.at(3));
    });
  };
  using enum AttitudeRate::Given;
  if (has(values, path + "omega_body"))
    return {attitude_of(), vector(values, path + "omega_body"), omega_body};
  if (has(values, path + "omega_inertial"))
    return {attitude_of(), vector(values, path + "omega_inertial"), omega_inertial};
  if (has(values, path + "omega_relative"))
    return {attitude_of(), vector(values, path + "omega_relative"), omega_relative};
  return {attitude_of(), vector(values, path + "momentum_body"), momentum_body};
}

// Integers stand for themselves, words for their places in the list.
double option_of(const Values& values, const std::string& path, const ChartOption& option) {
  if (!has(values, path)) return std::numeric_limits<double>::quiet_NaN();
  const Value& value = value_at(values, path);
  return value.words.empty() ? static_cast<double>(value.whole)
                             : option_number(option, value.words.front());
}

ChartState chart_state_of(const Values& values, const ChartKind& chart, const Body& body) {
  const std::string path = "state." + std::string(chart.name) + ".";
  ChartState state{chart, {}};
  std::size_t place = 0;
  for (const ChartVariable& variable : chart.variables) {
    const bool given = has(values, path + std::string(variable.name));
    state.numbers[place++] =
        number(values, path + std::string(given ? variable.name : variable.otherwise));
  }
  for (const ChartOption& option : chart.options)
    state.numbers[place++] = option_of(values, path + std::string(option.name), option);
  state.numbers = completed(chart, state.numbers, {&body});
  // what needs a body is seen when all else is there: see RotationBuilder::made
  if (!chart.needs_body) static_cast<void>(chart.to_hub(state.numbers, {nullptr}));
  return state;
}

InitialState state_of(const KindContext& at, const std::string& chart, const Body& body) {
  const Values& values = at.values;
  const std::string& name = at.name;
  if (chart == "tumbler") return tumbler_of(values, name);
  if (chart == "attitude-rate") return attitude_rate_of(values, name);
  const ChartKind* const kind = chart_named(chart, at.kinds.charts());
  if (kind == nullptr)
    throw std::logic_error("state: the schema allows a chart without a description: " + chart);
  return built(values, "state." + chart, name, [&] { return chart_state_of(values, *kind, body); });
}

std::string chart_of(const KindContext& at) {
  for (const std::string_view chart : state_charts(at.kinds.schema()))
    if (has(at.values, "state." + std::string(chart))) return std::string(chart);
  return {};
}

// What is made anew: with a base, only what stands on a number that has changed.
class RotationBuilder {
 public:
  RotationBuilder(const KindContext& at, const MadeRotation* base,
                  std::span<const std::string> changed)
      : at_(at), base_(base), changed_(changed) {}

  MadeRotation made() {
    const Values& values = at_.values;
    const std::string& name = at_.name;
    const std::string chart = chart_of(at_);
    std::shared_ptr<const ScenarioShape> shape =
        keeps({"body."}) ? base_->rotation.shape : shape_of(values, name);
    const Body body = keeps({"body."}) ? base_->rotation.body : body_of(values, shape.get(), name);
    time_ = has_automatic_rows(values) ? span_of(values, name) : times_of(values, name);
    MadeRotation made{{.body = body,
                       .q_file = has(values, "body.moments") ? Quaternion{} : body.q_FB(),
                       .chart = chart,
                       .state = state_of(at_, chart, body),
                       .epoch = has(values, "state.epoch") ? word(values, "state.epoch") : "",
                       .axes = word(values, "state.axes"),
                       .shape = std::move(shape),
                       .time = time_},
                      {},
                      {}};
    add_orbits(made);
    Rotation& rotation = made.rotation;
    rotation.method = method_of(at_);
    rotation.events = keeps({"event["}) ? base_->rotation.events : events_of(at_);
    if (base_ == nullptr)  // reported here, between the state and what acts on it
      static_cast<void>(format_options_of(values, at_.output.formats, name));
    add_frame(rotation, at_);
    same_axes_ = base_ != nullptr && rotation.q_file == base_->rotation.q_file;
    same_surface_ = same_axes_ && keeps({"surface["}) && rotation.shape == base_->rotation.shape;
    if (same_surface_) {
      rotation.surface = base_->rotation.surface;
      rotation.surface_meshes = base_->rotation.surface_meshes;
    } else {
      add_surface(rotation, values, name);
    }
    add_terms(made);
    if (const TumblerState* tumbler = std::get_if<TumblerState>(&rotation.state))
      require_psi(values, body, *tumbler, at_.units, name);
    built(values, "state." + chart, name, [&] { return free_rotation(rotation); });
    // members of an ensemble share the rows of the file
    if (has_automatic_rows(values))
      rotation.time =
          base_ != nullptr ? base_->rotation.time : automatic_times(rotation, values, name);
    return made;
  }

 private:
  // Whether there is a base, and no number below these paths has changed.
  bool keeps(std::initializer_list<std::string_view> paths) const {
    return base_ != nullptr && std::none_of(changed_.begin(), changed_.end(), [&](const auto& key) {
             return std::any_of(paths.begin(), paths.end(),
                                [&](std::string_view path) { return key.starts_with(path); });
           });
  }

  void add_orbits(MadeRotation& made) {
    const OrbitsContext place{at_.values, at_.units, time_, at_.name, at_.kinds};
    const std::vector<std::string> paths = orbit_paths(at_.values);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const OrbitKind* const kind = at_.kinds.orbit(word(at_.values, paths[i] + ".kind"));
      if (kind != nullptr && !kind->made)
        refuse(at_.values, paths[i] + ".kind", at_.name,
               "expected a kind with positions, such as \"kepler\" or \"elements\": shipped orbits "
               "are for kind = \"obliquity\"");
      const bool kept =
          keeps({paths[i] + ".", "state.dut1"}) && (!base_->orbits[i].time || keeps({"time."}));
      made.orbits.push_back(kept ? base_->orbits[i] : OrbitUses{});
      made.rotation.orbits.push_back(kept ? base_->rotation.orbits[i]
                                          : orbit_of(place, paths[i], made.orbits[i]));
      same_orbits_.push_back(kept);
    }
  }

  bool keeps_term(const std::string& path, const TermUses& uses) const {
    return keeps({path + ".", "state.dut1"}) && (!uses.body || keeps({"body."})) &&
           (!uses.file_axes || same_axes_) && (!uses.surface || same_surface_) &&
           std::all_of(uses.orbits.begin(), uses.orbits.end(),
                       [&](std::size_t orbit) { return same_orbits_[orbit]; });
  }

  MadeTerms made_terms(const Rotation& rotation, const std::string& kind, const std::string& path,
                       TermUses& uses) const {
    const PerturbationKind* const description = at_.kinds.perturbation(kind);
    if (description == nullptr)
      throw std::logic_error("perturbation: the schema allows a kind without a description: " +
                             kind);
    const KeyValues table(at_.values, at_.units, path, at_.name);
    return table.built("kind",
                       [&] { return description->made(TermContext(table, rotation, uses)); });
  }

  void add_made(Rotation& rotation, MadeTerms made, const std::string& path) const {
    if (auto* const one = std::get_if<AnyPerturbation>(&made)) {
      rotation.terms.push_back(std::move(*one));
    } else if (auto* const several = std::get_if<std::vector<AnyPerturbation>>(&made)) {
      for (AnyPerturbation& term : *several) rotation.terms.push_back(std::move(term));
    } else {
      if (rotation.damper)
        refuse(at_.values, path + ".kind", at_.name,
               "expected at most one perturbation of this kind");
      const auto& damper = std::get<DamperAtStart>(made);
      rotation.damper = damper.damper;
      rotation.damper_rate = damper.rate;
    }
  }

  void add_terms(MadeRotation& made) {
    Rotation& rotation = made.rotation;
    const std::vector<std::string> paths = array_paths(at_.values, "perturbation");
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::string& kind = word(at_.values, paths[i] + ".kind");
      rotation.kinds.push_back(kind);
      TermTable table{{}, rotation.terms.size(), 0};
      const MadeRotation* const base =
          base_ != nullptr && keeps_term(paths[i], base_->tables[i].uses) ? base_ : nullptr;
      if (base != nullptr && base->tables[i].count > 0) {
        table = base->tables[i];
        for (std::size_t k = 0; k < table.count; ++k)
          rotation.terms.push_back(base->rotation.terms[table.first + k]);
      } else {
        add_made(rotation, made_terms(rotation, kind, paths[i], table.uses), paths[i]);
        table.count = rotation.terms.size() - table.first;
      }
      made.tables.push_back(std::move(table));
    }
  }

  const KindContext& at_;
  const MadeRotation* base_;
  std::span<const std::string> changed_;
  std::optional<SaveAt> time_;
  bool same_axes_ = false;
  bool same_surface_ = false;
  std::vector<bool> same_orbits_;
};

}  // namespace

MadeRotation made_rotation(const KindContext& at, const MadeRotation* base,
                           std::span<const std::string> changed) {
  MadeRotation made = RotationBuilder(at, base, changed).made();
  check_motion(made.rotation, at.output, at.values, at.name);
  return made;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
