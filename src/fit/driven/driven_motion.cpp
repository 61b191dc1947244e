// SPDX-License-Identifier: MIT
// The motion of a driven body, leg by leg between jumps, with derivatives by its unknowns.
#include "fit/driven/driven_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/adaptive/adaptive_stepper.hpp"
#include "dynamics/sampled_run.hpp"
#include "fit/driven/sensitivity_field.hpp"
#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

std::vector<DrivenLeg> driven_legs(std::span<const double> times, double t0,
                                   const std::vector<SpinJump>& jumps) {
  std::vector<DrivenLeg> legs;
  for (const double side : {1.0, -1.0}) {
    // A jump acts just after its time: at t0 on the way forwards.
    const auto is_here = [&](double t) { return side > 0.0 ? t >= t0 : t < t0; };
    std::vector<double> wanted;
    for (const double t : times) {
      if (is_here(t)) wanted.push_back(side * t);
    }
    if (wanted.empty()) continue;
    std::ranges::sort(wanted);
    wanted.erase(std::ranges::unique(wanted).begin(), wanted.end());
    const double last = wanted.back();
    std::vector<std::pair<double, std::optional<std::size_t>>> ends;
    for (std::size_t j = 0; j < jumps.size(); ++j) {
      const double t = jumps[j].t;
      // Forwards what is seen at its time is before it, backwards too, which is after undoing it.
      if (is_here(t) && (side > 0.0 ? t < last : -t <= last)) ends.emplace_back(side * t, j);
    }
    std::ranges::sort(ends);
    ends.emplace_back(last, std::nullopt);
    double from = side * t0;
    std::size_t next = 0;
    for (std::size_t e = 0; e < ends.size(); ++e) {
      const auto& [to, jump] = ends[e];
      DrivenLeg leg{side * from, side * to, {}, 0, jump, e == 0};
      while (next < wanted.size() &&
             (wanted[next] < to || (wanted[next] == to && (side > 0.0 || !jump)))) {
        leg.times.push_back(side * wanted[next++]);
      }
      leg.asked = leg.times.size();
      if (leg.times.empty() || leg.times.back() != leg.to) leg.times.push_back(leg.to);
      legs.push_back(std::move(leg));
      from = to;
    }
  }
  return legs;
}

