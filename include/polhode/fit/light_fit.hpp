// SPDX-License-Identifier: MIT
// In this header: inertia_from_periods, light_model, light_fit, period_labels, likely_periods,
// derived_parameters.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/spin_fit.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/light/convex_body.hpp"
#include "polhode/light/ellipsoid.hpp"
#include "polhode/light/facet_brightness.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/light/scattering.hpp"
#include "polhode/shape/facet_shape.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

// Bodies that tumble with two given periods: where a fit of moments and attitude starts.
//
// Equations   P_phi = 2 pi / precession_rate_long, P_psi = polhode_period (free/free_rotation.hpp)
//             depend on the momentum by its size alone, so that P_psi / P_phi is one equation for
//             the ratios I1/I3 and I2/I3 of moments I1 < I2 < I3 and for the tilt: the most that
//             the axis of circulation, long or short, leans from the momentum. A tilt picks a curve
//             in the plane of ratios, I2/I3 the point of it.
// Units       periods in the unit of time, tilt in radians; moments in units of the greatest.
// Domain      mode short_axis or long_axis, tilt in (0, pi/2), I2/I3 in (1/2, 1).
// Accuracy    budget periods_of_body in tests/budgets/fit.hpp.
// Errors      DomainError for periods that are not positive, another mode, a tilt or ratio beyond
//             the domain, and where no body of this tilt and ratio has these periods (with the
//             P_psi/P_phi that there are).
// Cost        ten to twenty preparations of a FreeRotation: tens of microseconds.

struct TumblerPeriods {
  Regime mode;  // short_axis or long_axis
  double precession_period;
  double rotation_period;
};

struct TumblingBody {
  Body body;         // I1/I3, I2/I3, 1 about b1, b2, b3
  RotorState state;  // momentum along the third inertial axis, at the tilt
};

TumblingBody body_with_periods(const TumblerPeriods& periods, double tilt, double middle);

// The curve of a tilt: those of `count` evenly spaced I2/I3 that exist; maybe none.
std::vector<TumblingBody> inertia_from_periods(const TumblerPeriods& periods, double tilt,
                                               std::size_t count);

// LightModel: a tumbling body that scatters light. Its shape is an ellipsoid, a convex body by the
// areas of its facets, or a given mesh.
//
// Units       of spin those of light curves; lengths in any unit, since a light curve knows no
//             size; moments in any unit.
// Domain      axes F are those of the shape. Moments along them are arbitrary; MomentSource
//             (light_fit.hpp) chooses those of a fit. A convex body with the light of a body that
//             has hollows is only a model of it.
// Errors      DomainError as GaussianImage, ShadedMesh and convex_body.
// Cost        a mesh and the basis of a convex body are shared by copies.

struct ConvexShape {
  light::GaussianImage image;
  std::vector<double> coefficients;  // of `image`

  // The facets of an ellipsoid, in units of its b.
  static ConvexShape of(const light::Ellipsoid& ellipsoid, int degree = 6, int rows = 8);

  std::vector<double> areas() const { return image.areas(coefficients); }
  // The body itself, its centre of mass in the origin, along axes F.
  shape::FacetShape mesh() const;
};

using LightShape = std::variant<light::Ellipsoid, ConvexShape, light::ShadedMesh>;

struct LightModel {
  SpinState spin;
  LightShape shape = light::Ellipsoid{1.0, 1.0, 1.0};
  light::Scattering law;

  // An ellipsoid with the moments of an even filling.
  static LightModel homogeneous(double t0, const Quaternion& q, const Vec3& w_F,
                                const light::Ellipsoid& shape, const light::Scattering& law = {});

  bool is_ellipsoid() const { return std::holds_alternative<light::Ellipsoid>(shape); }
  bool is_convex() const { return std::holds_alternative<ConvexShape>(shape); }
  bool is_mesh() const { return std::holds_alternative<light::ShadedMesh>(shape); }
  // std::bad_variant_access for other shapes.
  const light::Ellipsoid& ellipsoid() const { return std::get<light::Ellipsoid>(shape); }
  const ConvexShape& convex() const { return std::get<ConvexShape>(shape); }
  const light::ShadedMesh& mesh() const { return std::get<light::ShadedMesh>(shape); }
};

// The inertia at constant density about the centre of mass, along the axes of the mesh, in units of
// its Izz.
Mat3 homogeneous_inertia(const shape::FacetShape& shape);

