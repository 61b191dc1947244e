// SPDX-License-Identifier: MIT
// Variation of constants: the rates of the constants, and the stepper that integrates them by Gauss
// collocation.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "dynamics/adaptive/breakpoints.hpp"
#include "dynamics/adaptive/rotor_field.hpp"
#include "dynamics/steppers.hpp"
#include "dynamics/variation/variation_collocation.hpp"
#include "free/short_flow.hpp"
#include "math/finite.hpp"
#include "math/gauss_legendre.hpp"
#include "math/number_text.hpp"
#include "polhode/detail/ode/runge_kutta.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/system/system.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// The rates of the constants of the free rotation: of the inertial state that the motion would have
// had at a reference epoch without terms and frame.
//
// x(t) = Phi(t - epoch, y) in inertial axes; dy/dt = DPhi^-1 (v, g x v + u), the inverse being the
// flow back from x(t).
class VariationField {
 public:
  VariationField(std::shared_ptr<const System> system, const DoubleDouble& epoch)
      : system_(std::move(system)), free_(system_->body()), epoch_(epoch) {}

  const System& system() const { return *system_; }
  const ShortFlow& free() const { return free_; }
  const DoubleDouble& epoch() const { return epoch_; }
  VariationField from(const DoubleDouble& epoch) const {
    VariationField f = *this;
    f.epoch_ = epoch;
    return f;
  }

  // q_IB and g of the motion at t.
  BasicRotorState<double> osculating(const DoubleDouble& t, const RotorValues<double>& y) const {
    const RotorState s = rotor_state<double>(y);
    const ShortFlow::PlainArc arc = free_.plain(s.g, (t - epoch_).hi);
    return {s.q * arc.turn, arc.g};
  }

  RotorValues<double> operator()(const DoubleDouble& t, const RotorValues<double>& y) const {
    const RotorState s = rotor_state<double>(y);
    const double time = (t - epoch_).hi;
    const ShortFlow::PlainArc arc = free_.plain(s.g, time);
    const Effect e = terms_effect(*system_, setting(t, {s.q * arc.turn, arc.g}));
    const Vec3 dg = cross(arc.g, e.v) + e.u;
    const FlowTangent<double> back = free_.tangent(arc.g, dg, -time, conj(arc.turn));
    const Vec3 w = 0.5 * (rotate(arc.turn, e.v) + back.attitude);
    const Quaternion q = s.q * Quaternion{0.0, w.x, w.y, w.z};
    return {q.w, q.x, q.y, q.z, back.momentum.x, back.momentum.y, back.momentum.z};
  }

  // Where the terms are asked: the motion in the reference frame.
  Setting setting(const DoubleDouble& t, const RotorState& x) const {
    Setting at{system_->body(), t.hi, x, {}, t.lo};
    if (!system_->frame().is_inertial()) {
      at.q_IS = system_->frame().at(t.hi).q_IS;
      at.s.q = conj(at.q_IS) * x.q;
    }
    return at;
  }

 private:
  std::shared_ptr<const System> system_;
  ShortFlow free_;
  DoubleDouble epoch_;
};

using Values = RotorValues<double>;
using Constants = CompensatedState<double, rotor_size<double>>;
using Wide = BasicRotorState<DoubleDouble>;

// The constants move to a new epoch, the middle of the step to come, before neighbouring motions
// have parted by more than this: their rates would grow with the arc, and short arcs are cheap.
constexpr double longest_arc = 0.125;

Wide wide(const Constants& c) {
  const auto sum = [&](std::size_t i) { return DoubleDouble::sum(c.y[i], c.carry[i]); };
  return {{sum(0), sum(1), sum(2), sum(3)}, {sum(4), sum(5), sum(6)}};
}

Constants split(const Wide& s) {
  const DoubleDouble parts[] = {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z};
  Constants c{};
  for (std::size_t i = 0; i < 7; ++i) {
    c.y[i] = parts[i].hi;
    c.carry[i] = parts[i].lo;
  }
  return c;
}

RotorState reference_axes(const VariationField& field, const DoubleDouble& t, const Values& y) {
  const Setting at = field.setting(t, field.osculating(t, y));
  return {normalized(at.s.q), at.s.g};
}

// The solver's view of a field whose epoch moves.
struct MovingField {
  std::shared_ptr<VariationField> field;
  Values operator()(const DoubleDouble& t, const Values& y) const { return (*field)(t, y); }
};

