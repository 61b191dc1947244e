// SPDX-License-Identifier: MIT
// The kinds of [frame.NAME].
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/table_check.hpp"
#include "scenario/kinds/frames/rate_formula.hpp"
#include "scenario/kinds/frames/rate_table.hpp"
#include "tables/number_table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

struct PrecessingArguments {
  Vec3 axis;
  std::optional<double> rate;
  std::string orbit;
  double turns = 0.0;
  std::optional<std::string> formula;
  std::optional<std::vector<double>> times, rates;
  std::optional<std::string> file;
  std::optional<std::vector<std::string>> columns;
  std::optional<std::string> time_unit, rate_unit;
  double epoch = 0.0;
};

constexpr std::array precessing_keys = {
    quantity_key<&PrecessingArguments::axis>(
        "axis", Dimension::number, "The axis, in inertial axes; its length plays no part.")
        .required()
        .example("[0.0, 0.0, 1.0]"),
    quantity_key<&PrecessingArguments::rate>("rate", Dimension::rate,
                                             "The rate of turn, right-handed about the axis.")
        .alternative()
        .example("0.5"),
    name_key<&PrecessingArguments::orbit>(
        "orbit",
        "The name of a table [orbit.NAME] whose mean motion gives the rate: the mean rate of "
        "the longitude, node and pericentre included.")
        .alternative()
        .example("\"earth\""),
    quantity_key<&PrecessingArguments::turns>(
        "turns", Dimension::number,
        "Turns of the frame per revolution on that orbit: 1 for a body that keeps one face to "
        "the other, 1.5 for the 3:2 resonance.")
        .alternative()
        .example("1.5"),
    text_key<&PrecessingArguments::formula>(
        "rate_formula",
        "The rate as a function of t: a sum of powers of t, sines and cosines, such as "
        "\"5e-3 + 1e-5*t + 2e-4*cos(0.3*t)\", in `units.angle` and `units.time`; arguments of "
        "sines and cosines in radians.")
        .alternative()
        .example("\"5e-3 + 1e-5*t\""),
    quantity_key<&PrecessingArguments::times>(
        "times", Dimension::time,
        "Times of a table of rates, increasing, which cover the run and `epoch`. Between rows the "
        "rate is a polynomial of order 10, or of what the number of rows allows.")
        .alternative()
        .example("[0, 10, 20, 30]"),
    quantity_key<&PrecessingArguments::rates>("rates", Dimension::rate, "The rates at `times`.")
        .alternative()
        .example("[0.5, 0.51, 0.515, 0.518]"),
    file_key<&PrecessingArguments::file>(
        "file",
        "A file of such rows, CSV or separated by blanks, .gz or not; the path is from the folder "
        "of this file.")
        .alternative()
        .example("\"precession.csv\""),
    columns_key<&PrecessingArguments::columns>(
        "columns",
        "Its columns of time and rate, by the names that the file gives them or by their numbers "
        "from 1; left out, the first two.")
        .example("[\"t\", \"rate\"]"),
    unit_key<&PrecessingArguments::time_unit>(
        "time_unit", "Unit of its times, which count from t = 0; left out, `units.time`.")
        .example("\"yr\""),
    unit_key<&PrecessingArguments::rate_unit>(
        "rate_unit", "Unit of its rates; left out, that of the file's rates.")
        .example("\"arcsec/yr\""),
    quantity_key<&PrecessingArguments::epoch>("epoch", Dimension::time,
                                              "When the frame coincides with the inertial axes.")
        .otherwise("0"),
};

// The rate of the mean longitude, which on a plane that stays is that of the direction to the body.
double mean_rate(const ScenarioOrbit& orbit, const FrameContext& at) {
  const KeplerElements* elements = kepler_elements(orbit);
  if (elements == nullptr || !(elements->eccentricity < 1.0))
    at.refuse("orbit", "expected an ellipse with elements");
  const double n = KeplerOrbit(*elements).mean_motion();
  const auto* moving = std::get_if<PrecessingKeplerOrbit>(&orbit.motion);
  if (moving == nullptr) return n;
  const SecularRates& rates = moving->rates();
  return n + rates.mean_anomaly + rates.argument + rates.node;
}

// A frame rotated about the axis by an angle that depends on time.
template <class Angle>
Frame turning_frame(const Vec3& axis, Angle angle) {
  const double size = norm(axis);
  if (!(size > 0.0) || !std::isfinite(size))
    throw DomainError("expected an axis whose length is positive and finite");
  const Vec3 n = (1.0 / size) * axis;
  return Frame::from_attitude([n, angle](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    const SinCos<T> half = sincos(T(T(0.5) * angle(t)));
    return BasicQuaternion<T>{half.cos, T(n.x) * half.sin, T(n.y) * half.sin, T(n.z) * half.sin};
  });
}

MadeFrame made_of_formula(const PrecessingArguments& a, const FrameContext& at) {
  const RateFormula formula = at.built("rate_formula", [&] {
    return RateFormula(*a.formula)
        .in_units(at.units().to_core(1.0, Dimension::time),
                  at.units().to_core(1.0, Dimension::rate));
  });
  return at.built("axis", [&] {
    const double start = formula.angle(a.epoch);
    return MadeFrame{turning_frame(a.axis,
                                   [formula, start](const auto& t) {
                                     using T = std::decay_t<decltype(t)>;
                                     return T(formula.angle(t) - T(start));
                                   }),
                     "precessing at " + *a.formula};
  });
}

