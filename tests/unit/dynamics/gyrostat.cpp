// SPDX-License-Identifier: MIT
// A gyrostat (tests/gyrostat.hpp). Its
// oracles: what it conserves, an integration of its own in long double, and the closed form of an
// axisymmetric body whose wheel lies along the axis.
#include "gyrostat.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "unit/dynamics/resume_support.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Gyrostat;
using polhode::test::GyrostatState;
using polhode::test::Worst;
using testing::HasSubstr;

using GyrostatProblem = BasicProblem<Gyrostat>;
using GyrostatTrajectory = BasicTrajectory<GyrostatState>;

const Gyrostat satellite({1.0, 1.7, 2.2}, {0.15, -0.4, 0.9}, 0.05);
const GyrostatState start{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}, 0.25};
const double wheel_rate = std::sqrt(0.15 * 0.15 + 0.4 * 0.4 + 0.9 * 0.9) / 0.05;
constexpr Adaptive sharp{.tolerance = 1e-14};
constexpr Collocation swept{.tolerance = 1e-14};

GyrostatProblem problem(double stop, const Method& method = sharp) {
  return {satellite, start, 0.0, stop, method};
}

Vec3 momentum_in_space(const GyrostatState& s) { return rotate(s.q, s.g); }

// By the classical method of order 4 in long double, in steps of 1/2000: the momentum in space is
// the datum, and the body's attitude all that is integrated.
class InLongDouble {
 public:
  using Long = long double;
  using Values = std::array<Long, 4>;

  Quaternion attitude(double t) const {
    const Long steps = std::ceil(static_cast<Long>(std::abs(t)) * 2000.0L);
    const Long h = static_cast<Long>(t) / steps;
    Values q{0.5L, 0.5L, -0.5L, 0.5L};
    for (Long i = 0.0L; i < steps; i += 1.0L) {
      const Values a = rates(q), b = rates(moved(q, a, 0.5L * h)), c = rates(moved(q, b, 0.5L * h)),
                   d = rates(moved(q, c, h));
      for (std::size_t k = 0; k < 4; ++k) q[k] += h / 6.0L * (a[k] + 2.0L * (b[k] + c[k]) + d[k]);
    }
    const auto narrow = [](Long x) { return static_cast<double>(x); };
    return normalized(Quaternion{narrow(q[0]), narrow(q[1]), narrow(q[2]), narrow(q[3])});
  }

 private:
  static Values moved(Values q, const Values& rate, Long h) {
    for (std::size_t k = 0; k < 4; ++k) q[k] += h * rate[k];
    return q;
  }
  // g = R^T G, from the matrix of the attitude and not by our quaternions.
  static Values rates(const Values& q) {
    const Long w = q[0], x = q[1], y = q[2], z = q[3];
    const Long n = w * w + x * x + y * y + z * z;
    // G of the start: that quaternion is a turn by 120 degrees, which permutes the axes
    const Long G[] = {-1.9L, -0.3L, 0.8L};
    const Long R[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    const Long I[] = {1.0L, 1.7L, 2.2L}, h[] = {0.15L, -0.4L, 0.9L};
    Long W[3];
    for (int i = 0; i < 3; ++i)
      W[i] = ((R[0][i] * G[0] + R[1][i] * G[1] + R[2][i] * G[2]) / n - h[i]) / I[i];
    return {0.5L * (-x * W[0] - y * W[1] - z * W[2]), 0.5L * (w * W[0] + y * W[2] - z * W[1]),
            0.5L * (w * W[1] + z * W[0] - x * W[2]), 0.5L * (w * W[2] + x * W[1] - y * W[0])};
  }
};

double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion d = conj(a) * b;
  return 2.0 * norm(Vec3{d.x, d.y, d.z});
}

TEST(Gyrostat, KeepsMomentumAndEnergy) {
  for (const Method& method :
       {Method(sharp), Method(Adaptive{.tolerance = 1e-18, .precision = Precision::double_double}),
        Method(swept), Method(Collocation{.step = 0.1})}) {
    SCOPED_TRACE(method_text(method));
    const GyrostatTrajectory run = integrate(problem(200.0, method), {.dense = false});
    ASSERT_TRUE(run.outcome().ok()) << run.outcome().advice;
    ASSERT_GT(run.samples().size(), 100U);
    Worst momentum, energy, wheel;
    for (const auto& [t, s] : run.samples()) {
      momentum.add(norm(momentum_in_space(s) - momentum_in_space(start)));
      energy.add(std::abs(satellite.energy(s) / satellite.energy(start) - 1.0));
      wheel.add(std::abs(s.wheel - start.wheel - t * wheel_rate) / (1.0 + s.wheel));
    }
    EXPECT_LE(momentum.value(), budget::gyrostat_invariants);
    EXPECT_LE(energy.value(), budget::gyrostat_invariants);
    EXPECT_LE(wheel.value(), budget::gyrostat_invariants);
  }
}

