// SPDX-License-Identifier: MIT
// Spin axes over ages. Oracles: the closed form on an orbit that stays, the other axes, the other
// method, and published numbers of the Earth.
#include "polhode/secular/spin_precession.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
using polhode::test::Worst;
using ::testing::HasSubstr;

constexpr double deg = std::numbers::pi / 180.0, arcsec = deg / 3600.0;

// Three of the largest terms of e and i of the Earth (Laskar 1988, tables 4 and 5); time in years.
secular::ElementSeries earth_like() {
  return {{{4.248976 * arcsec, 0.0189700, 30.613 * deg},
           {7.455487 * arcsec, 0.0163175, 199.811 * deg},
           {17.922491 * arcsec, 0.0129891, 151.998 * deg}},
          {{-18.848 * arcsec, 0.0106447, 234.0 * deg},
           {-5.61 * arcsec, 0.0055047, 348.7 * deg},
           {0.0, 0.01377449, 107.58 * deg}}};
}
constexpr secular::PrecessionRates earth_rates{
    .star = 17.37 * arcsec, .satellites = 37.5 * arcsec, .geodetic = 0.019 * arcsec};

secular::SpinAxis tilted(double obliquity) {
  return {{0.0, std::sin(obliquity), std::cos(obliquity)}};
}

template <class M>
secular::SpinAxis moved(const M& model, const secular::SpinAxis& start, double time,
                        const Method& method) {
  const Keep last{.samples = SaveAt::times({time}), .dense = false};
  return integrate(BasicProblem<M>{model, start, 0.0, time, method}, last).samples().back().s;
}

double apart(const secular::SpinAxis& a, const secular::SpinAxis& b) { return norm(a.s - b.s); }

TEST(OrbitElements, AxesAreThoseOfTheOrbit) {
  const double e = 0.3, i = 1.1, node = 0.7, argument = 2.2;
  const secular::OrbitElements o = secular::orbit_elements(e, i, node, argument);
  EXPECT_NEAR(secular::eccentricity(o), e, budget::secular_rounding);
  const Quaternion q = rotation_z(node) * rotation_x(i);
  EXPECT_LT(norm(secular::orbit_normal(o) - rotate(q, Vec3{0, 0, 1})), budget::secular_rounding);
  const Vec3 pericentre{std::cos(argument), std::sin(argument), 0.0};
  EXPECT_LT(norm(secular::pericentre_direction(o) - rotate(q, pericentre)),
            budget::secular_rounding);
  EXPECT_LT(
      norm(rotate(secular::equinoctial_attitude(o), Vec3{0, 0, 1}) - secular::orbit_normal(o)),
      budget::secular_rounding);
}

TEST(OrbitElements, ATableIsTheSeriesBetweenItsRows) {
  const secular::ElementSeries series = earth_like();
  std::vector<double> times;
  std::vector<secular::OrbitElements> rows;
  for (int k = 0; k <= 200; ++k) {
    times.push_back(1000.0 * k + (k % 3 == 1 ? 200.0 : 0.0));  // of no single cadence
    rows.push_back(series.at(times.back()));
  }
  const secular::ElementTable table(times, rows);
  Worst worst;
  for (double t = 6000.0; t < 194000.0; t += 137.0) {
    const secular::OrbitElements a = table.at(t), b = series.at(t);
    worst.add(std::hypot(a.k - b.k, a.h - b.h, std::hypot(a.q - b.q, a.p - b.p)));
  }
  EXPECT_LT(worst.value(), budget::secular_table);
  EXPECT_TRUE(std::isnan(table.at(-1.0).k));
}

