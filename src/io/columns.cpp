// SPDX-License-Identifier: MIT
#include "polhode/io/columns.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "io/detail/nearest.hpp"
#include "polhode/error.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/euler.hpp"

namespace polhode {
inline namespace v0 {

struct RowSample {
  const FreeRotation& motion;
  const SerretState& elements;
  double t = 0.0;
  RotorState state = {};
};

namespace {

using enum Dimension;

constexpr std::size_t widest_group = 6;
using Numbers = std::array<double, widest_group>;

struct ColumnSpec {
  std::string_view name;
  Dimension dimension;
};
struct GroupSpec {
  std::string_view name;
  std::array<ColumnSpec, widest_group> columns;  // an empty name ends them
  Numbers (*numbers)(const RowSample&);
};

Numbers numbers_of(const Vec3& v) { return {v.x, v.y, v.z, 0.0, 0.0, 0.0}; }

// Principal axes B to the axes F of the body's tensor; the identity without one.
Vec3 in_body_axes(const RowSample& s, const Vec3& v_B) {
  return rotate(s.motion.body().q_FB(), v_B);
}

Numbers attitude_numbers(const RowSample& s) {
  const Quaternion q = s.state.q * conj(s.motion.body().q_FB());
  return {q.w, q.x, q.y, q.z, 0.0, 0.0};
}
Numbers omega_numbers(const RowSample& s) {
  return numbers_of(in_body_axes(s, angular_velocity(s.motion.body(), s.state)));
}
Numbers inertial_omega_numbers(const RowSample& s) {
  return numbers_of(inertial_angular_velocity(s.motion.body(), s.state));
}
Numbers momentum_numbers(const RowSample& s) { return numbers_of(in_body_axes(s, s.state.g)); }
Numbers euler_numbers(const RowSample& s) {
  const EulerState e = to_euler(s.state);
  return {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
}
Numbers andoyer_numbers(const RowSample& s) {
  const AndoyerState a = to_andoyer(s.state);
  return {a.l, a.g, a.h, a.L, a.G, a.H};
}
Numbers sadov_numbers(const RowSample& s) {
  const SadovState a = to_sadov(s.motion, s.t);
  return {a.phi_l, a.phi_g, a.phi_h, a.I_l, a.I_g, a.I_h};
}
Numbers serret_numbers(const RowSample& s) {
  const SerretState& a = s.elements;
  return {a.g0, a.t0, a.T, a.h, a.G, a.H};
}

constexpr GroupSpec specs[] = {
    {"q", {{{"qw", number}, {"qx", number}, {"qy", number}, {"qz", number}}}, attitude_numbers},
    {"omega", {{{"w1", rate}, {"w2", rate}, {"w3", rate}}}, omega_numbers},
    {"omega_inertial", {{{"W1", rate}, {"W2", rate}, {"W3", rate}}}, inertial_omega_numbers},
    {"g", {{{"g1", momentum}, {"g2", momentum}, {"g3", momentum}}}, momentum_numbers},
    {"euler",
     {{{"phi", angle},
       {"theta", angle},
       {"psi", angle},
       {"Phi", momentum},
       {"Theta", momentum},
       {"Psi", momentum}}},
     euler_numbers},
    {"andoyer",
     {{{"l", angle},
       {"g", angle},
       {"h", angle},
       {"L", momentum},
       {"G", momentum},
       {"H", momentum}}},
     andoyer_numbers},
    {"sadov",
     {{{"phi_l", angle},
       {"phi_g", angle},
       {"phi_h", angle},
       {"I_l", momentum},
       {"I_g", momentum},
       {"I_h", momentum}}},
     sadov_numbers},
    {"serret",
     {{{"g0", angle}, {"t0", time}, {"T", energy}, {"h", angle}, {"G", momentum}, {"H", momentum}}},
     serret_numbers},
};

std::size_t spec_index(const std::string& name) {
  const auto found = std::find_if(std::begin(specs), std::end(specs),
                                  [&](const GroupSpec& spec) { return spec.name == name; });
  if (found != std::end(specs)) return static_cast<std::size_t>(found - std::begin(specs));
  const std::vector<std::string_view> names = column_group_names();
  const std::string_view near = detail::nearest(name, names);
  throw DomainError("RowLayout: unknown column group \"" + name + "\"" +
                    (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
}

}  // namespace

std::vector<std::string_view> column_group_names() {
  std::vector<std::string_view> names;
  for (const GroupSpec& spec : specs) names.push_back(spec.name);
  return names;
}

RowLayout::RowLayout(std::span<const std::string> groups, const Units& units) : units_(units) {
  groups_.push_back({"t", {{"t", units.label(Dimension::time)}}});
  std::vector<std::string_view> taken;
  for (const std::string& name : groups) {
    const std::size_t group = spec_index(name);
    ColumnGroup shown{name, {}};
    for (std::size_t i = 0; i < widest_group; ++i) {
      const ColumnSpec& column = specs[group].columns[i];
      if (column.name.empty()) break;
      if (std::find(taken.begin(), taken.end(), column.name) != taken.end()) continue;
      taken.push_back(column.name);
      shown.columns.push_back({std::string(column.name), units.label(column.dimension)});
      cells_.push_back({group, i, column.dimension});
    }
    if (shown.columns.empty())
      throw DomainError("RowLayout: column group \"" + name + "\" is there twice");
    groups_.push_back(std::move(shown));
  }
  width_ = cells_.size() + 1;
}

void RowLayout::write_row(const RowSample& sample, std::span<double> out) const {
  out[0] = units_.from_core(sample.t, Dimension::time);
  Numbers numbers{};
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    if (i == 0 || cells_[i - 1].group != cell.group) numbers = specs[cell.group].numbers(sample);
    out[i + 1] = units_.from_core(numbers[cell.index], cell.dimension);
  }
}

void RowLayout::write_rows(const FreeRotation& motion, std::span<const double> times,
                           std::span<double> out) const {
  const bool serret = std::any_of(cells_.begin(), cells_.end(), [](const Cell& cell) {
    return specs[cell.group].numbers == serret_numbers;
  });
  const SerretState elements = serret ? to_serret(motion, 0.0) : SerretState{};
  RowSample sample{motion, elements};
  for (std::size_t k = 0; k < times.size(); ++k) {
    sample.t = times[k];
    sample.state = motion.at(times[k]);
    write_row(sample, out.subspan(k * width_, width_));
  }
}

}  // namespace v0
}  // namespace polhode
