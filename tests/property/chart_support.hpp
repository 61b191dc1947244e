// SPDX-License-Identifier: MIT
// The canonical charts as one list, states near their singularities, and differences of states.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "polhode/math/double_double.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "worst.hpp"

namespace chart_test {

using namespace polhode;
using Numbers = std::array<double, 6>;
using polhode::test::larger;
using polhode::test::smaller;
using polhode::test::Worst;

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr std::array<Pole, 2> poles{Pole::zero, Pole::pi};

// A chart as six numbers: angles first. `angles` counts those that are modulo 2 pi.
struct Chart {
  std::string name;
  int angles;
  std::function<Numbers(const RotorState&)> from_hub;
  std::function<RotorState(const Numbers&)> to_hub;
  polhode::CanonicalChart id;
  std::function<Matrix6(const Numbers&)> own_jacobian;
  std::function<Vec3(const Numbers&)> own_momentum;  // g_B in double-double, rounded once
};

template <class T = double>
polhode::BasicEulerState<T> euler_of(const Numbers& n) {
  return {n[0], n[1], n[2], n[3], n[4], n[5]};
}
template <class T = double>
polhode::BasicAndoyerState<T> andoyer_of(const Numbers& n) {
  return {n[0], n[1], n[2], n[3], n[4], n[5]};
}
template <class T = double>
polhode::BasicPoincareState<T> poincare_of(const Numbers& n, Pole pole_J, Pole pole_I) {
  return {n[0], n[1], n[2], n[3], n[4], n[5], pole_J, pole_I};
}
inline Vec3 rounded_momentum(const polhode::BasicRotorState<polhode::DoubleDouble>& s) {
  return {s.g.x.hi, s.g.y.hi, s.g.z.hi};
}

inline Chart euler_chart() {
  return {"euler",
          3,
          [](const RotorState& s) {
            const auto e = to_euler(s);
            return Numbers{e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi};
          },
          [](const Numbers& n) { return to_rotor(euler_of(n)); },
          {CanonicalSet::euler},
          [](const Numbers& n) { return chart_jacobian(euler_of(n)); },
          [](const Numbers& n) { return rounded_momentum(to_rotor(euler_of<DoubleDouble>(n))); }};
}
inline Chart andoyer_chart() {
  return {"andoyer",
          3,
          [](const RotorState& s) {
            const auto a = to_andoyer(s);
            return Numbers{a.l, a.g, a.h, a.L, a.G, a.H};
          },
          [](const Numbers& n) { return to_rotor(andoyer_of(n)); },
          {CanonicalSet::andoyer},
          [](const Numbers& n) { return chart_jacobian(andoyer_of(n)); },
          [](const Numbers& n) { return rounded_momentum(to_rotor(andoyer_of<DoubleDouble>(n))); }};
}
inline Chart poincare_chart(Pole pole_J, Pole pole_I) {
  const auto text = [](Pole p) { return p == Pole::zero ? std::string("0") : std::string("pi"); };
  return {"poincare J" + text(pole_J) + " I" + text(pole_I),
          1,
          [=](const RotorState& s) {
            const auto p = to_poincare(s, pole_J, pole_I);
            return Numbers{p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2};
          },
          [=](const Numbers& n) { return to_rotor(poincare_of(n, pole_J, pole_I)); },
          {CanonicalSet::poincare, pole_J, pole_I},
          [=](const Numbers& n) { return chart_jacobian(poincare_of(n, pole_J, pole_I)); },
          [=](const Numbers& n) {
            return rounded_momentum(to_rotor(poincare_of<DoubleDouble>(n, pole_J, pole_I)));
          }};
}
inline std::vector<Chart> canonical_charts() {
  std::vector<Chart> charts{euler_chart(), andoyer_chart()};
  for (const Pole pole_J : poles)
    for (const Pole pole_I : poles) charts.push_back(poincare_chart(pole_J, pole_I));
  return charts;
}

// q = qz(h) qx(I) qz(g) qx(J) qz(l), |g| = G, from the inclinations themselves: J = 1e-150 or pi
// minus it (given as flip) are states like any other.
struct Inclined {
  double J;
  bool J_flip;
  double I;
  bool I_flip;
};
inline RotorState inclined_state(const Inclined& c, double l, double g, double h, double G = 1.0) {
  using polhode::rotation_x;
  using polhode::rotation_z;
  const auto tilt = [](double angle, bool flip) {
    const polhode::Quaternion q = rotation_x(flip ? -angle : angle);
    return flip ? polhode::Quaternion{0.0, 1.0, 0.0, 0.0} * q : q;
  };
  const double sJ = std::sin(c.J), cJ = std::cos(c.J);
  return {rotation_z(h) * tilt(c.I, c.I_flip) * rotation_z(g) * tilt(c.J, c.J_flip) * rotation_z(l),
          {G * sJ * std::sin(l), G * sJ * std::cos(l), c.J_flip ? -G * cJ : G * cJ}};
}

class Sampler {
 public:
  explicit Sampler(unsigned long seed) : engine_(seed) {}
  double uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  double angle() { return uniform(-3.141592653589793, 3.141592653589793); }
  bool coin() { return uniform(0.0, 1.0) < 0.5; }
  double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  RotorState generic(double G = 1.0) {
    std::normal_distribution<double> n;
    const Vec3 v{n(engine_), n(engine_), n(engine_)};
    const double size = norm(v);
    return {normalized(polhode::Quaternion{n(engine_), n(engine_), n(engine_), n(engine_)}),
            {G * v.x / size, G * v.y / size, G * v.z / size}};
  }
  // J and I each at least `closest` from 0 and pi, and often that close.
  RotorState near_andoyer_poles(double closest) {
    return inclined_state({log_uniform(closest, 1.5), coin(), log_uniform(closest, 1.5), coin()},
                          angle(), angle(), angle());
  }
  // theta at least `closest` from 0 and pi, and often that close.
  RotorState near_euler_poles(double closest) {
    const double theta = log_uniform(closest, 1.5), phi = angle(), psi = angle();
    const polhode::Quaternion tilt = polhode::rotation_x(theta);
    const polhode::Quaternion q =
        coin() ? tilt : polhode::Quaternion{0.0, 1.0, 0.0, 0.0} * conj(tilt);
    return {polhode::rotation_z(phi) * q * polhode::rotation_z(psi), generic().g};
  }

