// SPDX-License-Identifier: MIT
// The core of fits: known minima, bounds, priors, losses, covariances, and bad input.
#include "polhode/fit/least_squares.hpp"

#include <gmock/gmock.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"

namespace {

using namespace polhode;
using testing::HasSubstr;
using End = fit::LeastSquaresResult::End;
using Digits = boost::multiprecision::cpp_bin_float_100;

// y = a + b t at these times, every error 1.
const std::vector<double> times{0.0, 1.0, 2.0, 3.0, 4.0};

fit::LeastSquares line(const std::vector<double>& y) {
  fit::LeastSquares p;
  p.unknowns = {{"a", 0.1}, {"b", 0.1}};
  p.residuals.data = y.size();
  p.residuals.at = [y](std::span<const double> x, std::span<double> r, std::span<double> J) {
    for (std::size_t i = 0; i < y.size(); ++i) {
      r[i] = x[0] + x[1] * times[i] - y[i];
      if (!J.empty()) {
        J[2 * i] = 1.0;
        J[2 * i + 1] = times[i];
      }
    }
    return true;
  };
  return p;
}

TEST(Solve, FindsTheLineAndItsErrors) {
  const fit::LeastSquares p = line({1.1, 2.9, 5.2, 6.8, 9.0});
  const fit::LeastSquaresResult r = fit::solve(p);
  ASSERT_TRUE(r.is_converged()) << r.sentence;
  // by hand: b = S_ty / S_tt, a = mean(y) - 2 b
  EXPECT_NEAR(r.x[1], 1.97, budget::fit_line);
  EXPECT_NEAR(r.x[0], 1.06, budget::fit_line);
  EXPECT_NEAR(r.chi_square, 0.091, budget::fit_line);
  EXPECT_NEAR(fit::degrees_of_freedom(p, r), 3.0, budget::fit_line);
  const fit::UnknownsCovariance c = fit::covariance(p, r);
  EXPECT_NEAR(c.error(1), std::sqrt(0.1), budget::fit_line);
  EXPECT_NEAR(c.error(0), std::sqrt(0.6), budget::fit_line);
  EXPECT_NEAR(c.correlation(0, 1), -0.2 / std::sqrt(0.06), budget::fit_line);
  EXPECT_NEAR(fit::mahalanobis(c, r.x, std::vector<double>{1.06, 2.97}), 30.0,
              budget::fit_line * 1e3);
  EXPECT_TRUE(c.weak.empty());
}

// Residuals whose squares one error off are known: a straight line, a valley y = x^2 that is steep
// across, and one that grows ever less.
TEST(NotesOnErrors, SayWhereResidualsBend) {
  const auto notes = [](const fit::LeastSquares& p) {
    const fit::LeastSquaresResult r = fit::solve(p);
    EXPECT_TRUE(r.is_converged()) << r.sentence;
    return fit::notes_on_errors(p, r, fit::covariance(p, r));
  };
  EXPECT_TRUE(notes(line({1.1, 2.9, 5.2, 6.8, 9.0})).empty());

  const auto of = [](std::vector<fit::Unknown> unknowns, auto numbers) {
    fit::LeastSquares p;
    p.residuals.data = unknowns.size();
    p.unknowns = std::move(unknowns);
    p.residuals.at = numbers;
    return p;
  };
  fit::LeastSquares valley = of({{"x", 0.3}, {"y", 0.1}}, [](auto x, auto r, auto J) {
    r[0] = x[0];
    r[1] = 2.0 * (x[1] - x[0] * x[0]);
    if (J.empty()) return true;
    J[0] = 1.0;
    J[1] = 0.0;
    J[2] = -4.0 * x[0];
    J[3] = 2.0;
    return true;
  });
  EXPECT_THAT(notes(valley),
              testing::ElementsAre(
                  "residuals are not linear within the errors: one standard error away along x, "
                  "the sum of squares is 5 higher instead of 1; draw from the posterior for better "
                  "errors"));
  valley.loss.kind = fit::Loss::Kind::huber;
  EXPECT_TRUE(notes(valley).empty());
  valley.loss.kind = fit::Loss::Kind::squared;
  valley.nearness = 1.0;  // it may stop anywhere within the errors
  EXPECT_TRUE(notes(valley).empty());
  valley.nearness = 1e-3;
  valley.unknowns[0].low = -0.9;  // both ways are beyond the bounds
  valley.unknowns[0].high = 0.9;
  EXPECT_TRUE(notes(valley).empty());

  EXPECT_THAT(notes(of({{"x", 0.1}},
                       [](auto x, auto r, auto J) {
                         r[0] = std::atan(2.0 * x[0]) / 2.0;
                         if (!J.empty()) J[0] = 1.0 / (1.0 + 4.0 * x[0] * x[0]);
                         return true;
                       })),
              testing::ElementsAre(HasSubstr(
                  "one standard error away along x, the sum of squares is 0.306 higher")));
}

TEST(Solve, ScalesErrorsOfDataAlone) {
  fit::LeastSquares p = line({1.1, 2.9, 5.2, 6.8, 9.0});
  const fit::LeastSquaresResult free = fit::solve_scaled(p);
  ASSERT_TRUE(free.is_converged()) << free.sentence;
  EXPECT_NEAR(p.error_factor, std::sqrt(0.091 / 3.0), budget::fit_line);
  EXPECT_NEAR(fit::covariance(p, free).error(1), std::sqrt(0.1 * 0.091 / 3.0), budget::fit_line);
  // A prior far narrower than the data keeps its width, and takes an unknown from the data.
  p = line({1.1, 2.9, 5.2, 6.8, 9.0});
  p.priors = {{{"b"}, {1.97}, {1e-12}}};
  const fit::LeastSquaresResult held = fit::solve_scaled(p);
  EXPECT_NEAR(fit::covariance(p, held).error(1), 1e-6, 1e-6 * budget::fit_narrow_prior);
  EXPECT_NEAR(p.error_factor, std::sqrt(0.091 / 4.0), budget::fit_narrow_prior);
}

TEST(Solve, DoesNotFindErrorsFromDataThatLeaveNoFreedom) {
  fit::LeastSquares p = line({1.1, 2.9});
  const fit::LeastSquaresResult r = fit::solve_scaled(p);
  ASSERT_TRUE(r.is_converged()) << r.sentence;
  EXPECT_EQ(p.error_factor, 1.0);
  EXPECT_THAT(r.sentence, HasSubstr("errors are as given"));
}

TEST(Solve, TakesPriorsThatAreCorrelated) {
  fit::LeastSquares p = line({});
  p.residuals.prior = 0;
  p.priors = {{{"b", "a"}, {2.0, -1.0}, {0.04, 0.03, 0.03, 0.09}}};
  const fit::LeastSquaresResult r = fit::solve(p);
  ASSERT_TRUE(r.is_converged()) << r.sentence;
  EXPECT_NEAR(r.x[0], -1.0, budget::fit_line);
  EXPECT_NEAR(r.x[1], 2.0, budget::fit_line);
  const fit::UnknownsCovariance c = fit::covariance(p, r);
  EXPECT_NEAR(c.variance(0), 0.09, budget::fit_line);
  EXPECT_NEAR(c.correlation(0, 1), 0.5, budget::fit_line);
}

TEST(Solve, PutsOnItsBoundWhatIsPressedAgainstIt) {
  fit::LeastSquares p = line({1.1, 2.9, 5.2, 6.8, 9.0});
  for (const double high : {1.5, std::numeric_limits<double>::infinity()}) {
    // b in [0.2, 1.5], then b >= 2.5: the least is outside both.
    p.unknowns[1] =
        high == 1.5 ? fit::Unknown{"b", 0.5, 0.2, high} : fit::Unknown{"b", 3.5, 2.5, high};
    const double bound = high == 1.5 ? 1.5 : 2.5;
    const fit::LeastSquaresResult r = fit::solve(p);
    ASSERT_TRUE(r.is_converged()) << r.sentence;
    EXPECT_EQ(r.x[1], bound);
    EXPECT_NEAR(r.x[0], 5.0 - 2.0 * bound, budget::fit_bounded);
    EXPECT_EQ(r.bound, std::vector<std::size_t>{1});
    EXPECT_THAT(r.sentence, HasSubstr("b is on its bound"));
  }
  p.unknowns[1] = {"b", 0.5, -10.0, 10.0};
  EXPECT_NEAR(fit::solve(p).x[1], 1.97, budget::fit_bounded);
  p.unknowns[1] = {"b", 0.5, -std::numeric_limits<double>::infinity(), 10.0};
  EXPECT_NEAR(fit::solve(p).x[1], 1.97, budget::fit_bounded);
}

// From its bound the least is found as from elsewhere: inside, there, or on the other one.
TEST(Solve, StartsOnABound) {
  fit::LeastSquares p = line({1.1, 2.9, 5.2, 6.8, 9.0});
  p.unknowns[1] = {"b", 0.2, 0.2, 5.0};
  fit::LeastSquaresResult r = fit::solve(p);
  ASSERT_TRUE(r.is_converged()) << r.sentence;
  EXPECT_NEAR(r.x[1], 1.97, budget::fit_bounded);
  EXPECT_TRUE(r.bound.empty());
  p.unknowns[1] = {"b", 2.5, 2.5, std::numeric_limits<double>::infinity()};
  r = fit::solve(p);
  ASSERT_TRUE(r.is_converged()) << r.sentence;
  EXPECT_EQ(r.x[1], 2.5);
  p.unknowns[1] = {"b", 0.2, 0.2, 1.5};
  r = fit::solve(p);
  EXPECT_EQ(r.x[1], 1.5);
  EXPECT_EQ(r.bound, std::vector<std::size_t>{1});
}

// Held on its bound early, an unknown is let go where the others have moved.
TEST(Solve, LeavesABoundThatItMet) {
  fit::LeastSquares p;
  p.unknowns = {{"a", 0.1}, {"b", 1.0, 0.5, 2.0}};
  p.residuals.data = 2;
  p.residuals.at = [](std::span<const double> x, std::span<double> r, std::span<double> J) {
    r[0] = 10.0 * (x[1] - x[0] * x[0]);
    r[1] = 1.0 - x[0];
    if (!J.empty()) J[0] = -20.0 * x[0], J[1] = 10.0, J[2] = -1.0, J[3] = 0.0;
    return true;
  };
  const fit::LeastSquaresResult r = fit::solve(p);
  ASSERT_TRUE(r.is_converged()) << r.sentence;
  EXPECT_NEAR(r.x[0], 1.0, budget::fit_bounded);
  EXPECT_NEAR(r.x[1], 1.0, budget::fit_bounded);
}

TEST(Solve, ScalesErrorsOnTheTriangleInequality) {
  fit::LeastSquares p;
  p.unknowns = {{"I1/I3", 0.6}, {"I2/I3", 0.5}};
  p.triangle = fit::TriangleBound{0, 1};
  p.residuals.data = 4;
  p.residuals.at = [](std::span<const double> x, std::span<double> r, std::span<double> J) {
    for (std::size_t i = 0; i < 4; ++i) {
      r[i] = x[i % 2] - (i < 2 ? 0.39 : 0.41);
      if (J.empty()) continue;
      J[2 * i + i % 2] = 1.0;
      J[2 * i + 1 - i % 2] = 0.0;
    }
    return true;
  };
  const fit::LeastSquaresResult rod = fit::solve_scaled(p);  // nearest to (0.4, 0.4) on I1 + I2 = 1
  ASSERT_TRUE(rod.is_converged()) << rod.sentence;
  EXPECT_NEAR(rod.x[0], 0.5, budget::fit_bounded);
  EXPECT_NEAR(rod.x[1], 0.5, budget::fit_bounded);
}

// Two numbers that say a = wanted[0] and b = wanted[1], under the triangle inequality with 1.
TEST(Solve, KeepsTheTriangleInequality) {
  const auto nearest = [](double a, double b) {
    fit::LeastSquares p;
    p.unknowns = {{"I1/I3", 1.3}, {"I2/I3", 1.1}};
    p.triangle = fit::TriangleBound{0, 1};
    p.residuals.data = 2;
    p.residuals.at = [a, b](std::span<const double> x, std::span<double> r, std::span<double> J) {
      r[0] = x[0] - a;
      r[1] = x[1] - b;
      if (!J.empty()) J[0] = J[3] = 1.0, J[1] = J[2] = 0.0;
      return true;
    };
    return fit::solve(p);
  };
  const fit::LeastSquaresResult inside = nearest(2.9, 3.3);
  EXPECT_NEAR(inside.x[0], 2.9, budget::fit_bounded);
  EXPECT_NEAR(inside.x[1], 3.3, budget::fit_bounded);
  EXPECT_TRUE(inside.bound.empty());
  const fit::LeastSquaresResult flat = nearest(3.0, 1.0);  // the nearest on I1 = 1 + I2
  ASSERT_TRUE(flat.is_converged()) << flat.sentence;
  EXPECT_NEAR(flat.x[0], 2.5, budget::fit_bounded);
  EXPECT_NEAR(flat.x[1], 1.5, budget::fit_bounded);
  EXPECT_THAT(flat.sentence, HasSubstr("I1/I3 is on its bound, 1 + I2/I3"));
  const fit::LeastSquaresResult rod = nearest(0.4, 0.4);  // the nearest on I1 + I2 = 1
  EXPECT_NEAR(rod.x[0], 0.5, budget::fit_bounded);
  EXPECT_NEAR(rod.x[1], 0.5, budget::fit_bounded);
  EXPECT_THAT(rod.sentence, HasSubstr("I1/I3 + I2/I3 is on its bound, 1"));
}

// What rounding put beyond the bound of the triangle is on it.
TEST(Solve, TakesStartsThatRoundingPutOnTheTriangle) {
  fit::LeastSquares p;
  p.residuals.data = 2;
  p.residuals.at = [](std::span<const double> x, std::span<double> r, std::span<double> J) {
    r[0] = x[0] - 0.6;
    r[1] = x[1] - 0.7;
    if (!J.empty()) J[0] = J[3] = 1.0, J[1] = J[2] = 0.0;
    return true;
  };
  p.triangle = fit::TriangleBound{0, 1};
  for (const double s : {0.3, 0.1, 0.7, 0.9}) {
    p.unknowns = {{"I1/I3", std::nextafter(1.0 - s, 0.0)}, {"I2/I3", s}};
    const fit::LeastSquaresResult r = fit::solve(p);
    ASSERT_TRUE(r.is_converged()) << r.sentence;
    EXPECT_NEAR(r.x[0], 0.6, budget::fit_bounded);
    EXPECT_NEAR(r.x[1], 0.7, budget::fit_bounded);
  }
}

TEST(Solve, RobustLossesLeaveABadPointOut) {
  for (const auto kind :
       {fit::Loss::Kind::huber, fit::Loss::Kind::soft_l1, fit::Loss::Kind::cauchy}) {
    fit::LeastSquares p = line({1.0, 3.0, 5.0, 7.0, 39.0});
    p.loss = {kind, 0.1};
    const fit::LeastSquaresResult r = fit::solve(p);
    ASSERT_TRUE(r.is_converged()) << r.sentence;
    EXPECT_NEAR(r.x[1], 2.0, budget::fit_robust) << int(kind);
    EXPECT_NEAR(r.x[0], 1.0, budget::fit_robust) << int(kind);
    // The gradient of the loss vanishes: weights of covariance times residuals times rows.
    double by_a = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double residual = r.numbers[i];
      by_a += value(p.loss, residual * residual / 0.01).weight * residual;
    }
    EXPECT_NEAR(by_a, 0.0, budget::fit_robust_gradient);
  }
}

