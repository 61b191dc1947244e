// SPDX-License-Identifier: MIT
// From the values of a file of kind "fit" to its plan.
#include "scenario/fit/fit_plan.hpp"

#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/fit/observation_table.hpp"
#include "scenario/scenario_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

// Light curves are fitted by themselves, and their orbits are those of the file.
std::vector<Observation> observations_of(const FileValues& at, const Kinds& kinds,
                                         const Rotation& rotation) {
  const std::size_t count = array_paths(at.values, "observation").size();
  std::vector<Observation> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(observation_of(at, i, kinds, rotation));
  for (std::size_t i = 0; i < count; ++i) {
    const Placed<Observation> table = placed_observation(at, i);
    if (all[i].light.has_value() != all.front().light.has_value())
      table.refuse<&Observation::kind>(
          "expected light curves alone, or none: they are fitted by themselves");
    if (!all[i].light || all[i].light->orbit.empty()) continue;
    const Placed<LightObservation> light = placed_light(at, table.at().path());
    static_cast<void>(named_orbit<&LightObservation::orbit>(rotation, light));
    static_cast<void>(named_orbit<&LightObservation::observer_orbit>(rotation, light));
  }
  return all;
}

}  // namespace

FitPlan fit_plan(const FileValues& at, const Kinds& kinds, const Rotation& rotation) {
  FitPlan plan;
  plan.observations = observations_of(at, kinds, rotation);
  const Placed<FreeTable> free = free_table(at);
  const Placed<FitTable> fit = fit_table(at);
  require_words(free, fit, plan.has_light());
  plan.unknowns = {free->has("attitude"), free->has("rate"), free->has("moments"),
                   free->has("products")};
  plan.places.unknowns = free.place<&FreeTable::unknowns>();
  plan.places.frame = place_of(at.values, "frame", at.name);
  for (const std::string& path : array_paths(at.values, "perturbation"))
    plan.places.perturbations.push_back(place_of(at.values, path + ".kind", at.name));
  plan.light = light_plan(at, rotation, free, fit);
  add_priors(at, spin_state(rotation), plan);
  add_drive(at, rotation, plan);
  plan.loss = {fit->loss, fit->loss_scale};
  plan.most_iterations = fit->iterations;
  plan.starts = fit->starts;
  plan.rate_spread = fit->rate_spread;
  plan.within = fit->within;
  plan.most_solutions = fit->most_solutions;
  plan.seed = fit->seed;
  plan.noise = simulate_table(at)->seed;
  return plan;
}

}  // namespace detail

const FitPlan& require_fit(const Scenario& scenario) {
  if (scenario.fit != nullptr) return *scenario.fit;
  throw DomainError(scenario.document.name + ": kind: got \"" + scenario.document.kind +
                    "\"; expected \"fit\"");
}

fit::SpinState spin_state(const Rotation& rotation) {
  const RotorState& s = initial_state(rotation);
  const Quaternion& f = rotation.q_file;
  const Vec3& I = rotation.body.moments();
  const Mat3 R = rotation_matrix(f);
  Mat3 diagonal;
  for (int i = 0; i < 3; ++i) diagonal(i, i) = I[i];
  fit::SpinState state;
  state.q = normalized(s.q * conj(f));
  state.w_F = rotate(f, angular_velocity(rotation.body, s));
  state.inertia_F = f == Quaternion{} ? diagonal : R * diagonal * transpose(R);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) state.inertia_F(i, j) = state.inertia_F(j, i);
  return state;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
