// SPDX-License-Identifier: MIT
#include "polhode/fit/period_labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/free/tumbler.hpp"

namespace polhode {
inline namespace v0 {
namespace {

std::vector<LineLabel> lines(int most) {
  std::vector<LineLabel> all;
  for (int j = -most; j <= most; ++j)
    for (int k = -most; k <= most; ++k)
      if (j != 0 || k != 0) all.push_back({j, k});
  const int halves = most + 1;
  for (int j = -halves; j <= halves; ++j)
    for (int k = -halves; k <= halves; ++k)
      if (j % 2 != 0 || k % 2 != 0) all.push_back({j, k, 2});
  return all;
}

bool of_ellipsoid(const LineLabel& line, Regime mode) {
  return mode == Regime::long_axis ? line.k % 2 == 0 : (line.j + line.k) % 2 == 0;
}

int weakness(const LineLabel& line) {
  const int j = std::abs(line.j), k = std::abs(line.k);
  if (line.over == 2) return 5 + j + k;
  if (j == 2 && k == 0) return 0;
  if (j == 2 && k == 2) return 1;
  if (j + k <= 2) return 2;
  return j + k;
}

int weakness(const PeriodLabel& label) {
  return (label.of_ellipsoid ? 0 : 100) + weakness(label.first) + weakness(label.second);
}

}  // namespace

std::vector<PeriodLabel> period_labels(double f1, double f2, int most) {
  for (const double f : {f1, f2})
    if (!(f > 0.0) || !std::isfinite(f))
      throw DomainError("period_labels: frequency " + detail::number_text(f) + " must be positive");
  if (most < 1 || most > 9)
    throw DomainError("period_labels: most " + std::to_string(most) + ": it must be 1 to 9");
  std::vector<PeriodLabel> labels;
  const std::vector<LineLabel> all = lines(most);
  for (const LineLabel& a : all)
    for (const LineLabel& b : all) {
      const int determinant = a.j * b.k - a.k * b.j;
      if (determinant == 0) continue;
      const double line1 = a.over * f1, line2 = b.over * f2;
      const double f_phi = (b.k * line1 - a.k * line2) / determinant;
      const double f_psi = (a.j * line2 - b.j * line1) / determinant;
      if (!(f_phi > 0.0) || !(f_psi > 0.0)) continue;
      for (const Regime mode : {Regime::long_axis, Regime::short_axis}) {
        if (mode == Regime::short_axis && !(f_psi < f_phi)) continue;
        labels.push_back(
            {mode, 1.0 / f_phi, 1.0 / f_psi, a, b, of_ellipsoid(a, mode) && of_ellipsoid(b, mode)});
      }
    }
  std::stable_sort(labels.begin(), labels.end(), [](const PeriodLabel& a, const PeriodLabel& b) {
    return weakness(a) < weakness(b);
  });
  return labels;
}

bool allows(const Body& body, const PeriodLabel& label) {
  const double ratio = label.rotation_period / label.precession_period;
  try {
    return ratio > least_period_ratio(body, label.mode);
  } catch (const DomainError&) {
    return false;  // a body that does not have the mode
  }
}

}  // namespace v0
}  // namespace polhode
