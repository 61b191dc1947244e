// SPDX-License-Identifier: MIT
#include "polhode/elliptic/agm.hpp"

namespace polhode {
inline namespace v0 {

template double agm<double>(double, double);
template double cel<double>(double, double, double, double);
template double complete_k<double>(const BasicModulus<double>&);
template double complete_e<double>(const BasicModulus<double>&);
template double complete_b<double>(const BasicModulus<double>&);
template double complete_d<double>(const BasicModulus<double>&);
template double complete_pi<double>(const double&, const BasicModulus<double>&);
template DoubleDouble agm<DoubleDouble>(DoubleDouble, DoubleDouble);
template DoubleDouble cel<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble, DoubleDouble);
template DoubleDouble complete_k<DoubleDouble>(const BasicModulus<DoubleDouble>&);
template DoubleDouble complete_e<DoubleDouble>(const BasicModulus<DoubleDouble>&);
template DoubleDouble complete_b<DoubleDouble>(const BasicModulus<DoubleDouble>&);
template DoubleDouble complete_d<DoubleDouble>(const BasicModulus<DoubleDouble>&);
template DoubleDouble complete_pi<DoubleDouble>(const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
