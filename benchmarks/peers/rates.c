// SPDX-License-Identifier: MIT
// W1's right-hand side for REBOUND, which would otherwise call Python for every one: the eleven
// states of equations.py. Compiled by perturbed.py when a compiler is there.
#include <math.h>

static double A = 0.9, B = 1.0, C = 1.1;

void peers_moments(double a, double b, double c) {
  A = a;
  B = b;
  C = c;
}

void peers_rates(void* ode, double* d, const double* s, double t) {
  (void)ode;
  (void)t;
  const double w = s[0], x = s[1], y = s[2], z = s[3], p = s[4], q = s[5], r = s[6];
  const double X = s[7], Y = s[8];
  const double i2 = 1.0 / (X * X + Y * Y), i3 = i2 * sqrt(i2), k = 3.0 * i2 * i3;
  const double n1 = (1.0 - 2.0 * (y * y + z * z)) * X + 2.0 * (x * y + w * z) * Y;
  const double n2 = 2.0 * (x * y - w * z) * X + (1.0 - 2.0 * (x * x + z * z)) * Y;
  const double n3 = 2.0 * (x * z + w * y) * X + 2.0 * (y * z - w * x) * Y;
  d[0] = -0.5 * (x * p + y * q + z * r);
  d[1] = 0.5 * (w * p + y * r - z * q);
  d[2] = 0.5 * (w * q + z * p - x * r);
  d[3] = 0.5 * (w * r + x * q - y * p);
  d[4] = (B - C) / A * (q * r - k * n2 * n3);
  d[5] = (C - A) / B * (r * p - k * n3 * n1);
  d[6] = (A - B) / C * (p * q - k * n1 * n2);
  d[7] = s[9];
  d[8] = s[10];
  d[9] = -i3 * X;
  d[10] = -i3 * Y;
}
