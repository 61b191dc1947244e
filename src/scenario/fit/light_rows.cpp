// SPDX-License-Identifier: MIT
// Light curves of [[observation]]: read for a fit, written for a simulation.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

#include "polhode/error.hpp"
#include "polhode/light/aspect.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "scenario/fit/observation_table.hpp"
#include "scenario/kinds/observations/shared_keys.hpp"
#include "scenario/scenario_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::ObservationTable;
using O = Observation;
using L = LightObservation;
using Format = LightObservation::Format;
using TimeFormat = Observation::TimeFormat;

constexpr double speed_of_light = 299792458.0;  // m/s

// The table of a light curve.
struct LightCurveTable : ObservationTable {
  explicit LightCurveTable(const ObservationTable& table)
      : ObservationTable(table),
        light(*table.of.light),
        light_place(detail::placed_light(table.place.at().file_values(), table.place.at().path())),
        to_state(detail::to_state_axes(
            light.format == Format::lc ? ObservedAxes::ecliptic : light.axes, table.place.at())) {}

  // Whether points have light times of their own, by their vectors to the observer.
  bool has_own_light_times() const {
    return of.times == light::LightTime::at_observer && light.orbit.empty() && !of.light_time;
  }

  const LightObservation& light;
  detail::Placed<LightObservation> light_place;
  Quaternion to_state;  // from its axes to those of the state
};

LightColumns::Three three(const std::vector<std::string>& names) {
  return names.size() == 3 ? LightColumns::Three{names[0], names[1], names[2]}
                           : LightColumns::Three{};
}

LightColumns columns_of(const LightCurveTable& of) {
  const LightObservation& o = of.light;
  LightColumns columns;
  columns.time = o.columns.at(0);
  const bool is_flux = o.brightness == L::Brightness::flux;
  (is_flux ? columns.flux : columns.magnitude) = o.columns.at(1);
  if (!o.sigma_columns.empty())
    columns.sigma = o.sigma_columns[0];
  else if (!is_flux && o.sigma)
    columns.one_sigma = *o.sigma;
  if (!o.session_column.empty()) columns.session = o.session_column[0];
  columns.to_sun = three(o.sun_columns);
  columns.to_observer = three(o.observer_columns);
  columns.is_calibrated = o.is_calibrated;
  columns.times = of.of.times;
  columns.distances = o.is_of_the_time ? Distances::of_the_time : Distances::unit;
  if (of.of.time_format == TimeFormat::number) return columns;
  columns.form = of.of.time_format == TimeFormat::date ? LightColumns::Times::dates
                                                       : LightColumns::Times::julian_dates;
  if (of.of.time_format == TimeFormat::modified_julian) columns.julian_zero = detail::modified_zero;
  columns.scale = *of.of.time_scale;
  columns.epoch = of.clock->epoch;
  return columns;
}

LightCurveFile file_of(const LightCurveTable& of, const std::vector<std::size_t>& leave_out) {
  const std::string path = of.place.file_at<&Observation::file>();
  if (of.light.format == Format::lc)
    return read_lc(path, *of.of.time_scale, of.clock->epoch, leave_out);
  if (of.light.format == Format::alcdef) return read_alcdef(path, of.clock->epoch, leave_out);
  LightColumns columns = columns_of(of);
  columns.leave_out = leave_out;
  return read_light_columns(path, columns);
}

// What the file declares and the keys say must be the same.
void require_declared(const LightCurveTable& of, const LightSession& session) {
  if (session.times && *session.times != of.of.times)
    of.place.refuse<&O::times>(
        std::string("expected ") +
        (*session.times == light::LightTime::at_body ? "\"at-body\"" : "\"at-observer\"") +
        ", as the file says of its times");
}

// Errors and vectors that the table has and points have not.
void complete(light::LightCurve& curve, const LightObservation& of) {
  const bool is_part = of.format == Format::lc ||
                       (of.format == Format::columns && of.brightness == L::Brightness::flux);
  const double unit = is_part && of.sigma ? std::fabs(light::mean_flux(curve)) : 0.0;
  for (light::LightPoint& p : curve.points) {
    if (of.sigma && p.sigma == 0.0)
      p.sigma = (is_part ? unit : light::magnitude_slope * p.flux) * *of.sigma;
    if (of.to_sun && of.sun_columns.empty()) p.to_sun = *of.to_sun;
    if (of.to_observer && of.observer_columns.empty()) p.to_observer = *of.to_observer;
  }
}

