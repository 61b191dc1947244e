// SPDX-License-Identifier: MIT
// Every method finds the events that there are: against the closed form of a free body, and of one
// method against another.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "worst.hpp"

namespace {

using polhode::test::larger;
using polhode::test::smaller;
using namespace polhode;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

struct NamedMethod {
  std::string name;
  Method method;
};
void PrintTo(const NamedMethod& m, std::ostream* out) { *out << m.name; }

const NamedMethod methods[] = {
    {"Adaptive", Adaptive{}},
    {"AdaptiveLoose", Adaptive{.tolerance = 1e-6}},
    {"AdaptiveWide", Adaptive{.tolerance = 1e-18, .precision = Precision::double_double}},
    {"SplittingShort", Splitting{0.05}},
    {"SplittingLong", Splitting{7.0}},
    {"SplittingOrder2", Splitting{0.7, SplittingScheme::order2}},
    {"Variation", VariationOfConstants{}},
    {"VariationLoose", VariationOfConstants{.tolerance = 1e-6}},
};

class EventsOf : public testing::TestWithParam<NamedMethod> {
 protected:
  bool is_splitting() const { return GetParam().name.starts_with("Splitting"); }
  bool is_loose() const { return GetParam().name == "AdaptiveLoose"; }
  double budget_of_time() const {
    return is_loose() ? budget::event_time_loose : budget::event_time;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, EventsOf, testing::ValuesIn(methods),
                         [](const auto& one) { return one.param.name; });

Vec3 axis_of(const RotorState& s, const Vec3& b) { return rotate(s.q, b); }

// A wing nut, which flips again and again.
const Body wing_nut(30.53, 83.87, 113.3);
const RotorState spinning{{1.0, 0.0, 0.0, 0.0}, {0.01 * 30.53, 6.28 * 83.87, 0.0}};

const std::vector<Event> functions = {
    {"qw", [](double, const RotorState& s) { return s.q.w; }},
    {"qx", [](double, const RotorState& s) { return s.q.x - 0.3; }},
    {"flip", [](double, const RotorState& s) { return s.g.y / norm(s.g); }},
    {"across",
     [](double, const RotorState& s) {
       return axis_of(s, {1.0, 0.0, 0.0}).z;
     }},
    {"product",
     [](double, const RotorState& s) {
       return axis_of(s, {0.0, 0.0, 1.0}).z * axis_of(s, {1.0, 0.0, 0.0}).y - 0.1;
     }},
};

struct Known {
  double t;
  int direction;
};

// Changes of sign of the closed form between very many times, halved to rounding; q continuous.
std::vector<Known> known_zeros(const FreeRotation& exact, const Event& event, double stop) {
  Sample last{0.0, exact.at(0.0)};
  const auto at = [&](double t) {
    Sample s{t, exact.at(t)};
    const Quaternion &p = last.s.q, q = s.s.q;
    if (p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < 0.0) s.s.q = {-q.w, -q.x, -q.y, -q.z};
    return s;
  };
  std::vector<Known> zeros;
  const int looks = 40000;
  for (int k = 1; k <= looks; ++k) {
    const Sample next = at(stop * k / looks);
    const double before = event.function(last), after = event.function(next);
    if (before * after < 0.0) {
      double a = last.t, b = next.t;
      for (int trip = 0; trip < 60; ++trip) {
        const double m = 0.5 * (a + b);
        (event.function(at(m)) * before > 0.0 ? a : b) = m;
      }
      zeros.push_back({b, after > 0.0 ? 1 : -1});
    }
    last = next;
  }
  return zeros;
}

std::vector<EventRecord> of_name(const Trajectory& run, const std::string& name) {
  std::vector<EventRecord> events;
  for (const EventRecord& event : run.events())
    if (event.name == name) events.push_back(event);
  return events;
}

TEST_P(EventsOf, AreThoseOfTheClosedForm) {
  const double stop = is_loose() ? 8.0 : 40.0;  // what is loose leaves the motion at every flip
  const FreeRotation exact(wing_nut, spinning);
  const Trajectory run =
      integrate({System(wing_nut), spinning, 0.0, stop, GetParam().method, functions});
  EXPECT_TRUE(std::is_sorted(run.events().begin(), run.events().end(),
                             [](const auto& a, const auto& b) { return a.t < b.t; }));
  for (const Event& event : functions) {
    const std::vector<Known> known = known_zeros(exact, event, stop);
    const std::vector<EventRecord> found = of_name(run, event.name);
    ASSERT_GE(known.size(), 2U) << event.name;
    ASSERT_EQ(found.size(), known.size()) << event.name;
    for (std::size_t i = 0; i < known.size(); ++i) {
      EXPECT_NEAR(found[i].t, known[i].t, budget_of_time()) << event.name << " " << i;
      EXPECT_EQ(found[i].direction, known[i].direction) << event.name << " " << i;
      EXPECT_NEAR(event.function({found[i].t, found[i].s}), 0.0, budget::event_residual);
    }
  }
}

// The axis of a sphere that spins with 1 rad/s goes round: 1 + cos t dips below `depth` for a
// moment in every turn.
Problem sphere(const Method& method, double stop, Event event) {
  return {System(Body(1.0, 1.0, 1.0)),
          RotorState{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}},
          0.0,
          stop,
          method,
          {std::move(event)}};
}
Event dip(double depth) {
  return {"dip", [depth](double, const RotorState& s) {
            return 1.0 + axis_of(s, {1.0, 0.0, 0.0}).x - depth;
          }};
}

TEST_P(EventsOf, TwoZerosAreFoundHoweverNear) {
  for (const double depth : {0.1, 1e-3, 1e-6}) {
    const double half = 2.0 * std::asin(std::sqrt(0.5 * depth));
    const std::vector<EventRecord> found =
        integrate(sphere(GetParam().method, 40.0, dip(depth))).events();
    ASSERT_EQ(found.size(), 12U) << depth;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const bool rises = i % 2 == 1;
      const double t = pi * static_cast<double>(i + (rises ? 0 : 1)) + (rises ? half : -half);
      // the slope is sin(half)
      EXPECT_NEAR(found[i].t, t, budget_of_time() + budget::free_attitude / half) << depth;
      EXPECT_EQ(found[i].direction, rises ? 1 : -1);
    }
  }
}

