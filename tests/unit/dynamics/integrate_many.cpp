// SPDX-License-Identifier: MIT
// A body among others has the bits of its run alone, and fails alone.
#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "splitting_support.hpp"
#include "unit/perturb/every_term.hpp"

namespace polhode {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

AnyPerturbation gravity(double e) {
  return {"gravity gradient", GravityGradient(1.0, AnyOrbit("orbit", KeplerOrbit({1.0, 0.9, e})))};
}

// Bodies that differ in all that they may differ in.
Problem body(std::size_t k, const Collocation& method, const std::vector<AnyPerturbation>& more) {
  const auto x = static_cast<double>(k);
  std::vector<AnyPerturbation> terms{gravity(0.1 + 0.02 * x)};
  terms.insert(terms.end(), more.begin(), more.end());
  Problem p{System(Body(0.9, 1.0 + 0.01 * x, 1.1), Frame::inertial(), terms),
            {normalized(Quaternion{1.0, 0.1 * x, 0.0, 0.2}), {4.5 - 0.3 * x, 4.0, 8.25}},
            0.1 * x,
            3.0 + 0.7 * x,
            method};
  if (k == 4) p.stop = -2.0;  // back in time
  return p;
}

void expect_alone(const Problem& problem, const Keep& keep, const BodyRun& run,
                  const std::string& what) {
  const Trajectory alone = integrate(problem, keep);
  ASSERT_TRUE(run.trajectory) << what << ": " << run.error;
  const Trajectory& t = *run.trajectory;
  EXPECT_EQ(t.outcome().status, alone.outcome().status) << what;
  EXPECT_EQ(t.outcome().advice, alone.outcome().advice) << what;
  EXPECT_EQ(t.statistics().steps, alone.statistics().steps) << what;
  EXPECT_EQ(t.statistics().rejected, alone.statistics().rejected) << what;
  EXPECT_EQ(t.statistics().evaluations, alone.statistics().evaluations) << what;
  ASSERT_EQ(t.samples().size(), alone.samples().size()) << what;
  for (std::size_t i = 0; i < t.samples().size(); ++i) {
    EXPECT_EQ(t.samples()[i].t, alone.samples()[i].t) << what;
    EXPECT_EQ(t.samples()[i].s, alone.samples()[i].s) << what << " at " << t.samples()[i].t;
  }
  ASSERT_EQ(t.events().size(), alone.events().size()) << what;
  for (std::size_t i = 0; i < t.events().size(); ++i)
    EXPECT_EQ(t.events()[i].t, alone.events()[i].t) << what;
}

void expect_all_alone(const std::vector<Problem>& problems, const Keep& keep,
                      const std::string& what) {
  const std::vector<BodyRun> runs = integrate_many(problems, keep);
  ASSERT_EQ(runs.size(), problems.size());
  for (std::size_t k = 0; k < runs.size(); ++k)
    expect_alone(problems[k], keep, runs[k], what + ", body " + std::to_string(k));
}

std::vector<Problem> bodies(std::size_t count, const Collocation& method,
                            const std::vector<AnyPerturbation>& more = {}) {
  std::vector<Problem> problems;
  for (std::size_t k = 0; k < count; ++k) problems.push_back(body(k, method, more));
  return problems;
}

TEST(IntegrateMany, GivesTheBitsOfABodyAlone) {
  for (const int stages : {4, 8, 16})
    for (const std::size_t count : {1U, 2U, 8U, 11U})
      expect_all_alone(bodies(count, Collocation{.stages = stages}), {},
                       std::to_string(stages) + " stages");
  expect_all_alone(bodies(9, Collocation{.step = 0.11}), {}, "fixed steps");
  expect_all_alone(bodies(9, Collocation{.tolerance = 1e-6}), {}, "a loose tolerance");
}

TEST(IntegrateMany, TakesEveryTerm) {
  const Body like(1.0, 1.7, 2.1);
  for (const AnyPerturbation& term : perturb_test::every_term(like)) {
    std::vector<Problem> problems = bodies(3, Collocation{}, {term});
    for (Problem& p : problems) p.stop = 1.5;
    expect_all_alone(problems, {SaveAt::times({1.5}), false}, term.name());
  }
}

// Laws whose numbers differ, and a function of a user.
TEST(IntegrateMany, TakesTermsThatDiffer) {
  std::vector<Problem> problems;
  for (std::size_t k = 0; k < 6; ++k) {
    const double x = 0.01 * static_cast<double>(k);
    const auto push = [x](double t, const RotorState& s) { return x * std::sin(t) * s.g; };
    problems.push_back(
        body(k, Collocation{}, {{"push", TorqueTerm(push)}, {"damping", InternalDamping(x)}}));
  }
  expect_all_alone(problems, {}, "terms that differ");
}

TEST(IntegrateMany, KeepsFramesThatMove) {
  std::vector<Problem> problems = bodies(5, Collocation{});
  for (Problem& p : problems)
    p.system = System(p.system.body(), splitting_test::precessing_frame(), p.system.terms());
  expect_all_alone(problems, {SaveAt::times({0.5, 1.0, 1.5, 2.0, 2.5}), true}, "precessing");
}

// Of other stages, terms and methods, and a body that ends at once.
TEST(IntegrateMany, TakesBodiesThatDiffer) {
  std::vector<Problem> problems = bodies(12, Collocation{});
  problems[2].method = Collocation{.stages = 16};
  problems[3].method = Collocation{.stages = 16};
  problems[5].method = Adaptive{};
  problems[7].system = System(Body(1.0, 2.0, 2.7));
  problems[8].stop = problems[8].start;
  expect_all_alone(problems, {}, "mixed");
}

TEST(IntegrateMany, EndsStepsWhereATorqueSwitches) {
  std::vector<Problem> problems;
  for (std::size_t k = 0; k < 9; ++k) {
    const double x = 0.02 * static_cast<double>(k);
    const auto push = [x](const double&, const RotorState&, std::span<const double> sides) {
      return Vec3{(0.05 + x) * sides[0], 0.0, sides[1] > 0.0 ? 0.04 : 0.0};
    };
    const auto sides = [x](double t, const RotorState& s) {
      return std::vector{std::sin((0.7 + x) * t), s.g.z - 0.2};
    };
    const AnyPerturbation term("push", SwitchedTorqueTerm(push, sides));
    Problem p = body(k, Collocation{}, {term});
    p.initial.g = {0.8, 1.9, 0.3};
    p.stop = 12.0;
    problems.push_back(std::move(p));
  }
  expect_all_alone(problems, {}, "switches");
}

TEST(IntegrateMany, FindsEventsAndStopsAtThem) {
  std::vector<Problem> problems = bodies(10, Collocation{});
  for (std::size_t k = 0; k < problems.size(); ++k) {
    const double height = 8.0 - 0.05 * static_cast<double>(k);
    problems[k].stop = 10.0;
    problems[k].events.push_back({"height",
                                  [height](double, const RotorState& s) { return s.g.z - height; },
                                  Crossing::both, k % 3 == 0, 0.0});
  }
  expect_all_alone(problems, {}, "events");
}

TEST(IntegrateMany, LetsABodyFailAlone) {
  std::vector<Problem> problems = bodies(9, Collocation{});
  problems[1].initial.g.x = std::nan("");
  for (const std::size_t k : {3U, 6U}) {
    const auto push = [k](double t, const RotorState& s) {
      if (k == 3 && t > 2.0) throw std::runtime_error("no field here");
      return (t > 2.0 ? std::nan("") : 0.0) * s.g;
    };
    problems[k] = body(k, Collocation{}, {{"push", TorqueTerm(push)}});
  }
  const std::vector<BodyRun> runs = integrate_many(problems);
  EXPECT_FALSE(runs[1].trajectory);
  EXPECT_THAT(runs[1].error, StartsWith("body 1 at t = 0.1: "));
  EXPECT_FALSE(runs[3].trajectory);
  EXPECT_THAT(runs[3].error, HasSubstr("no field here"));
  EXPECT_THAT(runs[3].error, StartsWith("body 3 at t = 1."));
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (k != 1 && k != 3) expect_alone(problems[k], {}, runs[k], "body " + std::to_string(k));
  EXPECT_EQ(runs[6].trajectory->outcome().status, Outcome::Status::failed);
}

// At the time that its run has reached, whatever the method.
TEST(IntegrateMany, SaysWhenABodyHasFailed) {
  const auto push = [](double t, const RotorState& s) {
    if (t > 2.0) throw std::runtime_error("no field here");
    return 0.0 * s.g;
  };
  for (const Method& method : {Method(Collocation{}), Method(Adaptive{})}) {
    Problem problem = body(0, Collocation{}, {{"push", TorqueTerm(push)}});
    problem.method = method;
    const BodyRun run = integrate_body(7, problem, {});
    EXPECT_FALSE(run.trajectory);
    EXPECT_THAT(run.error, StartsWith("body 7 at t = 1."));
    EXPECT_THROW(std::rethrow_exception(run.thrown), std::runtime_error);
  }
}

TEST(IntegrateMany, AsksForProblemsWhenTheirTurnComes) {
  const std::vector<Problem> problems = bodies(20, Collocation{});
  std::size_t asked = 0, ended = 0;
  integrate_many(
      problems.size(),
      [&](std::size_t k) {
        EXPECT_EQ(k, asked++);
        EXPECT_EQ(k, ended);
        return problems[k];
      },
      {},
      [&](std::size_t k, const BodyRun& run) {
        EXPECT_EQ(k, ended);
        ended += run.trajectory ? 1U : 0U;
      });
  EXPECT_EQ(ended, problems.size());
  EXPECT_TRUE(integrate_many(std::vector<Problem>{}).empty());
}

TEST(IntegrateMany, EndsWhereProgressThrows) {
  for (const Method& method : {Method(Collocation{}), Method(Adaptive{})}) {
    std::vector<Problem> problems = bodies(3, Collocation{});
    for (Problem& p : problems) p.method = method;
    int asked = 0, ended = 0;
    EXPECT_THROW(integrate_many(
                     3, [&](std::size_t k) { return ++asked, problems[k]; }, {},
                     [&](std::size_t, const BodyRun&) { ++ended; },
                     [](double) { throw std::logic_error("no"); }),
                 std::logic_error);
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(ended, 0);
  }
}

TEST(IntegrateMany, NamesTermsThatAreAskedOneByOne) {
  const auto push = [](double, const RotorState& s) { return 0.0 * s.g; };
  const std::vector<Problem> problems{body(0, Collocation{}, {}),
                                      body(1, Collocation{}, {{"push", TorqueTerm(push)}})};
  const std::vector<BodyRun> runs = integrate_many(problems);
  EXPECT_EQ(runs[0].trajectory->method().find("stage by stage"), std::string::npos);
  EXPECT_THAT(runs[1].trajectory->method(), HasSubstr("\"push\" stage by stage"));
}

}  // namespace
}  // namespace polhode
