// SPDX-License-Identifier: MIT
// Runs of a body with a Kane damper, against two rigid bodies that rub in inertial axes.
#include <gmock/gmock.h>

#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/internal_damping.hpp"

namespace {

using namespace polhode;

const Body body(1.0, 1.6, 2.1);
constexpr double J = 0.3;
constexpr double c = 0.4;
const RotorState start{{0.5, 0.5, -0.5, 0.5}, {0.8, 1.9, 0.3}};
const Vec3 s0{0.4, -0.7, 0.2};
const Vec3 torque{0.02, -0.01, 0.03};  // inertial axes
constexpr Adaptive sharp{.tolerance = 1e-14};
const Method methods[] = {sharp, Collocation{.tolerance = 1e-14}};

Problem problem(double stop, const Method& method = sharp, const Frame& frame = Frame::inertial(),
                std::vector<AnyPerturbation> terms = {}, double friction = c) {
  return {System(body, frame, std::move(terms), KaneDamper(J, friction)),
          {start.q, start.g, s0},
          0.0,
          stop,
          method};
}

using Long = long double;
using LongVec3 = BasicVec3<Long>;
using LongQuaternion = BasicQuaternion<Long>;

LongVec3 wide(const Vec3& v) {
  return {static_cast<Long>(v.x), static_cast<Long>(v.y), static_cast<Long>(v.z)};
}
Vec3 narrow(const LongVec3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
LongVec3 divided(const LongVec3& x, const LongVec3& by) {
  return {x.x / by.x, x.y / by.y, x.z / by.z};
}
LongQuaternion attitude(const LongQuaternion& q) {
  const Long size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / size, q.x / size, q.y / size, q.z / size};
}

// q_IH of the hub, its momentum P and that of the sphere H, both in space: dP/dt = U + c s,
// dH/dt = -c s. In long double, by Fehlberg's method of order 8 at a step of a 200th.
class TwoBodies {
 public:
  using Values = std::array<Long, 10>;

  Values at(double t) const {
    const LongVec3 g = wide(start.g), s = wide(s0);
    const LongVec3 w = divided(g - J_ * s, wide(body.moments()));
    const LongQuaternion q = attitude({static_cast<Long>(start.q.w), static_cast<Long>(start.q.x),
                                       static_cast<Long>(start.q.y), static_cast<Long>(start.q.z)});
    const LongVec3 H = rotate(q, J_ * (w + s));
    const LongVec3 P = rotate(q, g) - H;
    Values v{q.w, q.x, q.y, q.z, P.x, P.y, P.z, H.x, H.y, H.z};
    boost::numeric::odeint::runge_kutta_fehlberg78<Values, Long> stepper;
    const Long steps = std::ceil(static_cast<Long>(t) * 200.0L);
    const Long h = static_cast<Long>(t) / steps;
    for (Long i = 0.0L; i < steps; i += 1.0L)
      stepper.do_step([this](const Values& a, Values& da, Long) { da = rates(a); }, v, 0.0L, h);
    return v;
  }
  Sample sample(double t, const Values& v) const {
    const LongQuaternion q = attitude({v[0], v[1], v[2], v[3]});
    const LongVec3 P{v[4], v[5], v[6]}, H{v[7], v[8], v[9]};
    return {t,
            {{static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
              static_cast<double>(q.z)},
             narrow(rotate(conj(q), P + H)),
             narrow(rotate(conj(q), (1.0L / J_) * H - rate(q, P)))}};
  }
  Sample sample(double t) const { return sample(t, at(t)); }

 private:
  // Of the hub, in space.
  LongVec3 rate(const LongQuaternion& q, const LongVec3& P) const {
    const LongVec3 I = wide(body.moments());
    return rotate(q, divided(rotate(conj(q), P), {I.x - J_, I.y - J_, I.z - J_}));
  }
  Values rates(const Values& v) const {
    const LongQuaternion q = attitude({v[0], v[1], v[2], v[3]});
    const LongVec3 P{v[4], v[5], v[6]}, H{v[7], v[8], v[9]};
    const LongVec3 W = rate(q, P);
    const LongVec3 friction = static_cast<Long>(c) * ((1.0L / J_) * H - W);
    const LongVec3 dP = wide(torque) + friction;
    const LongQuaternion dq = LongQuaternion{0.0L, 0.5L * W.x, 0.5L * W.y, 0.5L * W.z} * q;
    return {dq.w, dq.x, dq.y, dq.z, dP.x, dP.y, dP.z, -friction.x, -friction.y, -friction.z};
  }

