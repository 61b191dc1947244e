// SPDX-License-Identifier: MIT
// Searches with a given mesh: tumblers in both modes from their periods alone, what half turns
// leave, bad input; convex bodies that follow ellipsoids.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "bright_night.hpp"
#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/ensemble/cell_journal.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/light_search.hpp"
#include "polhode/shape/mass_properties.hpp"
#include "unit/light/meshes.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using testing::HasSubstr;

// Convex, and like no ellipsoid: one end thick, one side flat, so that no half turn leaves it.
shape::FacetShape pear() {
  const shape::FacetShape raw = globe(7, [](const Vec3& n) {
    const double along = 1.0 + 0.25 * n.x, up = n.z > 0.3 ? 0.3 + 0.4 * (n.z - 0.3) : n.z;
    return Vec3{1.5 * n.x, (0.9 + 0.1 * n.y) * along * n.y, 0.8 * along * up};
  });
  return raw.moved(-1.0 * shape::mass_properties(raw, 1.0).centre, 1.0);
}

// In its principal axes or near them.
fit::LightModel tumbler(const Vec3& w) {
  const shape::FacetShape shape = pear();
  return {{0.0, normalized(Quaternion{0.6, 0.3, -0.5, 0.2}), w, fit::homogeneous_inertia(shape)},
          light::ShadedMesh(shape),
          {}};
}

struct Night {
  fit::LightModel truth;  // at the epoch of the search
  fit::TumblerPeriods periods;
  std::vector<light::LightCurve> curves;
};

Night night_of(fit::LightModel truth, std::size_t count) {
  const Body body = Body::from_tensor(truth.spin.inertia_F);
  const Quaternion& f = body.q_FB();
  const Vec3 w_B = rotate(conj(f), truth.spin.w_F), I = body.moments();
  const FreeRotation motion(
      body, {normalized(truth.spin.q) * f, {I.x * w_B.x, I.y * w_B.y, I.z * w_B.z}});
  const double P = 2.0 * pi<double>() / motion.precession_rate_long();
  light::LightCurve curve{.name = "night", .is_calibrated = false, .points = {}};
  const double half = 3.0 * P;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = half * (2.0 * static_cast<double>(i) / static_cast<double>(count - 1) - 1.0);
    curve.points.push_back({t, 1.0, 1.0, {1.0, 0.2, 0.3}, {0.7, 0.9, 0.1}});
  }
  std::vector<light::LightCurve> curves{curve};
  const std::vector<double> flux = fit::model_fluxes(truth, curves).front();
  const ensemble::CounterRandom random(3, ensemble::key_of("pear"));
  for (std::size_t i = 0; i < count; ++i) {
    curves[0].points[i].flux = flux[i] * (1.0 + 0.02 * random.normal(i, 0));
    curves[0].points[i].sigma = 0.02 * flux[i];
  }
  return {std::move(truth), {motion.regime(), P, motion.polhode_period()}, std::move(curves)};
}

double distance(const fit::LightModel& truth, const fit::LightSolution& s) {
  const Vec3 turn = fit::attitude_residual(s.body.spin.q, truth.spin.q);
  const Vec3 dw = truth.spin.w_F - s.body.spin.w_F;
  double most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int k = static_cast<int>(i);
    most = larger(most, std::fabs(turn[k]) / s.covariance.error(i),
                  std::fabs(dw[k]) / s.covariance.error(i + 3));
  }
  return most;
}

fit::LightSearch search_of(const Night& night) {
  fit::LightSearch search;
  search.curves = night.curves;
  search.periods = {night.periods};
  search.tries = 60;
  search.short_iterations = 6;
  search.unknowns.moments = fit::MomentSource::start;
  search.body = night.truth;
  return search;
}

TEST(MeshSearch, FindsTheSpinFromItsPeriods) {
  for (const Vec3& w : {Vec3{2.0, 0.9, 0.5}, Vec3{0.3, 0.4, 1.0}}) {
    const Night night = night_of(tumbler(w), 90);
    ASSERT_EQ(night.periods.mode, w.x > 1.0 ? Regime::long_axis : Regime::short_axis);
    fit::TumblerPeriods off = night.periods, none = night.periods;
    off.precession_period *= 1.003;  // as a scan knows them
    off.rotation_period *= 0.997;
    none.rotation_period *= 1e-3;
    fit::LightSearch search = search_of(night);
    search.periods = {none, off};
    search.starts = 120;
    search.seed = 2;
    const fit::LightSearchResult found = fit::search_light(search);
    ASSERT_FALSE(found.solutions.empty());
    EXPECT_EQ(found.starts, 60u);
    ASSERT_EQ(found.notes.size(), 1u);
    EXPECT_THAT(found.notes[0], HasSubstr("no motion with 1 of 2 pairs of periods"));
    EXPECT_EQ(found.chi_square_of_periods[0], std::numeric_limits<double>::infinity());
    // the truth, and its image about the bisector with the same light
    std::size_t place = found.solutions.size();
    for (std::size_t k = 0; k < found.solutions.size(); ++k)
      if (distance(night.truth, found.solutions[k].solution) < budget::mesh_off) place = k;
    ASSERT_LT(place, 2u) << w.x;
    ASSERT_GE(found.solutions.size(), 2u);
    const fit::LightSolution& a = found.solutions[0].solution;
    const fit::LightSolution& b = found.solutions[1].solution;
    EXPECT_NEAR(a.result.chi_square / b.result.chi_square, 1.0, budget::mesh_image);
    EXPECT_EQ(found.solutions[1].image, fit::LightImage::bisector);
    EXPECT_LT(a.result.chi_square, budget::light_noise * a.degrees_of_freedom);
    EXPECT_EQ(found.solutions[0].periods, 1u);
    search.threads = 2;
    const fit::LightSearchResult again = fit::search_light(search);
    ASSERT_EQ(again.solutions.size(), found.solutions.size());
    EXPECT_EQ(again.solutions[0].solution.result.x, a.result.x);
    EXPECT_EQ(again.solutions[0].solution.body.spin.q, a.body.spin.q);
  }
}