TEST(Covariance, SaysWhatIsNotDetermined) {
  fit::LeastSquares p = line({1.0, 3.0, 5.0});
  p.residuals.at = [](std::span<const double> x, std::span<double> r, std::span<double> J) {
    for (std::size_t i = 0; i < 3; ++i) {
      r[i] = (x[0] - 2.0 * x[1]) * double(i + 1);
      if (!J.empty()) {
        J[2 * i] = double(i + 1);
        J[2 * i + 1] = -2.0 * double(i + 1);
      }
    }
    return true;
  };
  const fit::LeastSquaresResult r = fit::solve(p);
  const fit::UnknownsCovariance c = fit::covariance(p, r);
  ASSERT_EQ(c.weak.size(), 1u);
  EXPECT_EQ(c.weak[0].sentence, "the data do not determine a and b apart: they grow together");
  EXPECT_TRUE(std::isinf(c.error(0)));
  EXPECT_TRUE(std::isinf(c.error(1)));
  p.priors = {{{"a"}, {1.0}, {1e-4}}};
  const fit::UnknownsCovariance held = fit::covariance(p, fit::solve(p));
  EXPECT_TRUE(std::isfinite(held.error(1)));
  EXPECT_NEAR(held.error(0), 1e-2, budget::fit_line);
}