namespace {

constexpr const char* motion_function = "fit_driven_spin";
// Of the tensor, off the axes of the terms.
constexpr double diagonal_to = 1e-9;

System system_of(const SpinDrive& drive, const SpinState& start, const Mat3& R,
                 std::span<const double> parameters) {
  const Mat3 T = transpose(R) * (start.inertia_F * R);
  const double size = std::abs(T(0, 0)) + std::abs(T(1, 1)) + std::abs(T(2, 2));
  const double off = std::abs(T(0, 1)) + std::abs(T(1, 2)) + std::abs(T(0, 2));
  if (!(off <= diagonal_to * size)) {
    throw DomainError(std::string(motion_function) + ": the tensor has products " +
                      polhode::detail::tuple_text({T(0, 1), T(1, 2), T(0, 2)}) +
                      " in the axes of the terms; expected none: give q_FB");
  }
  const Body body = R == Mat3::identity() ? Body(T(0, 0), T(1, 1), T(2, 2))
                                          : Body::with_axes({T(0, 0), T(1, 1), T(2, 2)}, {});
  return System(body, Frame::inertial(),
                drive.terms ? drive.terms(parameters) : std::vector<AnyPerturbation>{});
}

Vec3 in_body(const Mat3& R, const Vec3& x_F) { return transpose(R) * x_F; }

// What a jump does to the momentum, in principal axes.
template <Real T>
BasicVec3<T> momentum_of(SpinJump::Of of, const BasicVec3<T>& change, const BasicVec3<T>& moments,
                         const BasicRotorState<T>& s) {
  if (of == SpinJump::Of::rate) {
    return {moments.x * change.x, moments.y * change.y, moments.z * change.z};
  }
  return of == SpinJump::Of::body_momentum ? change
                                           : body_from_reference(BasicPose<T>{moments, s}, change);
}

// The samples of a run; none where it failed or ends in no numbers.
template <class S>
using LegSamples = std::optional<std::vector<BasicSample<S>>>;

template <class S>
LegSamples<S> samples_of(BasicTrajectory<S> run, const DrivenLeg& leg) {
  if (!run.outcome().ok() || run.samples().size() != leg.times.size()) return std::nullopt;
  return std::move(run).samples();
}
LegSamples<SystemState> samples_of(const Problem& problem, const DrivenLeg& leg) {
  if (leg.from == leg.to) return {{{leg.from, problem.initial}}};
  return samples_of(integrate(problem, Keep{SaveAt::times(leg.times), false}), leg);
}
LegSamples<TangentRotor> samples_of(std::shared_ptr<const SensitivityField> field,
                                    const TangentRotor& s, const DrivenLeg& leg, double tolerance) {
  if (leg.from == leg.to) return {{{leg.from, s}}};
  auto stepper = polhode::detail::switching_stepper(
      std::move(field), leg.from, polhode::detail::column_values(polhode::detail::rotor_values(s)),
      Adaptive{tolerance});
  auto found =
      samples_of(polhode::detail::sampled_run(std::move(stepper), "", leg.times, {}, false), leg);
  if (found && leg.times.front() == leg.from) found->front().s = s;  // not normalised
  return found;
}

// Leg by leg from t0: the samples of each by `run`, those that are asked for to `see`, and its jump
// by `jumped`. Whether all went well.
template <class S>
bool walk(std::span<const DrivenLeg> legs, double t0, const S& start, const auto& run,
          const auto& jumped, const auto& see) {
  S s = start;
  for (const DrivenLeg& leg : legs) {
    if (leg.is_first) s = start;
    const auto samples = run(s, leg);
    if (!samples) return false;
    for (std::size_t i = 0; i < leg.asked; ++i) {
      if (!see((*samples)[i])) return false;
    }
    s = samples->back().s;
    if (leg.jump) s = jumped(s, *leg.jump, leg.to >= t0 ? 1.0 : -1.0);
  }
  return true;
}

// The state at t0 with the columns of these unknowns.
TangentRotor seeded(const RotorState& s, const Body& body, double unit, const Mat3& R,
                    std::span<const DrivenColumn> six) {
  const Vec3& I = body.moments();
  BasicQuaternion<Tangent> turn{Tangent(1.0), Tangent(0.0), Tangent(0.0), Tangent(0.0)};
  BasicVec3<Tangent> g{Tangent(s.g.x), Tangent(s.g.y), Tangent(s.g.z)};
  for (std::size_t c = 0; c < six.size(); ++c) {
    const Vec3 axis = in_body(R, six[c].axis_F);
    if (six[c].of == DrivenColumn::Of::turn) {
      turn.x.derivative[c] = 0.5 * axis.x;
      turn.y.derivative[c] = 0.5 * axis.y;
      turn.z.derivative[c] = 0.5 * axis.z;
    }
    for (int k = 0; k < 3; ++k) {
      if (six[c].of == DrivenColumn::Of::rate) g[k].derivative[c] = I[k] * axis[k];
      if (six[c].of == DrivenColumn::Of::ratio && static_cast<int>(six[c].index) == k) {
        g[k].derivative[c] = unit * (s.g[k] / I[k]);
      }
    }
  }
  return {polhode::detail::constant<double, 6>(s.q) * turn, g};
}

// The rotation vectors and rates of columns, in axes F.
void put_columns(const TangentRotor& s, const BasicVec3<Tangent>& w, const Mat3& R,
                 std::size_t count, MovedPoint& point) {
  const Quaternion inverse{s.q.w.value, -s.q.x.value, -s.q.y.value, -s.q.z.value};
  for (std::size_t c = 0; c < count; ++c) {
    const Quaternion half = inverse * Quaternion{s.q.w.derivative[c], s.q.x.derivative[c],
                                                 s.q.y.derivative[c], s.q.z.derivative[c]};
    point.turn.push_back(R * Vec3{2.0 * half.x, 2.0 * half.y, 2.0 * half.z});
    point.rate.push_back(R * Vec3{w.x.derivative[c], w.y.derivative[c], w.z.derivative[c]});
  }
}

}  // namespace

