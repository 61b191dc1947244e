// SPDX-License-Identifier: MIT
// Chart Jacobians against central differences of the same conversions at 100 digits, and against
// dual numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "budgets.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "property/chart_support.hpp"
#include "property/wide_jacobian.hpp"

namespace {

using namespace chart_test;
namespace budget = polhode::budget;

void expect_last_bits(const Matrix6& B, const Matrix6& expected, const std::string& where) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      EXPECT_NEAR(B(i, j), expected(i, j),
                  budget::jacobian_eps * eps * std::abs(expected(i, j)) + budget::jacobian_zero)
          << where << " entry " << i << ", " << j;
    }
  }
}

std::vector<RotorState> points(Sampler& sample) {
  std::vector<RotorState> states;
  for (int k = 0; k < 6; ++k) states.push_back(sample.generic());
  for (const double d : {1e-4, 1e-8, 1e-12}) {
    for (int k = 0; k < 4; ++k) {
      states.push_back(
          inclined_state({k % 2 == 0 ? d : 0.7, sample.coin(), k / 2 == 0 ? d : 0.9, sample.coin()},
                         sample.angle(), sample.angle(), sample.angle()));
      states.push_back(sample.near_euler_poles(d));
    }
  }
  return states;
}

TEST(ChartDerivatives, JacobiansAtTheHubAgainstDifferences) {
  Sampler sample(20250110);
  for (const RotorState& s : points(sample)) {
    for (const Chart& c : canonical_charts()) {
      if (c.id.set == CanonicalSet::poincare) {
        const auto p = nearest_poincare(s);
        if (c.id.pole_J != p.pole_J || c.id.pole_I != p.pole_I) continue;
      }
      const auto f = [&](const WideNumbers& n) { return to_hub(c.id, n); };
      expect_last_bits(chart_jacobian(s, c.id), differences(f, from_hub(c.id, widened(s))), c.name);
    }
  }
}

TEST(ChartDerivatives, JacobiansAtTheChartAgainstDifferences) {
  Sampler sample(20250111);
  for (const RotorState& s : points(sample)) {
    for (const Chart& c : canonical_charts()) {
      const Numbers n = c.from_hub(s);
      const Matrix6 B = c.own_jacobian(n);
      if (!finite(B)) continue;  // L = G in the numbers of the chart
      if (c.id.set == CanonicalSet::poincare) {
        const auto p = nearest_poincare(s);
        if (c.id.pole_J != p.pole_J || c.id.pole_I != p.pole_I) continue;
      }
      const auto f = [&](const WideNumbers& m) { return to_hub(c.id, m); };
      expect_last_bits(B, differences(f, widened(n)), c.name);
    }
  }
}

// At the poles themselves the Poincare-type sets are as regular as anywhere.
TEST(ChartDerivatives, PoincareAtItsPoles) {
  for (const Pole pole_J : poles) {
    for (const Pole pole_I : poles) {
      const Chart c = poincare_chart(pole_J, pole_I);
      const Numbers n{0.7, 0.0, 0.0, 1.0, 0.0, 0.0};
      const auto f = [&](const WideNumbers& m) { return to_hub(c.id, m); };
      expect_last_bits(c.own_jacobian(n), differences(f, widened(n)), c.name);
      expect_last_bits(chart_jacobian(c.to_hub(n), c.id), c.own_jacobian(n), c.name);
      EXPECT_LE(symplectic_defect(c.own_jacobian(n), canonical_tensor(), hub_tensor(c.to_hub(n).g)),
                budget::symplectic_eps);
    }
  }
}

TEST(ChartDerivatives, PlainSetsAtTheirPolesAreInfiniteNotUndefined) {
  for (const RotorState& s :
       {RotorState{{1, 0, 0, 0}, {0, 0, 1}}, RotorState{{0, 1, 0, 0}, {0, 0, 1}},
        RotorState{{1, 0, 0, 0}, {0, 0, -1}}}) {
    for (const Chart& c : {euler_chart(), andoyer_chart()}) {
      const Matrix6 B = chart_jacobian(s, c.id);
      bool infinite = false;
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
          EXPECT_FALSE(std::isnan(B(i, j))) << c.name << " " << i << ", " << j;
          infinite = infinite || std::isinf(B(i, j));
        }
      }
      EXPECT_TRUE(infinite) << c.name;
    }
  }
}

TEST(ChartDerivatives, RateJacobiansAgainstDifferences) {
  const polhode::Body body(1, 2, 2.5);
  Sampler sample(20250112);
  for (const RotorState& s : points(sample)) {
    const polhode::EulerRates e = to_euler_rates(body, s);
    const auto rates = [&](const WideNumbers& n) {
      return to_rotor(body, polhode::BasicEulerRates<Wide>{n[0], n[1], n[2], n[3], n[4], n[5]});
    };
    const Matrix6 B = chart_jacobian(body, e);
    const Matrix6 expected = differences(
        rates, widened(Numbers{e.phi, e.theta, e.psi, e.phi_dot, e.theta_dot, e.psi_dot}));
    const double size = 1.0 + std::abs(e.phi_dot) + std::abs(e.psi_dot);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        EXPECT_NEAR(B(i, j), expected(i, j), budget::chart_rounding * size);
      }
    }
    const Matrix6 unit = inverse_chart_jacobian(body, e) * B;
    const double sine = std::sin(e.theta);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        EXPECT_NEAR(unit(i, j), i == j ? 1.0 : 0.0,
                    budget::chart_rounding * size * size / (sine * sine));
      }
    }
  }
}