TEST(Solve, SaysHowItEnded) {
  fit::LeastSquares p = line({1.1, 2.9, 5.2, 6.8, 9.0});
  const auto rosenbrock = [](std::span<const double> x, std::span<double> r, std::span<double> J) {
    r[0] = 1e3 * (x[1] - x[0] * x[0]);
    r[1] = 1.0 - x[0];
    if (!J.empty()) J[0] = -2e3 * x[0], J[1] = 1e3, J[2] = -1.0, J[3] = 0.0;
    return true;
  };
  p.residuals.data = 2;
  p.residuals.at = rosenbrock;
  p.unknowns = {{"a", -1.2}, {"b", 1.0}};
  fit::LeastSquaresResult r = fit::solve(p);
  EXPECT_EQ(r.end, End::converged) << r.sentence;
  EXPECT_NEAR(r.x[0], 1.0, budget::fit_line);
  p.most_iterations = 3;
  r = fit::solve(p);
  EXPECT_EQ(r.end, End::iteration_limit);
  EXPECT_THAT(r.sentence, HasSubstr("the most allowed"));
  p.most_iterations = 200;
  p.residuals.at = [](std::span<const double>, std::span<double> numbers, std::span<double> J) {
    for (double& x : numbers) x = 1.0;  // wrong derivatives: no step helps
    for (double& x : J) x = 1.0;
    return true;
  };
  EXPECT_EQ(fit::solve(p).end, End::no_descent);
  p.residuals.at = [](std::span<const double>, std::span<double> numbers, std::span<double>) {
    for (double& x : numbers) x = std::nan("");
    return true;
  };
  r = fit::solve(p);
  EXPECT_EQ(r.end, End::no_value);
  EXPECT_THAT(r.sentence, HasSubstr("not numbers at a = -1.2, b = 1"));
}

