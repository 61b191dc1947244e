// SPDX-License-Identifier: MIT
// Fits of the spin state of a driven body to snapshots.
#include "polhode/fit/driven_spin_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fit/detail/rotation_vector.hpp"
#include "fit/detail/snapshot_residuals.hpp"
#include "fit/detail/spin_uncertainty.hpp"
#include "fit/driven/driven_motion.hpp"
#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {
namespace {

// Residuals of snapshots of a driven body, and what their unknowns are.
class DrivenResiduals {
 public:
  DrivenResiduals(const SpinFit& fit, const SpinDrive& drive);

  // In order, with their starts and bounds: those of the state, of torques, of jumps.
  std::vector<Unknown> unknowns() const;
  // Where the two ratios of moments are, if they are unknown.
  std::optional<TriangleBound> triangle() const;

  // At unknowns x about the start of the fit.
  SpinState state(std::span<const double> x) const;
  SpinDrive drive(std::span<const double> x) const;
  std::vector<DrivenColumn> columns(std::span<const double> x) const;
  bool at(std::span<const double> x, std::span<double> numbers, std::span<double> jacobian) const;
  double attitude_rms(std::span<const double> x) const;

  const SnapshotRows& rows() const { return rows_; }

 private:
  // None where the drive takes no such numbers, or leads nowhere.
  std::optional<std::vector<MovedPoint>> moved(std::span<const double> x,
                                               std::span<const DrivenColumn> columns) const;

  SpinFit fit_;
  SpinDrive drive_;
  std::vector<std::size_t> parameters_;  // of the state
  SnapshotRows rows_;
};

Vec3 unit_vector(std::size_t k) {
  Vec3 e;
  e[static_cast<int>(k)] = 1.0;
  return e;
}

std::vector<Vec3> changes_of(const SpinDrive& drive) {
  std::vector<Vec3> found;
  for (const SpinJump& jump : drive.jumps) found.push_back(jump.change);
  return found;
}

std::vector<double> starts_of(const SpinDrive& drive) {
  std::vector<double> found;
  for (const TorqueParameter& one : drive.parameters) found.push_back(one.start);
  return found;
}

DrivenResiduals::DrivenResiduals(const SpinFit& fit, const SpinDrive& drive)
    : fit_(fit),
      drive_(drive),
      parameters_(parameters_of(fit.unknowns)),
      rows_(fit.seen, fit.attitude_prior) {}

std::vector<Unknown> DrivenResiduals::unknowns() const {
  std::vector<Unknown> found;
  for (const std::size_t p : parameters_) {
    Unknown u;
    u.name = parameter_name(p);
    u.start = parameter_of(fit_.start, p);
    found.push_back(u);
  }
  for (const TorqueParameter& one : drive_.parameters) {
    found.push_back({one.name, one.start, one.low, one.high});
  }
  for (const SpinJump& jump : drive_.jumps) {
    for (int k = 0; k < 3; ++k) {
      Unknown u;
      u.name = jump.name + "[" + std::to_string(k) + "]";
      u.start = jump.change[k];
      found.push_back(u);
    }
  }
  return found;
}

std::optional<TriangleBound> DrivenResiduals::triangle() const {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (parameters_[i] == first_ratio) return TriangleBound{i, i + 1};
  }
  return std::nullopt;
}

SpinState DrivenResiduals::state(std::span<const double> x) const {
  return state_at(fit_.start, parameters_, x);
}

SpinDrive DrivenResiduals::drive(std::span<const double> x) const {
  SpinDrive found = drive_;
  std::size_t i = parameters_.size();
  for (TorqueParameter& one : found.parameters) one.start = x[i++];
  for (SpinJump& jump : found.jumps) {
    for (int k = 0; k < 3; ++k) jump.change[k] = x[i++];
  }
  return found;
}

