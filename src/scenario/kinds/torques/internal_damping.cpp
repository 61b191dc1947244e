// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "internal-damping".
#include "polhode/perturb/internal_damping.hpp"

#include <algorithm>
#include <optional>

#include "scenario/detail/torque_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct Arguments {
  std::optional<Vec3> k;
  bool grows;
  double wobble_time;
  double rate;
};

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::k>(
        "k", Dimension::number,
        "Of v = k g x omega, along the principal axes; in one over momentum.")
        .alternative()
        .example("[0.01, 0.01, 0.01]"),
    flag_key<&Arguments::grows>(
        "grows", "Whether k is multiplied by the momentum; it is then in one over its square.")
        .otherwise("false"),
    quantity_key<&Arguments::wobble_time>(
        "wobble_time", Dimension::time,
        "Time in which a small wobble about the axis of the largest moment falls by e.")
        .alternative()
        .example("\"100 d\"")
        .positive(),
    quantity_key<&Arguments::rate>("rate", Dimension::rate,
                                   "The rate of rotation about that axis at which it does.")
        .alternative()
        .example("\"360 deg/d\"")
        .positive(),
};

MadeTerms made(const Arguments& a, const TermContext& at) {
  if (a.k)
    return at.built("k", [&]() -> AnyPerturbation {
      return {"internal damping", InternalDamping(*a.k, a.grows)};
    });
  if (a.grows) at.refuse("grows", "expected a key k as well");
  const Vec3& I = at.body().moments();
  return at.built("kind", [&]() -> AnyPerturbation {
    return {"internal damping", InternalDamping::of_wobble(at.body(), a.wobble_time,
                                                           a.rate * std::max({I.x, I.y, I.z}))};
  });
}

}  // namespace

PerturbationKind internal_damping_kind() {
  PerturbationKind kind = perturbation_kind<Arguments>(
      "internal-damping", "Friction inside the body: energy falls, angular momentum stays.", keys,
      made);
  kind.sets = "wobble_time+rate|k";
  return kind;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