TEST(Gyrostat, MovesAsInLongDouble) {
  for (const double stop : {12.0, -12.0}) {
    for (const Method& method : {Method(sharp), Method(swept), Method(Collocation{1e-13, 4}),
                                 Method(Collocation{1e-14, 16})}) {
      SCOPED_TRACE(method_text(method));
      const GyrostatTrajectory run = integrate(problem(stop, method));
      ASSERT_TRUE(run.has_dense());
      for (const double share : {0.11, 0.58, 1.0}) {
        const double t = share * stop;
        EXPECT_LE(angle_between(run.at(t).q, InLongDouble().attitude(t)), budget::gyrostat_motion);
      }
    }
  }
}

Quaternion turned_about(const Vec3& axis, double angle) {
  const Vec3 v = std::sin(0.5 * angle) * axis;
  return {std::cos(0.5 * angle), v.x, v.y, v.z};
}

// I1 = I2 and the wheel along 3: g3 is constant, (g1, g2) turns about 3 at g3 - I1 w3 over I1, and
// the body about 3 by the opposite angle and about the momentum in space at G / I1.
TEST(Gyrostat, OfAnAxisymmetricBodyIsAClosedForm) {
  const double I1 = 1.3, I3 = 2.0, h = 0.7;
  const Gyrostat symmetric({I1, I1, I3}, {0.0, 0.0, h}, 0.1);
  const GyrostatTrajectory run =
      integrate(GyrostatProblem{symmetric, start, 0.0, 60.0, sharp}, {.dense = true});
  const double n = start.g.z / I1 - (start.g.z - h) / I3;
  const Vec3 G = momentum_in_space(start);
  for (const double t : {0.7, 33.0, 60.0}) {
    const GyrostatState s = run.at(t);
    const Vec3& g = s.g;
    const Quaternion q = turned_about((1.0 / norm(G)) * G, norm(G) * t / I1) * start.q *
                         turned_about({0.0, 0.0, 1.0}, -n * t);
    EXPECT_LE(angle_between(s.q, q), budget::gyrostat_motion);
    EXPECT_NEAR(s.wheel, start.wheel + h / 0.1 * t, budget::gyrostat_motion * s.wheel);
    EXPECT_NEAR(g.x, start.g.x * std::cos(n * t) - start.g.y * std::sin(n * t),
                budget::gyrostat_motion);
    EXPECT_NEAR(g.y, start.g.x * std::sin(n * t) + start.g.y * std::cos(n * t),
                budget::gyrostat_motion);
    EXPECT_NEAR(g.z, start.g.z, budget::gyrostat_motion);
  }
}

class GyrostatEvents : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, GyrostatEvents, testing::Values(sharp, swept));

TEST_P(GyrostatEvents, AreZerosOfItsState) {
  GyrostatProblem p = problem(30.0, GetParam());
  const double turn = 2.0 * 3.141592653589793;
  // the wheel has turned ten times; and the momentum about axis 1 changes its sign
  p.events = {
      {"ten", [turn](double, const GyrostatState& s) { return s.wheel - 10.0 * turn; }},
      {"g1", [](const BasicSample<GyrostatState>& at) { return at.s.g.x; }, Crossing::falling}};
  const GyrostatTrajectory run = integrate(p);
  std::vector<double> falls;
  int tens = 0;
  for (const BasicEventRecord<GyrostatState>& event : run.events()) {
    if (event.name == "ten") {
      ++tens;
      EXPECT_EQ(event.direction, 1);
      EXPECT_NEAR(event.t, (10.0 * turn - start.wheel) / wheel_rate, budget::gyrostat_motion);
      continue;
    }
    falls.push_back(event.t);
    EXPECT_EQ(event.direction, -1);
    EXPECT_NEAR(event.s.g.x, 0.0, budget::gyrostat_motion);
    EXPECT_EQ(event.s.g, run.at(event.t).g);
  }
  EXPECT_EQ(tens, 1);
  // as many as changes of sign on a fine grid of the dense output
  std::size_t changes = 0;
  for (int k = 1; k <= 3000; ++k)
    if (run.at(0.01 * (k - 1)).g.x > 0.0 && run.at(0.01 * k).g.x <= 0.0) ++changes;
  EXPECT_GT(changes, 2U);
  EXPECT_EQ(falls.size(), changes);
}

