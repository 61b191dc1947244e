// SPDX-License-Identifier: MIT
// The motion of driven bodies and its derivatives by every unknown, against differences of an
// integration in 40 digits.
#include "fit/driven/driven_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "budgets.hpp"
#include "driven_cases.hpp"
#include "fit/free_motion.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "worst.hpp"

namespace {
using namespace polhode;
using namespace polhode::test;
using fit::detail::DrivenColumn;

fit::SpinState spun(const Vec3& moments, const Vec3& w) {
  fit::SpinState s{0.0, normalized(Quaternion{0.5, 0.1, -0.7, 0.5}), w, Mat3::identity()};
  for (int i = 0; i < 3; ++i) s.inertia_F(i, i) = moments[i];
  return s;
}

struct Case {
  fit::SpinState start;
  fit::SpinDrive drive;
  WideTorque torque;
};

fit::TorqueParameter parameter(const char* name, double start) { return {name, start}; }

// Three components along the body, two along inertial axes.
Case constant_torque() {
  Case c{spun({0.6, 0.85, 1.0}, {0.2, -0.4, 0.9}), {}, {}};
  c.drive.parameters = {parameter("a", 1e-3), parameter("b", -2e-3), parameter("c", 0.0),
                        parameter("x", 4e-3), parameter("y", 0.0)};
  c.drive.terms = [](std::span<const double> p) {
    return std::vector<AnyPerturbation>{{"body", ConstantTorque::in_body({p[0], p[1], p[2]})},
                                        {"space", ConstantTorque::in_space({p[3], p[4], 0.003})}};
  };
  c.torque = [](const Wide&, const std::array<WideVec3, 3>& e, const WideVec3&,
                const WideSpin& of) {
    const auto& p = of.parameters;
    WideVec3 u = to_body(e, {p[3], p[4], Wide(0.003)});
    for (std::size_t i = 0; i < 3; ++i) u[i] += p[i];
    return u;
  };
  return c;
}

// Two entries of the tensor of eddy currents, and a friction: both see the moments through the
// rate.
Case eddy_currents() {
  Case c{spun({3.1, 3.25, 1.0}, {0.3, 0.2, -0.8}), {}, {}};
  c.drive.parameters = {parameter("M00", 0.02), parameter("M22", 0.03), parameter("d", 0.004)};
  static const Vec3 field{0.3, -0.2, 0.7};
  c.drive.terms = [](std::span<const double> p) {
    Mat3 M;
    M(0, 0) = p[0];
    M(1, 1) = 0.01;
    M(2, 2) = p[1];
    return std::vector<AnyPerturbation>{
        {"eddy", EddyCurrents(M, ConstantField(field), FieldRate::left_out)},
        {"friction", LinearDamping(p[2])}};
  };
  c.torque = [](const Wide&, const std::array<WideVec3, 3>& e, const WideVec3& w,
                const WideSpin& of) {
    const auto& p = of.parameters;
    const WideVec3 B = to_body(e, wide(field));
    WideVec3 seen = crossed(w, B);
    seen[0] *= p[0];
    seen[1] *= Wide(0.01);
    seen[2] *= p[1];
    WideVec3 u = crossed(seen, B);
    for (std::size_t i = 0; i < 3; ++i) u[i] -= p[2] * w[i];
    return u;
  };
  return c;
}

constexpr double flyby_gm = 40.0, pericentre = 6.0, eccentricity = 1.6, passage = 4.0;

// x, y of a hyperbola in its plane; once for each time, since all runs ask at the same ones.
WideVec3 on_hyperbola(const Wide& t) {
  static std::map<Wide, WideVec3> known;
  if (const auto one = known.find(t); one != known.end()) return one->second;
  const Wide e = eccentricity, q = pericentre, gm = flyby_gm, a = q / (e - 1);
  const Wide M = sqrt(gm / (a * a * a)) * (t - passage);
  Wide H = asinh(M / e);
  for (int i = 0; i < 60; ++i) {
    const Wide step = (e * sinh(H) - H - M) / (e * cosh(H) - 1);
    H -= step;
    if (abs(step) < Wide("1e-37")) break;
  }
  return known[t] = {a * (e - cosh(H)), a * sqrt(e * e - 1) * sinh(H), 0};
}

// The GM of what is passed, and a torque beside it.
Case flyby() {
  Case c{spun({0.5, 0.9, 1.0}, {0.1, 0.3, 0.4}), {}, {}};
  c.drive.parameters = {parameter("gm", 60.0), parameter("u", 1e-3)};
  c.drive.terms = [](std::span<const double> p) {
    const KeplerElements orbit{
        .gm = flyby_gm, .pericentre = pericentre, .eccentricity = eccentricity, .epoch = passage};
    return std::vector<AnyPerturbation>{{"gravity", GravityGradient(p[0], KeplerOrbit(orbit))},
                                        {"torque", ConstantTorque::in_body({0.0, 0.0, p[1]})}};
  };
  c.torque = [](const Wide& t, const std::array<WideVec3, 3>& e, const WideVec3&,
                const WideSpin& of) {
    const WideVec3 x_I = on_hyperbola(t), x = to_body(e, x_I);
    const Wide r2 = dotted(x_I, x_I), k = 3 * of.parameters[0] / (r2 * r2 * sqrt(r2));
    WideVec3 u = crossed(x, {of.moments[0] * x[0], of.moments[1] * x[1], of.moments[2] * x[2]});
    for (Wide& one : u) one *= k;
    u[2] += of.parameters[1];
    return u;
  };
  return c;
}

// A jump of each kind, and a torque that never stops.
Case jumps() {
  Case c = constant_torque();
  c.drive.jumps = {{"early", -2.0, fit::SpinJump::Of::body_momentum, {0.02, 0.1, -0.03}},
                   {"turn", 3.0, fit::SpinJump::Of::rate, {0.1, -0.2, 0.05}},
                   {"push", 4.5, fit::SpinJump::Of::inertial_momentum, {-0.04, 0.1, 0.1}}};
  return c;
}

std::vector<DrivenColumn> all_columns(const fit::SpinDrive& drive) {
  using enum fit::detail::DrivenColumn::Of;
  std::vector<DrivenColumn> found;
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3& e : axes) found.push_back({turn, 0, e});
  for (const Vec3& e : axes) found.push_back({rate, 0, e});
  for (std::size_t k = 0; k < 2; ++k) found.push_back({ratio, k, {}});
  for (std::size_t k = 0; k < drive.parameters.size(); ++k) found.push_back({torque, k, {}});
  for (std::size_t j = 0; j < drive.jumps.size(); ++j) {
    for (const Vec3& e : axes) found.push_back({jump, j, e});
  }
  return found;
}

