// SPDX-License-Identifier: MIT
// Switching functions of a system: on which side of each a run is, and where within a step one
// changes its sign.
#include "dynamics/adaptive/switching_functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "math/finite.hpp"
#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

Setting setting_of(const System& system, const DoubleDouble& t, const RotorState& s) {
  const Frame& frame = system.frame();
  const Quaternion q_IS = frame.is_inertial() ? Quaternion{} : frame.at(t.hi).q_IS;
  return {system.body(), t.hi, s, q_IS, t.lo};
}

// The values of all terms, one after the other.
SwitchSides switches_of(const System& system, const DoubleDouble& t, const RotorState& s) {
  const Setting at = setting_of(system, t, s);
  SwitchSides all;
  for (const AnyPerturbation& term : system.terms()) {
    all.first.push_back(all.values.size());
    if (!term.supports_switches()) continue;
    const std::vector<double> own = term.switches(at);
    all.values.insert(all.values.end(), own.begin(), own.end());
  }
  all.first.push_back(all.values.size());
  return all;
}

}  // namespace

SwitchWatch::SwitchWatch(const System& system, const char* jumps)
    : system_(system),
      jumps_(jumps),
      needed_(std::any_of(system.terms().begin(), system.terms().end(),
                          [](const AnyPerturbation& term) { return term.supports_switches(); })) {}

std::string SwitchWatch::begin(const DoubleDouble& t, const RotorState& s) {
  if (begun_ || !needed_) return {};
  SwitchSides sides = switches_of(system_, t, s);
  const std::vector<double> values = sides.values;
  for (double& value : sides.values) value = side_of(value);
  if (!sides.values.empty()) sides_ = std::make_shared<const SwitchSides>(std::move(sides));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(values[i])) return nan_text(i, t.hi);
  see(values);
  begun_ = true;
  return {};
}

std::vector<double> SwitchWatch::values(const DoubleDouble& t, const RotorState& s) const {
  SwitchSides now = switches_of(system_, t, s);
  for (std::size_t i = 0; i + 1 < now.first.size(); ++i) {
    const std::size_t count = now.first[i + 1] - now.first[i];
    const std::size_t before = sides_->first[i + 1] - sides_->first[i];
    if (count != before)
      throw DomainError("integrate: term \"" + system_.terms()[i].name() + "\" has " +
                        std::to_string(count) + " switching functions, and " +
                        std::to_string(before) + " at the start: expected as many");
  }
  for (std::size_t i = 0; i < now.values.size(); ++i) now.values[i] *= sides_->values[i];
  return std::move(now.values);
}

void SwitchWatch::see(const std::vector<double>& values) {
  largest_.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isinf(values[i])) largest_[i] = larger(largest_[i], std::fabs(values[i]));
}

// A function that a torque brings to zero and leaves there walks by roundings of what it is made
// of.
double SwitchWatch::rounding(std::size_t which) const {
  return 64.0 * epsilon<double>() * largest_[which];
}

double SwitchWatch::longest_step(const RotorState& s) const {
  constexpr double turn = 1.5;  // rad; a side of a facet lasts about half a turn
  const double rate = norm(polhode::angular_velocity(system_.body(), s));
  return rate > 0.0 ? turn / rate : std::numeric_limits<double>::infinity();
}

void SwitchWatch::cross(std::size_t which) {
  SwitchSides next = *sides_;
  next.values[which] = -next.values[which];
  sides_ = std::make_shared<const SwitchSides>(std::move(next));
}

bool SwitchWatch::cross_at_once(std::size_t which) {
  // functions that are zero together are crossed one by one, and a touch there and back
  if (++crossed_at_once_ > 2 * static_cast<int>(size())) return false;
  cross(which);
  return true;
}

std::size_t SwitchWatch::term_of(std::size_t which) const {
  std::size_t term = 0;
  while (which >= sides_->first[term + 1]) ++term;
  return term;
}

std::string SwitchWatch::text(std::size_t which) const {
  const std::size_t term = term_of(which);
  return "switching function " + std::to_string(which - sides_->first[term] + 1) + " of term \"" +
         system_.terms()[term].name() + "\"";
}
std::string SwitchWatch::nan_text(std::size_t which, double t) const {
  return text(which) + " is NaN at t = " + number_text(t) +
         ": give it a value there, or stop before";
}

// What does not look at the state has the same bits for every state.
bool SwitchWatch::depends_on_state(std::size_t which, const DoubleDouble& t,
                                   const RotorState& s) const {
  constexpr double little = 0x1p-10;
  const double g = norm(s.g), kick = little * (g > 0.0 ? g : 1.0);
  const double value = switches_of(system_, t, s).values[which];
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along{};
    along[axis] = 1.0;
    const Vec3 half = (0.5 * little) * along;
    const RotorState turned{normalized(s.q * Quaternion{1.0, half.x, half.y, half.z}), s.g};
    const RotorState kicked{s.q, s.g + kick * along};
    for (const RotorState& other : {turned, kicked})
      if (!(switches_of(system_, t, other).values[which] == value)) return true;
  }
  return false;
}

