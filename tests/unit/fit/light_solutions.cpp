// SPDX-License-Identifier: MIT
// What a search of light curves makes of the many states that its fits end at: which are one, whose
// images they are, which of them few starts find, and where unknowns that come last lead.
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <utility>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/fit/light_search.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using Beside = fit::FoundLight::Beside;

// The same body with its axes in another order, x y z becoming y z x.
fit::LightModel in_next_axes(const fit::LightModel& body) {
  fit::LightModel found = body;
  const Vec3& w = body.spin.w_F;
  found.spin.w_F = {w.y, w.z, w.x};
  // v_old = r v_new r*, a third of a turn about 1, 1, 1
  found.spin.q = body.spin.q * Quaternion{0.5, 0.5, 0.5, 0.5};
  const Mat3& T = body.spin.inertia_F;
  found.spin.inertia_F(0, 0) = T(1, 1) / T(0, 0);
  found.spin.inertia_F(1, 1) = T(2, 2) / T(0, 0);
  const light::Ellipsoid& s = body.ellipsoid();
  found.shape = light::Ellipsoid{1.0, s.c / s.b, s.a / s.b};
  return found;
}

TEST(LightImages, ABodyIsTheSameInAnyOrderOfItsAxes) {
  fit::LightModel body = in_long_axis_mode;
  body.spin.inertia_F(0, 0) *= 1.05;  // nothing says which axis is which
  const fit::LightModel other = in_next_axes(body);
  const std::vector<light::LightCurve> curves{night(body, 2.0, 20, 0.02, 3)};
  const auto here = fit::model_fluxes(body, curves).front(),
             there = fit::model_fluxes(other, curves).front();
  for (std::size_t k = 0; k < here.size(); ++k)
    EXPECT_NEAR(there[k] / here[k], 1.0, budget::fit_exact);

  const fit::LightModel back = fit::nearest_of_same(body, other);
  EXPECT_LT(norm(fit::attitude_residual(body.spin.q, back.spin.q)), budget::fit_exact);
  EXPECT_LT(norm(back.spin.w_F - body.spin.w_F), budget::fit_exact);
  EXPECT_NEAR(back.ellipsoid().b, body.ellipsoid().b, budget::fit_exact);
  EXPECT_NEAR(back.ellipsoid().c, body.ellipsoid().c, budget::fit_exact);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(back.spin.inertia_F(i, i), body.spin.inertia_F(i, i), budget::fit_exact);
}

fit::FoundLight found_with(const fit::LightModel& body) {
  fit::LightSolution s;
  s.body = body;
  s.periods = {Regime::long_axis, 12.0, 20.0};
  return fit::found_light(s);
}

// Two solutions 0.15 rad apart have images that are as near to each other.
TEST(LightImages, AreThoseOfTheNearest) {
  const std::vector<light::LightCurve> curves{night(in_long_axis_mode, 2.0, 20, 0.02, 3)};
  const Vec3 sun = curves[0].points[0].to_sun, observer = curves[0].points[0].to_observer;
  fit::LightModel beside = in_long_axis_mode;
  beside.spin.q = normalized(Quaternion{1.0, 0.075, 0.0, 0.0}) * beside.spin.q;
  for (const fit::LightImage i :
       {fit::LightImage::normal, fit::LightImage::bisector, fit::LightImage::difference}) {
    std::vector<fit::FoundLight> all{
        found_with(in_long_axis_mode), found_with(beside),
        found_with(fit::image_of(beside, i, sun, observer)),
        found_with(fit::image_of(in_long_axis_mode, i, sun, observer))};
    fit::describe_solutions(all, curves);
    EXPECT_EQ(all[1].beside, Beside::other_pole);
    for (const std::size_t k : {2u, 3u}) {
      EXPECT_EQ(all[k].beside, Beside::image);
      EXPECT_EQ(all[k].image, i);
      EXPECT_EQ(all[k].of, k == 2 ? 1u : 0u);
    }
  }
}

// Number 2 fits the data better, and is rougher: the cost decides, and the sentence says so.
TEST(LightSolutions, SayWhichTermOfTheCostDecides) {
  const std::vector<light::LightCurve> curves{night(in_long_axis_mode, 2.0, 20, 0.02, 3)};
  const auto with_terms = [](double data, double roughness) {
    fit::FoundLight f = found_with(in_long_axis_mode);
    f.solution.result.chi_square = data;
    f.solution.result.cost = data + roughness + 1.0;
    f.solution.terms = {{"data", data}, {"roughness", roughness}, {"moments", 1.0}};
    return f;
  };
  std::vector<fit::FoundLight> all{with_terms(643.0, 20.0), with_terms(555.0, 120.0)};
  fit::describe_solutions(all, curves);
  EXPECT_EQ(all[0].sentence,
            "long-axis mode, P_phi 12, P_psi 20: the lowest cost; solution 2 has a lower "
            "chi-square, 555 against 643, but its roughness costs 120 against 20");
  all = {with_terms(555.0, 20.0), with_terms(643.0, 120.0)};
  fit::describe_solutions(all, curves);
  EXPECT_EQ(all[0].sentence, "long-axis mode, P_phi 12, P_psi 20: the lowest cost");
}

fit::LightSearch search_of(const DrawnTumbler& t) {
  fit::LightSearch search;
  search.curves = {t.curve};
  // off by what a scan may be
  search.periods = {
      {t.mode, 1.0 / (t.f_phi + 0.03 / t.time_base), 1.0 / (t.f_psi - 0.03 / t.time_base)}};
  search.starts = 20;
  search.threads = 2;
  return search;
}