WideSpin wide_spin(const Case& c) {
  const Quaternion& q = c.start.q;
  const Mat3& T = c.start.inertia_F;
  WideSpin s{{q.w, q.x, q.y, q.z}, wide(c.start.w_F), {T(0, 0), T(1, 1), T(2, 2)}, {}, {}};
  Wide n = 0;
  for (const Wide& x : s.q) n += x * x;
  for (Wide& x : s.q) x /= sqrt(n);
  for (const fit::TorqueParameter& one : c.drive.parameters) s.parameters.emplace_back(one.start);
  for (const fit::SpinJump& one : c.drive.jumps) s.changes.push_back(wide(one.change));
  return s;
}

WideSpin changed(WideSpin s, const DrivenColumn& by, const Wide& h) {
  const WideVec3 e = wide(by.axis_F);
  switch (by.of) {
    case DrivenColumn::Of::turn: {
      const auto q = s.q;
      const Wide half = h / 2, c = 1 - half * half / 2;
      s.q[0] = c * q[0] - half * (q[1] * e[0] + q[2] * e[1] + q[3] * e[2]);
      const WideVec3 v = crossed({q[1], q[2], q[3]}, e);
      for (std::size_t i = 0; i < 3; ++i) s.q[i + 1] = c * q[i + 1] + half * (q[0] * e[i] + v[i]);
      break;
    }
    case DrivenColumn::Of::rate:
      for (std::size_t i = 0; i < 3; ++i) s.w[i] += h * e[i];
      break;
    case DrivenColumn::Of::ratio:
      s.moments[by.index] += h;
      break;
    case DrivenColumn::Of::torque:
      s.parameters[by.index] += h;
      break;
    case DrivenColumn::Of::jump:
      for (std::size_t i = 0; i < 3; ++i) s.changes[by.index][i] += h * e[i];
  }
  return s;
}

// Against the greatest of its column; columns of torques that have not acted are 0.
void expect_derivatives(const Case& c, const std::vector<double>& times) {
  const std::vector<DrivenColumn> columns = all_columns(c.drive);
  std::vector<double> parameters;
  std::vector<Vec3> changes;
  for (const fit::TorqueParameter& one : c.drive.parameters) parameters.push_back(one.start);
  for (const fit::SpinJump& one : c.drive.jumps) changes.push_back(one.change);
  const fit::detail::DrivenMotion motion(c.drive, c.start, parameters, changes);
  motion.require_affine(times, true);
  const auto points = motion.at(times, columns);
  ASSERT_TRUE(points);
  const Wide h("1e-9");
  const WideSpin s = wide_spin(c);
  Worst<> values, derivatives;
  for (std::size_t n = 0; n < times.size(); ++n) {
    const auto at = [&](const WideSpin& of) {
      return moved(of, c.torque, c.drive.jumps, times[n]);
    };
    const WidePoint exact = at(s);
    const fit::detail::MovedPoint& found = (*points)[n];
    const Quaternion q{double(exact.q[0]), double(exact.q[1]), double(exact.q[2]),
                       double(exact.q[3])};
    values.add(norm(fit::attitude_residual(q, found.q)));
    for (int i = 0; i < 3; ++i) {
      values.add(std::abs(double(exact.w[std::size_t(i)]) - found.w_F[i]));
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const WidePoint a = at(changed(s, columns[k], h)), b = at(changed(s, columns[k], -h));
      // 2 vec(q* dq)
      std::array<Wide, 4> d;
      for (std::size_t i = 0; i < 4; ++i) d[i] = (a.q[i] - b.q[i]) / h;
      const auto& p = exact.q;
      const WideVec3 v = crossed({p[1], p[2], p[3]}, {d[1], d[2], d[3]});
      double size = 0.0, error = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double turn = double(p[0] * d[i + 1] - d[0] * p[i + 1] - v[i]);
        const double rate = double((a.w[i] - b.w[i]) / (2 * h));
        size = larger(size, std::abs(turn), std::abs(rate));
        error = larger(error, std::abs(turn - found.turn[k][int(i)]),
                       std::abs(rate - found.rate[k][int(i)]));
      }
      derivatives.add(size > 0.0 ? error / size : error,
                      "column " + std::to_string(k) + " at " + std::to_string(times[n]));
    }
  }
  EXPECT_LE(values.value(), budget::fit_driven_motion) << values.where();
  EXPECT_LE(derivatives.value(), budget::fit_driven_derivatives) << derivatives.where();
}

