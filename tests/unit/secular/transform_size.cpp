// SPDX-License-Identifier: MIT
// How many terms and bytes a Lie transform takes, before it is made: against the transforms
// themselves.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "polhode/series/series_text.hpp"
#include "worst.hpp"

namespace secular_test {
namespace {

using namespace polhode;
using polhode::test::message_of;
using testing::AllOf;
using testing::HasSubstr;

series::Truncation up_to(int order) { return {{{"k", 1}}, order}; }

struct Example {
  std::string name;
  secular::Elimination<series::Rational> problem;
};

secular::Elimination<series::Rational> problem(const series::Symbols& symbols, const char* h,
                                               int order, std::vector<std::string> angles) {
  return {series::series_from_text<series::Rational>(symbols, h), up_to(order), std::move(angles)};
}

std::vector<Example> examples() {
  const series::Symbols pendulum({"G", "k"}, {"g"}, {{"g", "G"}});
  const series::Symbols rotor({"L", "G", "p", "d", "k"}, {"l", "g"}, {{"l", "L"}, {"g", "G"}});
  const series::Symbols two({"L", "G", "k"}, {"l", "g", "t"}, {{"l", "L"}, {"g", "G"}});
  const series::Symbols mixed({"L", "x", "y", "k"}, {"l"}, {{"l", "L"}, {"x", "y"}});
  std::vector<Example> all = {
      {"pendulum", problem(pendulum, "G^2/2 + k*cos(g)", 12, {"g"})},
      {"rotor", problem(rotor, "p*G^2/2 - d*L^2/2 + k*(G^2 - L^2)*cos(2*l)/2", 8, {"l"})},
      {"two angles",
       problem(two,
               "3*L + 7/5*G + k*L*cos(l - g) + k*G*sin(2*g) + k^2*L*G*cos(l) + k*G^2*cos(l + g)"
               " + k*L^2/4",
               5, {"l", "g"})},
      {"one of two", problem(two, "2*L + k*G^2*cos(g) + k*L*G*cos(l) + k*sin(l - g)", 5, {"l"})},
      {"all powers",
       problem(two, "2*L + 7/5*G + k*(L^2 + L*G + G^2)*(cos(l) + cos(g) + cos(l - g))", 4,
               {"l", "g"})},
      {"a slow angle",
       problem(two, "L^2/2 + k*G^2*L + k*G*cos(l) + k*L*cos(2*l) + k*L*cos(g) + k^2*G*sin(l - g)",
               5, {"l"})},
      {"coordinates", problem(mixed, "L + k*(x^2 + y^2)*cos(l) + k*x*y + k*L*x*sin(l)", 5, {"l"})},
      {"clock", problem(two, "3*L + 7/5*G + k*L^2 + k*L*G*cos(l - t) + k*G*sin(g + 2*t)", 5,
                        {"l", "g", "t"})}};
  all.back().problem.clocks = {{"t", series::constant(two, series::Rational(1, 3))}};
  return all;
}

double size_of(const series::Series<series::Rational>& a, int n) {
  return static_cast<double>(series::part_of_order(a, up_to(n), n).size());
}
// The bounds hold order by order, and all together are not far off.
void expect_bounds(const std::vector<double>& bounds, const std::vector<double>& terms,
                   const std::string& where) {
  ASSERT_EQ(bounds.size(), terms.size()) << where;
  double all = 0.0, most = 0.0;
  for (std::size_t n = 0; n < terms.size(); ++n) {
    EXPECT_GE(bounds[n], terms[n]) << where << ", order " << n;
    all += terms[n];
    most += bounds[n];
  }
  EXPECT_LE(most, budget::transform_size_factor * all) << where;
}

// The mean Hamiltonian and the generator share no term.
TEST(TransformSize, BoundsTheTermsAndIsNotFarOff) {
  for (const auto& [name, problem] : examples()) {
    const secular::TransformSize size = secular::transform_size(problem);
    EXPECT_EQ(size.counted, problem.keep.order) << name;
    EXPECT_TRUE(std::is_sorted(size.bytes.begin(), size.bytes.end())) << name;
    for (const secular::LieMethod method : {secular::LieMethod::deprit, secular::LieMethod::hori}) {
      const secular::LieTransform<series::Rational> transform(problem, method);
      std::vector<double> terms;
      for (int n = 0; n <= problem.keep.order; ++n)
        terms.push_back(size_of(transform.mean_hamiltonian(), n) +
                        size_of(transform.generator(), n));
      expect_bounds(size.terms, terms, name);
    }
  }
}

TEST(TransformSize, BoundsTheMaps) {
  for (const auto& [name, problem] : examples()) {
    const series::Symbols& symbols = problem.hamiltonian.symbols();
    const auto h = secular::detail::checked_parts(problem);
    const secular::detail::LieKeys keys = secular::detail::lie_keys(problem, h);
    const secular::LieTransform<series::Rational> transform(problem);
    const auto expect = [&](const secular::detail::KeyCount& count,
                            const series::Series<series::Rational>& map, const std::string& what) {
      std::vector<double> terms;
      for (int n = 0; n <= problem.keep.order; ++n) terms.push_back(size_of(map, n));
      expect_bounds(count.terms, terms, name + ": " + what);
    };
    for (const auto& [q, p] : symbols.pairs())
      for (const std::string& symbol : {q, p})
        if (const auto map = transform.short_period(symbol); !map.is_zero())
          expect(keys.count_of(symbol), map, symbol);
    const auto [q, p] = symbols.pairs()[0];
    const series::Series<series::Rational> f =
        series::cosine(symbols, series::Rational(1), {{p, 2}}, {{q, 3}}) +
        series::sine(symbols, series::Rational(1), {}, {{q, 1}});
    expect(keys.count_of(secular::detail::keys_of(secular::detail::parts(f, problem.keep))),
           transform.in_mean(f), "f");
  }
}

// Beyond what is counted: against what a longer count finds.
TEST(TransformSize, ExtrapolatesWithAPowerOfTheOrder) {
  int extrapolated = 0;
  for (auto [name, problem] : examples()) {
    problem.keep.order = 14;
    const auto keys = secular::detail::lie_keys(problem, secular::detail::checked_parts(problem));
    const secular::detail::KeyCount all = keys.count(), few = keys.count(2e3);
    EXPECT_EQ(all.counted, 14) << name;
    extrapolated += few.counted < 14 ? 1 : 0;
    for (std::size_t n = 0; n < all.terms.size(); ++n) {
      const double factor =
          static_cast<int>(n) <= few.counted ? 1.0 : budget::transform_size_extrapolated;
      EXPECT_LE(few.terms[n], factor * all.terms[n]) << name << n;
      EXPECT_GE(few.terms[n] * factor, all.terms[n]) << name << n;
    }
  }
  EXPECT_GE(extrapolated, 5);
}

TEST(TransformSize, RefusesBeforeItStarts) {
  auto [name, problem] = examples()[0];
  const auto refused = [&](double bytes) {
    problem.keep.most_bytes = static_cast<std::size_t>(bytes);
    return message_of([&] { secular::LieTransform<series::Rational>{problem}; });
  };
  const secular::TransformSize size = secular::transform_size(problem);
  EXPECT_EQ(refused(size.bytes[12] + 1.0), "");
  EXPECT_THAT(refused(size.bytes[12] - 1.0),
              AllOf(HasSubstr("LieTransform: order 12 may have 7 terms in a series and take 3."),
                    HasSubstr("e-05 GB allowed; order 11 takes"),
                    HasSubstr("lower the order, or raise Truncation::most_bytes")));
  EXPECT_THAT(refused(1.0), HasSubstr("more than the 1e-09 GB allowed; lower the order"));
  // Far beyond any memory: at once.
  const series::Symbols many({"A", "B", "C", "k"}, {"a", "b", "c"},
                             {{"a", "A"}, {"b", "B"}, {"c", "C"}});
  EXPECT_THAT(
      message_of([&] {
        secular::LieTransform<double>(
            {series::series_from_text<double>(
                 many,
                 "A + 1.1*B + 1.3*C + k*(A + B + C)^2*(1 + cos(a) + cos(b) + "
                 "cos(c) + cos(a - b) + cos(b - c))"),
             up_to(30),
             {"a", "b", "c"}});
      }),
      AllOf(HasSubstr("LieTransform: order 30 may have"), HasSubstr("order 18 takes 3.21 GB")));
  // A function that is larger than the Hamiltonian.
  problem.keep.most_bytes = static_cast<std::size_t>(2.0 * size.bytes[12]);
  const secular::LieTransform<series::Rational> transform(problem);
  const auto f = series::power(series::series_from_text<series::Rational>(
                                   problem.hamiltonian.symbols(), "G + G^2*cos(g) + G^3*sin(2*g)"),
                               6);
  EXPECT_REJECTED(transform.in_mean(f), "LieTransform: a map to order 12 may have");
  EXPECT_EQ(message_of([&] { transform.short_period("g"); }), "");
}

}  // namespace
}  // namespace secular_test
