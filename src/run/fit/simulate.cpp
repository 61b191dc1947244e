// SPDX-License-Identifier: MIT
// Simulated observations of a scenario, light curves included.
#include "polhode/run/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/part_file.hpp"
#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/ensemble/draws.hpp"
#include "polhode/error.hpp"
#include "polhode/light/ellipsoid.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/version.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/fit/fit_torques.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

// The motion at one time.
struct Seen {
  double t;
  Quaternion q;            // body axes of the file to inertial ones
  Vec3 w;                  // along these body axes
  Quaternion q_principal;  // principal axes to inertial ones
};

// Normal numbers of the seed and the places of table and row.
class Noise {
 public:
  Noise(std::uint64_t seed, std::size_t table)
      : random_(seed, ensemble::key_of("observation[" + std::to_string(table) + "]")) {}

  double normal(std::size_t row, std::size_t place) const {
    return random_.normal(row, static_cast<std::uint64_t>(place));
  }

 private:
  ensemble::CounterRandom random_;
};

// The flux of the body, from directions along inertial axes.
class SeenBody {
 public:
  explicit SeenBody(const Scenario& scenario) : law_(require_fit(scenario).light.law) {
    const LightPlan& plan = require_fit(scenario).light;
    const Rotation& rotation = scenario.rotation();
    if (plan.shape == LightPlan::Shape::mesh)
      mesh_ = std::make_unique<const light::ShadedMesh>(light_mesh(scenario));
    else if (plan.semiaxes)
      shape_ = {plan.semiaxes->x, plan.semiaxes->y, plan.semiaxes->z};
    else
      shape_ = light::homogeneous_ellipsoid(rotation.body.moments(), 1.0);
  }

  double flux(const Seen& seen, const Vec3& to_sun, const Vec3& to_observer) const {
    const Quaternion back = conj(mesh_ ? seen.q : seen.q_principal);
    const Vec3 s = rotate(back, to_sun), o = rotate(back, to_observer);
    return mesh_ ? mesh_->brightness(law_, s, o) : light::brightness(shape_, law_, s, o);
  }

 private:
  light::Scattering law_;
  light::Ellipsoid shape_{1.0, 1.0, 1.0};
  std::unique_ptr<const light::ShadedMesh> mesh_;
};

// The rows of each session: those of all sessions, or of all rows.
std::vector<std::vector<std::size_t>> sessions_of(const Scenario& scenario,
                                                  const std::vector<Seen>& motion) {
  const std::vector<double>& ends = require_fit(scenario).light.sessions;
  std::vector<std::vector<std::size_t>> all(std::max<std::size_t>(ends.size() / 2, 1));
  for (std::size_t k = 0; k < motion.size(); ++k) {
    if (ends.empty()) all[0].push_back(k);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
      if (motion[k].t >= ends[i] && motion[k].t <= ends[i + 1]) all[i / 2].push_back(k);
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].empty())
      require_fit(scenario).light.places.sessions.refuse("expected rows of [time] in session " +
                                                         std::to_string(i + 1));
  return all;
}

double sum_of(const light::LightCurve& curve) {
  double sum = 0.0;
  for (const light::LightPoint& p : curve.points) sum += p.flux;
  return sum;
}