TEST_P(EventsOf, ATouchIsOneOfNoDirection) {
  if (is_loose()) GTEST_SKIP() << "an error of 1e-6 lifts it off zero, or through";
  Event event = dip(0.0);
  const std::vector<EventRecord> found = integrate(sphere(GetParam().method, 40.0, event)).events();
  ASSERT_EQ(found.size(), 6U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].t, pi * static_cast<double>(2 * i + 1), budget::time_of_touch);
    EXPECT_EQ(found[i].direction, 0);
  }
  event.crossing = Crossing::rising;
  EXPECT_TRUE(integrate(sphere(GetParam().method, 40.0, event)).events().empty());
}

TEST_P(EventsOf, AZeroAtStartOrStopIsOne) {
  const Event across{"across", [](double, const RotorState& s) { return s.q.w * s.q.z; }};
  Problem p = sphere(GetParam().method, 2.0, across);
  std::vector<EventRecord> found = integrate(p).events();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].t, 0.0);
  EXPECT_EQ(found[0].direction, 1);
  p.continues = true;
  EXPECT_TRUE(integrate(p).events().empty());
  p.stop = -2.0;
  p.continues = false;
  found = integrate(p).events();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].direction, -1);

  const Event clock{"clock", [](double t, const RotorState&) { return t - 2.0; }};
  Problem until = sphere(GetParam().method, 2.0, clock), after = until;
  after.start = 2.0;
  after.stop = 4.0;
  found = integrate(until).events();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].t, 2.0);
  EXPECT_EQ(found[0].direction, 1);
  EXPECT_EQ(integrate(after).events().size(), 1U);
  after.continues = true;
  EXPECT_TRUE(integrate(after).events().empty());
  until.events[0].stops = true;
  EXPECT_EQ(integrate(until).outcome().status, Outcome::Status::stopped_by_event);
}

