// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "fit/detail/snapshot_residuals.hpp"
#include "fit/detail/spin_uncertainty.hpp"
#include "fit/free_motion.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace {

using detail::spin_parameters;

// How much of each parameter of a spin state one unknown is.
using Parts = std::array<double, spin_parameters>;

Parts parts_of(std::string_view unknown) {
  Parts parts{};
  for (std::size_t j = 0; j < spin_parameters; ++j)
    if (unknown == detail::parameter_name(j)) parts[j] = 1.0;
  return parts;
}

// Ixx/Izz = (b^2 + c^2) / (1 + b^2), Iyy/Izz = (1 + c^2) / (1 + b^2) by b/a, and by c/b.
Parts parts_of_shape(std::string_view unknown, const light::Ellipsoid& shape) {
  const double b = shape.b / shape.a, ratio = shape.c / shape.b, c = b * ratio;
  const double whole = 1.0 + b * b;
  const double X = (b * b + c * c) / whole, Y = (1.0 + c * c) / whole;
  Parts parts = parts_of(unknown);
  const double by_c = 2.0 * c / whole;
  if (unknown == "b/a") {
    parts[detail::first_ratio] = 2.0 * b * (1.0 - X) / whole + ratio * by_c;
    parts[detail::first_ratio + 1] = -2.0 * b * Y / whole + ratio * by_c;
  } else if (unknown == "c/b") {
    parts[detail::first_ratio] = parts[detail::first_ratio + 1] = b * by_c;
  }
  return parts;
}

std::vector<Parts> parts_of(const LightSolution& solution, const LightUnknowns& unknowns) {
  std::vector<Parts> parts;
  for (const std::string& name : solution.covariance.names)
    parts.push_back(solution.body.is_ellipsoid() && unknowns.moments == MomentSource::shape
                        ? parts_of_shape(name, solution.body.ellipsoid())
                        : parts_of(name));
  return parts;
}

// What each parameter adds to the momentum, in axes F and units of Izz.
std::array<Vec3, spin_parameters> momentum_changes(const SpinState& s) {
  const double unit = s.inertia_F(2, 2);
  const Vec3 L = (1.0 / unit) * (s.inertia_F * s.w_F);
  std::array<Vec3, spin_parameters> found;
  constexpr int places[5][2] = {{0, 0}, {1, 1}, {0, 1}, {1, 2}, {0, 2}};
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 e;
    e[static_cast<int>(k)] = 1.0;
    found[k] = cross(e, L);
    found[detail::first_rate + k] = (1.0 / unit) * (s.inertia_F * e);
  }
  for (std::size_t j = 0; j < 5; ++j) {
    Mat3 dT;
    dT(places[j][0], places[j][1]) = dT(places[j][1], places[j][0]) = 1.0;
    found[detail::first_ratio + j] = dT * s.w_F;
  }
  return found;
}

constexpr double unbounded = std::numeric_limits<double>::infinity();

// Whether it depends on an unknown that the data do not determine.
bool is_open(const std::vector<double>& a, const UnknownsCovariance& c) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::fabs(a[i]) > 0.0 && c.variance(i) == unbounded) return true;
  return false;
}

// Of neither open.
double product(const std::vector<double>& a, const UnknownsCovariance& c,
               const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (a[i] != 0.0 && b[j] != 0.0) sum += a[i] * c.matrix[i * a.size() + j] * b[j];
  return sum;
}

double error_of(const std::vector<double>& a, const UnknownsCovariance& c) {
  return is_open(a, c) ? unbounded : std::sqrt(product(a, c, a));
}

FreeRotation motion_of(const SpinState& s) {
  const Vec3 L = (1.0 / s.inertia_F(2, 2)) * (s.inertia_F * s.w_F);
  if (!(norm(L) > 0.0))
    throw DomainError("derived_parameters: the momentum " +
                      polhode::detail::tuple_text({L.x, L.y, L.z}) + " must not be 0");
  return detail::free_rotation_of(s);
}

class Figures {
 public:
  Figures(const SpinState& state, const UnknownsCovariance& c, const std::vector<Parts>& parts)
      : state_(state), c_(c), parts_(parts), motion_(motion_of(state)) {}

  DerivedParameters found() {
    DerivedParameters f{};
    f.periods.mode = motion_.regime();
    add_periods(f);
    add_pole(f);
    return f;
  }

 private:
  // df/dx of the unknowns from that of the parameters.
  template <class ByParameter>
  std::vector<double> by_unknown(const ByParameter& by) const {
    std::vector<double> found;
    for (const Parts& parts : parts_) {
      double sum = 0.0;
      for (std::size_t j = 0; j < spin_parameters; ++j)
        if (parts[j] != 0.0) sum += parts[j] * by(j);
      found.push_back(sum);
    }
    return found;
  }

