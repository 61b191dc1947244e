// SPDX-License-Identifier: MIT
#include "polhode/rotor/poincare.hpp"

#include <array>

#include "tables/detail/chart_families.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

// In rows each set has names of its own, since another set has other numbers; G is that of Andoyer.
struct Columns {
  std::string_view sigma, Q1, Q2, P1, P2;
};

consteval std::array<ChartVariable, 6> variables_of(Pole J, Pole I, const Columns& in_rows) {
  const bool along_3 = J == Pole::zero, along_z = I == Pole::zero;
  const auto sigma = along_3   ? (along_z ? "Andoyer's l + g + h." : "Andoyer's l + g - h.")
                     : along_z ? "Andoyer's g - l + h."
                               : "Andoyer's g - l - h.";
  const auto Q1 = along_3 ? "-sqrt(2 (G - L)) sin l; 0 where the momentum is along body axis 3."
                          : "sqrt(2 (G + L)) sin l; 0 where the momentum is against body axis 3.";
  const auto Q2 = along_z
                      ? "-sqrt(2 (G - H)) sin h; 0 where the momentum is along inertial axis 3."
                      : "sqrt(2 (G + H)) sin h; 0 where the momentum is against inertial axis 3.";
  using enum Dimension;
  return {ChartVariable("sigma", angle, sigma, "20", in_rows.sigma),
          ChartVariable("Q1", root_momentum, Q1, "-0.1", in_rows.Q1),
          ChartVariable("Q2", root_momentum, Q2, "-0.2", in_rows.Q2),
          ChartVariable("G", momentum, "Length of the angular momentum; not negative.", "1.0"),
          ChartVariable("P1", root_momentum,
                        along_3 ? "sqrt(2 (G - L)) cos l." : "sqrt(2 (G + L)) cos l.", "0.3",
                        in_rows.P1),
          ChartVariable("P2", root_momentum,
                        along_z ? "sqrt(2 (G - H)) cos h." : "sqrt(2 (G + H)) cos h.", "0.4",
                        in_rows.P2)};
}

constexpr auto variables_0_0 =
    variables_of(Pole::zero, Pole::zero, {"sigma_0_0", "Q1_0_0", "Q2_0_0", "P1_0_0", "P2_0_0"});
constexpr auto variables_0_pi =
    variables_of(Pole::zero, Pole::pi, {"sigma_0_pi", "Q1_0_pi", "Q2_0_pi", "P1_0_pi", "P2_0_pi"});
constexpr auto variables_pi_0 =
    variables_of(Pole::pi, Pole::zero, {"sigma_pi_0", "Q1_pi_0", "Q2_pi_0", "P1_pi_0", "P2_pi_0"});
constexpr auto variables_pi_pi = variables_of(
    Pole::pi, Pole::pi, {"sigma_pi_pi", "Q1_pi_pi", "Q2_pi_pi", "P1_pi_pi", "P2_pi_pi"});

template <Pole J, Pole I>
RotorState from_poincare(const ChartNumbers& x, const ChartPlace&) {
  return to_rotor(poincare_state(x[0], x[1], x[2], x[3], x[4], x[5], J, I));
}
template <Pole J, Pole I>
ChartNumbers to_poincare_numbers(const RotorState& s, const ChartPlace&) {
  const PoincareState p = to_poincare(s, J, I);
  return {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2};
}

constexpr ChartField fields_0_0[] = {{"pole_J", "zero"}, {"pole_I", "zero"}};
constexpr ChartField fields_0_pi[] = {{"pole_J", "zero"}, {"pole_I", "pi"}};
constexpr ChartField fields_pi_0[] = {{"pole_J", "pi"}, {"pole_I", "zero"}};
constexpr ChartField fields_pi_pi[] = {{"pole_J", "pi"}, {"pole_I", "pi"}};

template <Pole J, Pole I>
consteval ChartKind set(std::string_view name, std::string_view help,
                        std::span<const ChartVariable> variables,
                        std::span<const ChartField> fields) {
  return {.name = name,
          .help = help,
          .variables = variables,
          .to_hub = from_poincare<J, I>,
          .from_hub = to_poincare_numbers<J, I>,
          .in_scenarios = true,
          .state_class = "PoincareState",
          .state_fields = fields,
          .sources = {&andoyer1923, 1}};
}

constexpr ChartKind charts[] = {
    set<Pole::zero, Pole::zero>(
        "poincare-0-0",
        "The Poincare-type set for a momentum near body axis 3 and near inertial axis 3.",
        variables_0_0, fields_0_0),
    set<Pole::zero, Pole::pi>(
        "poincare-0-pi",
        "The Poincare-type set for a momentum near body axis 3 and near minus inertial axis 3.",
        variables_0_pi, fields_0_pi),
    set<Pole::pi, Pole::zero>(
        "poincare-pi-0",
        "The Poincare-type set for a momentum near minus body axis 3 and near inertial axis 3.",
        variables_pi_0, fields_pi_0),
    set<Pole::pi, Pole::pi>("poincare-pi-pi",
                            "The Poincare-type set for a momentum near minus body axis 3 and near "
                            "minus inertial axis 3.",
                            variables_pi_pi, fields_pi_pi),
};

}  // namespace

std::span<const ChartKind> poincare_charts() { return charts; }

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
