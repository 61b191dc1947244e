// SPDX-License-Identifier: MIT
// Light curves: what is wrong with one, magnitudes, aspect, light time.
#include "polhode/light/light_curve.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/light/aspect.hpp"
#include "polhode/light/light_time.hpp"

namespace polhode {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

// Three sound points, with vectors.
light::LightCurve sound() {
  return {"night 1",
          false,
          {{1.0, 0.9, 0.01, {1.0, 0.0, 0.0}, {0.0, 0.5, 0.0}},
           {2.0, 1.0, 0.02, {1.0, 0.0, 0.1}, {0.0, 0.5, 0.1}},
           {4.0, 1.1, 0.01, {1.0, 0.0, 0.2}, {0.0, 0.5, 0.2}}}};
}

std::string refusal(const std::vector<light::LightCurve>& curves, bool vectors = false) {
  try {
    light::require_sound(curves, {vectors});
  } catch (const DomainError& error) {
    return error.what();
  }
  return "sound";
}

template <class Change>
std::string refusal_of_changed(const Change& change, bool vectors = false) {
  light::LightCurve curve = sound();
  change(curve);
  return refusal({curve}, vectors);
}

TEST(LightCurveChecks, SoundOnesPass) {
  EXPECT_EQ(refusal({sound()}, true), "sound");
  EXPECT_FALSE(light::first_flaw({}));
  light::LightCurve noise = sound();
  noise.points[0].flux = -0.01;  // a faint body, and noise
  EXPECT_EQ(refusal({noise}), "sound");
  const light::LightCurve single{"", true, {{5.0, 1.0, 0.1, {}, {}}}};
  EXPECT_EQ(refusal({sound(), single}), "sound");
}

TEST(LightCurveChecks, ASentenceForEachFlaw) {
  const auto said = [](const auto& change) { return refusal_of_changed(change); };
  const std::string start = "light curve 1 (night 1)";
  EXPECT_EQ(said([](light::LightCurve& c) { c.points.clear(); }),
            start + " has no points; expected one or more");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[1].t = nan; }),
            start + ": point 2: time nan; expected a finite number");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[1].flux = inf; }),
            start + ": point 2: flux inf; expected a finite number");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[2].sigma = nan; }),
            start + ": point 3: error nan; expected a finite number");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[2].sigma = 0.0; }),
            start + ": point 3: error 0; expected one above 0");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[0].sigma = -0.5; }),
            start + ": point 1: error -0.5; expected one above 0");
  EXPECT_EQ(said([](light::LightCurve& c) {
              for (light::LightPoint& p : c.points) p.sigma = 0.0;
            }),
            start + " has no errors; expected those of the points, or one of all");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[2].t = 1.5; }),
            start +
                ": point 3: time 1.5 comes after 2 of point 2; expected rising times, or points "
                "that are to be sorted");
  // two telescopes in the same second
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[1].t = 1.0; }), "sound");
  EXPECT_EQ(said([](light::LightCurve& c) {
              c.points[2] = c.points[0];
              c.points[1].t = c.points[2].t;
            }),
            start +
                ": point 3: time 1 and flux 0.9 stand twice, here and in point 1; expected each "
                "observation once");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points.resize(1); }),
            start +
                " is relative and has one point, which says nothing, as its factor is free; "
                "expected two points or more, or calibrated fluxes");
  EXPECT_EQ(said([](light::LightCurve& c) {
              c.points[0].flux = -4.0;
              c.points[2].flux = 0.0;
            }),
            start + " is relative, with the mean flux -1; expected one above 0");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[0].to_sun.y = nan; }),
            start + ": point 1: the vector to the Sun is not finite");
  EXPECT_EQ(said([](light::LightCurve& c) { c.points[0].to_observer.z = inf; }),
            start + ": point 1: the vector to the observer is not finite");
}

