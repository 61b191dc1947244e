// SPDX-License-Identifier: MIT
#include "run/detail/simulated_light.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "polhode/light/ellipsoid.hpp"
#include "polhode/light/lambert.hpp"
#include "polhode/light/magnitudes.hpp"
#include "polhode/light/shaded_mesh.hpp"
#include "scenario/value_access.hpp"
#include "scenario/value_reader.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// What is seen, from directions along inertial axes.
class SeenBody {
 public:
  explicit SeenBody(const Scenario& scenario) : law_(require_fit(scenario).light.law) {
    const LightPlan& plan = require_fit(scenario).light;
    const Rotation& rotation = scenario.rotation();
    if (plan.shape == LightPlan::Shape::mesh)
      mesh_ = std::make_unique<const ShadedMesh>(light_mesh(scenario));
    else if (plan.semiaxes)
      shape_ = {plan.semiaxes->x, plan.semiaxes->y, plan.semiaxes->z};
    else
      shape_ = homogeneous_ellipsoid(rotation.body.moments(), 1.0);
  }

  double flux(const Seen& seen, const Vec3& to_sun, const Vec3& to_observer) const {
    const Quaternion back = conj(mesh_ ? seen.q : seen.q_principal);
    const Vec3 s = rotate(back, to_sun), o = rotate(back, to_observer);
    return mesh_ ? mesh_->brightness(law_, s, o) : brightness(shape_, law_, s, o);
  }

 private:
  Scattering law_;
  Ellipsoid shape_{1.0, 1.0, 1.0};
  std::unique_ptr<const ShadedMesh> mesh_;
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
      refuse(scenario.document.checked->values, ends.empty() ? "time" : "simulate.sessions",
             scenario.document.path, "expected rows of [time] in session " + std::to_string(i + 1));
  return all;
}

double sum_of(const LightCurve& curve) {
  double sum = 0.0;
  for (const LightPoint& p : curve.points) sum += p.flux;
  return sum;
}

}  // namespace

std::vector<LightCurve> simulated_sessions(const Scenario& scenario, std::size_t table,
                                           const std::vector<Seen>& motion) {
  const FitPlan& plan = require_fit(scenario);
  const Observation& of = plan.observations.at(table);
  if (!of.sigma)
    refuse(scenario.document.checked->values, "observation[" + std::to_string(table) + "].kind",
           scenario.document.path,
           "expected a key sigma, not sigma_columns: a simulation has no file to take errors from");
  const SeenBody body(scenario);
  const std::vector<std::vector<std::size_t>> rows = sessions_of(scenario, motion);
  std::vector<LightCurve> curves;
  double sum = 0.0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    LightCurve curve{.name = of.name, .is_calibrated = of.is_calibrated, .points = {}};
    for (const std::size_t k : rows[i]) curve.points.push_back({.t = motion[k].t});
    curve = with_vectors_of(scenario, table, std::move(curve));
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      LightPoint& p = curve.points[k];
      p.flux = body.flux(motion[rows[i][k]], p.to_sun, p.to_observer);
      if (of.is_of_the_time) p.flux /= dot(p.to_sun, p.to_sun) * dot(p.to_observer, p.to_observer);
    }
    sum += sum_of(curve);
    points += curve.points.size();
    curves.push_back(std::move(curve));
  }
  const bool is_magnitude = of.brightness == Observation::Brightness::magnitude ||
                            of.light_format == Observation::LightFormat::alcdef;
  const Noise noise(plan.noise, table);
  const double mean = sum / static_cast<double>(points);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const double own = sum_of(curves[i]) / static_cast<double>(curves[i].points.size());
    for (std::size_t k = 0; k < curves[i].points.size(); ++k) {
      LightPoint& p = curves[i].points[k];
      const double unit = of.is_calibrated ? mean : own;
      p.flux /= unit;
      // a part of the mean of its session, or a magnitude, as it is read
      p.sigma = *of.sigma * (is_magnitude ? magnitude_slope * p.flux : own / unit);
      p.flux += noise.at(rows[i][k], {p.sigma, 0.0, 0.0}).x;
    }
  }
  return curves;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