  void add_periods(DerivedParameters& f) const {
    const Regime mode = motion_.regime();
    if (mode != Regime::short_axis && mode != Regime::long_axis) return;
    const double turn = 2.0 * pi<double>();
    const double P_phi = f.periods.precession_period = turn / motion_.precession_rate_long();
    const double P_psi = f.periods.rotation_period = motion_.polhode_period();
    const detail::RateDerivatives d = detail::rate_derivatives(state_);
    // Axis 1 of the arc is the long axis in short-axis mode; the short one in long-axis mode, which
    // goes round faster by a turn in P_psi.
    const bool is_long = mode == Regime::long_axis;
    const double rate1 = is_long ? motion_.precession_rate_short() : motion_.precession_rate_long();
    const std::vector<double>& by_psi = f.rotation_slope =
        by_unknown([&](std::size_t j) { return P_psi * d.period[j]; });
    const std::vector<double>& by_phi = f.precession_slope = by_unknown([&](std::size_t j) {
      const double rate = rate1 * d.precession[j] + (is_long ? turn / P_psi * d.period[j] : 0.0);
      return -P_phi * P_phi / turn * rate;
    });
    f.precession_error = error_of(by_phi, c_);
    f.rotation_error = error_of(by_psi, c_);
    // 1/P_short = 1/P_phi + 1/P_psi
    f.short_period = turn / motion_.precession_rate_short();
    std::vector<double> by_short(by_phi.size());
    for (std::size_t i = 0; i < by_short.size(); ++i)
      by_short[i] = f.short_period * f.short_period *
                    (by_phi[i] / (P_phi * P_phi) + by_psi[i] / (P_psi * P_psi));
    f.short_error = error_of(by_short, c_);
    f.correlation = product(by_phi, c_, by_psi) / (f.precession_error * f.rotation_error);
  }

  void add_pole(DerivedParameters& f) const {
    const Vec3 L = inertial_momentum(motion_.initial_state());
    const double size = norm(L);
    f.pole_I = (1.0 / size) * L;
    const Vec3 other = std::fabs(f.pole_I.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
    const Vec3 east = (1.0 / norm(cross(other, f.pole_I))) * cross(other, f.pole_I);
    const Vec3 north = cross(f.pole_I, east);
    const std::array<Vec3, spin_parameters> change = momentum_changes(state_);
    const Quaternion q = normalized(state_.q);
    const double scale = norm((1.0 / state_.inertia_F(2, 2)) * (state_.inertia_F * state_.w_F));
    const auto along = [&](const Vec3& e) {
      return by_unknown([&](std::size_t j) { return dot(e, rotate(q, change[j])) / scale; });
    };
    const std::vector<double> x = along(east), y = along(north);
    if (is_open(x, c_) || is_open(y, c_)) {
      f.pole_major = f.pole_minor = unbounded;
      f.major_I = is_open(x, c_) ? east : north;
      return;
    }
    const double xx = product(x, c_, x), yy = product(y, c_, y), xy = product(x, c_, y);
    const double mean = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
    f.pole_major = std::sqrt(mean + apart);
    f.pole_minor = mean - apart < 0.0 ? 0.0 : std::sqrt(mean - apart);
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    f.major_I = std::cos(angle) * east + std::sin(angle) * north;
  }

  const SpinState& state_;
  const UnknownsCovariance& c_;
  const std::vector<Parts>& parts_;
  FreeRotation motion_;
};

}  // namespace

DerivedParameters derived_parameters(const SpinState& state, const UnknownsCovariance& covariance) {
  std::vector<Parts> parts;
  for (const std::string& name : covariance.names) parts.push_back(parts_of(name));
  return Figures(state, covariance, parts).found();
}

DerivedParameters derived_parameters(const LightSolution& solution, const LightUnknowns& unknowns) {
  const std::vector<Parts> parts = parts_of(solution, unknowns);
  return Figures(solution.body.spin, solution.covariance, parts).found();
}

DerivedParameters derived_parameters(const SpinSolution& solution) {
  DerivedParameters f =
      derived_parameters(solution.state, solution.covariance.without(solution.held));
  if (solution.held.empty()) return f;
  f.rotation_error = unbounded;
  f.correlation = std::numeric_limits<double>::quiet_NaN();
  return f;
}

std::vector<PredictedAttitude> predicted(const LightSolution& solution,
                                         const LightUnknowns& unknowns,
                                         std::span<const double> times) {
  const std::vector<Parts> parts = parts_of(solution, unknowns);
  const std::vector<double> at(times.begin(), times.end());
  std::vector<detail::MotionPoint> points;
  if (!detail::free_motion(solution.body.spin, at, {true, false}, points))
    throw DomainError(
        "predicted: the state of the solution is none that a body may have, or its motion has no "
        "derivatives");
  std::vector<PredictedAttitude> found;
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::vector<Vec3> turn(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (std::size_t j = 0; j < spin_parameters; ++j)
        if (parts[k][j] != 0.0) turn[k] = turn[k] + parts[k][j] * points[i].turn[j];
    found.push_back(
        {at[i], points[i].q, points[i].w_F, detail::turn_covariance(turn, solution.covariance)});
  }
  return found;
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
