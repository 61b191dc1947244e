// SPDX-License-Identifier: MIT
// Bodies and states of every regime and near every edge, the same ones for any revision: nothing of
// the library makes them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace probe {

using Triple = std::array<double, 3>;

struct Case {
  std::string name;
  Triple moments{};
  std::array<double, 4> q{};
  Triple g{};
  double t0 = 0.0;
  double turn = 1.0;  // 2 pi / |omega|, or 1
};

// Its own random numbers (splitmix64): those of a standard library may change.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}
  double uniform(double a, double b) {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return a + (b - a) * std::ldexp(static_cast<double>((z ^ (z >> 31)) >> 11), -53);
  }
  std::size_t index(std::size_t n) {
    return static_cast<std::size_t>(uniform(0.0, static_cast<double>(n)));
  }
  bool coin() { return uniform(0.0, 1.0) < 0.5; }
  double sign() { return coin() ? 1.0 : -1.0; }
  double power_of_ten(double a, double b) { return std::pow(10.0, uniform(a, b)); }
  double angle() { return uniform(-3.2, 3.2); }

 private:
  std::uint64_t state_;
};

// 0 < I1 < I2 < I3 < I1 + I2.
inline Triple triaxial(Draw& draw) {
  Triple m{draw.uniform(0.02, 1.0), draw.uniform(0.02, 1.0), draw.uniform(0.02, 1.0)};
  std::sort(m.begin(), m.end());
  return {m[0] + m[1], m[0] + m[2], m[1] + m[2]};
}

inline Triple direction(Draw& draw) {
  const double z = draw.uniform(-1.0, 1.0), turn = draw.angle();
  const double r = std::sqrt((1.0 - z) * (1.0 + z));
  return {r * std::cos(turn), r * std::sin(turn), z};
}

// Within delta of an axis.
inline Triple near_axis(Draw& draw, std::size_t axis, double delta) {
  const double turn = draw.angle();
  Triple v{};
  v[axis] = draw.sign() * std::sqrt((1.0 - delta) * (1.0 + delta));
  v[(axis + 1) % 3] = delta * std::cos(turn);
  v[(axis + 2) % 3] = delta * std::sin(turn);
  return v;
}

// Moments that rise, and the momentum along their axes; scaled and put in any order later.
struct Sorted {
  Triple I;
  Triple g;
  double moment_scale = 1.0;
  double momentum_scale = 1.0;
};

inline Sorted generic(Draw& d) {
  return {triaxial(d), direction(d), d.power_of_ten(-3, 3), d.power_of_ten(-3, 3)};
}
inline Sorted close_to_axis(Draw& d) {
  return {triaxial(d), near_axis(d, d.index(3), d.power_of_ten(-16, -2))};
}
inline Sorted on_axis(Draw& d) {
  Sorted s{triaxial(d), {}};
  s.g[d.index(3)] = d.sign();
  return s;
}
// The middle axis, and transverse components down to the smallest numbers.
inline Sorted middle_axis(Draw& d) {
  Sorted s{triaxial(d), {0.0, d.sign(), 0.0}};
  if (d.coin()) s.g[0] = d.sign() * d.power_of_ten(-320, -3);
  if (d.coin()) s.g[2] = d.sign() * d.power_of_ten(-320, -3);
  return s;
}
inline Sorted nearly_equal(Draw& d) {
  const auto small = [&d] { return d.coin() ? d.power_of_ten(-16, -3) : 0.0; };
  Sorted s{{1.0, 1.0, 1.0}, direction(d)};
  const std::size_t kind = d.index(3);
  if (kind == 0) s.I = {1.0, 1.0 + small(), d.uniform(1.1, 1.9)};
  if (kind == 1) s.I = {d.uniform(0.01, 0.9), 1.0, 1.0 + small()};
  if (kind == 2) s.I = {1.0, 1.0 + small(), 1.0 + small()};
  std::sort(s.I.begin(), s.I.end());
  if (d.coin()) s.g = near_axis(d, d.index(3), d.power_of_ten(-14, -3));
  return s;
}
// G^2 - 2 T I2 of 1e-17 to 1e-3 of G^2, both sides.
inline Sorted near_separatrix(Draw& d) {
  Sorted s{triaxial(d), {}};
  const double a = (s.I[2] - s.I[1]) / s.I[2], b = (s.I[1] - s.I[0]) / s.I[0];
  const double least = std::min(a, b);
  const double d2 = d.sign() * std::min(d.power_of_ten(-17, -3), 0.5 * least);
  const double smallest = std::abs(d2) / least;
  const double side = d.coin() ? smallest + (1.0 - smallest) * d.uniform(0.0, 1.0)
                               : std::pow(smallest, d.uniform(0.0, 1.0));
  s.g = {d.sign() * std::sqrt(std::max(0.0, (a * side - d2) / (a + b))),
         d.sign() * std::sqrt(std::max(0.0, 1.0 - side)),
         d.sign() * std::sqrt(std::max(0.0, (b * side + d2) / (a + b)))};
  return s;
}
// Exactly on it: g1^2 (I2 - I1) / I1 = g3^2 (I3 - I2) / I3 in integers.
inline Sorted separatrix(Draw& d) {
  struct Integers {
    Triple I;
    double g1, g3;
  };
  static const std::array<Integers, 3> all{
      {{{3, 4, 6}, 1, 1}, {{9, 10, 18}, 2, 1}, {{3, 6, 8}, 1, 2}}};
  const Integers& of = all[d.index(all.size())];
  const double x = std::ldexp(std::floor(d.uniform(0.1, 1.0) * 0x1p20), -20);
  return {of.I, {d.sign() * of.g1 * x, d.sign() * d.power_of_ten(-3, 6), d.sign() * of.g3 * x}};
}
inline Sorted needle(Draw& d) {
  const double thin = d.power_of_ten(-155, -1);
  return {{thin, 1.0, 1.0 + thin * d.uniform(0.0, 1.0)}, direction(d)};
}
inline Sorted disc(Draw& d) {
  const double mass = d.power_of_ten(-8, 0);
  return {{mass, 1.0, 1.0 + mass}, direction(d), std::ldexp(1.0, static_cast<int>(d.index(21)))};
}
inline Sorted extreme_scale(Draw& d) {
  const Sorted s = d.coin() ? near_separatrix(d) : generic(d);
  return {s.I, s.g, std::ldexp(1.0, static_cast<int>(d.uniform(-500, 500))),
          d.power_of_ten(-160, 160)};
}
inline Sorted rest(Draw& d) { return {triaxial(d), {}}; }

