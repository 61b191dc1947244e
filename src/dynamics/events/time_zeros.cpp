// SPDX-License-Identifier: MIT
#include "polhode/dynamics/detail/time_zeros.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Where the sign next to a zero is looked at, in intervals; and in roundings of the time, where
// these are coarse.
constexpr double next_to_zero = 0x1p-20;
// Zeros for less than so much of an interval are one: a touch is flat by rounding.
constexpr double stretch_part = 0x1p-7;
constexpr double zero_roundings = 4.0 * std::numeric_limits<double>::epsilon();
// A look that is nearer to zero than so much of the one before has come there at once.
constexpr double abruptly = 0x1p-36;
// Of a time next to the lowest value of a function, relative.
constexpr double time_grain = 2e-15;

int sign_of(double x) { return x > 0.0 ? 1 : (x < 0.0 ? -1 : 0); }

// The next time to ask for from `t` on, towards `to`: after that part of the way.
double next_to(double t, double to, double part = next_to_zero) {
  const double h = to - t, length = std::fabs(h);
  const double grain = zero_roundings * std::fmax(std::fabs(t), std::fabs(to));
  const double next =
      t + std::copysign(std::fmin(std::fmax(part * length, grain), 0.5 * length), h);
  return next == t ? to : next;
}

// The last zero from t, which is one, on the way to `to`, which is none: halved to rounding.
double last_zero(const TimeFunction& f, double t, double to, double floor = 0.0) {
  for (int trip = 0; trip < 128; ++trip) {
    const double m = t + 0.5 * (to - t);
    if (m == t || m == to) break;
    (std::fabs(f(m)) <= floor ? t : to) = m;
  }
  return t;
}

// The zeros around t, at which f is exactly zero: a stretch, or t alone. f is not zero at `from`
// and `to`.
ZeroSpan zeros_around(const TimeFunction& f, double t, double from, double to) {
  const double before = next_to(t, from, stretch_part), after = next_to(t, to, stretch_part);
  const bool since = before != from && f(before) == 0.0, on = after != to && f(after) == 0.0;
  return {since || on ? last_zero(f, since ? before : t, from) : t,
          since || on ? last_zero(f, on ? after : t, to) : t};
}

// Whether values of different sign are those of a folded angle that jumps. Where that is not clear,
// the interval is halved: the difference becomes a whole period, or nothing (60 trips at most).
bool jumps(const TimeFunction& f, Look& a, Look& b, double period) {
  for (int trip = 0; trip < 60; ++trip) {
    const double change = std::fabs(b.value - a.value);
    if (!(change > 0.25 * period)) return false;
    if (change > 0.75 * period) return true;
    Look m{a.t + 0.5 * (b.t - a.t), 0.0, 0.0};
    if (m.t == a.t || m.t == b.t) break;
    m.value = f(m.t);
    (sign_of(m.value) == sign_of(a.value) ? a : b) = m;
  }
  return std::fabs(b.value - a.value) > 0.5 * period;
}

// The lowest of a function that is v = sign f, between a, where it falls, and b, where it rises: by
// parabolas through three points, or a golden section where these do not lead on. Where v is like a
// power other than 2 of the distance, a V or something flatter than a parabola, the parabolas are
// those of a power of v.
class LowestValue {
 public:
  LowestValue(const TimeFunction& f, int sign, const Look& a, const Look& b)
      : f_(f), sign_(sign), low_(seen(a)), high_(seen(b)) {
    // The lowest point of the cubic through both ends with their slopes is near.
    const double h = b.t - a.t, ga = sign * a.slope * h, gb = sign * b.slope * h;
    const double d = ga + gb - 3.0 * (high_.v - low_.v);
    const double root = std::sqrt(std::max(d * d - ga * gb, 0.0));
    const double x = 1.0 - (gb + root - d) / (gb - ga + 2.0 * root);
    mid_ = at(a.t + (x > 0.01 && x < 0.99 ? x : 0.5) * h);
  }

