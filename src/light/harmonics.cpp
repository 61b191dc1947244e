// SPDX-License-Identifier: MIT
#include "light/harmonics.hpp"

#include <cmath>
#include <cstddef>

namespace polhode {
inline namespace v0 {

// P_lm / sin^m theta, normalised, by the recurrence in l; sin^m theta e^(i m phi) = (x + i y)^m.
std::vector<double> spherical_harmonics(int degree, const Vec3& n) {
  const auto size = static_cast<std::size_t>(degree) + 1;
  std::vector<double> Y(size * size);
  const auto place = [](int l, int m) {
    const int at = l * l + l + m;
    return static_cast<std::size_t>(at);
  };
  double re = 1.0, im = 0.0;  // (x + i y)^m
  double own = 1.0;           // of l = m
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) {
      const double before = re;
      re = before * n.x - im * n.y;
      im = before * n.y + im * n.x;
      // mean square 1: 2 from cos and sin at m = 1, (2m + 1) / (2m) from the degree
      own *= std::sqrt((m == 1 ? 2.0 : 1.0) * (2.0 * m + 1.0) / (2.0 * m));
    }
    double last = 0.0, P = own;
    for (int l = m; l <= degree; ++l) {
      Y[place(l, m)] = P * re;
      if (m > 0) Y[place(l, -m)] = P * im;
      const auto ratio = [m](double k) {  // of the norms of k - 1 and k, times k - m
        return std::sqrt((k * k - 1.0 * m * m) / (4.0 * k * k - 1.0));
      };
      const double next = (n.z * P - (l > m ? ratio(l) : 0.0) * last) / ratio(l + 1.0);
      last = P;
      P = next;
    }
  }
  return Y;
}

}  // namespace v0
}  // namespace polhode