// Seconds since J2000, and as late as times still tell looks apart.
TEST_P(EventsOf, AtLargeTimesNoneIsLost) {
  const RotorState fast{{1.0, 0.0, 0.0, 0.0}, {10.0, 40.0, 8.0}};
  for (const double t0 : {0.0, 1e8, 8e8, 1e10}) {
    const double stop = t0 + 0.125;
    const Event start{"start", [](double, const RotorState& s) { return s.q.x; }};
    const Event end{"end", [stop](double t, const RotorState&) { return t - stop; }};
    const std::vector<EventRecord> found =
        integrate({System(Body(1.0, 1.7, 2.1)), fast, t0, stop, GetParam().method, {start, end}})
            .events();
    ASSERT_EQ(found.size(), 2U) << t0;
    EXPECT_EQ(found[0].t, t0);
    EXPECT_EQ(found[0].direction, 1);
    EXPECT_EQ(found[1].t, stop);
  }
  for (const double t0 : {0.0, 8e8}) {
    const Event touch{
        "touch", [t0](double t, const RotorState&) { return (t - t0 - 3.3) * (t - t0 - 3.3); }};
    Problem p = sphere(GetParam().method, t0 + 10.0, touch);
    p.start = t0;
    const std::vector<EventRecord> found = integrate(p).events();
    ASSERT_EQ(found.size(), 1U) << t0;
    EXPECT_NEAR(found[0].t - t0, 3.3,
                budget::time_of_touch + 8.0 * std::numeric_limits<double>::epsilon() * t0);
    EXPECT_EQ(found[0].direction, 0);
  }
}

// A function that is zero for a while counts where it comes to zero and where it leaves it, in the
// order of time.
TEST_P(EventsOf, AStretchOfZerosIsTwo) {
  Problem p =
      sphere(GetParam().method, 100.0, {"stretch", [](double t, const RotorState&) {
                                          return t < 1.0 ? t - 1.0 : (t < 50.0 ? 0.0 : t - 50.0);
                                        }});
  p.start = 0.1;
  p.events.push_back({"other", [](double t, const RotorState&) { return std::sin(t); }});
  const Trajectory run = integrate(p, {.samples = SaveAt::steps(0.1, 60.1, 5.0)});
  EXPECT_EQ(run.events().size(), 33U);  // 31 half turns
  const std::vector<EventRecord> stretch = of_name(run, "stretch");
  ASSERT_EQ(stretch.size(), 2U);
  EXPECT_NEAR(stretch[0].t, 1.0, budget::event_time);
  EXPECT_NEAR(stretch[1].t, 50.0, budget::event_time);
  EXPECT_TRUE(std::is_sorted(run.events().begin(), run.events().end(),
                             [](const auto& a, const auto& b) { return a.t < b.t; }));
  p.events[0].stops = true;
  const Trajectory first = integrate(p, {.samples = SaveAt::steps(0.1, 60.1, 5.0)});
  EXPECT_EQ(first.outcome().status, Outcome::Status::stopped_by_event);
  EXPECT_EQ(first.outcome().t, stretch[0].t);
  EXPECT_EQ(first.samples().back().t, first.outcome().t);
}

// 12 half turns: every touch of |w| and of its powers.
TEST_P(EventsOf, TouchesOfAnyPowerAreFound) {
  if (is_loose()) GTEST_SKIP() << "an error of 1e-6 lifts it off zero, or through";
  for (const double power : {1.0, 2.0, 4.0, 6.0, 12.0}) {
    const Event event{"touch", [power](double, const RotorState& s) {
                        return std::pow(std::fabs(s.q.w), power);
                      }};
    const Trajectory run = integrate(sphere(GetParam().method, 40.0, event));
    ASSERT_EQ(run.events().size(), 6U) << power;
    for (std::size_t i = 0; i < run.events().size(); ++i) {
      EXPECT_EQ(run.events()[i].direction, 0);
      EXPECT_NEAR(run.events()[i].t, pi * static_cast<double>(2 * i + 1),
                  std::pow(budget::value_of_touch, 1.0 / larger(power, 2.0)));
    }
  }
}