std::vector<DrivenColumn> DrivenResiduals::columns(std::span<const double> x) const {
  using enum DrivenColumn::Of;
  // Turns about the start move the attitude by this times themselves.
  Mat3 of_turn = Mat3::identity();
  if (fit_.unknowns.attitude) of_turn = exp_derivative({x[0], x[1], x[2]});
  std::vector<DrivenColumn> found;
  for (const std::size_t p : parameters_) {
    if (p < first_rate)
      found.push_back({turn, 0, of_turn * unit_vector(p)});
    else if (p < first_ratio)
      found.push_back({rate, 0, unit_vector(p - first_rate)});
    else
      found.push_back({ratio, p - first_ratio, {}});
  }
  for (std::size_t k = 0; k < drive_.parameters.size(); ++k) found.push_back({torque, k, {}});
  for (std::size_t j = 0; j < drive_.jumps.size(); ++j) {
    for (std::size_t k = 0; k < 3; ++k) found.push_back({jump, j, unit_vector(k)});
  }
  return found;
}

std::optional<std::vector<MovedPoint>> DrivenResiduals::moved(
    std::span<const double> x, std::span<const DrivenColumn> columns) const {
  const SpinDrive at = drive(x);
  try {
    return DrivenMotion(at, state(x), starts_of(at), changes_of(at)).at(rows_.times(), columns);
  } catch (const DomainError&) {
    return std::nullopt;  // a trial step to a body or a torque that there is not
  }
}

bool DrivenResiduals::at(std::span<const double> x, std::span<double> numbers,
                         std::span<double> jacobian) const {
  std::vector<DrivenColumn> by;
  if (!jacobian.empty()) by = columns(x);
  const auto points = moved(x, by);
  if (!points) return false;
  const SpinState s = state(x);
  MovedPoint t0{s.q, s.w_F, {}, {}};
  for (const DrivenColumn& column : columns(x)) {
    t0.turn.push_back(column.of == DrivenColumn::Of::turn ? column.axis_F : Vec3{});
  }
  rows_.at(*points, t0, numbers, jacobian);
  return true;
}

double DrivenResiduals::attitude_rms(std::span<const double> x) const {
  const auto points = moved(x, {});
  if (!points) return std::numeric_limits<double>::quiet_NaN();
  std::vector<Quaternion> attitudes;
  for (const MovedPoint& point : *points) attitudes.push_back(point.q);
  return rows_.attitude_rms(attitudes);
}

}  // namespace
}  // namespace detail

