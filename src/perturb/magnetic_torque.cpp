// SPDX-License-Identifier: MIT
#include "polhode/perturb/magnetic_torque.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "perturb/detail/friction_matrix.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void require_dipole(const Vec3& m) {
  if (!std::isfinite(m.x) || !std::isfinite(m.y) || !std::isfinite(m.z))
    throw DomainError("ResidualDipole: moment " + tuple_text({m.x, m.y, m.z}) + " must be finite");
}

Mat3 checked_magnetic_tensor(const Mat3& M) {
  return friction_matrix(M, "EddyCurrents: magnetic tensor");
}

void require_field_rate(bool has_rate) {
  if (!has_rate)
    throw DomainError(
        "EddyCurrents: this field has no derivative by time: expected FieldRate::left_out, or an "
        "orbit and a field that take Dual times");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