TEST(LightCurveChecks, VectorsAreMissedWhereTheyAreNeeded) {
  const auto without_sun = [](light::LightCurve& c) { c.points[1].to_sun = {}; };
  const auto without_observer = [](light::LightCurve& c) { c.points[2].to_observer = {}; };
  EXPECT_EQ(refusal_of_changed(without_sun), "sound");
  EXPECT_EQ(refusal_of_changed(without_sun, true),
            "light curve 1 (night 1): point 2: there is no vector to the Sun; expected one, in the "
            "file or from an orbit");
  EXPECT_EQ(refusal_of_changed(without_observer, true),
            "light curve 1 (night 1): point 3: there is no vector to the observer; expected one, "
            "in the file or from an orbit");
}

TEST(LightCurveChecks, AnObservationBelongsToOneSession) {
  light::LightCurve other = sound();
  other.name.clear();
  other.points.erase(other.points.begin());
  EXPECT_EQ(refusal({sound(), other}),
            "light curve 2: point 1: time 2 and flux 1 are those of point 2 of light curve 1; "
            "expected each observation in one session");
  for (light::LightPoint& p : other.points)
    p.flux += 0.001;  // another telescope, at the same times
  EXPECT_EQ(refusal({sound(), other}), "sound");
}

TEST(LightCurveChecks, PointsAreSortedForWhoAsks) {
  light::LightCurve curve = sound();
  std::swap(curve.points[0], curve.points[2]);
  EXPECT_NE(refusal({curve}), "sound");
  EXPECT_EQ(light::in_order_of_time(curve), sound());
}

TEST(Magnitudes, FluxesAreThoseOfPogson) {
  for (const double m : {-27.3, -0.1, 0.0, 1e-8, 12.345, 25.0}) {
    for (const double zero : {0.0, 14.2}) {
      const light::Flux flux = light::flux_of({m, 0.03}, zero);
      const Wide exact = pow(Wide(10), -Wide(4) / 10 * (Wide(m) - Wide(zero)));
      const Wide sigma = Wide(4) / 10 * log(Wide(10)) * exact * Wide(0.03);
      EXPECT_LT(abs(Wide(flux.value) / exact - 1), budget::light_flux);
      EXPECT_LT(abs(Wide(flux.sigma) / sigma - 1), budget::light_flux);
      const light::Magnitude back = light::magnitude_of(flux, zero);
      EXPECT_NEAR(back.value, m, budget::light_magnitude);
      EXPECT_NEAR(back.sigma, 0.03, budget::light_flux * 0.03);
    }
  }
  EXPECT_TRUE(std::isnan(light::magnitude_of({0.0, 1.0}).value));
  EXPECT_TRUE(std::isnan(light::magnitude_of({-1.0, 1.0}).sigma));
  EXPECT_TRUE(std::isnan(light::magnitude_of({nan, 1.0}).value));
}

TEST(Magnitudes, RelativeSessionsHaveTheMeanOne) {
  light::LightCurve curve = sound();
  for (light::LightPoint& p : curve.points) {
    p.flux *= 300.0;
    p.sigma *= 300.0;
  }
  const light::LightCurve scaled = light::normalised(curve);
  EXPECT_NEAR(light::mean_flux(scaled), 1.0, budget::light_flux);
  EXPECT_NEAR(scaled.points[2].flux / scaled.points[0].flux, 11.0 / 9.0, budget::light_flux);
  EXPECT_NEAR(scaled.points[1].sigma, 0.02, budget::light_flux);
  EXPECT_EQ(light::with_relative_sigma(curve, 0.05).points[0].sigma,
            0.05 * light::mean_flux(curve));
  EXPECT_TRUE(std::isnan(light::mean_flux({})));
  for (light::LightPoint& p : curve.points) p.flux = -7.0;
  EXPECT_MESSAGE(light::normalised(curve),
                 "normalised: light curve night 1: its mean flux is -7; expected one above 0");
  EXPECT_MESSAGE(light::with_relative_sigma(sound(), 0.0),
                 "with_relative_sigma: fraction 0; expected one above 0");
}

