// SPDX-License-Identifier: MIT
// Every chart at the edges: momenta and moments of any size that doubles have, 1e-300 from every
// axis, needles, plates, symmetric bodies. What a state loses on the way through a chart is held
// against the documented bounds, the numbers of the flow-adapted charts against a thousand digits.
// A refusal is right only where the header of the chart says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "oracle/chart_conditioning.hpp"
#include "oracle/flow_charts.hpp"
#include "polhode/error.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/system/osculation.hpp"
#include "property/chart_support.hpp"
#include "property/edge_cases.hpp"
#include "worst.hpp"

namespace {

using polhode::test::larger;
using polhode::test::smaller;
using namespace chart_test;
using namespace oracle;
using namespace polhode;

// --- verdicts ---

enum class Verdict { held, refused, left_out, wrong, not_a_number };
struct Result {
  Verdict verdict = Verdict::held;
  double loss = 0.0;
  std::string why;
};

// Where there is nothing to compare.
const Result left_out{Verdict::left_out, 0.0, {}};

double half_turn_distance(const Quaternion& a, const Quaternion& b) {
  const Quaternion r = conj(normalized(a)) * normalized(b);
  return 2.0 * norm(Vec3{r.x, r.y, r.z});
}
// Rotation angle or |change of g| / |g|, whichever is larger.
double loss_of(const RotorState& a, const RotorState& b) {
  const double G = norm(b.g);
  const double change =
      G > 0.0 ? norm(Vec3{a.g.x / G - b.g.x / G, a.g.y / G - b.g.y / G, a.g.z / G - b.g.z / G})
              : norm(a.g);
  const double turn = half_turn_distance(a.q, b.q);
  return std::isnan(turn) || std::isnan(change) ? std::nan("") : larger(turn, change);
}
Result judged(double loss, double allowed, const std::string& what) {
  if (std::isnan(loss)) return {Verdict::not_a_number, loss, what};
  if (loss <= allowed) return {Verdict::held, loss, {}};
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), ": %.2g, allowed %.2g", loss, allowed);
  return {Verdict::wrong, loss, what + text.data()};
}

// What the header of a chart promises at this state.
struct Place {
  double I = 1.0, J = 1.0, D2 = 1.0;  // sines of the angles, and |D2| / G^2
  double J3 = 1.0, theta = 1.0;       // of body axis 3, and between the third axes
  double short_part = 1.0;            // of the momentum along the short axis
  bool needle = false;                // moments of a ratio below 1e-20
  double gap = 1.0;                   // the lesser relative difference of neighbouring moments
  double lower_part = 1.0;            // (I2 - I1) / (I3 - I1), 0 for a sphere
};
constexpr double least_sine = 1e-320;  // that of 0
double double_of(const Long& x) { return static_cast<double>(x); }
double pole_loss(double sine) {
  return smaller(budget::andoyer_pole_eps * eps / sine, budget::andoyer_pole);
}

class Survey {
 public:
  void add(const EdgeCase& c, const Result& r) {
    ++tried_;
    if (r.verdict == Verdict::held) losses_.push_back(r.loss);
    if (r.verdict == Verdict::refused) ++refused_;
    if (r.verdict == Verdict::left_out) ++left_out_;
    if (r.verdict == Verdict::wrong || r.verdict == Verdict::not_a_number) {
      ++failed_;
      if (r.verdict == Verdict::not_a_number) ++nan_;
      if (failed_ <= most_shown) ADD_FAILURE() << r.why << "\n  " << text_of(c);
      worst_wrong_ = larger(worst_wrong_, std::isnan(r.loss) ? 0.0 : r.loss);
    }
  }
  void record(const std::string& name) {
    std::ranges::sort(losses_);
    const double median = losses_.empty() ? 0.0 : losses_[losses_.size() / 2];
    const double worst = losses_.empty() ? 0.0 : losses_.back();
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(),
                  "%d tried, %d failed (%d NaN, worst %.1e), %d refused, %d left out, %zu held: "
                  "median %.1e, worst %.1e",
                  tried_, failed_, nan_, worst_wrong_, refused_, left_out_, losses_.size(), median,
                  worst);
    testing::Test::RecordProperty("edges_" + name, line.data());
    std::printf("%-22s %s\n", name.c_str(), line.data());
  }
  double share_held() const { return static_cast<double>(losses_.size()) / tried_; }

 private:
  static constexpr int most_shown = 12;
  std::vector<double> losses_;
  int tried_ = 0, failed_ = 0, nan_ = 0, refused_ = 0, left_out_ = 0;
  double worst_wrong_ = 0.0;
};