// Rates in body and inertial components: attitude varied by a small turn, omega by itself.
TEST(ChartDerivatives, BodyAndInertialRates) {
  const polhode::Body body(1, 2, 2.5);
  const polhode::Vec3& I = body.moments();
  Sampler sample(20250113);
  for (const RotorState& s : points(sample)) {
    const auto base = widened(s);
    const auto turned = [&](const WideNumbers& n) {
      const polhode::BasicQuaternion<Wide> d{Wide(1), n[0] / 2, n[1] / 2, n[2] / 2};
      return normalized(base.q) * normalized(d);
    };
    const auto momentum = [&](const polhode::BasicVec3<Wide>& w) {
      return polhode::BasicVec3<Wide>{I.x * w.x, I.y * w.y, I.z * w.z};
    };
    const auto by_body = [&](const WideNumbers& n) {
      return WideState{turned(n), momentum({n[3], n[4], n[5]})};
    };
    const auto by_inertial = [&](const WideNumbers& n) {
      const auto q = turned(n);
      return WideState{q, momentum(rotate(conj(q), polhode::BasicVec3<Wide>{n[3], n[4], n[5]}))};
    };
    const auto compare = [&](const Matrix6& B, const Matrix6& inverse, const Matrix6& expected) {
      const Matrix6 unit = inverse * B;
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
          EXPECT_NEAR(B(i, j), expected(i, j), budget::chart_rounding);
          EXPECT_NEAR(unit(i, j), i == j ? 1.0 : 0.0, budget::chart_rounding);
        }
      }
    };
    const Vec3 w_B = angular_velocity(body, s), w_I = inertial_angular_velocity(body, s);
    compare(body_rate_jacobian(body), inverse_body_rate_jacobian(body),
            differences(by_body, widened(Numbers{0, 0, 0, w_B.x, w_B.y, w_B.z})));
    compare(inertial_rate_jacobian(body, s), inverse_inertial_rate_jacobian(body, s),
            differences(by_inertial, widened(Numbers{0, 0, 0, w_I.x, w_I.y, w_I.z})));
  }
}

// The conversions are templates that a dual number passes through.
TEST(ChartDerivatives, DualNumbersThroughTwoConversions) {
  using D = polhode::Dual<double, 6>;
  Sampler sample(20250114);
  for (int k = 0; k < 200; ++k) {
    const RotorState s = inclined_state(
        {sample.uniform(0.3, 1.3), sample.coin(), sample.uniform(0.3, 1.3), sample.coin()},
        sample.angle(), sample.angle(), sample.angle());
    const Numbers n = andoyer_chart().from_hub(s);
    std::array<D, 6> x;
    for (int j = 0; j < 6; ++j) {
      x[static_cast<std::size_t>(j)] = D::variable(n[static_cast<std::size_t>(j)], j);
    }
    const auto hub = to_rotor(polhode::BasicAndoyerState<D>{x[0], x[1], x[2], x[3], x[4], x[5]});
    const auto e = to_euler(hub);
    const auto p = nearest_poincare(hub);
    const D euler[6] = {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
    const D poincare[6] = {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2};
    const RotorState at = andoyer_chart().to_hub(n);
    const Matrix6 to_euler_ =
        canonical_transformation(at, {CanonicalSet::andoyer}, {CanonicalSet::euler});
    const Matrix6 to_poincare_ = canonical_transformation(
        at, {CanonicalSet::andoyer}, {CanonicalSet::poincare, p.pole_J, p.pole_I});
    const double sine = std::sin(e.theta.value);
    for (int i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_NEAR(euler[i].derivative[j], to_euler_(i, static_cast<int>(j)),
                    budget::andoyer_generic / (sine * sine));
        EXPECT_NEAR(poincare[i].derivative[j], to_poincare_(i, static_cast<int>(j)),
                    budget::andoyer_generic);
      }
    }
  }
}

// Euler's variables from Andoyer's by the paper's own closed formulas (the misprinted ones
// corrected): a way from one chart to the other that shares nothing with the hub.

polhode::EulerState euler_by_the_paper(const polhode::AndoyerState& a) {
  const double sl = std::sin(a.l), cl = std::cos(a.l), sg = std::sin(a.g), cg = std::cos(a.g),
               sh = std::sin(a.h), ch = std::cos(a.h);
  const double rL = std::sqrt((a.G - a.L) * (a.G + a.L)), rH = std::sqrt((a.G - a.H) * (a.G + a.H));
  // [SA (78)], corrected [SA (79)], [SA (80)] with its quadrant
  const double cos_theta = (a.L * a.H - cg * rL * rH) / (a.G * a.G);
  const double psi = std::atan2(rH * (a.G * sg * cl + a.L * sl * cg) + a.H * sl * rL,
                                -rH * (a.G * sg * sl - a.L * cl * cg) + a.H * cl * rL);
  const double phi = std::atan2(rL * (a.G * sg * ch + a.H * sh * cg) + a.L * sh * rH,
                                -(rL * (a.G * sg * sh - a.H * ch * cg) - a.L * ch * rH));
  // [SA (76)], corrected equation for Theta after [SA (80)], [SA (75)]
  return {phi, std::acos(cos_theta), psi, a.H, rL * std::sin(a.l - psi), a.L};
}

TEST(ChartIdentities, EulerFromAndoyerByThePaper) {
  Sampler sample(20250120);
  for (int k = 0; k < 2000; ++k) {
    const RotorState s = inclined_state(
        {sample.uniform(0.2, 1.5), sample.coin(), sample.uniform(0.2, 1.5), sample.coin()},
        sample.angle(), sample.angle(), sample.angle());
    const polhode::EulerState e = euler_by_the_paper(to_andoyer(s)), f = to_euler(s);
    const double sine = std::sin(f.theta);
    EXPECT_LE(numbers_difference({e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi},
                                 {f.phi, f.theta, f.psi, f.Phi, f.Theta, f.Psi}, 3),
              budget::andoyer_generic / sine);
  }
}

}  // namespace
