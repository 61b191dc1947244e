// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "dynamics/splitting/splitting_map.hpp"
#include "message_of.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "splitting_support.hpp"
#include "unit/dynamics/splitting_support.hpp"

namespace polhode::splitting_test {
namespace {

using namespace splitting_test;
using Scheme = SplittingScheme;

constexpr Scheme schemes[] = {Scheme::order2, Scheme::order4, Scheme::order6,
                              Scheme::order8, Scheme::ABA864, Scheme::ABA1064};

System gravity(double strength, const Frame& frame = Frame::inertial()) {
  return System(workload_body(), frame,
                {AnyPerturbation("gravity gradient", PointMassTorque{1.0, 0.1, strength})});
}

double slope(double coarse, double fine, double octaves) {
  return std::log2(coarse / fine) / octaves;
}

TEST(SplittingCoefficients, AddUpToOneAndAreTheSameBackwards) {
  for (const Scheme scheme : schemes) {
    for (const bool exact : {true, false}) {
      const detail::SplittingCoefficients c = detail::splitting_coefficients(scheme, exact);
      for (const std::vector<double>& a : {c.drifts, c.kicks}) {
        DoubleDouble sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
          sum += a[i];
          EXPECT_EQ(a[i], a[a.size() - 1 - i]);
        }
        EXPECT_LE(std::abs((sum - 1.0).hi), budget::splitting_consistency);
      }
      const std::size_t more = c.drift_first ? c.drifts.size() : c.kicks.size();
      EXPECT_EQ(more, (c.drift_first ? c.kicks.size() : c.drifts.size()) + 1);
      EXPECT_TRUE(exact || c.drift_first || !detail::composes_order2(scheme));
    }
  }
}

TEST(Splitting, IsFreeRotationWhereThereIsNoTorque) {
  const auto methods = [](double time) {
    std::vector<Splitting> all;
    for (const Scheme scheme : schemes) all.push_back({time / 97.3, scheme});
    return all;
  };
  expect_free_rotation(methods, budget::splitting_free);
}

// A rotor of constant speed in the body, and axes that move in space, beside Collocation; and what
// the term does to the equations of motion, by dual numbers of its energy.
TEST(Splitting, TakesTermsLinearInTheMomentum) {
  const auto wheel = [](double) { return Vec3{0.3, -0.2, 0.1}; };
  const auto axis = [](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    using std::sin;
    return BasicVec3<T>{T(0.1) + T(0.05) * sin(T(0.7) * t), T(0.2), T(-0.15) * t};
  };
  const std::vector<AnyPerturbation> terms[] = {
      {AnyPerturbation("wheel", MomentumTerm(wheel))},
      {AnyPerturbation("inertial", MomentumTerm(axis, SpaceAxes::inertial))},
      {AnyPerturbation("reference", MomentumTerm(axis, SpaceAxes::reference)),
       AnyPerturbation("gravity gradient", PointMassTorque{1.0, 0.1, 0.01})}};
  const RotorState s = splitting_test::workload_state();
  for (const Frame& frame : {Frame::inertial(), splitting_test::precessing_frame()})
    for (const std::vector<AnyPerturbation>& all : terms) {
      EXPECT_TRUE(all[0].supports_flow());
      EXPECT_EQ(all[0].supports_any_real(), all[0].name() != "wheel");  // a function on double
      const System system(splitting_test::workload_body(), frame, all);
      const RotorState exact =
          splitting_test::end_of(system, s, 0.0, 5.0, Collocation{.tolerance = 1e-14});
      const RotorState end =
          splitting_test::end_of(system, s, 0.0, 5.0, Splitting{0.01, SplittingScheme::order6});
      EXPECT_LE(splitting_test::distance(end, exact), budget::splitting_momentum_term);
      const Setting at{system.body(), 0.4, s, frame.at(0.4).q_IS};
      const Effect e = all[0].effect(at);
      const BasicSetting<Tangent> dual = with_variables(at);
      const auto H = [&]<class Term>(const Term& term) { return term.energy(dual).derivative; };
      const auto d = &all == &terms[0]   ? H(MomentumTerm(wheel))
                     : &all == &terms[1] ? H(MomentumTerm(axis, SpaceAxes::inertial))
                                         : H(MomentumTerm(axis, SpaceAxes::reference));
      EXPECT_LE(norm(e.v - Vec3{d[3], d[4], d[5]}) + norm(e.u + Vec3{d[0], d[1], d[2]}),
                budget::splitting_momentum_effect);
    }
}

TEST(Splitting, AndVariationOfConstantsTakeRatesOfAnyUnitOfTime) {
  const System system(workload_body());
  for (const double unit : {1e-28, 1e27}) {
    RotorState s = workload_state();
    s.g = unit * s.g;
    const double time = 3.0 / unit;
    const RotorState exact = FreeRotation(system.body(), s).at(time);
    EXPECT_LE(distance(end_of(system, s, 0.0, time, Splitting{0.01 * time}), exact),
              budget::splitting_free);
    EXPECT_LE(distance(end_of(system, s, 0.0, time, VariationOfConstants{}), exact),
              budget::splitting_free);
  }
}

TEST(Splitting, TakesMomentaOfAnyUnitOfMass) {
  const Vec3 I = workload_body().moments();
  for (const double unit : {1e-120, 1e120}) {
    const System system(Body(unit * I.x, unit * I.y, unit * I.z));
    RotorState s = workload_state();
    s.g = unit * s.g;
    const RotorState exact = FreeRotation(system.body(), s).at(3.0);
    const RotorState end = end_of(system, s, 0.0, 3.0, Splitting{0.01});
    EXPECT_LE(distance({end.q, (1.0 / unit) * end.g}, {exact.q, (1.0 / unit) * exact.g}),
              budget::splitting_free)
        << unit;
  }
}

TEST(Splitting, TakesStepsOfManyTurnsOfAFreeBody) {
  const System system(workload_body());
  const RotorState exact = FreeRotation(system.body(), workload_state()).at(10.0);
  const RotorState end = end_of(system, workload_state(), 0.0, 10.0, Splitting{5.0});
  EXPECT_LE(distance(end, exact), budget::splitting_free);
}

// What is tiny next to the middle axis grows: the body flips where the closed form flips it.
TEST(Splitting, FlipsABodyThatIsNextToItsMiddleAxis) {
  const Body body(1.0, 1.7, 2.1);
  const RotorState start{{1, 0, 0, 0}, {1e-120, 1.0, 0.0}};
  const Vec3 g = FreeRotation(body, start).at(1400.0).g;
  const RotorState end = end_of(System(body), start, 0.0, 1400.0, Splitting{0.5});
  EXPECT_LT(g.y, -0.999);
  EXPECT_LT(end.g.y, -0.999);
}

// |g| and the kinetic energy after 1e5 drifts: no walk at all, while g itself has been rounded at
// every step.
TEST(Splitting, KeepsMomentumAndEnergyOfAFreeBodyBeyondDouble) {
  const Body body = workload_body();
  const detail::SplittingMap map(System(body), Scheme::order2);
  detail::SplittingState s = map.start(0.0, workload_state());
  const auto squares = [&](const Vec3& weight) {
    DoubleDouble sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const DoubleDouble g = DoubleDouble::sum(s.g.hi[i], s.g.lo[i]);
      sum += g * g / weight[i];
    }
    return sum;
  };
  const DoubleDouble G2 = squares({1, 1, 1}), T2 = squares(body.moments());
  for (int i = 0; i < 100000; ++i) s = map.stepped(s, 0.0123);
  EXPECT_LE(std::abs(((squares({1, 1, 1}) - G2) / G2).hi), budget::splitting_invariant);
  EXPECT_LE(std::abs(((squares(body.moments()) - T2) / T2).hi), budget::splitting_invariant);
}

