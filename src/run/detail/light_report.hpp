// SPDX-License-Identifier: MIT
// What texts and JSON of fits of light curves share: words, numbers with their errors, groups of
// pairs of periods, and how well a period or a model describes the data.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "polhode/run/light_report.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

const char* mode_word(Regime mode);  // "SAM", "LAM", or what else it is
const char* beside_word(const fit::FoundLight& found);
const char* image_word(fit::LightImage image);
const char* loss_word(const fit::Loss& loss);  // as fit.loss has it

// What solutions are ranked by, the sum that was minimised, as tables name it: "chi-square" of the
// data; "loss" if it is robust; "cost" of convex bodies, with what regularises them.
const char* rank_word(const LightReport& report, const fit::Loss& loss);

// Where a direction along the axes of the state points, in rad: longitude or right ascension, 0 to
// 2 pi, and latitude or declination.
struct SkyPlace {
  double longitude, latitude;
};
SkyPlace sky_place(const Vec3& direction);
// The pole turned by pi about the normal of the plane of Sun and observer, in the middle of the
// data; where these are one direction there is no such plane, and it is the pole.
Vec3 mirror_pole(const Vec3& pole, const LightReport& report);

// A number with its errors, as given and scaled, in the unit of the file. Errors are NaN if no
// solution describes the data.
struct WithErrors {
  double value, error, scaled_error;
  std::string unit;
};
struct LightFigures {
  WithErrors precession_period, rotation_period, short_axis_period;
  SkyPlace pole;                      // in the unit of angles
  WithErrors pole_major, pole_minor;  // the errors; value is not used
};
LightFigures light_figures(const Scenario& scenario, const LightReport& report,
                           std::size_t solution);

const char* shape_word(LightPlan::Shape shape);  // "ellipsoid", "convex", "mesh"

// Pairs of periods that came to one: the same mode and periods, and an ellipsoid of the same cost.
struct PairGroup {
  std::size_t best;                // of the report's pairs
  std::vector<std::size_t> pairs;  // all of them, `best` first
};
// By what each came to, its surface where it has one, the lowest first; those that came to nothing
// left out.
std::vector<PairGroup> groups_of_pairs(const LightReport& report);

// Fluxes of a solution at all points, session by session.
std::vector<std::vector<double>> fluxes_of(const LightReport& report, std::size_t solution);

// From so many points on, means of neighbouring points are recommended.
inline constexpr std::size_t many_points = 3000;
std::size_t count_points(std::span<const light::LightCurve> curves);

// A point whose residual is more than four times the spread of all.
struct FarPoint {
  ObservedRow place;
  double r;  // in standard errors as given
};
std::vector<FarPoint> far_points(const LightReport& report, const fit::LightSolution& s);
// "3 of table 1, 17 of table 2, ..."; tables only if there are several.
std::string lines_of(const Scenario& scenario, const std::vector<ObservedRow>& places);

// What was minimised, where that is not chi-square, and the points that are far from the model.
void add_loss(std::string& text, const Scenario& scenario, const LightReport& report,
              const fit::LightSolution& s);

// The sentence for a scan of these curves for which one period or a constant is enough; empty
// otherwise.
std::string scan_verdict(const Scenario& scenario, const LightScan& scan,
                         std::span<const light::LightCurve> curves);
// The sentence for solutions none of which describes the data, and what is wrong; empty otherwise.
std::string misfit_text(const Scenario& scenario, const LightReport& report);

// Sentences on what was read: magnitudes taken for fluxes, errors far from the scatter of
// neighbours, single points that are far from their neighbours. Errors are called too small only
// if no model of the report describes the data.
std::vector<std::string> data_notes(const Scenario& scenario, const LightReport& report);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
