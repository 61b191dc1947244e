// SPDX-License-Identifier: MIT
#include "polhode/free/serret.hpp"

#include "tables/detail/chart_families.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr ChartVariable variables[] = {
    {"g0", Dimension::angle, "Andoyer's g at the instant t0.", "20"},
    {"h", Dimension::angle, "From inertial axis 1 to the node of the invariable plane.", "40"},
    {"t0", Dimension::time, "Instant at which the elliptic argument is zero.", "0.2"},
    {"G", Dimension::momentum, "Length of the angular momentum; positive.", "1.0"},
    {"H", Dimension::momentum, "Angular momentum along inertial axis 3; |H| <= G.", "0.5"},
    {"T", Dimension::energy, "Kinetic energy, from G^2/(2 Imax) to G^2/(2 Imin).", "0.505"},
};
constexpr std::size_t column_order[] = {0, 2, 5, 1, 3, 4};  // those of its own first

constexpr ChartOption options[] = {
    {"sign_g1", "1|-1", "1",
     "Sign of the momentum along the long axis at t0: the side that it circles in LAM.", "1"},
    {"sign_g3", "1|-1", "1",
     "Sign of the momentum along the short axis at t0: the side that it circles in SAM.", "1"},
};

SerretState state(const ChartNumbers& x) {
  return {x[0], x[1], x[2], x[3], x[4], x[5], static_cast<int>(x[6]), static_cast<int>(x[7])};
}

RotorState from_serret(const ChartNumbers& x, const ChartPlace& at) {
  return to_rotor(*at.body, state(x), at.t);
}
FreeRotation motion_of(const Body& body, const ChartNumbers& x) {
  return polhode::free_rotation(body, state(x));
}
ChartNumbers of_motion(const FreeRotation& motion, double t) {
  const SerretState e = to_serret(motion, t);
  return {e.g0,
          e.h,
          e.t0,
          e.G,
          e.H,
          e.T,
          static_cast<double>(e.sign_g1),
          static_cast<double>(e.sign_g3)};
}
ChartNumbers to_serret_numbers(const RotorState& s, const ChartPlace& at) {
  return of_motion(FreeRotation(*at.body, s, at.t), at.t);
}

constexpr Citation sources[] = {
    {"serret1866",
     "Serret, J. A. (1866). Memoire sur l'emploi de la methode de la variation des arbitraires "
     "dans la theorie des mouvements de rotation. Memoires de l'Academie des sciences de Paris "
     "35, 585-616.",
     "Serret's elements"},
};

constexpr ChartKind charts[] = {
    {.name = "serret",
     .help = "Serret's elements: constants of the free motion.",
     .variables = variables,
     .to_hub = from_serret,
     .from_hub = to_serret_numbers,
     .needs_body = true,
     .in_scenarios = true,
     .options = options,
     .from_motion = of_motion,
     .to_motion = motion_of,
     .is_constant = true,
     .column_order = column_order,
     .state_class = "SerretState",
     .sources = sources},
};

}  // namespace

std::span<const ChartKind> serret_charts() { return charts; }

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