TEST(Splitting, HasTheOrderThatItsNameSays) {
  const System system = gravity(1.0, precessing_frame());
  const RotorState s = workload_state();
  const RotorState exact = end_of(system, s, 0.0, 2.0, Splitting{0.002, Scheme::order8});
  const struct {
    Scheme scheme;
    double order, h, octaves;
  } cases[] = {{Scheme::order2, 2, 0.05, 2},
               {Scheme::order4, 4, 0.05, 2},
               {Scheme::order6, 6, 0.05, 2},
               {Scheme::order8, 8, 0.1, 1}};
  for (const auto& c : cases) {
    const double coarse = distance(end_of(system, s, 0.0, 2.0, Splitting{c.h, c.scheme}), exact);
    const double fine = distance(
        end_of(system, s, 0.0, 2.0, Splitting{c.h * std::exp2(-c.octaves), c.scheme}), exact);
    EXPECT_GE(slope(coarse, fine, c.octaves), c.order - budget::splitting_order_below);
    EXPECT_LE(slope(coarse, fine, c.octaves), c.order + budget::splitting_order_above);
  }
}

// The part of the error that is odd in the torque: its leading term is that in eps.
double odd_error(Scheme scheme, double strength, double h) {
  std::array<double, 6> e[2];
  for (const int side : {0, 1}) {
    const System system = gravity(side == 0 ? strength : -strength);
    const RotorState s = workload_state();
    const RotorState exact = end_of(system, s, 0.0, 4.0, Splitting{0.004, Scheme::order8});
    const RotorState end = end_of(system, s, 0.0, 4.0, Splitting{h, scheme});
    e[side] = difference(end, exact);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum += (e[0][i] - e[1][i]) * (e[0][i] - e[1][i]);
  return 0.5 * std::sqrt(sum);
}

TEST(Splitting, OfNearIntegrableFamiliesIsOfOrder8And10InASmallTorqueAndProportionalToIt) {
  EXPECT_NEAR(slope(odd_error(Scheme::ABA864, 0.1, 0.1), odd_error(Scheme::ABA864, 0.1, 0.05), 1),
              8.0, budget::splitting_near_order);
  EXPECT_NEAR(slope(odd_error(Scheme::ABA1064, 0.1, 0.2), odd_error(Scheme::ABA1064, 0.1, 0.1), 1),
              10.0, budget::splitting_near_order);
  for (const auto& [scheme, h] : {std::pair{Scheme::ABA864, 0.1}, {Scheme::ABA1064, 0.2}})
    EXPECT_NEAR(odd_error(scheme, 0.03, h) / odd_error(scheme, 0.006, h), 5.0,
                budget::splitting_proportion);
}

TEST(Splitting, OfNearIntegrableFamiliesIsOfOrder4InAStrongTorque) {
  const System system = gravity(100.0);
  const RotorState s = workload_state();
  const RotorState exact = end_of(system, s, 0.0, 1.0, Splitting{0.001, Scheme::order8});
  for (const Scheme scheme : {Scheme::ABA864, Scheme::ABA1064}) {
    const double coarse = distance(end_of(system, s, 0.0, 1.0, Splitting{0.025, scheme}), exact);
    const double fine = distance(end_of(system, s, 0.0, 1.0, Splitting{0.00625, scheme}), exact);
    EXPECT_NEAR(slope(coarse, fine, 2.0), 4.0, budget::splitting_order_below);
  }
}

// Two kinds of flows together: kicks are then compositions themselves.
TEST(Splitting, KeepsItsOrderWhereFlowsDoNotCommute) {
  const System system(workload_body(), Frame::inertial(),
                      {AnyPerturbation("damping", Damping{0.7}),
                       AnyPerturbation("gravity gradient", PointMassTorque{1.0, 0.1, 3.0}),
                       AnyPerturbation("torque along b1", Spinner{0.9})});
  const RotorState s = workload_state();
  const RotorState exact = end_of(system, s, 0.0, 1.0, Splitting{0.0005, Scheme::order8});
  const struct {
    Scheme scheme;
    double order, h;
  } cases[] = {{Scheme::order2, 2, 0.01}, {Scheme::order4, 4, 0.05}, {Scheme::order6, 6, 0.05},
               {Scheme::order8, 8, 0.1},  {Scheme::ABA864, 4, 0.1},  {Scheme::ABA1064, 4, 0.1}};
  for (const auto& c : cases) {
    const double coarse = distance(end_of(system, s, 0.0, 1.0, Splitting{c.h, c.scheme}), exact);
    const double fine =
        distance(end_of(system, s, 0.0, 1.0, Splitting{0.5 * c.h, c.scheme}), exact);
    EXPECT_GE(slope(coarse, fine, 1.0), c.order - budget::splitting_order_below)
        << static_cast<int>(c.scheme) << " " << coarse << " " << fine;
  }
}

TEST(Splitting, RunsBackToWhereItStarted) {
  const System system = gravity(1.0, precessing_frame());
  const RotorState s = workload_state();
  for (const Scheme scheme : schemes) {
    const Splitting method{turns_10 / 128.0, scheme};
    const RotorState there = end_of(system, s, 0.0, turns_10, method);
    EXPECT_LE(distance(end_of(system, there, turns_10, 0.0, method), s), budget::splitting_free);
    const double far = 10.0 * turns_10;
    const RotorState farther = end_of(system, s, 0.0, far, method);
    EXPECT_LE(distance(end_of(system, farther, far, 0.0, method), s), budget::hundred_turns_back);
  }
}

TEST(Splitting, IsTheSameMotionInAMovingFrame) {
  const System inertial = gravity(1.0), moving = gravity(1.0, precessing_frame());
  const RotorState s = workload_state();  // the frame coincides with inertial axes at t = 0
  for (const Scheme scheme : schemes) {
    const Splitting method{0.1, scheme};
    const RotorState a = end_of(inertial, s, 0.0, turns_10, method);
    const RotorState b = end_of(moving, s, 0.0, turns_10, method);
    EXPECT_LE(distance(inertial_state(moving, turns_10, b), a), budget::splitting_free);
  }
}

TEST(Splitting, DenseOutputIsAStepOfTheSameScheme) {
  const System system = gravity(1.0, precessing_frame());
  const RotorState s = workload_state();
  for (const Scheme scheme : schemes) {
    const Splitting method{0.1, scheme};
    const auto stepper = detail::make_stepper(Problem{system, s, 0.0, 1.0, method, {}}, method);
    ASSERT_EQ(stepper->advance(1.0), "");
    ASSERT_EQ(stepper->advance(1.0), "");
    const auto dense = stepper->dense(true);
    EXPECT_EQ(dense->t0(), 0.1);
    EXPECT_EQ(dense->t1(), 0.2);
    EXPECT_LE(distance(dense->at(dense->t1()), stepper->state()), budget::splitting_dense);
    const RotorState first = end_of(system, s, 0.0, 0.1, method);
    EXPECT_LE(distance(dense->at(0.1), first), budget::splitting_dense);
    const RotorState middle = end_of(system, first, 0.1, 0.143, method);
    EXPECT_LE(distance(dense->at(0.143), middle), budget::splitting_dense);
  }
}

Matrix6 poisson(const Vec3& g) {
  Matrix6 P;
  const Mat3 h = hat(g);
  for (int i = 0; i < 3; ++i) {
    P(i, 3 + i) = 1.0;
    P(3 + i, i) = -1.0;
    for (int j = 0; j < 3; ++j) P(3 + i, 3 + j) = h(i, j);
  }
  return P;
}

TEST(Splitting, StepIsSymplectic) {
  for (const Frame& frame : {Frame::inertial(), precessing_frame()}) {
    for (const Scheme scheme : schemes) {
      const detail::SplittingMap map(gravity(1.0, frame), scheme);
      const detail::SplittingState s = map.start(0.3, workload_state());
      const Matrix6 M = map.step_transition(s, 0.1);  // one radian
      const Vec3 g1 = map.stepped(s, 0.1).g.hi;
      const Matrix6 P = poisson(s.g.hi), image = M * P * transpose(M), wanted = poisson(g1);
      Matrix6 size_M = M, size_P = P;
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
          size_M(i, j) = std::abs(M(i, j));
          size_P(i, j) = std::abs(P(i, j));
        }
      const Matrix6 size = size_M * size_P * transpose(size_M);
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          EXPECT_LE(std::abs(image(i, j) - wanted(i, j)),
                    budget::splitting_symplectic_eps * epsilon<double>() * size(i, j));
    }
  }
}

