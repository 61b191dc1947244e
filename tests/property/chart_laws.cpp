// SPDX-License-Identifier: MIT
// Laws of the canonical charts, for every ordered pair of them: round trips through the hub, and
// canonicity, at generic points and next to every singularity. G = 1, angles modulo 2 pi.
#include <gtest/gtest.h>

#include <cmath>

#include "budgets.hpp"
#include "property/chart_support.hpp"

namespace {

using namespace chart_test;
namespace budget = polhode::budget;

// Where to look: which inclinations are within 1 to 3 times `distance` of 0 or pi.
struct Region {
  const char* name;
  bool near_J;
  bool near_I;
  bool near_theta;
  double distance;
};

RotorState state_in(const Region& r, Sampler& sample) {
  if (r.near_theta) return sample.near_euler_poles(r.distance);
  const auto tilt = [&](bool near) {
    return near ? sample.log_uniform(r.distance, 3.0 * r.distance) : sample.uniform(0.2, 1.5);
  };
  const double J = tilt(r.near_J), I = tilt(r.near_I);
  return inclined_state({J, sample.coin(), I, sample.coin()}, sample.angle(), sample.angle(),
                        sample.angle());
}

std::vector<Region> regions(double closest) {
  std::vector<Region> all{{"generic", false, false, false, 1.0}};
  for (double d = 1e-2; d > 0.5 * closest; d *= 1e-2) {
    all.push_back({"J", true, false, false, d});
    all.push_back({"I", false, true, false, d});
    all.push_back({"J and I", true, true, false, d});
    all.push_back({"theta", false, false, true, d});
  }
  return all;
}

bool is_regular(const Chart& c, const RotorState& s) {
  if (c.id.set != CanonicalSet::poincare) return true;
  const auto p = nearest_poincare(s);
  return p.pole_J == c.id.pole_J && p.pole_I == c.id.pole_I;
}

// 1 - cos J of a chart with L and G is a multiple of eps: 1e-12 is J = 1.4e-6.
double closest_distance(const Chart& c) {
  return c.id.set == CanonicalSet::andoyer ? 1.4e-6 : 1e-12;
}

Numbers hub_sizes(const RotorState& s) {
  return {1.0, 1.0, 1.0, std::abs(s.g.x), std::abs(s.g.y), std::abs(s.g.z)};
}

// a -> hub -> b -> hub -> a: each passage adds the rounding of the hub and of b, as the inverse
// Jacobians carry it to a.
TEST(ChartLaws, RoundTrips) {
  Sampler sample(20250103);
  for (const Chart& a : canonical_charts()) {
    for (const Region& region : regions(closest_distance(a))) {
      for (int k = 0; k < 200; ++k) {
        const Numbers S = a.from_hub(state_in(region, sample));
        const RotorState s = a.to_hub(S);
        if (!is_regular(a, s)) continue;
        const double through_hub = amplified(inverse_chart_jacobian(s, a.id), hub_sizes(s));
        for (const Chart& b : canonical_charts()) {
          if (!is_regular(b, s)) continue;
          const Numbers S_b = b.from_hub(s);
          const double through_b = amplified(canonical_transformation(s, b.id, a.id), S_b);
          const double error = numbers_difference(a.from_hub(b.to_hub(S_b)), S, a.angles);
          EXPECT_LE(error, budget::round_trip_floor +
                               budget::round_trip_eps * eps * (through_hub + through_b))
              << a.name << " -> " << b.name << ", " << region.name << " " << region.distance;
        }
      }
    }
  }
}

// B Jc B^T = Pi and M Jc M^T = Jc, entry by entry, in units of eps (|M| |J| |M^T|).
TEST(ChartLaws, Canonicity) {
  Sampler sample(20250104);
  for (const Region& region : regions(1e-12)) {
    for (int k = 0; k < 200; ++k) {
      const RotorState s = state_in(region, sample);
      for (const Chart& a : canonical_charts()) {
        if (!is_regular(a, s)) continue;
        EXPECT_LE(symplectic_defect(chart_jacobian(s, a.id), canonical_tensor(), hub_tensor(s.g)),
                  budget::symplectic_eps)
            << a.name << ", " << region.name << " " << region.distance;
        for (const Chart& b : canonical_charts()) {
          if (!is_regular(b, s)) continue;
          const Matrix6 m = canonical_transformation(s, a.id, b.id);
          EXPECT_LE(symplectic_defect(m, canonical_tensor(), canonical_tensor()),
                    budget::symplectic_eps)
              << a.name << " -> " << b.name << ", " << region.name << " " << region.distance;
        }
      }
    }
  }
}

// The same with B at the numbers of the chart itself, and the momentum that they hold exactly.
TEST(ChartLaws, CanonicityAtTheChartsOwnNumbers) {
  Sampler sample(20250105);
  for (const Chart& a : canonical_charts()) {
    for (const Region& region : regions(closest_distance(a))) {
      for (int k = 0; k < 200; ++k) {
        const Numbers S = a.from_hub(state_in(region, sample));
        const RotorState s = a.to_hub(S);
        if (!is_regular(a, s)) continue;
        EXPECT_LE(
            symplectic_defect(a.own_jacobian(S), canonical_tensor(), hub_tensor(a.own_momentum(S))),
            budget::own_symplectic_eps)
            << a.name << ", " << region.name << " " << region.distance;
      }
    }
  }
}

TEST(ChartLaws, InverseOfTheJacobian) {
  Sampler sample(20250106);
  for (int k = 0; k < 200; ++k) {
    const RotorState s = sample.generic();
    for (const Chart& a : canonical_charts()) {
      const Matrix6 B = chart_jacobian(s, a.id), inverse = inverse_chart_jacobian(s, a.id);
      const Matrix6 product = inverse * B, scale = magnitudes(inverse) * magnitudes(B);
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
          EXPECT_NEAR(product(i, j), i == j ? 1.0 : 0.0,
                      budget::symplectic_eps * eps * scale(i, j) + budget::jacobian_zero);
        }
      }
    }
  }
}