// At one instant all are met, also those behind the one that stops the run in the list, and those
// whose functions are 0.0 at the end of a step there.
TEST_P(EventsOf, OnesOfOneInstantAreAllThere) {
  const double at = 7.25;
  const std::vector<Event> together = {
      {"a", [=](double t, const RotorState&) { return t - at; }, Crossing::both, true},
      {"b", [=](double t, const RotorState&) { return at - t; }},
      {"c", [=](double t, const RotorState&) { return std::sin(0.3 * (t - at)); }},
      {"d", [=](double t, const RotorState&) { return std::fabs(t - at); }},
      {"e", [=](double t, const RotorState&) { return t < at ? at - t : 0.0; }},
      {"later", [=](double t, const RotorState&) { return t - at - 1e-9; }}};
  for (const bool lands : {false, true}) {  // a table whose row ends a step there
    for (std::size_t stop = 0; stop < 2; ++stop) {
      Problem p = sphere(GetParam().method, 20.0, together[0]);
      p.events = together;
      p.events[0].stops = stop == 0;
      p.events[1].stops = stop == 1;
      if (lands && is_splitting()) continue;
      if (lands)
        p.system = System(
            p.system.body(), Frame::inertial(),
            {{"table", TorqueTable({{0.0, {}}, {at, {0.0, 0.0, 1e-3}}},
                                   {TorqueTable::Between::step, TorqueTable::Outside::hold, {}})}});
      const Trajectory run = integrate(p);
      EXPECT_EQ(run.outcome().status, Outcome::Status::stopped_by_event);
      std::string names;
      for (const EventRecord& e : run.events()) names += e.name;
      std::sort(names.begin(), names.end());
      EXPECT_EQ(names, "abcde") << lands << stop;
      for (const EventRecord& e : run.events()) EXPECT_NEAR(e.t, at, budget::event_time) << e.name;
    }
  }
}

// Not a number for less time than looks are apart, where the search asks for it.
TEST_P(EventsOf, NaNBetweenTwoLooksEndsTheRun) {
  const double nan = std::nan("");
  const Event gap{"gap", [nan](double t, const RotorState&) {
                    return std::fabs(t - 5.0) < 0.02 ? nan : t - 5.0;
                  }};
  const Trajectory run = integrate(sphere(GetParam().method, 20.0, gap));
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(run.outcome().advice, HasSubstr("event \"gap\" is NaN after t = "));
  EXPECT_LE(run.outcome().t, 5.0);
  EXPECT_TRUE(run.events().empty());
  const Sample& last = run.samples().back();
  EXPECT_EQ(last.t, run.stop());
  EXPECT_GT(last.t, 4.0);
  EXPECT_NEAR(run.at(last.t).q.z, last.s.q.z, budget::free_attitude);
}

// What is NaN beyond the event that stops the run does not matter, whichever is named first.
TEST_P(EventsOf, NaNAfterTheEndIsNone) {
  const Event end{.name = "end",
                  .function = [](double t, const RotorState&) { return t - 5.0; },
                  .stops = true};
  const Event root{"root", [](double t, const RotorState&) { return 1.0 + std::sqrt(5.001 - t); }};
  for (const std::vector<Event>& events : {std::vector{end, root}, std::vector{root, end}}) {
    Problem p = sphere(GetParam().method, 20.0, end);
    p.events = events;
    const Trajectory run = integrate(p);
    EXPECT_EQ(run.outcome().status, Outcome::Status::stopped_by_event);
    EXPECT_EQ(run.outcome().t, 5.0);
  }
}

TEST_P(EventsOf, TooManyLooksInAStepAreRefused) {
  Event hum{"hum", [](double t, const RotorState&) { return std::sin(t); }};
  hum.interval = 1e-12;
  const Trajectory run = integrate(sphere(GetParam().method, 20.0, hum));
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(run.outcome().advice,
              HasSubstr("event \"hum\" needs more than 1e+08 looks in the step from t = 0 to "));
  EXPECT_THAT(run.outcome().advice, HasSubstr("is its interval of 1e-12 too short? Give"));
  EXPECT_EQ(run.outcome().t, 0.0);
}

// Two runs, one of which goes on where the other ended, have every event once: also where that is
// at a root.
TEST_P(EventsOf, ARunInTwoPartsHasEachOnce) {
  // q and -q are one attitude: a state may have the other sign than the run that it is from
  std::vector<Event> even = functions;
  std::erase_if(even, [](const Event& event) { return event.name == "qx"; });
  const Problem whole{System(wing_nut), spinning, 0.0, 12.0, GetParam().method, even};
  const std::vector<EventRecord> all = integrate(whole).events();
  for (std::size_t k = 0; k < all.size(); k += 5) {
    Problem first = whole;
    first.stop = all[k].t;
    const Trajectory start = integrate(first);
    Problem rest = whole;
    rest.start = all[k].t;
    rest.initial = start.samples().back().s;
    rest.continues = true;
    const Trajectory end = integrate(rest);
    EXPECT_EQ(start.events().size() + end.events().size(), all.size()) << k;
  }
}

