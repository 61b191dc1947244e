// SPDX-License-Identifier: MIT
// A run that goes on from a checkpoint gives the bits of the straight run: every method, forwards
// and backwards, between steps and inside one, with events and without.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "message_of.hpp"
#include "own_steps.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/torque_table.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "unit/dynamics/resume_support.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;
using testing::HasSubstr;

Problem problem(const Method& method, double stop) {
  const KeplerOrbit moon({.gm = 1.0, .pericentre = 0.9, .eccentricity = 0.1});
  const auto height = [](double, const RotorState& s) { return s.g.z - 0.2; };
  return {System(Body(1.0, 2.0, 2.7), Frame::precessing({0.0, 0.0, 1.0}, 0.1, 0.0),
                 {AnyPerturbation("moon", GravityGradient(0.3, moon))}),
          {{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}},
          0.0,
          stop,
          method,
          {{"height", height, Crossing::both, false, 0.0}}};
}

using Record = RecordOf<SystemState>;

class ResumeOf : public testing::TestWithParam<Method> {};

TEST_P(ResumeOf, BetweenSteps) {
  for (const double stop : {40.0, -40.0}) {
    SCOPED_TRACE(stop);
    expect_the_straight_run(problem(GetParam(), stop), SaveAt::count(0.0, stop, 41), 7);
  }
}

// More samples than steps, and more than a block holds: checkpoints are among them.
TEST_P(ResumeOf, InsideAStep) {
  expect_the_straight_run(problem(GetParam(), 8.0), SaveAt::count(0.0, 8.0, 1201), 101);
}

TEST_P(ResumeOf, ARunThatAnEventStops) {
  Problem p = problem(GetParam(), 400.0);
  p.events.push_back(
      {"end", [](double t, const RotorState&) { return t - 33.3; }, Crossing::both, true, 0.0});
  expect_the_straight_run(p, SaveAt::count(0.0, 400.0, 401), 3);
}

// Sides of switching functions, and steps that end where one is zero.
TEST(Resume, ATorqueThatSwitches) {
  const auto push = [](const double&, const RotorState&, std::span<const double> sides) {
    return Vec3{0.05 * sides[0], 0.0, sides[1] > 0.0 ? 0.04 : 0.0};
  };
  const auto sides = [](double t, const RotorState& s) {
    return std::vector{std::sin(0.7 * t), s.g.z - 0.2};
  };
  for (const Method& method : {Method(Adaptive{}), Method(Collocation{})})
    for (const double stop : {40.0, -40.0}) {
      SCOPED_TRACE(method_text(method));
      Problem p = problem(method, stop);
      p.system = System(p.system.body(), p.system.frame(),
                        {AnyPerturbation("push", SwitchedTorqueTerm(push, sides))});
      expect_the_straight_run(p, SaveAt::count(0.0, stop, 401), 3);
    }
}

// What `checkpoint` throws stops the run there: nothing after it is lost to the resumed one.
TEST_P(ResumeOf, AStreamMayStopTheRun) {
  const Problem p = problem(GetParam(), 40.0);
  const SaveAt times = SaveAt::count(0.0, 40.0, 401);
  Record record;
  Streams streams = into(record, 30);
  std::size_t kept = 0;
  streams.checkpoint = [&](const Checkpoint& now) {
    record.checkpoints.push_back(now);
    kept = record.samples.size();
    throw std::runtime_error("stop");
  };
  EXPECT_THROW(integrate(p, times, streams), std::runtime_error);
  Record straight, rest;
  integrate(p, times, into(straight, 0));
  resume(p, times, record.checkpoints.at(0), into(rest, 0));
  record.samples.resize(kept);
  record.samples.insert(record.samples.end(), rest.samples.begin(), rest.samples.end());
  EXPECT_EQ(record.samples, straight.samples);
}

INSTANTIATE_TEST_SUITE_P(
    Methods, ResumeOf,
    testing::Values(Adaptive{.tolerance = 1e-9},
                    Adaptive{.tolerance = 1e-18, .precision = Precision::double_double},
                    Splitting{.step = 0.05, .scheme = SplittingScheme::order4},
                    Splitting{.step = 0.05}, VariationOfConstants{.tolerance = 1e-10},
                    Collocation{.tolerance = 1e-10}, Collocation{.stages = 4, .step = 0.1},
                    test::runge_kutta_4(0.05)));

TEST(Resume, WithADamper) {
  for (const Method& method :
       {Method(Adaptive{.tolerance = 1e-9}),
        Method(Adaptive{.tolerance = 1e-18, .precision = Precision::double_double}),
        Method(Collocation{.tolerance = 1e-10}), Method(Collocation{.step = 0.1})}) {
    SCOPED_TRACE(method_text(method));
    const Problem free = problem(method, 40.0);
    const auto height = [](double, const RotorState& s) { return s.g.z - 0.2; };
    const Problem p{
        System(free.system.body(), free.system.frame(), free.system.terms(), KaneDamper(0.2, 0.05)),
        {free.initial.q, free.initial.g, {0.1, 0.2, -0.3}},
        0.0,
        40.0,
        method,
        {{"height", height, Crossing::both, false, 0.0}}};
    expect_the_straight_run(p, SaveAt::count(0.0, 40.0, 401), 21);

    const SaveAt times = SaveAt::count(0.0, 40.0, 401);
    RecordOf<SystemState> record, rest;
    integrate(p, times, into(record, 50));
    const Checkpoint& from = record.checkpoints.at(0);
    const auto differs = [&](const Problem& other) {
      return message_of([&] { resume(other, times, from, into(rest, 0)); });
    };
    Problem other = p;
    other.system =
        System(free.system.body(), free.system.frame(), free.system.terms(), KaneDamper(0.2, 0.06));
    EXPECT_THAT(differs(other), HasSubstr("damper differs"));
    other.system = free.system;
    other.initial.damper_rate = {};
    EXPECT_THAT(differs(other), HasSubstr("damper differs"));
    other = p;
    other.initial.damper_rate.x = 0.0;
    EXPECT_THAT(differs(other), HasSubstr("damper_rate differs"));
  }
}

