// SPDX-License-Identifier: MIT
#include "polhode/elliptic/jacobi.hpp"

namespace polhode {
inline namespace v0 {

template Jacobi<double> jacobi<double>(const double&, const BasicModulus<double>&);
template double amplitude<double>(const double&, const BasicModulus<double>&);
template Jacobi<DoubleDouble> jacobi<DoubleDouble>(const DoubleDouble&,
                                                   const BasicModulus<DoubleDouble>&);
template DoubleDouble amplitude<DoubleDouble>(const DoubleDouble&,
                                              const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
