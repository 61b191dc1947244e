// SPDX-License-Identifier: MIT
// Magnetic fields, the residual dipole and eddy currents.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "unit/perturb/support.hpp"
#include "worst.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using polhode::test::Worst;

constexpr double two_pi = 6.283185307179586;
const GaussCoefficients gauss{-29.4968, -1.5864, 4.9443};
constexpr double radius = 0.9;
const PrimaryRotation primary{{0.3, -0.5, 1.7}, 0.8, 0.4, -0.25};
const Mat3 tensor{{{0.5, 0.1, -0.2}, {0.1, 0.3, 0.05}, {-0.2, 0.05, 0.4}}};

// A curve that any number type can follow.
struct Arc {
  template <Real T>
  BasicVec3<T> position(const T& t) const {
    return {T(1.1) + T(0.1) * t * t, T(0.7) - T(0.2) * t, T(0.4) * t - T(0.3)};
  }
};

// From the axes of the primary at time t to inertial ones: three elementary turns, written out.
WideVec3 from_primary(const WideVec3& x, const Wide& t) {
  const WideVec3 p = wide(primary.pole);
  const Wide node = atan2(p.x, -p.y), tilt = acos(p.z / sqrt(dot(p, p)));
  const Wide turn = Wide(primary.meridian) + Wide(primary.rate) * (t - Wide(primary.epoch));
  const WideVec3 a{cos(turn) * x.x - sin(turn) * x.y, sin(turn) * x.x + cos(turn) * x.y, x.z};
  const WideVec3 b{a.x, cos(tilt) * a.y - sin(tilt) * a.z, sin(tilt) * a.y + cos(tilt) * a.z};
  return {cos(node) * b.x - sin(node) * b.y, sin(node) * b.x + cos(node) * b.y, b.z};
}

// a (a/r)^2 (g10 cos(theta) + (g11 cos(phi) + h11 sin(phi)) sin(theta)) in spherical coordinates.
Wide potential(const Wide& t, const WideVec3& x) {
  const auto along = [&](int i) {
    WideVec3 axis;
    axis[i] = 1;
    return dot(from_primary(axis, t), x);
  };
  const Wide r = sqrt(dot(x, x)), a = radius;
  const Wide theta = acos(along(2) / r), phi = atan2(along(1), along(0));
  return a * (a / r) * (a / r) *
         (gauss.g10 * cos(theta) + (gauss.g11 * cos(phi) + gauss.h11 * sin(phi)) * sin(theta));
}

// B = -grad V by central differences.
WideVec3 field_by_differences(const Wide& t, const WideVec3& x) {
  const Wide h = 1e-25;
  WideVec3 B;
  for (int i = 0; i < 3; ++i) {
    WideVec3 forth = x, back = x;
    forth[i] += h;
    back[i] -= h;
    B[i] = -(potential(t, forth) - potential(t, back)) / (2 * h);
  }
  return B;
}

DipoleField tilted() { return DipoleField::from_gauss(gauss, radius, primary); }

// --- fields ---

TEST(DipoleField, IsTheGradientOfTheIgrfPotential) {
  const DipoleField dipole = tilted();
  Worst worst, worst_wide;
  for (std::uint64_t i = 0; i < 100; ++i) {
    Draw draw(551, i);
    const Vec3 x = drawn_vector(draw);
    const double t = draw.uniform(-50.0, 50.0);
    const WideVec3 want = field_by_differences(t, wide(x));
    const double scale = 30.0 * std::pow(radius / norm(x), 3);
    worst.add(largest(wide(dipole.field(t, x)) - want) / scale);
    const BasicVec3<DoubleDouble> fine =
        dipole.field(DoubleDouble(t), BasicVec3<DoubleDouble>{x.x, x.y, x.z});
    worst_wide.add(largest(wide(fine) - want) / scale);
  }
  EXPECT_LE(worst.value(), budget::magnetic_field_eps * eps);
  // the axes of the primary are made in double
  EXPECT_LE(worst_wide.value(), budget::magnetic_field_eps * eps);
}