// A torque that jumps ends steps, and the samples before the jump are those of its own side.
TEST(Resume, WithATorqueThatJumps) {
  const TorqueTable thruster(
      {{0.0, {}}, {2.7, {0.3, 0.0, 0.0}}, {2.9, {}}, {5.5, {0.0, 0.2, 0.0}}},
      {TorqueTable::Between::step, TorqueTable::Outside::hold, std::nullopt});
  for (const Method& method :
       {Method(Adaptive{.tolerance = 1e-9}), Method(VariationOfConstants{.tolerance = 1e-10})}) {
    Problem p = problem(method, 8.0);
    std::vector<AnyPerturbation> terms = p.system.terms();
    terms.emplace_back("thruster", thruster);
    p.system = System(p.system.body(), p.system.frame(), terms);
    expect_the_straight_run(p, SaveAt::count(0.0, 8.0, 1201), 67);
  }
}

TEST(Resume, AnotherProblemIsRefusedByWhatDiffers) {
  const Problem p = problem(Splitting{.step = 0.1}, 40.0);
  const SaveAt times = SaveAt::count(0.0, 40.0, 41);
  Record record;
  integrate(p, times, into(record, 100));
  const Checkpoint& from = record.checkpoints.at(0);
  const auto refusal = [&](const Problem& other, const SaveAt& at) {
    Record rest;
    const std::string message = message_of([&] { resume(other, at, from, into(rest, 0)); });
    EXPECT_TRUE(rest.samples.empty());
    return message;
  };
  Problem other = p;
  other.initial.g.x = 0.81;
  EXPECT_THAT(refusal(other, times), HasSubstr("state differs"));
  other = p;
  other.stop = 41.0;
  EXPECT_THAT(refusal(other, times), HasSubstr("stop differs"));
  other = p;
  other.method = Splitting{.step = 0.2};
  EXPECT_THAT(refusal(other, times), HasSubstr("method differs"));
  other = p;
  other.events.clear();
  EXPECT_THAT(refusal(other, times), HasSubstr("events differs"));
  EXPECT_THAT(refusal(p, SaveAt::count(0.0, 40.0, 42)), HasSubstr("sample times differs"));
}

TEST(Resume, BytesThatAreNoCheckpoint) {
  Record record;
  integrate(problem(Splitting{.step = 0.1}, 40.0), SaveAt::count(0.0, 40.0, 41), into(record, 100));
  std::string bytes = record.checkpoints.at(0).bytes();
  EXPECT_THROW(Checkpoint(""), DomainError);
  EXPECT_THROW(Checkpoint("no checkpoint, but long enough to be one of them"), DomainError);
  EXPECT_THROW(Checkpoint(bytes.substr(0, bytes.size() - 1)), DomainError);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  EXPECT_THROW(Checkpoint{bytes}, DomainError);
}

// t and what a run has written are in the hash, and so is the hash itself by its comparison.
TEST(Resume, AFlippedBitAnywhereIsSeen) {
  Record record;
  integrate(problem(Splitting{.step = 0.1}, 40.0), SaveAt::count(0.0, 40.0, 41), into(record, 100));
  const std::string& bytes = record.checkpoints.at(0).bytes();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
    EXPECT_THROW(Checkpoint{damaged}, DomainError) << i;
  }
}

// What follows the hash, under a head that is right.
Checkpoint with_hash(const Checkpoint& from, const std::string& hashed) {
  Archive reader(from.bytes()), head;
  std::string magic;
  reader(magic);
  std::uint64_t hash = fingerprint(hashed);
  head.all(magic, hash);
  return Checkpoint(head.bytes() + hashed);
}

std::string behind_hash(const Checkpoint& from) {
  Archive reader(from.bytes());
  std::string magic;
  reader(magic);
  return from.bytes().substr(8 + magic.size() + 8);
}

TEST(Resume, BytesThatWereMadeUp) {
  const Problem p = problem(Splitting{.step = 0.1}, 40.0);
  const SaveAt times = SaveAt::count(0.0, 40.0, 41);
  Record record;
  integrate(p, times, into(record, 100));
  const Checkpoint& from = record.checkpoints.at(0);
  const std::string hashed = behind_hash(from);
  const auto refusal = [&](const std::string& bytes) {
    return message_of([&] { resume(p, times, with_hash(from, bytes), Streams{}); });
  };
  EXPECT_EQ(refusal(hashed), "");
  EXPECT_THAT(refusal(hashed + std::string(8, '\0')), HasSubstr("holds more numbers"));
  EXPECT_THAT(refusal(hashed.substr(0, hashed.size() - 8)), HasSubstr("end too early"));
  // more features than memory holds: their number stands behind t
  std::string many = hashed;
  many[8 + 7] = '\x10';
  EXPECT_THAT(refusal(many), HasSubstr("end too early"));
}

}  // namespace
