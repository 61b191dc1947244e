// SPDX-License-Identifier: MIT
// [[free.parameter]] and [[free.jump]]: unknown numbers of torques, and jumps of the spin.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polhode/detail/scenario/varied_scenario.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario/ensemble/vary.hpp"
#include "scenario/fit/fit_plan.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/tables/fit.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

// Steps become too short for derivatives below, and derivatives too wrong for a descent above.
constexpr double least_tolerance = 1e-14, most_tolerance = 1e-4;

struct ParameterTable {
  std::string key;
  std::optional<double> low, high, mean, sigma;  // in the unit of the key
};

constexpr std::array keys_of_parameter = {
    text_key<&ParameterTable::key>(
        "key",
        "The number by its keys; perturbation[0] is the first of its tables, torque[2] the "
        "third number of an array. All else of this table is in the unit that it has in the "
        "file.")
        .required()
        .example("\"perturbation[0].torque[2]\""),
    quantity_key<&ParameterTable::low>(
        "low", Dimension::number,
        "Least number; left out, 0 for what cannot be negative, else none.")
        .example("0"),
    quantity_key<&ParameterTable::high>("high", Dimension::number, "Greatest number.").example("1"),
    quantity_key<&ParameterTable::mean>("mean", Dimension::number,
                                        "Of a normal prior; left out, the number of the file.")
        .example("0"),
    quantity_key<&ParameterTable::sigma>("sigma", Dimension::number,
                                         "Its standard error; left out, no prior.")
        .example("0.1")
        .positive(),
};
constexpr Table<ParameterTable> parameter_description = {
    {.path = "free.parameter[]",
     .help = "A number of a torque that is unknown, one to which the torque is proportional or "
             "proportional beside a part that stays: a component, GM, a pressure, a tensor. The "
             "fit begins at the number of the file."},
    keys_of_parameter};

struct JumpTable {
  fit::SpinJump::Of of = fit::SpinJump::Of::rate;
  double t = 0.0;
  Vec3 change;
  std::optional<Vec3> sigmas;
};

consteval KindKey<JumpTable> change_key(std::string_view kinds, Dimension dimension,
                                        std::string_view help) {
  return quantity_key<&JumpTable::change>("change", dimension, help)
      .otherwise("[0, 0, 0]")
      .of_kinds(kinds);
}
consteval KindKey<JumpTable> errors_key(std::string_view kinds, Dimension dimension) {
  return quantity_key<&JumpTable::sigmas>(
             "sigmas", dimension, "Standard errors of a normal prior about that; left out, none.")
      .example("[1, 1, 1]")
      .of_kinds(kinds)
      .positive();
}

constexpr std::string_view of_momentum = "momentum-body|momentum-inertial";
constexpr std::array keys_of_jump = {
    choice_key<&JumpTable::of, fit::SpinJump::Of::rate, fit::SpinJump::Of::body_momentum,
               fit::SpinJump::Of::inertial_momentum>("kind", "rate|momentum-body|momentum-inertial",
                                                     "What jumps.")
        .required()
        .example("\"rate\""),
    quantity_key<&JumpTable::t>("t", Dimension::time, "When, counted from the epoch.")
        .required()
        .example("100")
        .or_date(),
    change_key("rate", Dimension::rate,
               "Where the fit begins: of the angular velocity along the body axes."),
    change_key(of_momentum, Dimension::momentum, "Where the fit begins: of the angular momentum."),
    errors_key("rate", Dimension::rate),
    errors_key(of_momentum, Dimension::momentum),
};
constexpr KindText kinds_of_jump[] = {
    {"free.jump[]", "rate", "The angular velocity, along the body axes."},
    {"free.jump[]", "momentum-body", "The angular momentum, along the body axes."},
    {"free.jump[]", "momentum-inertial", "The angular momentum, along the inertial axes."},
};
constexpr Table<JumpTable> jump_description = {
    {.path = "free.jump[]",
     .help = "A jump of the spin of an unknown size, just after a time that lies between the "
             "observations: a collision, a thruster, the shedding of mass."},
    keys_of_jump,
    {},
    kinds_of_jump};