  Long J_ = static_cast<Long>(J);
};

double distance(const Sample& a, const Sample& b) {
  const Quaternion d = conj(a.s.q) * b.s.q;
  return 2.0 * norm(Vec3{d.x, d.y, d.z}) + norm(a.s.g - b.s.g) / norm(b.s.g) +
         norm(a.s.damper_rate - b.s.damper_rate);
}

AnyPerturbation thruster() { return {"thruster", ConstantTorque::in_space(torque)}; }

TEST(KaneDamperRun, IsThatOfTwoBodiesInSpace) {
  for (const Method& method :
       {Method(sharp), Method(Adaptive{.tolerance = 1e-18, .precision = Precision::double_double}),
        Method(Collocation{.tolerance = 1e-14}), Method(Collocation{1e-14, 4}),
        Method(Collocation{1e-14, 16}), Method(Collocation{.step = 0.1})}) {
    SCOPED_TRACE(method_text(method));
    const Trajectory run = integrate(problem(20.0, method, Frame::inertial(), {thruster()}));
    ASSERT_TRUE(run.outcome().ok());
    for (const double t : {0.3, 7.1, 20.0}) {
      const Sample want = TwoBodies().sample(t);
      EXPECT_LE(distance(run.sample(t), want), budget::kane_two_bodies) << t;
      EXPECT_EQ(run.at(t), run.sample(t).s);
    }
    EXPECT_LT(norm(run.at(20.0).damper_rate), 0.5 * norm(s0));
  }
}

TEST(KaneDamperRun, IsTheSameInAMovingFrame) {
  for (const Method& method : methods) {
    SCOPED_TRACE(method_text(method));
    const Frame frame = Frame::precessing({0.3, -0.2, 1.0}, 0.7, 0.4);
    Problem moving = problem(20.0, method, frame, {thruster()});
    const RotorState seen = reference_state(moving.system, 0.0, start);
    moving.initial = {seen.q, seen.g, s0};
    const Trajectory run = integrate(moving);
    Sample end = run.sample(20.0);
    const RotorState inertial = inertial_state(moving.system, 20.0, end.s);
    end.s = {inertial.q, inertial.g, end.s.damper_rate};
    EXPECT_LE(distance(end, TwoBodies().sample(20.0)), budget::kane_two_bodies);
  }
}

// An energy in momenta alone: its v turns body and sphere alike.
struct Coupling {
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return {{T(0.1) * at.s.g.y, T(0.1) * at.s.g.x, T(0.0)}, {}};
  }
  template <Real T>
  T energy(const BasicSetting<T>& at) const {
    return T(0.1) * at.s.g.x * at.s.g.y;
  }
};

TEST(KaneDamperRun, LosesTheEnergyOfTheFrictionAndNoMomentum) {
  for (const Method& method : methods) {
    SCOPED_TRACE(method_text(method));
    for (const bool with_terms : {false, true}) {
      std::vector<AnyPerturbation> terms;
      if (with_terms) terms.emplace_back("coupling", Coupling{});
      const Frame frame =
          with_terms ? Frame::precessing({0.0, 0.6, 0.8}, 0.3, 0.0) : Frame::inertial();
      const Problem p = problem(15.0, method, frame, terms);
      const Trajectory run = integrate(p);
      const auto energy_at = [&](double t) {
        const SystemState at = run.at(t);
        return energy(at_damper_rate(p.system, at.damper_rate), t, at);
      };
      const auto power = [&](double t) {
        const Vec3 s = run.at(t).damper_rate;
        return c * dot(s, s);
      };
      double lost = 0.0;
      for (int i = 0; i < 30; ++i)
        lost +=
            boost::math::quadrature::gauss<double, 15>::integrate(power, 0.5 * i, 0.5 * i + 0.5);
      EXPECT_GT(lost, 0.01);
      EXPECT_NEAR((energy_at(0.0) - energy_at(15.0)) / lost, 1.0, budget::kane_energy);
      const auto in_space = [&](double t) {
        const RotorState s = inertial_state(p.system, t, run.at(t));
        return rotate(s.q, s.g);
      };
      if (with_terms) continue;
      EXPECT_LE(norm(in_space(15.0) - in_space(0.0)), budget::internal_damping_momentum);
    }
  }
}

