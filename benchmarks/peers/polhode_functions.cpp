// SPDX-License-Identifier: MIT
#include "functions.hpp"
#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/heuman.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/many_jacobi.hpp"

namespace peers {
namespace {

class Polhode : public Functions {
 public:
  explicit Polhode(double m1) : mod_(polhode::Modulus::from_pair(1.0 - m1, m1)) {}
  std::string who() const override { return "polhode"; }
  Values jacobi(double u) const override {
    const auto j = polhode::jacobi(u, mod_);
    return {j.sn, j.cn, j.dn};
  }
  double complete_k() const override { return polhode::complete_k(mod_); }
  double complete_pi(double n) const override { return polhode::complete_pi(n, mod_); }
  double heuman(double phi) const override { return polhode::heuman_lambda0(phi, mod_); }

 private:
  polhode::Modulus mod_;
};

}  // namespace

std::unique_ptr<Functions> polhode_functions(double m1) { return std::make_unique<Polhode>(m1); }

void polhode_jacobi(const std::vector<double>& u, const std::vector<double>& m,
                    const std::vector<double>& m1, JacobiTable& results) {
  polhode::jacobi(u, m, m1, polhode::JacobiSpans{results.sn, results.cn, results.dn});
}

}  // namespace peers