RateTable rates_of(const PrecessingArguments& a, const FrameContext& at) {
  if (!a.file) {
    if (a.times->size() != a.rates->size())
      at.refuse("rates",
                "expected " + std::to_string(a.times->size()) + " numbers, as many as times has");
    return at.built("times", [&] { return RateTable(*a.times, *a.rates, a.epoch); });
  }
  const std::vector<std::string> columns = a.columns.value_or(std::vector<std::string>{"1", "2"});
  if (columns.size() != 2) at.refuse("columns", "expected 2 columns: time and rate");
  const double time = at.unit("time_unit", Dimension::time);
  const double rate = at.unit("rate_unit", Dimension::rate);
  return at.built("file", [&] {
    NumberTable read = read_number_table(at.file_at("file"), columns);
    require_rising(read, 0, "time");
    const TableCheck check(at, read, columns);
    check.unit(0, {"time_unit", time, Dimension::time});
    check.unit(1, {"rate_unit", rate, Dimension::rate});
    check.epoch();
    for (double& t : read.columns[0]) t *= time;
    for (double& r : read.columns[1]) r *= rate;
    return RateTable(read.columns[0], read.columns[1], a.epoch);
  });
}

MadeFrame made_of_table(const PrecessingArguments& a, const FrameContext& at) {
  const RateTable table = rates_of(a, at);
  if (std::isnan(table.angle(a.epoch)))
    at.refuse("epoch", "expected a time that the table of rates covers");
  return at.built("axis", [&] {
    return MadeFrame{turning_frame(a.axis, [table](const auto& t) { return table.angle(t); }),
                     "precessing at the rates of a table"};
  });
}

MadeFrame made_precessing(const PrecessingArguments& a, const FrameContext& at) {
  for (const char* own : {"columns", "time_unit", "rate_unit"})
    if (!a.file && at.is_explicit(own)) at.refuse(own, "expected a key file as well");
  if (a.formula) return made_of_formula(a, at);
  if (a.file || a.times) return made_of_table(a, at);
  const Precession p{a.axis, a.rate ? *a.rate : a.turns * mean_rate(at.orbit("orbit"), at),
                     a.epoch};
  return at.built("axis", [&] {
    return MadeFrame{Frame::precessing(p.axis, p.rate, p.epoch), "precessing", p};
  });
}

}  // namespace

FrameKind precessing_kind() {
  FrameKind kind = frame_kind<PrecessingArguments>("precessing",
                                                   "A frame that turns about a constant axis, with "
                                                   "a rate that is constant or a function of time.",
                                                   precessing_keys, made_precessing);
  kind.sets = "rate|orbit+turns|rate_formula|times+rates|file";
  return kind;
}

namespace {

struct OrbitPlaneArguments {
  std::string orbit;
  PlaneOrigin axis_1 = PlaneOrigin::node;
};

constexpr std::array orbit_plane_keys = {
    name_key<&OrbitPlaneArguments::orbit>("orbit", "The name of a table [orbit.NAME].")
        .required()
        .example("\"earth\""),
    choice_key<&OrbitPlaneArguments::axis_1, PlaneOrigin::node, PlaneOrigin::shortest_turn>(
        "axis_1", "node|shortest-turn",
        "What axis 1 is: the ascending node, or, for orbits next to inertial axes 1 and 2, which "
        "have no node that stays, where the shortest turn to the plane brings inertial axis 1.")
        .otherwise("\"node\"")
        .example("\"shortest-turn\""),
};

// frame_of(motion): an orbit of a file has one of four types, which can be differentiated twice.
template <class FrameOf>
Frame along_orbit(const ScenarioOrbit& orbit, const FrameOf& frame_of) {
  return std::visit(
      [&](const auto& motion) -> Frame {
        if constexpr (std::is_same_v<std::decay_t<decltype(motion)>, AnyOrbit>)
          throw std::logic_error("a frame along an orbit that no file has");
        else
          return frame_of(motion);
      },
      orbit.motion);
}

MadeFrame made_orbit_plane(const OrbitPlaneArguments& a, const FrameContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  return at.built("orbit", [&] {
    return MadeFrame{
        along_orbit(orbit, [&](const auto& motion) { return orbit_plane_frame(motion, a.axis_1); }),
        "plane of orbit " + orbit.name};
  });
}

}  // namespace

FrameKind orbit_plane_kind() {
  return frame_kind<OrbitPlaneArguments>(
      "orbit-plane",
      "The plane of an orbit of date: axis 1 along its ascending node, axis 3 along its normal. It "
      "turns with the plane, not with the body on the orbit. Of elements the plane is theirs, of a "
      "table and of an ephemeris that of position and velocity.",
      orbit_plane_keys, made_orbit_plane);
}

namespace {

struct LocalVerticalArguments {
  std::string orbit;
};

constexpr std::array local_vertical_keys = {
    name_key<&LocalVerticalArguments::orbit>("orbit", "The name of a table [orbit.NAME].")
        .required()
        .example("\"earth\""),
};

MadeFrame made_local_vertical(const LocalVerticalArguments&, const FrameContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  return at.built("orbit", [&] {
    return MadeFrame{
        along_orbit(orbit, [](const auto& motion) { return local_vertical_frame(motion); }),
        "local vertical of orbit " + orbit.name};
  });
}

}  // namespace

FrameKind local_vertical_kind() {
  return frame_kind<LocalVerticalArguments>(
      "local-vertical",
      "The local vertical, local horizontal of an orbit (LVLH): axis 3 "
      "points to the centre, axis 2 against the normal of the orbit, axis "
      "1 completes them, towards the motion. The columns roll, pitch and "
      "yaw are the angles about axes 1, 2 and 3.",
      local_vertical_keys, made_local_vertical);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
