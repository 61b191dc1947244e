// SPDX-License-Identifier: MIT
// One state of a free rotation: FreeRotation::at, and many in one call, next to the textbook form
// (Jacobi functions and an incomplete integral of the third kind per state) with Boost.Math and
// with GSL; then preparation and the transition matrix. Short-axis mode, times up to 1e4 rad of
// rotation. `error` is the largest angle (rad) from the textbook form at 50 digits, over 64 times;
// `k` is the modulus.
#include "polhode/free/free_rotation.hpp"

#include <benchmark/benchmark.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::Worst;
namespace bm = boost::math;
using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;
using DoubleOnly = bm::policies::policy<bm::policies::promote_double<false>>;

constexpr double farthest = 1e4;

// sn, cn, dn and Pi(n; am u, k) - with n = -kappa^2 - of one library.
template <class T, class Policy>
struct BoostFunctions {
  using Real = T;
  static T complete_k(const T& k) { return bm::ellint_1(k, Policy()); }
  static T complete_pi(const T& n, const T& k) { return bm::ellint_3(k, n, Policy()); }
  static T incomplete_pi(const T& n, const T& phi, const T& k) {
    return bm::ellint_3(k, n, phi, Policy());
  }
  static T incomplete_f(const T& phi, const T& k) { return bm::ellint_1(k, phi, Policy()); }
  static T jacobi(const T& u, const T& k, T& cn, T& dn) {
    return bm::jacobi_elliptic(k, u, &cn, &dn, Policy());
  }
};

struct GslFunctions {
  using Real = double;
  static double complete_k(double k) { return gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE); }
  static double complete_pi(double n, double k) {
    return gsl_sf_ellint_Pcomp(k, -n, GSL_PREC_DOUBLE);
  }
  static double incomplete_pi(double n, double phi, double k) {
    return gsl_sf_ellint_P(phi, k, -n, GSL_PREC_DOUBLE);
  }
  static double incomplete_f(double phi, double k) {
    return gsl_sf_ellint_F(phi, k, GSL_PREC_DOUBLE);
  }
  static double jacobi(double u, double k, double& cn, double& dn) {
    double sn = 0.0;
    gsl_sf_elljac_e(u, k * k, &sn, &cn, &dn);
    return sn;
  }
};

// The textbook form: l, J from the momentum, g by a third-kind integral [SA (54), (1490)-(1492)].
template <class F>
class Textbook {
 public:
  using T = typename F::Real;

  Textbook(const Vec3& I, const Vec3& g) {
    using std::atan2;
    using std::sqrt;
    const T A = I.x, B = I.y, C = I.z, x = g.x, y = g.y, z = g.z;
    const T DA = y * y * (B - A) / B + z * z * (C - A) / C;
    const T DC = x * x * (C - A) / A + y * y * (C - B) / B;
    G_ = sqrt(x * x + y * y + z * z);
    a1_ = sqrt(A * DC / (C - A));
    a2_ = sqrt(B * DC / (C - B));
    a3_ = sqrt(C * DA / (C - A));
    n_ = sqrt((C - B) * DA / (A * B * C));
    k_ = sqrt((B - A) * DC / ((C - B) * DA));
    nu_ = -C * (B - A) / (A * (C - B));
    slow_ = G_ / C;
    weight_ = G_ / n_ * (1 / A - 1 / C);
    K_ = F::complete_k(k_);
    Pi_ = F::complete_pi(nu_, k_);
    u0_ = F::incomplete_f(atan2(T(y / a2_), T(x / a1_)), k_);
    pi0_ = pi_of(u0_);
  }

  BasicQuaternion<T> attitude(const T& t) const {
    using std::acos;
    using std::atan2;
    using std::sqrt;
    const T u = u0_ + n_ * t;
    T cn = 0, dn = 0;
    const T sn = F::jacobi(u, k_, cn, dn);
    const T x = a1_ * cn, y = a2_ * sn, z = a3_ * dn;
    const T g = slow_ * t + weight_ * (pi_of(u) - pi0_);
    const T J = atan2(T(sqrt(x * x + y * y)), z), l = atan2(x, y);
    return rotation_z(g) * rotation_x(J) * rotation_z(l);
  }

 private:
  T pi_of(const T& u) const {
    using std::atan2;
    using std::floor;
    const T periods = floor(u / (2 * K_) + T(0.5)), r = u - 2 * periods * K_;
    T cn = 0, dn = 0;
    const T sn = F::jacobi(r, k_, cn, dn);
    return F::incomplete_pi(nu_, atan2(sn, cn), k_) + 2 * periods * Pi_;
  }

  T G_, a1_, a2_, a3_, n_, k_, nu_, slow_, weight_, K_, Pi_, u0_, pi0_;
};

const Vec3 moments{1.0, 1.7, 2.1};

// Near the axis, moderate, large, next to the separatrix.
Vec3 momentum(std::int64_t which) {
  const double along_long[] = {0.04, 0.4, 0.6, 0.7822};
  return {along_long[which], 0.1, 1.5};
}

std::vector<double> times(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(0.0, farthest);
  std::vector<double> t(count);
  for (double& x : t) x = u(random);
  return t;
}

// The angle between two attitudes relative to their own starts.
template <class T>
double angle(const BasicQuaternion<T>& start, const BasicQuaternion<T>& end,
             const BasicQuaternion<Wide>& exact) {
  const auto widened = [](const BasicQuaternion<T>& q) {
    return BasicQuaternion<Wide>{Wide(q.w), Wide(q.x), Wide(q.y), Wide(q.z)};
  };
  const BasicQuaternion<Wide> q = normalized(conj(widened(start)) * widened(end));
  const BasicQuaternion<Wide> r = conj(exact) * q;
  return 2.0 * static_cast<double>(sqrt(Wide(r.x * r.x + r.y * r.y + r.z * r.z)));
}