using Maker = Sorted (*)(Draw&);
inline constexpr std::pair<const char*, Maker> families[] = {{"generic", generic},
                                                             {"near-axis", close_to_axis},
                                                             {"on-axis", on_axis},
                                                             {"middle-axis", middle_axis},
                                                             {"nearly-equal", nearly_equal},
                                                             {"near-separatrix", near_separatrix},
                                                             {"separatrix", separatrix},
                                                             {"needle", needle},
                                                             {"disc", disc},
                                                             {"extreme-scale", extreme_scale},
                                                             {"rest", rest}};

// A product of a turn by h about the third axis and a tilt by I about the first: the node of the
// momentum is then near, or at, that of a chart.
inline std::array<double, 4> attitude(Draw& d) {
  if (d.coin()) return {d.uniform(-1, 1), d.uniform(-1, 1), d.uniform(-1, 1), d.uniform(-1, 1)};
  const double I = d.coin() ? d.power_of_ten(-160, 0) : 0.0, h = d.angle();
  const double c = std::cos(0.5 * I), s = std::sin(0.5 * I);
  const std::array<double, 4> q{std::cos(0.5 * h) * c, std::cos(0.5 * h) * s, std::sin(0.5 * h) * s,
                                std::sin(0.5 * h) * c};
  return d.coin() ? q : std::array<double, 4>{-q[1], q[0], q[3], -q[2]};  // and the other pole
}

inline Case placed(Draw& d, const Sorted& s) {
  Case c;
  std::array<std::size_t, 3> axis{0, 1, 2};
  for (std::size_t i = 2; i > 0; --i) std::swap(axis[i], axis[d.index(i + 1)]);
  double square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    c.moments[axis[i]] = s.moment_scale * s.I[i];
    c.g[axis[i]] = s.momentum_scale * s.g[i];
    square += (s.g[i] / s.I[i]) * (s.g[i] / s.I[i]);
  }
  const double rate = std::sqrt(square) * (s.momentum_scale / s.moment_scale);
  if (std::isfinite(rate) && rate > 0.0) c.turn = 6.283185307179586 / rate;
  c.q = attitude(d);
  if (d.coin()) c.t0 = d.uniform(-10.0, 10.0) * c.turn;
  return c;
}

inline std::vector<Case> cases(int of_each) {
  std::vector<Case> all;
  std::uint64_t seed = 1;
  for (const auto& [name, make] : families) {
    Draw draw(seed++);
    for (int k = 0; k < of_each; ++k) {
      all.push_back(placed(draw, make(draw)));
      all.back().name = name + std::string("/") + std::to_string(k);
    }
  }
  return all;
}

}  // namespace probe