TEST(MeshSearch, SaysWhatIsWrong) {
  const Night night = night_of(tumbler({2.0, 0.9, 0.5}), 20);
  const fit::LightSearch good = search_of(night);
  const auto refusal = [&](const auto& change) {
    fit::LightSearch bad = good;
    change(bad);
    return message_of([&] { static_cast<void>(fit::search_light(bad)); });
  };
  EXPECT_THAT(refusal([](fit::LightSearch& s) { s.periods.clear(); }), HasSubstr("no periods"));
  EXPECT_EQ(refusal([](fit::LightSearch& s) { s.periods[0].rotation_period = -2.0; }),
            "search_light: period -2 must be positive");
  EXPECT_EQ(refusal([](fit::LightSearch& s) { s.periods[0].mode = Regime::steady; }),
            "search_light: the mode must be short_axis or long_axis");
  EXPECT_EQ(refusal([](fit::LightSearch& s) { s.starts = 0; }),
            "search_light: starts = 0 must be 1 or more");
  EXPECT_EQ(refusal([](fit::LightSearch& s) { s.within = 0.5; }),
            "search_light: within = 0.5 must be 1 or more");
  EXPECT_THAT(refusal([](fit::LightSearch& s) { s.unknowns.moments = fit::MomentSource::shape; }),
              HasSubstr("moments cannot follow a shape that stays"));
  EXPECT_THAT(refusal([](fit::LightSearch& s) { s.curves[0].points.resize(3); }),
              HasSubstr("3 points"));
  int calls = 0;
  fit::LightSearch stopped = good;
  stopped.between = [&] {
    if (++calls == 3) throw std::runtime_error("stopped");
  };
  EXPECT_THROW(static_cast<void>(fit::search_light(stopped)), std::runtime_error);
  EXPECT_THAT(refusal([](fit::LightSearch& s) { s.surface.emplace(); }),
              HasSubstr("no ellipsoids"));
  EXPECT_THAT(refusal([](fit::LightSearch& s) {
                s.surface = fit::SurfaceSearch{.mesh = fit::LightModel::homogeneous(
                                                   0.0, {}, {0.0, 0.0, 1.0}, {1.0, 0.8, 0.6})};
                s.body.reset();
              }),
              HasSubstr("must be a mesh"));
  EXPECT_THAT(refusal([](fit::LightSearch& s) {
                s.surface = fit::SurfaceSearch{.degree = 20, .rows = 4};
                s.body.reset();
              }),
              HasSubstr("rows"));
}

// Two stages, each to its end; a journal has the results of both, so that nothing is fitted again.
TEST(SurfaceSearch, GoesOnFromEllipsoidsToConvexBodies) {
  const Night night = night_of(tumbler({0.3, 0.4, 1.0}), 60);
  fit::LightSearch search;
  search.curves = night.curves;
  search.periods = {night.periods};
  search.starts = 12;
  search.surface =
      fit::SurfaceSearch{.degree = 2, .rows = 3, .unknowns = {.moments = fit::MomentSource::fit}};
  std::vector<std::string> stages;
  std::vector<double> ends;
  search.begins = [&](const std::string& stage, const std::string&) {
    stages.push_back(stage);
    ends.push_back(0.0);
  };
  search.progress = [&](double part) { ends.back() = part; };
  ensemble::CellJournal journal;
  search.journal = &journal;
  const fit::LightSearchResult found = fit::search_light(search);
  EXPECT_THAT(stages, testing::ElementsAre("search", "surfaces"));
  EXPECT_THAT(ends, testing::ElementsAre(1.0, 1.0));
  ASSERT_FALSE(found.solutions.empty());
  EXPECT_EQ(found.failure, "");
  EXPECT_GE(found.surfaces, found.surfaces_converged);
  EXPECT_GE(found.surfaces_converged, found.solutions.size());
  for (const fit::FoundLight& one : found.solutions) {
    EXPECT_TRUE(one.solution.body.is_convex() && one.begun->is_ellipsoid());
    EXPECT_EQ(one.solution.covariance.names.size(), 8u + 8u);
  }
  ASSERT_TRUE(found.best_of_periods[0] && found.surface_of_periods[0]);
  EXPECT_TRUE(found.best_of_periods[0]->body.is_ellipsoid());
  EXPECT_TRUE(found.surface_of_periods[0]->body.is_convex());
  EXPECT_TRUE(found.surface_of_periods[0]->is_found());

  Archive written;
  journal.serialize(written);
  Archive read(written.bytes());
  ensemble::CellJournal kept;
  kept.serialize(read);
  int fits = 0;
  search.between = [&] { ++fits; };
  search.journal = &kept;
  const fit::LightSearchResult again = fit::search_light(search);
  EXPECT_EQ(fits, 0);
  ASSERT_EQ(again.solutions.size(), found.solutions.size());
  for (std::size_t k = 0; k < again.solutions.size(); ++k)
    EXPECT_EQ(again.solutions[k].solution.result.x, found.solutions[k].solution.result.x);
}

}  // namespace