template <class Motion>
double worst_error(const Motion& motion, std::int64_t which) {
  const Textbook<BoostFunctions<Wide, bm::policies::policy<>>> exact(moments, momentum(which));
  const BasicQuaternion<Wide> start = exact.attitude(Wide(0));
  Worst worst;
  for (const double t : times(64))
    worst.add(angle(motion(0.0), motion(t), conj(start) * exact.attitude(Wide(t))));
  return worst.value();
}

double modulus(std::int64_t which) {
  const FreeRotation f(Body(moments.x, moments.y, moments.z), {{}, momentum(which)});
  return std::sqrt(f.modulus().m());
}

template <class Motion>
void measure(benchmark::State& state, const Motion& motion) {
  const std::vector<double> t = times(1024);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(motion(t[i]));
    i = (i + 1) % t.size();
  }
  state.counters["k"] = modulus(state.range(0));
  state.counters["error"] = worst_error(motion, state.range(0));
}

void polhode_at(benchmark::State& state) {
  const FreeRotation f(Body(moments.x, moments.y, moments.z), {{}, momentum(state.range(0))});
  measure(state, [&](double t) { return f.at(t).q; });
}
template <class F>
void textbook(benchmark::State& state) {
  const Textbook<F> f(moments, momentum(state.range(0)));
  measure(state, [&](double t) { return f.attitude(t); });
}
// Many times in one call; `range(1)` is the set of instructions.
void polhode_states_at(benchmark::State& state) {
  const auto set = static_cast<InstructionSet>(state.range(1));
  if (!supports(set)) return state.SkipWithError("this processor has no such instructions");
  const FreeRotation f(Body(moments.x, moments.y, moments.z), {{}, momentum(state.range(0))});
  const std::vector<double> t = times(4096);
  std::vector<RotorState> states(t.size());
  for (auto _ : state) {
    states_at(f.kernel(), t, states, set);
    benchmark::DoNotOptimize(states.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(t.size()));
  state.SetLabel(std::string(instruction_set_name(set)));
  state.counters["k"] = modulus(state.range(0));
  const auto at = [&](double x) {
    const std::vector<double> same(16, x);
    std::vector<RotorState> found(same.size());
    states_at(f.kernel(), same, found, set);
    return found.back().q;
  };
  state.counters["error"] = worst_error(at, state.range(0));
  state.counters["ns_per_state"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(t.size()) * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
// An even grid in cache; `range(1)` is the set of instructions.
void polhode_states_on_grid(benchmark::State& state) {
  const auto set = static_cast<InstructionSet>(state.range(1));
  if (!supports(set)) return state.SkipWithError("this processor has no such instructions");
  const FreeRotation f(Body(moments.x, moments.y, moments.z), {{}, momentum(state.range(0))});
  std::vector<RotorState> states(4096);
  const TimeGrid grid{0.0, 0x1.3p+1};  // up to 1e4
  for (auto _ : state) {
    states_on_grid(f.kernel(), grid, 0, states, set);
    benchmark::DoNotOptimize(states.data());
    benchmark::ClobberMemory();
  }
  state.SetLabel(std::string(instruction_set_name(set)));
  state.counters["k"] = modulus(state.range(0));
  const Textbook<BoostFunctions<Wide, bm::policies::policy<>>> exact(moments,
                                                                     momentum(state.range(0)));
  const BasicQuaternion<Wide> start = exact.attitude(Wide(0));
  Worst worst;
  for (std::size_t i = 0; i < states.size(); i += 61)
    worst.add(angle(states[0].q, states[i].q,
                    conj(start) * exact.attitude(Wide(static_cast<double>(i) * grid.step))));
  state.counters["error"] = worst.value();
  state.counters["ns_per_state"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(states.size()) * 1e-9,
      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(polhode_at)->DenseRange(0, 3);
BENCHMARK(polhode_states_at)->ArgsProduct({{0, 1, 2, 3}, {0, 1, 2}});
BENCHMARK(polhode_states_on_grid)->ArgsProduct({{0, 1, 2, 3}, {0, 1, 2}});
BENCHMARK(textbook<BoostFunctions<double, bm::policies::policy<>>>)->DenseRange(0, 3);
BENCHMARK(textbook<BoostFunctions<double, DoubleOnly>>)->DenseRange(0, 3);
BENCHMARK(textbook<GslFunctions>)->DenseRange(0, 3);

void prepare_long_arc(benchmark::State& state) {
  const Body body(moments.x, moments.y, moments.z);
  RotorState s{{}, momentum(state.range(0))};
  for (auto _ : state) benchmark::DoNotOptimize(FreeRotation(body, s));
}
void prepare_short_arc(benchmark::State& state) {
  const Body body(moments.x, moments.y, moments.z);
  RotorState s{{}, momentum(state.range(0))};
  for (auto _ : state) benchmark::DoNotOptimize(FreeRotation::short_arc(body, s));
}
void transition_matrix(benchmark::State& state) {
  const FreeRotation f(Body(moments.x, moments.y, moments.z), {{}, momentum(state.range(0))});
  for (auto _ : state) benchmark::DoNotOptimize(f.state_transition(50.0));
}
BENCHMARK(prepare_long_arc)->DenseRange(0, 3);
BENCHMARK(prepare_short_arc)->DenseRange(0, 3);
BENCHMARK(transition_matrix)->DenseRange(0, 3);

}  // namespace