TEST_P(EventsOf, WhatIsFasterThanTheBodyNeedsAnInterval) {
  Event hum{"hum", [](double t, const RotorState&) { return std::sin(40.0 * t + 0.1); }};
  hum.interval = 0.02;
  EXPECT_EQ(integrate(sphere(GetParam().method, 20.0, hum)).events().size(), 254U);
}

TEST_P(EventsOf, WhatTheyAskOfTheTermsIsCounted) {
  const Event event{"w", [](double, const RotorState& s) { return s.q.w; }};
  Problem p = sphere(GetParam().method, 40.0, event);
  const Statistics with = integrate(p).statistics();
  p.events.clear();
  const Statistics without = integrate(p).statistics();
  EXPECT_EQ(with.steps, without.steps);
  // how fast the body turns at both ends of a step, and slopes there
  EXPECT_GE(with.evaluations, without.evaluations + 4 * with.steps);
}

TEST_P(EventsOf, EndAtTheFirstThatStops) {
  Problem p{System(wing_nut), spinning, 0.0, 40.0, GetParam().method, functions};
  p.events[2].stops = true;
  const Trajectory run = integrate(p);
  EXPECT_EQ(run.outcome().status, Outcome::Status::stopped_by_event);
  const std::vector<Known> known =
      known_zeros(FreeRotation(wing_nut, spinning), functions[2], 40.0);
  EXPECT_NEAR(run.stop(), known[0].t, budget_of_time());
  EXPECT_EQ(run.events().back().name, "flip");
  EXPECT_EQ(of_name(run, "flip").size(), 1U);
  EXPECT_EQ(run.samples().back().t, run.stop());
}

// A torque that changes its slope makes steps end there; events are found on both sides.
TEST_P(EventsOf, InsideStepsThatATableCuts) {
  if (!std::holds_alternative<Adaptive>(GetParam().method) &&
      !std::holds_alternative<VariationOfConstants>(GetParam().method))
    GTEST_SKIP() << "the steps of a splitting are all equal";
  // w3 = 1 + the integral of a saw of torque: 1 + t^2 / 2 up to 1, 1.5 + u - u^2 / 2 up to 3, ...
  const TorqueTable saw({{0.0, {}}, {1.0, {0, 0, 1.0}}, {3.0, {0, 0, -1.0}}, {5.0, {}}}, {});
  const Event level{"level", [](double, const RotorState& s) { return s.g.z - 1.95; }};
  const Trajectory run =
      integrate({System(Body(1.0, 1.0, 1.0), Frame::inertial(), {AnyPerturbation("saw", saw)}),
                 RotorState{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}},
                 0.0,
                 5.0,
                 GetParam().method,
                 {level}});
  // 1.5 + u - u^2 / 2 = 1.95
  const double half = std::sqrt(0.1);
  ASSERT_EQ(run.events().size(), 2U);
  EXPECT_NEAR(run.events()[0].t, 2.0 - half, budget_of_time());
  EXPECT_NEAR(run.events()[1].t, 2.0 + half, budget_of_time());
}

TEST_P(EventsOf, MethodsAgreeInAGravityGradient) {
  const KeplerOrbit moon({.gm = 1.0, .pericentre = 0.9, .eccentricity = 0.1});
  Problem p{System(Body(0.4, 0.6, 0.9), Frame::precessing({0.0, 0.0, 1.0}, 0.5, 0.0),
                   {AnyPerturbation("moon", GravityGradient(0.01, moon))}),
            {{0.5, 0.5, -0.5, 0.5}, {0.2, 0.3, 0.9}},
            0.0,
            60.0,
            Adaptive{.tolerance = 1e-14},
            functions};
  const Trajectory best = integrate(p);
  const std::string& name = GetParam().name;
  const double allowed = name == "AdaptiveLoose" || name == "SplittingOrder2"
                             ? budget::event_time_beside_orbit_loose
                             : budget::event_time_beside_orbit;
  p.method = GetParam().method;
  if (auto* splitting = std::get_if<Splitting>(&p.method))
    splitting->step = smaller(splitting->step, 0.2);
  const Trajectory run = integrate(p);
  for (const Event& event : functions) {
    const auto wanted = of_name(best, event.name), found = of_name(run, event.name);
    ASSERT_EQ(found.size(), wanted.size()) << event.name;
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i].t, wanted[i].t, allowed) << event.name;
  }
}

