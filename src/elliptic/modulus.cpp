// SPDX-License-Identifier: MIT
#include "polhode/elliptic/modulus.hpp"

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void throw_bad_ratio(double a, double b) {
  throw DomainError("Modulus: ratio " + tuple_text({a, b}) +
                    " breaks 0 <= a, b and 0 < a + b < inf");
}

void throw_bad_modulus_pair(double m, double m1) {
  throw DomainError("Modulus: pair " + tuple_text({m, m1}) + " breaks 0 <= m, m1 and m + m1 = 1");
}

void throw_bad_any_pair(double m, double m1) {
  throw DomainError("Modulus: pair " + tuple_text({m, m1}) +
                    " breaks m + m1 = 1 with finite members");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
