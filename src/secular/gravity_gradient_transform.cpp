// SPDX-License-Identifier: MIT
#include "secular/gravity_gradient_transform.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {
namespace {

using Local = series::Series<ActionTaylor>;

series::Symbols symbols() {
  return series::Symbols({"I_l", "I_g", "I_h", "k"}, {"phi_l", "phi_g", "phi_h", "M"},
                         {{"phi_l", "I_l"}, {"phi_g", "I_g"}, {"phi_h", "I_h"}});
}

struct Rates {
  double l, g, M;
  double of(const series::Symbols& names, const series::TermKey& key) const {
    return series::multiplier(names, key, 0) * l + series::multiplier(names, key, 1) * g +
           series::multiplier(names, key, 3) * M;
  }
};
// H_0 is one term.
double rate_by(const Local& h0, const char* action) {
  return series::derivative(h0, action).terms()[0].c.constant();
}

double size_of(const series::Term<ActionTaylor>& term) { return std::abs(term.c.constant()); }

// Left out are periodic terms that move angles by less than `least`; those whose products with the
// largest do so are of the second order: they enter alone. The mean actions are off by as much, and
// with them the mean rates.
struct Selection {
  Local terms;
  double largest_angle;  // moved by a periodic term
  double left_out;       // of the mean rates, rad per rad of rotation
};
Selection by_size(const Local& gradient, const Rates& rates, double I_g,
                  const GravityGradientOptions& options) {
  const series::Symbols& names = gradient.symbols();
  const auto is_periodic = [&](const series::Term<ActionTaylor>& term) {
    return series::multiplier(names, term.key, 0) != 0 ||
           series::multiplier(names, term.key, 1) != 0 ||
           series::multiplier(names, term.key, 3) != 0;
  };
  const auto angle_moved = [&](const series::Term<ActionTaylor>& term) {
    return size_of(term) / (I_g * std::abs(rates.of(names, term.key)));
  };
  double largest = 0.0, most = 0.0;
  for (const auto& term : gradient.terms()) {
    largest = std::max(largest, size_of(term));
    if (is_periodic(term)) most = std::max(most, angle_moved(term));
  }
  constexpr double rounding = 1e-15;
  const int k = names.variable("k");
  std::vector<series::Term<ActionTaylor>> terms;
  double left_out = 0.0;
  for (const auto& term : gradient.terms()) {
    if (!(size_of(term) > rounding * largest)) continue;
    series::Term<ActionTaylor> kept = term;
    if (is_periodic(term)) {
      const double moved = angle_moved(term);
      if (!(moved > options.least)) {
        left_out += moved;
        continue;
      }
      if (options.order == 2 && moved * most < options.least) {
        left_out += moved * most;
        kept.key.exponents = names.exponents().with(kept.key.exponents, k, 1);
      }
    }
    terms.push_back(kept);
  }
  return {Local(names, std::move(terms)), most, left_out};
}

// k.H_0''.k of the angles of a term.
double curvature(const series::TermKey& key, const Local& h0) {
  const series::Symbols& names = h0.symbols();
  const char* const action[2] = {"I_l", "I_g"};
  double sum = 0.0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const Local second = series::derivative(series::derivative(h0, action[i]), action[j]);
      for (const auto& one : second.terms())
        sum += series::multiplier(names, key, i) * series::multiplier(names, key, j) *
               one.c.constant();
    }
  return sum;
}

// A term A cos(angle) of the Hamiltonian holds what turns slower than 2 sqrt(|A k.H_0''.k|). At
// twice that, the second order is a sixteenth of the first.
void require_no_resonance(const Local& h0, const Rates& rates, const series::TermKey& key,
                          double A) {
  const series::Symbols& names = h0.symbols();
  const double rate = std::abs(rates.of(names, key));
  const double held = 2.0 * std::sqrt(A * std::abs(curvature(key, h0)));
  if (rate > 2.0 * held) return;
  refuse_theory("a resonance: " + series::angle_text(h0, key) + " turns at the rate " +
                polhode::detail::number_text(rate) + ", and the torque holds what is slower than " +
                polhode::detail::number_text(held));
}
void require_no_resonance(const Local& gradient, const Local& h0, const Rates& rates,
                          bool averages_orbit) {
  const series::Symbols& names = gradient.symbols();
  for (const auto& term : gradient.terms())
    if (series::multiplier(names, term.key, 0) != 0 ||
        series::multiplier(names, term.key, 1) != 0 ||
        (averages_orbit && series::multiplier(names, term.key, 3) != 0))
      require_no_resonance(h0, rates, term.key, size_of(term));
}
// Of a generator, which has terms over their rates: those of the second order too.
void require_no_resonance(const Local& generator, const Local& h0, const Rates& rates) {
  for (const auto& term : generator.terms())
    require_no_resonance(h0, rates, term.key,
                         size_of(term) * std::abs(rates.of(generator.symbols(), term.key)));
}