struct Known {
  const EdgeCase& c;
  const Body& body;
  const FlowCharts& flow;  // at the state itself
  Place place;
};

// --- the charts that need no body ---

Result euler_result(const Known& k) {
  const auto e = to_euler(k.c.state);
  return judged(loss_of(to_rotor(e), k.c.state),
                budget::chart_rounding +
                    smaller(budget::euler_pole_eps * eps / k.place.theta, 2.0 * k.place.J3),
                "euler");
}
Result andoyer_result(const Known& k) {
  const auto a = to_andoyer(k.c.state);
  return judged(loss_of(to_rotor(andoyer_state(a.l, a.g, a.h, a.L, a.G, a.H)), k.c.state),
                budget::chart_rounding + pole_loss(k.place.J3) + pole_loss(k.place.I), "andoyer");
}
Result poincare_result(const Known& k) {
  const auto p = nearest_poincare(k.c.state);
  const auto checked = poincare_state(p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2, p.pole_J, p.pole_I);
  return judged(loss_of(to_rotor(checked), k.c.state), budget::poincare, "poincare");
}
Result euler_rates_result(const Known& k) {
  const Vec3 w = angular_velocity(k.body, k.c.state);
  if (!std::isnormal(norm(w))) return left_out;
  for (int i = 0; i < 3; ++i)  // a needle: a subnormal rate lacks digits of a large momentum
    if (w[i] != 0.0 && !std::isnormal(w[i])) return left_out;
  const RotorState back = to_rotor(k.body, to_euler_rates(k.body, k.c.state));
  const Vec3 I = k.body.moments();
  // the component along axis 3 is a difference of rates about the third axes
  const double across = std::hypot(w.x, w.y) / k.place.theta;
  const double along = I.z * (across / norm(k.c.state.g));
  if (!(eps * along < 1.0)) return left_out;  // a needle: the rates hold no momentum
  return judged(loss_of(back, k.c.state),
                budget::chart_rounding + budget::euler_pole_eps * eps * along, "euler rates");
}

// --- Jacobians of the canonical charts: B of the scaled state, by the chain rule ---

bool both_not_a_number(double a, double b) { return std::isnan(a) && std::isnan(b); }

