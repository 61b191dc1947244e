// SPDX-License-Identifier: MIT
// Elliptic kernels next to Boost.Math and GSL: time per call, and error against 50 digits.
//
// Everyone is given the same modulus (m, m1), in the form that the function takes: polhode the
// pair, the others k or m rounded from it. error is the largest over 64 arguments: relative for F,
// Pi, K and RJ, absolute for the Jacobi triple, whose dn_error is relative.
#include <benchmark/benchmark.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "polhode/elliptic/agm.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/elliptic/legendre.hpp"
#include "polhode/elliptic/legendre_pi.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::larger;
using polhode::test::Worst;
namespace bm = boost::math;
using Exact = boost::multiprecision::cpp_bin_float_50;
// double computed in double; the default computes in long double.
using NoPromotion = bm::policies::policy<bm::policies::promote_double<false>>;

constexpr std::array<double, 5> complements{0.9999, 0.75, 0.19, 0.002, 2e-9};
constexpr double characteristic = -0.7;
constexpr std::size_t arguments = 1024, checked = 64;

struct Argument {
  double u, phi, s, c, p;
};

struct Case {
  double m1;
  elliptic::Modulus mod;
  double k;
  std::vector<Argument> at;

  explicit Case(std::int64_t index)
      : m1(complements[static_cast<std::size_t>(index)]),
        mod(elliptic::Modulus::from_pair(1.0 - m1, m1)),
        k(std::sqrt(1.0 - m1)) {
    std::mt19937_64 engine(7);
    const double quarter = elliptic::complete_k(mod);
    const auto uniform = [&](double lo, double hi) {
      return lo + (hi - lo) * std::ldexp(static_cast<double>(engine() >> 11U), -53);
    };
    for (std::size_t i = 0; i < arguments; ++i) {
      Argument a{};
      a.u = quarter * uniform(-2.0, 2.0);
      a.phi = uniform(0.05, 1.55);
      a.s = std::sin(a.phi);
      a.c = std::cos(a.phi);
      a.p = 1.0 + 0.7 * a.s * a.s;
      at.push_back(a);
    }
  }
};

double relative(double got, const Exact& want) {
  return static_cast<double>(Exact(abs((Exact(got) - want) / want)));
}

// Times call(argument) and reports the largest error(argument).
template <class Call, class Error>
void measure(benchmark::State& state, const Case& c, const Call& call, const Error& error) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(call(c.at[i]));
    i = (i + 1) % arguments;
  }
  Worst worst;
  for (std::size_t j = 0; j < checked; ++j) worst.add(error(c.at[j]));
  state.counters["m1"] = c.m1;
  state.counters["error"] = worst.value();
}

template <class Triple>
void measure_jacobi(benchmark::State& state, const Triple& triple) {
  const Case c(state.range(0));
  const Exact k = sqrt(1 - Exact(c.m1));
  Worst dn_error;
  const auto call = [&](const Argument& a) { return triple(c, a.u); };
  measure(state, c, call, [&](const Argument& a) {
    Exact cn, dn;
    const Exact sn = bm::jacobi_elliptic(k, Exact(a.u), &cn, &dn);
    const elliptic::Jacobi<double> j = call(a);
    dn_error.add(relative(j.dn, dn));
    return static_cast<double>(Exact(larger(abs(j.sn - sn), abs(j.cn - cn), abs(j.dn - dn))));
  });
  state.counters["dn_error"] = dn_error.value();
}

void jacobi_polhode(benchmark::State& state) {
  measure_jacobi(state, [](const Case& c, double u) { return elliptic::jacobi(u, c.mod); });
}
void jacobi_boost(benchmark::State& state) {
  measure_jacobi(state, [](const Case& c, double u) {
    elliptic::Jacobi<double> j{};
    j.sn = bm::jacobi_elliptic(c.k, u, &j.cn, &j.dn);
    return j;
  });
}
void jacobi_boost_double(benchmark::State& state) {
  measure_jacobi(state, [](const Case& c, double u) {
    elliptic::Jacobi<double> j{};
    j.sn = bm::jacobi_elliptic(c.k, u, &j.cn, &j.dn, NoPromotion());
    return j;
  });
}
void jacobi_gsl(benchmark::State& state) {
  measure_jacobi(state, [](const Case& c, double u) {
    elliptic::Jacobi<double> j{};
    gsl_sf_elljac_e(u, c.mod.m(), &j.sn, &j.cn, &j.dn);
    return j;
  });
}