// The ellipsoid of constant density with the principal moments of a tensor, 1 = a >= b >= c.
// DomainError if no body has them.
light::Ellipsoid ellipsoid_of_moments(const Mat3& inertia);

// The inertia of a convex body of constant density.
struct ShapeInertia {
  double Ixx, Iyy;  // over Izz, about the axes F
  double axes_off;  // rad: the greatest angle between its principal axes and those of F
};
ShapeInertia shape_inertia(const ConvexShape& shape);

// fit_light(): light curves of a tumbling body to its spin state and shape, from one start. The
// shape is that of the start: an ellipsoid, a convex body of facets, or a mesh that is known.
//
// Equations   flux = f B(shape, law; q* s q, q* o q) in free rotation (polhode/free/). f is one
//             factor for each relative session and one for all calibrated ones, the best one at
//             every trial (variable projection), whose change is part of the derivatives: f = sum(w
//             F B) / sum(w B^2), and under a robust loss the f of the least sum of losses; of
//             several minima that cauchy may have, the one that descent meets from the weighted
//             median of F / B. Motion by dual numbers as fit_spin has it. Unknowns: the attitude at
//             t0 as a rotation vector, w_F, and what LightUnknowns names.
//             Ellipsoid: B of light/lambert.hpp; its unknowns are b/a and c/b.
//             Convex body: B = sum of A_j S_h(n_j . o, n_j . s), A_j of GaussianImage, each facet a
//             patch (patch_brightness.hpp); its unknowns are c_lm with l > 0, c_00 being part of
//             the factors. Beside the data, as residuals of priors: closure, sum A_j n_j / A over
//             closure_error, A = sum A_j; the products of the area tensor, sum A_j n_j n_j^T / A,
//             over axes_error, so that axes F are nearly those of inertia; roughness, l (l + 1)
//             (c_lm - usual) over roughness_error; and the ratios of moments about the usual ones.
//             Mesh: B of light/shaded_mesh.hpp; no unknowns. Derivatives by the attitude are those
//             of the facets that are lit and seen, exact between the directions at which a facet
//             goes into shadow or comes out of it; what comes and goes there is left out of them.
// Units       t that of the light curves, w rad per unit of time; fluxes at unit distances
//             (at_unit_distances in light/aspect.hpp), in any unit; moments in units of Izz, areas
//             in units of the b of the ellipsoid that a convex body begins with.
// Domain      axes F are those of the shape, and principal but for a mesh whose moments stay.
//             Moments of an even filling of an ellipsoid: 1 >= b/a >= 0.05, 1 >= c/b >= 0.05, so
//             that a is about the axis of the least moment; other moments: both between 0.05 and
//             20. Those of a convex body follow the areas, also in derivatives and errors, linear
//             in them within a round of iterations; the fit has converged where they are those of
//             the body to 1e-5. Times are free of light time.
// Accuracy    budget light_derivatives in tests/budgets/fit.hpp, where the motion is no degenerate
//             one, convex_moments_by_areas of moments that follow areas; errors: covariance.hpp, of
//             factors that follow, and of convex bodies only under their regularisation. The
//             facets of a mesh are those of the body, which bend its light where they pass a
//             terminator, so that a fit stops next to the minimum: converged is nearer than
//             one standard error, or 1 of chi-square. Shadows jump by the light of a facet: fine
//             meshes keep that below the errors of the data, and a fit that stalls in the jumps
//             says that it did not converge.
// Errors      DomainError as require_sound and solve; a start that no body has; fewer points than
//             unknowns and factors; regularisation errors that are not above 0; MomentSource::shape
//             of a mesh, which does not change.
// Cost        benchmarks/fit_light_curves.cpp: about 2 us a point and iteration; facets
//             (degree + 1)^2 flops of a convex body, whose moments take one convex_moments for ten
//             iterations besides where they follow; that of the mesh at each point
//             (benchmarks/brightness.cpp), about three times with derivatives.

// The source of moments of inertia: the shape filled evenly, the start, or the
// unknowns Ixx/Izz and Iyy/Izz.
enum class MomentSource { shape, start, fit };

struct LightUnknowns {
  bool shape = true;  // b/a and c/b of an ellipsoid, facets of a convex body; a mesh is known
  MomentSource moments = MomentSource::shape;
  bool multiple = false;  // the weight of Lambert's law, that of Lommel and Seeliger's being 1
};