// B of a state in units where |g| is 2^e times smaller: entries times exact powers of two.
Result jacobian_result(const Known& k, const CanonicalChart& chart) {
  const double G = norm(k.c.state.g);
  if (G == 0.0) return left_out;
  const int e = std::ilogb(G) / 2 * 2;
  const RotorState unit{k.c.state.q,
                        {std::ldexp(k.c.state.g.x, -e), std::ldexp(k.c.state.g.y, -e),
                         std::ldexp(k.c.state.g.z, -e)}};
  const Matrix6 B = chart_jacobian(k.c.state, chart), B1 = chart_jacobian(unit, chart);
  const Matrix6 C = inverse_chart_jacobian(k.c.state, chart),
                C1 = inverse_chart_jacobian(unit, chart);
  const bool pairs = chart.set == CanonicalSet::poincare;
  const bool at_pole = k.place.J3 <= least_sine || k.place.I <= least_sine;
  // of those that the set of this name is not made for
  const bool at_far_pole =
      pairs && ((k.place.J3 <= least_sine && k.c.state.g.z < 0.0) ||
                (k.place.I <= least_sine && inertial_momentum(k.c.state).z < 0.0));
  const std::array<int, 6> coordinate = pairs ? std::array<int, 6>{0, e / 2, e / 2, e, e / 2, e / 2}
                                              : std::array<int, 6>{0, 0, 0, e, e, e};
  double worst = 0.0;
  for (int i = 0; i < 6; ++i) {
    const int hub = i < 3 ? 0 : e;
    for (int j = 0; j < 6; ++j) {
      const int to = coordinate[static_cast<std::size_t>(j)];
      const double b = std::ldexp(B1(i, j), hub - to), c = std::ldexp(C1(j, i), to - hub);
      const bool no_inverse = at_pole && both_not_a_number(C(j, i), c);
      for (const auto& [got, wanted] : {std::pair{B(i, j), b}, std::pair{C(j, i), c}}) {
        if (got == wanted || (std::isinf(wanted) && !std::isnan(got))) continue;
        if (both_not_a_number(got, wanted) && (at_far_pole || (no_inverse && !std::isnan(b))))
          continue;
        const double off = std::abs(got - wanted) / larger(std::abs(wanted), 1e-290);
        if (std::isnan(off)) return {Verdict::not_a_number, off, "jacobian"};
        worst = larger(worst, smaller(off, std::abs(got / wanted - 1.0)));
      }
    }
  }
  return judged(worst, budget::scaled_jacobian_eps * eps,
                "jacobian against that of the scaled state");
}

// --- the flow-adapted charts ---

bool rate_is_in_range(const Known& k) {
  const Vec3& I = k.body.moments();
  if (!(smaller(I.x, I.y, I.z) >= 0x1p-900 * larger(I.x, I.y, I.z))) return false;
  const int rate = std::ilogb(norm(k.c.state.g)) - std::ilogb(larger(I.x, I.y, I.z));
  return std::abs(rate) < 1020;
}
double angle_off(double a, const Long& b) {
  const Long off = Long(a) - b, turn = 2 * long_pi();
  return std::abs(double_of(Long(off - turn * round(off / turn))));
}
double relative_off(double a, const Long& b) {
  return b == 0 ? std::abs(a) : std::abs(double_of(Long((Long(a) - b) / b)));
}
bool energy_is_held(const Known& k) {
  return k.flow.T > Long(std::numeric_limits<double>::min()) &&
         k.flow.T < Long(std::numeric_limits<double>::max());
}
// Next to the separatrix, nearer than this, G and T hold the branch and the place on it.
constexpr double branch_zone = 1e-12;
constexpr double branch_distance = 0x1p-40;
// Within 1e-130 of an axis, where the limit of the axis is returned, and across an axis of
// symmetry, where T does not tell the rate.
bool counts_as_steady(const Known& k) {
  return !k.flow.moves || k.place.J < 1e-130 ||
         (k.place.gap < branch_zone && k.place.D2 < branch_zone);
}
double serret_allowed(const Known& k) {
  return budget::serret_edge + pole_loss(k.place.I) +
         smaller(budget::flow_pole_eps * eps / k.place.J, budget::flow_pole) +
         smaller(budget::serret_separatrix_eps * eps / k.place.D2,
                 budget::serret_next_to_separatrix);
}
double sadov_allowed(const Known& k) {
  return budget::serret_edge + pole_loss(k.place.I) +
         smaller(budget::flow_pole_eps * eps / k.place.J, budget::flow_pole) +
         budget::sadov_separatrix_eps * eps / k.place.D2;
}