// The light curves of a table, whose rows are those of the motion.
std::vector<light::LightCurve> simulated_sessions(const Scenario& scenario, std::size_t table,
                                                  const std::vector<Seen>& motion) {
  const FitPlan& plan = require_fit(scenario);
  const std::string& name = plan.observations.at(table).name;
  const LightObservation& of = *plan.observations.at(table).light;
  if (!of.sigma)
    plan.observations.at(table).place.refuse(
        "expected a key sigma, not sigma_columns: a simulation has no file to take errors from");
  const SeenBody body(scenario);
  const std::vector<std::vector<std::size_t>> rows = sessions_of(scenario, motion);
  std::vector<light::LightCurve> curves;
  double sum = 0.0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    light::LightCurve curve{.name = name, .is_calibrated = of.is_calibrated, .points = {}};
    for (const std::size_t k : rows[i]) curve.points.push_back({.t = motion[k].t});
    curve = with_vectors_of(scenario, table, std::move(curve));
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      light::LightPoint& p = curve.points[k];
      p.flux = body.flux(motion[rows[i][k]], p.to_sun, p.to_observer);
      if (of.is_of_the_time) p.flux /= dot(p.to_sun, p.to_sun) * dot(p.to_observer, p.to_observer);
    }
    sum += sum_of(curve);
    points += curve.points.size();
    curves.push_back(std::move(curve));
  }
  const bool is_magnitude = of.brightness == LightObservation::Brightness::magnitude ||
                            of.format == LightObservation::Format::alcdef;
  const Noise noise(plan.noise, table);
  const double mean = sum / static_cast<double>(points);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double own = sum_of(curves[i]) / static_cast<double>(curves[i].points.size());
    for (std::size_t k = 0; k < curves[i].points.size(); ++k) {
      light::LightPoint& p = curves[i].points[k];
      const double unit = of.is_calibrated ? mean : own;
      p.flux /= unit;
      // a part of the mean of its session, or a magnitude, as it is read
      p.sigma = *of.sigma * (is_magnitude ? light::magnitude_slope * p.flux : own / unit);
      p.flux += p.sigma * noise.normal(rows[i][k], 0);
    }
  }
  return curves;
}

}  // namespace
}  // namespace detail

namespace {

namespace fs = std::filesystem;
using detail::Noise;
using detail::Seen;

const FitPlan& simulated_plan(const Scenario& scenario) {
  const std::string& name = scenario.document.name;
  const FitPlan& plan = require_fit(scenario);
  if (!row_times(scenario))
    throw DomainError(name + ": time: got nothing; expected [time], when to observe");
  detail::require_inertial(scenario, "observations are");
  return plan;
}

bool begins_before_0(const Rotation& rotation) {
  const SaveAt& times = *rotation.time;
  for (std::int64_t k = 0; k < times.size(); ++k)
    if (times[k] < 0.0) return true;
  return false;
}

// With the jumps that the file begins a fit from, and before t = 0, too.
std::vector<Seen> motion_as_fitted(const Scenario& scenario) {
  const SaveAt& times = *scenario.rotation().time;
  std::vector<double> at;
  for (std::int64_t k = 0; k < times.size(); ++k) at.push_back(times[k]);
  std::vector<Seen> all;
  for (const fit::PredictedAttitude& one :
       fit::driven_attitudes(spin_state(scenario.rotation()), *detail::drive_of(scenario), at))
    all.push_back({one.t, one.q, one.w_F, normalized(one.q * scenario.rotation().q_file)});
  return all;
}

std::vector<Seen> motion_of(const Scenario& scenario) {
  const Rotation& rotation = scenario.rotation();
  const bool has_jumps = !require_fit(scenario).drive.jumps.empty();
  const bool is_driven = !rotation.kinds.empty() && !rotation.damper;
  if (has_jumps || (is_driven && begins_before_0(rotation))) return motion_as_fitted(scenario);
  const Quaternion f = rotation.q_file;
  std::vector<Seen> all;
  if (!propagation_method(rotation)) {
    const FreeRotation& motion = free_rotation(rotation);
    const SaveAt& times = *rotation.time;
    for (std::int64_t k = 0; k < times.size(); ++k) {
      const RotorState s = motion.at(times[k]);
      all.push_back({times[k], normalized(s.q * conj(f)),
                     rotate(f, angular_velocity(motion.body(), s)), s.q});
    }
    return all;
  }
  const Problem problem = rotor_problem(rotation);
  const System& system = problem.system;
  const Trajectory end = integrate(problem, *rotation.time, [&](std::span<const Sample> samples) {
    for (const Sample& one : samples)
      all.push_back({one.t, normalized(one.s.q * conj(f)),
                     rotate(f, angular_velocity(system, one.t, one.s).inertial),
                     normalized(one.s.q)});
  });
  if (end.outcome().status == Outcome::Status::failed)
    throw DomainError(scenario.document.name + ": the run failed: " + end.outcome().advice);
  return all;
}

fit::Snapshots rows_of(const FitPlan& plan, std::size_t table, const std::vector<Seen>& motion) {
  const ObservedRows& of = plan.observations.at(table).rows;
  const Noise noise(plan.noise, table);
  // errors in columns are rejected when the file is written
  const std::vector<double> sigmas =
      of.sigmas.empty() ? std::vector<double>(of.error_units.size(), 0.0) : of.sigmas;
  fit::Snapshots rows;
  for (std::size_t k = 0; k < motion.size(); ++k)
    of.simulate(
        {motion[k].t, motion[k].q, motion[k].w},
        [&](std::size_t place) { return noise.normal(k, place); }, sigmas, rows);
  return rows;
}

std::vector<std::string> notes_of(const Scenario& scenario, std::size_t table) {
  return {"simulated by polhode " + std::string(version()) + " from " +
              detail::printable(scenario.document.name, detail::longest_path) + ", seed " +
              std::to_string(require_fit(scenario).noise),
          "observation " + std::to_string(table + 1) + ": " +
              require_fit(scenario).observations[table].kind};
}

std::string text_of(const Scenario& scenario, std::size_t table, const std::vector<Seen>& motion) {
  const FitPlan& plan = require_fit(scenario);
  const std::vector<std::string> notes = notes_of(scenario, table);
  if (plan.observations[table].light)
    return light_curve_text(scenario, table, detail::simulated_sessions(scenario, table, motion),
                            notes);
  return observation_text(scenario, table, rows_of(plan, table, motion), notes);
}

void require_free(const std::vector<std::string>& paths, const Scenario& scenario,
                  bool may_replace) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string shown = detail::printable(paths[i], detail::longest_path);
    std::error_code ignored;
    if (fs::exists(paths[i], ignored) && !may_replace)
      throw DomainError(shown + ": is there; expected another folder, since it may be real data");
    for (std::size_t k = 0; k < i; ++k)
      if (paths[k] == paths[i])
        throw DomainError(scenario.document.name + ": observation[" + std::to_string(i) +
                          "].file: got the file of observation[" + std::to_string(k) +
                          "]; expected one of its own to simulate");
  }
}