// The regularisation of a convex body: priors that keep it closed, along its axes and smooth.
struct Regularisation {
  double closure_error = 1e-3;
  double axes_error = 1e-2;
  double roughness_error = 3.0;
  double moments_error = 0.1;  // infinity: nothing is known of moments
  // The ellipsoid or convex body whose coefficients and moments are the usual ones; none: those of
  // the start. So a fit can go on from what another one found.
  std::optional<LightModel> about = std::nullopt;
};

struct LightFit {
  std::vector<light::LightCurve> curves;
  LightModel start;
  LightUnknowns unknowns;
  Loss loss;
  int most_iterations = 200;
  double first_step = 0.0;  // as LeastSquares
  Regularisation regularisation = {};
};

// A part of the sum that was minimised.
struct CostTerm {
  std::string name;
  double value;
};

// The greatest chi-square per degree of freedom, or square of the spread under a robust loss, at
// which a model is taken to describe the data.
inline constexpr double most_chi_square = 10.0;

struct LightSolution {
  LightModel body;  // of an ellipsoid a = 1
  LeastSquaresResult result;
  UnknownsCovariance covariance;  // of errors as they are given; turns about the body found
  std::vector<double> factors;    // of each session
  double degrees_of_freedom = 0.0;
  // How the body tumbles: periods are 0 where the regime has none.
  TumblerPeriods periods{};
  Vec3 pole;  // direction of the momentum, along I
  std::vector<std::string> notes;

  Loss loss;               // that was minimised
  std::size_t points = 0;  // numbers of data, with which those of the result begin
  // Terms of result.cost: "data" under the loss, and for convex bodies those that regularise them.
  std::vector<CostTerm> terms;

  // By which all errors of fluxes, and so those of the unknowns, would be as large as residuals: by
  // chi-square, or under a robust loss by the spread, as chi-square is that of the points it
  // spared. NaN where the data leave no degrees of freedom, fewer than 0.5.
  double error_factor() const;
  // The standard deviation of the residuals, in their errors, by the median of their sizes.
  double spread() const;
  // Whether error_factor()^2 is at most most_chi_square. Otherwise errors mean nothing.
  bool describes_data() const;
  // Nothing that did not converge counts as found.
  bool is_found() const { return result.is_converged(); }
};

LightSolution fit_light(const LightFit& fit);

// The problem that it solves, for another optimiser or a sampler (residual_function.hpp): turns are
// about the attitude of the start, factors of sessions the best ones under the loss of the fit;
// regularisation is among the residuals, as priors. Moments that follow the areas of a convex body
// are those of the body at every x, one convex_moments each: no value where the areas close none,
// and DomainError where those of the start do.
LeastSquares least_squares_of(const LightFit& fit);
// The body at some values of the unknowns.
LightModel body_at(const LightFit& fit, std::span<const double> x);

// The unknowns of a body, in the order of the covariance of a fit from `about`, which has the same
// shape.
std::vector<double> light_unknowns_at(const LightUnknowns& unknowns, const LightModel& about,
                                      const LightModel& body);

// Fluxes of the model at all points, session by session, with the best factor of each under a loss.
std::vector<std::vector<double>> model_fluxes(const LightModel& body,
                                              std::span<const light::LightCurve> curves,
                                              const Loss& loss = {});

// Labels of a pair of frequencies: which periods of precession and rotation a tumbler may have that
// shows these two lines.
//
// Equations   lines of a light curve are at |j f_phi + k f_psi|, f_phi = 1 / P_phi of the long axis
//             about the momentum, f_psi = 1 / P_psi about it (Kaasalainen 2001; Samarasinha and
//             A'Hearn 1991); a scan may also find half of that, as its series has harmonics. A body
//             with three planes of symmetry, as an ellipsoid, has those alone with k even in
//             long-axis mode, where half a turn about the long axis is half a polhode, and those
//             with j + k even in short-axis mode, where half a turn about the short axis is half a
//             polhode and turns the long axis about. In short-axis mode P_psi > P_phi: the least
//             ratio is 1 / sqrt((I3/I1 - 1)(I3/I2 - 1)), I1 < I2 < I3, which I3 <= I1 + I2 keeps
//             from falling below 1, for flat bodies. In long-axis mode it is 1 / sqrt((1 - I1/I2)(1
//             - I1/I3)) - 1 and thin bodies have any. Ellipsoids have all of the triangle but its
//             flat edge, so that the bounds are theirs, too.
// Units       frequencies in turns per unit of time, periods in that unit.
// Domain      positive frequencies.
// Accuracy    a system of two equations in double.
// Errors      DomainError for frequencies that are not positive, most below 1 or above 9.
// Cost        some (4 most + 4)^4 / 2 labels looked at: half a millisecond.