TEST(OrbitElements, WhatIsNoOrbitIsRefused) {
  const secular::OrbitElements good = secular::orbit_elements(0.1, 0.2, 0.3, 0.4);
  const auto error = [](std::vector<double> times,
                        const std::vector<secular::OrbitElements>& rows) {
    return message_of([&] { secular::ElementTable(std::move(times), rows); });
  };
  EXPECT_THAT(error({0, 1, 1, 2}, {good, good, good, good}),
              HasSubstr("ElementTable: row 2: got time 1 after 1; expected rising times"));
  EXPECT_THAT(error({0, 1, 2, 3}, {good, {0.8, 0.7, 0, 0}, good, good}),
              HasSubstr("row 1: got eccentricity 1.063"));
  EXPECT_THAT(error({0, 1, 2, 3}, {good, good, {0, 0, 0.8, 0.7}, good}),
              HasSubstr("row 2: got q^2 + p^2 = 1.13"));
  EXPECT_THAT(error({0, std::nan(""), 2, 3}, {good, good, good, good}),
              HasSubstr("row 1: got time nan; expected a finite one"));
  EXPECT_THAT(error({0, 1}, {good}), HasSubstr("got 2 times and 1 rows"));
  EXPECT_REJECTED(secular::ElementSeries({{0.1, 1.1, 0.0}}, {}),
                  "got amplitudes that add up to 1.1");
  EXPECT_REJECTED(secular::orbit_elements(1.0, 0, 0, 0), "got eccentricity 1");
  EXPECT_REJECTED(secular::orbit_elements(0.1, 4.0, 0, 0),
                  "got inclination 4; expected 0 to below pi, in rad");
  EXPECT_REJECTED(secular::orbit_elements(0.1, 1.0, std::nan(""), 0), "expected finite angles");
  EXPECT_REJECTED(secular::ElementSeries({{std::nan(""), 0.1, 0.0}}, {}),
                  "got frequency nan and phase 0; expected finite ones");
  EXPECT_REJECTED(secular::star_precession(1e-3, 0.0, 1.0, 1.0),
                  "star_precession: got ellipticity 0.001 and spin_rate 0");
  EXPECT_REJECTED(secular::satellite_precession(1e-3, 1.0, -1.0, 1.0, 0.0, 0.0),
                  "satellite_precession: gm -1");
  EXPECT_REJECTED(secular::satellite_precession(1e-3, 1.0, 1.0, 1.0, 1.0, 0.0),
                  "satellite_precession: got eccentricity 1");
  EXPECT_REJECTED(secular::spin_axis({0, 0, 0}), "direction of length 0");
}

TEST(SpinPrecession, OnAnOrbitThatStaysIsATurnAboutItsNormal) {
  const secular::ElementSeries still({{0.0, 0.2, 1.0}}, {{0.0, 0.4, 2.0}});
  const secular::PrecessionRates rates{.star = 2.0, .satellites = 1.0, .geodetic = 0.3};
  const secular::SpinPrecession model(still, rates);
  const Vec3 n = secular::orbit_normal(still.at(0.0));
  for (const double tilt : {0.0, 0.4, 1.5, 2.9, std::numbers::pi}) {
    const secular::SpinAxis start =
        secular::spin_axis(rotate(secular::equinoctial_attitude(still.at(0.0)), tilted(tilt).s));
    const double alpha = 2.0 * std::pow(1.0 - 0.04, -1.5) + 1.0;
    const double angle = -(alpha * std::cos(tilt) - 0.3) * 7.0;
    const secular::SpinAxis exact = secular::detail::turned(start, n, angle);
    for (const Method& method :
         {Method(Adaptive{1e-13}), Method(Splitting{0.1, SplittingScheme::order2})})
      EXPECT_LT(apart(moved(model, start, 7.0, method), exact), budget::secular_constant_orbit)
          << tilt;
  }
}

// 5 Myr: 190 turns of the equinox.
constexpr double ages = 5e6;

TEST(SpinPrecession, IsTheSameInTheAxesOfTheOrbit) {
  const secular::ElementSeries orbit = earth_like();
  const secular::SpinPrecession inertial(orbit, earth_rates);
  const secular::SpinInOrbitAxes moving(orbit, earth_rates);
  const secular::SpinAxis start = tilted(23.44 * deg);
  const secular::SpinAxis seen{rotate(conj(secular::equinoctial_attitude(orbit.at(0.0))), start.s)};
  const secular::SpinAxis a = moved(inertial, start, ages, Adaptive{1e-14});
  const secular::SpinAxis b = moved(moving, seen, ages, Adaptive{1e-14});
  EXPECT_LT(norm(rotate(secular::equinoctial_attitude(orbit.at(ages)), b.s) - a.s),
            budget::secular_axes);
}

TEST(SpinPrecession, SplittingIsTheAdaptiveMethodAtEveryOrder) {
  const secular::SpinPrecession model(earth_like(), earth_rates);
  const secular::SpinAxis start = tilted(23.44 * deg),
                          exact = moved(model, start, ages, Adaptive{1e-14});
  struct Row {
    SplittingScheme scheme;
    double step;
    double order;
  };
  for (const Row& row :
       {Row{SplittingScheme::order2, 625.0, 2.0}, Row{SplittingScheme::order4, 2500.0, 4.0},
        Row{SplittingScheme::order6, 5000.0, 6.0}, Row{SplittingScheme::order8, 1e4, 8.0},
        Row{SplittingScheme::ABA864, 2500.0, 4.0}}) {
    const double coarse = apart(moved(model, start, ages, Splitting{row.step, row.scheme}), exact);
    const double fine =
        apart(moved(model, start, ages, Splitting{0.5 * row.step, row.scheme}), exact);
    EXPECT_GT(std::log2(coarse / fine), row.order - budget::secular_order) << row.step;
  }
  EXPECT_LT(apart(moved(model, start, ages, Splitting{2500.0, SplittingScheme::order8}), exact),
            budget::secular_splitting);
}

