// SPDX-License-Identifier: MIT
#include "polhode/free/sadov.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "polhode/error.hpp"
#include "tables/detail/chart_families.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr ChartVariable variables[] = {
    {"phi_l", Dimension::angle, "Angle of the motion in the body.", "20"},
    {"phi_g", Dimension::angle, "Angle of the precession about the angular momentum.", "30"},
    {"phi_h", Dimension::angle, "From inertial axis 1 to the node of the invariable plane.", "40"},
    {"I_l", Dimension::momentum, "Action of phi_l; |I_l| <= I_g, and I_l >= 0 in LAM.", "0.95"},
    {"I_g", Dimension::momentum, "Length of the angular momentum; positive.", "1.0"},
    {"I_h", Dimension::momentum, "Angular momentum along inertial axis 3; |I_h| <= I_g.", "0.5"},
};
constexpr std::size_t region = 6, lobe = 7;
constexpr ChartOption options[] = {
    {"region", "SAM|LAM", "",
     "Left out: SAM where |I_l|/I_g is above its value on the separatrix, else LAM.", "\"SAM\""},
    {"lobe", "1|-1", "1",
     "In LAM the sign of the momentum along the long axis; in SAM I_l carries the sign.", "1"},
};
constexpr double left_out = std::numeric_limits<double>::quiet_NaN();
constexpr double number_of(SadovRegion of) { return of == SadovRegion::short_axis ? 0.0 : 1.0; }

// |I_l|/I_g is above (2/pi) arctan kappa in short-axis mode, kappa^2 = I3 (I2 - I1)/(I1 (I3 - I2)).
SadovRegion region_of(const Body& body, double I_l, double I_g) {
  std::array<double, 3> I{body.moments().x, body.moments().y, body.moments().z};
  std::sort(I.begin(), I.end());
  const double separatrix =
      std::atan2(std::sqrt(I[2] * (I[1] - I[0])), std::sqrt(I[0] * (I[2] - I[1]))) *
      (2.0 / std::numbers::pi);
  return std::fabs(I_l) >= separatrix * I_g ? SadovRegion::short_axis : SadovRegion::long_axis;
}
ChartNumbers with_region(const ChartNumbers& x, const ChartPlace& at) {
  ChartNumbers all = x;
  if (std::isnan(x[region])) all[region] = number_of(region_of(*at.body, x[3], x[4]));
  return all;
}

RotorState from_sadov(const ChartNumbers& x, const ChartPlace& at) {
  const bool short_axis = x[region] == number_of(SadovRegion::short_axis);
  return to_rotor(*at.body,
                  SadovState{x[0], x[1], x[2], x[3], x[4], x[5],
                             short_axis ? SadovRegion::short_axis : SadovRegion::long_axis,
                             static_cast<int>(x[lobe])});
}
// There is no lobe to name in the short-axis region.
ChartNumbers of_motion(const FreeRotation& motion, double t) {
  const SadovState a = to_sadov(motion, t);
  const bool has_lobe = a.region == SadovRegion::long_axis;
  return {a.phi_l,
          a.phi_g,
          a.phi_h,
          a.I_l,
          a.I_g,
          a.I_h,
          number_of(a.region),
          has_lobe ? static_cast<double>(a.lobe) : left_out};
}
ChartNumbers to_sadov_numbers(const RotorState& s, const ChartPlace& at) {
  return of_motion(FreeRotation::short_arc(*at.body, s, at.t), at.t);
}

// One column for both options: the lobe, 0 in the short-axis region.
constexpr std::string_view columns[] = {"lobe"};
constexpr std::size_t column = 6;
ChartNumbers to_lobe_column(const ChartNumbers& x) {
  ChartNumbers all = x;
  all[column] = x[region] == number_of(SadovRegion::short_axis) ? 0.0 : x[lobe];
  return all;
}
ChartNumbers from_lobe_column(const ChartNumbers& x) {
  ChartNumbers all = x;
  all[region] = all[lobe] = left_out;
  if (std::isnan(x[column])) return all;
  all[region] = number_of(x[column] == 0.0 ? SadovRegion::short_axis : SadovRegion::long_axis);
  if (x[column] != 0.0) all[lobe] = x[column];
  return all;
}

constexpr Citation sources[] = {
    {"sadov1970",
     "Sadov, Yu. A. (1970). The action-angle variables in the Euler-Poinsot problem. Journal of "
     "Applied Mathematics and Mechanics 34, 922-925.",
     "action-angle variables"},
    {"kinoshita1972",
     "Kinoshita, H. (1972). First-order perturbations of the two finite body problem. "
     "Publications of the Astronomical Society of Japan 24, 423-457.",
     "action-angle variables, the form with Heuman's Lambda"},
};

constexpr ChartKind charts[] = {
    {.name = "sadov",
     .help = "Sadov's action-angle variables.",
     .variables = variables,
     .to_hub = from_sadov,
     .from_hub = to_sadov_numbers,
     .needs_body = true,
     .in_scenarios = true,
     .options = options,
     .completed = with_region,
     .from_motion = of_motion,
     .branch_columns = columns,
     .to_columns = to_lobe_column,
     .from_columns = from_lobe_column,
     .state_class = "SadovState",
     .sources = sources},
};

}  // namespace

std::span<const ChartKind> sadov_charts() { return charts; }

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
