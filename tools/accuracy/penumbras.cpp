// SPDX-License-Identifier: MIT
// Twelve random satellites in the conical shadow of the Earth: errors and steps of methods against
// an integration of its own in 80-bit arithmetic, for docs/accuracy/perturbed-rotation.md.
//   g++ -O2 -std=c++20 -Iinclude -Isrc tools/accuracy/penumbras.cpp build/release/src/libpolhode.a
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "polhode/dynamics/integrate.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/solar_pressure.hpp"

namespace {

constexpr double gm = 3.986004418e14, gm_sun = 1.32712440018e20, earth = 6.378e6,
                 sun_radius = 6.957e8;
constexpr double far = 1.496e11, light = 4.56e-6, sun_inclination = 0.409;

struct Plate {
  std::array<double, 3> centre, normal;
  double area, specular, diffuse;
};
struct Satellite {
  double radius, inclination, node, argument;
  std::array<double, 3> moments;
  std::array<double, 4> q;
  std::array<double, 3> g;
  std::vector<Plate> plates;
  double stop, spin;
};

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  double operator()(double from, double to) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return from + (to - from) * (static_cast<double>(state_ >> 11) * 0x1p-53);
  }
  template <std::size_t N>
  std::array<double, N> direction() {
    std::array<double, N> v{};
    double square = 0.0;
    for (double& x : v) x = (*this)(-1.0, 1.0), square += x * x;
    for (double& x : v) x /= std::sqrt(square);
    return v;
  }

 private:
  std::uint64_t state_;
};

Satellite satellite(int k) {
  Draws draw(20261128U + 977U * static_cast<unsigned>(k));
  for (int i = 0; i < 5; ++i) draw(0.0, 1.0);
  Satellite s{};
  s.radius = earth + draw(3e5, 1.5e6);
  s.inclination = draw(0.0, 1.2);
  s.node = draw(0.0, 6.28);
  s.argument = draw(0.0, 6.28);
  auto& I = s.moments;
  I[0] = draw(300.0, 600.0);
  I[1] = I[0] + draw(50.0, 350.0);
  I[2] = I[1] + draw(20.0, 20.0 + 0.8 * (I[0] - 50.0));
  s.q = draw.direction<4>();
  s.spin = std::pow(10.0, -5.0 + 5.0 * k / 11.0);
  s.g = draw.direction<3>();
  for (std::size_t i = 0; i < 3; ++i) s.g[i] *= I[i] * s.spin;
  for (int i = 0; i < 2; ++i) {
    Plate plate{};
    for (double& x : plate.centre) x = draw(-3.0, 3.0);
    plate.normal = draw.direction<3>();
    plate.area = draw(2.0, 12.0);
    plate.specular = draw(0.0, 0.4);
    plate.diffuse = draw(0.0, 0.3);
    s.plates.push_back(plate);
  }
  const double orbits = s.spin > 0.2 ? 1.0 : 10.0;  // the reference takes steps of 0.2 rad
  s.stop = orbits * 2.0 * std::numbers::pi * std::sqrt(s.radius * s.radius * s.radius / gm);
  return s;
}

// --- the integration of its own ---

using Real = long double;
using State = std::array<Real, 7>;
struct Vector {
  Real x, y, z;
};
Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator*(Real k, Vector a) { return {k * a.x, k * a.y, k * a.z}; }
Real dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Three>
Vector vector(const Three& v) {
  return {v[0], v[1], v[2]};
}

enum class Light { full, penumbra, none };

class Reference {
 public:
  explicit Reference(const Satellite& s)
      : s_(s), rate_(std::sqrt(Real(gm) / (Real(s.radius) * s.radius * s.radius))) {}

