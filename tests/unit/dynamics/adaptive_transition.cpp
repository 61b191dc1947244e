// SPDX-License-Identifier: MIT
// State transition matrices: against the closed one of the free rotation, differences of runs in
// double-double, and the symplectic law.
#include <gmock/gmock.h>

#include <cmath>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "unit/dynamics/adaptive_support.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace polhode::test;
using polhode::test::larger;

const Adaptive tight{1e-14};

double largest(const Matrix6& m) {
  double size = 0.0;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) size = larger(size, std::abs(m(i, j)));
  return size;
}
// Entries relative to the largest one.
double difference(const Matrix6& a, const Matrix6& b) {
  Matrix6 d;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) d(i, j) = a(i, j) - b(i, j);
  return largest(d) / largest(b);
}

// The Poisson matrix of (theta_B, g_B): {theta, g} = 1, {g_i, g_j} = -eps_ijk g_k.
Matrix6 poisson(const Vec3& g) {
  Matrix6 P;
  const Mat3 G = hat(g);
  for (int i = 0; i < 3; ++i) {
    P(i, i + 3) = 1.0;
    P(i + 3, i) = -1.0;
    for (int j = 0; j < 3; ++j) P(i + 3, j + 3) = G(i, j);
  }
  return P;
}

// (dtheta_B, dg_B) from one state to a near one.
std::array<double, 6> tangent(const RotorState& from, const RotorState& to) {
  Quaternion d = conj(from.q) * to.q;
  if (d.w < 0.0) d = {-d.w, -d.x, -d.y, -d.z};
  const Vec3 g = to.g - from.g;
  return {2.0 * d.x, 2.0 * d.y, 2.0 * d.z, g.x, g.y, g.z};
}

TEST(StateTransitions, WithoutTorqueAreThoseOfTheFreeRotation) {
  const double stop = 10.0 * w1_turn;
  const FreeRotation free(w1_body, w1_state);
  for (const Method& method : {Method(tight), Method(Collocation{1e-14})}) {
    SCOPED_TRACE(method_text(method));
    const auto rows = state_transitions({System(w1_body), w1_state, 0.0, stop, method},
                                        SaveAt::count(0.0, stop, 4));
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0].transition, Matrix6::identity());
    for (const TransitionSample& row : rows) {
      EXPECT_LE(difference(row.transition, free.state_transition(row.t)), budget::transition_free);
      EXPECT_LE(distance(row.s, free.at(row.t)), budget::transition_free);
    }
  }
}

// Powers of two scale every number of the run, and so no bit of its steps.
TEST(StateTransitions, DoNotDependOnTheUnitOfMass) {
  const auto transition = [](double unit) {
    const Problem problem{System(Body(unit, 1.5 * unit, 2.25 * unit)),
                          {{}, {0.25 * unit, 0.5 * unit, 1.75 * unit}},
                          0.0,
                          20.0,
                          Adaptive{.tolerance = 1e-9}};
    return state_transitions(problem, SaveAt::times({20.0}))[0].transition;
  };
  const Matrix6 one = transition(1.0);
  for (const double unit : {0x1p-40, 0x1p40}) {
    const Matrix6 other = transition(unit);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        EXPECT_EQ(other(i, j), one(i, j));
        EXPECT_EQ(other(i, j + 3) * unit, one(i, j + 3));
        EXPECT_EQ(other(i + 3, j + 3), one(i + 3, j + 3));
      }
  }
}