template <class F>
void measure_f(benchmark::State& state, const F& f) {
  const Case c(state.range(0));
  const Exact k = sqrt(1 - Exact(c.m1));
  const auto call = [&](const Argument& a) { return f(c, a); };
  measure(state, c, call, [&](const Argument& a) {
    return relative(call(a), bm::ellint_1(k, Exact(atan2(Exact(a.s), Exact(a.c)))));
  });
}
void f_polhode(benchmark::State& state) {
  measure_f(state,
            [](const Case& c, const Argument& a) { return elliptic::legendre_f(a.s, a.c, c.mod); });
}
void f_boost(benchmark::State& state) {
  measure_f(state, [](const Case& c, const Argument& a) { return bm::ellint_1(c.k, a.phi); });
}
void f_boost_double(benchmark::State& state) {
  measure_f(state, [](const Case& c, const Argument& a) {
    return bm::ellint_1(c.k, a.phi, NoPromotion());
  });
}
void f_gsl(benchmark::State& state) {
  measure_f(state, [](const Case& c, const Argument& a) {
    return gsl_sf_ellint_F(a.phi, c.k, GSL_PREC_DOUBLE);
  });
}

template <class F>
void measure_pi(benchmark::State& state, const F& f) {
  const Case c(state.range(0));
  const Exact k = sqrt(1 - Exact(c.m1));
  const auto call = [&](const Argument& a) { return f(c, a); };
  measure(state, c, call, [&](const Argument& a) {
    return relative(call(a),
                    bm::ellint_3(k, Exact(characteristic), Exact(atan2(Exact(a.s), Exact(a.c)))));
  });
}
void pi_polhode(benchmark::State& state) {
  measure_pi(state, [](const Case& c, const Argument& a) {
    return elliptic::legendre_pi(a.s, a.c, characteristic, c.mod);
  });
}
void pi_boost(benchmark::State& state) {
  measure_pi(state, [](const Case& c, const Argument& a) {
    return bm::ellint_3(c.k, characteristic, a.phi);
  });
}
void pi_boost_double(benchmark::State& state) {
  measure_pi(state, [](const Case& c, const Argument& a) {
    return bm::ellint_3(c.k, characteristic, a.phi, NoPromotion());
  });
}
void pi_gsl(benchmark::State& state) {
  measure_pi(state, [](const Case& c, const Argument& a) {
    return gsl_sf_ellint_P(a.phi, c.k, -characteristic, GSL_PREC_DOUBLE);  // 1 + n sin^2
  });
}

template <class F>
void measure_k(benchmark::State& state, const F& f) {
  const Case c(state.range(0));
  const Exact exact = bm::ellint_1(Exact(sqrt(1 - Exact(c.m1))));
  measure(
      state, c,
      [&](const Argument&) {
        double m1 = c.m1;
        benchmark::DoNotOptimize(m1);  // not hoisted out of the loop
        return f(c);
      },
      [&](const Argument&) { return relative(f(c), exact); });
}
void k_polhode(benchmark::State& state) {
  measure_k(state, [](const Case& c) { return elliptic::complete_k(c.mod); });
}
void k_boost(benchmark::State& state) {
  measure_k(state, [](const Case& c) { return bm::ellint_1(c.k); });
}
void k_boost_double(benchmark::State& state) {
  measure_k(state, [](const Case& c) { return bm::ellint_1(c.k, NoPromotion()); });
}
void k_gsl(benchmark::State& state) {
  measure_k(state, [](const Case& c) { return gsl_sf_ellint_Kcomp(c.k, GSL_PREC_DOUBLE); });
}

