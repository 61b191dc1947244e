// SPDX-License-Identifier: MIT
// Elliptic functions of one library, each given a modulus whose complement is known: m1 = 1 - m.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace peers {

struct Values {
  double a = std::nan(""), b = std::nan(""), c = std::nan("");
};

// A library's functions at one modulus; NaN where it has none.
class Functions {
 public:
  Functions() = default;
  Functions(const Functions&) = delete;
  Functions& operator=(const Functions&) = delete;
  virtual ~Functions() = default;
  virtual std::string who() const = 0;
  virtual Values jacobi(double) const { return {}; }
  virtual double complete_k() const { return std::nan(""); }
  virtual double complete_pi(double) const { return std::nan(""); }
  virtual double heuman(double) const { return std::nan(""); }
};

std::unique_ptr<Functions> polhode_functions(double m1);
// All arguments at once, each with a modulus of its own, or all with that of a single m1.
struct JacobiTable {
  std::vector<double> sn, cn, dn;
};
void polhode_jacobi(const std::vector<double>& u, const std::vector<double>& m,
                    const std::vector<double>& m1, JacobiTable& results);
// Boost by default, Boost in double, GSL, GeographicLib: those that are here.
std::vector<std::unique_ptr<Functions>> peer_functions(double m1);
// At 50 digits, rounded; K, Pi and Heuman's lambda of the exact m1.
std::unique_ptr<Functions> exact_functions(double m1);

}  // namespace peers