TEST(DipoleField, OfAPrimaryThatStandsOnAxis3) {
  const DipoleField earth = DipoleField::from_gauss({-2.0, 0.5, -0.25}, 2.0);
  EXPECT_EQ(earth.strength(), (Vec3{4.0, -2.0, -16.0}));
  EXPECT_EQ(earth.strength_at(0.7), (Vec3{4.0, -2.0, -16.0}));
  // on the axis of an axial dipole 2 K / r^3, on its equator -K / r^3
  const DipoleField axial({0.0, 0.0, 16.0});
  EXPECT_EQ(axial.field(0.0, Vec3{0.0, 0.0, 2.0}), (Vec3{0.0, 0.0, 4.0}));
  EXPECT_EQ(axial.field(0.0, Vec3{0.0, -2.0, 0.0}), (Vec3{0.0, 0.0, -2.0}));
}

TEST(DipoleField, RefusesWhatIsNone) {
  EXPECT_REJECTED(DipoleField(Vec3{NAN, 0.0, 0.0}), "must be finite");
  EXPECT_REJECTED(DipoleField::from_gauss({1.0, 0.0, 0.0}, 0.0), "positive");
  EXPECT_REJECTED(DipoleField({1.0, 0.0, 0.0}, {.pole = {0.0, 0.0, 0.0}}), "not zero");
  EXPECT_REJECTED(DipoleField({1.0, 0.0, 0.0}, {.rate = NAN}), "must be finite");
}

// The whole derivative, of the field that the body meets: by differences along the curve.
TEST(FieldAlongOrbit, RateIsTheDerivativeOfWhatTheBodyMeets) {
  const FieldAlongOrbit met(Arc{}, tilted());
  ASSERT_TRUE(met.has_rate());
  for (const double t : {-2.0, 0.3, 1.9}) {
    const Wide h = 1e-20;
    const auto at = [&](const Wide& when) {
      return field_by_differences(when, Arc{}.position(when));
    };
    const WideVec3 forth = at(Wide(t) + h), back = at(Wide(t) - h);
    const WideVec3 want = (1 / (2 * h)) * (forth - back);
    const BasicFieldMotion<double> got = met.motion(t, 0.0);
    EXPECT_LE(largest(wide(got.rate) - want), budget::magnetic_field_eps * eps * largest(want));
    EXPECT_LE(largest(wide(got.field) - wide(met.field(t, 0.0))),
              budget::magnetic_field_eps * eps * norm(got.field));
  }
}

TEST(FieldAlongOrbit, KnowsWhetherItHasARate) {
  const auto plain = [](double, const Vec3& x) { return x; };
  const auto generic = [](const auto& t, const auto& x) { return t * x; };
  EXPECT_FALSE(FieldAlongOrbit(Arc{}, FieldFunction(plain)).has_rate());
  const FieldAlongOrbit grows(Arc{}, FieldFunction(generic));
  EXPECT_TRUE(grows.has_rate());
  const Vec3 x = Arc{}.position(2.0), v{0.4, -0.2, 0.4};
  EXPECT_LE(norm(grows.motion(2.0, 0.0).rate - (x + 2.0 * v)), budget::magnetic_field_eps * eps);
  const FieldAlongOrbit still(Arc{}, FieldFunction(plain));
  EXPECT_REJECTED(still.motion(0.0, 0.0), "no derivative");
  EXPECT_REJECTED(EddyCurrents(tensor, still), "FieldRate::left_out");
  const AnyPerturbation given("eddy", EddyCurrents(tensor, still, FieldRate::left_out));
  EXPECT_TRUE(given.is_affine());
  EXPECT_FALSE(given.supports_any_real());  // a function on double alone
}

// --- residual dipole ---

TEST(ResidualDipole, IsTheDerivativeOfItsEnergy) {
  const ResidualDipole term({0.3, -0.7, 0.2}, FieldAlongOrbit(Arc{}, tilted()));
  Worst worst;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Case c = drawn_case(552, i);
    BasicSetting<Wide> at = c.on<Wide>();
    at.s.q = normalized(at.s.q);
    at.q_IS = normalized(at.q_IS);
    const BasicEffect<Wide> want = effect_by_differences(term, at);
    const double scale = norm(term.field().field(c.t, 0.0));
    worst.add(largest(wide(term.effect(c.on<double>()).u) - want.u) / scale);
    EXPECT_EQ(largest(want.v), 0.0);
  }
  EXPECT_LE(worst.value(), budget::magnetic_field_eps * eps);
  EXPECT_NE(message_of([] {
              ResidualDipole({NAN, 0.0, 0.0}, ConstantField({1.0, 0.0, 0.0}));
            }),
            "");
}