TEST(AspectOf, IsThatOfTheTriangle) {
  // Sun, body and observer as a triangle with sides 2, 1.5 and, between Sun and observer, 1.
  const double r = 2.0, delta = 1.5, base = 1.0;
  const double cosine = (r * r + delta * delta - base * base) / (2.0 * r * delta);
  const double angle = std::acos(cosine);
  light::LightPoint p;
  p.to_sun = {0.0, r, 0.0};
  p.to_observer = {delta * std::sin(angle), delta * std::cos(angle), 0.0};
  const light::Aspect a = light::aspect(p);
  EXPECT_EQ(a.sun_distance, r);
  EXPECT_NEAR(a.observer_distance, delta, budget::light_aspect);
  EXPECT_NEAR(a.phase_angle, angle, budget::light_aspect);
  EXPECT_NEAR(a.bisector.x, std::sin(0.5 * angle), budget::light_aspect);
  EXPECT_NEAR(a.bisector.y, std::cos(0.5 * angle), budget::light_aspect);
  EXPECT_NEAR(light::reduced_magnitude(15.0, r, delta), 15.0 - 5.0 * std::log10(3.0),
              budget::light_magnitude);
}

TEST(AspectOf, KeepsSmallAnglesAndSaysWhatThereIsNot) {
  const light::Aspect small = light::aspect({0.0, 1.0, 0.1, {1e8, 0.0, 0.0}, {1e7, 1e-2, 0.0}});
  EXPECT_NEAR(small.phase_angle, 1e-9, budget::light_aspect * 1e-9);
  const light::Aspect opposite = light::aspect({0.0, 1.0, 0.1, {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}});
  EXPECT_EQ(opposite.phase_angle, std::numbers::pi);
  EXPECT_TRUE(std::isnan(opposite.bisector.x));
  const light::Aspect none = light::aspect({0.0, 1.0, 0.1, {1.0, 0.0, 0.0}, {}});
  EXPECT_EQ(none.sun_distance, 1.0);
  EXPECT_TRUE(std::isnan(none.observer_distance) && std::isnan(none.phase_angle));
}

TEST(AspectOf, FluxesAtUnitDistances) {
  light::LightCurve curve = sound();
  curve.points.resize(1);
  curve.points[0].to_sun = {3.0, 0.0, 4.0};
  curve.points[0].to_observer = {0.0, 2.0, 0.0};
  const light::LightCurve unit = light::at_unit_distances(curve, 2.0);
  EXPECT_NEAR(unit.points[0].flux, 0.9 * 6.25, budget::light_flux);
  EXPECT_NEAR(unit.points[0].sigma, 0.01 * 6.25, budget::light_flux);
  EXPECT_MESSAGE(light::at_unit_distances(curve, 0.0),
                 "at_unit_distances: unit 0; expected a length above 0");
  curve.points[0].to_sun = {};
  EXPECT_MESSAGE(light::at_unit_distances(curve, 1.0),
                 "at_unit_distances: light curve night 1: point 1 has no distances; expected "
                 "vectors to the Sun and to the observer");
}

// Along straight lines the light time is a root of a quadratic equation, solved here in 50 digits.
struct Line {
  Vec3 start, velocity;
  Vec3 operator()(double t) const { return start + t * velocity; }
};

Wide exact_light_time(const Line& moving, const Vec3& fixed, double t, double c, int direction) {
  // |p + direction tau v| = c tau, with p from the fixed end to the moving one at t
  Wide pp = 0, pv = 0, vv = 0;
  for (int i = 0; i < 3; ++i) {
    const Wide p = Wide(moving.start[i]) + Wide(t) * Wide(moving.velocity[i]) - Wide(fixed[i]);
    const Wide v = direction * Wide(moving.velocity[i]);
    pp += p * p;
    pv += p * v;
    vv += v * v;
  }
  const Wide a = Wide(c) * Wide(c) - vv;
  return (pv + sqrt(pv * pv + a * pp)) / a;
}

