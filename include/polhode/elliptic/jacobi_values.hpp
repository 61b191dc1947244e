// SPDX-License-Identifier: MIT
// Jacobi: the values of Jacobi's three elliptic functions at one argument.
//
// Equations   sn^2 + cn^2 = 1, dn^2 + m sn^2 = 1.
// Domain      any number type; of packs, one set of values per lane.
// Accuracy    that of the function that made it (jacobi.hpp).
// Cost        three numbers.
#pragma once

#include "polhode/math/real.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {

template <Number T>
struct Jacobi {
  T sn;
  T cn;
  T dn;

  // Of packs, lane by lane.
  friend Jacobi select(const Mask<T>& mask, const Jacobi& a, const Jacobi& b)
    requires(!Real<T>)
  {
    return {select(mask, a.sn, b.sn), select(mask, a.cn, b.cn), select(mask, a.dn, b.dn)};
  }
};

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