// A shorter step from the same start.
class VariationDense final : public DenseStep {
 public:
  VariationDense(VariationField field, const DoubleDouble& t0, const Constants& start, double t1,
                 const RotorState& end)
      : DenseStep(t0.hi, t1), field_(std::move(field)), t0_(t0), start_(start), end_(end) {}

  SystemState at(double t) const override {
    if (t == t1()) return end_;
    const double h = (DoubleDouble(t) - t0_).hi;
    Constants c = start_;
    const auto step = collocation_step<rotor_size<double>>(field_, RotorErrorSize{}, t0_, c.y, h,
                                                           0.5 * epsilon<double>());
    c.add(step.increment);
    return reference_axes(field_, DoubleDouble(t), c.y);
  }

 private:
  VariationField field_;
  DoubleDouble t0_;
  Constants start_;
  RotorState end_;
};

// The step once more as four shorter ones, each a polynomial: a quarter of the step has the last
// coefficients of a series smaller by 4^-12 and more, so that their squares' root is as small as
// the tolerance. Many looks inside the step cost a free motion each.
class VariationPieces final : public DenseStep {
 public:
  VariationPieces(VariationField field, const DoubleDouble& t0, const Constants& start,
                  const DoubleDouble& t1)
      : DenseStep(t0.hi, t1.hi), field_(std::move(field)) {
    const double h = (t1 - t0).hi;
    Constants c = start;
    for (std::size_t i = 0; i < pieces; ++i) {
      const DoubleDouble from = t0 + (h * (static_cast<double>(i) / pieces));
      const auto step = collocation_step<rotor_size<double>>(
          field_, RotorErrorSize{}, from, c.y, h / pieces, 0.5 * epsilon<double>(), &series_[i]);
      is_made_ = is_made_ && step.status == Step::Status::made;
      begin_[i] = from;
      constants_[i] = c;
      c.add(step.increment);
    }
    length_ = h / pieces;
  }

  // Where the terms are too rough for so small a change, it is no polynomial.
  bool is_made() const { return is_made_; }

  SystemState at(double t) const override {
    const double share = (DoubleDouble(t) - begin_[0]).hi / length_;
    const std::size_t i = static_cast<std::size_t>(std::clamp(share, 0.0, pieces - 1.0));
    const double x = (DoubleDouble(t) - begin_[i]).hi / length_;
    Constants c = constants_[i];
    c.add(collocation_increment(series_[i], length_, x));
    return reference_axes(field_, DoubleDouble(t), c.y);
  }

 private:
  using Step = CollocationStep<rotor_size<double>>;
  static constexpr std::size_t pieces = 4;

  VariationField field_;
  bool is_made_ = true;
  double length_ = 0.0;
  std::array<DoubleDouble, pieces> begin_;
  std::array<Constants, pieces> constants_;
  std::array<CollocationSeries<rotor_size<double>>, pieces> series_{};
};

class VariationStepper final : public Stepper {
 public:
  VariationStepper(const Problem& problem, const VariationOfConstants& method)
      : system_(std::make_shared<const System>(problem.system)),
        breakpoints_(problem.system),
        field_(std::make_shared<VariationField>(system_, problem.start)),
        solver_({field_}, {}, problem.start, start_values(problem),
                {method.tolerance, first_step(problem, *field_), method.largest_step}),
        before_(*field_),
        begin_(problem.start),
        start_(solver_.state()) {}

  // Gauss' nodes are inside a step, so that its ends may be breakpoints.
  std::string advance(double run_end) override {
    const double stop = breakpoints_.end(solver_.time().hi, run_end);
    follow(solver_.next_step(stop));
    const DoubleDouble begin = solver_.time();
    const Constants start = solver_.state();
    const StepOutcome outcome = solver_.advance(stop);
    if (outcome != StepOutcome::made) return failure(outcome);
    before_ = *field_;
    begin_ = begin;
    start_ = start;
    return {};
  }