  State end() {
    State y{};
    for (std::size_t i = 0; i < 4; ++i) y[i] = s_.q[i];
    for (std::size_t i = 0; i < 3; ++i) y[4 + i] = s_.g[i];
    for (std::size_t i = 0; i < s_.plates.size(); ++i)
      sides_.push_back(cosine(0, y, i) < 0 ? -1 : 1);
    Real t = 0;
    for (const Real next : contacts()) {
      const Real middle = (t + next) / 2;
      light_ = beyond(middle, 1) > 0    ? Light::full
               : beyond(middle, -1) > 0 ? Light::penumbra
                                        : Light::none;
      const int pieces = light_ == Light::penumbra ? 1 : static_cast<int>((next - t) / 600) + 1;
      length_ = (next - t) / pieces;
      for (int i = 0; i < pieces; ++i) {
        begin_ = t + i * length_;
        go(y);
      }
      t = next;
    }
    return y;
  }

 private:
  struct Sky {
    Vector to_sun;
    Real distance, sun, planet, apart;  // angles
  };
  static Vector circle(Real radius, Real inclination, Real node, Real u) {
    const Real x = std::cos(u), y = std::sin(u) * std::cos(inclination);
    return radius * Vector{x * std::cos(node) - y * std::sin(node),
                           x * std::sin(node) + y * std::cos(node),
                           std::sin(u) * std::sin(inclination)};
  }
  Sky sky(Real t) const {
    const Real sun_rate = std::sqrt(Real(gm_sun) / (Real(far) * far * far));
    const Vector body = circle(s_.radius, s_.inclination, s_.node, s_.argument + rate_ * t);
    const Vector to_sun = circle(far, sun_inclination, 0, sun_rate * t) + Real(-1) * body;
    const Real r = std::sqrt(dot(to_sun, to_sun)), away = std::sqrt(dot(body, body));
    const Vector e = (1 / r) * to_sun, across = cross(e, body);
    return {e, r, std::asin(sun_radius / r), std::asin(earth / away),
            std::atan2(std::sqrt(dot(across, across)), -dot(e, body))};
  }
  // How far the discs are from touching outside (1) or inside (-1).
  Real beyond(Real t, int side) const {
    const Sky at = sky(t);
    return at.apart - (at.planet + side * at.sun);
  }
  std::vector<Real> contacts() const {
    std::vector<Real> found;
    for (const int side : {1, -1})
      for (Real t = 0; t < s_.stop; t += 2) {
        Real a = t, b = std::min(t + 2, Real(s_.stop));
        const Real first = beyond(a, side);
        if (first * beyond(b, side) > 0) continue;
        for (int trip = 0; trip < 70; ++trip) {
          const Real m = (a + b) / 2;
          (beyond(m, side) * first > 0 ? a : b) = m;
        }
        found.push_back((a + b) / 2);
      }
    std::sort(found.begin(), found.end());
    found.push_back(s_.stop);
    return found;
  }
  static Real visible(const Sky& at) {
    const Real a = at.sun, b = at.planet, c = at.apart;
    if (c >= a + b) return 1;
    if (c <= b - a) return 0;
    const Real x = (c * c + a * a - b * b) / (2 * c),
               y = std::sqrt(std::max(a * a - x * x, Real(0)));
    const Real covered = a * a * std::atan2(y, x) + b * b * std::atan2(y, c - x) - c * y;
    return 1 - covered / (std::numbers::pi_v<Real> * a * a);
  }
  static Vector in_body(const State& y, Vector e) {
    const Real w = y[0], norm = w * w + y[1] * y[1] + y[2] * y[2] + y[3] * y[3];
    const Vector u{y[1], y[2], y[3]};
    return (1 / norm) * ((w * w - dot(u, u)) * e + (2 * dot(u, e)) * u + (2 * w) * cross(e, u));
  }
  Real cosine(Real t, const State& y, std::size_t i) const {
    return dot(vector(s_.plates[i].normal), in_body(y, sky(t).to_sun));
  }
  State rates(Real t, const State& y) const {
    const Vector g{y[4], y[5], y[6]};
    const Vector w{g.x / s_.moments[0], g.y / s_.moments[1], g.z / s_.moments[2]};
    Vector torque = cross(g, w);
    if (light_ != Light::none) {
      const Sky at = sky(t);
      const Vector e = in_body(y, at.to_sun);
      const Real pressure = (light_ == Light::full ? 1 : visible(at)) * light *
                            (far / at.distance) * (far / at.distance);
      for (std::size_t i = 0; i < s_.plates.size(); ++i) {
        const Plate& plate = s_.plates[i];
        const Vector n = Real(sides_[i]) * vector(plate.normal);
        const Real c = dot(n, e);
        const Vector force = (-pressure * plate.area * c) *
                             ((1 - Real(plate.specular)) * e +
                              (2 * Real(plate.specular) * c + Real(2) / 3 * plate.diffuse) * n);
        torque = torque + cross(vector(plate.centre), force);
      }
    }
    const Real half = 0.5L;
    return {half * (-y[1] * w.x - y[2] * w.y - y[3] * w.z),
            half * (y[0] * w.x + y[2] * w.z - y[3] * w.y),
            half * (y[0] * w.y + y[3] * w.x - y[1] * w.z),
            half * (y[0] * w.z + y[1] * w.y - y[2] * w.x),
            torque.x,
            torque.y,
            torque.z};
  }
  // Of a stretch, x from 0 to 1: in a penumbra powers 3/2 of the time at both ends are smooth in x.
  Real time(Real x) const {
    return begin_ + length_ * (light_ == Light::penumbra ? x * x * (3 - 2 * x) : x);
  }
  State field(Real x, const State& y) const {
    State f = rates(time(x), y);
    for (Real& one : f) one *= light_ == Light::penumbra ? 6 * length_ * x * (1 - x) : length_;
    return f;
  }
  // Gragg's extrapolation with 2, 4, ... 18 midpoint steps.
  State step(Real x, const State& y, Real h, Real& error) const {
    constexpr std::size_t columns = 9;
    std::array<std::array<State, columns>, columns> table;
    const State first = field(x, y);
    for (std::size_t k = 0; k < columns; ++k) {
      const int n = 2 * (static_cast<int>(k) + 1);
      const Real part = h / n;
      State a = y, b = y;
      for (std::size_t j = 0; j < 7; ++j) b[j] += part * first[j];
      for (int i = 1; i <= n; ++i) {
        const State f = field(i == n ? x + h : x + i * part, b);
        if (i == n)
          for (std::size_t j = 0; j < 7; ++j) table[k][0][j] = (a[j] + b[j] + part * f[j]) / 2;
        else
          for (std::size_t j = 0; j < 7; ++j) a[j] = std::exchange(b[j], a[j] + 2 * part * f[j]);
      }
      for (std::size_t m = 1; m <= k; ++m) {
        const Real ratio = Real(k + 1) / Real(k + 1 - m), weight = 1 / (ratio * ratio - 1);
        for (std::size_t j = 0; j < 7; ++j)
          table[k][m][j] =
              table[k][m - 1][j] + weight * (table[k][m - 1][j] - table[k - 1][m - 1][j]);
      }
    }
    const State &end = table[columns - 1][columns - 1], &before = table[columns - 1][columns - 2];
    const Real momentum = std::sqrt(y[4] * y[4] + y[5] * y[5] + y[6] * y[6]);
    error = 0;
    for (std::size_t j = 0; j < 7; ++j)
      error = std::max(error, std::abs(end[j] - before[j]) / (j < 4 ? 1 : momentum));
    return end;
  }
  // Where in a step plate i turns edge-on first: at one of some places of the step, then halved. 2:
  // it does not.
  Real edge_on(Real x, const State& y, Real h, const State& end, std::size_t i) const {
    // a step turns by 0.3 rad at most
    if (sides_[i] * (cosine(time(x), y, i) + cosine(time(x + h), end, i)) > 0.31L) return 2;
    Real error = 0, a = 0, b = 0;
    const auto lit = [&](Real way) {
      return sides_[i] * cosine(time(x + way), step(x, y, way, error), i) >= 0;
    };
    constexpr int places = 8;
    int k = 1;
    for (; k <= places; ++k)
      if (b = h * k / places; !lit(b)) break;
    if (k > places) return 2;
    for (int trip = 0; trip < 64; ++trip) {
      const Real m = (a + b) / 2;
      (lit(m) ? a : b) = m;
    }
    return b;
  }
  void go(State& y) {
    Real x = 0, h = 0.1L, error = 0;
    while (1 - x > 1e-18L) {
      const Real turning = std::sqrt(y[4] * y[4] + y[5] * y[5] + y[6] * y[6]) / s_.moments[0];
      h = std::min({h, 1 - x, 0.3L / (turning * length_ * 1.5L), 0.2L});
      State next = step(x, y, h, error);
      if (error > 4e-18L && h > 1e-12L) {
        h *= 0.6L;
        continue;
      }
      Real first = 2;
      std::size_t which = 0;
      for (std::size_t i = 0; i < s_.plates.size(); ++i)
        if (const Real at = edge_on(x, y, h, next, i); at < first) first = at, which = i;
      if (first < 2) {
        y = step(x, y, first, error);
        x += first;
        sides_[which] = -sides_[which];
        continue;
      }
      y = next;
      x += h;
      if (error < 1e-18L) h *= error < 1e-20L ? 1.5L : 1.1L;
    }
  }

