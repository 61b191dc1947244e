// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "damping".
#include "polhode/perturb/linear_damping.hpp"
#include "scenario/detail/torque_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct Arguments {
  LinearMap coefficients;
};

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::coefficients>(
        "coefficients", Dimension::damping,
        "D of the torque -D omega in body axes: its diagonal, or three rows.")
        .required()
        .example("[0.001, 0.001, 0.001]"),
};

// The body axes of the file are those of its tensor; the term wants principal axes.
MadeTerms made(const Arguments& a, const TermContext& at) {
  const Mat3& D = a.coefficients.matrix;
  return at.built("coefficients", [&]() -> AnyPerturbation {
    if (a.coefficients.is_diagonal && at.has_principal_axes())
      return {"damping", LinearDamping(Vec3{D(0, 0), D(1, 1), D(2, 2)})};
    const LinearDamping in_file_axes(D, at.body());
    return {"damping", LinearDamping(at.principal(in_file_axes.matrix()), at.body())};
  });
}

}  // namespace

PerturbationKind damping_kind() {
  return perturbation_kind<Arguments>(
      "damping", "A torque against the angular velocity, in proportion to it.", keys, made);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
