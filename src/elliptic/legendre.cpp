// SPDX-License-Identifier: MIT
#include "polhode/elliptic/legendre.hpp"

namespace polhode {
inline namespace v0 {

template double legendre_f<double>(const double&, const double&, const BasicModulus<double>&);
template double legendre_f<double>(const double&, const BasicModulus<double>&);
template double legendre_e<double>(const double&, const double&, const BasicModulus<double>&);
template double legendre_e<double>(const double&, const BasicModulus<double>&);
template double legendre_d<double>(const double&, const double&, const BasicModulus<double>&);
template double legendre_d<double>(const double&, const BasicModulus<double>&);
template double legendre_b<double>(const double&, const double&, const BasicModulus<double>&);
template double legendre_b<double>(const double&, const BasicModulus<double>&);
template DoubleDouble legendre_f<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                               const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_f<DoubleDouble>(const DoubleDouble&,
                                               const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_e<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                               const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_e<DoubleDouble>(const DoubleDouble&,
                                               const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_d<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                               const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_d<DoubleDouble>(const DoubleDouble&,
                                               const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_b<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                               const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_b<DoubleDouble>(const DoubleDouble&,
                                               const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