  Satellite s_;
  Real rate_;
  Light light_ = Light::full;
  std::vector<int> sides_;
  Real begin_ = 0, length_ = 0;
};

// --- polhode ---

polhode::System system_of(const Satellite& s) {
  using namespace polhode;
  std::vector<SurfaceFacet> facets;
  for (const Plate& p : s.plates) {
    Finish finish;
    finish.specular = p.specular;
    finish.diffuse = p.diffuse;
    const Surface plate =
        Surface::of_plate({p.centre[0], p.centre[1], p.centre[2]},
                          {p.normal[0], p.normal[1], p.normal[2]}, p.area, finish, true);
    facets.insert(facets.end(), plate.facets().begin(), plate.facets().end());
  }
  const AnyOrbit orbit("orbit",
                       KeplerOrbit({gm, s.radius, 0.0, s.inclination, s.node, s.argument}));
  const AnyOrbit sun("sun", KeplerOrbit({gm_sun, far, 0.0, sun_inclination}));
  return System(Body(s.moments[0], s.moments[1], s.moments[2]), Frame::inertial(),
                {{"sunlight", SolarPressure(Surface(facets), {light, far}, {orbit}, {sun},
                                            Shadow::cone(earth, sun_radius))}});
}

void measure(const Satellite& s, const State& exact, const polhode::Method& method) {
  using namespace polhode;
  const RotorState start{{s.q[0], s.q[1], s.q[2], s.q[3]}, {s.g[0], s.g[1], s.g[2]}};
  const Trajectory run = integrate({system_of(s), start, 0.0, s.stop, method},
                                   {.samples = SaveAt::times({s.stop}), .dense = false});
  const Quaternion q{double(exact[0]), double(exact[1]), double(exact[2]), double(exact[3])};
  const Quaternion off = conj(normalized(q)) * run.samples().back().s.q;
  std::printf(" %.1e, %lld |", 2.0 * std::hypot(off.x, off.y, off.z),
              static_cast<long long>(run.statistics().steps));
}

}  // namespace

// From case number ARGUMENT on.
int main(int count, char** arguments) {
  for (int k = count > 1 ? std::atoi(arguments[1]) : 0; k < 12; ++k) {
    const Satellite s = satellite(k);
    const State exact = Reference(s).end();
    std::printf("| %.1e | %.1e |", s.spin, s.spin * s.stop);
    for (const double tolerance : {1e-9, 1e-12, 1e-14})
      measure(s, exact, polhode::Collocation{.tolerance = tolerance});
    measure(s, exact, polhode::Adaptive{.tolerance = 1e-12});
    std::printf("\n");
    std::fflush(stdout);
  }
}
