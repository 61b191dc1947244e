// SPDX-License-Identifier: MIT
// Boost's functions at 50 digits are given k; Heuman's lambda is formed of F, K and Zeta of the
// complement by its definition (2/pi)(E F' + K (E' - F')).
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "functions.hpp"

namespace peers {
namespace {

namespace bm = boost::math;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;

class Exact : public Functions {
 public:
  explicit Exact(double m1) : k_(sqrt(1 - Wide(m1))), k1_(sqrt(Wide(m1))) {}
  std::string who() const override { return "50 digits"; }
  Values jacobi(double u) const override {
    Wide cn, dn;
    const Wide sn = bm::jacobi_elliptic(k_, Wide(u), &cn, &dn);
    return {static_cast<double>(sn), static_cast<double>(cn), static_cast<double>(dn)};
  }
  double complete_k() const override { return static_cast<double>(bm::ellint_1(k_)); }
  double complete_pi(double n) const override {
    return static_cast<double>(bm::ellint_3(k_, Wide(n)));
  }
  double heuman(double phi) const override {
    const Wide f = bm::ellint_1(k1_, Wide(phi)), e = bm::ellint_2(k1_, Wide(phi));
    const Wide K = bm::ellint_1(k_), E = bm::ellint_2(k_);
    return static_cast<double>(Wide((E * f + K * (e - f)) * 2 / acos(Wide(-1))));
  }

 private:
  Wide k_, k1_;
};

}  // namespace

std::unique_ptr<Functions> exact_functions(double m1) { return std::make_unique<Exact>(m1); }

}  // namespace peers