TEST(Splitting, StepTransitionIsTheDerivativeOfTheStep) {
  const detail::SplittingMap map(gravity(1.0, precessing_frame()), Scheme::ABA864);
  const RotorState s = workload_state();
  const Matrix6 M = map.step_transition(map.start(0.3, s), 0.1);
  const double d = 1e-5;
  for (int j = 0; j < 6; ++j) {
    std::array<double, 6> ends[2];
    for (const int side : {0, 1}) {
      const double x = side == 0 ? d : -d;
      RotorState moved = s;
      if (j < 3) {
        Quaternion turn{1.0, 0.0, 0.0, 0.0};
        (j == 0 ? turn.x : j == 1 ? turn.y : turn.z) = 0.5 * x;
        moved.q = s.q * turn;
      } else {
        moved.g[j - 3] += x;
      }
      const auto end = map.state(map.stepped(map.start(0.3, moved), 0.1));
      const auto base = map.state(map.stepped(map.start(0.3, s), 0.1));
      ends[side] = difference(end, base);
      for (std::size_t i = 3; i < 6; ++i) ends[side][i] *= norm(base.g);
    }
    for (int i = 0; i < 6; ++i) {
      const auto row = static_cast<std::size_t>(i);
      EXPECT_NEAR((ends[0][row] - ends[1][row]) / (2.0 * d), M(i, j), budget::splitting_difference);
    }
  }
}