namespace {

constexpr const char* function = "fit_driven_spin";
// As in fit_spin.
constexpr double far_turn = 1.0;
constexpr int most_recentrings = 20;

[[noreturn]] void refuse(const std::string& what) {
  throw DomainError(std::string(function) + ": " + what);
}

void require_state(const SpinFit& fit, const SpinDrive& drive) {
  const SpinState& s = fit.start;
  const double size = std::hypot(std::hypot(s.q.w, s.q.x), std::hypot(s.q.y, s.q.z));
  if (!std::isfinite(s.t0) || !std::isfinite(size) || !(size > 0.0) ||
      !polhode::detail::is_finite(s.w_F)) {
    refuse("the start, t0 = " + polhode::detail::number_text(s.t0) + ", quaternion " +
           polhode::detail::tuple_text({s.q.w, s.q.x, s.q.y, s.q.z}) + " and rate " +
           polhode::detail::tuple_text({s.w_F.x, s.w_F.y, s.w_F.z}) +
           ", must be finite, the quaternion not 0");
  }
  if (fit.unknowns.products) {
    refuse("products of inertia are no unknowns of a driven body; fix them");
  }
  if (fit.unknowns.moment_ratios && !(drive.q_FB == Quaternion{})) {
    refuse(
        "the ratios of moments are no unknowns of a tensor with products of inertia, or in "
        "other axes than the principal ones, of a driven body; fix them");
  }
  for (const NormalPrior& prior : fit.priors) {
    for (const std::string& name : prior.unknowns) {
      if (name.starts_with("turn_")) {
        refuse("a prior of " + name + "; that of the attitude is given as attitude_prior");
      }
    }
  }
  if (!fit.attitude_prior) return;
  if (!fit.unknowns.attitude)
    refuse("a prior of the attitude, which is not an unknown of this fit");
  ObservedAttitude prior = *fit.attitude_prior;
  prior.t = s.t0;
  check(Snapshots{{prior}, {}, {}, {}});
}

void require_drive(const SpinFit& fit, const SpinDrive& drive) {
  if (!drive.terms && !drive.parameters.empty()) {
    refuse("parameters without a function that makes terms of them");
  }
  for (const TorqueParameter& one : drive.parameters) {
    if (!std::isfinite(one.start)) {
      refuse(one.name + " = " + polhode::detail::number_text(one.start) +
             " at the start; expected a finite "
             "number");
    }
  }
  const std::vector<double> times = times_of(fit.seen);
  if (times.empty()) refuse("there are no observations");
  const auto [first, last] = std::ranges::minmax(times);
  for (const SpinJump& jump : drive.jumps) {
    if (!(jump.t >= first && jump.t < last)) {
      refuse(jump.name + " at t = " + polhode::detail::number_text(jump.t) +
             "; expected a time from the first observation on, " +
             polhode::detail::number_text(first) + ", and before the last one, " +
             polhode::detail::number_text(last));
    }
    if (!polhode::detail::is_finite(jump.change)) {
      refuse(jump.name + " begins with a change that is not finite");
    }
  }
  const detail::DrivenMotion motion(drive, fit.start, detail::starts_of(drive),
                                    detail::changes_of(drive));
  motion.require_affine(times, fit.unknowns.moment_ratios);
  motion.require_no_jumps(times);
}

auto numbers_of(const detail::DrivenResiduals& residuals) {
  return [residuals](std::span<const double> x, std::span<double> numbers,
                     std::span<double> jacobian) { return residuals.at(x, numbers, jacobian); };
}

LeastSquares problem_of(const SpinFit& fit, const SpinDrive& drive) {
  const detail::DrivenResiduals residuals(fit, drive);
  LeastSquares p;
  p.unknowns = residuals.unknowns();
  if (p.unknowns.empty()) {
    refuse("nothing is unknown; expected attitude, rate, moments, parameters or jumps");
  }
  p.triangle = residuals.triangle();
  p.residuals.data = fit.seen.numbers();
  p.residuals.prior = fit.attitude_prior ? 3 : 0;
  p.residuals.blocks = residuals.rows().blocks();
  p.residuals.at = numbers_of(residuals);
  p.priors = fit.priors;
  p.loss = fit.loss;
  p.error_factor = fit.error_factor;
  p.most_iterations = fit.most_iterations;
  return p;
}

double size_of_turn(const SpinFit& fit, const std::vector<double>& x) {
  return fit.unknowns.attitude ? norm(Vec3{x[0], x[1], x[2]}) : 0.0;
}

// The motion of a solution.
detail::DrivenMotion motion_of(const SpinDrive& solved, const SpinSolution& solution) {
  return {solved, solution.state, detail::starts_of(solved), detail::changes_of(solved)};
}

SpinSolution fitted(const SpinFit& fit, const SpinDrive& drive) {
  SpinFit about = fit;
  SpinDrive driven = drive;
  SpinSolution found;
  int iterations = 0, evaluations = 0;
  LeastSquares problem;
  for (int round = 0; round < most_recentrings; ++round) {
    problem = problem_of(about, driven);
    found.result = fit.scales_errors ? solve_scaled(problem) : solve(problem);
    iterations += found.result.iterations;
    evaluations += found.result.evaluations;
    const detail::DrivenResiduals residuals(about, driven);
    about.start = residuals.state(found.result.x);
    driven = residuals.drive(found.result.x);
    about.error_factor = problem.error_factor;
    const bool is_far = size_of_turn(fit, found.result.x) > far_turn;
    if (!is_far || found.result.end == LeastSquaresResult::End::no_value) break;
  }
  found.result.iterations = iterations;
  found.result.evaluations = evaluations;
  found.state = about.start;
  found.error_factor = problem.error_factor;
  // The same numbers with turns about what was found.
  const detail::DrivenResiduals residuals(about, driven);
  problem.residuals.at = numbers_of(residuals);
  if (fit.unknowns.attitude) std::fill_n(found.result.x.begin(), 3, 0.0);
  found.covariance = covariance(problem, found.result);
  found.degrees_of_freedom = degrees_of_freedom(problem, found.result);
  found.attitude_rms = residuals.attitude_rms(found.result.x);
  found.notes = repeated(fit.seen);
  std::ranges::move(notes_on_errors(problem, found.result, found.covariance),
                    std::back_inserter(found.notes));
  return found;
}

}  // namespace

