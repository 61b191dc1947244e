// SPDX-License-Identifier: MIT
#include "polhode/perturb/kane_damper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "budgets.hpp"
#include "message_of.hpp"
#include "unit/perturb/support.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::Worst;

WideVec3 divided(const WideVec3& x, const WideVec3& by) {
  return {x.x / by.x, x.y / by.y, x.z / by.z};
}

// A body with room for the sphere, and the two as they share the momentum.
struct Shared {
  Case c;
  KaneDamper damper;
  Vec3 s;
  Wide J;
  WideVec3 I, hub, g, h;

  explicit Shared(std::uint64_t index) : c(drawn_case(931, index)), damper(1.0, 0.0) {
    Draw draw(932, index);
    const Vec3& m = c.body.moments();
    double sorted[] = {m.x, m.y, m.z};
    std::sort(sorted, sorted + 3);
    damper = KaneDamper(draw.uniform(0.01, 0.99) * (sorted[0] - (sorted[2] - sorted[1])),
                        draw.uniform(0.0, 3.0));
    s = drawn_vector(draw);
    J = damper.moment();
    I = wide(m);
    hub = {I.x - J, I.y - J, I.z - J};
    g = wide(c.s.g);
    h = wide(damper.momentum(c.body, c.s.g, s));
  }
  // Of roundings, by I - J.
  double amplified() const { return static_cast<double>(I.x / hub.x + I.y / hub.y + I.z / hub.z); }
};

TEST(KaneDamper, SharesTheMomentumOfTwoBodies) {
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Shared two(i);
    const WideVec3 w = divided(two.g - two.h, two.hub);
    const WideVec3 s = Wide(1) / two.J * two.h - w;
    const WideVec3 mean = divided(two.g, two.I);
    const double size = largest(mean) + largest(wide(two.s));
    const Vec3 v = two.damper.rate_of_body(two.c.body, two.s);
    const Vec3 back = two.damper.relative_rate(two.c.body, two.c.s.g,
                                               two.damper.momentum(two.c.body, two.c.s.g, two.s));
    const Wide T = (dot(two.g - two.h, w) + dot(two.h, two.h) / two.J) / 2;
    const Wide added = T - dot(two.g, mean) / 2;
    const double off = static_cast<double>(added - two.damper.energy(two.c.body, two.s));
    for (const double error :
         {largest(s - wide(two.s)) / size, largest(w - mean - wide(v)) / size,
          norm(back - two.s) / size, std::abs(off) / (two.damper.moment() * size * size)})
      worst.add(error / two.amplified());
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
}

// d(h/J - (I - J)^-1 (g - h))/dt of dh/dt = h x w0 - c s.
TEST(KaneDamper, RateChangesAsThatOfTwoBodies) {
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Shared two(i);
    Draw draw(933, i);
    const Vec3 dg = drawn_vector(draw);
    const WideVec3 w = divided(two.g - two.h, two.hub);
    const WideVec3 s = Wide(1) / two.J * two.h - w;
    const WideVec3 dh = cross(two.h, w) - Wide(two.damper.friction()) * s;
    const WideVec3 want = Wide(1) / two.J * dh - divided(wide(dg) - dh, two.hub);
    const double decay = two.damper.friction() / two.damper.moment();
    const double size =
        two.amplified() * (largest(divided(wide(dg), two.I)) + largest(s) * (largest(w) + decay));
    const Vec3 got = two.damper.acceleration(two.c.body, two.c.s.g, dg, two.s);
    worst.add(largest(wide(got) - want) / size);
  }
  EXPECT_LE(worst.value(), budget::perturb_eps * eps);
}

TEST(KaneDamper, RefusesWhatIsNoSphereInABody) {
  EXPECT_MESSAGE(KaneDamper(0.0, 1.0), "KaneDamper: moment 0 must be positive and finite");
  EXPECT_MESSAGE(KaneDamper(std::nan(""), 1.0),
                 "KaneDamper: moment nan must be positive and finite");
  EXPECT_MESSAGE(KaneDamper(1.0, -1.0), "KaneDamper: friction -1 must be >= 0 and finite");
  EXPECT_MESSAGE(
      KaneDamper(0.75, 1.0).require_room(Body(2.0, 1.5, 3.0)),
      "KaneDamper: moment 0.75 in a body of moments (2, 1.5, 3) must be at most 0.5, the sum of "
      "the two smaller ones less the largest, and less than each: what is left must be a body");
  KaneDamper(0.5, 1.0).require_room(Body(2.0, 1.5, 3.0));
  // nothing would be left about axis 1
  EXPECT_NE(message_of([] { KaneDamper(1.0, 1.0).require_room(Body(1.0, 2.0, 2.0)); }), "");
}

}  // namespace
}  // namespace perturb_test