TEST(Solve, RefusesWhatMakesNoSense) {
  fit::LeastSquares p = line({1.0, 2.0, 3.0});
  const auto refusal = [&p](const auto& change) {
    fit::LeastSquares changed = p;
    change(changed);
    return test::message_of([&] { fit::solve(changed); });
  };
  EXPECT_THAT(refusal([](fit::LeastSquares& q) { q.residuals.data = 1; }),
              HasSubstr("2 unknowns (a, b) and 1 numbers"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) { q.unknowns.clear(); }), HasSubstr("no unknowns"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) { q.unknowns[1].name = "a"; }), HasSubstr("twice"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) { q.unknowns[0].low = 0.2; }),
              HasSubstr("the start of a, 0.1, must lie between its bounds"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) {
                q.unknowns[0] = {"a", 1.0, 3.0, 2.0};
              }),
              HasSubstr("the bounds of a, 3 and 2, must leave room"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) {
                q.priors = {{{"c"}, {0.0}, {1.0}}};
              }),
              HasSubstr("a prior is of c"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) {
                q.priors = {{{"a", "a"}, {0.0, 0.0}, {1.0, 0.0, 0.0, 1.0}}};
              }),
              HasSubstr("names a twice"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) {
                q.triangle = fit::TriangleBound{0, 2};
              }),
              HasSubstr("unknowns 0 and 2; expected two different ones of 2"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) { q.residuals.at = nullptr; }),
              HasSubstr("no function"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) {
                q.priors = {{{"a"}, {0.0}, {0.0}}};
              }),
              HasSubstr("positive definite"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) { q.loss.scale = -1.0; }), HasSubstr("positive"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) {
                q.residuals.blocks = {3, 3};
              }),
              HasSubstr("blocks"));
  EXPECT_THAT(refusal([](fit::LeastSquares& q) {
                q.triangle = fit::TriangleBound{0, 1};
              }),
              HasSubstr("triangle inequality"));
}