SpinSolution fit_driven_spin(const SpinFit& fit, const SpinDrive& drive) {
  check(fit.seen);
  require_state(fit, drive);
  require_drive(fit, drive);
  return detail::with_undetermined_moments(
      fit, fitted(fit, drive), [&](const SpinFit& other) { return fitted(other, drive); });
}

LeastSquares least_squares_of(const SpinFit& fit, const SpinDrive& drive) {
  check(fit.seen);
  require_state(fit, drive);
  require_drive(fit, drive);
  return problem_of(fit, drive);
}

SpinState state_at(const SpinFit& fit, const SpinDrive& drive, std::span<const double> x) {
  const detail::DrivenResiduals residuals(fit, drive);
  const std::size_t n = residuals.unknowns().size();
  if (x.size() != n)
    throw DomainError("state_at: got " + std::to_string(x.size()) + " unknowns; expected " +
                      std::to_string(n));
  return residuals.state(x);
}

SpinDrive solved_drive(const SpinFit& fit, const SpinDrive& drive, const SpinSolution& solution) {
  return detail::DrivenResiduals(fit, drive).drive(solution.result.x);
}

std::vector<double> unknowns_at(const SpinFit& fit, const SpinDrive& drive, const SpinState& about,
                                const SpinSolution& solution) {
  std::vector<double> x = unknowns_at(fit, about, solution.state);
  const std::size_t tail = drive.parameters.size() + 3 * drive.jumps.size();
  x.insert(x.end(), solution.result.x.end() - static_cast<std::ptrdiff_t>(tail),
           solution.result.x.end());
  return x;
}

std::vector<PredictedAttitude> predicted(const SpinFit& fit, const SpinDrive& drive,
                                         const SpinSolution& solution,
                                         std::span<const double> times) {
  const SpinDrive solved = solved_drive(fit, drive, solution);
  SpinFit about = fit;
  about.start = solution.state;
  if (!solution.held.empty()) about.unknowns.moment_ratios = false;
  const std::vector<double> x(solution.result.x);
  const std::vector<detail::DrivenColumn> columns =
      detail::DrivenResiduals(about, solved).columns(x);
  const auto points = motion_of(solved, solution).at(times, columns);
  if (!points) {
    throw DomainError(
        "predicted: the motion of the solution does not reach all of the times, or "
        "has no derivatives there");
  }
  const UnknownsCovariance known = solution.covariance.without(solution.held);
  std::vector<PredictedAttitude> found;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const detail::MovedPoint& point = (*points)[i];
    found.push_back({times[i], point.q, point.w_F, detail::turn_covariance(point.turn, known)});
  }
  return found;
}

std::vector<PredictedAttitude> driven_attitudes(const SpinState& start, const SpinDrive& drive,
                                                std::span<const double> times) {
  const detail::DrivenMotion motion(drive, start, detail::starts_of(drive),
                                    detail::changes_of(drive));
  const auto points = motion.at(times, {});
  if (!points) {
    throw DomainError("driven_attitudes: the motion does not reach all of the times");
  }
  std::vector<PredictedAttitude> found;
  for (std::size_t i = 0; i < times.size(); ++i) {
    found.push_back({times[i], (*points)[i].q, (*points)[i].w_F, Mat3{}});
  }
  return found;
}

SpinState after_jumps(const SpinFit& fit, const SpinDrive& drive, const SpinSolution& solution) {
  const SpinDrive solved = solved_drive(fit, drive, solution);
  const auto state = motion_of(solved, solution).after_jumps();
  if (!state) {
    throw DomainError(
        "after_jumps: the motion of the solution does not reach its last jump and "
        "come back");
  }
  return *state;
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
