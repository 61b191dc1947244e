// SPDX-License-Identifier: MIT
// Chaos indicators by Adaptive and Collocation: a motion with a deviation from it, and with the
// integrals of its growth.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "analysis/detail/deviated_state.hpp"
#include "dynamics/adaptive/adaptive_stepper.hpp"
#include "dynamics/augmented.hpp"
#include "dynamics/collocation/collocation_stepper.hpp"
#include "dynamics/collocation/variational_stages.hpp"
#include "system/moving_setting.hpp"

namespace polhode {
inline namespace v0 {
namespace analysis {
namespace detail {
namespace {

// The scales by which a deviation is measured.
struct Growth {
  double start = 0.0;
  double forward = 1.0;  // or -1, as elapsed time runs
  double momentum_scale = 1.0;
  double target = 1.0;  // the length that it is brought back to
  double initial_length = 1.0;

  double elapsed(const DoubleDouble& t) const { return std::abs((t - start).hi); }
};

// The numbers of a deviation begin here, behind those of the rotor.
constexpr std::size_t beside = 7;
// A linear deviation is scaled down before it leaves the range of a double, and long before.
constexpr double linear_reach = 0x1p200;

// For Adaptive: turn and momentum, by the variational equations.
class Variational {
 public:
  static constexpr std::size_t size = 6, following = 3;
  static constexpr double reach = linear_reach;
  using Values = std::array<double, 16>;

  Variational(const System&, double momentum_scale) : scale_(momentum_scale) {}

  Deviation deviation(const Values& y) const { return {{y[7], y[8], y[9]}, {y[10], y[11], y[12]}}; }
  void put(Values& y, const Deviation& d) const {
    const Vec3 &turn = d.turn, &momentum = d.momentum;
    const double values[] = {turn.x, turn.y, turn.z, momentum.x, momentum.y, momentum.z};
    std::copy_n(values, 6, y.begin() + beside);
  }
  double error_size(const Values& error, const Values& y, const Values&) const {
    return length(deviation(error)) / length(deviation(y));
  }
  // theta' = dw + theta x w, dg' = dg x w + g x dw + du; the frame turns both attitudes alike.
  Values rates(const polhode::detail::RotorField<double>& rotor, const DoubleDouble& t,
               const Values& y, const SwitchSides* sides) const {
    const System& system = rotor.system();
    const RotorState s = polhode::detail::rotor_state<double>(y);
    const Deviation d = deviation(y);
    const Vec3 dg = scale_ * d.momentum;
    Setting at = rotor.equations().setting(t, s);
    const bool inertial = system.frame().is_inertial();
    const FrameMotion frame = inertial ? FrameMotion{} : rotor.equations().frame_motion(t);
    at.q_IS = frame.q_IS;
    const BasicEffect<Tangent> sum = sum_of_terms(system, moving_along(at, {d.turn, dg}), sides);
    const Effect e{value_of(sum.v), value_of(sum.u)};
    const Vec3& I = system.body().moments();
    const Vec3 w0{s.g.x / I.x, s.g.y / I.y, s.g.z / I.z}, w = w0 + e.v;
    const Vec3 dw = Vec3{dg.x / I.x, dg.y / I.y, dg.z / I.z} + slope_of(sum.v);
    RotorRates r = inertial_rates(s, w0, e);
    if (!inertial) r = relative_rates(r, s.q, frame.mu_S);
    Values f{r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z};
    put(f, {dw + cross(d.turn, w),
            (1.0 / scale_) * (cross(dg, w) + cross(s.g, dw) + slope_of(sum.u))});
    return f;
  }

 private:
  double scale_;
};

// For Collocation: a column of dq and dg, by the derivative of the steps.
class Column {
 public:
  static constexpr std::size_t size = 7, following = 3;
  static constexpr double reach = linear_reach;
  using Values = std::array<double, 17>;

  Column(const System& system, double momentum_scale) : jacobian_(system), scale_(momentum_scale) {}

  const polhode::detail::RotorJacobian& jacobian() const { return jacobian_; }
  Deviation deviation(const Values& y) const { return deviation(y, y); }
  void put(Values& y, const Deviation& d) const {
    const Vec3 half = 0.5 * d.turn;
    const Quaternion dq =
        polhode::detail::rotor_state<double>(y).q * Quaternion{0.0, half.x, half.y, half.z};
    const polhode::detail::RotorValues<double> column =
        polhode::detail::rotor_values<double>({dq, scale_ * d.momentum});
    std::copy_n(column.begin(), 7, y.begin() + beside);
  }
  double error_size(const Values& error, const Values& y, const Values&) const {
    return length(deviation(y, error)) / length(deviation(y));
  }

 private:
  Deviation deviation(const Values& y, const Values& column) const {
    const Quaternion q = polhode::detail::rotor_state<double>(y).q;
    const RotorState d = polhode::detail::rotor_state<double>(column, beside);
    const double square = (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z);
    const Quaternion half = conj(q) * d.q;
    const double two = 2.0 / square;
    return {{two * half.x, two * half.y, two * half.z}, (1.0 / scale_) * d.g};
  }

  polhode::detail::RotorJacobian jacobian_;
  double scale_;
};

// A second motion, under the same steps.
class Neighbour {
 public:
  static constexpr std::size_t size = 7;
  static constexpr std::size_t following = 4;  // one more to fill the processor's registers
  static constexpr double reach = neighbour_reach;
  using Values = std::array<double, 18>;

  Neighbour(const System&, double momentum_scale) : scale_(momentum_scale) {}

  Deviation deviation(const Values& y) const {
    return detail::deviation(polhode::detail::rotor_state<double>(y),
                             polhode::detail::rotor_state<double>(y, beside), scale_);
  }
  void put(Values& y, const Deviation& d) const {
    const polhode::detail::RotorValues<double> other =
        polhode::detail::rotor_values(moved_by(polhode::detail::rotor_state<double>(y), d, scale_));
    std::copy_n(other.begin(), 7, y.begin() + beside);
  }
  double error_size(const Values& error, const Values& y, const Values& increment) const {
    return polhode::detail::RotorErrorSize()(polhode::detail::rotor_at(error, beside),
                                             polhode::detail::rotor_at(y, beside),
                                             polhode::detail::rotor_at(increment, beside));
  }
  void settle(CompensatedState<double, 18>& s) const { polhode::detail::restore_norm(s, beside); }
  // Both on the sides of the first: they part by less than a step can see.
  Values rates(const polhode::detail::RotorField<double>& rotor, const DoubleDouble& t,
               const Values& y, const SwitchSides* sides) const {
    const polhode::detail::RotorValues<double> a = rotor(t, polhode::detail::rotor_at(y), sides);
    const polhode::detail::RotorValues<double> b =
        rotor(t, polhode::detail::rotor_at(y, beside), sides);
    Values f{};
    std::copy_n(a.begin(), 7, f.begin());
    std::copy_n(b.begin(), 7, f.begin() + beside);
    return f;
  }

 private:
  double scale_;
};

// The rotor, the deviation `By` one of the three above, the integral of the growth L, that of
// MEGNO, and the logarithm of the factor that the deviation was scaled down by.
template <class By>
class DeviationField
    : public polhode::detail::AugmentedField<DeviatedState, By::size + By::following> {
 public:
  using Values = typename By::Values;
  using Compensated = CompensatedState<double, std::tuple_size_v<Values>>;
  static constexpr std::size_t growth_place = beside + By::size, megno_place = growth_place + 1,
                               behind = growth_place + 2;

  DeviationField(const System& system, const Growth& growth)
      : polhode::detail::AugmentedField<DeviatedState, By::size + By::following>(system),
        by_(system, growth.momentum_scale),
        growth_(growth) {}

  const polhode::detail::RotorJacobian& jacobian() const { return by_.jacobian(); }
  const Growth& growth() const { return growth_; }

  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const {
    Values f = by_.rates(this->rotor_alone(), t, y, sides);
    const double L = grown(y);
    f[growth_place] = growth_.forward * L;
    f[megno_place] = growth_.forward * megno(L, y[growth_place], growth_.elapsed(t));
    return f;
  }
  // With a deviation whose length is known after rounding.
  Values start(const RotorState& s, const Deviation& d) {
    Values y{};
    const polhode::detail::RotorValues<double> first = polhode::detail::rotor_values(s);
    std::copy_n(first.begin(), 7, y.begin());
    by_.put(y, scaled(d, growth_.target / length(d)));
    growth_.initial_length = length(by_.deviation(y));
    return y;
  }
  // L.
  double grown(const Values& y) const {
    return y[behind] + std::log(length(by_.deviation(y)) / growth_.initial_length);
  }
  DeviatedState state(const Values& y) const {
    return {this->rotor(y), {by_.deviation(y), grown(y), y[growth_place], y[megno_place]}};
  }
  // The error of a motion and that of its deviation, relative to each. The integrals follow: they
  // hold nothing that the rest does not.
  double error_size(const Values& error, const Values& y, const Values& increment) const {
    return polhode::detail::larger(
        polhode::detail::RotorErrorSize()(polhode::detail::rotor_at(error),
                                          polhode::detail::rotor_at(y),
                                          polhode::detail::rotor_at(increment)),
        by_.error_size(error, y, increment));
  }
  void settle(Compensated& s) const {
    polhode::detail::restore_norm(s);
    if constexpr (requires { by_.settle(s); }) by_.settle(s);
    rescale(s);
  }
  // After a step: a deviation that is not too long or too short.
  void rescale(Compensated& s) const {
    const Deviation d = by_.deviation(s.y);
    const double length_now = length(d), target = growth_.target;
    if (target < By::reach * length_now && length_now < By::reach * target) return;
    if (!(length_now > 0.0) || !std::isfinite(length_now)) return;  // state() says it
    by_.put(s.y, scaled(d, target / length_now));
    s.y[behind] += std::log(length_now / length(by_.deviation(s.y)));
    for (std::size_t i = beside; i < growth_place; ++i) s.carry[i] = 0.0;
  }

 private:
  By by_;
  Growth growth_;
};

// The second motion is solved after the first.
class NeighbourStages : public polhode::detail::AugmentedStages<DeviationField<Neighbour>, 11> {
 public:
  static constexpr int motions = 2;
  using Rates = polhode::detail::RotorAlone<Field>;

  NeighbourStages(const std::shared_ptr<const Field>& field, std::size_t stages, InstructionSet set)
      : AugmentedStages(field, stages, set),
        other_(std::shared_ptr<const polhode::detail::RotorStages::Field>(field,
                                                                          &field->rotor_alone()),
               stages, set) {}

  void begin(const DoubleDouble& t, const State& start, double h, const SwitchSides* sides) {
    AugmentedStages::begin(t, start, h, sides);
    other_.begin(t,
                 {polhode::detail::rotor_at(start.y, beside),
                  polhode::detail::rotor_at(start.carry, beside)},
                 h, sides);
  }
  void guess_start() {
    AugmentedStages::guess_start();
    other_.guess_start();
  }
  void guess(const Rows& coefficients, const polhode::detail::StageMatrix& at_stages,
             const NeighbourStages& of) {
    AugmentedStages::guess(coefficients, at_stages, of);
    polhode::detail::RotorStages::Rows rows{};
    std::copy_n(coefficients.begin() + beside, 7, rows.begin());
    other_.guess(rows, at_stages, of.other_);
  }
  polhode::detail::SweepsEnd solved(double enough, std::int64_t& sweeps) {
    polhode::detail::SweepsEnd end = polhode::detail::swept(rotor_, enough, sweeps);
    if (end == polhode::detail::SweepsEnd::converged)
      end = polhode::detail::swept(other_, enough, sweeps);
    std::copy_n(other_.rates().begin(), 7, rest_.F.begin());
    move(0, 7);
    return end;
  }

 private:
  polhode::detail::RotorStages other_;
};

// The integrals of the growth, at the stages of a step whose motions are solved.
template <class Stages>
class GrowthStages : public Stages {
 public:
  using Field = typename Stages::Field;
  using Stages::Stages;

  polhode::detail::SweepsEnd solved(double enough, std::int64_t& sweeps) {
    const polhode::detail::SweepsEnd end = Stages::solved(enough, sweeps);
    if (end == polhode::detail::SweepsEnd::converged) follow();
    return end;
  }

 private:
  static constexpr std::size_t growth = Field::growth_place - 7, megno_integral = growth + 1;

  void follow() {
    const Growth& how = this->field_->growth();
    std::array<double, most_stages> L;
    for (std::size_t i = 0; i < this->scheme().stages; ++i) {
      typename Field::Values y;
      for (std::size_t n = 0; n < y.size(); ++n)
        y[n] = n < 7 ? this->at_stage(i, n) : this->rest_.Y[n - 7][i];
      L[i] = this->field_->grown(y);
      this->rest_.F[growth][i] = how.forward * L[i];
    }
    this->move(growth, growth + 1);
    for (std::size_t i = 0; i < this->scheme().stages; ++i)
      this->rest_.F[megno_integral][i] =
          how.forward * megno(L[i], this->rest_.Y[growth][i], how.elapsed(this->time(i)));
    this->move(megno_integral, this->rest_.F.size());
  }
};

template <class Field>
std::pair<std::shared_ptr<const Field>, typename Field::Values> begun(const Problem& problem,
                                                                      const ChaosOptions& options,
                                                                      double target) {
  const auto field = std::make_shared<Field>(
      problem.system, Growth{problem.start, problem.stop < problem.start ? -1.0 : 1.0,
                             options.momentum_scale, target});
  const typename Field::Values y = field->start(problem.initial, options.deviation);
  return {field, y};
}

// No pulse of a torque is stepped over, and none is seen from the other side.
template <class By>
std::unique_ptr<polhode::detail::BasicStepper<DeviatedState>> stepper_by(
    const Problem& problem, const Adaptive& method, const ChaosOptions& options, double target) {
  const auto [field, y] = begun<DeviationField<By>>(problem, options, target);
  return polhode::detail::switching_stepper(field, problem.start, y, method, unknown_jump);
}
template <class Stages>
std::unique_ptr<polhode::detail::BasicStepper<DeviatedState>> stepper_by(
    const Problem& problem, const Collocation& method, const ChaosOptions& options, double target) {
  const auto [field, y] = begun<typename Stages::Field>(problem, options, target);
  return polhode::detail::collocation_stepper<GrowthStages<Stages>>(field, problem.start, y, method,
                                                                    unknown_jump);
}

}  // namespace

std::unique_ptr<polhode::detail::BasicStepper<DeviatedState>> deviation_stepper(
    const Problem& problem, const ChaosOptions& options, DeviationBy by) {
  if (const auto* const method = std::get_if<Splitting>(&problem.method))
    return splitting_deviation(problem, *method, options, by);
  const bool is_linear = by == DeviationBy::variational;
  if (const auto* const method = std::get_if<Collocation>(&problem.method)) {
    using Linear = polhode::detail::VariationalStages<DeviationField<Column>, 1, 3>;
    return is_linear ? stepper_by<Linear>(problem, *method, options, 1.0)
                     : stepper_by<NeighbourStages>(problem, *method, options, options.distance);
  }
  const Adaptive& method = std::get<Adaptive>(problem.method);
  return is_linear ? stepper_by<Variational>(problem, method, options, 1.0)
                   : stepper_by<Neighbour>(problem, method, options, options.distance);
}

}  // namespace detail
}  // namespace analysis
}  // namespace v0
}  // namespace polhode
