// SPDX-License-Identifier: MIT
// From the values of a file of kind "fit" to its plan.
#include "scenario/fit/fit_plan.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "polhode/math/quaternion.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/ensemble/vary.hpp"
#include "scenario/prepared_base.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// Steps become too short for derivatives below, and derivatives too wrong for a descent above.
constexpr double least_tolerance = 1e-14, most_tolerance = 1e-4;

double square(double x) { return x * x; }

bool is_torque_key(const std::string& key) {
  return key.starts_with("perturbation[") || key.starts_with("surface[");
}

void add_parameter(const FileValues& at, const std::string& path, FitPlan& plan) {
  const VariedNumbers found = varied_numbers({at.values, at.units, path, at.name}, "key");
  const std::string key = found.keys.front(), own = path + ".key";
  if (!is_torque_key(key))
    refuse(at.values, own, at.name,
           "expected a number of [[perturbation]] or [[surface]]; what else is unknown stands in "
           "free.unknowns");
  const auto is_same = [&](const FreeParameter& other) { return other.number.name == key; };
  if (std::any_of(plan.drive.parameters.begin(), plan.drive.parameters.end(), is_same))
    refuse(at.values, own, at.name, "expected a key that no other table [[free.parameter]] has");
  FreeParameter one{{key, found.values.front()}, found.units.front()};
  const Range range = value_at(at.values, found.places.front().path).key->range;
  if (range == Range::positive || range == Range::not_negative) one.number.low = 0.0;
  if (has(at.values, path + ".low")) one.number.low = number(at.values, path + ".low");
  if (has(at.values, path + ".high")) one.number.high = number(at.values, path + ".high");
  if (!(one.number.low < one.number.high))
    refuse(at.values, path + (has(at.values, path + ".high") ? ".high" : ".low"), at.name,
           "expected low below high");
  if (!(one.number.start >= one.number.low && one.number.start <= one.number.high))
    refuse(at.values, own, at.name,
           "expected a number of the file between low and high: the fit begins there");
  if (has(at.values, path + ".sigma")) {
    require_range(at.values, path + ".sigma", at.name);
    const double mean =
        has(at.values, path + ".mean") ? number(at.values, path + ".mean") : one.number.start;
    plan.priors.push_back({{key}, {mean}, {square(number(at.values, path + ".sigma"))}});
  } else if (has(at.values, path + ".mean")) {
    refuse(at.values, path + ".mean", at.name, "expected a key sigma as well");
  }
  plan.drive.parameters.push_back(std::move(one));
}

void add_jump(const FileValues& at, const std::string& path, FitPlan& plan) {
  const KeyValues table(at.values, at.units, path, at.name);
  const std::string& kind = table.word("kind");
  SpinJump jump;
  jump.name = path.substr(path.find('.') + 1) + ".change";
  jump.t = table.number("t");
  jump.of = kind == "rate"            ? SpinJump::Of::rate
            : kind == "momentum-body" ? SpinJump::Of::body_momentum
                                      : SpinJump::Of::inertial_momentum;
  jump.change = table.vector("change");
  if (table.has("sigmas")) {
    require_range(at.values, table.key_path("sigmas"), at.name);
    const Vec3 sigmas = table.vector("sigmas");
    for (int k = 0; k < 3; ++k)
      plan.priors.push_back(
          {{jump.name + "[" + std::to_string(k) + "]"}, {jump.change[k]}, {square(sigmas[k])}});
  }
  plan.drive.jumps.push_back(std::move(jump));
}

// Adds the tables [[free.parameter]] and [[free.jump]], and their priors, to a plan. Throws a
// ScenarioError at the place of what is wrong.
void add_drive(const FileValues& at, const Rotation& rotation, FitPlan& plan) {
  for (const std::string& path : array_paths(at.values, "free.parameter"))
    add_parameter(at, path, plan);
  for (const std::string& path : array_paths(at.values, "free.jump")) add_jump(at, path, plan);
  plan.drive.tolerance = number(at.values, "fit.tolerance");
  if (!(plan.drive.tolerance >= least_tolerance && plan.drive.tolerance <= most_tolerance))
    refuse(at.values, "fit.tolerance", at.name, "expected a number from 1e-14 to 1e-4");
  const bool is_default = plan.drive.tolerance == FitDrive{}.tolerance;  // as templates print it
  if (!is_default && rotation.kinds.empty() && plan.drive.parameters.empty() &&
      plan.drive.jumps.empty())
    refuse(at.values, "fit.tolerance", at.name,
           "expected torques or jumps as well: free rotation has none");
}

}  // namespace
}  // namespace detail

