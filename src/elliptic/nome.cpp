// SPDX-License-Identifier: MIT
#include "polhode/elliptic/nome.hpp"

namespace polhode {
inline namespace v0 {

template double nome<double>(const BasicModulus<double>&);
template DoubleDouble nome<DoubleDouble>(const BasicModulus<DoubleDouble>&);

}  // namespace v0
}  // namespace polhode
