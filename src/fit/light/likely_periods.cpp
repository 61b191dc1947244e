// SPDX-License-Identifier: MIT
// Likely periods of a tumbling body, from the harmonics of its light.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <span>

#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {

namespace {

constexpr std::size_t strongest = 3;
constexpr double same_pair = 1e-3;
// What is off a whole number by less is one.
constexpr double whole = 1e-6;
// The share of lines that ellipsoids have, but weak ones; and of those that they do not have.
constexpr double weak = 1.5e-3, forbidden = 1e-3;

struct Line {
  int j, k;
  double share;
};

// Mean shares of lines in the light of random ellipsoids at phase angles of 10 to 70 deg (40 of
// them, order 2), rounded; below 1 % from the fewest of them. Labels are taken from the first
// `named`.
constexpr std::array<Line, 20> long_axis{
    {{2, 0, 0.29},  {2, 2, 0.21},  {1, 0, 0.16},   {1, 2, 0.09},   {0, 2, 0.06},
     {2, -2, 0.03}, {2, -4, 0.02}, {1, -2, 0.012}, {4, 0, 0.013},  {4, -4, 0.012},
     {4, -2, 0.01}, {0, 4, 0.008}, {4, 4, 0.005},  {4, 2, 0.005},  {3, 0, 0.003},
     {3, 2, 0.003}, {1, 4, 0.003}, {2, 4, 0.003},  {3, -2, 0.003}, {1, -4, 0.003}}};
constexpr std::array<Line, 19> short_axis{{{1, 1, 0.55},
                                           {2, 0, 0.22},
                                           {2, 2, 0.12},
                                           {0, 2, 0.04},
                                           {1, 3, 0.025},
                                           {1, -1, 0.018},
                                           {2, -2, 0.012},
                                           {0, 4, 0.005},
                                           {1, -3, 0.003},
                                           {4, -4, 0.003},
                                           {3, 1, 0.003},
                                           {2, 4, 0.003},
                                           {4, 0, 0.003},
                                           {3, 3, 0.003},
                                           {1, 5, 0.002},
                                           {2, -4, 0.002},
                                           {3, -1, 0.002},
                                           {4, 2, 0.002},
                                           {4, 4, 0.002}}};
constexpr std::size_t long_named = 8, short_named = 7;

std::span<const Line> lines_of(Regime mode) {
  if (mode == Regime::long_axis) return long_axis;
  return short_axis;
}

double share_of(Regime mode, int j, int k) {
  if (j < 0 || (j == 0 && k < 0)) {
    j = -j;
    k = -k;
  }
  for (const Line& l : lines_of(mode))
    if (l.j == j && l.k == k) return l.share;
  const bool has = mode == Regime::long_axis ? k % 2 == 0 : (j + k) % 2 == 0;
  return has ? weak : forbidden;
}

// Two lines of the series, and what they are in f_phi and f_psi.
struct Reading {
  Regime mode;
  FourierTerm first, second;
  int j1, k1, j2, k2;
};

// Where the equations have a solution of positive frequencies.
std::optional<TumblerPeriods> periods_of(const Reading& r, double f1, double f2) {
  const int det = r.j1 * r.k2 - r.k1 * r.j2;
  if (det == 0) return std::nullopt;
  const double a = r.first.j * f1 + r.first.k * f2, b = r.second.j * f1 + r.second.k * f2;
  const double f_phi = (r.k2 * a - r.k1 * b) / det, f_psi = (r.j1 * b - r.j2 * a) / det;
  if (!(f_phi > 0.0) || !(f_psi > 0.0)) return std::nullopt;
  if (r.mode == Regime::short_axis && !(f_psi < f_phi)) return std::nullopt;
  return TumblerPeriods{r.mode, 1.0 / f_phi, 1.0 / f_psi};
}

double power(const FourierTerm& t) { return t.cosine * t.cosine + t.sine * t.sine; }

double score_of(const Reading& r, std::span<const FourierTerm> terms, double total) {
  const double det = r.first.j * r.second.k - r.first.k * r.second.j;
  double score = 0.0;
  for (const FourierTerm& t : terms) {
    const double a = (t.j * r.second.k - t.k * r.second.j) / det;
    const double b = (r.first.j * t.k - r.first.k * t.j) / det;
    const double j = a * r.j1 + b * r.j2, k = a * r.k1 + b * r.k2;
    const double at_j = std::round(j), at_k = std::round(k);
    const bool is_line = std::abs(j - at_j) < whole && std::abs(k - at_k) < whole;
    const double share =
        is_line ? share_of(r.mode, static_cast<int>(at_j), static_cast<int>(at_k)) : forbidden;
    score += power(t) / total * std::log(share);
  }
  return score;
}

bool are_same(const TumblerPeriods& a, const TumblerPeriods& b) {
  return a.mode == b.mode &&
         std::abs(a.precession_period / b.precession_period - 1.0) < same_pair &&
         std::abs(a.rotation_period / b.rotation_period - 1.0) < same_pair;
}

// All readings of two lines in one mode: the sign of the first pair of j and k is that of both.
template <class F>
void for_readings(Regime mode, const FourierTerm& first, const FourierTerm& second, const F& f) {
  const std::size_t named = mode == Regime::long_axis ? long_named : short_named;
  const std::span<const Line> lines = lines_of(mode).first(named);
  for (const Line& a : lines)
    for (const int sa : {1, -1})
      for (const Line& b : lines)
        for (const int sb : {1, -1})
          f(Reading{mode, first, second, sa * a.j, sa * a.k, sb * b.j, sb * b.k});
}

}  // namespace