  // The lowest point, or the first found at zero or beyond; 128 trips at most, usually 3. `order`:
  // the power that v would be if it touched zero.
  Look found(double enough, double order) {
    for (int trip = 0; trip < 128 && mid_.v > enough; ++trip) {
      const double width = high_.t - low_.t;
      double drop = 0.0;
      double t = vertex(drop);
      bool sections = trip % 4 == 3;
      if (trip > 1 && drop < 0.01 * shape(mid_.v)) {
        if (!may_reach_zero()) break;
        power_ = 2.0 / order;
        sections = true;
      }
      const bool inside = (t - low_.t) * (high_.t - t) > 0.0;
      if (!inside || sections) t = golden();
      const double least = 1e-8 * std::fabs(width) + 1e-15 * std::fabs(mid_.t);
      if (std::fabs(t - mid_.t) < least) t = mid_.t + std::copysign(least, golden() - mid_.t);
      if (!((t - low_.t) * (high_.t - t) > 0.0)) break;
      if (!narrow(at(t))) break;
    }
    return {mid_.t, sign_ * mid_.v, 0.0};
  }

 private:
  struct Point {
    double t;
    double v;
  };
  Point seen(const Look& look) const { return {look.t, sign_ * look.value}; }
  Point at(double t) const { return {t, sign_ * f_(t)}; }
  double shape(double v) const {
    return power_ == 1.0 ? v : std::copysign(std::pow(std::fabs(v), power_), v);
  }
  // Not so where v is above zero with its tangents at the middle, as far as the wider side goes.
  // The kink of a V may lie next to the middle, on either side of it: the steeper one counts.
  bool may_reach_zero() const {
    const double before = low_.t - mid_.t, after = high_.t - mid_.t;
    const double wide = std::fmax(std::fabs(before), std::fabs(after));
    const double near = std::fmax(0x1p-10 * wide, 0x1p-44 * std::fabs(mid_.t));
    double slope = 0.0;
    for (const double side : {before, after}) {
      const double step = std::copysign(std::fmin(near, std::fabs(side)), side);
      slope = std::fmax(slope, std::fabs((at(mid_.t + step).v - mid_.v) / step));
    }
    return mid_.v <= slope * wide;
  }

  // Of the parabola, and by how much it lies below the middle.
  double vertex(double& drop) const {
    const double h0 = mid_.t - low_.t, h1 = high_.t - mid_.t;
    const double mid = shape(mid_.v);
    const double s0 = (mid - shape(low_.v)) / h0, s1 = (shape(high_.v) - mid) / h1;
    const double half_curvature = (s1 - s0) / (h0 + h1);
    const double slope = s0 + half_curvature * h0;
    const double move = -0.5 * slope / half_curvature;
    drop = std::fabs(0.5 * slope * move);
    return mid_.t + move;
  }
  double golden() const {
    constexpr double part = 0.381966011250105;
    const double h0 = mid_.t - low_.t, h1 = high_.t - mid_.t;
    return std::fabs(h0) > std::fabs(h1) ? mid_.t - part * h0 : mid_.t + part * h1;
  }
  bool narrow(const Point& p) {
    if (std::isnan(p.v)) return false;
    const bool before = (mid_.t - p.t) * (high_.t - low_.t) > 0.0;
    if (p.v < mid_.v) {
      (before ? high_ : low_) = mid_;
      mid_ = p;
    } else {
      (before ? low_ : high_) = p;
    }
    return true;
  }

  const TimeFunction& f_;
  double sign_;
  Point low_, high_, mid_{};
  double power_ = 1.0;  // of v, whose parabolas are looked at
};

// How sign * f falls from a and rises to b, per interval; and the power of the time since its
// lowest place that it would be like if it touched zero.
struct Dip {
  double falls, rises;
  double order;
};
// No value if it does not come near zero.
std::optional<Dip> dip_of(int sign, const Look& a, const Look& b) {
  const double h = b.t - a.t, va = sign * a.value, vb = sign * b.value;
  const double falls = sign * a.slope * h, rises = sign * b.slope * h;
  if (!(falls < 0.0 && rises > 0.0)) return std::nullopt;
  if (va + 2.0 * falls > 0.0 && vb - 2.0 * rises > 0.0)
    return std::nullopt;  // twice as steep, it comes not near
  // Of |t - t0|^n: value over slope is the distance from t0 over n.
  const double order = std::round(std::fmin(1.0 / (vb / rises - va / falls), 64.0));
  return Dip{falls, rises, std::fmax(order, 1.0)};
}

}  // namespace

