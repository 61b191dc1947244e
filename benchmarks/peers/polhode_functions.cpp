// SPDX-License-Identifier: MIT
#include "functions.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/legendre.hpp"

namespace peers {
namespace {

class Polhode : public Functions {
 public:
  explicit Polhode(double m1) : mod_(polhode::elliptic::Modulus::from_pair(1.0 - m1, m1)) {}
  std::string who() const override { return "polhode"; }
  Values jacobi(double u) const override {
    const auto j = polhode::elliptic::jacobi(u, mod_);
    return {j.sn, j.cn, j.dn};
  }
  double complete_k() const override { return polhode::elliptic::complete_k(mod_); }
  double complete_pi(double n) const override { return polhode::elliptic::complete_pi(n, mod_); }
  double heuman(double phi) const override { return polhode::elliptic::heuman_lambda0(phi, mod_); }

 private:
  polhode::elliptic::Modulus mod_;
};

}  // namespace

std::unique_ptr<Functions> polhode_functions(double m1) { return std::make_unique<Polhode>(m1); }

void polhode_jacobi(const std::vector<double>& u, const std::vector<double>& m,
                    const std::vector<double>& m1, JacobiTable& results) {
  polhode::elliptic::jacobi(u, m, m1,
                            polhode::elliptic::JacobiSpans{results.sn, results.cn, results.dn});
}

}  // namespace peers