bool is_torque_key(const std::string& key) {
  return key.starts_with("perturbation[") || key.starts_with("surface[");
}

void add_parameter(const FileValues& at, const Placed<ParameterTable>& table, FitPlan& plan) {
  using P = ParameterTable;
  const VariedNumbers found = varied_numbers(table.at(), table.name<&ParameterTable::key>());
  const std::string& key = found.keys.front();
  if (!is_torque_key(key))
    table.refuse<&P::key>(
        "expected a number of [[perturbation]] or [[surface]]; what else is unknown stands in "
        "free.unknowns");
  const auto is_same = [&](const FreeParameter& other) { return other.number.name == key; };
  if (std::ranges::any_of(plan.drive.parameters, is_same))
    table.refuse<&P::key>("expected a key that no other table [[free.parameter]] has");
  FreeParameter one{{key, found.values.front()}, found.units.front()};
  const Range range = value_at(at.values, found.places.front().path).key->range;
  if (range == Range::positive || range == Range::not_negative) one.number.low = 0.0;
  one.number.low = table->low.value_or(one.number.low);
  one.number.high = table->high.value_or(one.number.high);
  const double low = one.number.low, high = one.number.high, start = one.number.start;
  if (!(low < high)) {
    table.refuse_any<&P::high>("expected low below high");
    table.refuse<&P::low>("expected low below high");
  }
  if (!(start >= low && start <= high))
    table.refuse<&P::key>(
        "expected a number of the file between low and high: the fit begins there");
  if (table->mean && !table->sigma) table.refuse<&P::mean>("expected a key sigma as well");
  if (table->sigma)
    plan.priors.push_back({{key}, {table->mean.value_or(start)}, {*table->sigma * *table->sigma}});
  plan.drive.parameters.push_back(std::move(one));
  if (!plan.places.drive) plan.places.drive = table.place<&P::key>();
}

void add_jump(const Placed<JumpTable>& table, FitPlan& plan) {
  const std::string& path = table.at().path();
  const std::string name = path.substr(path.find('.') + 1) + ".change";
  if (table->sigmas)
    for (int k = 0; k < 3; ++k) {
      const double sigma = (*table->sigmas)[k];
      plan.priors.push_back(
          {{name + "[" + std::to_string(k) + "]"}, {table->change[k]}, {sigma * sigma}});
    }
  plan.drive.jumps.push_back({name, table->t, table->of, table->change});
  if (!plan.places.drive) plan.places.drive = table.place<&JumpTable::of>();
}

}  // namespace

SchemaPart drive_keys() { return part_of<parameter_description, jump_description>(); }

void add_drive(const FileValues& at, const Rotation& rotation, FitPlan& plan) {
  for (const Placed<ParameterTable>& one : placed_tables(parameter_description, at))
    add_parameter(at, one, plan);
  for (const Placed<JumpTable>& one : placed_tables(jump_description, at)) add_jump(one, plan);
  const Placed<FitTable> fit = fit_table(at);
  plan.drive.tolerance = fit->tolerance;
  if (!(fit->tolerance >= least_tolerance && fit->tolerance <= most_tolerance))
    fit.refuse<&FitTable::tolerance>("expected a number from 1e-14 to 1e-4");
  const bool is_default = fit->tolerance == FitDrive{}.tolerance;  // as templates print it
  if (!is_default && rotation.kinds.empty() && plan.drive.parameters.empty() &&
      plan.drive.jumps.empty())
    fit.refuse<&FitTable::tolerance>("expected torques or jumps as well: free rotation has none");
}

}  // namespace detail

fit::SpinDrive spin_drive(const Scenario& scenario) {
  const FitDrive& plan = require_fit(scenario).drive;
  fit::SpinDrive drive;
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
  // which refers to its scenario, and the drive may outlive that of the caller
  const auto own = std::make_shared<const Scenario>(scenario);
  const auto varied = std::make_shared<const VariedScenario>(*own, keys);
  drive.terms = [own, varied](std::span<const double> numbers) {
    return detail::rotation_of(varied->experiment(numbers)).terms;
  };
  return drive;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