using Record = test::RecordOf<GyrostatState>;

TEST(Gyrostat, GoesOnFromACheckpointInTheSameBits) {
  for (const Method& method :
       {Method(Adaptive{.tolerance = 1e-10}),
        Method(Adaptive{.tolerance = 1e-18, .precision = Precision::double_double}),
        Method(Collocation{.tolerance = 1e-10}), Method(Collocation{.step = 0.1})}) {
    SCOPED_TRACE(method_text(method));
    GyrostatProblem p = problem(40.0, method);
    p.events = {{"g3", [](double, const GyrostatState& s) { return s.g.z - 0.2; }}};
    test::expect_the_straight_run(p, SaveAt::count(0.0, 40.0, 1201), 101);
  }
}

TEST(Gyrostat, ACheckpointKnowsItsProblem) {
  const SaveAt times = SaveAt::count(0.0, 40.0, 41);
  Record record, rest;
  integrate(problem(40.0), times, into(record, 10));
  const Checkpoint& from = record.checkpoints.at(0);
  GyrostatProblem other = problem(40.0);
  other.system = Gyrostat({1.0, 1.7, 2.2}, {0.15, -0.4, 0.8}, 0.05);
  EXPECT_REJECTED(resume(other, times, from, into(rest, 0)), "parameters differs");
  other = problem(40.0);
  other.initial.wheel = 0.3;
  EXPECT_REJECTED(resume(other, times, from, into(rest, 0)), "state differs");
  const Problem rotor{System(Body(1.0, 1.7, 2.2)), {start.q, start.g}, 0.0, 40.0, sharp};
  EXPECT_REJECTED(resume(rotor, times, from, Streams{}), "another problem: state differs");
}

TEST(Gyrostat, ACheckpointKnowsTheStateAsItIsStarted) {
  const SaveAt times = SaveAt::count(0.0, 40.0, 41);
  Record record, rest;
  integrate(problem(40.0), times, into(record, 10));
  GyrostatProblem same = problem(40.0);
  same.initial.q = {1.0, 1.0, -1.0, 1.0};  // twice as long
  resume(same, times, record.checkpoints.at(0), into(rest, 0));
  ASSERT_FALSE(rest.samples.empty());
  EXPECT_EQ(rest.samples.back(), record.samples.back());
}

TEST(Gyrostat, RefusesWhatItCannotDo) {
  EXPECT_REJECTED(integrate(problem(1.0, Splitting{0.1})),
                  "method of a gyrostat must be Adaptive or Collocation: the others");
  GyrostatProblem p = problem(1.0);
  p.initial.wheel = std::nan("");
  EXPECT_REJECTED(integrate(p), "the angle of the wheel");
  EXPECT_REJECTED(problem(HUGE_VAL), "stop inf must be finite");
  for (const Method& method : {Method(sharp), Method(swept)}) {
    p = problem(1.0, method);
    p.initial.g.x = std::nan("");
    const GyrostatTrajectory run = integrate(p);
    EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
    EXPECT_THAT(run.outcome().advice, HasSubstr("rates of a gyrostat are not finite"));
  }
  const GyrostatTrajectory run = integrate(problem(100.0, Collocation{.step = 30.0}));
  EXPECT_EQ(run.outcome().status, Outcome::Status::failed);
  EXPECT_THAT(run.outcome().advice, HasSubstr("do not converge: take a shorter step"));
}

TEST(Gyrostat, StopsAtAnEventAndGoesBack) {
  GyrostatProblem p = problem(40.0);
  p.events = {{.name = "g3",
               .function = [](double, const GyrostatState& s) { return s.g.z - 0.2; },
               .stops = true}};
  const GyrostatTrajectory there = integrate(p, {.samples = SaveAt::steps(0.0, 40.0, 0.25)});
  ASSERT_EQ(there.outcome().status, Outcome::Status::stopped_by_event);
  const BasicSample<GyrostatState>& end = there.samples().back();
  EXPECT_EQ(end.t, there.outcome().t);
  const GyrostatTrajectory back = integrate(GyrostatProblem{satellite, end.s, end.t, 0.0, sharp});
  const GyrostatState s = back.at(0.0);
  EXPECT_LE(angle_between(s.q, start.q) + norm(s.g - start.g), budget::gyrostat_motion);
  EXPECT_NEAR(s.wheel, start.wheel, budget::gyrostat_motion);
}

}  // namespace
