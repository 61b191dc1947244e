// SPDX-License-Identifier: MIT
// Free bodies seen from moving frames. The exact route: a free rotation in inertial axes, the frame
// put on by its own attitude; the oracle: the same motion with 76 digits, frames and their rates by
// definition. After 1e4 turns the non-osculating elements still give the inertial angular velocity,
// the osculating ones the relative rate, and both move as andoyer_rates says.
#include "polhode/system/osculation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "budgets.hpp"
#include "oracle/free_body.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/system/canonical_rates.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using namespace oracle;
using polhode::test::smaller;
using polhode::test::Worst;

// A frame for the library, and by definition: attitude and rate, both in inertial axes.
struct Observer {
  std::string name;
  Frame frame;
  WideQuaternion (*q_IS)(const Wide& t);
  WideVec3 (*mu_I)(const Wide& t);
};

constexpr double slow = 0x1p-7;
constexpr double precession = -0.011;

// An orbit plane with a regressing node and an inclination that swings.
struct Node {
  template <class T>
  T operator()(const T& t) const {
    return T(T(0.25) - T(slow) * t);
  }
};
struct Tilt {
  template <class T>
  T operator()(const T& t) const {
    using std::sin;
    return T(T(0.5) + T(0.125) * T(sin(T(T(slow) * t))));
  }
};
// Any attitude: a turn about an axis that itself goes round.
struct Tumble {
  template <class T>
  BasicQuaternion<T> operator()(const T& t) const {
    return rotation_z(T(T(slow) * t)) * rotation_x(T(T(precession) * t));
  }
};

// mu_I = 2 (dq/dt) q*, by a central difference: of q alone.
template <class F>
WideVec3 turning_rate(F q, const Wide& t) {
  const Wide h("1e-25");
  const WideQuaternion a = q(Wide(t - h)), b = q(Wide(t + h));
  const WideQuaternion turn = b * conj(a);
  return {turn.x / h, turn.y / h, turn.z / h};
}

std::vector<Observer> observers() {
  return {{"precessing about an inclined axis", Frame::precessing({0.6, 0.0, 0.8}, precession, 2.0),
           [](const Wide& t) {
             const Wide half = Wide(precession) * (t - 2) / 2;
             const Vec3 n{0.6 / norm(Vec3{0.6, 0, 0.8}), 0, 0.8 / norm(Vec3{0.6, 0, 0.8})};
             return WideQuaternion{cos(half), n.x * sin(half), 0, n.z * sin(half)};
           },
           [](const Wide&) {
             return WideVec3{Wide(precession) * 6 / 10, 0, Wide(precession) * 8 / 10};
           }},
          {"orbit plane", Frame::orbit_plane(Node{}, Tilt{}),
           [](const Wide& t) { return rotation_z(Node{}(t)) * rotation_x(Tilt{}(t)); },
           [](const Wide& t) {
             const Wide Omega = Node{}(t), swing = Wide(slow) * Wide(cos(Wide(slow) * t)) / 8;
             return WideVec3{swing * cos(Omega), swing * sin(Omega), -Wide(slow)};
           }},
          {"tumbling", Frame::from_attitude(Tumble{}), [](const Wide& t) { return Tumble{}(t); },
           [](const Wide& t) { return turning_rate(Tumble{}, t); }}};
}

struct Rotor {
  std::string name;
  Vec3 moments;
  RotorState start;
  Body body() const { return {moments.x, moments.y, moments.z}; }
};
std::vector<Rotor> rotors() {
  const Quaternion q = normalized(Quaternion{0.6, -0.3, 0.7, 0.2});
  return {{"short axis", {3, 4, 6}, {q, {1.5, 1.0, 6.0}}},
          {"long axis", {3, 4, 6}, {q, {4.0, 1.0, -1.2}}},
          {"axisymmetric", {4, 4, 5}, {q, {2.0, 1.0, 5.0}}},
          {"nearly about b3", {3, 4, 6}, {q, {0.01, -0.02, 6.0}}}};
}

WideState wide_reference_state(const Observer& o, const Wide& t, const WideState& s_I) {
  return {conj(o.q_IS(t)) * s_I.q, s_I.g};
}
double distance(const Vec3& a, const WideVec3& b) {
  const WideVec3 d{Wide(a.x) - b.x, Wide(a.y) - b.y, Wide(a.z) - b.z};
  return static_cast<double>(norm(d));
}
WideVec3 body_rate(const Rotor& r, const WideState& s) {
  return {s.g.x / r.moments.x, s.g.y / r.moments.y, s.g.z / r.moments.z};
}