TEST(DrivenMotion, ConstantTorque) { expect_derivatives(constant_torque(), {6.0, -3.0}); }
TEST(DrivenMotion, EddyCurrents) { expect_derivatives(eddy_currents(), {5.0}); }
TEST(DrivenMotion, Flyby) { expect_derivatives(flyby(), {9.0}); }
TEST(DrivenMotion, Jumps) { expect_derivatives(jumps(), {6.0, 3.0, -2.0, -4.0}); }

// Of times before and after, and of those of jumps: what is seen there is before them.
TEST(DrivenMotion, WithoutDriveItIsFree) {
  Case c = constant_torque();
  c.drive = {};
  const fit::detail::DrivenMotion motion(c.drive, c.start, {}, {});
  const std::vector<double> times{7.0, 0.0, -3.0, 7.0};
  std::vector<fit::detail::MotionPoint> free;
  ASSERT_TRUE(fit::detail::free_motion(c.start, times, {}, free));
  const auto points = motion.at(times, {});
  ASSERT_TRUE(points);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_LE(norm(fit::attitude_residual((*points)[i].q, free[i].q)), budget::fit_driven_motion);
  }
}

// What is seen at the time of a jump is before it, on both ways.
TEST(DrivenLegs, SeeBeforeTheJump) {
  const std::vector<fit::SpinJump> jumps{{"a", -3.0, fit::SpinJump::Of::rate, {}},
                                         {"b", 2.0, fit::SpinJump::Of::rate, {}}};
  const std::vector<double> times{-5.0, -3.0, 2.0, 4.0};
  double undone = 0.0;
  std::size_t seen = 0;
  for (const fit::detail::DrivenLeg& leg : fit::detail::driven_legs(times, 0.0, jumps)) {
    if (leg.is_first) undone = 0.0;
    for (std::size_t i = 0; i < leg.asked; ++i) {
      const double t = leg.times[i];
      ++seen;
      EXPECT_EQ(undone, t == -3.0 || t == -5.0 || t == 4.0 ? 1.0 : 0.0) << t;
    }
    if (leg.jump) undone += 1.0;
  }
  EXPECT_EQ(seen, times.size());
}

// A torque that names breakpoints, some at the times of jumps and observations, where it is smooth.
TEST(DrivenMotion, EdgesAtTheTimesOfJumpsChangeNothing) {
  struct Edged : ConstantTorque {
    std::vector<double> breakpoints() const { return {-3.0, -2.0, 1.0, 3.0, 4.5}; }
  };
  const Case smooth = jumps();
  Case edged = smooth;
  edged.drive.terms = [](std::span<const double> p) {
    return std::vector<AnyPerturbation>{
        {"body", Edged{ConstantTorque::in_body({p[0], p[1], p[2]})}},
        {"space", ConstantTorque::in_space({p[3], p[4], 0.003})}};
  };
  const std::vector<double> times{6.0, 3.0, 1.0, -2.0, -4.0};
  std::vector<double> parameters;
  std::vector<Vec3> changes;
  for (const fit::TorqueParameter& one : smooth.drive.parameters) parameters.push_back(one.start);
  for (const fit::SpinJump& one : smooth.drive.jumps) changes.push_back(one.change);
  const std::vector<DrivenColumn> columns = all_columns(smooth.drive);
  const auto points_of = [&](const Case& c) {
    return fit::detail::DrivenMotion(c.drive, c.start, parameters, changes)
        .at(times, columns)
        .value();
  };
  const auto expected = points_of(smooth), found = points_of(edged);
  for (std::size_t n = 0; n < times.size(); ++n) {
    EXPECT_LE(norm(fit::attitude_residual(expected[n].q, found[n].q)), budget::fit_driven_motion);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double size = norm(expected[n].turn[k]) + norm(expected[n].rate[k]);
      const double apart = norm(found[n].turn[k] - expected[n].turn[k]) +
                           norm(found[n].rate[k] - expected[n].rate[k]);
      EXPECT_LE(apart, budget::fit_driven_derivatives * size) << times[n] << " " << k;
    }
  }
}

}  // namespace