SpinDrive spin_drive(const Scenario& scenario) {
  const FitDrive& plan = require_fit(scenario).drive;
  SpinDrive drive;
  drive.q_FB = scenario.rotation().q_file;
  drive.jumps = plan.jumps;
  drive.tolerance = plan.tolerance;
  std::vector<std::string> keys;
  for (const FreeParameter& one : plan.parameters) {
    drive.parameters.push_back(one.number);
    keys.push_back(one.number.name);
  }
  if (keys.empty()) {
    drive.terms = [terms = scenario.rotation().terms](std::span<const double>) { return terms; };
    return drive;
  }
  // a base refers to its scenario, and the drive may outlive that of the caller
  const auto own = std::make_shared<const Scenario>(scenario);
  const auto base = std::make_shared<const detail::PreparedBase>(*own, keys);
  drive.terms = [own, base](std::span<const double> numbers) {
    return detail::rotation_of(base->experiment(numbers)).terms;
  };
  return drive;
}

namespace detail {
namespace {

constexpr std::int64_t most_starts = 1'000'000, most_iterations = 1'000'000;

std::int64_t whole_in(const FileValues& at, const std::string& path, std::int64_t least,
                      std::int64_t most, const char* words) {
  const std::int64_t n = value_at(at.values, path).whole;
  if (n < least || n > most)
    refuse(at.values, path, at.name, std::string("expected a whole number ") + words);
  return n;
}

SpinUnknowns unknowns_of(const FileValues& at) {
  const std::vector<std::string>& words = value_at(at.values, "free.unknowns").words;
  const auto has_word = [&](std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  return {has_word("attitude"), has_word("rate"), has_word("moments"), has_word("products")};
}

// Light curves are fitted by themselves, and their orbits are those of the file.
void require_one_sort(const FileValues& at, const std::vector<Observation>& all,
                      const Rotation& rotation) {
  using enum Observation::Kind;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string path = "observation[" + std::to_string(i) + "].";
    if ((all[i].kind == light_curve) != (all.front().kind == light_curve))
      refuse(at.values, path + "kind", at.name,
             "expected light curves alone, or none: they are fitted by themselves");
    if (all[i].orbit.empty()) continue;
    for (const char* const key : {"orbit", "observer_orbit"})
      static_cast<void>(orbit_named(rotation.orbits, at.values, path + key, at.name));
  }
}

// About the body axes: phi turns about the third inertial axis, theta about the node, psi about the
// third axis of the body.
Mat3 euler_covariance(const Quaternion& q, const Vec3& sigmas) {
  const Quaternion spin = rotation_z(euler_angles(q).psi);
  const Vec3 axes[3] = {rotate(conj(q), Vec3{0.0, 0.0, 1.0}),
                        rotate(conj(spin), Vec3{1.0, 0.0, 0.0}), Vec3{0.0, 0.0, 1.0}};
  Mat3 covariance;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) covariance(i, j) += square(sigmas[k]) * axes[k][i] * axes[k][j];
  return covariance;
}

// The tables [[free.prior]].
class Priors {
 public:
  Priors(const FileValues& at, const SpinState& start, FitPlan& plan)
      : at_(at), start_(start), plan_(plan) {}

  void add(const std::string& path) {
    const KeyValues table(at_.values, at_.units, path, at_.name);
    const std::string& kind = table.word("kind");
    require_unknown(table, kind);
    for (const char* const key : {"sigmas", "euler_sigmas"})
      if (table.has(key)) require_range(at_.values, table.key_path(key), at_.name);
    const Mat3& T = start_.inertia_F;
    const double unit = T(2, 2);
    if (kind == "attitude")
      add_attitude(table);
    else if (kind == "rate")
      add_numbers(table, {"w_x", "w_y", "w_z"}, {start_.w_F.x, start_.w_F.y, start_.w_F.z});
    else if (kind == "moments")
      add_numbers(table, {"Ixx/Izz", "Iyy/Izz"}, {T(0, 0) / unit, T(1, 1) / unit});
    else
      add_numbers(table, {"Ixy/Izz", "Iyz/Izz", "Ixz/Izz"},
                  {T(0, 1) / unit, T(1, 2) / unit, T(0, 2) / unit});
  }

 private:
  void require_unknown(const KeyValues& table, const std::string& kind) {
    const SpinUnknowns& u = plan_.unknowns;
    const bool is_unknown = kind == "attitude"  ? u.attitude
                            : kind == "rate"    ? u.rate
                            : kind == "moments" ? u.moment_ratios
                                                : u.products;
    if (!is_unknown) table.refuse("kind", "expected one of free.unknowns");
    if (std::find(seen_.begin(), seen_.end(), kind) != seen_.end())
      table.refuse("kind", "expected one prior of each kind");
    seen_.push_back(kind);
  }

