// SPDX-License-Identifier: MIT
// What the checks of the paper share: 50-digit numbers, vectors, elementary rotations, derivatives,
// quadrature, and seeded random states. Nothing here uses the library, so that the paper's
// equations are judged by definitions alone: passive rotation matrices, the rate of turn of the
// body axes, momentum as the derivative of the kinetic energy by a rate.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "worst.hpp"

namespace polhode::paper {

using Mp = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                         boost::multiprecision::et_off>;
using Vec = std::array<Mp, 3>;
using Mat = std::array<Vec, 3>;   // rows
using Phase = std::array<Mp, 6>;  // three coordinates, then their momenta
using Curve = std::function<Mp(const Mp&)>;
using Field = std::function<Mp(const Phase&)>;

// Elementary functions, compiled once in support.cpp; s and c are the paper's s_x = sin x and
// c_x = cos x.
Mp s(const Mp& x);
Mp c(const Mp& x);
Mp root(const Mp& x);
Mp arctan(const Mp& x);
Mp angle(const Mp& y, const Mp& x);  // atan2
Mp magnitude(const Mp& x);           // |x|
Mp squared(const Mp& x);
const Mp& pi();
Mp turned(const Mp& a);  // a brought to [-pi, pi]

Vec operator+(const Vec& a, const Vec& b);
Vec operator-(const Vec& a, const Vec& b);
Vec operator*(const Mp& k, const Vec& a);
Vec operator*(const Mat& m, const Vec& v);
Mat operator*(const Mat& a, const Mat& b);
Mp dot(const Vec& a, const Vec& b);
Vec cross(const Vec& a, const Vec& b);
Mp length(const Vec& a);
Mat transposed(const Mat& m);
Mat hat(const Vec& w);
// Componentwise: with the moments of inertia I g = I omega is scaled(I, omega).
Vec scaled(const Vec& moments, const Vec& w);
Vec unscaled(const Vec& moments, const Vec& g);

// Passive elementary rotations: the components of a fixed vector in axes turned by a.
Mat R1(const Mp& a);
Mat R3(const Mp& a);
Mat euler_matrix(const Vec& q);  // R3(psi) R1(theta) R3(phi), inertial to body components
Mat andoyer_matrix(const Mp& l, const Mp& J, const Mp& g, const Mp& I, const Mp& h);
Vec euler_angles(const Mat& R);  // phi, theta, psi of a matrix
// Inertial angular velocity at parameter 0 of a moving set of body axes (the rows of R), from the
// rates of turn of the three axes.
Vec inertial_rate(const std::function<Mat(const Mp&)>& R);
// Body angular velocity of Euler angles q moving at the given rates.
Vec body_rate(const Vec& q, const Vec& rates);
// Momenta conjugate to the Euler angles: derivatives of T by the rates, for body momentum g.
Vec euler_momenta(const Vec& q, const Vec& g);

Mp kinetic(const Vec& moments, const Vec& g);

// Central differences; the error is about 1e-32 of the third derivative.
Mp derivative(const Curve& f, const Mp& x);
Phase gradient(const Field& f, const Phase& x);
// Rows are the gradients of the six components.
std::array<Phase, 6> jacobian(const std::function<Phase(const Phase&)>& f, const Phase& x);
// (f, h) = sum over pairs of f_q h_p - f_p h_q
Mp bracket(const Phase& df, const Phase& dh);
Mp bracket(const Field& f, const Field& h, const Phase& x);
// Largest entry of M J M^T - J for the 6x6 Jacobian with the given rows.
double symplectic_defect(const std::array<Phase, 6>& rows);

// Integral of a smooth function from a to b by Gauss-Legendre panels.
Mp integral(const Curve& f, const Mp& a, const Mp& b);
// Legendre's integrals in the paper's notation, by quadrature of their definition: modulus k, and
// Pi with 1 + n sin^2.
Mp ellint_F(const Mp& z, const Mp& k);
Mp ellint_Pi(const Mp& z, const Mp& n, const Mp& k);
Mp ellint_K(const Mp& k);

struct Jacobi {
  Mp am, sn, cn, dn;
};
Jacobi jacobi(const Mp& u, const Mp& k);  // by the descending Landen transformation

// Largest difference seen between two sides of an equation.
class Gap {
 public:
  void add(const Mp& a, const Mp& b);
  void add(const Vec& a, const Vec& b);
  void add(const Mat& a, const Mat& b);
  double size() const { return size_.value(); }

 private:
  test::Worst<> size_;
};

// Seeded random numbers that are exact doubles, so that the library can be given the same input.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double number(double low, double high);
  Vec moments();  // I1 < I2 < I3 < I1 + I2, apart by 8 percent or more
 private:
  std::mt19937_64 engine_;
};

// A moving triaxial body in Euler's angles.
struct EulerCase {
  Vec I, q, rates;         // moments; phi, theta, psi; their rates
  Mat R;                   // inertial to body
  Vec omega, Omega, g, G;  // angular velocity and momentum: body, inertial components
  Vec p;                   // Phi, Theta, Psi
};
const std::vector<EulerCase>& euler_cases();

// A free triaxial body in Andoyer's variables.
struct AndoyerCase {
  Vec I;
  Phase a;         // l, g, h, L, G, H
  Mp J, incl;      // cos J = L/G, cos incl = H/G
  Mat R;           // five rotations
  Vec g_B, G_vec;  // body momentum, inertial momentum
  Vec q, p;        // Euler angles and momenta of the same state
};
AndoyerCase andoyer_case(const Vec& moments, const Phase& a);
const std::vector<AndoyerCase>& andoyer_cases();
// Cases of one mode: long_axis false or true, and sign of L (short-axis mode) or g1 (long-axis).
std::vector<AndoyerCase> andoyer_cases(bool long_axis, int sign, int count);
// The four branches together: each mode with each sign.
std::vector<AndoyerCase> branches(int each);

// A direction in Andoyer's six variables, the state met along it, and rates of change there.
Phase direction(Random& random);
AndoyerCase moved(const AndoyerCase& e, const Phase& d, const Mp& t);
Mp rate(const AndoyerCase& e, const Phase& d, const std::function<Mp(const AndoyerCase&)>& f);

// From Euler variables (phi, theta, psi, Phi, Theta, Psi): the body momentum, and Andoyer's
// (l, g, h, L, G, H) with g measured between the two nodes.
Vec euler_body_momentum(const Phase& x);
Phase andoyer_of_euler(const Phase& x);
// Energy as a function of Andoyer's and of Euler's variables.
Mp andoyer_energy(const Vec& moments, const Phase& a);
Mp euler_energy(const Vec& moments, const Phase& x);

// The closed curve of the body momentum through a state, by its amplitude xi:
//   short-axis mode  (A1 cos xi, sign A2 sin xi, sign A3 Delta),  sign = sign of L,
//   long-axis mode   (sign A1 Delta, sign A2 sin xi, A3 cos xi),  sign = sign of g1,
// with Delta = sqrt(1 - k^2 sin^2 xi) and dxi/dt = n Delta.
struct Polhode {
  bool long_axis;
  Mp sign;
  Mp G, T, k, n;
  Mp kappa, lambda;  // Sadov's
  Vec amplitude;
  Mp xi;  // of the state
};
Polhode polhode(const Vec& moments, const Phase& andoyer);
Vec momentum_at(const Polhode& p, const Mp& xi);
// int cosJ dl along it, without any elliptic formula.
Mp tilt_integral(const Polhode& p, const Mp& from, const Mp& to);

}  // namespace polhode::paper