// The functions that take any B agree with those that know the chart.
TEST(ChartLaws, TransformationOfGivenJacobians) {
  Sampler sample(20250108);
  const Chart a = euler_chart(), b = andoyer_chart();
  for (int k = 0; k < 200; ++k) {
    const RotorState s = sample.generic();
    const Matrix6 B_a = chart_jacobian(s, a.id), B_b = chart_jacobian(s, b.id);
    const Matrix6 inverse = inverse_chart_jacobian(s.g, B_b);
    const Matrix6 exact_inverse = inverse_chart_jacobian(s, b.id);
    const Matrix6 m = canonical_transformation(s.g, B_a, B_b);
    const Matrix6 exact = canonical_transformation(s, a.id, b.id);
    const Numbers ones{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    const double size_b = amplified(B_b, ones), size = size_b * amplified(B_a, ones);
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        EXPECT_NEAR(inverse(i, j), exact_inverse(i, j), budget::given_jacobian_eps * eps * size_b);
        EXPECT_NEAR(m(i, j), exact(i, j), budget::given_jacobian_eps * eps * size);
      }
    }
  }
}

// Poincare-type sets within 90 degrees of their poles, where their momenta can be anything up to
// the poles themselves.
TEST(ChartLaws, PoincareRoundTripsWithoutAmplification) {
  Sampler sample(20250107);
  for (const double d : {1.5, 1e-2, 1e-6, 1e-12, 1e-150}) {
    for (int k = 0; k < 1000; ++k) {
      const double J = d * sample.uniform(0.1, 1.0), I = d * sample.uniform(0.1, 1.0);
      const RotorState s = inclined_state({J, sample.coin(), I, sample.coin()}, sample.angle(),
                                          sample.angle(), sample.angle());
      const auto p = nearest_poincare(s);
      const Chart chart = poincare_chart(p.pole_J, p.pole_I);
      const Numbers S = chart.from_hub(s);
      EXPECT_LE(numbers_difference(chart.from_hub(chart.to_hub(S)), S, 1), budget::poincare);
    }
  }
}

}  // namespace