  void add_attitude(const KeyValues& table) {
    plan_.attitude_prior = ObservedAttitude{
        0.0, start_.q,
        table.has("sigmas") ? covariance_of(table.vector("sigmas"))
                            : euler_covariance(start_.q, table.vector("euler_sigmas"))};
    const Mat3& c = plan_.attitude_prior->covariance;
    table.built("euler_sigmas", [&] {
      const Vec3 rows[3] = {
          {c(0, 0), c(0, 1), c(0, 2)}, {c(1, 0), c(1, 1), c(1, 2)}, {c(2, 0), c(2, 1), c(2, 2)}};
      if (!(dot(rows[0], cross(rows[1], rows[2])) > 0.0))
        throw DomainError("expected a start whose theta is neither 0 nor 180 deg; sigmas instead");
      return 0;
    });
  }

  void add_numbers(const KeyValues& table, const std::vector<std::string>& names,
                   const std::vector<double>& start) {
    const std::vector<double>& mean = table.has("mean") ? table.numbers("mean") : start;
    const std::vector<double>& sigmas = table.numbers("sigmas");
    for (std::size_t i = 0; i < names.size(); ++i)
      plan_.priors.push_back({{names[i]}, {mean[i]}, {square(sigmas[i])}});
  }

  const FileValues& at_;
  const SpinState& start_;
  FitPlan& plan_;
  std::vector<std::string> seen_;
};

Loss loss_of(const FileValues& at) {
  require_range(at.values, "fit.loss_scale", at.name);
  const std::string& kind = word(at.values, "fit.loss");
  using enum Loss::Kind;
  return {kind == "huber"     ? huber
          : kind == "soft-l1" ? soft_l1
          : kind == "cauchy"  ? cauchy
                              : squared,
          number(at.values, "fit.loss_scale")};
}

}  // namespace

FitPlan fit_plan(const FileValues& at, const Rotation& rotation) {
  FitPlan plan;
  for (const std::string& path : array_paths(at.values, "observation"))
    plan.observations.push_back(observation_of(KeyValues(at.values, at.units, path, at.name)));
  require_one_sort(at, plan.observations, rotation);
  require_words(at, plan.has_light());
  plan.unknowns = unknowns_of(at);
  plan.light = light_plan(at, rotation);
  const SpinState start = spin_state(rotation);
  Priors priors(at, start, plan);
  for (const std::string& path : array_paths(at.values, "free.prior")) priors.add(path);
  add_drive(at, rotation, plan);
  plan.loss = loss_of(at);
  plan.most_iterations =
      static_cast<int>(whole_in(at, "fit.iterations", 1, most_iterations, "from 1 to 1e6"));
  plan.starts = whole_in(at, "fit.starts", 1, most_starts, "from 1 to 1e6");
  require_range(at.values, "fit.rate_spread", at.name);
  plan.rate_spread = number(at.values, "fit.rate_spread");
  require_range(at.values, "fit.within", at.name);
  plan.within = number(at.values, "fit.within");
  plan.most_solutions =
      static_cast<std::size_t>(whole_in(at, "fit.most_solutions", 1, most_starts, "from 1 to 1e6"));
  constexpr const char* of_seeds = "from 0 to 2^63 - 1";
  plan.seed = static_cast<std::uint64_t>(whole_in(at, "fit.seed", 0, INT64_MAX, of_seeds));
  plan.noise = static_cast<std::uint64_t>(whole_in(at, "simulate.seed", 0, INT64_MAX, of_seeds));
  return plan;
}

}  // namespace detail

const FitPlan* fit_plan(const Scenario& scenario) { return scenario.document.checked->fit.get(); }

const FitPlan& require_fit(const Scenario& scenario) {
  if (const FitPlan* const plan = fit_plan(scenario)) return *plan;
  throw DomainError(scenario.document.name + ": kind: got \"" + scenario.document.kind +
                    "\"; expected \"fit\"");
}

SpinState spin_state(const Rotation& rotation) {
  const RotorState s = initial_state(rotation);
  const Quaternion& f = rotation.q_file;
  const Vec3& I = rotation.body.moments();
  const Mat3 R = rotation_matrix(f);
  Mat3 diagonal;
  for (int i = 0; i < 3; ++i) diagonal(i, i) = I[i];
  SpinState state;
  state.q = normalized(s.q * conj(f));
  state.w_F = rotate(f, angular_velocity(rotation.body, s));
  state.inertia_F = f == Quaternion{} ? diagonal : R * diagonal * transpose(R);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) state.inertia_F(i, j) = state.inertia_F(j, i);
  return state;
}

}  // namespace v0
}  // namespace polhode