TEST(StateTransitions, OfAGravityGradientAreTheDifferencesOfRuns) {
  const double stop = 3.0, h = 1e-4;
  const auto rows = state_transitions(w1(tight, 0.0, stop), SaveAt::times({stop}));
  const auto swept = state_transitions(w1(Collocation{1e-14}, 0.0, stop), SaveAt::times({stop}));
  const Adaptive exact{1e-19, Precision::double_double};
  Matrix6 M;
  for (int j = 0; j < 6; ++j) {
    const auto moved = [&](double step) {
      RotorState s = w1_state;
      if (j < 3) {
        Quaternion turn{1.0, 0.0, 0.0, 0.0};
        (j == 0 ? turn.x : j == 1 ? turn.y : turn.z) = std::tan(0.5 * step);
        s.q = normalized(s.q * turn);
      } else {
        s.g[j - 3] += step;
      }
      return tangent(rows[0].s, end_of(w1(exact, 0.0, stop, s)).s);
    };
    // Fourth order: (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / 12 h
    const auto a = moved(h), b = moved(-h), c = moved(2.0 * h), d = moved(-2.0 * h);
    for (int i = 0; i < 6; ++i) {
      const auto k = static_cast<std::size_t>(i);
      M(i, j) = (8.0 * (a[k] - b[k]) - (c[k] - d[k])) / (12.0 * h);
    }
  }
  EXPECT_LE(difference(rows[0].transition, M), budget::transition_difference);
  EXPECT_LE(difference(swept[0].transition, M), budget::transition_difference);
}

TEST(StateTransitions, OfAHamiltonianAreSymplectic) {
  const auto rows = state_transitions(w1(tight, 0.0, 20.0), SaveAt::count(0.0, 20.0, 6));
  for (const TransitionSample& row : rows) {
    const Matrix6& M = row.transition;
    const Matrix6 carried = M * poisson(w1_state.g) * transpose(M);
    const double scale = largest(M) * largest(M) * largest(poisson(w1_state.g));
    EXPECT_LE(largest(poisson(row.s.g)) * difference(carried, poisson(row.s.g)),
              budget::transition_symplectic * scale);
  }
}

TEST(StateTransitions, InAPrecessingFrameBackwards) {
  const Frame frame = Frame::precessing({0.0, 0.6, 0.8}, 0.4);
  const double stop = -2.0;
  const auto there =
      state_transitions(w1(tight, 0.0, stop, w1_state, frame), SaveAt::times({stop}));
  const auto back =
      state_transitions(w1(tight, stop, 0.0, there[0].s, frame), SaveAt::times({0.0}));
  EXPECT_LE(distance(back[0].s, w1_state), budget::transition_free);
  EXPECT_LE(difference(back[0].transition * there[0].transition, Matrix6::identity()),
            budget::transition_free);
}

TEST(StateTransitions, OfEveryMethodAreThoseOfTheMotion) {
  const Frame frame = Frame::precessing({0.0, 0.6, 0.8}, 0.4);
  // within steps, at their ends, and several in one
  const SaveAt times = SaveAt::times({0.0, 0.013, 0.015, 0.5, 1.0, 1.2345});
  for (const double stop : {1.5, -1.5}) {
    const SaveAt due = stop > 0.0 ? times : SaveAt::times({0.0, -0.013, -1.0, -1.2345});
    const auto exact = state_transitions(w1(tight, 0.0, stop, w1_state, frame), due);
    for (const Method& method :
         {Method{Splitting{0.01, SplittingScheme::order8}}, Method{VariationOfConstants{1e-13}},
          Method{Collocation{1e-13}}, Method{Collocation{1e-13, 4}}, Method{Collocation{1e-13, 16}},
          Method{Collocation{.step = 0.05}}}) {
      SCOPED_TRACE(method_text(method));
      const auto rows = state_transitions(w1(method, 0.0, stop, w1_state, frame), due);
      ASSERT_EQ(rows.size(), exact.size());
      for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_EQ(rows[k].t, exact[k].t);
        EXPECT_LE(difference(rows[k].transition, exact[k].transition), budget::transition_method);
        EXPECT_LE(distance(rows[k].s, exact[k].s), budget::transition_method);
      }
    }
  }
}

// M P M^T - P', relative to |M|^2 |P|.
double symplectic_defect(const TransitionSample& row, const RotorState& first) {
  const Matrix6& M = row.transition;
  const Matrix6 carried = M * poisson(first.g) * transpose(M);
  const double scale = largest(M) * largest(M) * largest(poisson(first.g));
  return largest(poisson(row.s.g)) * difference(carried, poisson(row.s.g)) / scale;
}

TEST(StateTransitions, OfASplittingAreSymplecticWhateverTheStep) {
  const auto rows = state_transitions(w1(Splitting{0.1, SplittingScheme::order2}, 0.0, 20.0),
                                      SaveAt::count(0.0, 20.0, 6));
  for (const TransitionSample& row : rows)
    EXPECT_LE(symplectic_defect(row, w1_state), budget::transition_symplectic);
}

