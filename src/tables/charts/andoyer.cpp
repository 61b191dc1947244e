// SPDX-License-Identifier: MIT
#include "polhode/rotor/andoyer.hpp"

#include "tables/detail/chart_families.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr ChartVariable variables[] = {
    {"l", Dimension::angle,
     "From the node of the body equator on the invariable plane to body axis 1.", "70", "", "0"},
    {"g", Dimension::angle,
     "From the node of the invariable plane to the node of the body equator.", "20", "", "0"},
    {"h", Dimension::angle, "From inertial axis 1 to the node of the invariable plane.", "40", "",
     "0"},
    {"L", Dimension::momentum, "Angular momentum along body axis 3; |L| <= G.", "0.8"},
    {"G", Dimension::momentum, "Length of the angular momentum; not negative.", "1.0"},
    {"H", Dimension::momentum,
     "Angular momentum along inertial axis 3; |H| <= G. Left out it is G: a momentum along that "
     "axis.",
     "0.5", "", "G"},
};

RotorState from_andoyer(const ChartNumbers& x, const ChartPlace&) {
  return to_rotor(andoyer_state(x[0], x[1], x[2], x[3], x[4], x[5]));
}
ChartNumbers to_andoyer_numbers(const RotorState& s, const ChartPlace&) {
  const AndoyerState a = to_andoyer(s);
  return {a.l, a.g, a.h, a.L, a.G, a.H};
}

constexpr ChartKind charts[] = {
    {.name = "andoyer",
     .help = "Andoyer variables.",
     .variables = variables,
     .to_hub = from_andoyer,
     .from_hub = to_andoyer_numbers,
     .in_scenarios = true,
     .state_class = "AndoyerState",
     .sources = {&andoyer1923, 1}},
};

}  // namespace

std::span<const ChartKind> andoyer_charts() { return charts; }

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