// Losses against their definition in 50 digits.

Digits rho(fit::Loss::Kind kind, const Digits& z) {
  switch (kind) {
    case fit::Loss::Kind::huber:
      return z <= 1 ? z : Digits(2 * sqrt(z) - 1);
    case fit::Loss::Kind::soft_l1:
      return 2 * (sqrt(1 + z) - 1);
    case fit::Loss::Kind::cauchy:
      return log(1 + z);
    case fit::Loss::Kind::squared:
      break;
  }
  return z;
}

TEST(Loss, IsWhatItsNameSays) {
  for (const auto kind : {fit::Loss::Kind::squared, fit::Loss::Kind::huber,
                          fit::Loss::Kind::soft_l1, fit::Loss::Kind::cauchy}) {
    for (const double z : {1e-30, 1e-8, 0.99e-4, 1.01e-4, 0.3, 0.999, 1.001, 7.0, 1e6, 1e30}) {
      const fit::LossValue found = fit::value({kind, 1.0}, z);
      const Digits at(z), step = at * Digits("1e-40");
      const auto ratio = [&](const Digits& y) { return Digits(rho(kind, y) / y); };
      const Digits slope = (ratio(at + step) - ratio(at - step)) / (2 * step);
      const Digits weight = (rho(kind, at + step) - rho(kind, at - step)) / (2 * step);
      EXPECT_NEAR(found.ratio, double(ratio(at)), budget::loss * double(ratio(at)));
      EXPECT_NEAR(found.weight, double(weight), budget::loss * double(weight));
      const auto pull = [&](const Digits& r) {  // rho'(r^2) r
        const Digits y = r * r, by = y * Digits("1e-30");
        return Digits(r * (rho(kind, y + by) - rho(kind, y - by)) / (2 * by));
      };
      const Digits r = sqrt(at), off = r * Digits("1e-20");
      const Digits curvature = (pull(r + off) - pull(r - off)) / (2 * off);
      EXPECT_NEAR(found.curvature, double(curvature), budget::loss * double(weight));
      // The slope acts multiplied by z.
      EXPECT_NEAR(z * found.slope, double(at * slope), budget::loss * double(ratio(at)));
    }
  }
}

TEST(Loss, OfNothingIsTheSquare) {
  for (const auto kind : {fit::Loss::Kind::squared, fit::Loss::Kind::huber,
                          fit::Loss::Kind::soft_l1, fit::Loss::Kind::cauchy}) {
    const fit::LossValue found = fit::value({kind, 2.0}, 0.0);
    EXPECT_EQ(found.ratio, 1.0);
    EXPECT_EQ(found.weight, 1.0);
  }
}

TEST(Loss, NeedsAScale) {
  EXPECT_REJECTED(fit::check({fit::Loss::Kind::huber, 0.0}), "must be positive");
  EXPECT_THROW(fit::check({fit::Loss::Kind::cauchy, std::numeric_limits<double>::infinity()}),
               DomainError);
  EXPECT_NO_THROW(fit::check({fit::Loss::Kind::soft_l1, 1.5}));
}

}  // namespace