// In (q, g), which are no canonical variables, Gauss' steps are symplectic to their order: with
// eight stages to rounding at any step that is of use.
TEST(StateTransitions, OfCollocationAreSymplecticToItsOrder) {
  const auto defect = [](int stages, double step) {
    const auto rows = state_transitions(w1(Collocation{.stages = stages, .step = step}, 0.0, 4.0),
                                        SaveAt::times({4.0}));
    return symplectic_defect(rows[0], w1_state);
  };
  EXPECT_NEAR(std::log2(defect(4, 0.2) / defect(4, 0.1)), 8.0, budget::collocation_order);
  for (const TransitionSample& row :
       state_transitions(w1(Collocation{.step = 0.2}, 0.0, 20.0), SaveAt::count(0.0, 20.0, 6)))
    EXPECT_LE(symplectic_defect(row, w1_state), budget::transition_symplectic);
}

// Of the steps as they are, however coarse: differences of runs by the same steps.
TEST(StateTransitions, OfCollocationAreThoseOfItsSteps) {
  const Collocation coarse{.stages = 4, .step = 0.25};
  const double stop = 3.0, h = 1e-4;
  const auto rows = state_transitions(w1(coarse, 0.0, stop), SaveAt::times({stop}));
  for (int j = 0; j < 6; ++j) {
    const auto moved = [&](double step) {
      RotorState s = w1_state;
      if (j < 3) {
        Quaternion turn{1.0, 0.0, 0.0, 0.0};
        (j == 0 ? turn.x : j == 1 ? turn.y : turn.z) = std::tan(0.5 * step);
        s.q = normalized(s.q * turn);
      } else {
        s.g[j - 3] += step;
      }
      const Trajectory run = integrate(w1(coarse, 0.0, stop, s), {SaveAt::times({stop}), false});
      return tangent(rows[0].s, run.samples().back().s);
    };
    const auto a = moved(h), b = moved(-h), c = moved(2.0 * h), d = moved(-2.0 * h);
    for (int i = 0; i < 6; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double slope = (8.0 * (a[k] - b[k]) - (c[k] - d[k])) / (12.0 * h);
      EXPECT_NEAR(rows[0].transition(i, j), slope,
                  budget::transition_difference * largest(rows[0].transition));
    }
  }
}

struct BreaksAt {
  static constexpr bool kick = true;
  double t;
  template <Real T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    return {{}, {T(at.t > T(t) ? std::nan("") : 0.0), T(0.0), T(0.0)}};
  }
};

TEST(StateTransitions, RefuseWhatTheyCannotDo) {
  const SaveAt end = SaveAt::times({1.0});
  const auto dragged = [](const auto&, const auto& s) { return s.g.x * s.q.w * s.q.w; };
  const Problem no_flow{
      System(w1_body, Frame::inertial(), {AnyPerturbation("drag", HamiltonianTerm(dragged))}),
      w1_state, 0.0, 1.0, Splitting{0.01}};
  EXPECT_REJECTED(state_transitions(no_flow, end), "Adaptive");
  const auto on_double = [](double, const RotorState&) { return Vec3{}; };
  const Problem p{
      System(w1_body, Frame::inertial(), {AnyPerturbation("thruster", TorqueTerm(on_double))}),
      w1_state, 0.0, 1.0};
  EXPECT_REJECTED(state_transitions(p, end), "\"thruster\" works on double alone");
  const Problem broken{
      System(w1_body, Frame::inertial(), {AnyPerturbation("broken", BreaksAt{0.5})}), w1_state, 0.0,
      1.0};
  for (const Method& method : {Method(tight), Method(Splitting{0.01}), Method(Collocation{})}) {
    Problem run = broken;
    run.method = method;
    EXPECT_REJECTED(state_transitions(run, end), "finite");
  }
  EXPECT_THROW(state_transitions(w1(tight, 0.0, 1.0), SaveAt::times({0.5, 0.2})), DomainError);
  EXPECT_THROW(state_transitions(w1(Adaptive{0.0}, 0.0, 1.0), end), DomainError);
}

}  // namespace
