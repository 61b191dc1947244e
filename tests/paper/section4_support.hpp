// SPDX-License-Identifier: MIT
// Perturbations and moving frames for the tests of section 4: each as the library takes it and as
// 50-digit functions of Euler's variables, from which Hamilton's equations follow by differences.
#pragma once

#include <string>
#include <vector>

#include "paper/library.hpp"
#include "paper/support.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "polhode/system/system.hpp"

namespace polhode::paper {

// H' that depends on the momentum in every way: linear, quadratic, cubic and as a root, with
// components along body axes and along reference axes, and on time.
struct MixedEnergy {
  std::array<double, 8> a;

  template <class T>
  T operator()(const T& t, const BasicRotorState<T>& s) const {
    using std::sqrt;
    const BasicVec3<T>& g = s.g;
    const BasicVec3<T> G = rotate(s.q, g);  // in S
    const BasicVec3<T> b = rotate(s.q, BasicVec3<T>{T(0.6), T(0.0), T(0.8)});
    const T linear = T(a[0]) * g.x + T(a[1]) * G.y + T(a[2]) * t * G.z;
    const T products = T(a[3]) * g.x * G.x + T(a[4]) * g.y * g.z * b.x;
    const T cubic = T(a[5]) * G.x * g.z * G.y;
    const T root = T(a[6]) * sqrt(T(T(1.0) + g.x * g.x + G.z * G.z)) * b.y;
    return linear + products + cubic + root + T(a[7]) * b.z * b.z;
  }
};

// H' = quadratic in the momentum alone, as an elastic body has it.
struct QuadraticEnergy {
  std::array<double, 6> a;

  template <class T>
  T operator()(const T&, const BasicRotorState<T>& s) const {
    const BasicVec3<T>& g = s.g;
    return T(a[0]) * g.x * g.x + T(a[1]) * g.y * g.y + T(a[2]) * g.z * g.z + T(a[3]) * g.x * g.y +
           T(a[4]) * g.y * g.z + T(a[5]) * g.z * g.x;
  }
};

// A frame as the library takes it, and its passive matrix (inertial to S components) by definition.
struct MovingFrame {
  std::string name;
  Frame frame;
  std::function<Mat(const Mp&)> matrix;

  Vec mu_S(const Mp& t) const {
    const auto here = [this, &t](const Mp& x) { return matrix(t + x); };
    return matrix(t) * inertial_rate(here);
  }
};

inline std::vector<MovingFrame> moving_frames() {
  const double rate = 0.3, node0 = 0.4, incl = 0.5, swing = 0.2;
  const auto Omega = [=](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    return T(T(node0) + T(rate) * t - T(0.125) * t * t);
  };
  const auto tilt = [=](const auto& t) {
    using std::sin;
    using T = std::decay_t<decltype(t)>;
    return T(T(incl) + T(swing) * sin(t));
  };
  // about z, then x, then z: an axis that is none of the three
  const Mp lean("0.7"), turn("-1.1");
  const Mat to_axis = R1(lean) * R3(turn);
  const Vec& axis = to_axis[2];
  const Vec3 n{static_cast<double>(axis[0]), static_cast<double>(axis[1]),
               static_cast<double>(axis[2])};
  return {
      {"inertial", Frame::inertial(), [](const Mp&) { return R3(Mp(0)); }},
      {"precessing", Frame::precessing(n, rate, 0.25),
       [=](const Mp& t) { return transposed(to_axis) * R3(Mp(rate) * (t - Mp(0.25))) * to_axis; }},
      {"orbit plane", Frame::orbit_plane(Omega, tilt), [=](const Mp& t) {
         return R1(Mp(incl) + Mp(swing) * s(t)) * R3(Mp(node0) + Mp(rate) * t - Mp(0.125) * t * t);
       }}};
}

// The hub state of Euler's variables.
inline BasicRotorState<Mp> wide_state(const Phase& x) {
  const Mp a = x[0] / 2, b = x[1] / 2, d = x[2] / 2;
  const Vec g = euler_body_momentum(x);
  return {{c(b) * c(a + d), s(b) * c(a - d), s(b) * s(a - d), c(b) * s(a + d)}, {g[0], g[1], g[2]}};
}

// A system, twice.
struct PerturbedCase {
  Vec I;
  MovingFrame frame;
  MixedEnergy mixed;
  QuadraticEnergy quadratic;
  double t;
  RotorState s;

  System system() const {
    return System(body_of(I), frame.frame,
                  {AnyPerturbation("mixed", HamiltonianTerm(mixed)),
                   AnyPerturbation("quadratic", HamiltonianTerm(quadratic))});
  }
  Phase euler() const { return exact_euler(s); }
  // What perturbs: -mu . g and the terms, by Euler's variables.
  Mp delta_H(const Phase& x) const {
    const Vec g_S = transposed(euler_matrix({x[0], x[1], x[2]})) * euler_body_momentum(x);
    const BasicRotorState<Mp> w = wide_state(x);
    return mixed(Mp(t), w) + quadratic(Mp(t), w) - dot(mu_S, g_S);
  }
  Mp H(const Phase& x) const { return euler_energy(I, x) + delta_H(x); }
  // Hamilton's equations [SA (101)]
  Phase euler_rates() const {
    const Phase d = gradient([this](const Phase& x) { return H(x); }, euler());
    return {d[3], d[4], d[5], -d[0], -d[1], -d[2]};
  }

  Vec mu_S;
};

// Phase x moved by h along its rates.
inline Phase moved(const Phase& x, const Phase& rates, const Mp& h) {
  Phase y;
  for (std::size_t i = 0; i < 6; ++i) y[i] = x[i] + h * rates[i];
  return y;
}

inline std::vector<PerturbedCase> perturbed_cases(std::uint64_t seed, int of_each) {
  Random random(seed);
  std::vector<PerturbedCase> all;
  for (const MovingFrame& f : moving_frames()) {
    for (const RotorState& s : hub_states(seed + all.size(), of_each)) {
      PerturbedCase e{random.moments(), f, {}, {}, random.number(-1, 1), s, {}};
      for (double& x : e.mixed.a) x = random.number(-0.5, 0.5);
      for (double& x : e.quadratic.a) x = random.number(-0.1, 0.1);
      e.s.q = normalized(s.q);
      e.mu_S = f.mu_S(Mp(e.t));
      all.push_back(e);
    }
  }
  return all;
}

}  // namespace polhode::paper
