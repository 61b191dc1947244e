// SPDX-License-Identifier: MIT
// [[free.prior]]: what is known of the unknowns of a fit beforehand.
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "polhode/rotor/attitude.hpp"
#include "scenario/fit/fit_plan.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct PriorTable {
  enum class Of { attitude, rate, moments, products };
  Of kind = Of::attitude;
  std::vector<double> mean;  // empty: that of the start
  std::vector<double> sigmas;
  std::optional<Vec3> euler_sigmas;
};

consteval KindKey<PriorTable> mean_key(std::string_view kind, int count, Dimension dimension,
                                       std::string_view example, std::string_view help) {
  return quantity_key<&PriorTable::mean>("mean", dimension, help)
      .of_length(count)
      .example(example)
      .of_kinds(kind);
}
consteval KindKey<PriorTable> sigmas_key(std::string_view kind, int count, Dimension dimension,
                                         std::string_view example, std::string_view help) {
  return quantity_key<&PriorTable::sigmas>("sigmas", dimension, help)
      .of_length(count)
      .example(example)
      .of_kinds(kind)
      .positive();
}

constexpr std::array keys_of_prior = {
    choice_key<&PriorTable::kind, PriorTable::Of::attitude, PriorTable::Of::rate,
               PriorTable::Of::moments, PriorTable::Of::products>(
        "kind", "attitude|rate|moments|products", "Of which unknowns.")
        .required()
        .example("\"rate\""),
    mean_key("rate", 3, Dimension::rate, "[14.5, 33.5, -98.7]",
             "Of the angular velocity along the body axes; left out, that of the start."),
    mean_key("moments", 2, Dimension::number, "[3.1, 3.2]",
             "Of Ixx/Izz and Iyy/Izz; left out, those of the start."),
    mean_key("products", 3, Dimension::number, "[0, 0, 0]",
             "Of Ixy/Izz, Iyz/Izz, Ixz/Izz; left out, those of the start."),
    sigmas_key("attitude", 3, Dimension::angle, "[15, 15, 15]",
               "Standard errors of the attitude of the start about the body axes.")
        .alternative(),
    quantity_key<&PriorTable::euler_sigmas>("euler_sigmas", Dimension::angle,
                                            "Standard errors of its Euler angles phi, theta, psi.")
        .alternative()
        .example("[15, 15, 15]")
        .of_kinds("attitude")
        .positive(),
    sigmas_key("rate", 3, Dimension::rate, "[0.1, 0.1, 0.1]",
               "Standard errors along the body axes.")
        .required(),
    sigmas_key("moments", 2, Dimension::number, "[0.1, 0.1]", "Standard errors of the two ratios.")
        .required(),
    sigmas_key("products", 3, Dimension::number, "[0.01, 0.01, 0.01]",
               "Standard errors of the three.")
        .required(),
};
constexpr Alternatives sets_of_prior[] = {{"free.prior[]", "sigmas|euler_sigmas", "attitude"}};
constexpr KindText kinds_of_prior[] = {
    {"free.prior[]", "attitude", "The attitude at t = 0."},
    {"free.prior[]", "rate", "The angular velocity at t = 0 along the body axes."},
    {"free.prior[]", "moments", "The ratios of moments Ixx/Izz and Iyy/Izz."},
    {"free.prior[]", "products",
     "The products of inertia over Izz, as elements of the tensor: Ixy is minus the integral of x "
     "y dm."},
};
constexpr Table<PriorTable> prior_description = {
    {.path = "free.prior[]", .help = "What is known of unknowns beforehand, as normal numbers."},
    keys_of_prior,
    sets_of_prior,
    kinds_of_prior};

// About the body axes: phi turns about the third inertial axis, theta about the node, psi about the
// third axis of the body.
Mat3 euler_covariance(const Quaternion& q, const Vec3& sigmas) {
  const Quaternion spin = rotation_z(euler_angles(q).psi);
  const Vec3 axes[3] = {rotate(conj(q), Vec3{0.0, 0.0, 1.0}),
                        rotate(conj(spin), Vec3{1.0, 0.0, 0.0}), Vec3{0.0, 0.0, 1.0}};
  Mat3 covariance;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        covariance(i, j) += sigmas[k] * sigmas[k] * axes[k][i] * axes[k][j];
  return covariance;
}

fit::ObservedAttitude attitude_prior(const Placed<PriorTable>& table, const Quaternion& q) {
  const std::vector<double>& s = table->sigmas;
  const Mat3 c = table->euler_sigmas ? euler_covariance(q, *table->euler_sigmas)
                                     : fit::covariance_of(Vec3{s.at(0), s.at(1), s.at(2)});
  const Vec3 rows[3] = {
      {c(0, 0), c(0, 1), c(0, 2)}, {c(1, 0), c(1, 1), c(1, 2)}, {c(2, 0), c(2, 1), c(2, 2)}};
  if (!(dot(rows[0], cross(rows[1], rows[2])) > 0.0))
    table.refuse<&PriorTable::euler_sigmas>(
        "expected a start whose theta is neither 0 nor 180 deg; sigmas instead");
  return {0.0, q, c};
}

bool is_unknown(PriorTable::Of kind, const fit::SpinUnknowns& u) {
  using enum PriorTable::Of;
  return kind == attitude  ? u.attitude
         : kind == rate    ? u.rate
         : kind == moments ? u.moment_ratios
                           : u.products;
}

// The unknowns of a kind, and where a fit begins.
std::vector<std::pair<std::string, double>> numbers_of(PriorTable::Of kind,
                                                       const fit::SpinState& start) {
  const Mat3& T = start.inertia_F;
  const double unit = T(2, 2);
  if (kind == PriorTable::Of::rate)
    return {{"w_x", start.w_F.x}, {"w_y", start.w_F.y}, {"w_z", start.w_F.z}};
  if (kind == PriorTable::Of::moments)
    return {{"Ixx/Izz", T(0, 0) / unit}, {"Iyy/Izz", T(1, 1) / unit}};
  return {{"Ixy/Izz", T(0, 1) / unit}, {"Iyz/Izz", T(1, 2) / unit}, {"Ixz/Izz", T(0, 2) / unit}};
}

}  // namespace

SchemaPart prior_keys() { return part_of<prior_description>(); }

void add_priors(const FileValues& at, const fit::SpinState& start, FitPlan& plan) {
  std::vector<PriorTable::Of> seen;
  for (const Placed<PriorTable>& table : placed_tables(prior_description, at)) {
    const PriorTable::Of kind = table->kind;
    if (plan.has_light())
      table.refuse<&PriorTable::kind>("expected no prior: a fit of light curves takes none");
    if (!is_unknown(kind, plan.unknowns))
      table.refuse<&PriorTable::kind>("expected one of free.unknowns");
    if (std::ranges::count(seen, kind) > 0)
      table.refuse<&PriorTable::kind>("expected one prior of each kind");
    seen.push_back(kind);
    if (kind == PriorTable::Of::attitude) {
      plan.attitude_prior = attitude_prior(table, start.q);
      continue;
    }
    std::size_t i = 0;
    for (const auto& [name, own] : numbers_of(kind, start)) {
      const double sigma = table->sigmas.at(i);
      plan.priors.push_back(
          {{name}, {table->mean.empty() ? own : table->mean.at(i)}, {sigma * sigma}});
      ++i;
    }
  }
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
