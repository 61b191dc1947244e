// SPDX-License-Identifier: MIT
#include "polhode/elliptic/carlson.hpp"

namespace polhode {
inline namespace v0 {

template double carlson_rc<double>(const double&, const double&);
template double carlson_rj<double>(double, double, double, double);
template DoubleDouble carlson_rc<DoubleDouble>(const DoubleDouble&, const DoubleDouble&);
template DoubleDouble carlson_rj<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble,
                                               DoubleDouble);

}  // namespace v0
}  // namespace polhode
