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
constexpr double roundings = 4.0 * std::numeric_limits<double>::epsilon();
// Of a time next to the lowest value of a function, relative.
constexpr double time_grain = 2e-15;

int sign_of(double x) { return x > 0.0 ? 1 : (x < 0.0 ? -1 : 0); }

// The next time to ask for from `t` on, towards `to`.
double next_to(double t, double to) {
  const double h = to - t, length = std::fabs(h);
  const double grain = roundings * std::fmax(std::fabs(t), std::fabs(to));
  const double next =
      t + std::copysign(std::fmin(std::fmax(next_to_zero * length, grain), 0.5 * length), h);
  return next == t ? to : next;
}

// Of a function that is zero at t and not at `to`, the last zero: halved to rounding.
double last_zero(const TimeFunction& f, double t, double to) {
  for (int trip = 0; trip < 128; ++trip) {
    const double m = t + 0.5 * (to - t);
    if (m == t || m == to) break;
    (f(m) == 0.0 ? t : to) = m;
  }
  return t;
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
// parabolas through three points, or a golden section where these do not lead on.
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

  // The lowest point, or the first found at zero or beyond; 64 trips at most, usually 3.
  Look found(double enough) {
    for (int trip = 0; trip < 64 && mid_.v > enough; ++trip) {
      const double width = high_.t - low_.t;
      double drop = 0.0;
      double t = vertex(drop);
      if (trip > 1 && drop < 0.01 * mid_.v) break;  // zero is out of reach
      const bool inside = (t - low_.t) * (high_.t - t) > 0.0;
      if (!inside || trip % 4 == 3) t = golden();
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

  // Of the parabola, and by how much it lies below the middle.
  double vertex(double& drop) const {
    const double h0 = mid_.t - low_.t, h1 = high_.t - mid_.t;
    const double s0 = (mid_.v - low_.v) / h0, s1 = (high_.v - mid_.v) / h1;
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
};

}  // namespace

// Illinois' regula falsi with a bisection at every third trip: at most 128 trips, usually 10.
std::optional<double> crossing_between(const TimeFunction& f, Look a, Look b, double period) {
  if (period > 0.0 && jumps(f, a, b, period)) return std::nullopt;
  if (std::isnan(a.value) || std::isnan(b.value)) return std::nullopt;
  const bool rises = b.value > 0.0;
  int last_moved = -1;
  for (int trip = 0; trip < 128; ++trip) {
    double t = b.t - b.value * ((b.t - a.t) / (b.value - a.value));
    if (trip % 3 == 2 || !((t - a.t) * (b.t - t) > 0.0)) t = a.t + 0.5 * (b.t - a.t);
    if (t == a.t || t == b.t) break;  // neighbours
    const double value = f(t);
    if (std::isnan(value)) return std::nullopt;
    if (value == 0.0) {
      const double next = next_to(t, b.t);
      return next != b.t && f(next) == 0.0 ? last_zero(f, next, b.t) : t;
    }
    const int moved = (value > 0.0) == rises ? 1 : 0;
    (moved == 1 ? b : a) = {t, value, 0.0};
    if (moved == last_moved) (moved == 1 ? a : b).value *= 0.5;  // else the far end never moves
    last_moved = moved;
  }
  return b.t;
}

void ZeroSearch::begin(double t, double value, bool reports) {
  sign_ = sign_of(value);
  at_zero_ = value == 0.0;
  t_zero_ = t;
  stretch_ = !reports;
}

void ZeroSearch::leave_zero(int sign, std::vector<Zero>& found) {
  at_zero_ = false;
  if (sign_ != 0 && sign != sign_) {
    found.push_back({t_zero_, sign});
  } else if (!stretch_) {
    found.push_back({t_zero_, sign_ == 0 ? sign : 0});
  }
  sign_ = sign;
}

void ZeroSearch::reach_zero(double t, bool stays) {
  t_zero_ = t;
  stretch_ = stays || at_zero_;
  at_zero_ = true;
}

void ZeroSearch::cross(double t, int sign, std::vector<Zero>& found) {
  found.push_back({t, sign});
  sign_ = sign;
}

// Between values of one sign.
void ZeroSearch::turn_around(const TimeFunction& f, const Look& a, const Look& b,
                             std::vector<Zero>& found) {
  const double h = b.t - a.t, va = sign_ * a.value, vb = sign_ * b.value;
  const double falls = sign_ * a.slope * h, rises = sign_ * b.slope * h;
  if (!(falls < 0.0 && rises > 0.0)) return;
  if (va + 2.0 * falls > 0.0 && vb - 2.0 * rises > 0.0)
    return;  // twice as steep, it comes not near
  // near its lowest value f is a parabola, asked for at times as coarse as doubles are there
  const double grain = time_grain * std::fabs(b.t / h);
  const double enough = touching * std::max(va, vb) + 0.5 * (rises - falls) * grain * grain;
  if (va <= enough || vb <= enough) {  // at a look: of this interval, by the slope there
    found.push_back({va <= enough ? std::nextafter(a.t, b.t) : b.t, 0});
    return;
  }
  const Look m = LowestValue(f, sign_, a, b).found(enough);
  const double lowest = sign_ * m.value;
  if (lowest < -enough) {
    const int sign = sign_;
    if (const auto t = crossing_between(f, a, m, period_)) cross(*t, -sign, found);
    if (const auto t = crossing_between(f, m, b, period_)) cross(*t, sign, found);
  } else if (lowest <= enough) {
    found.push_back({m.t, 0});
  }
}

void ZeroSearch::between(const TimeFunction& f, Look a, Look b, std::vector<Zero>& found) {
  const double t_a = a.t, t_b = b.t;
  if (a.value == 0.0) {
    a.t = next_to(t_a, t_b);
    a.value = f(a.t);
    if (std::isnan(a.value)) return;
    if (a.value == 0.0) {
      stretch_ = true;
    } else {
      leave_zero(sign_of(a.value), found);
    }
  }
  const bool ends_at_zero = b.value == 0.0;
  if (ends_at_zero) {
    b.t = next_to(t_b, t_a);
    b.value = f(b.t);
    if (std::isnan(b.value)) return;
  }
  const int before = sign_of(a.value), after = sign_of(b.value);
  if (before == 0 && after != 0) {
    if (sign_ != 0 && sign_ != after) t_zero_ = last_zero(f, a.t, b.t);
    leave_zero(after, found);
  } else if (before != 0 && after == 0) {
    reach_zero(b.t, true);
  } else if (before * after < 0) {
    if (const auto t = crossing_between(f, a, b, period_)) found.push_back({*t, after});
    sign_ = after;
  } else if (before != 0) {
    turn_around(f, a, b, found);
  }
  if (ends_at_zero) reach_zero(t_b, after == 0);
}

void ZeroSearch::end(std::vector<Zero>& found) {
  if (at_zero_ && !stretch_) found.push_back({t_zero_, -sign_});
  at_zero_ = false;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