// --- eddy currents ---

// The currents that flow in the body, from what the body sees: in body axes the field is R^T B,
// and its derivative there (by differences, the body turning by w) drives them.
TEST(EddyCurrents, AreDrivenByTheFieldThatTheBodySees) {
  const FieldAlongOrbit met(Arc{}, tilted());
  const EddyCurrents term(tensor, met);
  Worst worst;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const Case c = drawn_case(553, i);
    const BasicSetting<Wide> at = c.on<Wide>();
    const WideQuaternion q_IB = normalized(at.q_IS) * normalized(at.s.q);
    const Vec3& I = c.body.moments();
    const WideVec3 w{at.s.g.x / I.x, at.s.g.y / I.y, at.s.g.z / I.z};
    const auto seen = [&](const Wide& h) {
      const Wide rate = sqrt(dot(w, w)), half = rate * h / 2;
      const Wide f = sin(half) / rate;
      const WideQuaternion q = q_IB * WideQuaternion{cos(half), f * w.x, f * w.y, f * w.z};
      return rotate(conj(q), field_by_differences(at.t + h, Arc{}.position(at.t + h)));
    };
    const Wide h = 1e-20;
    const WideVec3 forth = seen(h), back = seen(-h), B = seen(0);
    const WideVec3 change = (1 / (2 * h)) * (forth - back);
    WideVec3 moment;
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) moment[k] -= Wide(tensor(k, j)) * change[j];
    const WideVec3 want = cross(moment, B);
    const double scale = (1.0 + largest(change)) * largest(B);
    worst.add(largest(wide(term.effect(c.on<double>()).u) - want) / scale);
    const BasicEffect<Tangent> e = term.effect(c.on<Tangent>());
    EXPECT_EQ(Vec3({e.u.x.value, e.u.y.value, e.u.z.value}), term.effect(c.on<double>()).u);
  }
  EXPECT_LE(worst.value(), budget::magnetic_field_eps * eps);
}

TEST(EddyCurrents, TakeEnergyInAFieldAtRest) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Case c = drawn_case(554, i);
    const Vec3 w = angular_velocity(c.body, c.s);
    const EddyCurrents constant(tensor, ConstantField({0.3, -0.2, 0.8}));
    const EddyCurrents without(tensor, FieldAlongOrbit(Arc{}, tilted()), FieldRate::left_out);
    EXPECT_LT(dot(constant.effect(c.on<double>()).u, w), 0.0);
    EXPECT_LT(dot(without.effect(c.on<double>()).u, w), 0.0);
  }
}

TEST(EddyCurrents, AffineFormIsTheEffect) {
  const EddyCurrents term(tensor, FieldAlongOrbit(Arc{}, tilted()));
  Worst worst;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Case c = drawn_case(555, i);
    const AffineTorque affine = term.affine_torque(c.on<double>());
    const Vec3 u = affine.constant - affine.damping * c.s.g;
    const double size = norm(affine.constant) + norm(affine.damping * c.s.g);
    worst.add(norm(u - term.effect(c.on<double>()).u) / size);
  }
  EXPECT_LE(worst.value(), budget::magnetic_field_eps * eps);
}

// g(h) - g of dg/dt = c - A g by its Taylor series at 76 digits.
WideVec3 change_by_series(const AffineTorque& torque, const Vec3& g, double h) {
  const auto times = [&](const WideVec3& x) {
    WideVec3 y;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) y[i] += Wide(torque.damping(i, j)) * x[j];
    return y;
  };
  WideVec3 term = Wide(h) * (wide(torque.constant) - times(wide(g))), sum = term;
  for (int k = 2; k < 600; ++k) {
    term = Wide(-Wide(h) / k) * times(term);
    sum = sum + term;
  }
  return sum;
}

