// SPDX-License-Identifier: MIT
// The textbook form with Boost.Math and with GeographicLib.
#include "boost_form.hpp"
#include "textbook.hpp"

#ifdef PEERS_GEOGRAPHIC  // by CMake, where the library is
#include <GeographicLib/EllipticFunction.hpp>
#endif

namespace peers {
namespace {

namespace bp = boost::math::policies;
using Default = BoostFunctions<double, bp::policy<>>;
using DoubleOnly = BoostFunctions<double, bp::policy<bp::promote_double<false>>>;

#ifdef PEERS_GEOGRAPHIC
struct Geographic {
  using Real = double;
  GeographicLib::EllipticFunction f;
  double K = 0.0, Pi = 0.0;

  Geographic() = default;
  Geographic(double m, double m1, double n) : f(m, n, m1, 1.0 - n), K(f.K()), Pi(f.Pi()) {}
  double incomplete_f(double phi) const { return f.F(phi); }
  double incomplete_pi(double sn, double cn, double dn) const { return f.Pi(sn, cn, dn); }
  double jacobi(double u, double& cn, double& dn) const {
    double sn = 0.0;
    f.sncndn(u, sn, cn, dn);
    return sn;
  }
};
#endif

template <class F>
Maker maker(const char* who) {
  return {who, textbook_motion<F>, fresh_sum<F>, sadov_action<F>};
}

}  // namespace

Maker boost_maker() { return maker<Default>("Boost.Math, textbook form"); }
Maker boost_double_maker() { return maker<DoubleOnly>("Boost.Math in double, textbook form"); }
Maker geographic_maker() {
#ifdef PEERS_GEOGRAPHIC
  return maker<Geographic>("GeographicLib, textbook form");
#else
  return {"GeographicLib, textbook form", nullptr, nullptr};
#endif
}

}  // namespace peers