Vec3 turned(const Quaternion& q, const Vec3& v) { return v == Vec3{} ? v : rotate(q, v); }

double speed_of(const LightCurveTable& of) {
  return of.scenario.units().to_core(speed_of_light, "m/s", Dimension::speed);
}

// The orbit of the body or of the observer. Beyond its ends a table is continued in a straight
// line, since the iteration for the light time may try such times; require_cover rejects a result
// there.
template <auto key>
class LightOrbit {
 public:
  explicit LightOrbit(const LightCurveTable& of)
      : of_(of),
        orbit_(detail::named_orbit<key>(of.scenario.rotation(), of.light_place)),
        motion_(any_orbit(orbit_)),
        table_(std::get_if<TableOrbit>(&orbit_.motion)) {}

  Vec3 position(double t) const {
    if (table_ == nullptr) return motion_.position(t);
    const double inside = std::clamp(t, table_->first_time() - table_->overhang(),
                                     table_->last_time() + table_->overhang());
    const Vec3 x = table_->position(inside);
    return t == inside ? x : x + (t - inside) * table_->velocity(inside);
  }
  // `event` happens from the first of these times to the last.
  void require_cover(double first, double last, const std::string& event) const {
    constexpr double rounding = 2e-3;  // s, of dates in files
    if (table_ == nullptr) return;
    const Units& units = of_.scenario.units();
    const double slack = units.to_core(rounding, "s", Dimension::time);
    const double begin = table_->first_time(), end = table_->last_time();
    if (first >= begin - slack && last <= end + slack) return;
    const auto text = [&](double t) {
      const double rounded = slack * std::round(t / slack) + 0.0;  // no -0
      return fmt::format("{:.10g}", units.from_core(rounded, Dimension::time));
    };
    of_.light_place.template refuse<key>(
        "it covers the times " + text(begin) + " to " + text(end) + " " + units.time() +
        "; expected all when light " + event + ", " + text(first) + " to " + text(last) +
        (orbit_.kind == "table" ? "" : " (the table is made for [time])"));
  }

 private:
  const LightCurveTable& of_;
  const ScenarioOrbit& orbit_;
  AnyOrbit motion_;
  const TableOrbit* table_;  // null: it has no end
};

// Vectors, and times at the body where `given` are those at the observer.
light::LightCurve with_orbits(const LightCurveTable& of, light::LightCurve curve,
                              light::LightTime given) {
  const LightOrbit<&L::orbit> body(of);
  const LightOrbit<&L::observer_orbit> observer(of);
  const double c = speed_of(of);
  curve = of.light_place.built<&L::orbit>([&] {
    return light::with_vectors(
        std::move(curve), given, [&](double t) { return body.position(t); },
        [&](double t) { return observer.position(t); }, [](double) { return Vec3{}; }, c);
  });
  const auto require_cover = [&](const auto& orbit, const char* event, const auto& time) {
    if (curve.points.empty()) return;
    const auto [first, last] = std::ranges::minmax(curve.points, {}, time);
    orbit.require_cover(time(first), time(last), event);
  };
  require_cover(body, "leaves", [](const light::LightPoint& p) { return p.t; });
  require_cover(observer, "arrives",
                [&](const light::LightPoint& p) { return p.t + norm(p.to_observer) / c; });
  return curve;
}

// From when light arrived to when it left, by the vector to the observer of each point.
light::LightCurve after_own_light_times(const LightCurveTable& of, light::LightCurve curve) {
  constexpr double unit_length = 1e-9;  // of a direction that was written with ten digits
  if (std::ranges::all_of(curve.points, [](const light::LightPoint& p) {
        return std::fabs(norm(p.to_observer) - 1.0) < unit_length;
      }))
    of.place.refuse<&O::times>(
        "expected a key light_time as well: vectors to the observer have length 1, so "
        "that they are directions and no distances");
  return of.place.built<&O::times>([&] { return light::at_body(std::move(curve), speed_of(of)); });
}

