// SPDX-License-Identifier: MIT
// From the values of a file to what moves the body: frame, orbits, terms, method, events.
#include <algorithm>
#include <cmath>
#include <limits>

#include "io/detail/nearest.hpp"
#include "io/detail/scenario_parts.hpp"
#include "io/detail/value_access.hpp"
#include "io/detail/word_list.hpp"
#include "polhode/io/columns.hpp"
#include "polhode/io/schema.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/linear_damping.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double most_steps = 1e15;

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view near = nearest(word, known);
  return near.empty() ? "" : "; did you mean " + std::string(near) + "?";
}

// "orbit.moon" for each table [orbit.NAME].
std::vector<std::string> orbit_paths(const Values& values) {
  std::vector<std::string> paths;
  for (const auto& [path, value] : values)
    if (value.key->path == "orbit.*") paths.push_back(path);
  return paths;
}

// "perturbation[0]", ...
std::vector<std::string> array_paths(const Values& values, const std::string& array) {
  std::vector<std::string> paths;
  for (;;) {
    const std::string path = array + "[" + std::to_string(paths.size()) + "]";
    const auto first = values.lower_bound(path + ".");
    if (first == values.end() || !first->first.starts_with(path + ".")) return paths;
    paths.push_back(path);
  }
}

const ScenarioOrbit& orbit_named(const std::vector<ScenarioOrbit>& orbits, const Values& values,
                                 const std::string& path, const std::string& name) {
  const std::string& wanted = word(values, path);
  std::vector<std::string_view> known;
  for (const ScenarioOrbit& orbit : orbits) {
    if (orbit.name == wanted) return orbit;
    known.push_back(orbit.name);
  }
  if (known.empty()) refuse(values, path, name, "expected a table [orbit." + wanted + "]");
  refuse(
      values, path, name,
      "expected the name of an orbit of this file: " + one_of(known) + did_you_mean(wanted, known));
}

KeplerElements elements_of(const Values& values, const std::string& path, const std::string& name) {
  const auto key = [&](const char* own) { return path + "." + own; };
  const double gm = number(values, key("gm")), e = number(values, key("eccentricity"));
  if (!(gm > 0.0)) refuse(values, key("gm"), name, "expected a positive gravitational parameter");
  if (!(e >= 0.0) || e == 1.0)
    refuse(values, key("eccentricity"), name,
           "expected 0 <= e < 1 (an ellipse) or e > 1 (a hyperbola); at e = 1 use a number next to "
           "it, with the same pericentre");
  const bool by_axis = there(values, key("semi_major_axis"));
  const std::string size_key = key(by_axis ? "semi_major_axis" : "pericentre");
  const double size = number(values, size_key);
  if (!(size > 0.0)) refuse(values, size_key, name, "expected a positive length");
  if (by_axis && e > 1.0)
    refuse(values, size_key, name, "expected pericentre instead, since e > 1 is a hyperbola");
  return {.gm = gm,
          .pericentre = by_axis ? pericentre_distance(size, e) : size,
          .eccentricity = e,
          .inclination = number(values, key("inclination")),
          .node = number(values, key("node")),
          .argument = number(values, key("pericentre_argument")),
          .mean_anomaly = number(values, key("mean_anomaly")),
          .epoch = number(values, key("epoch"))};
}

AnyPerturbation gravity_gradient_of(const Scenario& scenario, const Values& values,
                                    const std::string& path, const std::string& name) {
  const ScenarioOrbit orbit = orbit_named(scenario.orbits, values, path + ".orbit", name);
  const bool own = there(values, path + ".gm");
  const double gm = own ? number(values, path + ".gm") : orbit.elements.gm;
  if (!(gm > 0.0))
    refuse(values, path + ".gm", name, "expected a positive gravitational parameter");
  const std::string text = "gravity gradient, orbit " + orbit.name;
  if (orbit.rates == SecularRates{})
    return {text, GravityGradient(gm, KeplerOrbit(orbit.elements))};
  return {text, GravityGradient(gm, PrecessingKeplerOrbit(orbit.elements, orbit.rates))};
}

AnyPerturbation torque_of(const Scenario& scenario, const Values& values, const std::string& path) {
  const Vec3 torque = vector(values, path + ".torque");
  if (word(values, path + ".axes") == "inertial")
    return {"constant torque, inertial axes", ConstantTorque::in_space(torque)};
  return {"constant torque, body axes",
          ConstantTorque::in_body(rotate(conj(scenario.body.q_FB()), torque))};
}

