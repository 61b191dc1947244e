// SPDX-License-Identifier: MIT
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/heuman_lambda.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "functions.hpp"

#if __has_include(<gsl/gsl_sf_ellint.h>)
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#define PEERS_GSL 1
#endif
#ifdef PEERS_GEOGRAPHIC  // by CMake, where the library is
#include <GeographicLib/EllipticFunction.hpp>
#endif

namespace peers {
namespace {

namespace bm = boost::math;

template <class Policy>
class BoostFunctions : public Functions {
 public:
  BoostFunctions(const char* who, double m1) : who_(who), k_(std::sqrt(1.0 - m1)) {}
  std::string who() const override { return who_; }
  Values jacobi(double u) const override {
    Values v;
    v.a = bm::jacobi_elliptic(k_, u, &v.b, &v.c, Policy());
    return v;
  }
  double complete_k() const override { return bm::ellint_1(k_, Policy()); }
  double complete_pi(double n) const override { return bm::ellint_3(k_, n, Policy()); }
  double heuman(double phi) const override { return bm::heuman_lambda(k_, phi, Policy()); }

 private:
  const char* who_;
  double k_;
};

#ifdef PEERS_GSL
class Gsl : public Functions {
 public:
  explicit Gsl(double m1) : m_(1.0 - m1), k_(std::sqrt(m_)) { gsl_set_error_handler_off(); }
  std::string who() const override { return "GSL"; }
  Values jacobi(double u) const override {
    Values v;
    gsl_sf_elljac_e(u, m_, &v.a, &v.b, &v.c);
    return v;
  }
  double complete_k() const override { return gsl_sf_ellint_Kcomp(k_, GSL_PREC_DOUBLE); }
  double complete_pi(double n) const override {
    return gsl_sf_ellint_Pcomp(k_, -n, GSL_PREC_DOUBLE);
  }

 private:
  double m_, k_;
};
#endif

#ifdef PEERS_GEOGRAPHIC
class Geographic : public Functions {
 public:
  explicit Geographic(double m1) : m1_(m1), f_(1.0 - m1, 0.0, m1, 1.0) {}
  std::string who() const override { return "GeographicLib"; }
  Values jacobi(double u) const override {
    Values v;
    f_.sncndn(u, v.a, v.b, v.c);
    return v;
  }
  double complete_k() const override { return made(0.0).K(); }
  double complete_pi(double n) const override { return made(n).Pi(); }

 private:
  // Its constructor computes the complete integrals.
  GeographicLib::EllipticFunction made(double n) const { return {1.0 - m1_, n, m1_, 1.0 - n}; }
  double m1_;
  GeographicLib::EllipticFunction f_;
};
#endif

}  // namespace

std::vector<std::unique_ptr<Functions>> peer_functions(double m1) {
  namespace bp = bm::policies;
  std::vector<std::unique_ptr<Functions>> list;
  list.push_back(std::make_unique<BoostFunctions<bp::policy<>>>("Boost.Math", m1));
  list.push_back(std::make_unique<BoostFunctions<bp::policy<bp::promote_double<false>>>>(
      "Boost.Math in double", m1));
#ifdef PEERS_GSL
  list.push_back(std::make_unique<Gsl>(m1));
#endif
#ifdef PEERS_GEOGRAPHIC
  list.push_back(std::make_unique<Geographic>(m1));
#endif
  return list;
}

}  // namespace peers
