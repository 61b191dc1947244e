// SPDX-License-Identifier: MIT
#include "polhode/elliptic/jacobi_zeta.hpp"

namespace polhode {
inline namespace v0 {

template double jacobi_zeta<double>(const double&, const double&, const BasicModulus<double>&);
template double jacobi_zeta<double>(const double&, const BasicModulus<double>&);
template DoubleDouble jacobi_zeta<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);
template DoubleDouble jacobi_zeta<DoubleDouble>(const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