 private:
  std::mt19937_64 engine_;
};

// Rotation angle between two attitudes, rad.
inline double attitude_difference(const polhode::Quaternion& p, const polhode::Quaternion& q) {
  const polhode::Quaternion d = conj(normalized(p)) * normalized(q);
  return 2.0 * std::asin(smaller(1.0, norm(Vec3{d.x, d.y, d.z})));
}
// Larger of the attitude difference and the relative difference of the momenta.
inline double hub_difference(const RotorState& a, const RotorState& b) {
  const double size = norm(a.g);
  return larger(attitude_difference(a.q, b.q), norm(a.g - b.g) / (size > 0.0 ? size : 1.0));
}
inline double angle_difference(double a, double b) {
  return std::remainder(a - b, 2.0 * 3.141592653589793);
}
// Largest difference of the six numbers, the first `angles` of them modulo 2 pi.
inline double numbers_difference(const Numbers& a, const Numbers& b, int angles) {
  Worst worst;
  for (std::size_t i = 0; i < 6; ++i) {
    const double d = static_cast<int>(i) < angles ? angle_difference(a[i], b[i]) : a[i] - b[i];
    worst.add(std::abs(d));
  }
  return worst.value();
}
inline bool finite(const Numbers& n) {
  return std::all_of(n.begin(), n.end(), [](double x) { return std::isfinite(x); });
}
inline bool finite(const RotorState& s) {
  return finite(Numbers{s.q.w, s.q.x, s.q.y, s.q.z, 0.0, 0.0}) &&
         finite(Numbers{s.g.x, s.g.y, s.g.z, 0.0, 0.0, 0.0});
}
inline bool finite(const Matrix6& m) {
  return std::all_of(m.a.begin(), m.a.end(), [](const Numbers& row) { return finite(row); });
}

// max_i (|M| |S|)_i
inline double amplified(const Matrix6& m, const Numbers& size) {
  Worst worst;
  for (int i = 0; i < 6; ++i) {
    double sum = 0.0;
    for (int j = 0; j < 6; ++j)
      sum += std::abs(m(i, j)) * std::abs(size[static_cast<std::size_t>(j)]);
    worst.add(sum);
  }
  return worst.value();
}

inline Matrix6 canonical_tensor() {
  Matrix6 m;
  for (int i = 0; i < 3; ++i) {
    m(i, i + 3) = 1.0;
    m(i + 3, i) = -1.0;
  }
  return m;
}
// Pi(g) = [[0, 1], [-1, hat(g)]]
inline Matrix6 hub_tensor(const Vec3& g) {
  Matrix6 m = canonical_tensor();
  const polhode::Mat3 k = polhode::hat(g);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i + 3, j + 3) = k(i, j);
  return m;
}
inline Matrix6 magnitudes(Matrix6 m) {
  for (auto& row : m.a)
    for (double& x : row) x = std::abs(x);
  return m;
}
// Largest |M from M^T - to| in units of eps (|S| |from| |S^T|), entry by entry. S is M as another
// has it: an M that is wrong must not set its own scale.
inline double symplectic_defect(const Matrix6& m, const Matrix6& from, const Matrix6& to,
                                const Matrix6& s) {
  const Matrix6 image = m * from * transpose(m);
  const Matrix6 scale = magnitudes(s) * magnitudes(from) * magnitudes(transpose(s));
  Worst worst;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double d = std::abs(image(i, j) - to(i, j)) / eps;
      worst.add(d == 0.0 ? 0.0 : d / scale(i, j));
    }
  }
  return worst.value();
}
// Where M itself is compared elsewhere.
inline double symplectic_defect(const Matrix6& m, const Matrix6& from, const Matrix6& to) {
  return symplectic_defect(m, from, to, m);
}

}  // namespace chart_test
