// SPDX-License-Identifier: MIT
#include "series/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace {

using polhode::detail::number_text;
using Complex = std::complex<double>;

constexpr std::size_t most_points = std::size_t{1} << 26;

struct Axis {
  int angle;           // its place among the angles of the symbols
  std::size_t points;  // odd
  std::size_t stride;  // between neighbours in a grid
  int largest() const { return static_cast<int>(points / 2); }
  // The multiplier of the harmonic at place i of a transform.
  int harmonic(std::size_t i) const {
    return static_cast<int>(i) <= largest() ? static_cast<int>(i)
                                            : static_cast<int>(i) - static_cast<int>(points);
  }
};

struct Grid {
  std::vector<Axis> axes;
  std::size_t size = 1;
  std::size_t place(const Axis& axis, std::size_t node) const {
    return node / axis.stride % axis.points;
  }
};

Grid grid_of(const Symbols& symbols, const std::vector<FourierAngle>& angles) {
  Grid grid;
  for (const auto& [name, points] : angles) {
    const int angle = symbols.angle(name);
    if (points < 1 || points % 2 == 0)
      throw DomainError("fourier_series: " + std::to_string(points) + " points for the angle " +
                        name + " must be odd and at least 1");
    for (const Axis& other : grid.axes)
      if (other.angle == angle) throw DomainError("fourier_series: " + name + " is there twice");
    grid.axes.push_back({angle, static_cast<std::size_t>(points), grid.size});
    grid.size *= static_cast<std::size_t>(points);
    if (grid.size > most_points)
      throw DomainError("fourier_series: the grid has more than " + std::to_string(most_points) +
                        " points (2^26)");
  }
  return grid;
}

// Two real functions are the parts of one complex one: values[j] has functions 2 j and 2 j + 1.
struct Values {
  std::size_t functions = 0;
  std::vector<std::vector<Complex>> pairs;
};

[[noreturn]] void refuse_value(double value, const std::vector<double>& angles) {
  std::string at;
  for (const double angle : angles) at += (at.empty() ? "" : ", ") + number_text(angle);
  throw DomainError("fourier_series: f is " + number_text(value) + " at (" + at +
                    "); it must be finite everywhere");
}

Values values_of(const Grid& grid,
                 const std::function<std::vector<double>(std::span<const double>)>& f) {
  Values values;
  std::vector<double> angles(grid.axes.size());
  for (std::size_t node = 0; node < grid.size; ++node) {
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const Axis& axis = grid.axes[i];
      angles[i] = 2.0 * std::numbers::pi * static_cast<double>(grid.place(axis, node)) /
                  static_cast<double>(axis.points);
    }
    std::vector<double> here = f(angles);
    if (node == 0) {
      values.functions = here.size();
      values.pairs.assign((here.size() + 1) / 2, std::vector<Complex>(grid.size));
    }
    if (here.size() != values.functions)
      throw DomainError("fourier_series: f has " + std::to_string(here.size()) +
                        " values at one point and " + std::to_string(values.functions) +
                        " at another");
    for (const double value : here)
      if (!std::isfinite(value)) refuse_value(value, angles);
    here.resize(2 * values.pairs.size(), 0.0);
    for (std::size_t j = 0; j < values.pairs.size(); ++j)
      values.pairs[j][node] = {here[2 * j], here[2 * j + 1]};
  }
  return values;
}

// The transform along one axis, in place. Grids are short: a plain sum is as fast as what is
// clever.
void transform(std::vector<Complex>& values, const Axis& axis) {
  const std::size_t n = axis.points;
  std::vector<Complex> roots(n), line(n);
  for (std::size_t i = 0; i < n; ++i)
    roots[i] =
        std::polar(1.0 / static_cast<double>(n),
                   -2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
  for (std::size_t at = 0; at < values.size() / n; ++at) {
    const std::size_t start = at / axis.stride * axis.stride * n + at % axis.stride;
    for (std::size_t i = 0; i < n; ++i) line[i] = values[start + i * axis.stride];
    for (std::size_t k = 0; k < n; ++k) {
      double re = 0.0, im = 0.0;  // std::complex's product looks for infinities
      std::size_t root = 0;
      for (std::size_t i = 0; i < n; ++i) {
        re += line[i].real() * roots[root].real() - line[i].imag() * roots[root].imag();
        im += line[i].real() * roots[root].imag() + line[i].imag() * roots[root].real();
        root += k;
        if (root >= n) root -= n;
      }
      values[start + k * axis.stride] = {re, im};
    }
  }
}

// The place of the harmonic with the opposite multipliers.
std::size_t opposite(const Grid& grid, std::size_t node) {
  std::size_t other = 0;
  for (const Axis& axis : grid.axes) {
    const std::size_t i = grid.place(axis, node);
    other += (i == 0 ? 0 : axis.points - i) * axis.stride;
  }
  return other;
}

// c_k of two real functions, of which one complex transform has c_k and c_-k.
std::pair<Complex, Complex> separated(Complex at, Complex at_opposite) {
  const Complex a = at, b = std::conj(at_opposite);
  return {0.5 * (a + b), Complex(0.0, -0.5) * (a - b)};
}

}  // namespace

FourierSeries fourier_series(const Symbols& symbols, const std::vector<FourierAngle>& angles,
                             const std::function<std::vector<double>(std::span<const double>)>& f,
                             double least) {
  if (!(least >= 0.0))
    throw DomainError("fourier_series: least " + number_text(least) + " must not be negative");
  const Grid grid = grid_of(symbols, angles);
  Values values = values_of(grid, f);
  for (std::vector<Complex>& pair : values.pairs)
    for (const Axis& axis : grid.axes) transform(pair, axis);
  FourierSeries found{{}, 0.0};
  std::vector<std::vector<Term<double>>> terms(2 * values.pairs.size());
  for (std::size_t node = 0; node < grid.size; ++node) {
    const std::size_t other = opposite(grid, node);
    if (other < node) continue;  // c_-k is the conjugate of c_k
    Multiples multiples;
    bool border = false;
    for (const Axis& axis : grid.axes) {
      const int k = axis.harmonic(grid.place(axis, node));
      border = border || (k != 0 && std::abs(k) == axis.largest());
      multiples.emplace_back(symbols.angles()[static_cast<std::size_t>(axis.angle)], k);
    }
    const double twice = other == node ? 1.0 : 2.0;
    for (std::size_t j = 0; j < values.pairs.size(); ++j) {
      const auto [first, second] = separated(values.pairs[j][node], values.pairs[j][other]);
      for (const auto& [c, function] : {std::pair{first, 2 * j}, std::pair{second, 2 * j + 1}}) {
        if (border) found.at_border = std::max(found.at_border, twice * std::abs(c));
        const double of_cosine = twice * c.real(), of_sine = -twice * c.imag();
        if (std::abs(of_cosine) > least)
          terms[function].push_back(
              {packed(symbols, {}, multiples, Trigonometric::cosine), of_cosine});
        if (other != node && std::abs(of_sine) > least)
          terms[function].push_back({packed(symbols, {}, multiples, Trigonometric::sine), of_sine});
      }
    }
  }
  for (std::size_t i = 0; i < values.functions; ++i)
    found.series.emplace_back(symbols, std::move(terms[i]));
  return found;
}

}  // namespace series
}  // namespace v0
}  // namespace polhode