// Regula falsi by the rule of Anderson and Bjorck, with a bisection if three trips have not
// halved the bracket: at most 128 trips, usually 7.
std::optional<Root> root_between(const TimeFunction& f, Look a, Look b, double close) {
  if (std::isnan(a.value) || std::isnan(b.value)) return std::nullopt;
  const bool rises = b.value > 0.0;
  int last_moved = -1;
  double last = std::numeric_limits<double>::quiet_NaN(), width = std::fabs(b.t - a.t);
  for (int trip = 0; trip < 128; ++trip) {
    double t = b.t - b.value * ((b.t - a.t) / (b.value - a.value));
    bool bisects = !((t - a.t) * (b.t - t) > 0.0);
    if (trip % 3 == 2) {
      const double now = std::fabs(b.t - a.t);
      bisects = bisects || now > 0.5 * width;
      width = now;
    }
    if (bisects) t = a.t + 0.5 * (b.t - a.t);
    if (t == a.t || t == b.t) break;  // neighbours
    if (std::fabs(t - last) <= close) return Root{t, false};
    last = t;
    const double value = f(t);
    if (std::isnan(value)) return std::nullopt;
    if (value == 0.0) return Root{t, true};
    const int moved = (value > 0.0) == rises ? 1 : 0;
    Look& near = moved == 1 ? b : a;
    if (moved == last_moved) {  // else the far end never moves
      const double m = 1.0 - value / near.value;
      (moved == 1 ? a : b).value *= m > 0.0 ? m : 0.5;
    }
    near = {t, value, 0.0};
    last_moved = moved;
  }
  return Root{b.t, false};
}

std::optional<Look> dip_between(const TimeFunction& f, int sign, const Look& a, const Look& b,
                                double enough) {
  const std::optional<Dip> dip = dip_of(sign, a, b);
  if (!dip) return std::nullopt;
  return LowestValue(f, sign, a, b).found(enough, dip->order);
}

std::optional<ZeroSpan> crossing_between(const TimeFunction& f, Look a, Look b, double period) {
  if (period > 0.0 && jumps(f, a, b, period)) return std::nullopt;
  const std::optional<Root> root = root_between(f, a, b);
  if (!root) return std::nullopt;
  return root->is_exact ? zeros_around(f, root->t, a.t, b.t) : ZeroSpan{root->t, root->t};
}

void ZeroSearch::begin(double t, double value, bool reports) {
  sign_ = sign_of(value);
  at_zero_ = value == 0.0;
  t_zero_ = t;
  counts_ = reports;
  see(value, 0.0);
}

void ZeroSearch::see(double value, double before) {
  if (std::isfinite(value)) scale_ = std::fmax(scale_, std::fabs(value));
  floor_ = std::fmin(touching * scale_, abruptly * std::fabs(before));
  is_near_ = value != 0.0 && std::fabs(value) <= floor_;
}

void ZeroSearch::cross(const TimeFunction& f, const Look& a, const Look& b,
                       std::vector<Zero>& found) {
  const int sign = sign_of(b.value);
  const std::optional<ZeroSpan> at = crossing_between(f, a, b, period_);
  sign_ = sign;
  if (!at) return;
  found.push_back({at->first, sign});
  if (at->last != at->first) found.push_back({at->last, sign});
}

// Between values of one sign.
void ZeroSearch::turn_around(const TimeFunction& f, const Look& a, const Look& b,
                             std::vector<Zero>& found) {
  const std::optional<Dip> dip = dip_of(sign_, a, b);
  if (!dip) return;
  const double va = sign_ * a.value, vb = sign_ * b.value;
  // near its lowest value f is a parabola, or a V, asked for at times as coarse as doubles are
  // there
  const double grain = time_grain * std::fabs(b.t / (b.t - a.t));
  const double enough = touching * std::max(va, vb) +
                        (dip->rises - dip->falls) * grain * (dip->order > 1.0 ? 0.5 * grain : 1.0);
  if (va <= enough || vb <= enough) {  // at a look: of this interval, by the slope there
    found.push_back({va <= enough ? std::nextafter(a.t, b.t) : b.t, 0});
    return;
  }
  const Look m = LowestValue(f, sign_, a, b).found(enough, dip->order);
  const double lowest = sign_ * m.value;
  if (lowest < -enough) {
    cross(f, a, m, found);
    cross(f, m, b, found);
  } else if (lowest <= enough) {
    const ZeroSpan span = m.value == 0.0 ? zeros_around(f, m.t, a.t, b.t) : ZeroSpan{m.t, m.t};
    found.push_back({span.first, span.first != span.last ? -sign_ : 0});
    if (span.first != span.last) found.push_back({span.last, sign_});
  }
}