// What the six doubles can hold, asked only where the plain bound does not do: a few half ulps of
// each. Next to an axis, where a number holds J^2, the root of what it holds of that. Nearer to the
// separatrix than 2^-40 the headers promise more.
double held_by_doubles(const Known& k, const std::array<double, 6>& held, int halves, bool serret) {
  if (!k.flow.moves || k.flow.K == 0 || (serret && k.place.D2 < branch_distance)) return 0.0;
  const double moved = moved_by_half_ulps(k.body.moments(), k.c.state,
                                          serret ? serret_numbers : sadov_numbers, halves, held);
  return budget::chart_half_ulps * smaller(moved, std::sqrt(2.0 * k.place.J * moved));
}
// From the half period of the oracle to that of these elements.
int halves_between(const Known& k, double t0) {
  if (!k.flow.moves || k.flow.K == 0) return 0;
  const Long off = (Long(k.c.t) - Long(t0) - k.flow.elapsed) * k.flow.n / (2 * k.flow.K);
  return static_cast<int>(static_cast<double>(Long(round(off))));
}
// eps |t0| times the rate of the phase, for spin about the middle axis that next to it.
bool place_is_lost(const Known& k, double t0) {
  double n = double_of(k.flow.n);
  if (!k.flow.moves) {
    std::array<double, 3> m{k.body.moments().x, k.body.moments().y, k.body.moments().z};
    std::ranges::sort(m);
    n = norm(k.c.state.g) / m[1] * std::sqrt((m[1] - m[0]) / m[0]) *
        std::sqrt((m[2] - m[1]) / m[2]);
  }
  return !(eps * std::abs(t0) * n <= budget::says_nothing);
}

Result refused(const std::string& message, bool rightly) {
  return {rightly ? Verdict::refused : Verdict::wrong, 0.0, "refused: " + message};
}

Result serret_result(const Known& k) {
  const bool sphere =
      k.body.moments().x == k.body.moments().y && k.body.moments().y == k.body.moments().z;
  try {
    const FreeRotation motion(k.body, k.c.state, k.c.t);
    const auto s = to_serret(motion, k.c.t);
    for (const double x : {s.g0, s.h, s.t0, s.G, s.H, s.T})
      if (std::isnan(x)) return {Verdict::not_a_number, x, "to_serret"};
    const double loss = loss_of(to_rotor(k.body, s, k.c.t), k.c.state);
    // across an axis of symmetry l is lost, and what t0 does not tell
    if ((k.place.gap == 0.0 && k.place.D2 < branch_zone) || place_is_lost(k, s.t0)) {
      const Vec3 g = inertial_momentum(to_rotor(k.body, s, k.c.t));
      const RotorState still{{1.0, 0.0, 0.0, 0.0}, inertial_momentum(k.c.state)};
      return judged(loss_of({still.q, g}, still), serret_allowed(k), "serret, momentum in space");
    }
    double allowed = serret_allowed(k);
    if (loss > allowed) {
      const std::array<double, 6> held{s.g0, s.h, s.t0, s.G, s.H, s.T};
      allowed = larger(allowed, held_by_doubles(k, held, halves_between(k, s.t0), true));
    }
    return judged(loss, smaller(allowed, budget::says_nothing), "serret");
  } catch (const DomainError& error) {
    // moments equal but for rounding: T says nothing
    const bool untold = k.place.D2 < branch_zone && k.place.gap < branch_zone;
    const bool t0_is_held = !k.flow.moves || k.flow.K == 0 ||
                            2 * k.flow.K / k.flow.n < Long(std::numeric_limits<double>::max());
    return refused(error.what(),
                   sphere || untold || !rate_is_in_range(k) || !energy_is_held(k) || !t0_is_held);
  }
}

// The numbers themselves; t0 in units of the argument u.
Result serret_values(const Known& k) {
  if (!rate_is_in_range(k) || !energy_is_held(k) || counts_as_steady(k)) return left_out;
  try {
    const auto s = to_serret(FreeRotation(k.body, k.c.state, k.c.t), k.c.t);
    double off = larger(relative_off(s.G, k.flow.G), relative_off(s.T, k.flow.T),
                        std::abs(double_of(Long((s.H - k.flow.H) / k.flow.G))));
    // at the base point that the library took
    const Long shift = (Long(k.c.t) - Long(s.t0) - k.flow.elapsed) * k.flow.n;
    const Long halves = k.flow.K == 0 ? Long(0) : Long(round(shift / (2 * k.flow.K)));
    const Long u_off = shift - 2 * k.flow.K * halves;
    off = larger(off, std::abs(double_of(u_off)) / (1.0 + std::abs(double_of(k.flow.u))));
    return judged(off, budget::flow_values + eps * std::abs(double_of(Long(k.c.t * k.flow.n))),
                  "serret values");
  } catch (const DomainError& error) {
    return refused(error.what(), true);  // judged by serret_result
  }
}

