// SPDX-License-Identifier: MIT
// The oracle of the state transition matrix of free rotation, in the tangent of the hub:
// (dtheta_B, dg_B), dtheta_B the change of attitude in body axes, q -> q exp(dtheta_B/2).
//
// Equations   d(dtheta)/dt = -omega x dtheta + I^-1 dg,  d(dg)/dt = dg x omega + g x I^-1 dg,
//             integrated as Taylor series along the body's polhode; at fixed dg = 0,
//             dtheta(t) = A(t)^T A(0) dtheta(0). The coefficients depend on g alone, which half a
//             period turns by S about the pole, so that with Phi1 = Phi(P/2), D = diag(S, S)
//                 Phi(N P/2 + r) = D^N Phi(r) (D Phi1)^N.
// Accuracy    76 digits, steps good to 1e-66 relative to each column.
#pragma once

#include <cstdlib>

#include "oracle/free_body.hpp"
#include "polhode/math/vector.hpp"
#include "worst.hpp"

namespace oracle {

using WideMatrix6 = polhode::BasicMatrix6<Wide>;
using polhode::test::larger;
using polhode::test::smaller;

class FreeTransition {
 public:
  explicit FreeTransition(FreeBody& body) : body_(body) {}
  // d(tangent after `elapsed`)/d(tangent at the start)
  WideMatrix6 at(const Wide& elapsed);

 private:
  struct Column {
    WideVec3 theta, g;
  };
  struct ColumnSeries {
    Series3 theta, g;
  };
  using Columns = std::array<Column, 3>;

  WideMatrix6 integrated(const Wide& elapsed);
  void append_order(const Series3& g, ColumnSeries& column, std::size_t k) const;
  double log2_step_of(const Series3& s) const;
  Wide advance(WideVec3& y, Columns& columns, const Wide& left) const;
  WideMatrix6 assembled(const Columns& columns, const Wide& elapsed);

  FreeBody& body_;
};

inline Series3 as_series(const WideVec3& v) { return {Series{v.x}, Series{v.y}, Series{v.z}}; }

inline void FreeTransition::append_order(const Series3& g, ColumnSeries& column,
                                         std::size_t k) const {
  const auto& [I1, I2, I3] = body_.equations().moments();
  const std::array<Wide, 3> I{I1, I2, I3};
  const auto times = [k](const Series& a, const Series& b) { return convolution(a, b, k); };
  std::array<Wide, 3> theta_dot, g_dot;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
    const Wide c = (I[j] - I[l]) / (I[j] * I[l]);
    g_dot[i] = c == 0 ? Wide(0) : c * (times(column.g[j], g[l]) + times(column.g[l], g[j]));
    theta_dot[i] = times(column.theta[j], g[l]) / I[l] - times(column.theta[l], g[j]) / I[j] +
                   column.g[i][k] / I[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    column.g[i].push_back(g_dot[i] / (k + 1));
    column.theta[i].push_back(theta_dot[i] / (k + 1));
  }
}

// As log2_step, for a vector: relative to the largest component of its value or of its change.
inline double FreeTransition::log2_step_of(const Series3& s) const {
  const auto largest = [&s](std::size_t k) {
    return larger(log2_magnitude(s[0][k]), log2_magnitude(s[1][k]), log2_magnitude(s[2][k]));
  };
  const double tolerance = body_.settings().log10_tolerance * std::log2(10.0);
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t m = s[0].size() - 4; m < s[0].size(); ++m) {
    const double top = largest(m);
    if (std::isinf(top)) continue;
    result = smaller(result, larger((tolerance + largest(0) - top) / static_cast<double>(m),
                                    (tolerance + largest(1) - top) / static_cast<double>(m - 1)));
  }
  return result;
}

// One step of at most `left` (signed); returns the time advanced.
inline Wide FreeTransition::advance(WideVec3& y, Columns& columns, const Wide& left) const {
  const EulerEquations& equations = body_.equations();
  Series3 unknowns = as_series(y), g = as_series(equations.momentum(y));
  std::array<ColumnSeries, 3> series;
  for (std::size_t i = 0; i < 3; ++i)
    series[i] = {as_series(columns[i].theta), as_series(columns[i].g)};
  for (std::size_t k = 0; k < body_.settings().order; ++k) {
    for (ColumnSeries& column : series) append_order(g, column, k);
    equations.append_order(unknowns, k);
    const WideVec3 next =
        equations.momentum({unknowns[0].back(), unknowns[1].back(), unknowns[2].back()});
    for (std::size_t i = 0; i < 3; ++i) g[i].push_back(component(next, i));
  }
  double length = log2_step(unknowns, body_.settings());
  for (const ColumnSeries& column : series)
    length = smaller(length, log2_step_of(column.theta), log2_step_of(column.g));
  Wide h = abs(left);
  if (std::isfinite(length) && pow(Wide(2), Wide(length)) < h) h = pow(Wide(2), Wide(length));
  if (left < 0) h = -h;
  y = polynomial(unknowns, h);
  for (std::size_t i = 0; i < 3; ++i)
    columns[i] = {polynomial(series[i].theta, h), polynomial(series[i].g, h)};
  return h;
}

inline WideMatrix6 FreeTransition::assembled(const Columns& columns, const Wide& elapsed) {
  WideMatrix6 phi;
  const auto A0 = polhode::rotation_matrix(body_.initial().q);
  const auto turned = polhode::transpose(polhode::rotation_matrix(body_.at(elapsed).q)) * A0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Column& column = columns[static_cast<std::size_t>(j)];
      phi(i, j) = turned(i, j);
      phi(i, 3 + j) = column.theta[i];
      phi(3 + i, 3 + j) = column.g[i];
    }
  }
  return phi;
}

inline WideMatrix6 FreeTransition::integrated(const Wide& elapsed) {
  WideVec3 y = body_.equations().unknowns();
  Columns columns;
  for (int i = 0; i < 3; ++i) columns[static_cast<std::size_t>(i)].g[i] = 1;
  for (Wide left = elapsed; left != 0;) left -= advance(y, columns, left);
  return assembled(columns, elapsed);
}

inline WideMatrix6 FreeTransition::at(const Wide& elapsed) {
  const bool periodic = body_.motion() == Motion::periodic;
  const Wide halves = periodic ? Wide(trunc(elapsed / body_.half_period())) : Wide(0);
  if (halves == 0) return integrated(elapsed);
  const Wide half = halves < 0 ? -body_.half_period() : body_.half_period();
  WideMatrix6 turn = WideMatrix6::identity();  // D
  for (int i = 0; i < 3; ++i) {
    const bool pole = static_cast<std::size_t>(i) == body_.pole();
    turn(i, i) = turn(3 + i, 3 + i) = pole ? 1 : -1;
  }
  WideMatrix6 factor = turn * integrated(half), power = WideMatrix6::identity();
  const long count = std::labs(halves.convert_to<long>());
  for (long n = count; n > 0; n /= 2) {
    if (n % 2 == 1) power = power * factor;
    factor = factor * factor;
  }
  const WideMatrix6 rest = integrated(elapsed - halves * body_.half_period()) * power;
  return count % 2 == 1 ? turn * rest : rest;
}

}  // namespace oracle