// In core time at the body, with vectors along the axes of the state.
light::LightCurve in_core(const LightCurveTable& of, light::LightCurve curve) {
  const double unit = of.clock ? of.clock->second : of.time_unit;
  for (light::LightPoint& p : curve.points) {
    p.t = unit * p.t - of.light_time();
    p.to_sun = turned(of.to_state, p.to_sun);
    p.to_observer = turned(of.to_state, p.to_observer);
  }
  if (!of.light.orbit.empty()) return with_orbits(of, std::move(curve), of.of.times);
  if (of.has_own_light_times()) return after_own_light_times(of, std::move(curve));
  return curve;
}

// Whole numbers from 1; `most` is how many there are.
template <auto key>
std::vector<std::size_t> counted_from_1(const LightCurveTable& of, std::size_t most) {
  std::vector<std::size_t> all;
  for (const std::string& one : of.light.*key) {
    std::size_t n = 0;
    const auto [end, error] = std::from_chars(one.data(), one.data() + one.size(), n);
    if (error != std::errc() || end != one.data() + one.size() || n < 1 || n > most)
      of.light_place.refuse<key>("expected whole numbers from 1 to " + std::to_string(most));
    all.push_back(n);
  }
  return all;
}

// Removes the sessions that the table does not name, and those of which all points are left out.
void take_wanted(const LightCurveTable& of, const std::vector<std::size_t>& left_out,
                 LightCurveFile& file) {
  if (!of.light.sessions.empty()) {
    const std::vector<std::size_t> wanted = counted_from_1<&L::sessions>(of, file.sessions.size());
    std::vector<LightSession> taken;
    for (std::size_t k = 0; k < file.sessions.size(); ++k)
      if (std::ranges::count(wanted, k + 1) > 0) taken.push_back(std::move(file.sessions[k]));
    file.sessions = std::move(taken);
  }
  std::vector<std::size_t> unseen = left_out;
  for (const LightSession& session : file.sessions)
    for (const std::size_t line : session.left_out) std::erase(unseen, line);
  if (!unseen.empty())
    of.light_place.refuse<&L::leave_out>(
        "expected lines with a point of the sessions taken; line " +
        std::to_string(unseen.front()) + " has none");
  std::erase_if(file.sessions, [](const LightSession& s) { return s.curve.points.empty(); });
  if (file.sessions.empty()) of.light_place.refuse<&L::leave_out>("expected some points to stay");
}

template <auto... keys>
void require_names(const LightCurveTable& of) {
  const auto is_number = [](const std::string& name) {
    return name.empty() || (name.front() >= '0' && name.front() <= '9');
  };
  ((std::ranges::any_of(of.light.*keys, is_number)
        ? of.light_place.refuse<keys>("expected names and no numbers of columns to simulate")
        : void()),
   ...);
}

// Those that the keys of the table read, with names of others that are written beside them.
LightColumns written_columns(const LightCurveTable& of, std::size_t sessions, bool has_vectors) {
  const LightObservation& o = of.light;
  require_names<&L::columns, &L::sigma_columns, &L::session_column, &L::sun_columns,
                &L::observer_columns>(of);
  if (sessions > 1 && o.session_column.empty())
    of.place.refuse<&O::file>(
        "expected session_column = [\"session\"] as well, to simulate more than "
        "one session");
  const LightColumns usual = light_csv_columns(has_vectors);
  LightColumns own = columns_of(of);
  if (own.sigma.empty()) own.sigma = usual.sigma;
  if (own.session.empty()) own.session = usual.session;
  if (own.to_sun[0].empty()) own.to_sun = usual.to_sun;
  if (own.to_observer[0].empty()) own.to_observer = usual.to_observer;
  return own;
}

// The first flaw of what was read, with the key that mends it.
void require_usable(const LightCurveTable& of, const LightCurveFile& file) {
  const light::LightCurveNeeds needs{.vectors = of.light.orbit.empty()};
  try {
    require_sound(file, needs);
  } catch (const DomainError& error) {
    const std::optional<light::LightCurveFlaw> flaw = light::first_flaw(light_curves(file), needs);
    if (!flaw) throw;
    const LightSession& session = file.sessions[flaw->curve];
    std::string way;
    if (flaw->kind == light::LightCurveFlaw::Kind::order)
      way = "sort = true sorts them";
    else if (flaw->kind == light::LightCurveFlaw::Kind::error)
      way = "sigma gives points without an error one";
    else if (flaw->point && *flaw->point < session.lines.size())
      way = "leave_out = [" + std::to_string(session.lines[*flaw->point]) + "] leaves it out";
    if (way.empty()) throw;
    throw DomainError(std::string(error.what()) + "; " + way);
  }
}