std::vector<LikelyPeriods> likely_periods(const FourierFit& fit) {
  std::vector<FourierTerm> terms = fit.terms;
  // a line without power is no line
  std::erase_if(terms, [](const FourierTerm& t) { return !(power(t) > 0.0); });
  std::ranges::stable_sort(terms, std::ranges::greater{}, power);
  double total = 0.0;
  for (const FourierTerm& t : terms) total += power(t);
  std::vector<LikelyPeriods> found;
  const auto add = [&](const Reading& r) {
    const std::optional<TumblerPeriods> p = periods_of(r, fit.f1, fit.f2);
    if (!p) return;
    const bool is_known = std::ranges::any_of(
        found, [&](const LikelyPeriods& known) { return are_same(known.periods, *p); });
    if (!is_known) found.push_back({*p, score_of(r, terms, total)});
  };
  const std::size_t count = std::min(strongest, terms.size());
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b) {
      if (terms[a].j * terms[b].k == terms[a].k * terms[b].j) continue;
      for (const Regime mode : {Regime::long_axis, Regime::short_axis})
        for_readings(mode, terms[a], terms[b], add);
    }
  std::ranges::stable_sort(found, std::ranges::greater{}, &LikelyPeriods::score);
  return found;
}

namespace {

constexpr double same_periods = 1e-3;

}  // namespace

std::vector<TumblerPeriods> labelled_periods(std::span<const ScanMinimum> minima,
                                             const LabelChoice& choice) {
  std::vector<TumblerPeriods> found;
  const auto is_known = [&](const TumblerPeriods& l) {
    return std::ranges::any_of(found, [&](const TumblerPeriods& p) {
      return p.mode == l.mode &&
             std::abs(p.precession_period / l.precession_period - 1.0) < same_periods &&
             std::abs(p.rotation_period / l.rotation_period - 1.0) < same_periods;
    });
  };
  std::size_t pairs = 0;
  for (const ScanMinimum& m : minima) {
    if (!m.resolved || !m.refined.converged || m.at_edge) continue;
    if (pairs++ == choice.pairs) break;
    std::size_t taken = 0;
    for (const LikelyPeriods& l : likely_periods(m.refined.fit)) {
      if (taken++ == choice.labels) break;
      if (!is_known(l.periods)) found.push_back(l.periods);
    }
  }
  return found;
}

}  // namespace fit
}  // namespace v0
}  // namespace polhode