TEST(LightTimes, VectorsComeFromWhereTheBodyWasWhenLightLeft) {
  const double c = 299792.458;
  const Line body{{2.5e8, 1e7, -3e6}, {-4.0, 19.0, 1.5}},
      observer{{1.4e8, -2e7, 0.0}, {5.0, 29.0, 0.0}};
  const auto sun = [](double) { return Vec3{}; };
  light::LightCurve curve = sound();
  curve.points[0].t = -86400.0;
  curve.points[1].t = 0.0;
  curve.points[2].t = 1e7;
  const light::LightCurve seen =
      light::with_vectors(curve, light::LightTime::at_observer, body, observer, sun, c);
  for (std::size_t k = 0; k < 3; ++k) {
    const double t = curve.points[k].t;
    const Wide tau = exact_light_time(body, observer(t), t, c, -1);
    const light::LightPoint& p = seen.points[k];
    EXPECT_LT(abs(Wide(t) - tau - Wide(p.t)), budget::light_time_s);
    EXPECT_EQ(p.to_sun, -body(p.t));
    EXPECT_EQ(p.to_observer, observer(t) - body(p.t));
    EXPECT_NEAR(norm(p.to_observer) / c, tau.convert_to<double>(), budget::light_time_s);
    EXPECT_EQ(p.flux, curve.points[k].flux);
  }
  // and back: from the times at the body the same vectors
  const light::LightCurve again =
      light::with_vectors(seen, light::LightTime::at_body, body, observer, sun, c);
  for (std::size_t k = 0; k < 3; ++k) {
    const light::LightPoint &p = seen.points[k], &q = again.points[k];
    EXPECT_EQ(p.t, q.t);
    EXPECT_EQ(p.to_sun, q.to_sun);
    EXPECT_LT(norm(p.to_observer - q.to_observer), budget::light_time_km);
    const Wide tau = exact_light_time(observer, body(p.t), p.t, c, 1);
    EXPECT_NEAR(norm(q.to_observer) / c, tau.convert_to<double>(), budget::light_time_s);
  }
}

TEST(LightTimes, TimesAtTheBodyByTheDistanceOfEachPoint) {
  const light::LightCurve corrected = light::at_body(sound(), 0.25);
  EXPECT_EQ(corrected.points[0].t, -1.0);
  EXPECT_EQ(corrected.points[0].to_sun, sound().points[0].to_sun);
  EXPECT_EQ(light::at_body_after(sound(), 0.5).points[2].t, 3.5);
  light::LightCurve without = sound();
  without.points[1].to_observer = {};
  EXPECT_MESSAGE(light::at_body(without, 1.0),
                 "light curve night 1: point 2: there is no vector to the observer; expected one, "
                 "or a light time");
  EXPECT_MESSAGE(light::at_body(sound(), 0.0),
                 "light time: speed of light 0; expected one above 0");
  EXPECT_MESSAGE(light::at_body_after(sound(), nan),
                 "at_body_after: light time nan; expected a finite time, 0 or more");
  EXPECT_MESSAGE(light::at_body_after(sound(), -0.5),
                 "at_body_after: light time -0.5; expected a finite time, 0 or more");
  EXPECT_EQ(light::at_body_after(sound(), 0.0), sound());
}

TEST(LightCurveMessages, OneWithoutANameHasNone) {
  light::LightCurve curve = sound();
  curve.name.clear();
  for (light::LightPoint& p : curve.points) p = {p.t, -1.0, p.sigma, {}, {}};
  EXPECT_MESSAGE(light::normalised(curve),
                 "normalised: light curve: its mean flux is -1; expected one above 0");
  EXPECT_MESSAGE(light::at_unit_distances(curve, 1.0),
                 "at_unit_distances: light curve: point 1 has no distances; expected vectors to "
                 "the Sun and to the observer");
  EXPECT_MESSAGE(
      light::at_body(curve, 1.0),
      "light curve: point 1: there is no vector to the observer; expected one, or a light time");
}

TEST(LightTimes, ABodyFasterThanLightHasNone) {
  const Line body{{10.0, 0.0, 0.0}, {-3.0, 0.0, 0.0}}, observer{};
  const auto sun = [](double) { return Vec3{}; };
  EXPECT_MESSAGE(
      light::with_vectors(sound(), light::LightTime::at_observer, body, observer, sun, 1.0),
      "light curve night 1: point 1: its light time does not converge; expected finite "
      "positions of bodies that are slower than light");
}

}  // namespace
}  // namespace polhode
