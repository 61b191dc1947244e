// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string>

#include "elliptic/detail/jacobi_lanes_declared.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace elliptic {
namespace detail {

void jacobi_alone(double u, double m, double m1, double& sn, double& cn, double& dn) {
  if (!(std::isfinite(m) && std::isfinite(m1))) {
    sn = cn = dn = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const Jacobi<double> j = jacobi(u, Modulus::from_any_pair(m, m1));
  sn = j.sn;
  cn = j.cn;
  dn = j.dn;
}

namespace {

template <InstructionSet isa>
void jacobi_by(const JacobiColumns& columns, std::size_t count, bool one_modulus) {
  if (one_modulus)
    jacobi_in_lanes<isa, true>(columns, count);
  else
    jacobi_in_lanes<isa, false>(columns, count);
}

void require_as_many(const char* what, std::size_t got, std::size_t count) {
  if (got != count)
    throw DomainError(std::string("jacobi: got ") + std::to_string(got) + " numbers " + what +
                      " of " + std::to_string(count) + " arguments; expected as many");
}

}  // namespace
}  // namespace detail

void jacobi(std::span<const double> u, std::span<const double> m, std::span<const double> m1,
            const JacobiSpans& results, InstructionSet set) {
  const std::size_t count = u.size();
  detail::require_as_many("sn", results.sn.size(), count);
  detail::require_as_many("cn", results.cn.size(), count);
  detail::require_as_many("dn", results.dn.size(), count);
  const bool one_modulus = m.size() == 1 && m1.size() == 1;
  if (!one_modulus) {
    detail::require_as_many("m", m.size(), count);
    detail::require_as_many("m1", m1.size(), count);
  }
  if (!supports(set))
    throw DomainError("jacobi: got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
  const detail::JacobiColumns columns{u.data(),          m.data(),          m1.data(),
                                      results.sn.data(), results.cn.data(), results.dn.data()};
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return detail::jacobi_by<InstructionSet::avx512>(columns, count, one_modulus);
  if (set == InstructionSet::avx2)
    return detail::jacobi_by<InstructionSet::avx2>(columns, count, one_modulus);
#endif
  detail::jacobi_by<InstructionSet::baseline>(columns, count, one_modulus);
}

void jacobi(std::span<const double> u, const Modulus& modulus, const JacobiSpans& results,
            InstructionSet set) {
  jacobi(u, std::span(&modulus.m(), 1), std::span(&modulus.m1(), 1), results, set);
}

}  // namespace elliptic
}  // namespace v0
}  // namespace polhode