// Another shape fits this night nearly as well; one start in twelve comes to it.
TEST(LightSearch, FindsWhatFewStartsComeTo) {
  fit::LightSearch search = search_of(drawn_tumbler(29, 100, 0.02, 5));
  Vec3 first;
  std::vector<double> parts;
  search.progress = [&](double part) { parts.push_back(part); };
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    search.seed = seed;
    const fit::LightSearchResult found = fit::search_light(search);
    ASSERT_EQ(found.solutions.size(), 8u) << "seed " << seed;
    // images have one cost, and one order
    const Vec3& pole = found.solutions[0].solution.pole;
    if (seed == 1) first = pole;
    EXPECT_LT(norm(pole - first), budget::fit_same);
    EXPECT_TRUE(std::ranges::all_of(parts, [](double part) { return part > 0.0 && part <= 1.0; }));
    EXPECT_EQ(parts.back(), 1.0);
    parts.clear();
    EXPECT_EQ(std::ranges::count(found.solutions, Beside::image, &fit::FoundLight::beside), 6);
    EXPECT_EQ(std::ranges::count(found.solutions, Beside::other_pole, &fit::FoundLight::beside), 1);
  }
}

// The largest ratio between the time that was left and what the parts so far tell, either way up,
// over the calls between `from` and 0.8 of the processor time of a search.
double worst_time_left(fit::LightSearch search, double from) {
  std::vector<std::pair<double, double>> calls;  // processor time, part
  const auto now = [] { return static_cast<double>(std::clock()); };
  const double begun = now();
  search.threads = 1;
  search.progress = [&](double part) { calls.push_back({now() - begun, part}); };
  fit::search_light(search);
  const double whole = now() - begun;
  Worst worst;
  for (const auto& [time, part] : calls) {
    if (time < from * whole || time > 0.8 * whole) continue;
    const double ratio = time * (1.0 - part) / part / (whole - time);
    worst.add(ratio);
    worst.add(1.0 / ratio);
  }
  return worst.value();
}

// Starts may be nearly all of the work, or the fits of many solutions be: then the number of
// solutions is known after the first starts only.
TEST(LightSearch, TellsTimesLeft) {
  fit::LightSearch search = search_of(drawn_tumbler(29, 100, 0.02, 5));
  search.starts = 200;
  EXPECT_LT(worst_time_left(search, 0.1), 2.0);
  search.starts = 40;
  search.within = 50.0;
  EXPECT_LT(worst_time_left(search, 0.4), 2.0);
}

// With so few points two of the solutions are found by one start each.
TEST(LightSearch, SaysWhatFewStartsCameTo) {
  fit::LightSearch search = search_of(drawn_tumbler(14, 60, 0.02, 5));
  search.seed = 1;
  const fit::LightSearchResult found = fit::search_light(search);
  EXPECT_TRUE(std::ranges::any_of(found.notes, [](const std::string& note) {
    return note.find("found from a single start (images counted as one)") != note.npos;
  }));
}

// Before any start.
TEST(LightSearch, SaysWhatIsWrongWithAllUnknowns) {
  fit::LightSearch search = search_of(drawn_tumbler(10, 10, 0.02, 5));
  search.unknowns = {.moments = fit::MomentSource::fit, .multiple = true};
  int begun = 0;
  search.between = [&] { ++begun; };
  EXPECT_MESSAGE(fit::search_light(search),
                 "fit_light: 10 points for 11 unknowns and 1 factor; expected as many at least");
  EXPECT_EQ(begun, 0);
}

// Light of a body with moments of its own and some of Lambert's law.
TEST(LightSearch, EndsNoHigherWithMoreUnknowns) {
  DrawnTumbler t = drawn_tumbler(10, 120, 0.02, 5);
  t.body.law = {1.0, 0.3};
  t.body.spin.inertia_F(0, 0) *= 1.03;
  const auto fluxes = fit::model_fluxes(t.body, std::vector<light::LightCurve>{t.curve}).front();
  const ensemble::CounterRandom random(5, ensemble::key_of("noise"));
  for (std::size_t k = 0; k < fluxes.size(); ++k) {
    light::LightPoint& p = t.curve.points[k];
    p.flux = fluxes[k] * (1.0 + 0.02 * random.normal(k, 0));
    p.sigma = 0.02 * fluxes[k];
  }
  fit::LightSearch search = search_of(t);
  double least = 1e300;
  for (const fit::LightUnknowns& unknowns :
       {fit::LightUnknowns{}, fit::LightUnknowns{.multiple = true},
        fit::LightUnknowns{.moments = fit::MomentSource::fit, .multiple = true}}) {
    search.unknowns = unknowns;
    const fit::LightSearchResult found = fit::search_light(search);
    ASSERT_FALSE(found.solutions.empty());
    const double cost = found.solutions.front().solution.result.cost;
    EXPECT_LE(cost, least);
    least = cost;
    ASSERT_TRUE(found.best_of_periods[0].has_value());
    EXPECT_EQ(found.best_of_periods[0]->result.cost, found.chi_square_of_periods[0]);
  }
  // as low as from the truth
  const fit::LightSolution at = fit::fit_light({{t.curve}, t.body, search.unknowns, {}, 200});
  ASSERT_TRUE(at.is_found());
  EXPECT_NEAR(least / at.result.cost, 1.0, budget::light_cost);
}

}  // namespace
