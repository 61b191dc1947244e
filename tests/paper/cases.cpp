// SPDX-License-Identifier: MIT
#include <cstddef>

#include "paper/support.hpp"

namespace polhode::paper {
namespace {

EulerCase euler_case(Random& random) {
  EulerCase e;
  e.I = random.moments();
  e.q = {Mp(random.number(-3.1, 3.1)), Mp(random.number(0.3, 2.8)), Mp(random.number(-3.1, 3.1))};
  e.rates = {Mp(random.number(-2, 2)), Mp(random.number(-2, 2)), Mp(random.number(-2, 2))};
  e.R = euler_matrix(e.q);
  e.omega = body_rate(e.q, e.rates);
  e.Omega = transposed(e.R) * e.omega;
  e.g = scaled(e.I, e.omega);
  e.G = transposed(e.R) * e.g;
  e.p = euler_momenta(e.q, e.g);
  return e;
}

Phase random_andoyer(Random& random) {
  const Mp G = random.number(0.6, 1.9);
  return {Mp(random.number(-3.1, 3.1)),
          Mp(random.number(-3.1, 3.1)),
          Mp(random.number(-3.1, 3.1)),
          random.number(-0.93, 0.93) * G,
          G,
          random.number(-0.93, 0.93) * G};
}

}  // namespace

const std::vector<EulerCase>& euler_cases() {
  static const std::vector<EulerCase> cases = [] {
    Random random(1866);
    std::vector<EulerCase> all;
    all.reserve(12);
    for (int i = 0; i < 12; ++i) all.push_back(euler_case(random));
    return all;
  }();
  return cases;
}

AndoyerCase andoyer_case(const Vec& moments, const Phase& a) {
  AndoyerCase e;
  e.I = moments;
  e.a = a;
  const Mp &L = a[3], &G = a[4], &H = a[5];
  e.J = angle(root(G * G - L * L), L);
  e.incl = angle(root(G * G - H * H), H);
  e.R = andoyer_matrix(a[0], e.J, a[1], e.incl, a[2]);
  // The momentum is the third axis of the frame after the first two turns.
  e.G_vec = transposed(R1(e.incl) * R3(a[2])) * Vec{Mp(0), Mp(0), G};
  e.g_B = e.R * e.G_vec;
  e.q = euler_angles(e.R);
  e.p = euler_momenta(e.q, e.g_B);
  return e;
}

const std::vector<AndoyerCase>& andoyer_cases() {
  static const std::vector<AndoyerCase> cases = [] {
    Random random(1923);
    std::vector<AndoyerCase> all;
    while (all.size() < 12) {
      const Vec moments = random.moments();  // drawn first, whatever the compiler
      const AndoyerCase e = andoyer_case(moments, random_andoyer(random));
      if (s(e.q[1]) > Mp("0.2")) all.push_back(e);
    }
    return all;
  }();
  return cases;
}

std::vector<AndoyerCase> andoyer_cases(bool long_axis, int sign, int count) {
  Random random(long_axis ? 1970 : 1972);
  std::vector<AndoyerCase> all;
  while (all.size() < static_cast<std::size_t>(count)) {
    const Vec moments = random.moments();  // drawn first, whatever the compiler
    const AndoyerCase e = andoyer_case(moments, random_andoyer(random));
    const Mp G2 = e.a[4] * e.a[4], T = kinetic(e.I, e.g_B);
    const Mp side = (G2 - 2 * T * e.I[1]) / G2;  // > 0 in the short-axis mode
    const Mp lead = long_axis ? e.g_B[0] : e.g_B[2];
    const bool near_end = magnitude(e.g_B[1]) < e.a[4] / 20;
    if (magnitude(side) < Mp("0.02") || near_end || s(e.q[1]) < Mp("0.2")) continue;
    if ((side < 0) == long_axis && (lead > 0) == (sign > 0)) all.push_back(e);
  }
  return all;
}

std::vector<AndoyerCase> branches(int each) {
  std::vector<AndoyerCase> all;
  for (const bool long_axis : {false, true})
    for (const int sign : {1, -1})
      for (const AndoyerCase& e : andoyer_cases(long_axis, sign, each)) all.push_back(e);
  return all;
}

Phase direction(Random& random) {
  Phase d;
  for (Mp& x : d) x = random.number(-0.4, 0.4);
  return d;
}

AndoyerCase moved(const AndoyerCase& e, const Phase& d, const Mp& t) {
  Phase a = e.a;
  for (std::size_t i = 0; i < 6; ++i) a[i] += t * d[i];
  return andoyer_case(e.I, a);
}

Mp rate(const AndoyerCase& e, const Phase& d, const std::function<Mp(const AndoyerCase&)>& f) {
  return derivative([&](const Mp& t) { return f(moved(e, d, t)); }, Mp(0));
}

Vec euler_body_momentum(const Phase& x) {
  const Vec q{x[0], x[1], x[2]}, p{x[3], x[4], x[5]};
  // The three momenta are the projections of g on the turning axes: solve for g by cofactors.
  const Vec a = euler_momenta(q, {Mp(1), Mp(0), Mp(0)});
  const Vec b = euler_momenta(q, {Mp(0), Mp(1), Mp(0)});
  const Vec d = euler_momenta(q, {Mp(0), Mp(0), Mp(1)});
  const Mp volume = dot(a, cross(b, d));
  return {dot(p, cross(b, d)) / volume, dot(a, cross(p, d)) / volume, dot(a, cross(b, p)) / volume};
}

Phase andoyer_of_euler(const Phase& x) {
  const Vec g = euler_body_momentum(x);
  const Mat R = euler_matrix({x[0], x[1], x[2]});
  const Vec G_vec = transposed(R) * g;
  const Mp G = length(g);
  const Vec node_i = cross({Mp(0), Mp(0), Mp(1)}, G_vec);
  const Vec node_j = cross(G_vec, R[2]);
  return {angle(g[0], g[1]),
          angle(dot(cross(node_i, node_j), G_vec) / G, dot(node_i, node_j)),
          angle(G_vec[0], -G_vec[1]),
          g[2],
          G,
          G_vec[2]};
}

Mp andoyer_energy(const Vec& moments, const Phase& a) {
  const Mp side2 = a[4] * a[4] - a[3] * a[3];
  const Mp sl = s(a[0]), cl = c(a[0]);
  return (sl * sl / moments[0] + cl * cl / moments[1]) * side2 / 2 + a[3] * a[3] / (2 * moments[2]);
}
Mp euler_energy(const Vec& moments, const Phase& x) {
  return kinetic(moments, euler_body_momentum(x));
}

Polhode polhode(const Vec& moments, const Phase& a) {
  const Mp &I1 = moments[0], &I2 = moments[1], &I3 = moments[2];
  Polhode p;
  p.G = a[4];
  p.T = andoyer_energy(moments, a);
  const Mp side = root(a[4] * a[4] - a[3] * a[3]);
  const Vec g{side * s(a[0]), side * c(a[0]), a[3]};
  const Mp D1 = p.G * p.G - 2 * p.T * I1, D3 = 2 * p.T * I3 - p.G * p.G;
  p.long_axis = p.G * p.G < 2 * p.T * I2;
  const Mp kappa2 = I3 * (I2 - I1) / (I1 * (I3 - I2));
  const Mp lambda2 = kappa2 * I1 * D3 / (I3 * D1);
  p.kappa = root(kappa2);
  p.lambda = root(lambda2);
  p.k = p.long_axis ? 1 / p.lambda : p.lambda;
  const Mp middle = p.long_axis ? I2 * D1 / (I2 - I1) : I2 * D3 / (I3 - I2);
  p.amplitude = {root(I1 * D3 / (I3 - I1)), root(middle), root(I3 * D1 / (I3 - I1))};
  p.n = root((p.long_axis ? (I2 - I1) * D3 : (I3 - I2) * D1) / (I1 * I2 * I3));
  p.sign = (p.long_axis ? g[0] : g[2]) < 0 ? -1 : 1;
  p.xi = angle(p.sign * g[1] / p.amplitude[1],
               p.long_axis ? g[2] / p.amplitude[2] : g[0] / p.amplitude[0]);
  return p;
}

Vec momentum_at(const Polhode& p, const Mp& xi) {
  const Mp sx = s(xi), Delta = root(1 - p.k * p.k * sx * sx);
  const Vec& A = p.amplitude;
  if (p.long_axis) return {p.sign * A[0] * Delta, p.sign * A[1] * sx, A[2] * c(xi)};
  return {A[0] * c(xi), p.sign * A[1] * sx, p.sign * A[2] * Delta};
}

Mp tilt_integral(const Polhode& p, const Mp& from, const Mp& to) {
  return integral(
      [&](const Mp& xi) {
        const Vec g = momentum_at(p, xi);
        const Vec& A = p.amplitude;
        const Mp sx = s(xi), cx = c(xi), fall = p.k * p.k * sx * cx;
        const Mp d1 = p.long_axis ? -A[0] * A[0] * fall / g[0] : -A[0] * sx;
        const Mp d2 = p.sign * A[1] * cx;
        return g[2] / p.G * (d1 * g[1] - g[0] * d2) / (g[0] * g[0] + g[1] * g[1]);
      },
      from, to);
}

}  // namespace polhode::paper
