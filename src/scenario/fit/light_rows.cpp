// SPDX-License-Identifier: MIT
// Light curves of [[observation]]: read for a fit, written for a simulation.
#include <array>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/light/magnitudes.hpp"
#include "polhode/tables/lc.hpp"
#include "polhode/tables/light_columns.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "scenario/fit/observation_table.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::ObservationTable;
using TimeFormat = Observation::TimeFormat;

LightColumns::Three three(const std::vector<std::string>& names) {
  return names.size() == 3 ? LightColumns::Three{names[0], names[1], names[2]}
                           : LightColumns::Three{};
}

LightColumns columns_of(const ObservationTable& of) {
  const Observation& o = of.of;
  LightColumns columns;
  columns.time = o.columns.at(0);
  const bool is_flux = o.brightness == Observation::Brightness::flux;
  (is_flux ? columns.flux : columns.magnitude) = o.columns.at(1);
  if (!o.sigma_columns.empty()) columns.sigma = o.sigma_columns[0];
  if (!is_flux && o.sigma) columns.one_sigma = *o.sigma;
  if (!o.session_column.empty()) columns.session = o.session_column[0];
  columns.to_sun = three(o.sun_columns);
  columns.to_observer = three(o.observer_columns);
  columns.is_calibrated = o.is_calibrated;
  columns.times = o.times;
  columns.distances = Distances::unit;
  if (o.time_format == TimeFormat::number) return columns;
  columns.form = o.time_format == TimeFormat::date ? LightColumns::Times::dates
                                                   : LightColumns::Times::julian_dates;
  if (o.time_format == TimeFormat::modified_julian) columns.julian_zero = detail::modified_zero;
  columns.scale = *o.time_scale;
  columns.epoch = of.clock->epoch;
  return columns;
}

LightCurveFile file_of(const ObservationTable& of) {
  const std::string path = of.keys.file_at("file");
  if (of.of.light_format == Observation::LightFormat::lc)
    return read_lc(path, *of.of.time_scale, of.clock->epoch);
  return read_light_columns(path, columns_of(of));
}

// Errors and vectors that the table has and the file has not.
void complete(LightCurve& curve, const Observation& of) {
  const bool is_part = of.light_format == Observation::LightFormat::lc ||
                       of.brightness == Observation::Brightness::flux;
  if (is_part && of.sigma) curve = with_relative_sigma(std::move(curve), *of.sigma);
  for (LightPoint& p : curve.points) {
    if (of.to_sun) p.to_sun = *of.to_sun;
    if (of.to_observer) p.to_observer = *of.to_observer;
  }
}

Vec3 turned(const Quaternion& q, const Vec3& v) { return v == Vec3{} ? v : rotate(q, v); }

[[noreturn]] void refuse_to_write(const ObservationTable& of, const char* key, const char* text) {
  of.keys.refuse(key, text);
}

// What light_csv writes is what the keys of the table must read.
void require_own_columns(const ObservationTable& of) {
  const Observation& o = of.of;
  const LightColumns own = light_csv_columns(true);
  if (o.time_format != TimeFormat::number)
    refuse_to_write(of, "time_format",
                    "expected \"number\" to simulate columns; lc has dates: format = \"lc\"");
  if (o.columns != std::vector<std::string>{own.time, own.flux})
    refuse_to_write(of, "columns", "expected [\"t\", \"flux\"] to simulate");
  if (!o.sun_columns.empty() && three(o.sun_columns) != own.to_sun)
    refuse_to_write(of, "sun_columns", "expected [\"sun_x\", \"sun_y\", \"sun_z\"] to simulate");
  if (!o.observer_columns.empty() && three(o.observer_columns) != own.to_observer)
    refuse_to_write(of, "observer_columns",
                    "expected [\"observer_x\", \"observer_y\", \"observer_z\"] to simulate");
}

}  // namespace

void detail::read_light_curves(const ObservationTable& of, std::size_t index,
                               ReadObservations& all) {
  LightCurveFile file = file_of(of);
  for (LightSession& session : file.sessions) complete(session.curve, of.of);
  require_sound(file, {.vectors = true});
  const double unit = of.clock ? of.clock->second : of.time_unit;
  for (LightSession& session : file.sessions) {
    for (LightPoint& p : session.curve.points) {
      p.t = unit * p.t - of.light_time();
      p.to_sun = turned(of.to_state, p.to_sun);
      p.to_observer = turned(of.to_state, p.to_observer);
    }
    all.curves.push_back(std::move(session.curve));
    all.curve_tables.push_back(index);
  }
}

Vec3 in_axes_of_state(const Scenario& scenario, std::size_t index, const Vec3& v) {
  const std::string path = detail::observation_path(index);
  return turned(detail::observation_table(scenario, index, path).to_state, v);
}

std::string light_curve_text(const Scenario& scenario, std::size_t index, const LightCurve& curve,
                             std::span<const std::string> notes) {
  const std::string path = detail::observation_path(index);
  const ObservationTable of = detail::observation_table(scenario, index, path);
  const bool is_lc = of.of.light_format == Observation::LightFormat::lc;
  if (!is_lc) require_own_columns(of);
  const double unit = of.clock ? of.clock->second : of.time_unit;
  LightCurve written = curve;
  for (LightPoint& p : written.points) {
    p.t = (p.t + of.light_time()) / unit;
    p.to_sun = turned(conj(of.to_state), p.to_sun);
    p.to_observer = turned(conj(of.to_state), p.to_observer);
  }
  const LightCurve curves[] = {std::move(written)};
  if (!is_lc) return light_csv(curves, notes);
  return lc_text(curves, converted(of.clock->epoch, *of.of.time_scale, of.clock->dut1));
}

}  // namespace v0
}  // namespace polhode
