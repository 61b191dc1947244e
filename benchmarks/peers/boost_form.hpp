// SPDX-License-Identifier: MIT
// Boost.Math's elliptic functions for textbook.hpp: functions of the modulus k.
#pragma once

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

namespace peers {

template <class T, class Policy>
struct BoostFunctions {
  using Real = T;
  T k{}, n{}, K{}, Pi{};

  BoostFunctions() = default;
  BoostFunctions(const T& m, const T& /*m1*/, const T& characteristic)
      : k(root(m)),
        n(characteristic),
        K(boost::math::ellint_1(k, Policy())),
        Pi(boost::math::ellint_3(k, n, Policy())) {}
  T incomplete_f(const T& phi) const { return boost::math::ellint_1(k, phi, Policy()); }
  T incomplete_pi(const T& sn, const T& cn, const T& /*dn*/) const {
    using std::atan2;
    return boost::math::ellint_3(k, n, T(atan2(sn, cn)), Policy());
  }
  T jacobi(const T& u, T& cn, T& dn) const {
    return boost::math::jacobi_elliptic(k, u, &cn, &dn, Policy());
  }

 private:
  static T root(const T& m) {
    using std::sqrt;
    return sqrt(m);
  }
};

}  // namespace peers