TEST(SpinPrecession, TheAxisKeepsItsLength) {
  const secular::SpinPrecession model(earth_like(), earth_rates);
  const secular::SpinAxis start = secular::spin_axis({0.3, -0.2, 0.8});
  const secular::SpinAxis late = moved(model, start, 1e9, Splitting{1e4, SplittingScheme::order2});
  EXPECT_LT(std::abs(norm(late.s) - 1.0), budget::secular_length);
}

TEST(SpinPrecession, ARunGoesOnToTheLastBitFromACheckpoint) {
  const secular::SpinPrecession model(earth_like(), earth_rates);
  const BasicProblem<secular::SpinPrecession<secular::ElementSeries>> problem{
      model, tilted(0.4), 0.0, 3e5, Splitting{1000.0, SplittingScheme::order6}};
  const SaveAt times = SaveAt::steps(0.0, 3e5, 700.0);
  std::vector<BasicSample<secular::SpinAxis>> whole, rest;
  std::vector<std::pair<Checkpoint, std::size_t>> kept;  // and how many samples came before
  const auto into = [](std::vector<BasicSample<secular::SpinAxis>>& to) {
    return [&to](std::span<const BasicSample<secular::SpinAxis>> block) {
      to.insert(to.end(), block.begin(), block.end());
    };
  };
  integrate(problem, times,
            BasicStreams<secular::SpinAxis>{
                .samples = into(whole),
                .checkpoint_due = [n = 0](double) mutable { return ++n % 50 == 0; },
                .checkpoint = [&](const Checkpoint& at) { kept.emplace_back(at, whole.size()); }});
  ASSERT_GT(kept.size(), 3U);
  const auto& [from, before] = kept[2];
  resume(problem, times, from, BasicStreams<secular::SpinAxis>{.samples = into(rest)});
  whole.erase(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(before));
  EXPECT_EQ(rest, whole);
  EXPECT_GT(rest.size(), 100U);
}

TEST(SpinPrecession, MethodsThatDoNotKnowItAreRefused) {
  const secular::SpinInOrbitAxes moving(earth_like(), earth_rates);  // has no frozen motion
  EXPECT_REJECTED(moved(moving, tilted(0.4), 1.0, Splitting{1.0}),
                  "method of a spin axis seen from its orbit must be Adaptive or Collocation: the "
                  "others");
  const secular::SpinPrecession model(earth_like(), earth_rates);
  EXPECT_REJECTED(moved(model, tilted(0.4), 1.0, VariationOfConstants{}),
                  "must be Adaptive, Collocation or Splitting");
}

TEST(SpinPrecession, ATableThatEndsEndsTheRun) {
  std::vector<double> times;
  std::vector<secular::OrbitElements> rows;
  for (int k = 0; k <= 20; ++k) {
    times.push_back(1000.0 * k);
    rows.push_back(earth_like().at(times.back()));
  }
  const secular::SpinPrecession model(secular::ElementTable(times, rows), earth_rates);
  const auto run = integrate(
      BasicProblem<secular::SpinPrecession<secular::ElementTable>>{model, tilted(0.4), 0.0, 5e4,
                                                                   Splitting{500.0}},
      Keep{.dense = false});
  EXPECT_FALSE(run.outcome().ok());
  EXPECT_THAT(run.outcome().advice, HasSubstr("does what it depends on end there?"));
  EXPECT_EQ(run.stop(), 20000.0);
}

