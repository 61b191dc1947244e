// SPDX-License-Identifier: MIT
// The exact motion: prepared, read, and evaluated for whole grids.
#include "motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "numbers.hpp"
#include "polhode/free/rounding_sensitivity.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/light/lommel_seeliger.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode_web.h"
#include "refusals.hpp"

using namespace polhode;
using namespace polhode::web;

namespace {

// So many states lie on the stack at a time.
constexpr std::size_t block = 256;

// Axes of the invariable plane: inertial ones brought by the least turn to where the third is the
// momentum.
struct InvariableAxes {
  Vec3 first, second, across;
};
InvariableAxes invariable_axes(const Vec3& momentum) {
  const double G = norm(momentum);
  const Vec3 k = (1.0 / G) * momentum;
  // about the node of the plane; 1 + |k.z|, so that nothing cancels for either side
  const double side = std::copysign(1.0, k.z), a = 1.0 / (1.0 + std::abs(k.z));
  const Vec3 first{1.0 - a * k.x * k.x, -a * k.x * k.y, -side * k.x};
  return {first, cross(k, first), k};
}

struct Light {
  light::Ellipsoid body;
  Vec3 to_sun, to_observer;
};

double* put_andoyer(const AndoyerState& a, double* to) {
  return put_all(to, a.l, a.g, a.h, a.L, a.G, a.H);
}

// The rows of `kind` for states of a motion, those of a block.
struct RowMaker {
  const FreeRotation& motion;
  int kind;
  InvariableAxes plane;
  Light light;

  Vec3 rate(const RotorState& s) const {
    if (kind == POLHODE_BODY_RATES) return angular_velocity(motion.body(), s);
    const Vec3 w = inertial_angular_velocity(motion.body(), s);
    if (kind == POLHODE_INERTIAL_RATES) return w;
    return {dot(w, plane.first), dot(w, plane.second), dot(w, plane.across)};
  }
  double brightness(const RotorState& s) const {
    const Quaternion back = conj(normalized(s.q));
    return light::lommel_seeliger_brightness(light.body, rotate(back, light.to_sun),
                                             rotate(back, light.to_observer));
  }

  double* rows(std::span<const RotorState> states, double* to) const {
    for (const RotorState& s : states) {
      if (kind == POLHODE_STATES)
        to = put(to, s);
      else if (kind == POLHODE_ANDOYER_ROWS)
        to = put_andoyer(to_andoyer(s), to);
      else if (kind == POLHODE_BRIGHTNESS)
        *to++ = brightness(s);
      else
        to = put(to, rate(s));
    }
    return to;
  }
};

Light light_of(const double* x) {
  if (x == nullptr) return {{1.0, 1.0, 1.0}, {}, {}};
  return {{x[0], x[1], x[2]}, vector(x + 3), vector(x + 6)};
}

}  // namespace

polhode_motion* polhode_motion_of(const double* moments, const double* x, double t0) {
  polhode_motion* result = nullptr;
  guarded([&] { result = new polhode_motion{FreeRotation(body(moments), state(x), t0)}; });
  return result;
}
void polhode_motion_release(polhode_motion* motion) { delete motion; }

void polhode_motion_summary(const polhode_motion* motion, double* summary) {
  const FreeRotation& m = motion->rotation;
  double* to = put_all(summary, m.regime(), m.momentum(), m.energy(), m.modulus().m(),
                       m.modulus().m1(), m.separatrix_distance(), m.polhode_period(),
                       m.precession_rate_long(), m.precession_rate_short(), m.circulation_action());
  to = put(to, (1.0 / m.momentum()) * inertial_momentum(m.initial_state()));
  const SadovFrequencies n = sadov_frequencies(m);
  const TumblingAngles a = tumbling_angles(m);
  put_all(to, n.n_l, n.n_g, a.long_least, a.long_most, a.short_least, a.short_most);
}

void polhode_motion_at(const polhode_motion* motion, double t, double* result) {
  put(result, motion->rotation.at(t));
}

int polhode_motion_chart(const polhode_motion* motion, int chart, double t, double* numbers) {
  return guarded([&] {
    const FreeRotation& m = motion->rotation;
    if (chart == POLHODE_SERRET) {
      const SerretState s = to_serret(m, t);
      put_all(numbers, s.g0, s.h, s.t0, s.G, s.H, s.T, s.sign_g1, s.sign_g3);
    } else if (chart == POLHODE_SADOV) {
      const SadovState s = to_sadov(m, t);
      put_all(numbers, s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h,
              s.region == SadovRegion::long_axis, s.lobe);
    } else {
      const TumblerState s = to_tumbler(m, t);
      double* to = put_all(numbers, s.precession_period, s.rotation_period);
      to = put(to, s.pole);
      put_all(to, s.mode == Regime::long_axis, s.phi0, s.psi0, s.branch, s.sense);
    }
  });
}

double polhode_motion_sensitivity(const polhode_motion* motion, double t) {
  return free::rounding_sensitivity(motion->rotation, t);
}

int polhode_motion_flips(const polhode_motion* motion, double start, double stop, uint32_t most,
                         double* times, double* interval) {
  const FreeRotation& m = motion->rotation;
  *interval = std::numeric_limits<double>::infinity();
  if (m.regime() == Regime::rest || m.regime() == Regime::steady) return 0;
  int count = 0;
  const int failed = guarded([&] {
    // l = +-pi/2, the base point of Serret's time: the momentum along the middle axis is 0
    const double at = to_serret(m, start).t0, half = 0.5 * m.polhode_period();
    *interval = half;
    const double first = std::isfinite(half) ? std::ceil((start - at) / half) : 0.0;
    for (double k = first; static_cast<uint32_t>(count) < most; k += 1.0) {
      const double t = k == 0.0 ? at : at + k * half;
      if (!(t <= stop)) return;
      if (t >= start) times[count++] = t;
    }
  });
  return failed == done ? count : -1;
}

int polhode_motion_rows(const polhode_motion* motion, int kind, const double* times, double start,
                        double step, uint32_t count, const double* light, double* rows) {
  return guarded([&] {
    const FreeRotation& m = motion->rotation;
    const RowMaker maker{m, kind, invariable_axes(inertial_momentum(m.initial_state())),
                         light_of(light)};
    std::array<RotorState, block> states;
    for (std::size_t i = 0; i < count; i += block) {
      const std::span some = std::span(states).first(std::min<std::size_t>(block, count - i));
      // one by one: kernels in lanes would be a quarter of the module
      for (std::size_t k = 0; k < some.size(); ++k)
        some[k] = m.at(times != nullptr ? times[i + k] : start + static_cast<double>(i + k) * step);
      rows = maker.rows(some, rows);
    }
  });
}