TEST(KaneDamperRun, WithoutFrictionTheHubIsFree) {
  for (const Method& method : methods) {
    SCOPED_TRACE(method_text(method));
    const Problem p = problem(30.0, method, Frame::inertial(), {}, 0.0);
    const Trajectory run = integrate(p);
    const Vec3& I = body.moments();
    const Vec3 h = p.system.damper()->momentum(body, start.g, s0);
    const FreeRotation hub(Body(I.x - J, I.y - J, I.z - J), {start.q, start.g - h});
    const Vec3 h_I = rotate(start.q, h);
    for (const double t : {3.0, 30.0}) {
      const Sample at = run.sample(t);
      const RotorState alone = hub.at(t);
      const Vec3 of_sphere = rotate(conj(alone.q), h_I);
      const Sample want{t,
                        {alone.q, alone.g + of_sphere,
                         p.system.damper()->relative_rate(body, alone.g + of_sphere, of_sphere)}};
      EXPECT_LE(distance(at, want), budget::kane_two_bodies);
    }
  }
}

// A sphere that follows closely: InternalDamping with k = J^2/c I^-2, up to k J/c, which is k^2/J.
TEST(KaneDamperRun, TendsToInternalDamping) {
  const Vec3& I = body.moments();
  std::vector<double> error;
  for (const double k : {0.5e-4, 1e-4, 2e-4}) {
    const Vec3 k_B{k / (I.x * I.x), k / (I.y * I.y), k / (I.z * I.z)};
    const System limit(body, Frame::inertial(), {{"friction", InternalDamping(k_B)}});
    const System full(body, Frame::inertial(), {}, KaneDamper(J, J * J / k));
    const Vec3 g = integrate({full, start, 0.0, 40.0, sharp}).at(40.0).g;
    error.push_back(norm(g - integrate({limit, start, 0.0, 40.0, sharp}).at(40.0).g));
  }
  EXPECT_LT(error[0], budget::kane_close);
  EXPECT_NEAR(error[1] / error[0], 4.0, budget::kane_first_order);
  EXPECT_NEAR(error[2] / error[1], 4.0, budget::kane_first_order);
}

TEST(KaneDamperRun, TurnsWithABodyThatSpins) {
  for (const Method& method : methods) {
    SCOPED_TRACE(method_text(method));
    Problem p = problem(50.0, method);
    p.initial.g = {0.0, 0.0, 1.7};
    p.initial.damper_rate = {};
    const Trajectory run = integrate(p);
    EXPECT_EQ(run.samples().back().s.damper_rate, Vec3{});
    EXPECT_EQ(run.samples().back().s.g, p.initial.g);
  }
}

TEST(KaneDamperRun, RestsWithABodyAtRest) {
  for (const Method& method : methods) {
    SCOPED_TRACE(method_text(method));
    Problem p = problem(50.0, method);
    p.initial.g = {};
    p.initial.damper_rate = {};
    const Trajectory run = integrate(p);
    EXPECT_EQ(run.outcome().status, Outcome::Status::completed) << run.outcome().advice;
    EXPECT_EQ(run.samples().back().s, p.initial);
    EXPECT_EQ(run.samples().back().s.damper_rate, Vec3{});
  }
}

TEST(KaneDamperRun, GoesBackToItsStart) {
  for (const Method& method : methods) {
    SCOPED_TRACE(method_text(method));
    Problem p = problem(3.0, method, Frame::inertial(), {thruster()});
    p.initial = integrate(p).at(3.0);
    p.start = 3.0;
    p.stop = 0.0;
    EXPECT_LE(distance(integrate(p).sample(0.0), {0.0, {start.q, start.g, s0}}),
              budget::kane_two_bodies);
  }
}

TEST(KaneDamperRun, EventsAndSamplesHoldItsRate) {
  for (const Method& method : methods) {
    SCOPED_TRACE(method_text(method));
    Problem p = problem(20.0, method);
    p.events.push_back({"slow",
                        [](double, const SystemState& s) { return norm(s.damper_rate) - 0.3; },
                        Crossing::falling, true});
    const Trajectory run = integrate(p, {.samples = SaveAt::steps(0.0, 20.0, 0.25)});
    ASSERT_EQ(run.events().size(), 1U);
    EXPECT_NEAR(norm(run.events()[0].s.damper_rate), 0.3, budget::kane_two_bodies);
    EXPECT_EQ(run.outcome().status, Outcome::Status::stopped_by_event);
    EXPECT_EQ(run.samples()[0].s.damper_rate, s0);
    EXPECT_EQ(run.samples().back().s.damper_rate, run.events()[0].s.damper_rate);
    EXPECT_EQ(run.samples()[2].s.damper_rate, run.at(0.5).damper_rate);
  }
}

