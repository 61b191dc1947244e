// SPDX-License-Identifier: MIT
// Lie transforms, exact in rationals: the pendulum's published series, Hori beside Deprit, maps
// that undo each other and keep brackets, resonances, clocks, and what is refused.
#include "polhode/secular/lie_transform.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "message_of.hpp"
#include "polhode/series/product.hpp"
#include "polhode/series/series_text.hpp"
#include "polhode/series/taylor_coefficient.hpp"

namespace secular_test {
namespace {

using namespace polhode;
using polhode::test::message_of;
using testing::HasSubstr;

using Exact = series::Series<series::Rational>;
constexpr secular::LieMethod methods[] = {secular::LieMethod::deprit, secular::LieMethod::hori};

series::Symbols pendulum() { return series::Symbols({"G", "k"}, {"g"}, {{"g", "G"}}); }
// Two degrees of freedom, and an angle that is a clock in one description.
series::Symbols two() {
  return series::Symbols({"L", "G", "T", "k"}, {"l", "g", "t"},
                         {{"l", "L"}, {"g", "G"}, {"t", "T"}});
}
Exact read(const series::Symbols& symbols, const char* text) {
  return series::series_from_text<series::Rational>(symbols, text);
}
series::Truncation up_to(int order) { return {{{"k", 1}}, order}; }

// H = G^2/2 + k cos g is Mathieu's equation in the limit of large r: a_r = r^2 + q^2 / (2 r^2)
// + 5 q^4 / (32 r^6) + 9 q^6 / (64 r^10), Abramowitz and Stegun 20.3.15, with k = q/4, G = r/2,
// K = a/8.
TEST(LieTransform, PendulumIsThatOfMathieusFunctions) {
  const Exact h = read(pendulum(), "G^2/2 + k*cos(g)");
  const Exact mathieu = read(pendulum(), "G^2/2 + 1/4*k^2*G^-2 + 5/64*k^4*G^-6 + 9/128*k^6*G^-10");
  for (const secular::LieMethod method : methods)
    EXPECT_EQ(
        secular::LieTransform<series::Rational>({h, up_to(7), {"g"}}, method).mean_hamiltonian(),
        mathieu);
}

secular::Elimination<series::Rational> two_angles(int order) {
  return {read(two(),
               "3*L + 7/5*G + k*L*cos(l - g) + k*G*sin(2*g) + k^2*L*G*cos(l) + k*G^2*cos(l + g)"
               " + k*L^2/4"),
          up_to(order),
          {"l", "g"}};
}
// Parts of several orders, with and without angles.
Exact some_function() { return read(two(), "L*cos(g) + G^2 + k*sin(l - 2*g) + k^2*L^-1"); }
Exact other_function() { return read(two(), "G*sin(l) + L*G + k*L*cos(2*l)"); }

TEST(LieTransform, HoriAndDepritHaveOneMeanHamiltonian) {
  const auto problem = two_angles(4);
  const secular::LieTransform<series::Rational> hori(problem, secular::LieMethod::hori),
      deprit(problem, secular::LieMethod::deprit);
  EXPECT_EQ(hori.mean_hamiltonian(), deprit.mean_hamiltonian());
  EXPECT_GE(hori.mean_hamiltonian().size(), 10U);
  for (const char* const angle : {"l", "g"})
    EXPECT_TRUE(series::derivative(hori.mean_hamiltonian(), angle).is_zero());
  // Generators are one at the first order.
  EXPECT_EQ(series::part_of_order(hori.generator(), up_to(4), 1),
            series::part_of_order(deprit.generator(), up_to(4), 1));
}

TEST(LieTransform, MapsUndoEachOtherAndCarryTheHamiltonian) {
  for (const secular::LieMethod method : methods) {
    const auto problem = two_angles(4);
    const secular::LieTransform<series::Rational> transform(problem, method);
    const Exact f = some_function();
    ASSERT_GE(transform.in_mean(f).size(), 50U);
    EXPECT_EQ(transform.in_osculating(transform.in_mean(f)), f);
    EXPECT_EQ(transform.in_mean(transform.in_osculating(f)), f);
    EXPECT_EQ(transform.in_mean(problem.hamiltonian), transform.mean_hamiltonian());
    EXPECT_EQ(transform.in_osculating(transform.mean_hamiltonian()), problem.hamiltonian);
  }
}

TEST(LieTransform, MapsAreCanonicalAndKeepProducts) {
  const series::Truncation keep = up_to(3);
  for (const secular::LieMethod method : methods) {
    const secular::LieTransform<series::Rational> transform(two_angles(3), method);
    const Exact f = some_function(), g = other_function();
    const Exact mean_f = transform.in_mean(f), mean_g = transform.in_mean(g);
    EXPECT_EQ(series::bracket(mean_f, mean_g, keep),
              transform.in_mean(series::bracket(f, g, keep)));
    EXPECT_EQ(series::product(mean_f, mean_g, keep),
              transform.in_mean(series::product(f, g, keep)));
  }
}

// cos(l + d) and L + D put together from the displacements of l and L.
TEST(LieTransform, ShortPeriodsAreTheMapOfTheSymbols) {
  const series::Truncation keep = up_to(3);
  const Exact wave = read(two(), "cos(l)"), momentum = read(two(), "L");
  for (const secular::LieMethod method : methods) {
    const secular::LieTransform<series::Rational> transform(two_angles(3), method);
    EXPECT_EQ(series::displaced(wave, "l", transform.short_period("l"), keep),
              transform.in_mean(wave));
    EXPECT_EQ(series::displaced(wave, "l", transform.short_period_back("l"), keep),
              transform.in_osculating(wave));
    EXPECT_EQ(momentum + transform.short_period("L"), transform.in_mean(momentum));
    EXPECT_EQ(momentum + transform.short_period_back("L"), transform.in_osculating(momentum));
    EXPECT_TRUE(transform.short_period("k").is_zero());
  }
}

TEST(LieTransform, KeepsWhatIsNotToBeEliminated) {
  const series::Symbols symbols = two();
  const Exact h =
      read(symbols, "2*L + G + k*cos(l - 2*g) + k*cos(2*l - 4*g) + k*G*cos(l) + k*sin(g)");
  for (const secular::LieMethod method : methods) {
    const secular::LieTransform<series::Rational> resonant(
        {h, up_to(2), {"l", "g"}, {{{"l", -1}, {"g", 2}}}}, method);
    EXPECT_EQ(series::part_of_order(resonant.mean_hamiltonian(), up_to(2), 1),
              read(symbols, "k*cos(l - 2*g) + k*cos(2*l - 4*g)"));
    // The angle l - 2 g alone: momenta 2 L + G stay.
    EXPECT_TRUE(series::bracket(resonant.mean_hamiltonian(), read(symbols, "2*L + G")).is_zero());
    const Exact plain = read(symbols, "2*L + G + k*G*cos(l) + k*sin(g)");
    const secular::LieTransform<series::Rational> fast({plain, up_to(2), {"l"}}, method);
    EXPECT_TRUE(series::derivative(fast.mean_hamiltonian(), "l").is_zero());
    EXPECT_EQ(series::part_of_order(fast.mean_hamiltonian(), up_to(2), 1),
              read(symbols, "k*sin(g)"));
    // 2 l - 4 g is no multiple of 3 (l - 2 g).
    EXPECT_REJECTED(secular::LieTransform<series::Rational>(
                        {h, up_to(1), {"l", "g"}, {{{"l", 3}, {"g", -6}}}}, method),
                    "l - 2*g, whose rate is 0: a resonance");
  }
}

// Time as an angle with a rate, and time as an angle whose momentum is T.
TEST(LieTransform, AClockIsAnAngleWithAMomentumThatIsLeftOut) {
  const series::Symbols symbols = two();
  const Exact forced = read(symbols, "3*L + 7/5*G + k*L^2 + k*L*cos(l - t) + k*G*sin(g + 2*t)");
  const Exact momentum = read(symbols, "1/3*T");
  const Exact f = some_function();
  for (const secular::LieMethod method : methods) {
    secular::Elimination<series::Rational> problem{forced, up_to(3), {"l", "g", "t"}};
    problem.clocks = {{"t", series::constant(symbols, series::Rational(1, 3))}};
    const secular::LieTransform<series::Rational> with_clock(problem, method);
    const secular::LieTransform<series::Rational> extended(
        {forced + momentum, up_to(3), {"l", "g", "t"}}, method);
    EXPECT_EQ(with_clock.mean_hamiltonian() + momentum, extended.mean_hamiltonian());
    EXPECT_EQ(with_clock.generator(), extended.generator());
    EXPECT_EQ(with_clock.in_mean(f), extended.in_mean(f));
  }
}

// Momenta of the rotor about L = 3, G = 1/2; its divisors are sums of functions of both.
using Taylor = polhode::series::TaylorCoefficient<series::Rational, 2, 6>;
using Local = series::Series<Taylor>;
Taylor number(series::Rational c) { return Taylor(std::move(c)); }
Taylor momentum_L() { return Taylor::variable(0, series::Rational(3)); }
Taylor momentum_G() { return Taylor::variable(1, series::Rational(1, 2)); }

// K of order n in k, up to a degree in the displacements.
Exact of_order(const Local& k, int n, int degree) {
  return series::expanded(series::part_of_order(k, up_to(n), n), degree);
}

// H = L^2/2 + a G^2 + k cos(l - g) is a pendulum in p = w / m, w = L - 2 a G, m = 1 + 2 a:
// K = L^2/2 + a G^2 + k^2 m / (4 w^2) + 5/64 k^4 m^3 / w^6.
TEST(LieTransform, DivisorsOfTwoMomentaAreThoseOfAPendulum) {
  const series::Symbols symbols = two();
  const Taylor l = momentum_L(), g = momentum_G(), a = number(series::Rational(3, 5)),
               m = number(series::Rational(11, 5)), w = l - number(series::Rational(2)) * a * g,
               w2 = w * w;
  const Local h = series::constant(symbols, l * l / Taylor(2) + a * g * g) +
                  series::cosine(symbols, Taylor(1), {{"k", 1}}, {{"l", 1}, {"g", -1}});
  const Local second = series::monomial(symbols, m / (Taylor(4) * w2), {{"k", 2}});
  const Local fourth = series::monomial(
      symbols, number(series::Rational(5, 64)) * m * m * m / (w2 * w2 * w2), {{"k", 4}});
  for (const secular::LieMethod method : methods) {
    const secular::LieTransform<Taylor> transform({h, up_to(4), {"l", "g"}}, method);
    const Local k = transform.mean_hamiltonian();
    EXPECT_EQ(of_order(k, 0, 6), series::expanded(series::part_of_order(h, up_to(4), 0)));
    EXPECT_TRUE(of_order(k, 1, 6).is_zero());
    EXPECT_EQ(of_order(k, 2, 5), series::expanded(second, 5));
    EXPECT_TRUE(of_order(k, 3, 4).is_zero());
    EXPECT_EQ(of_order(k, 4, 3), series::expanded(fourth, 3));
    for (const auto& term : k.terms())
      EXPECT_EQ(term.c.known(),
                std::min<int>(6, 7 - series::exponent(symbols, term.key, symbols.variable("k"))));
  }
}

TEST(LieTransform, DivisorsOfTwoMomentaInHoriAndDeprit) {
  const series::Symbols symbols = two();
  const Taylor l = momentum_L(), g = momentum_G(), square = l * l;
  const auto wave = [&](const Taylor& c, int of_l, int of_g) {
    return series::cosine(symbols, c, {{"k", 1}}, {{"l", of_l}, {"g", of_g}});
  };
  const Local h = series::constant(symbols, square / Taylor(2) + g * g * g) + wave(g, 1, 1) +
                  wave(l, 1, -1) + wave(Taylor(1) / l, 2, 1) + wave(square, 2, 0);
  const secular::LieTransform<Taylor> hori({h, up_to(3), {"l", "g"}}, secular::LieMethod::hori),
      deprit({h, up_to(3), {"l", "g"}}, secular::LieMethod::deprit);
  const Local f = series::constant(symbols, l * g) + series::cosine(symbols, g, {}, {{"l", 1}});
  for (int n = 1; n <= 3; ++n) {
    const Exact k = of_order(hori.mean_hamiltonian(), n, 7 - n);
    EXPECT_EQ(k, of_order(deprit.mean_hamiltonian(), n, 7 - n));
    EXPECT_EQ(k.is_zero(), n == 1);
    for (const auto* const transform : {&hori, &deprit}) {
      const Local there = transform->in_mean(f);
      EXPECT_FALSE(of_order(there, n, 6 - n).is_zero());
      EXPECT_TRUE(of_order(transform->in_osculating(there), n, 6 - n).is_zero());
    }
  }
}

TEST(LieTransform, Refuses) {
  const series::Symbols symbols = two();
  const auto refused = [&](const char* h, series::Truncation keep, double least = 0.0) {
    return message_of([&] {
      secular::LieTransform<series::Rational>({read(symbols, h), keep, {"l", "g"}, {}, {}, least});
    });
  };
  EXPECT_EQ(refused("L + 2*G + k*cos(l)", up_to(2)), "");
  EXPECT_THAT(refused("L", {}), HasSubstr("no small parameters"));
  EXPECT_THAT(refused("L", {{{"G", 1}}, 2}), HasSubstr("small parameter G has a conjugate"));
  EXPECT_THAT(refused("L", up_to(31)), HasSubstr("the order 31 is out of [0, 30]"));
  EXPECT_THAT(refused("L + cos(l)", up_to(2)), HasSubstr("order 0 depends on the angle l"));
  EXPECT_THAT(refused("L + k^-1*cos(l)", up_to(2)), HasSubstr("an order below 0"));
  EXPECT_THAT(refused("L + 1001/1000*G + k*cos(l - g)", up_to(1), 0.01),
              HasSubstr("turns with l - g, whose rate has the coefficient -0.001, below"));
  EXPECT_REJECTED(
      secular::LieTransform<series::Rational>({read(symbols, "L"), up_to(1), {"l"}, {{{"g", 1}}}}),
      "the resonance has the angle g");
  const series::Symbols plane({"q", "p", "L", "k"}, {"l"}, {{"q", "p"}, {"l", "L"}});
  const auto in_plane = [&](const char* h) {
    return message_of([&] {
      secular::LieTransform<series::Rational>(
          {series::series_from_text<series::Rational>(plane, h), up_to(1), {}});
    });
  };
  EXPECT_THAT(in_plane("p^2 + q^2"), HasSubstr("depends on the coordinate q"));
  EXPECT_THAT(in_plane("L + p^2 + k*q*cos(l)"),
              HasSubstr("depends on the momentum p of q, which is a variable"));
  EXPECT_EQ(in_plane("L + k*p^2 + k*q*cos(l)"), "");
}

TEST(LieTransform, RefusesClocksThatAreNone) {
  const series::Symbols symbols({"L", "k", "n"}, {"l", "t"}, {{"l", "L"}});
  const auto refused = [&](const char* angle, const char* rate) {
    secular::Elimination<series::Rational> problem{
        read(symbols, "L + k*cos(l - 2*t)"), up_to(1), {"l", "t"}};
    problem.clocks = {{angle, read(symbols, rate)}};
    return message_of([&] { secular::LieTransform<series::Rational>{problem}; });
  };
  EXPECT_EQ(refused("t", "n^2"),
            "integral: the term with k*cos(l - 2*t) turns with l - 2*t, whose "
            "rate is a sum of 2 terms; it must be one");
  EXPECT_EQ(refused("t", "3"), "");
  EXPECT_THAT(refused("x", "1"), HasSubstr("no angle 'x'"));
  EXPECT_THAT(refused("l", "1"), HasSubstr("the clock l has the momentum L"));
  EXPECT_THAT(refused("t", "1 + k"), HasSubstr("rate of the clock t has a small parameter"));
  EXPECT_THAT(refused("t", "L"), HasSubstr("rate of the clock t depends on L, of a pair"));
  EXPECT_THAT(refused("t", "cos(l)"), HasSubstr("rate of the clock t depends on angles"));
  secular::Elimination<series::Rational> twice{read(symbols, "L"), up_to(1), {"t"}};
  twice.clocks = {{"t", read(symbols, "1")}, {"t", read(symbols, "2")}};
  EXPECT_REJECTED(secular::LieTransform<series::Rational>{twice}, "clock t is there");
}

TEST(LieTransform, RefusesWhatDoesNotTurn) {
  const auto refused = [&](std::vector<std::string> angles, double least) {
    return message_of([&] {
      const series::Symbols names({"G", "k"}, {"g", "t"}, {{"g", "G"}});
      secular::LieTransform<series::Rational>(
          {read(names, "G + k*cos(g - t)"), up_to(1), std::move(angles), {}, {}, least});
    });
  };
  EXPECT_EQ(refused({"g"}, 0.0), "");
  EXPECT_THAT(refused({"g", "t"}, 0.0),
              HasSubstr("angle t is to be eliminated, and has neither a momentum nor a clock"));
  EXPECT_THAT(refused({"g"}, -1.0), HasSubstr("least_divisor = -1 must not be negative"));
  EXPECT_THAT(message_of([&] {
                const series::Symbols names({"k", "G"}, {"g"}, {{"g", "G"}});
                const Local h =
                    series::constant(names, momentum_G()) +
                    series::cosine(names, number(series::Rational(1)), {{"k", 1}}, {{"g", 1}});
                secular::LieTransform<Taylor>({h, up_to(1), {"g"}});
              }),
              HasSubstr("the small parameter k is a variable of the coefficients"));
}

TEST(LieTransform, NamesUnknownSymbolsAndOtherSets) {
  const series::Symbols symbols = two();
  const auto refused = [&](std::vector<std::string> angles,
                           std::vector<series::Multiples> resonances) {
    return message_of([&] {
      secular::LieTransform<series::Rational>(
          {read(symbols, "L"), up_to(1), std::move(angles), std::move(resonances)});
    });
  };
  EXPECT_THAT(refused({"x"}, {}), HasSubstr("no angle 'x'; there are variables L, G"));
  EXPECT_THAT(refused({"L"}, {}), HasSubstr("no angle 'L'"));
  EXPECT_THAT(refused({"l"}, {{{"x", 1}}}), HasSubstr("no angle 'x'"));
  const secular::LieTransform<series::Rational> transform(two_angles(1));
  EXPECT_REJECTED(transform.short_period("x"), "no variable 'x'");
  EXPECT_REJECTED(transform.in_mean(read(pendulum(), "G")), "two sets of symbols");
  secular::Elimination<series::Rational> problem{read(symbols, "L"), up_to(1), {"t"}};
  problem.clocks = {{"t", series::constant(pendulum(), series::Rational(1))}};
  EXPECT_REJECTED(secular::LieTransform<series::Rational>{problem}, "two sets of symbols");
  EXPECT_REJECTED(
      secular::LieTransform<series::Rational>({read(symbols, "L"), {{{"x", 1}}, 1}, {"l"}}),
      "no variable 'x'");
}

}  // namespace
}  // namespace secular_test