Result sadov_result(const Known& k) {
  try {
    const FreeRotation motion(k.body, k.c.state, k.c.t);
    const auto s = to_sadov(motion, k.c.t);
    for (const double x : {s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h})
      if (std::isnan(x)) return {Verdict::not_a_number, x, "to_sadov"};
    const RotorState back = to_rotor(k.body, s);
    double allowed = sadov_allowed(k);
    if (loss_of(back, k.c.state) > allowed) {
      const std::array<double, 6> held{s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h};
      allowed = larger(allowed, held_by_doubles(k, held, 0, false));
    }
    if (allowed > budget::says_nothing) {  // the place on the polhode is lost
      const RotorState still{{1.0, 0.0, 0.0, 0.0}, inertial_momentum(k.c.state)};
      return judged(loss_of({still.q, inertial_momentum(back)}, still),
                    budget::serret_edge + pole_loss(k.place.I), "sadov, momentum in space");
    }
    return judged(loss_of(back, k.c.state), allowed, "sadov");
  } catch (const DomainError& error) {
    return refused(error.what(), !rate_is_in_range(k));
  }
}

Result sadov_values(const Known& k) {
  if (!rate_is_in_range(k) || counts_as_steady(k) || k.flow.K == 0) return left_out;
  const auto s = to_sadov(FreeRotation(k.body, k.c.state, k.c.t), k.c.t);
  const double action = k.flow.long_axis ? s.I_l : std::abs(s.I_l);
  const double allowed = budget::flow_values;
  const Long wanted = k.flow.action * k.flow.G;
  double off = larger(relative_off(s.I_g, k.flow.G), angle_off(s.phi_l, k.flow.phi_l));
  if (wanted > Long(1e-300)) off = larger(off, relative_off(action, wanted));
  off = larger(off, std::abs(double_of(Long((s.I_h - k.flow.H) / k.flow.G))));
  // phi_g and h share what I = 0, pi loses
  off = larger(off, angle_off(s.phi_g, k.flow.phi_g) * k.place.I);
  return judged(off, allowed, "sadov values");
}

bool period_is_held(const Known& k) {
  return !k.flow.moves || k.flow.K == 0 ||
         (k.flow.P_psi > Long(std::numeric_limits<double>::min()) &&
          k.flow.P_psi < Long(std::numeric_limits<double>::max()));
}

// At the tip of a polhode in SAM k_z = 0, psi = psi_max, and an error e of psi is sqrt(2 e / w) in
// k_z: k_y = cot(psi) k_x and k_y^2 + (1 - m) k_x^2 = const give w = k_y + (1 - m) / k_y next to
// pi/2, with k_y along the short axis and 1 - m = (I2 - I1) / (I3 - I1). Nearly equal lesser
// moments make it small. psi0 and psi_max, both rounded, are up to e = eps apart.
double tip_width(const Known& k) {
  const double y = k.place.short_part, beta = k.place.lower_part;
  if (y == 0.0) return beta > 0.0 ? 1.0 : eps;
  return smaller(1.0, larger(y + beta / y, eps));
}