bool SwitchWatch::is_fading(std::size_t which, const DoubleDouble& t, const RotorState& s) const {
  return system_.terms()[term_of(which)].fades_at_switches() && !depends_on_state(which, t, s);
}

double SwitchWatch::bend(std::size_t which, const DoubleDouble& t, const RotorState& s,
                         double h) const {
  const std::size_t term = term_of(which);
  const double g = norm(s.g);
  double largest = 0.0;
  // a torque may happen to vanish at one attitude
  for (int axis = -1; axis < 3; ++axis) {
    RotorState turned = s;
    if (axis >= 0) {
      Vec3 half{};
      half[axis] = 0.5;
      turned.q = normalized(s.q * Quaternion{1.0, half.x, half.y, half.z});
    }
    const auto effect = [&](double x) {
      Setting at = setting_of(system_, t + x * h, turned);
      at.sides = sides_->of(term);
      return system_.terms()[term].effect(at);
    };
    const Effect a = effect(0.0), b = effect(0.5), c = effect(1.0);
    const Vec3 u = a.u - 2.0 * b.u + c.u, v = a.v - 2.0 * b.v + c.v;
    // a body at rest: of the momentum that it gets
    const double momentum = larger(g, std::fabs(h) * norm(b.u));
    if (momentum > 0.0) largest = larger(largest, norm(u) / momentum);
    largest = larger(largest, norm(v));
  }
  return largest;
}

Effect SwitchWatch::change(std::size_t which, const DoubleDouble& t, const RotorState& s) const {
  const std::size_t term = term_of(which);
  SwitchSides sides = *sides_;
  Setting at = setting_of(system_, t, s);
  at.sides = sides.of(term);
  const Effect here = system_.terms()[term].effect(at);
  sides.values[which] = -sides.values[which];
  const Effect beyond = system_.terms()[term].effect(at);
  return {beyond.v - here.v, beyond.u - here.u};
}

std::string SwitchWatch::refused_jump(std::size_t which, const DoubleDouble& t, const RotorState& s,
                                      std::initializer_list<RotorState> before) const {
  if (jumps_ == nullptr || !depends_on_state(which, t, s)) return {};
  constexpr double part = 1e-6;
  const Effect here = change(which, t, s);
  double u = 0.0, v = 0.0;
  for (const RotorState& other : before) {
    const Effect away = change(which, t, other);
    u = larger(u, norm(away.u));
    v = larger(v, norm(away.v));
  }
  const bool torque = norm(here.u) > part * u;
  if (!torque && !(norm(here.v) > part * v)) return {};
  return std::string("the ") + (torque ? "torque" : "rate") + " of term \"" +
         system_.terms()[term_of(which)].name() +
         "\" jumps where the state says so, at t = " + number_text(t.hi) + ": " + jumps_;
}

void SwitchWatch::serialize(Archive& bytes) {
  bytes.all(begun_, crossed_at_once_, largest_);
  serialize(bytes, sides_);
}

void SwitchWatch::serialize(Archive& bytes, std::shared_ptr<const SwitchSides>& sides) const {
  SwitchSides values = sides ? *sides : SwitchSides{};
  std::vector<std::int64_t> first(values.first.begin(), values.first.end());
  bytes.all(first, values.values);
  if (!bytes.reads()) return;
  values.first.assign(first.begin(), first.end());
  if (!first.empty() && first.size() != system_.terms().size() + 1)
    throw DomainError("resume: the checkpoint is of another problem: terms differs");
  sides = first.empty() ? nullptr : std::make_shared<const SwitchSides>(std::move(values));
}

namespace {

// Samples of a step: between them a switching function has one dip at most.
constexpr int pieces = 4;
// Its slopes at the ends of a step are differences over this fraction of a piece.
constexpr double aside = 0x1p-12;
// The interpolation is solved to this, the truth to rounding: fractions of a step.
constexpr double roughly = 1e-7;
constexpr double closely = std::numeric_limits<double>::epsilon();

// A change of sign that the interpolation shows: at or above zero at `before`, below at `beyond`.
struct Crossing {
  std::size_t which;
  double before;
  double beyond;
  double guess;
};

class Search {
 public:
  explicit Search(const SwitchCurve& curve) : curve_(curve) {
    for (std::size_t k = 0; k <= pieces; ++k) values_[k] = curve.along(place(k));
  }

