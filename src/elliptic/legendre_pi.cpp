// SPDX-License-Identifier: MIT
#include "polhode/elliptic/legendre_pi.hpp"

namespace polhode {
inline namespace v0 {

template double legendre_pi<double>(const double&, const double&, const double&,
                                    const BasicModulus<double>&);
template double legendre_pi<double>(const double&, const double&, const BasicModulus<double>&);
template DoubleDouble legendre_pi<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_pi<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