// Places of times that are asked for, by time.
class DrivenMotion::Wanted {
 public:
  explicit Wanted(std::span<const double> times) {
    for (std::size_t i = 0; i < times.size(); ++i) at_.emplace_back(times[i], i);
    std::ranges::sort(at_);
  }
  void each(double t, const auto& take) const {
    auto i = std::ranges::lower_bound(at_, std::pair(t, std::size_t{0}));
    for (; i != at_.end() && i->first == t; ++i) take(i->second);
  }

 private:
  std::vector<std::pair<double, std::size_t>> at_;
};

DrivenMotion::DrivenMotion(const SpinDrive& drive, const SpinState& start,
                           std::span<const double> parameters, std::span<const Vec3> changes)
    : drive_(drive),
      start_(start),
      parameters_(parameters.begin(), parameters.end()),
      changes_(changes.begin(), changes.end()),
      R_(drive.q_FB == Quaternion{} ? Mat3::identity() : rotation_matrix(normalized(drive.q_FB))),
      system_(system_of(drive, start, R_, parameters)) {
  const Vec3 w = in_body(R_, start.w_F), &I = system_.body().moments();
  initial_ = {normalized(normalized(start.q) * normalized(drive.q_FB)),
              {I.x * w.x, I.y * w.y, I.z * w.z}};
}

SpinState DrivenMotion::shown(const RotorState& s) const {
  SpinState found = start_;
  found.q = normalized(s.q * conj(normalized(drive_.q_FB)));
  found.w_F = R_ * angular_velocity(system_.body(), s);
  return found;
}

std::optional<std::vector<MovedPoint>> DrivenMotion::at(
    std::span<const double> times, std::span<const DrivenColumn> columns) const {
  const std::vector<DrivenLeg> legs = driven_legs(times, start_.t0, drive_.jumps);
  const Wanted wanted(times);
  std::vector<MovedPoint> points(times.size());
  const bool went = walk(
      legs, start_.t0, initial_,
      [&](const RotorState& s, const DrivenLeg& leg) {
        return samples_of(Problem{system_, s, leg.from, leg.to, Collocation{drive_.tolerance}},
                          leg);
      },
      [&](const RotorState& s, std::size_t j, double sign) { return jumped(s, j, sign); },
      [&](const Sample& sample) {
        const Quaternion q = shown(sample.s).q;
        // with what terms add to the rate
        const Vec3 w = R_ * angular_velocity(system_, sample.t, sample.s).inertial;
        wanted.each(sample.t, [&](std::size_t i) { points[i] = {q, w, {}, {}}; });
        return polhode::detail::is_finite(w);
      });
  if (!went) return std::nullopt;
  for (std::size_t first = 0; first < columns.size(); first += 6) {
    const auto six = columns.subspan(first, std::min<std::size_t>(6, columns.size() - first));
    if (!add_columns(legs, six, wanted, points)) return std::nullopt;
  }
  return points;
}

RotorState DrivenMotion::jumped(const RotorState& s, std::size_t j, double sign) const {
  const SpinJump::Of of = drive_.jumps[j].of;
  const Vec3 change =
      of == SpinJump::Of::inertial_momentum ? changes_[j] : in_body(R_, changes_[j]);
  return {s.q, s.g + sign * momentum_of<double>(of, change, system_.body().moments(), s)};
}

