// SPDX-License-Identifier: MIT
// Maps of Lie transforms: the canonical map between the mean variables of Hori and of Deprit, exact
// in rationals; and maps there and back in doubles, whose error falls with the order.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "polhode/series/compiled_series.hpp"
#include "polhode/series/series_text.hpp"
#include "worst.hpp"

namespace secular_test {
namespace {

using namespace polhode;
using polhode::test::Worst;

using Exact = series::Series<series::Rational>;
series::Symbols two() {
  return series::Symbols({"L", "G", "k"}, {"l", "g"}, {{"l", "L"}, {"g", "G"}});
}
Exact read(const char* text) { return series::series_from_text<series::Rational>(two(), text); }
series::Truncation up_to(int order) { return {{{"k", 1}}, order}; }

// exp(L_chi) f, L_chi f = {f, chi}; chi has no part of order 0, so that it ends.
Exact lie_series(const Exact& f, const Exact& chi, const series::Truncation& keep) {
  Exact sum = f, power = f;
  for (int m = 1; m <= keep.order; ++m) {
    power = series::bracket(power, chi, keep) / series::Rational(m);
    sum += power;
  }
  return sum;
}

// l is eliminated and g stays. Mean variables of Hori, as functions of those of Deprit.
class HoriAndDeprit {
 public:
  HoriAndDeprit()
      : problem_{read("3*L + k*G^2/2 + k*G*cos(g) + k*G*cos(l) + k*L*cos(l - g)"
                      " + k*L*G*cos(2*l + g)"),
                 keep,
                 {"l"}},
        hori_(problem_, secular::LieMethod::hori),
        deprit_(problem_, secular::LieMethod::deprit) {}

  Exact composed(const Exact& f) const { return deprit_.in_mean(hori_.in_osculating(f)); }
  const Exact& of_hori() const { return hori_.mean_hamiltonian(); }
  const Exact& of_deprit() const { return deprit_.mean_hamiltonian(); }

  // The generator of the composed map, order by order, from what it does to G: -d chi/dg is the
  // part of composed(G) that the generator so far does not explain.
  Exact generator() const {
    const Exact G = read("G"), moved = composed(G);
    Exact chi(two());
    for (int n = 1; n <= keep.order; ++n) {
      const Exact left = series::part_of_order(moved - lie_series(G, chi, up_to(n)), keep, n);
      chi -= series::integral(left, {{"g", series::constant(two(), series::Rational(1))}}, 0.0);
    }
    return chi;
  }

  static inline const series::Truncation keep = up_to(5);

 private:
  secular::Elimination<series::Rational> problem_;
  secular::LieTransform<series::Rational> hori_, deprit_;
};

TEST(LieMaps, HoriAndDepritDifferByACanonicalMapOfTheMeanVariables) {
  const HoriAndDeprit of;
  // The mean Hamiltonians are one up to order 3, and two from there on.
  EXPECT_EQ(series::truncated(of.of_hori(), up_to(3)), series::truncated(of.of_deprit(), up_to(3)));
  EXPECT_FALSE(series::part_of_order(of.of_hori() - of.of_deprit(), of.keep, 4).is_zero());

  const Exact chi = of.generator();
  EXPECT_TRUE(series::truncated(chi, up_to(2)).is_zero());
  EXPECT_FALSE(series::part_of_order(chi, of.keep, 3).is_zero());
  EXPECT_TRUE(series::derivative(chi, "l").is_zero());
  // One generator for all: it carries one mean Hamiltonian into the other, and every function as
  // the two maps one after the other do.
  EXPECT_EQ(lie_series(of.of_hori(), chi, of.keep), of.of_deprit());
  for (const char* const f : {"G", "L", "cos(g)", "sin(l)", "L*G*cos(2*l - g)"}) {
    EXPECT_EQ(lie_series(read(f), chi, of.keep), of.composed(read(f))) << f;
  }
  EXPECT_EQ(of.composed(read("L")), read("L"));
  EXPECT_NE(of.composed(read("G")), read("G"));
}

constexpr std::array<const char*, 4> phase_space = {"l", "g", "L", "G"};

// Displacements of l, g, L, G.
class Displacement {
 public:
  Displacement(const secular::LieTransform<double>& transform, bool back) {
    for (const char* const name : phase_space)
      of_.emplace_back(back ? transform.short_period_back(name) : transform.short_period(name));
  }
  // Of l, g, L, G, at k.
  std::array<double, 4> moved(const std::array<double, 4>& from, double k) const {
    const auto [l, g, L, G] = from;
    const std::array<double, 5> point = {L, G, k, l, g};
    std::array<double, 4> to = from;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += of_[i].at(point);
    return to;
  }

 private:
  std::vector<series::CompiledSeries> of_;
};

// The largest change of a point by a map and its inverse.
double error(const Displacement& there, const Displacement& back, double k) {
  Worst worst;
  for (const double l : {0.3, 1.7, 4.0}) {
    const std::array<double, 4> from = {l, 0.8 - 2.0 * l, 1.1, 0.7};
    const auto again = back.moved(there.moved(from, k), k);
    for (std::size_t i = 0; i < from.size(); ++i) worst.add(std::abs(again[i] - from[i]));
  }
  return worst.value();
}

TEST(LieMaps, ThereAndBackIsTheIdentityToTheOrder) {
  const series::Series<double> h = series::to_doubles(
      read("L^2/2 + k*G^2/2 + k*G*cos(g) + k*G*cos(l) + k*L*cos(l - g) + k*L*G*cos(2*l + g)"));
  for (const secular::LieMethod method : {secular::LieMethod::deprit, secular::LieMethod::hori})
    for (int order = 1; order <= 5; ++order) {
      const secular::LieTransform<double> transform({h, up_to(order), {"l"}}, method);
      const Displacement to_mean(transform, true), to_osculating(transform, false);
      const auto slope = [&](const Displacement& there, const Displacement& back) {
        return std::log2(error(there, back, 0.02) / error(there, back, 0.01));
      };
      EXPECT_NEAR(slope(to_mean, to_osculating), order + 1.0, budget::lie_map_slope) << order;
      EXPECT_NEAR(slope(to_osculating, to_mean), order + 1.0, budget::lie_map_slope) << order;
    }
}

}  // namespace
}  // namespace secular_test