// Whether f is zero from a zero at a to one at b, and so is where it began.
bool ZeroSearch::stays(const TimeFunction& f, const Look& a, const Look& b,
                       std::vector<Zero>& found) {
  if (!(std::fabs(b.value) <= floor_)) return false;
  const double values[] = {a.value, f(next_to(a.t, b.t)), f(a.t + 0.5 * (b.t - a.t)),
                           f(next_to(b.t, a.t)), b.value};
  bool exactly = true;
  for (const double x : values) {
    if (!(std::fabs(x) <= floor_)) return false;
    exactly = exactly && x == 0.0;
  }
  begin_stretch(exactly, found);
  t_zero_ = b.t;
  return true;
}

void ZeroSearch::begin_stretch(bool exactly, std::vector<Zero>& found) {
  if (!stretch_ && counts_) found.push_back({t_zero_, -sign_});
  is_exact_ = exactly && (!stretch_ || is_exact_);
  at_zero_ = stretch_ = true;
}

// From a zero at a, and how far: to where f is not zero any more. None where it is NaN.
std::optional<Look> ZeroSearch::leave(const TimeFunction& f, const Look& a, const Look& b,
                                      std::vector<Zero>& found) {
  Look next = a;
  const double floor = stretch_ && !is_exact_ ? floor_ : 0.0;
  const double near = next_to(a.t, b.t);
  for (const double t : {near, next_to(a.t, b.t, stretch_part), a.t + 0.5 * (b.t - a.t),
                         next_to(b.t, a.t, stretch_part), b.t}) {
    next.t = t;
    next.value = t == b.t ? b.value : f(t);
    if (std::isnan(next.value)) return std::nullopt;
    if (!(std::fabs(next.value) <= floor)) break;
    if (t != near) begin_stretch(next.value == 0.0, found);
  }
  const int sign = sign_of(next.value);
  if (stretch_)
    found.push_back({last_zero(f, a.t, next.t, floor), sign});
  else if (sign_ != 0 && sign != sign_)
    found.push_back({t_zero_, sign});
  else if (counts_)
    found.push_back({t_zero_, sign_ == 0 ? sign : 0});
  sign_ = sign;
  at_zero_ = stretch_ = false;
  return next;
}

void ZeroSearch::between(const TimeFunction& f, Look a, Look b, std::vector<Zero>& found) {
  const double value_a = a.value, value_b = b.value, t_b = b.t;
  const std::size_t earlier = found.size();
  if (std::isnan(value_a) || std::isnan(value_b)) return;
  if ((at_zero_ || is_near_) && stays(f, a, b, found)) return;
  if (at_zero_) {
    const std::optional<Look> left = leave(f, a, b, found);
    if (!left) return;
    a = *left;
  }
  for (const double part : {next_to_zero, stretch_part})
    if (b.value == 0.0 && a.t != t_b) {
      b.t = next_to(t_b, a.t, part);
      b.value = f(b.t);
      if (std::isnan(b.value)) return;
    }
  const int after = sign_of(b.value);
  if (after == 0) {
    found.push_back({last_zero(f, b.t, a.t), -sign_});
    stretch_ = is_exact_ = true;
  } else if (after != sign_) {
    cross(f, a, b, found);
  } else {
    turn_around(f, a, b, found);
  }
  if (value_b == 0.0) {
    at_zero_ = counts_ = true;
    t_zero_ = t_b;
  }
  see(value_b, value_a);
  if (!is_near_) return;
  // if the next look is as near, a stretch has begun here
  t_zero_ = last_zero(f, t_b, a.t, floor_);
  counts_ = true;
  for (std::size_t i = earlier; i < found.size(); ++i)
    if ((found[i].t - t_zero_) * (t_b - a.t) >= 0.0) counts_ = false;
}

void ZeroSearch::end(std::vector<Zero>& found, bool is_near_enough) {
  const bool near = is_near_enough && is_near_ && !at_zero_;
  if ((at_zero_ || near) && (counts_ || stretch_))
    found.push_back({t_zero_, stretch_ ? 0 : -sign_});
  at_zero_ = is_near_ = false;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