// The Earth: K0 and the ratio of Zeebe & Lourens (2022); 1.92 arcsec a century of de Sitter.
TEST(SpinPrecession, TheEarthPrecessesAsItDoes) {
  constexpr double au = 1.495978707e11, gm_sun = 1.32712440018e20, year = 365.25 * 86400.0;
  constexpr double E = 0.0032737634, w = 7.292115e-5;
  EXPECT_NEAR(secular::star_precession(E, w, gm_sun, au) * year / arcsec, 17.376,
              budget::secular_earth_constant);
  EXPECT_NEAR(secular::satellite_precession(E, w, 4.9028e12, 3.833978e8, 0.0549, 5.157 * deg) *
                  year / arcsec,
              17.376 * 2.1612, budget::secular_moon_constant);
  EXPECT_NEAR(secular::geodetic_precession(gm_sun, au, 299792458.0) * year / arcsec, 0.0192,
              budget::secular_geodetic);
  EXPECT_NEAR(secular::andoyer_factor(0.1), 1.0 - 1.5 * std::sin(0.1) * std::sin(0.1),
              budget::secular_rounding);
}

// What VPLanet's own test of the solar system prints (tests/DistorbDistrot/SSDistOrbDistRot), from
// the data of its files: Gauss's constant, a in au, days of 86400 s.
TEST(PrecessionRates, AreTheNaturalOnesOfVPLanet) {
  struct Planet {
    double ellipticity, days, a, e, obliquity, printed;
  };
  constexpr double gauss = 0.01720209895 / 86400.0;
  for (const Planet& of :
       {Planet{5.363e-3, 1.0259233, 1.52366290, 0.09341266, 25.189417, 1.166082e-12},
        Planet{1.3125e-5, 243.69, 0.72333377, 0.00677478, 177.36, -6.903194e-12},
        Planet{3.28e-3, 1.0, 1.00000321, 0.01671327, 23.44, 2.461543e-12}}) {
    const double spin = 2.0 * std::numbers::pi / (of.days * 86400.0);
    const secular::PrecessionRates rates{
        .star = secular::star_precession(of.ellipticity, spin, gauss * gauss, of.a)};
    const double rate = rates.torque(0.0, of.e * of.e) * std::cos(of.obliquity * deg);
    EXPECT_NEAR(rate, of.printed, budget::secular_printed) << of.days;
  }
}

TEST(SpinAngles, AreThoseOfTheAlmanacAtTheEpoch) {
  const double obliquity = 23.4392911 * deg;
  const secular::OrbitElements earth =
      secular::orbit_elements(0.016708634, 0.0, 0.0, 102.937 * deg);
  const secular::SpinAngles of = secular::spin_angles(tilted(obliquity), earth);
  EXPECT_NEAR(of.obliquity, obliquity, budget::secular_rounding);
  EXPECT_NEAR(of.precession, 0.0, budget::secular_rounding);
  EXPECT_NEAR(of.pericentre, 102.937 * deg, budget::secular_rounding);
  EXPECT_NEAR(of.climatic_precession, 0.016708634 * std::sin(102.937 * deg),
              budget::secular_rounding);
  // in a hundred years the equinox goes back by 5038.48 arcsec (IAU 2006, of Moon and Sun alone)
  const secular::SpinPrecession model(
      secular::ElementSeries({{0.0, 0.016708634, 0.0}}, {}),
      secular::PrecessionRates{.star = 17.376 * arcsec,
                               .satellites = 17.376 * 2.1612 * arcsec,
                               .geodetic = 0.0192 * arcsec});
  const secular::SpinAxis later = moved(model, tilted(obliquity), 100.0, Adaptive{});
  EXPECT_NEAR(secular::spin_angles(later, earth).precession / deg, 5038.4815 / 3600.0,
              budget::secular_general);
  EXPECT_TRUE(std::isnan(secular::spin_angles({{0.0, 0.0, 1.0}}, earth).precession));
}

// Saturn (Ward & Hamilton 2004): q = 0.05164 and l = 0.00278 of all its satellites, here in one,
// and 0.8306 arcsec a year.
TEST(PrecessionRates, SatellitesInTheEquatorTakeSaturnAlong) {
  const double J2 = 0.016297, lambda = 0.2199, q = 0.05164, l = 0.00278;
  const secular::InnerSatellite all{2.0 * q / 400.0, 20.0, l / (2.0 * q)};
  const double factor = secular::inner_satellites_factor(J2, lambda, {{all}});
  const double n = 12.22 * deg, spin = 2.0 * std::numbers::pi / 0.44401 * 365.25;
  const double star = secular::star_precession(J2 / lambda, spin, n * n, 1.0) / arcsec;
  EXPECT_NEAR(star * factor, 0.8306, budget::secular_saturn);
  EXPECT_EQ(secular::inner_satellites_factor(J2, lambda, {}), 1.0);
  EXPECT_MESSAGE(secular::inner_satellites_factor(0.0, lambda, {}),
                 "inner_satellites_factor: J2 0 must be positive");
}

}  // namespace