bool DrivenMotion::add_columns(std::span<const DrivenLeg> legs, std::span<const DrivenColumn> six,
                               const Wanted& wanted, std::vector<MovedPoint>& points) const {
  const double unit = start_.inertia_F(2, 2);
  const Vec3& I = system_.body().moments();
  std::array<SensitivityTerm, 6> terms;
  BasicVec3<Tangent> moments{Tangent(I.x), Tangent(I.y), Tangent(I.z)};
  for (std::size_t c = 0; c < six.size(); ++c) {
    if (six[c].of == DrivenColumn::Of::torque) {
      terms[c].stepped = stepped_terms(six[c].index, terms[c].step);
    } else if (six[c].of == DrivenColumn::Of::ratio) {
      terms[c].moment = static_cast<int>(six[c].index);
      terms[c].moment_rate = unit;
      moments[*terms[c].moment].derivative[c] = unit;
    }
  }
  const auto field = std::make_shared<const SensitivityField>(system_, std::move(terms));
  const auto jump = [&](TangentRotor at, std::size_t j, double sign) {
    const SpinJump::Of of = drive_.jumps[j].of;
    const auto turned = [&](const Vec3& x) {
      return of == SpinJump::Of::inertial_momentum ? x : in_body(R_, x);
    };
    const Vec3 value = turned(changes_[j]);
    BasicVec3<Tangent> change{Tangent(value.x), Tangent(value.y), Tangent(value.z)};
    for (std::size_t c = 0; c < six.size(); ++c) {
      if (six[c].of != DrivenColumn::Of::jump || six[c].index != j) continue;
      const Vec3 axis = turned(six[c].axis_F);
      for (int k = 0; k < 3; ++k) change[k].derivative[c] = axis[k];
    }
    at.g = at.g + Tangent(sign) * momentum_of<Tangent>(of, change, moments, at);
    return at;
  };
  return walk(
      legs, start_.t0, seeded(initial_, system_.body(), unit, R_, six),
      [&](const TangentRotor& s, const DrivenLeg& leg) {
        return samples_of(field, s, leg, drive_.tolerance);
      },
      jump,
      [&](const BasicSample<TangentRotor>& sample) {
        const BasicVec3<Tangent> w = field->rate(sample.t, sample.s);
        bool is_number = true;
        wanted.each(sample.t, [&](std::size_t i) {
          put_columns(sample.s, w, R_, six.size(), points[i]);
          is_number = is_number &&
                      polhode::detail::is_finite(points[i].turn.back() + points[i].rate.back());
        });
        return is_number;
      });
}

std::vector<AnyPerturbation> DrivenMotion::stepped_terms(std::size_t parameter,
                                                         double& step) const {
  // Effects are affine: any step will do, and a long one leaves least to rounding. One that the
  // terms do not take, a negative pressure, is made shorter.
  std::vector<double> p = parameters_;
  const double here = p[parameter];
  double length = std::max(std::abs(here), 1.0);
  for (int tries = 0; tries < 40; ++tries, length *= 0.1) {
    for (const double by : {length, -length}) {
      p[parameter] = here + by;
      step = p[parameter] - here;
      if (step == 0.0) continue;
      try {
        return drive_.terms(p);
      } catch (const DomainError&) {
        continue;
      }
    }
  }
  throw DomainError(std::string(motion_function) + ": " + drive_.parameters[parameter].name +
                    " = " + polhode::detail::number_text(here) +
                    " has no neighbours that its torque takes; expected a number that can vary");
}

std::optional<SpinState> DrivenMotion::after_jumps() const {
  double last = start_.t0;
  bool has_jump = false;
  for (const SpinJump& jump : drive_.jumps) {
    if (jump.t < start_.t0) continue;
    has_jump = true;
    last = std::max(last, jump.t);
  }
  if (!has_jump) return start_;
  // To just after the last jump, and back without any.
  RotorState s = initial_;
  const std::vector<double> beyond{std::nextafter(last, std::numeric_limits<double>::infinity())};
  std::vector<DrivenLeg> legs = driven_legs(beyond, start_.t0, drive_.jumps);
  legs.pop_back();
  const auto run = [&](const RotorState& from, const DrivenLeg& leg) {
    auto samples =
        samples_of(Problem{system_, from, leg.from, leg.to, Collocation{drive_.tolerance}}, leg);
    if (samples) s = samples->back().s;
    return samples;
  };
  const auto jump = [&](const RotorState& at, std::size_t j, double sign) {
    return s = jumped(at, j, sign);
  };
  if (!walk(legs, start_.t0, initial_, run, jump, [](const Sample&) { return true; })) {
    return std::nullopt;
  }
  if (!run(s, {last, start_.t0, {start_.t0}, 1, std::nullopt, true})) return std::nullopt;
  return shown(s);
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