// Times up to 1e4 turns and a little more.
std::vector<double> times(const Rotor& r) {
  const double turn = 6.283185307179586 / FreeRotation(r.body(), r.start).precession_rate_short();
  return {0.0, 0.3 * turn, 17.1 * turn, 1e3 * turn, 1e4 * turn, 10001.37 * turn};
}

// [SA (124)] I^-1 g of the canonical elements in S is the inertial angular velocity; that of the
// osculating ones is the relative one; so angular_velocity says too.
TEST(Osculation, BothAngularVelocitiesAfterTenThousandTurns) {
  for (const Rotor& r : rotors()) {
    FreeBody exact(r.moments, r.start.q, r.start.g);
    const FreeRotation motion(r.body(), r.start);
    for (const Observer& o : observers()) {
      const System system(r.body(), o.frame);
      Worst inertial, relative, named;
      double apart = 1e300;
      for (const double t : times(r)) {
        const RotorState s = reference_state(system, t, motion.at(t));
        const RotorState canonical = to_rotor(to_andoyer(s));
        const RotorState osculating = to_rotor(charts::osculating_andoyer(system, t, s));
        const Quaternion q_IS = o.frame.at(t).q_IS;
        const auto inertial_axes = [&](const RotorState& x, const Vec3& w) {
          return rotate(q_IS, rotate(x.q, w));
        };
        const WideState s_I = exact.at(Wide(t));
        const WideVec3 w_IB = rotate(s_I.q, body_rate(r, s_I)), w_SB = w_IB - o.mu_I(Wide(t));
        const Vec3 w_canonical = inertial_axes(canonical, angular_velocity(r.body(), canonical));
        const Vec3 w_osculating = inertial_axes(osculating, angular_velocity(r.body(), osculating));
        inertial.add(distance(w_canonical, w_IB));
        relative.add(distance(w_osculating, w_SB));
        const AngularVelocities w = angular_velocity(system, t, s);
        named.add(distance(inertial_axes(s, w.inertial), w_IB));
        named.add(distance(inertial_axes(s, w.relative), w_SB));
        apart = smaller(apart, norm(osculating.g - canonical.g) / norm(s.g));
      }
      const std::string where = r.name + ", " + o.name;
      EXPECT_LT(inertial.value(), budget::osculation_rate) << where;
      EXPECT_LT(relative.value(), budget::osculation_rate) << where;
      EXPECT_LT(named.value(), budget::osculation_rate) << where;
      EXPECT_GT(apart, budget::osculation_apart) << where;
    }
  }
}

// The elements of the exact route, differenced at 76 digits, move as Hamilton's equations of
// T - mu . g say: the frame's term belongs to canonical elements.
TEST(Osculation, CanonicalElementsObeyHamiltonsEquationsInTheFrame) {
  const Wide h("1e-25");
  for (const Rotor& r : rotors()) {
    FreeBody exact(r.moments, r.start.q, r.start.g);
    const FreeRotation motion(r.body(), r.start);
    for (const Observer& o : observers()) {
      const System system(r.body(), o.frame);
      Worst worst;
      for (const double t : times(r)) {
        const auto elements = [&](const Wide& time) {
          const auto a = to_andoyer(wide_reference_state(o, time, exact.at(time)));
          return std::array<Wide, 6>{a.l, a.g, a.h, a.L, a.G, a.H};
        };
        const auto before = elements(Wide(t) - h), after = elements(Wide(t) + h);
        const rates::AndoyerRates a =
            rates::andoyer_rates(system, t, reference_state(system, t, motion.at(t)));
        const double rates[6] = {a.l, a.g, a.h, a.L, a.G, a.H};
        for (std::size_t i = 0; i < 6; ++i) {
          Wide change = after[i] - before[i];
          if (i < 3 && abs(change) > 1) continue;  // an angle that passed pi
          worst.add(static_cast<double>(Wide(abs(Wide(change / (2 * h) - Wide(rates[i]))))));
        }
      }
      EXPECT_LT(worst.value(), budget::osculation_rates) << r.name << ", " << o.name;
    }
  }
}