Result tumbler_result(const Known& k) {
  try {
    const FreeRotation motion(k.body, k.c.state, k.c.t);
    if (motion.regime() != Regime::short_axis && motion.regime() != Regime::long_axis) {
      try {
        static_cast<void>(to_tumbler(motion, k.c.t));
      } catch (const DomainError&) {
        return left_out;
      }
      return {Verdict::wrong, 1.0, "tumbler of a motion that has none"};
    }
    const auto s = to_tumbler(motion, k.c.t);
    const double values = k.flow.moves && k.flow.K != 0
                              ? larger(relative_off(s.rotation_period, k.flow.P_psi),
                                       relative_off(s.precession_period, k.flow.P_phi))
                              : 0.0;
    if (!(values <= budget::flow_values))
      return judged(values, budget::flow_values, "tumbler periods");
    RotorState back;
    try {
      back = to_rotor(k.body, s);
    } catch (const DomainError& error) {
      // no momentum in double precision has these periods
      const bool said =
          std::string(error.what()).find("closer to the separatrix") != std::string::npos;
      return refused(error.what(), said && (k.place.D2 < budget::tumbler_untold || k.place.needle));
    }
    const double tip = std::sqrt(2.0 * eps / tip_width(k));
    if (tip > budget::says_nothing) return left_out;
    return judged(loss_of(back, k.c.state), budget::tumbler_edge + tip, "tumbler");
  } catch (const DomainError& error) {
    return refused(error.what(), !rate_is_in_range(k) || !period_is_held(k));
  }
}

Result modified_result(const Known& k) {
  try {
    const auto a = charts::modified_andoyer(k.body, k.c.t, k.c.state, k.c.t);
    return judged(loss_of(charts::from_modified_andoyer(k.body, k.c.t, a, k.c.t), k.c.state),
                  budget::serret_edge + pole_loss(k.place.J3) + pole_loss(k.place.I),
                  "modified andoyer");
  } catch (const DomainError& error) {
    return refused(error.what(), !rate_is_in_range(k));
  }
}

Result flow_jacobian_result(const Known& k) {
  try {
    const FreeRotation motion(k.body, k.c.state, k.c.t);
    const Vec3& I = k.body.moments();
    const int a = std::ilogb(larger(I.x, I.y, I.z)), b = std::ilogb(norm(k.c.state.g));
    if (std::abs(a) + std::abs(b) == 0) return left_out;
    // in units of 2^a and 2^b, time in those of 2^(a-b)
    const Body unit(std::ldexp(I.x, -a), std::ldexp(I.y, -a), std::ldexp(I.z, -a));
    const auto s = to_sadov(motion, k.c.t);
    auto s1 = s;
    for (double* x : {&s1.I_l, &s1.I_g, &s1.I_h}) *x = std::ldexp(*x, -b);
    const Matrix6 B = chart_jacobian(k.body, s), B1 = chart_jacobian(unit, s1);
    // where the header says that it is not finite
    const bool singular = counts_as_steady(k) || k.place.J * k.place.J < eps ||
                          k.place.I * k.place.I < eps || k.place.D2 < branch_zone;
    double worst = 0.0;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        const double wanted = std::ldexp(B1(i, j), (i < 3 ? 0 : b) - (j < 3 ? 0 : b));
        if (B(i, j) == wanted || (std::isinf(wanted) && !std::isnan(B(i, j)))) continue;
        if (singular && both_not_a_number(B(i, j), wanted)) continue;
        const double off = std::abs(B(i, j) - wanted) / larger(std::abs(wanted), 1e-290);
        if (std::isnan(off)) return {Verdict::not_a_number, off, "sadov jacobian"};
        worst = larger(worst, off);
      }
    return judged(worst, budget::scaled_jacobian_eps * eps,
                  "sadov jacobian against that of the scaled state");
  } catch (const DomainError& error) {
    return refused(error.what(), !rate_is_in_range(k));
  }
}

struct EdgeChart {
  const char* name;
  double least_held;  // of the cases: about half of what it was when this was written
  std::function<Result(const Known&)> result;
};