// RJ(c^2, c^2 + m1 s^2, 1, 1 + nu s^2), as in the precession of a free body.
template <class F>
void measure_rj(benchmark::State& state, const F& f) {
  const Case c(state.range(0));
  const auto call = [&](const Argument& a) {
    const double x = a.c * a.c;
    return f(x, x + c.m1 * a.s * a.s, a.p);
  };
  measure(state, c, call, [&](const Argument& a) {
    const double x = a.c * a.c;
    const double y = x + c.m1 * a.s * a.s;
    return relative(call(a), bm::ellint_rj(Exact(x), Exact(y), Exact(1), Exact(a.p)));
  });
}
void rj_polhode(benchmark::State& state) {
  measure_rj(state,
             [](double x, double y, double p) { return elliptic::carlson_rj(x, y, 1.0, p); });
}
void rj_boost(benchmark::State& state) {
  measure_rj(state, [](double x, double y, double p) { return bm::ellint_rj(x, y, 1.0, p); });
}
void rj_boost_double(benchmark::State& state) {
  measure_rj(state, [](double x, double y, double p) {
    return bm::ellint_rj(x, y, 1.0, p, NoPromotion());
  });
}
void rj_gsl(benchmark::State& state) {
  measure_rj(state, [](double x, double y, double p) {
    return gsl_sf_ellint_RJ(x, y, 1.0, p, GSL_PREC_DOUBLE);
  });
}

// The same kernels in DoubleDouble.
void pi_polhode_double_double(benchmark::State& state) {
  const Case c(state.range(0));
  const DoubleDouble m1 = c.m1;
  const auto mod = elliptic::BasicModulus<DoubleDouble>::from_pair(1.0 - m1, m1);
  const Exact k = sqrt(1 - Exact(c.m1));
  const auto call = [&](const Argument& a) {
    return elliptic::legendre_pi(DoubleDouble(a.s), DoubleDouble(a.c), DoubleDouble(characteristic),
                                 mod);
  };
  measure(state, c, call, [&](const Argument& a) {
    const DoubleDouble got = call(a);
    // Off the circle by a rounding of s and c: only the speed is meant here.
    return relative(got.hi,
                    bm::ellint_3(k, Exact(characteristic), Exact(atan2(Exact(a.s), Exact(a.c)))));
  });
}
void k_polhode_double_double(benchmark::State& state) {
  const Case c(state.range(0));
  const DoubleDouble m1 = c.m1;
  const auto mod = elliptic::BasicModulus<DoubleDouble>::from_pair(1.0 - m1, m1);
  const Exact exact = bm::ellint_1(Exact(sqrt(1 - Exact(c.m1))));
  measure(
      state, c, [&](const Argument&) { return elliptic::complete_k(mod); },
      [&](const Argument&) {
        const DoubleDouble got = elliptic::complete_k(mod);
        return static_cast<double>(Exact(abs((Exact(got.hi) + Exact(got.lo)) / exact - 1)));
      });
}

#define POLHODE_BENCHMARK(name) BENCHMARK(name)->DenseRange(0, 4)
POLHODE_BENCHMARK(jacobi_polhode);
POLHODE_BENCHMARK(jacobi_boost);
POLHODE_BENCHMARK(jacobi_boost_double);
POLHODE_BENCHMARK(jacobi_gsl);
POLHODE_BENCHMARK(f_polhode);
POLHODE_BENCHMARK(f_boost);
POLHODE_BENCHMARK(f_boost_double);
POLHODE_BENCHMARK(f_gsl);
POLHODE_BENCHMARK(pi_polhode);
POLHODE_BENCHMARK(pi_boost);
POLHODE_BENCHMARK(pi_boost_double);
POLHODE_BENCHMARK(pi_gsl);
POLHODE_BENCHMARK(k_polhode);
POLHODE_BENCHMARK(k_boost);
POLHODE_BENCHMARK(k_boost_double);
POLHODE_BENCHMARK(k_gsl);
POLHODE_BENCHMARK(rj_polhode);
POLHODE_BENCHMARK(rj_boost);
POLHODE_BENCHMARK(rj_boost_double);
POLHODE_BENCHMARK(rj_gsl);
POLHODE_BENCHMARK(k_polhode_double_double);
POLHODE_BENCHMARK(pi_polhode_double_double);

}  // namespace