// The body axes of the file are those of its tensor; the term wants principal axes.
AnyPerturbation damping_of(const Scenario& scenario, const Values& values, const std::string& path,
                           const std::string& name) {
  const std::string key = path + ".coefficients";
  const std::vector<double>& n = value_at(values, key).numbers;
  const Quaternion& q_FB = scenario.body.q_FB();
  return built(values, key, name, [&]() -> AnyPerturbation {
    if (n.size() == 3 && q_FB == Quaternion{})
      return {"damping", LinearDamping(vector(values, key))};
    const Mat3 D_F = n.size() == 3 ? Mat3{{{n[0], 0.0, 0.0}, {0.0, n[1], 0.0}, {0.0, 0.0, n[2]}}}
                                   : Mat3{{{n.at(0), n.at(1), n.at(2)},
                                           {n.at(3), n.at(4), n.at(5)},
                                           {n.at(6), n.at(7), n.at(8)}}};
    const LinearDamping in_file_axes(D_F, scenario.body);  // refuses what is no damping
    const Mat3 R = rotation_matrix(q_FB);                  // v_F = R v_B
    const Mat3 D = transpose(R) * in_file_axes.matrix() * R;
    Mat3 even = D;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) even(i, k) = 0.5 * (D(i, k) + D(k, i));
    return {"damping", LinearDamping(even, scenario.body)};
  });
}

void add_frame(Scenario& scenario, const Values& values, const std::string& name) {
  scenario.frame_text = "inertial";
  if (there(values, "frame.precessing")) {
    const Precession p{vector(values, "frame.precessing.axis"),
                       number(values, "frame.precessing.rate"),
                       number(values, "frame.precessing.epoch")};
    scenario.frame = built(values, "frame.precessing.axis", name,
                           [&] { return Frame::precessing(p.axis, p.rate, p.epoch); });
    scenario.precession = p;
    scenario.frame_text = "precessing";
  } else if (there(values, "frame.orbit-plane")) {
    const ScenarioOrbit orbit =
        orbit_named(scenario.orbits, values, "frame.orbit-plane.orbit", name);
    scenario.frame_text = "plane of orbit " + orbit.name;
    const KeplerElements& k = orbit.elements;
    scenario.frame = Frame::orbit_plane(
        [node = k.node, rate = orbit.rates.node, epoch = k.epoch](const auto& t) {
          using T = std::remove_cvref_t<decltype(t)>;
          return T(node) + T(rate) * (t - T(epoch));
        },
        [i = k.inclination](const auto& t) { return std::remove_cvref_t<decltype(t)>(i); });
  }
}

SplittingScheme scheme_of(const std::string& word) {
  if (word == "order2") return SplittingScheme::order2;
  if (word == "order4") return SplittingScheme::order4;
  if (word == "order6") return SplittingScheme::order6;
  if (word == "order8") return SplittingScheme::order8;
  return word == "ABA864" ? SplittingScheme::ABA864 : SplittingScheme::ABA1064;
}

Crossing crossing_of(const std::string& word) {
  if (word == "both") return Crossing::both;
  return word == "rising" ? Crossing::rising : Crossing::falling;
}

// A run of more steps than a double can count would not end.
void check_step(const Scenario& scenario, const Values& values, const std::string& name) {
  const auto* splitting = scenario.method ? std::get_if<Splitting>(&*scenario.method) : nullptr;
  if (splitting == nullptr || !scenario.time) return;
  const SaveAt& rows = *scenario.time;
  const double farthest = std::max(std::fabs(rows[0]), std::fabs(rows[rows.size() - 1]));
  if (farthest > most_steps * splitting->step)
    refuse(values, "method.step", name, "expected a step of which 1e15 at most make the run");
}

bool is_energy_there(const Scenario& scenario) { return rotor_system(scenario).is_hamiltonian(); }

std::string without_energy(const Scenario& scenario) {
  for (const AnyPerturbation& term : scenario.terms)
    if (!term.supports_energy())
      return "expected no energy, since a perturbation has none: " + term.name();
  return {};
}

// An integrated run visits its rows in order.
void check_times(const Scenario& scenario, const Values& values, const std::string& name) {
  if (!scenario.time || !propagation_method(scenario) || !there(values, "time.at")) return;
  const SaveAt& rows = *scenario.time;
  const bool rises = rows[rows.size() - 1] >= rows[0];
  for (std::int64_t k = 1; k < rows.size(); ++k)
    if (rises ? rows[k] < rows[k - 1] : rows[k] > rows[k - 1])
      refuse(values, "time.at", name,
             "expected times in order, rising or falling, since the run is integrated");
}

}  // namespace