const std::vector<EdgeChart>& edge_charts() {
  static const std::vector<EdgeChart> all{
      {"euler", 0.50, euler_result},
      {"euler_rates", 0.46, euler_rates_result},
      {"andoyer", 0.50, andoyer_result},
      {"poincare", 0.50, poincare_result},
      {"modified_andoyer", 0.47, modified_result},
      {"serret", 0.35, serret_result},
      {"serret_values", 0.26, serret_values},
      {"sadov", 0.45, sadov_result},
      {"sadov_values", 0.30, sadov_values},
      {"tumbler", 0.30, tumbler_result},
      {"jacobian_euler", 0.50,
       [](const Known& k) { return jacobian_result(k, {CanonicalSet::euler}); }},
      {"jacobian_andoyer", 0.50,
       [](const Known& k) { return jacobian_result(k, {CanonicalSet::andoyer}); }},
      {"jacobian_poincare", 0.50,
       [](const Known& k) { return jacobian_result(k, {CanonicalSet::poincare}); }},
      {"jacobian_sadov", 0.25, flow_jacobian_result}};
  return all;
}

struct Prepared {
  EdgeCase c;
  FlowCharts flow;
  Place place;
};

const std::vector<Prepared>& prepared_cases() {
  static const std::vector<Prepared> all = [] {
    const bool full = std::getenv("POLHODE_TEST_FULL") != nullptr;
    const std::size_t count = full ? 4000 : 250;
    std::vector<Prepared> cases;
    for (std::uint64_t i = 0; cases.size() < count; ++i) {
      const EdgeCase c = drawn_edge_case(i);
      const Vec3& I = c.moments;
      bool in_range = norm(c.state.g) > 1e-300 && norm(c.state.g) < 1e301;
      for (const double x : {I.x, I.y, I.z}) in_range = in_range && std::isnormal(x) && x < 1e301;
      if (!in_range) continue;
      const FlowCharts flow = flow_charts(I, c.state);
      const Quaternion q = normalized(c.state.q);
      // D2 as double-double holds it, and that of the momentum displaced for the limit of a spin
      const double least = smaller(I.x, I.y, I.z), most = larger(I.x, I.y, I.z);
      Place place;
      place.needle = least < 1e-20 * most;
      place.I = larger(double_of(flow.node), least_sine);
      place.J = larger(double_of(flow.across), least_sine);
      place.D2 = larger(double_of(Long(abs(flow.D2) / (flow.G * flow.G))), least_sine);
      const Vec3& g = c.state.g;
      place.J3 = larger(std::hypot(g.x / norm(g), g.y / norm(g)), least_sine);
      place.theta = larger(2.0 * std::hypot(q.x, q.y) * std::hypot(q.w, q.z), least_sine);
      std::array<double, 3> m{I.x, I.y, I.z};
      std::ranges::sort(m);
      const Vec3 along{I.x == m[2] ? g.x : 0.0, I.y == m[2] ? g.y : 0.0, I.z == m[2] ? g.z : 0.0};
      place.short_part = norm(along) / norm(g);
      place.gap = smaller((m[1] - m[0]) / m[1], (m[2] - m[1]) / m[2]);
      place.lower_part = m[2] > m[0] ? (m[1] - m[0]) / (m[2] - m[0]) : 0.0;
      cases.push_back({c, flow, place});
    }
    return cases;
  }();
  return all;
}

// One test: its processes would each ask the oracle again.
TEST(ChartEdges, HoldTheStateOrSayWhyNot) {
  for (const EdgeChart& chart : edge_charts()) {
    SCOPED_TRACE(chart.name);
    Survey survey;
    for (const Prepared& p : prepared_cases()) {
      const Body body(p.c.moments.x, p.c.moments.y, p.c.moments.z);
      Result r;
      try {
        r = chart.result({p.c, body, p.flow, p.place});
      } catch (const std::exception& error) {
        r = {Verdict::wrong, 0.0, std::string("threw: ") + error.what()};
      }
      survey.add(p.c, r);
    }
    survey.record(chart.name);
    EXPECT_GE(survey.share_held(), chart.least_held);
  }
}

}  // namespace
