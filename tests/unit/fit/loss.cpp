// SPDX-License-Identifier: MIT
// Losses against their definition in 50 digits.
#include "polhode/fit/loss.hpp"

#include <gmock/gmock.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"

namespace {
using namespace polhode;
using Digits = boost::multiprecision::cpp_bin_float_100;

Digits rho(Loss::Kind kind, const Digits& z) {
  switch (kind) {
    case Loss::Kind::huber:
      return z <= 1 ? z : Digits(2 * sqrt(z) - 1);
    case Loss::Kind::soft_l1:
      return 2 * (sqrt(1 + z) - 1);
    case Loss::Kind::cauchy:
      return log(1 + z);
    case Loss::Kind::squared:
      break;
  }
  return z;
}

TEST(Loss, IsWhatItsNameSays) {
  for (const auto kind :
       {Loss::Kind::squared, Loss::Kind::huber, Loss::Kind::soft_l1, Loss::Kind::cauchy}) {
    for (const double z : {1e-30, 1e-8, 0.99e-4, 1.01e-4, 0.3, 0.999, 1.001, 7.0, 1e6, 1e30}) {
      const LossValue found = value({kind, 1.0}, z);
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
  for (const auto kind :
       {Loss::Kind::squared, Loss::Kind::huber, Loss::Kind::soft_l1, Loss::Kind::cauchy}) {
    const LossValue found = value({kind, 2.0}, 0.0);
    EXPECT_EQ(found.ratio, 1.0);
    EXPECT_EQ(found.weight, 1.0);
  }
}

TEST(Loss, NeedsAScale) {
  EXPECT_REJECTED(check({Loss::Kind::huber, 0.0}), "must be positive");
  EXPECT_THROW(check({Loss::Kind::cauchy, std::numeric_limits<double>::infinity()}), DomainError);
  EXPECT_NO_THROW(check({Loss::Kind::soft_l1, 1.5}));
}

}  // namespace