TEST(AffineTorque, ChangeIsTheExponential) {
  Worst worst, worst_small;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Case c = drawn_case(556, i);
    const EddyCurrents term(tensor, ConstantField({0.3, -0.2, 0.8}));
    AffineTorque torque = term.affine_torque(c.on<double>());
    torque.constant = {0.4, -0.1, 0.3};
    for (const double h : {1e-9, 0.01, 0.2, 3.0, 40.0, -5.0}) {
      const Vec3 got = change_of_momentum(torque, c.s.g, h);
      const WideVec3 want = change_by_series(torque, c.s.g, h);
      const double size = largest(want);
      (std::abs(h) < 0.3 ? worst_small : worst)
          .add(largest(wide(got) - want) / (size * (1.0 + std::abs(h))));
    }
    EXPECT_EQ(change_of_momentum(torque, c.s.g, 0.0), Vec3{});
  }
  EXPECT_LE(worst_small.value(), budget::affine_change_eps * eps);
  EXPECT_LE(worst.value(), budget::affine_change_eps * eps);
}

TEST(EddyCurrents, RefuseWhatDrives) {
  const ConstantField field({0.0, 0.0, 1.0});
  const Mat3 driving{{{1.0, 2.0, 0.0}, {2.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  EXPECT_REJECTED(EddyCurrents(driving, field), "has the eigenvalue -");
  const Mat3 skew{{{1.0, 0.5, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  EXPECT_REJECTED(EddyCurrents(skew, field), "magnetic tensor");
  EXPECT_REJECTED(ConstantField({0.0, NAN, 1.0}), "must be finite");
}

// --- what bodies do ---

Mat3 times_identity(double k) { return {{{k, 0.0, 0.0}, {0.0, k, 0.0}, {0.0, 0.0, k}}}; }

RotorState end_of(const System& system, const RotorState& s, double stop, const Method& method) {
  const std::vector<Sample> samples = integrate(Problem{system, s, 0.0, stop, method},
                                                {.samples = SaveAt::times({stop}), .dense = false})
                                          .samples();
  return samples.back().s;
}

// A sphere of moment I in a field B at rest: the spin across B decays as exp(-k B^2 t / I), that
// along B stays.
TEST(EddyCurrents, SphereLosesItsSpinAcrossTheField) {
  const double k = 0.02, I = 1.3;
  const Vec3 B{0.3, -0.2, 0.8}, g_I{0.4, 1.1, -0.7};
  const System system(Body(I, I, I), Frame::inertial(),
                      {{"eddy", EddyCurrents(times_identity(k), ConstantField(B))}});
  const RotorState start{normalized(Quaternion{0.3, 0.5, -0.4, 0.7}),
                         rotate(conj(normalized(Quaternion{0.3, 0.5, -0.4, 0.7})), g_I)};
  const double B2 = dot(B, B), t = 40.0;
  const Vec3 along = (dot(B, g_I) / B2) * B;
  const Vec3 want = along + std::exp(-k * B2 / I * t) * (g_I - along);
  for (const Method& method :
       {Method(Adaptive{.tolerance = 1e-15}), Method(VariationOfConstants{.tolerance = 1e-15}),
        Method(Splitting{0.25})}) {
    const RotorState end = end_of(system, start, t, method);
    EXPECT_LE(norm(rotate(end.q, end.g) - want), budget::magnetic_decay) << method_text(method);
  }
}

// A sphere on a circular polar orbit about an axial dipole, the mean over a revolution by
// quadrature (midpoints: exact for what has finitely many harmonics) and by hand: with B in units
// of K / r^3 the rates along node, orbit normal and pole are 11/8, 5/2, 9/8 times k / I, and the
// turning field drives the spin about the normal towards 9/5 of the motion of the body.
TEST(EddyCurrents, SecularRatesOnAPolarOrbit) {
  const double small = 1e-7, K = 2.0;
  const KeplerOrbit orbit(
      {.gm = 1.0, .pericentre = 1.0, .eccentricity = 0.0, .inclination = 0.25 * two_pi});
  const FieldAlongOrbit met(orbit, DipoleField({0.0, 0.0, K}));
  const Vec3 w0{3.0, 4.0, 5.0};  // along node, minus normal, pole
  Vec3 mean;
  const int count = 64;
  for (int j = 0; j < count; ++j) {
    const double t = two_pi * (j + 0.5) / count;
    const double c = std::cos(t), s = std::sin(t);  // x = (c, 0, s), pole = (0, 0, 1)
    const Vec3 B{3.0 * K * s * c, 0.0, K * (3.0 * s * s - 1.0)};
    const Vec3 rate{3.0 * K * (c * c - s * s), 0.0, 6.0 * K * s * c};
    mean = mean + (1.0 / count) * cross(cross(w0, B) - rate, B);
  }
  // the normal is (0, -1, 0)
  const Vec3 by_hand{-11.0 / 8.0 * w0.x, -5.0 / 2.0 * w0.y - 4.5, -9.0 / 8.0 * w0.z};
  EXPECT_LE(norm(mean - K * K * by_hand), budget::magnetic_secular * norm(mean));
  const System system(Body(1.0, 1.0, 1.0), Frame::inertial(),
                      {{"eddy", EddyCurrents(times_identity(small), met)}});
  const RotorState end = end_of(system, {{}, w0}, two_pi, Adaptive{.tolerance = 1e-15});
  const Vec3 change = (1.0 / (small * two_pi)) * (rotate(end.q, end.g) - w0);
  // second order in the strength, and roundings of w over it
  EXPECT_LE(norm(change - mean), budget::magnetic_average * norm(mean));
}

// Eddy currents and kicks in one flow: the schemes keep their order.
TEST(Splitting, EddyCurrentsWithKicksKeepTheOrder) {
  const KeplerOrbit orbit({.gm = 1.0, .pericentre = 0.9, .eccentricity = 0.1});
  const FieldAlongOrbit met(orbit, tilted());
  const System system(
      Body(0.9, 1.0, 1.1), Frame::inertial(),
      {{"gravity", GravityGradient(1.0, orbit)},
       {"eddy", EddyCurrents(Mat3{{{2e-4, 0.0, 0.0}, {0.0, 1e-4, 0.0}, {0.0, 0.0, 3e-4}}}, met)},
       {"magnet", ResidualDipole({1e-3, 2e-3, 0.0}, met)}});
  const RotorState start{{}, {0.9 * 1.0, 1.2, 1.1 * 1.6}};
  const RotorState want = end_of(system, start, 6.0, Adaptive{.tolerance = 1e-15});
  const auto error = [&](SplittingScheme scheme, double step) {
    const RotorState end = end_of(system, start, 6.0, Splitting{step, scheme});
    const Quaternion d = conj(want.q) * end.q;
    return norm(Vec3{d.x, d.y, d.z}) + norm(end.g - want.g);
  };
  using enum SplittingScheme;
  const auto order = [&](SplittingScheme scheme, double step) {
    return std::log2(error(scheme, step) / error(scheme, 0.5 * step));
  };
  EXPECT_NEAR(order(order2, 0.1), 2.0, budget::splitting_affine_order);
  EXPECT_NEAR(order(order4, 0.2), 4.0, budget::splitting_affine_order);
  EXPECT_NEAR(order(order6, 0.4), 6.0, budget::splitting_affine_order);
  EXPECT_LE(error(ABA864, 0.05), budget::splitting_affine);
  // a term with a flow of its own makes it a composition, of order 4 at most
  System damped(system.body(), system.frame(),
                {system.terms()[0], system.terms()[1], system.terms()[2],
                 AnyPerturbation("air", LinearDamping(1e-3))});
  const RotorState with_air = end_of(damped, start, 6.0, Adaptive{.tolerance = 1e-15});
  const RotorState split = end_of(damped, start, 6.0, Splitting{0.05, ABA864});
  EXPECT_LE(norm(split.g - with_air.g), budget::splitting_affine_composed);
  EXPECT_REJECTED(
      state_transitions({system, start, 0.0, 1.0, Splitting{0.1}}, SaveAt::times({1.0})),
      "\"eddy\" has no derivative");
}

TEST(EddyCurrents, InAListOfTerms) {
  const EddyCurrents term(tensor, ConstantField({0.3, -0.2, 0.8}));
  const AnyPerturbation any("eddy", term);
  EXPECT_TRUE(any.is_affine());
  const Case c = drawn_case(557, 0);
  const Setting at = c.on<double>();
  EXPECT_EQ(any.flow(at, 0.7).g, c.s.g + change_of_momentum(term.affine_torque(at), c.s.g, 0.7));
  const AnyPerturbation air("air", LinearDamping(0.1));
  EXPECT_FALSE(air.is_affine());
  EXPECT_REJECTED(air.affine_torque(at), "affine");
}

}  // namespace
}  // namespace perturb_test