  double time() const override { return solver_.time().hi; }
  SystemState state() const override {
    return reference_axes(*field_, solver_.time(), solver_.state().y);
  }
  std::shared_ptr<const DenseStep> dense(bool) override {
    return std::make_shared<const VariationDense>(before_, begin_, start_, time(), state());
  }
  std::shared_ptr<const DenseStep> inside() override {
    auto pieces = std::make_shared<const VariationPieces>(before_, begin_, start_, solver_.time());
    return pieces->is_made() ? pieces : dense(false);
  }
  // As many as the step's polynomial has degrees: terms may act faster than the body turns.
  int intervals() const override { return static_cast<int>(gauss_nodes); }
  Statistics statistics() const override {
    return {solver_.steps(), solver_.rejected(), solver_.evaluations()};
  }
  void serialize(Archive& bytes) override {
    solver_.serialize(bytes);
    DoubleDouble epoch = field_->epoch(), epoch_before = before_.epoch();
    bytes.all(epoch, epoch_before, begin_, start_.y, start_.carry);
    *field_ = field_->from(epoch);
    before_ = field_->from(epoch_before);
  }

 private:
  // q_IB, g at the start, which is the first epoch.
  static Values start_values(const Problem& problem) {
    return rotor_values(inertial_state(problem.system, problem.start,
                                       {normalized(problem.initial.q), problem.initial.g}));
  }

  // A radian, or what the terms need to make a tenth of the momentum; 0 where nothing moves.
  static double first_step(const Problem& problem, const VariationField& field) {
    const Values y = start_values(problem);
    const double change = RotorErrorSize{}(field(problem.start, y), y, Values{});
    const double rate =
        norm(angular_velocity(problem.system.body(), problem.initial)) + 10.0 * change;
    return rate > 0.0 && std::isfinite(rate) ? 1.0 / rate : 0.0;
  }

  // In double-double, so that |g|, the energy and the phases of the free motion walk nowhere.
  void follow(double step) {
    const DoubleDouble elapsed = solver_.time() - field_->epoch();
    const double arc = std::max(std::abs(elapsed.hi), std::abs(elapsed.hi + step));
    const Vec3 g{solver_.state().y[4], solver_.state().y[5], solver_.state().y[6]};
    if (!(arc * field_->free().polhode_rate(g) > longest_arc)) return;
    const DoubleDouble move = elapsed + 0.5 * step;
    solver_.state() = split(carried(system_->body(), wide(solver_.state()), move));
    *field_ = field_->from(field_->epoch() + move);
  }

  std::string failure(StepOutcome outcome) const {
    const DoubleDouble& t = solver_.time();
    const std::string where = " at t = " + number_text(t.hi);
    if (outcome == StepOutcome::too_small)
      return "the step" + where + " would be " + number_text(std::abs(solver_.trial())) +
             ", below the rounding of t: try a larger tolerance, or Adaptive where the momentum is "
             "near zero";
    for (const DoubleDouble& when : {t, t + solver_.trial()}) {
      const Setting at = field_->setting(when, field_->osculating(when, solver_.state().y));
      for (const AnyPerturbation& term : system_->terms()) {
        const Effect e = term.effect(at);
        if (!is_finite(e.u) || !is_finite(e.v))
          return "term \"" + term.name() + "\" is not finite" + where +
                 ": give it a value there, or stop before";
      }
    }
    return "a term or the frame is not finite" + where +
           ": give it a value there, or stop before; try Adaptive where the momentum is near zero";
  }

  std::shared_ptr<const System> system_;
  Breakpoints breakpoints_;
  std::shared_ptr<VariationField> field_;
  AdaptiveCollocation<rotor_size<double>, MovingField, RotorErrorSize> solver_;
  VariationField before_;  // of the step made last
  DoubleDouble begin_;
  Constants start_;
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const VariationOfConstants& method) {
  require_valid(method);
  return std::make_unique<VariationStepper>(problem, method);
}

namespace {

using DD = DoubleDouble;
constexpr std::size_t s = gauss_nodes;

GaussTableau made() {
  const GaussNodes<DD, s> nodes;
  const auto& [x, w, P] = nodes;
  GaussTableau g{};
  for (std::size_t i = 0; i < s; ++i) {
    g.c[i] = (0.5 * (1.0 + x[i])).hi;
    g.b[i] = (0.5 * w[i]).hi;
    for (std::size_t k = 0; k < s; ++k)
      g.all[k][i] = ((static_cast<double>(k) + 0.5) * (w[i] * P[i][k])).hi;
    for (std::size_t m = 0; m < 2; ++m) g.last[m][i] = g.all[s - 1 - m][i];
    for (std::size_t j = 0; j < s; ++j) g.a[i][j] = (0.25 * (w[j] * nodes.integral(i, j))).hi;
  }
  return g;
}

}  // namespace

const GaussTableau& gauss_tableau() {
  static const GaussTableau tableau = made();
  return tableau;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
