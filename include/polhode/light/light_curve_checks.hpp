// SPDX-License-Identifier: MIT
// What keeps light curves from being used: the first flaw, as a sentence, before a fit sees it.
//
// Units       those of the light curves.
// Domain      any sessions. A flaw is: no points; a number that is not finite; sigma that is not
//             above 0; times that fall in a session; an observation that stands twice (others at
//             one time are of two telescopes); a relative session of one point, or of a mean flux
//             that is not above 0; and where vectors are needed, one that is missing. Nothing is
//             mended here: times out of order are most often a typing error, or two nights in one
//             session; who knows better asks for in_order_of_time.
// Accuracy    times are compared as they are, without a tolerance.
// Errors      require_sound throws a DomainError with the name of the session and the point, from
//             1.
// Cost        one pass, and a sort of all points for those that two sessions share.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "polhode/light/light_curve.hpp"

namespace polhode {
inline namespace v0 {

struct LightCurveNeeds {
  bool vectors = false;  // to the Sun and to the observer, of each point
};

struct LightCurveFlaw {
  std::size_t curve = 0;             // its place among the sessions, from 0
  std::optional<std::size_t> point;  // its place in the session, from 0; none: the session as such
  std::string text;                  // what is wrong, and what was expected
  enum class Kind { other, order, twice, error };
  Kind kind = Kind::other;  // what would mend it: sorting, leaving the point out, an error
};

// The first in the order of sessions and points; those between sessions come last.
std::optional<LightCurveFlaw> first_flaw(std::span<const LightCurve> curves,
                                         const LightCurveNeeds& needs = {});
// "light curve 2 (NAME): point 3: error 0; expected one above 0"
void require_sound(std::span<const LightCurve> curves, const LightCurveNeeds& needs = {});

// By time; points of one time stay in their order.
LightCurve in_order_of_time(LightCurve curve);

}  // namespace v0
}  // namespace polhode