// Points of each session by time, where the table wants that.
void sort_points(LightSession& session) {
  std::vector<std::size_t> order(session.curve.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return session.curve.points[k].t; });
  const LightSession given = session;
  for (std::size_t k = 0; k < order.size(); ++k) {
    session.curve.points[k] = given.curve.points[order[k]];
    if (given.lines.size() == order.size()) session.lines[k] = given.lines[order[k]];
  }
}

}  // namespace

void detail::read_light_curves(const ObservationTable& table, std::size_t index,
                               ReadObservations& all) {
  const LightCurveTable of(table);
  if (of.light.sigma && !(*of.light.sigma > 0.0))
    of.light_place.refuse<&L::sigma>("expected one above 0 for a fit; 0 is for simulations");
  const std::vector<std::size_t> left_out = counted_from_1<&L::leave_out>(of, 0xffffffff);
  LightCurveFile file = file_of(of, left_out);
  take_wanted(of, left_out, file);
  for (LightSession& session : file.sessions) {
    require_declared(of, session);
    complete(session.curve, of.light);
    if (of.light.sorts) sort_points(session);
  }
  require_usable(of, file);
  for (LightSession& session : file.sessions) {
    light::LightCurve curve = in_core(of, std::move(session.curve));
    if (of.light.is_of_the_time)
      curve = of.light_place.built<&L::is_of_the_time>(
          [&] { return light::at_unit_distances(curve, 1.0); });
    std::vector<ObservedRow> rows;
    for (std::size_t k = 0; k < curve.points.size(); ++k)
      rows.push_back({index, static_cast<std::uint32_t>(k < session.lines.size() ? session.lines[k]
                                                                                 : session.line)});
    all.curves.push_back(std::move(curve));
    all.curve_rows.push_back(std::move(rows));
  }
}

light::LightCurve with_vectors_of(const Scenario& scenario, std::size_t index,
                                  light::LightCurve curve) {
  const LightCurveTable of(detail::observation_table(scenario, index));
  if (!of.light.orbit.empty()) return with_orbits(of, std::move(curve), light::LightTime::at_body);
  const auto required = [&](const char* key, const std::optional<Vec3>& given) {
    if (given && norm(*given) > 0.0) return turned(of.to_state, *given);
    of.place.refuse<&O::kind>(std::string("expected a key ") + key +
                              " as well, a vector that is not 0, or orbits, for a simulation");
  };
  const Vec3 sun = required("to_sun", of.light.to_sun);
  const Vec3 observer = required("to_observer", of.light.to_observer);
  for (light::LightPoint& p : curve.points) {
    p.to_sun = sun;
    p.to_observer = observer;
  }
  return curve;
}

std::string light_curve_text(const Scenario& scenario, std::size_t index,
                             std::span<const light::LightCurve> curves,
                             std::span<const std::string> notes) {
  const LightCurveTable of(detail::observation_table(scenario, index));
  const bool has_columns = of.light.format == Format::columns;
  const double unit = has_columns ? 1.0 : of.clock->second;
  const bool has_orbit = !of.light.orbit.empty();
  std::vector<light::LightCurve> written(curves.begin(), curves.end());
  for (light::LightCurve& curve : written)
    for (light::LightPoint& p : curve.points) {
      const bool arrives =
          of.has_own_light_times() || (has_orbit && of.of.times == light::LightTime::at_observer);
      p.t = (p.t + (arrives ? norm(p.to_observer) / speed_of(of) : of.light_time())) / unit;
      p.to_sun = turned(conj(of.to_state), p.to_sun);
      p.to_observer = turned(conj(of.to_state), p.to_observer);
      if (has_orbit) p.to_sun = p.to_observer = Vec3{};  // the file is read without them
    }
  if (has_columns)
    return light_csv(written, notes, written_columns(of, curves.size(), !has_orbit),
                     [&](double t) { return detail::clock_text(of, t); });
  if (of.light.format == Format::lc)
    return lc_text(written,
                   ephemeris::converted(of.clock->epoch, *of.of.time_scale, of.clock->dut1));
  return of.place.built<&O::file>([&] {
    return alcdef_text(written, of.clock->epoch,
                       {.object = of.of.name,
                        .times = of.of.times,
                        .is_of_the_time = of.light.is_of_the_time,
                        .notes = {notes.begin(), notes.end()}});
  });
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