TEST(Splitting, NamesATermWithoutAFlow) {
  const System system(workload_body(), Frame::inertial(), {AnyPerturbation("drag", NoFlow{})});
  EXPECT_MESSAGE(detail::make_stepper(Problem{system, workload_state(), 0, 1, Splitting{0.1}, {}},
                                      Splitting{0.1}),
                 "Splitting: term \"drag\" has no exact flow: use Adaptive, which needs none");
}

std::string advice_of(const System& system, double start, double stop, double step) {
  const Splitting method{step};
  const auto stepper =
      detail::make_stepper(Problem{system, workload_state(), start, stop, method, {}}, method);
  for (int i = 0; i < 1000 && stepper->time() != stop; ++i) {
    const double before = stepper->time();
    const std::string advice = stepper->advance(stop);
    if (advice.empty()) continue;
    EXPECT_EQ(stepper->time(), before);  // it stays where it was
    EXPECT_TRUE(std::isfinite(stepper->state().q.w));
    return advice;
  }
  return "";
}

TEST(Splitting, SaysWhyItCannotGoOn) {
  const System broken(workload_body(), Frame::inertial(),
                      {AnyPerturbation("fine", PointMassTorque{1.0, 0.1}),
                       AnyPerturbation("broken", BreaksAt{1.0})});
  EXPECT_THAT(advice_of(broken, 0.0, 3.0, 0.1),
              testing::HasSubstr("term \"broken\" is not finite near t = "));
  EXPECT_EQ(advice_of(gravity(1.0), 1e9, 2e9, 1e-9),
            "step 1e-09 is below the rounding of t = 1e+09: take a larger step or count time from "
            "a nearer epoch");
  EXPECT_EQ(advice_of(gravity(1.0), 0.0, 1e12, 1e6),
            "step 1e+06 is 7500000 radians of rotation at t = 0: take a step of less than a turn");
}