// A thruster takes the momentum to a rate and goes out: 0.0 or a rounding is left of the function,
// for good. Nothing was reported.
TEST(Events, ADespunBodyHasReachedItsRate) {
  const auto jet = [](const double&, const RotorState&, std::span<const double> sides) {
    return Vec3{0.0, 0.0, sides[0] > 0.0 ? -0.25 : 0.0};
  };
  for (const Method& method : {Method(Collocation{}), Method(Adaptive{})})
    for (const double rate : {0.125, 0.1, 0.3, 0.7}) {
      const auto above = [rate](double, const RotorState& s) { return std::vector{s.g.z - rate}; };
      const System system(Body(1.0, 1.5, 2.0), Frame::inertial(),
                          {{"jet", SwitchedTorqueTerm(jet, above)}});
      Problem p{system, {{}, {0.0, 0.0, 1.0}}, 0.0, 10.0, method};
      p.events = {{"done", [rate](double, const RotorState& s) { return s.g.z - rate; }}};
      const double time = 4.0 * (1.0 - rate);
      const Trajectory whole = integrate(p);
      ASSERT_EQ(whole.events().size(), 2U) << rate;
      EXPECT_NEAR(whole.events()[0].t, time, budget::event_time_of_line) << rate;
      EXPECT_EQ(whole.events()[0].direction, -1);
      EXPECT_EQ(whole.events()[1].t, 10.0);
      p.events[0].crossing = Crossing::falling;
      p.events[0].stops = true;
      const Trajectory run = integrate(p);
      EXPECT_EQ(run.outcome().status, Outcome::Status::stopped_by_event);
      EXPECT_EQ(run.stop(), whole.events()[0].t);
    }
}

// At rest until a table begins.
TEST(Events, ABodyLeavesItsRestWhereATableBegins) {
  const TorqueTable table({{0.0, {}}, {3.0, {}}, {5.0, {0.0, 0.0, 1.0}}}, {});
  for (const Method& method : {Method(Collocation{}), Method(Adaptive{})}) {
    Problem p{
        System(Body(1.0, 1.5, 2.0), Frame::inertial(), {{"table", table}}), {}, 0.0, 4.5, method};
    p.events = {{"moves", [](double, const RotorState& s) { return s.g.z; }}};
    const Trajectory run = integrate(p);
    ASSERT_EQ(run.events().size(), 2U);
    EXPECT_EQ(run.events()[0].t, 0.0);
    EXPECT_EQ(run.events()[0].direction, 0);
    EXPECT_NEAR(run.events()[1].t, 3.0, budget::event_time_of_line);
    EXPECT_EQ(run.events()[1].direction, 1);
  }
}

// A torque that is rough by 1e-9 is no polynomial to 1e-16.
TEST(Events, OfARoughTorqueAreThoseOfShorterSteps) {
  const AnyPerturbation rough("rough", TorqueTerm([](double, const RotorState& s) {
                                const double x = s.q.x * s.q.x + 1e-8 * std::sin(1e12 * s.q.x);
                                return Vec3{0.0, 0.0, 0.05 + 0.05 * x};
                              }));
  const Event level{"level", [](double, const RotorState& s) { return std::sin(9.0 * s.g.z); }};
  Problem p{System(Body(1.0, 1.2, 1.5), Frame::inertial(), {rough}),
            {{0.6, 0.8, 0.0, 0.0}, {0.1, 0.2, 0.5}},
            0.0,
            40.0,
            Adaptive{.tolerance = 1e-8},
            {level}};
  const std::vector<EventRecord> wanted = integrate(p).events();
  p.method = VariationOfConstants{.tolerance = 1e-6};
  const std::vector<EventRecord> found = integrate(p).events();
  ASSERT_GE(wanted.size(), 5U);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(level.function({found[i].t, found[i].s}), 0.0, budget::event_time) << i;
    EXPECT_NEAR(found[i].t, wanted[i].t, budget::event_time_loose) << i;
  }
}

TEST(Events, ThatAreNoneAreRefused) {
  Problem p = sphere(Adaptive{}, 1.0, dip(0.1));
  p.events[0].interval = -1.0;
  EXPECT_REJECTED(integrate(p), "event \"dip\": interval -1 must be positive, or 0 for none");
  p.events[0].interval = 0.0;
  p.events[0].period = std::nan("");
  EXPECT_REJECTED(integrate(p), "event \"dip\": period nan");
}

}  // namespace
