// SPDX-License-Identifier: MIT
// Elliptic integrals and functions: the instances of their templates that the library holds, and
// the checks of a modulus.
#include "math/number_text.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/carlson.hpp"
#include "polhode/elliptic/carlson_rf_rd.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/legendre_pi.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {

void throw_bad_ratio(double a, double b) {
  throw DomainError("Modulus: ratio " + polhode::detail::tuple_text({a, b}) +
                    " breaks 0 <= a, b and 0 < a + b < inf");
}

void throw_bad_modulus_pair(double m, double m1) {
  throw DomainError("Modulus: pair " + polhode::detail::tuple_text({m, m1}) +
                    " breaks 0 <= m, m1 and m + m1 = 1");
}

void throw_bad_any_pair(double m, double m1) {
  throw DomainError("Modulus: pair " + polhode::detail::tuple_text({m, m1}) +
                    " breaks m + m1 = 1 with finite members");
}

}  // namespace detail

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

template double legendre_pi<double>(const double&, const double&, const double&,
                                    const BasicModulus<double>&);
template double legendre_pi<double>(const double&, const double&, const BasicModulus<double>&);
template DoubleDouble legendre_pi<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);
template DoubleDouble legendre_pi<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);

template double carlson_rc<double>(const double&, const double&);
template double carlson_rj<double>(double, double, double, double);
template DoubleDouble carlson_rc<DoubleDouble>(const DoubleDouble&, const DoubleDouble&);
template DoubleDouble carlson_rj<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble,
                                               DoubleDouble);

template double carlson_rf<double>(double, double, double);
template double carlson_rd<double>(double, double, double);
template DoubleDouble carlson_rf<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble);
template DoubleDouble carlson_rd<DoubleDouble>(DoubleDouble, DoubleDouble, DoubleDouble);

template double heuman_lambda0<double>(const double&, const double&, const BasicModulus<double>&);
template double heuman_lambda0<double>(const double&, const BasicModulus<double>&);
template DoubleDouble heuman_lambda0<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                   const BasicModulus<DoubleDouble>&);
template DoubleDouble heuman_lambda0<DoubleDouble>(const DoubleDouble&,
                                                   const BasicModulus<DoubleDouble>&);

template Jacobi<double> jacobi<double>(const double&, const BasicModulus<double>&);
template double amplitude<double>(const double&, const BasicModulus<double>&);
template Jacobi<DoubleDouble> jacobi<DoubleDouble>(const DoubleDouble&,
                                                   const BasicModulus<DoubleDouble>&);
template DoubleDouble amplitude<DoubleDouble>(const DoubleDouble&,
                                              const BasicModulus<DoubleDouble>&);

template double jacobi_zeta<double>(const double&, const double&, const BasicModulus<double>&);
template double jacobi_zeta<double>(const double&, const BasicModulus<double>&);
template DoubleDouble jacobi_zeta<DoubleDouble>(const DoubleDouble&, const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);
template DoubleDouble jacobi_zeta<DoubleDouble>(const DoubleDouble&,
                                                const BasicModulus<DoubleDouble>&);

template double nome<double>(const BasicModulus<double>&);
template DoubleDouble nome<DoubleDouble>(const BasicModulus<DoubleDouble>&);

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