std::vector<ScenarioOrbit> orbits_of(const Values& values, const std::string& name) {
  std::vector<ScenarioOrbit> orbits;
  for (const std::string& path : orbit_paths(values)) {
    const ScenarioOrbit orbit{std::string(key_name(path)),
                              elements_of(values, path, name),
                              {.node = number(values, path + ".node_rate"),
                               .argument = number(values, path + ".pericentre_rate"),
                               .mean_anomaly = number(values, path + ".mean_anomaly_rate")}};
    built(values, path, name, [&] { return PrecessingKeplerOrbit(orbit.elements, orbit.rates); });
    orbits.push_back(orbit);
  }
  return orbits;
}

std::optional<Method> method_of(const Values& values, const std::string& name) {
  if (!there(values, "method")) return std::nullopt;
  const std::string& kind = word(values, "method.kind");
  const double largest = there(values, "method.largest_step")
                             ? number(values, "method.largest_step")
                             : std::numeric_limits<double>::infinity();
  const auto checked = [&](const char* path, const Method& method) {
    return built(values, path, name, [&] {
      require_valid(method);
      return method;
    });
  };
  if (kind == "splitting")
    return checked("method.step", Splitting{number(values, "method.step"),
                                            scheme_of(word(values, "method.scheme"))});
  if (!(largest > 0.0)) refuse(values, "method.largest_step", name, "expected a positive time");
  const double tolerance = number(values, "method.tolerance");
  if (kind == "variation-of-constants")
    return checked("method.tolerance",
                   VariationOfConstants{.tolerance = tolerance, .largest_step = largest});
  const bool wide = word(values, "method.precision") == "double-double";
  return checked("method.tolerance",
                 Adaptive{.tolerance = tolerance,
                          .precision = wide ? Precision::double_double : Precision::compensated,
                          .largest_step = largest});
}

std::vector<ScenarioEvent> events_of(const Values& values, const Units& units,
                                     const std::string& name) {
  std::vector<ScenarioEvent> events;
  const std::vector<std::string_view> known = column_names();
  for (const std::string& path : array_paths(values, "event")) {
    const std::string& column = word(values, path + ".column");
    if (std::find(known.begin(), known.end(), column) == known.end())
      refuse(values, path + ".column", name,
             "expected a column such as \"theta\", \"L\" or \"w3\" (docs/reference/files.md)" +
                 did_you_mean(column, known));
    const std::string own = there(values, path + ".name") ? word(values, path + ".name") : column;
    for (const ScenarioEvent& other : events)
      if (other.name == own)
        refuse(values, path + (there(values, path + ".name") ? ".name" : ".column"), name,
               "expected a name of its own, since an event before it is called " + own);
    const double value = number(values, path + ".value");
    events.push_back({own, column, units.to_core(value, column_dimension(column)),
                      crossing_of(word(values, path + ".crossing")),
                      value_at(values, path + ".stops").whole == 1});
  }
  return events;
}

void add_motion(Scenario& scenario, const Values& values, const std::string& name) {
  add_frame(scenario, values, name);
  for (const std::string& path : array_paths(values, "perturbation")) {
    const std::string& kind = word(values, path + ".kind");
    scenario.kinds.push_back(kind);
    scenario.terms.push_back(built(values, path + ".kind", name, [&] {
      if (kind == "gravity-gradient") return gravity_gradient_of(scenario, values, path, name);
      return kind == "damping" ? damping_of(scenario, values, path, name)
                               : torque_of(scenario, values, path);
    }));
  }
}

void check_motion(const Scenario& scenario, const Values& values, const std::string& name) {
  check_times(scenario, values, name);
  check_step(scenario, values, name);
  if (scenario.method && std::holds_alternative<Splitting>(*scenario.method))
    for (const AnyPerturbation& term : scenario.terms)
      if (!term.supports_flow())
        refuse(values, "method.kind", name,
               "expected \"adaptive\" or \"variation-of-constants\", since a perturbation has no "
               "exact flow: " +
                   term.name());
  if (is_energy_there(scenario)) return;
  if (std::any_of(scenario.columns.begin(), scenario.columns.end(), needs_energy))
    refuse(values, "output.columns", name, without_energy(scenario));
  for (std::size_t i = 0; i < scenario.events.size(); ++i)
    if (needs_energy(scenario.events[i].column))
      refuse(values, "event[" + std::to_string(i) + "].column", name, without_energy(scenario));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
