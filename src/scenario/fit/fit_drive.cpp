// SPDX-License-Identifier: MIT
#include "scenario/fit/fit_drive.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "polhode/scenario/scenario.hpp"
#include "scenario/ensemble/vary.hpp"
#include "scenario/prepared_base.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"

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

void add_parameter(const FitContext& at, const std::string& path, FitPlan& plan) {
  const VariedNumbers found = varied_numbers({at.values, at.units, at.name}, path);
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

void add_jump(const FitContext& at, const std::string& path, FitPlan& plan) {
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

}  // namespace

void add_drive(const FitContext& at, const Rotation& rotation, FitPlan& plan) {
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

}  // namespace v0
}  // namespace polhode
