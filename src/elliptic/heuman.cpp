// SPDX-License-Identifier: MIT
#include "polhode/elliptic/heuman.hpp"

namespace polhode {
inline namespace v0 {

template double heuman_lambda0<double>(const double&, const double&, const BasicModulus<double>&);
template double heuman_lambda0<double>(const double&, const BasicModulus<double>&);
template DoubleDouble heuman_lambda0<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                   const BasicModulus<DoubleDouble>&);
template DoubleDouble heuman_lambda0<DoubleDouble>(const DoubleDouble&,
                                                   const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