// Another unit of mass, from grains to planets: the same bits.
TEST(Splitting, AndVariationOfConstantsDoNotKnowUnits) {
  const Vec3 I = workload_body().moments();
  const RotorState s = workload_state();
  const auto run = [&](double unit, const auto& method) {
    const System system(Body(unit * I.x, unit * I.y, unit * I.z), precessing_frame(),
                        {AnyPerturbation("gravity gradient", PointMassTorque{1.0, 0.1})});
    RotorState end = end_of(system, {s.q, unit * s.g}, 0.0, turns_10, method);
    end.g = (1.0 / unit) * end.g;
    return end;
  };
  for (const double unit : {0x1p-120, 0x1p160}) {
    EXPECT_EQ(run(unit, Splitting{0.1}), run(1.0, Splitting{0.1}));
    EXPECT_EQ(run(unit, VariationOfConstants{1e-9}), run(1.0, VariationOfConstants{1e-9}));
  }
}

TEST(Splitting, CountsWhatItDoes) {
  const Splitting method{0.125, Scheme::order2};
  const auto stepper =
      detail::make_stepper(Problem{gravity(1.0), workload_state(), 0.0, 1.0, method, {}}, method);
  while (stepper->time() != 1.0) ASSERT_EQ(stepper->advance(1.0), "");
  EXPECT_EQ(stepper->statistics().steps, 8);
  EXPECT_EQ(stepper->statistics().evaluations, 9);  // the kick between two steps is made once
}

// What a step makes of one deviation is the step's derivative times that deviation: every column of
// the one is the other, two derivations that share the kicks' duals alone.

TEST(SplittingDeviation, IsAColumnOfTheTransition) {
  const System system(Body(1.0, 1.7, 2.1), precessing_frame(),
                      {AnyPerturbation("gravity", PointMassTorque{0.8, 0.2})});
  const Vec3 moving{0.7, -1.1, 0.4}, rest{};
  for (const auto& [scheme, g] : {std::pair{SplittingScheme::order2, moving},
                                  {SplittingScheme::ABA864, moving},
                                  {SplittingScheme::order2, rest},
                                  {SplittingScheme::ABA864, rest}}) {
    const detail::SplittingMap map(system, scheme);
    const detail::SplittingState s =
        map.start(0.4, {normalized(Quaternion{0.3, -0.4, 0.5, 0.6}), g});
    const Matrix6 M = map.step_transition(s, 0.3);
    for (int j = 0; j < 6; ++j) {
      HubDirection d{};
      (j < 3 ? d.turn : d.momentum)[j % 3] = 1.0;
      const HubDirection after = map.step_deviation(s, d, 0.3).along;
      for (int i = 0; i < 6; ++i)
        EXPECT_NEAR((i < 3 ? after.turn : after.momentum)[i % 3], M(i, j),
                    budget::splitting_deviation)
            << "entry " << i << ", " << j;
    }
  }
}

}  // namespace
}  // namespace polhode::splitting_test