  std::optional<Edge> first() {
    const std::optional<Edge> nan = first_nan();
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < values_[0].size(); ++i) add_crossings(i, crossings);
    std::stable_sort(crossings.begin(), crossings.end(),
                     [](const Crossing& a, const Crossing& b) { return a.guess < b.guess; });
    for (const Crossing& c : crossings) {
      if (nan && c.beyond > nan->x) continue;
      if (!below(c.which, curve_.truly(c.which, c.beyond))) continue;  // the interpolation errs
      const double step = 0.01 * (c.beyond - c.before), x = c.guess;
      const double slope = (rough(c.which, x + step) - rough(c.which, x)) / step;
      const auto truth = [&](double at) { return curve_.truly(c.which, at); };
      return Edge{c.which, bracketed_root(truth, c.before, c.beyond, x, slope, closely)};
    }
    return nan;
  }

  const std::vector<double>& at_end() const { return values_.back(); }

 private:
  std::optional<Edge> first_nan() const {
    for (std::size_t k = 0; k <= pieces; ++k)
      for (std::size_t i = 0; i < values_[k].size(); ++i)
        if (std::isnan(values_[k][i])) return Edge{i, place(k), true};
    return std::nullopt;
  }

  static double place(std::size_t k) { return static_cast<double>(k) / pieces; }
  double rough(std::size_t which, double x) const { return curve_.along(x)[which]; }
  bool below(std::size_t which, double value) const { return value < -curve_.rounding(which); }

  // Every sample below zero, and what dips below it between samples that are not.
  void add_crossings(std::size_t i, std::vector<Crossing>& found) {
    double before = 0.0;
    bool was_beyond = false;
    for (std::size_t k = 1; k <= pieces; ++k) {
      const bool beyond = below(i, values_[k][i]);
      if (beyond) {
        add({i, before, place(k), 0.0}, found);
      } else if (!was_beyond && may_dip(k - 1, i)) {
        const double x = lowest_in(before, place(k), i);
        if (below(i, rough(i, x))) add({i, before, x, 0.0}, found);
      }
      was_beyond = beyond;
      before = place(k);
    }
  }
  void add(Crossing c, std::vector<Crossing>& found) const {
    const auto f = [&](double x) { return rough(c.which, x); };
    // from the middle: at the beginning a step has the zero that the last one ended at
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    c.guess = bracketed_root(f, c.before, c.beyond, 0.5 * (c.before + c.beyond), unknown, roughly);
    found.push_back(c);
  }

  // Whether function i may be below zero between samples k and k + 1. Where it dips it is convex, a
  // parabola or a V, and then above the lines through the samples on either side. At the ends of a
  // step the line is the tangent.
  bool may_dip(std::size_t k, std::size_t i) {
    const double a = values_[k][i], b = values_[k + 1][i];
    // without the tangents first: most steps end here
    if (k > 0 && !below(i, a + (a - values_[k - 1][i]))) return false;
    if (k + 2 <= pieces && !below(i, b + (b - values_[k + 2][i]))) return false;
    const double falls = a - (k > 0 ? values_[k - 1][i] : before_first(i));
    const double rises = (k + 2 <= pieces ? values_[k + 2][i] : after_last(i)) - b;
    if (!(falls < 0.0 && rises > 0.0)) return false;
    // a + falls x and b - rises (1 - x) meet
    const double x = std::clamp((a - b + rises) / (rises - falls), 0.0, 1.0);
    return below(i, a + falls * x);
  }
  // The values that the tangents at the ends have one piece outside.
  double before_first(std::size_t i) {
    if (near_first_.empty()) near_first_ = curve_.along(aside / pieces);
    return values_[0][i] - (near_first_[i] - values_[0][i]) / aside;
  }
  double after_last(std::size_t i) {
    if (near_last_.empty()) near_last_ = curve_.along(1.0 - aside / pieces);
    return values_[pieces][i] + (values_[pieces][i] - near_last_[i]) / aside;
  }

  // Where function i is lowest, by golden sections, or a place where it is below zero.
  double lowest_in(double from, double to, std::size_t i) const {
    constexpr double golden = 0.6180339887498949;
    double low = to - golden * (to - from), high = from + golden * (to - from);
    double at_low = rough(i, low), at_high = rough(i, high);
    for (int trip = 0; trip < 32; ++trip) {
      if (below(i, at_low)) return low;
      if (below(i, at_high)) return high;
      if (at_low < at_high) {
        to = std::exchange(high, low);
        at_high = at_low;
        low = to - golden * (to - from);
        at_low = rough(i, low);
      } else {
        from = std::exchange(low, high);
        at_low = at_high;
        high = from + golden * (to - from);
        at_high = rough(i, high);
      }
    }
    return at_low < at_high ? low : high;
  }

  const SwitchCurve& curve_;
  std::array<std::vector<double>, pieces + 1> values_;
  std::vector<double> near_first_, near_last_;  // once they are asked for
};

}  // namespace

EdgeSearch search_edges(const SwitchCurve& curve) {
  Search search(curve);
  std::optional<Edge> first = search.first();
  return {first, search.at_end()};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