// (j f_phi + k f_psi) / over, over = 1 or 2.
struct LineLabel {
  int j, k;
  int over = 1;

  bool operator==(const LineLabel&) const = default;
};

struct PeriodLabel {
  Regime mode;  // short_axis or long_axis
  double precession_period;
  double rotation_period;
  LineLabel first, second;  // what f1 and f2 are then
  bool of_ellipsoid;  // whether a body with three planes of symmetry shows both, or twice both
};

// All with |j|, |k| up to `most`, and up to most + 1 of halves. Those of ellipsoids first, then by
// how strong such lines are expected to be: 2 f_phi, 2 (f_phi +- f_psi), then simple ones, then the
// rest, then halves.
std::vector<PeriodLabel> period_labels(double f1, double f2, int most = 2);

// Whether a body can have the periods of a label in its mode.
bool allows(const Body& body, const PeriodLabel& label);

// likely_periods(): which periods of a tumbler the whole Fourier series of a light curve speaks
// for.
//
// Equations   f_phi and f_psi are read from any two of the three strongest lines of the series,
//             each as one of the strong lines of a tumbler, j f_phi + k f_psi with |j|, |k| <= 2
//             and few beyond; every line of the series is then j f_phi + k f_psi for some j, k.
//             Ranked by sum p ln s, p the share of a line in the power of the series, s the share
//             that the line of these j, k has in the light of ellipsoids on average, by mode.
// Units       frequencies in turns per unit of time, periods in that unit.
// Domain      a series with two lines of different directions. In short-axis mode P_psi > P_phi. It
//             says what is likely for an ellipsoid; bodies without its symmetry have weak lines
//             where it has none, which costs ln 1000 of their share.
// Accuracy    docs/design/0053-light-labels.md has how high the true periods stand in the list.
// Errors      none; nothing is found where all amplitudes but one vanish.
// Cost        some 1000 labels looked at: a millisecond.

struct LikelyPeriods {
  TumblerPeriods periods;
  double score;  // the mean of ln s, below 0
};

// The most likely first; those that are the same to 1e-3 once.
std::vector<LikelyPeriods> likely_periods(const FourierFit& fit);

// DerivedParameters: what a fitted spin state is known by, with its errors: the two periods of a
// tumbler and its pole.
//
// Equations   var f = (df/dx)^T C df/dx for f = P_phi (long axis), P_psi, P_short and the pole;
//             1/P_short = 1/P_phi + 1/P_psi; df/dx by dual numbers through prepared free motion.
// Units       those of the fit; errors of the pole in rad, along the axes of the ellipse that they
//             are on the sky.
// Domain      a covariance whose unknowns have the names that fit_spin and fit_light give them,
//             about `state`; b/a and c/b change moments where `moments_of_shape` says so. Periods
//             are 0 where the regime has none; their errors are NaN where the motion is a
//             degenerate one. Errors are infinite of what depends on an unknown that the data do
//             not determine, those of the pole then both; a correlation with it is NaN.
// Accuracy    first order in the errors; budget derived_parameters in tests/budgets/fit.hpp.
// Errors      DomainError as FreeRotation; for a state without momentum.
// Cost        one preparation with dual numbers: some hundred microseconds.

struct DerivedParameters {
  TumblerPeriods periods;
  double precession_error, rotation_error;
  // Of precession of the short axis, which most papers give for tumblers; 0 as those of `periods`.
  double short_period, short_error;
  double correlation;  // of the two
  // Of the periods, by the unknowns of the covariance; empty where they are 0.
  std::vector<double> precession_slope, rotation_slope;
  Vec3 pole_I;  // of length 1
  double pole_major, pole_minor;
  Vec3 major_I;  // in which direction the pole is known least
};

DerivedParameters derived_parameters(const SpinState& state, const UnknownsCovariance& covariance);
// Of an ellipsoid whose moments follow from its axes, if the fit had them so.
DerivedParameters derived_parameters(const LightSolution& solution, const LightUnknowns& unknowns);
// Of a fit of attitudes: with moments that are held, the period of a wobble has no error.
DerivedParameters derived_parameters(const SpinSolution& solution);
// Attitudes with the errors that a fit of light curves leaves.
std::vector<PredictedAttitude> predicted(const LightSolution& solution,
                                         const LightUnknowns& unknowns,
                                         std::span<const double> times);

}  // namespace fit
}  // namespace v0
}  // namespace polhode
