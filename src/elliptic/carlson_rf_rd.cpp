// SPDX-License-Identifier: MIT
#include "polhode/elliptic/carlson_rf_rd.hpp"

namespace polhode {
inline namespace v0 {

template double carlson_rf<double>(double, double, double);
template double carlson_rd<double>(double, double, double);
template DoubleDouble carlson_rf<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble);
template DoubleDouble carlson_rd<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble);

}  // namespace v0
}  // namespace polhode