// What an action moves by at the first order must be small against its way to where the elements
// lose their sense.
void require_small(const LieTransform<ActionTaylor>& transform, const GravityGradientRequest& s) {
  constexpr double share = 0.3;
  const auto require = [&](const char* name, double distance, const char* where) {
    double moved = 0.0;
    const Local first = series::part_of_order(transform.short_period(name), gradient_orders(1), 1);
    for (const auto& term : first.terms()) moved += size_of(term) / s.at.I_g;
    if (moved < share * distance) return;
    refuse_theory("the torque moves " + std::string(name) + " / I_g by " +
                  polhode::detail::number_text(moved) + ", and it is " +
                  polhode::detail::number_text(distance) + " from " + where);
  };
  require("I_l", distance_in_region(s.body, s.at), "spin about an axis or the separatrix");
  require("I_h", 1.0 - std::abs(s.at.I_h) / s.at.I_g, "momentum along the normal of the orbit");
}

}  // namespace

void refuse_theory(const std::string& why) { throw DomainError("GravityGradientTheory: " + why); }

series::Truncation gradient_orders(int order) { return {{{"k", 1}}, order}; }

void require_valid(const GravityGradientRequest& s) {
  const Vec3& m = s.body.moments();
  const double e = s.orbit.elements().eccentricity;
  if (!(s.gm > 0.0) || !std::isfinite(s.gm))
    refuse_theory("gm = " + polhode::detail::number_text(s.gm) + " must be positive");
  if (!(e < 1.0))
    refuse_theory("the eccentricity " + polhode::detail::number_text(e) + " must be below 1");
  constexpr double most_eccentric = 0.9;
  if (e > most_eccentric)
    refuse_theory("the eccentricity " + polhode::detail::number_text(e) +
                  " must be at most 0.9: series in the mean anomaly grow too long");
  if (s.options.order != 1 && s.options.order != 2)
    refuse_theory("the order " + std::to_string(s.options.order) + " must be 1 or 2");
  if (!(s.options.least > 0.0))
    refuse_theory("least = " + polhode::detail::number_text(s.options.least) + " must be positive");
  if (m.x == m.y && m.y == m.z) refuse_theory("a sphere has no gravity gradient");
  if (!(s.at.I_g > 0.0)) refuse_theory("the body is at rest");
  constexpr double nearest = 1e-4;  // nearer, interpolated coefficients lose their digits
  if (!(distance_in_region(s.body, s.at) > nearest))
    refuse_theory("I_l / I_g = " + polhode::detail::number_text(s.at.I_l / s.at.I_g) +
                  " is next to spin about an axis or to the separatrix, where the elements lose "
                  "their sense");
  if (!(1.0 - std::abs(s.at.I_h) / s.at.I_g > nearest))
    refuse_theory("I_h / I_g = " + polhode::detail::number_text(s.at.I_h / s.at.I_g) +
                  ": the momentum is along the normal of the orbit, where phi_h loses its sense");
}

GravityGradientTransform transformed(const GravityGradientRequest& s) {
  require_valid(s);
  const series::Symbols names = symbols();
  const KeplerElements& e = s.orbit.elements();
  const double a = semi_major_axis(e);
  constexpr double rounding = 1e-15;
  const TurningTensor tensor = turning_tensor(s.body, s.at, rounding);
  const OrbitWaves orbit = orbit_waves(Eccentricity::of(e.eccentricity), rounding);
  const Local gradient = gradient_series(names, tensor, orbit, s.at, 1.5 * s.gm / (a * a * a));
  const Local h0 = series::constant(names, tensor.energy);
  const Rates rates{rate_by(h0, "I_l"), rate_by(h0, "I_g"), s.orbit.mean_motion()};
  const auto [kept, largest_angle, left_out] = by_size(gradient, rates, s.at.I_g, s.options);
  require_no_resonance(kept, h0, rates, s.options.averages_orbit);
  Elimination<ActionTaylor> problem{
      h0 + kept, gradient_orders(s.options.order), {"phi_l", "phi_g"}};
  if (s.options.averages_orbit) problem.angles.emplace_back("M");
  problem.clocks = {{"M", series::constant(names, ActionTaylor(rates.M))}};
  LieTransform<ActionTaylor> transform(std::move(problem));
  require_no_resonance(transform.generator(), h0, rates);
  require_small(transform, s);
  return {std::move(transform), kept.size(), largest_angle, left_out};
}

}  // namespace detail
}  // namespace secular
}  // namespace v0
}  // namespace polhode