// Free motion from the osculating state touches the true one: it leaves it with the square of the
// time, free motion from the canonical state with the first power.
TEST(Osculation, OsculatingMeansTouching) {
  for (const Rotor& r : rotors()) {
    const FreeRotation motion(r.body(), r.start);
    for (const Observer& o : observers()) {
      const System system(r.body(), o.frame);
      const double t = 3.0;
      const RotorState s = reference_state(system, t, motion.at(t));
      const auto leaves = [&](const RotorState& from, double h) {
        const Quaternion there = reference_state(system, t + h, motion.at(t + h)).q;
        const Quaternion d = conj(FreeRotation(r.body(), from, t).at(t + h).q) * there;
        return std::hypot(d.x, d.y, d.z);
      };
      const auto slope = [&](const RotorState& from) {
        return std::log2(leaves(from, 0x1p-8) / leaves(from, 0x1p-9));
      };
      const std::string where = r.name + ", " + o.name;
      EXPECT_NEAR(slope(charts::osculating_state(system, t, s)), 2.0, budget::osculation_slope)
          << where;
      EXPECT_NEAR(slope(s), 1.0, budget::osculation_slope) << where;
    }
  }
}

// [SA (102), (103)] the modified set along the exact route, by fourth-order differences.
TEST(Osculation, ModifiedSetMovesAtItsRates) {
  for (const Rotor& r : rotors()) {
    const FreeRotation motion(r.body(), r.start);
    for (const Observer& o : observers()) {
      const System system(r.body(), o.frame);
      const double t = 2.0, t0 = -1.5, h = 0x1p-6;
      const auto elements = [&](double time) {
        const RotorState s = reference_state(system, time, motion.at(time));
        const AndoyerState a = charts::modified_andoyer(r.body(), time, s, t0);
        return std::array<double, 6>{a.l, a.g, a.h, a.L, a.G, a.H};
      };
      const auto m2 = elements(t - 2 * h), m1 = elements(t - h);
      const auto p1 = elements(t + h), p2 = elements(t + 2 * h);
      const RotorState s = reference_state(system, t, motion.at(t));
      const rates::AndoyerRates a = charts::modified_andoyer_rates(system, t, s, t0);
      const double rates[6] = {a.l, a.g, a.h, a.L, a.G, a.H};
      for (std::size_t i = 0; i < 6; ++i) {
        const double rate = (8.0 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12.0 * h);
        EXPECT_NEAR(rate, rates[i], budget::osculation_differences)
            << r.name << ", " << o.name << ", element " << i;
      }
      const RotorState back = charts::from_modified_andoyer(
          r.body(), t, charts::modified_andoyer(r.body(), t, s, t0), t0);
      EXPECT_LT(norm(back.g - s.g) / norm(s.g), budget::osculation_round_trip) << r.name;
    }
  }
}

// H' with every power of the momentum up to the third and with the attitude.
struct Mixed {
  std::array<double, 6> a;
  template <class T>
  T operator()(const T& t, const BasicRotorState<T>& s) const {
    const BasicVec3<T>& g = s.g;
    const BasicVec3<T> G = rotate(s.q, g);
    return T(a[0]) * g.x * g.y + T(a[1]) * G.z * g.z + T(a[2]) * t * G.x +
           T(a[3]) * g.z * g.z * g.x + T(a[4]) * G.y * g.y * g.y + T(a[5]) * G.z * G.z;
  }
};

// There and back for v that is nonlinear in g.
TEST(Osculation, CanonicalFromOsculating) {
  Draw draw(17021, 0);
  Worst worst;
  for (int i = 0; i < 200; ++i) {
    Mixed H{};
    for (double& x : H.a) x = draw.uniform(-0.02, 0.02);
    const Observer o = observers()[draw.index(3)];
    const Body body(3, 4, 5);
    const System system(body, o.frame, {AnyPerturbation("mixed", HamiltonianTerm(H))});
    const RotorState s{
        normalized(Quaternion{draw.normal(), draw.normal(), draw.normal(), draw.normal()}),
        {draw.normal(), draw.normal(), draw.normal()}};
    const double t = draw.uniform(-3.0, 3.0);
    const RotorState back =
        charts::canonical_state(system, t, charts::osculating_state(system, t, s));
    worst.add(norm(back.g - s.g) / norm(s.g));
    const AndoyerState a = to_andoyer(s);
    const RotorState through =
        to_rotor(charts::canonical_andoyer(system, t, charts::osculating_andoyer(system, t, a)));
    worst.add(norm(through.g - s.g) / norm(s.g));
  }
  EXPECT_LT(worst.value(), budget::osculation_round_trip);
}

}  // namespace
