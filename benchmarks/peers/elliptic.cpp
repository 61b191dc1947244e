// SPDX-License-Identifier: MIT
// Goals G7 and G8: Jacobi's functions, K, Pi and Heuman's lambda, to the edge of the separatrix.
// Errors against 50 digits: the largest of the three for Jacobi's functions, relative for the
// others. Arguments: seed, repetitions.
#include <algorithm>
#include <cstdlib>
#include <random>

#include "functions.hpp"
#include "samples.hpp"
#include "worst.hpp"

namespace peers {
namespace {

constexpr std::size_t count = 256, checked = 32;

class Measured {
 public:
  Measured(double m1, std::mt19937_64& engine) : m1_(m1), exact_(exact_functions(m1)) {
    all_.push_back(polhode_functions(m1));
    for (auto& f : peer_functions(m1)) all_.push_back(std::move(f));
    const double K = exact_->complete_k();
    const auto uniform = [&engine](double a, double b) {
      return a + (b - a) * std::ldexp(static_cast<double>(engine() >> 11U), -53);
    };
    for (std::size_t i = 0; i < count; ++i) {
      u_.push_back(uniform(-2.0 * K, 2.0 * K));
      n_.push_back(uniform(-0.95, -0.05));
      phi_.push_back(uniform(0.05, 1.55));
    }
  }

  void jacobi(const std::string& what, int repetitions) const {
    std::vector<Entry> list = entries(
        u_, [](const Functions& f, double u) { return f.jacobi(u); }, largest_of_three);
    list.push_back(many("polhode jacobi, many at once", count));
    list.push_back(many("polhode jacobi, many at once, one modulus", 1));
    compare("G7", what, list, repetitions);
  }
  void integrals(const std::string& what, int repetitions) const {
    const auto relative = [](double got, double want) { return std::abs(got / want - 1.0); };
    compare("G8", "K, " + what,
            entries(
                u_, [](const Functions& f, double) { return f.complete_k(); }, relative),
            repetitions);
    compare("G8", "Pi, " + what,
            entries(
                n_, [](const Functions& f, double n) { return f.complete_pi(n); }, relative),
            repetitions);
    compare("G8", "Heuman lambda, " + what,
            entries(
                phi_, [](const Functions& f, double phi) { return f.heuman(phi); }, relative),
            repetitions);
  }

 private:
  static double largest_of_three(const Values& got, const Values& want) {
    return polhode::test::larger(std::abs(got.a - want.a), std::abs(got.b - want.b),
                                 std::abs(got.c - want.c));
  }

  // Of all arguments, with so many moduli, which happen to be equal.
  Entry many(const char* who, std::size_t moduli) const {
    const std::vector<double> m(moduli, 1.0 - m1_), m1(moduli, m1_);
    JacobiTable got{std::vector<double>(count), std::vector<double>(count),
                    std::vector<double>(count)};
    polhode_jacobi(u_, m, m1, got);
    polhode::test::Worst worst;
    for (std::size_t i = 0; i < checked; ++i)
      worst.add(largest_of_three({got.sn[i], got.cn[i], got.dn[i]}, exact_->jacobi(u_[i])));
    return {who,
            [this, m, m1, got]() mutable {
              polhode_jacobi(u_, m, m1, got);
              keep(got.sn.data());
            },
            static_cast<double>(count), worst.value()};
  }

  // One entry for each library that has the function.
  template <class Call, class Error>
  std::vector<Entry> entries(const std::vector<double>& at, Call call, Error error) const {
    std::vector<Entry> list;
    for (const auto& f : all_) {
      polhode::test::Worst worst;
      for (std::size_t i = 0; i < checked; ++i)
        worst.add(error(call(*f, at[i]), call(*exact_, at[i])));
      if (std::isnan(worst.value())) continue;
      list.push_back({f->who(),
                      [&f = *f, &at, call] {
                        for (const double x : at) keep(call(f, x));
                      },
                      static_cast<double>(at.size()), worst.value()});
    }
    return list;
  }

  double m1_;
  std::unique_ptr<Functions> exact_;
  std::vector<std::unique_ptr<Functions>> all_;
  std::vector<double> u_, n_, phi_;
};

}  // namespace
}  // namespace peers

int main(int argc, char** argv) {
  using namespace peers;
  std::mt19937_64 engine(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1);
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 7;
  const std::pair<double, const char*> moduli[] = {{0.75, "1 - m = 0.75"},
                                                   {0.19, "1 - m = 0.19"},
                                                   {0.002, "1 - m = 0.002"},
                                                   {2e-9, "1 - m = 2e-9"}};
  for (const auto& [m1, what] : moduli) {
    const Measured measured(m1, engine);
    measured.jacobi(what, repetitions);
    measured.integrals(what, repetitions);
  }
}
