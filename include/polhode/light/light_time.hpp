// SPDX-License-Identifier: MIT
// Light time: from when light reached the observer to when it left the body, and the vectors to Sun
// and observer from positions that are functions of time.
//
// Equations   t_body = t - |observer(t) - body(t_body)| / c, by iteration; to_observer =
//             observer(t) - body(t_body), to_sun = sun(t_body) - body(t_body).
// Units       c in lengths of the vectors per unit of time of t: 299792.458 km/s, or with au
//             173.144632674 au/d = 0.00200398880410 au/s.
// Domain      positions of body, observer and Sun from one origin along the inertial axes I, as
//             calls position(t) -> Vec3; with the Sun as origin its own is 0. Bodies slower than
//             light. The iteration begins with no light time, so that the position that moves must
//             be finite at t as well; a table may hold its ends. Sunlight is taken from where the
//             Sun is at t_body: aberration, 1e-4 rad, is left out.
// Accuracy    the light time to a few roundings of itself and of t.
// Errors      DomainError naming the point: no vector to the observer, c not above 0, a light time
//             that does not converge or is below 0. What a position throws passes through.
// Cost        four or five calls of the moving position a point.
#pragma once

#include <cmath>
#include <cstddef>

#include "polhode/light/detail/light_time_root.hpp"
#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

// Whose times the points of a light curve have: when light arrived, or when it left.
enum class LightTime { at_observer, at_body };

// Times at the observer become those at the body, by the distance to the observer of each point.
LightCurve at_body(LightCurve curve, double c);
// By one light time for all.
LightCurve at_body_after(LightCurve curve, double light_time);

// The same session with its vectors, and with times at the body, whose times `given` are.
template <class Body, class Observer, class Sun>
LightCurve with_vectors(LightCurve curve, LightTime given, const Body& body,
                        const Observer& observer, const Sun& sun, double c) {
  detail::require_speed_of_light(c);
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    LightPoint& p = curve.points[k];
    const bool arrived = given == LightTime::at_observer;
    const Vec3 fixed = arrived ? observer(p.t) : body(p.t);
    const double tau = detail::light_time_root(
        [&](double lag) {
          return norm(arrived ? fixed - body(p.t - lag) : observer(p.t + lag) - fixed);
        },
        p.t, c);
    if (!std::isfinite(tau))
      detail::fail_light_time(curve, k,
                              "its light time does not converge; expected finite positions of "
                              "bodies that are slower than light");
    const double left = arrived ? p.t - tau : p.t;
    const Vec3 of_body = arrived ? body(left) : fixed;
    p.to_observer = (arrived ? fixed : observer(p.t + tau)) - of_body;
    p.to_sun = sun(left) - of_body;
    p.t = left;
  }
  return curve;
}

}  // namespace light
}  // namespace v0
}  // namespace polhode