// An event of the rotor, samples that are pushed, and a rate of 0 without a damper.
TEST(KaneDamperRun, SamplesPushedAreThoseKept) {
  const auto height = [](double, const RotorState& s) { return s.g.z - 0.2; };
  for (const bool with_damper : {true, false}) {
    SCOPED_TRACE(with_damper);
    const System system =
        with_damper ? problem(1.0).system : System(body, Frame::inertial(), {thruster()});
    const Problem p{system, start, 0.0, 20.0, sharp, {{"height", height, Crossing::both}}};
    const Trajectory run = integrate(p);
    ASSERT_FALSE(run.events().empty());
    EXPECT_EQ(norm(run.at(7.7).damper_rate) > 0.0, with_damper);
    std::vector<Sample> pushed;
    integrate(p, SaveAt::count(0.0, 20.0, 9), [&](std::span<const Sample> block) {
      pushed.insert(pushed.end(), block.begin(), block.end());
    });
    ASSERT_EQ(pushed.size(), 9U);
    for (const Sample& at : pushed) EXPECT_EQ(at.s, run.at(at.t));
  }
}

TEST(KaneDamperRun, SystemAtARateKnowsItsRotation) {
  const Problem p = problem(1.0);
  const System at = at_damper_rate(p.system, s0);
  const Vec3& I = body.moments();
  const Vec3 h = p.system.damper()->momentum(body, start.g, s0), rest = start.g - h;
  const Vec3 w{rest.x / (I.x - J), rest.y / (I.y - J), rest.z / (I.z - J)};
  EXPECT_LE(norm(angular_velocity(at, 0.0, start).inertial - w), budget::kane_rounding);
  EXPECT_NEAR(energy(at, 0.0, start), 0.5 * (dot(rest, w) + dot(h, h) / J), budget::kane_rounding);
  EXPECT_FALSE(at.damper());
  EXPECT_TRUE(p.system.has_energy());
  EXPECT_FALSE(p.system.is_hamiltonian());
}

TEST(KaneDamperRun, RefusesWhatDoesNotCarryItsState) {
  const Problem p = problem(1.0);
  EXPECT_MESSAGE(angular_velocity(p.system, 0.0, start),
                 "a system with a Kane damper has no angular velocity without the rate of the "
                 "damper: take at_damper_rate(system, rate)");
  EXPECT_REJECTED(energy(p.system, 0.0, start), "at_damper_rate");
  EXPECT_REJECTED(rotor_rates(p.system, 0.0, start), "at_damper_rate");
  const Problem bare{p.system, start, 0.0, 1.0, sharp};
  for (const Method& method : {Method(Splitting{0.1}), Method(VariationOfConstants{})})
    EXPECT_MESSAGE(integrate(problem(1.0, method)),
                   "integrate: a Kane damper has a state of its own: method must be Adaptive or "
                   "Collocation; InternalDamping, its limit of strong friction, has no state");
  EXPECT_MESSAGE(state_transitions(bare, SaveAt::times({1.0})),
                 "state_transitions: a Kane damper has a state of its own, which integrate alone "
                 "carries; InternalDamping, its limit of strong friction, has no state");
  EXPECT_REJECTED(analysis::chaos_indicator(bare, SaveAt::times({1.0})),
                  "which integrate alone carries");
  const Problem without{System(body), {start.q, start.g, {0.0, 0.1, 0.0}}, 0.0, 1.0, sharp};
  EXPECT_MESSAGE(integrate(without),
                 "integrate: damper_rate (0, 0.1, 0) must be zero for a system without a damper");
  EXPECT_MESSAGE(at_damper_rate(without.system, {0.0, 0.1, 0.0}),
                 "at_damper_rate: rate (0, 0.1, 0) must be zero for a system without a damper");
  Problem lost = p;
  lost.initial.damper_rate.y = std::nan("");
  EXPECT_MESSAGE(integrate(lost), "integrate: damper_rate (0.4, nan, 0.2) must be finite");
  EXPECT_REJECTED(System(body, Frame::inertial(), {}, KaneDamper(0.6, 1.0)),
                  "what is left must be a body");
}

}  // namespace