void require_light(const Scenario& scenario, std::size_t table, bool is_light) {
  const Observation& of = simulated_plan(scenario).observations.at(table);
  if (of.light.has_value() == is_light) return;
  of.place.refuse(is_light ? "expected \"light-curve\"; what else is seen is simulated by simulated"
                           : "expected \"attitude\", \"direction\" or \"rate\"; light curves are "
                             "simulated by simulated_light");
}

}  // namespace

fit::Snapshots simulated(const Scenario& scenario, std::size_t table) {
  require_light(scenario, table, false);
  return rows_of(simulated_plan(scenario), table, motion_of(scenario));
}

std::vector<light::LightCurve> simulated_light(const Scenario& scenario, std::size_t table) {
  require_light(scenario, table, true);
  return detail::simulated_sessions(scenario, table, motion_of(scenario));
}

std::vector<std::string> write_simulation(const Scenario& scenario, const std::string& folder,
                                          bool may_replace) {
  const FitPlan& plan = simulated_plan(scenario);
  std::vector<std::string> paths, texts;
  for (const Observation& of : plan.observations)
    paths.push_back((fs::path(folder) / of.file).string());
  require_free(paths, scenario, may_replace);
  const std::vector<Seen> motion = motion_of(scenario);
  for (std::size_t i = 0; i < paths.size(); ++i) texts.push_back(text_of(scenario, i, motion));
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const fs::path parent = fs::path(paths[i]).parent_path();
    std::error_code failed;
    if (!parent.empty()) fs::create_directories(parent, failed);
    detail::PartFile file(paths[i]);
    file.write(texts[i]);
    file.commit();
  }
  return paths;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
