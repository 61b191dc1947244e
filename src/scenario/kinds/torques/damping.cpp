// SPDX-License-Identifier: MIT
// [[perturbation]] of kinds "damping", "internal-damping", "anelastic-damping" and "kane-damper".
#include <algorithm>
#include <optional>

#include "polhode/perturb/internal_damping.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

struct LinearDampingArguments {
  LinearMap coefficients;
};

constexpr KindKey<LinearDampingArguments> linear_damping_keys[] = {
    quantity_key<&LinearDampingArguments::coefficients>(
        "coefficients", Dimension::damping,
        "D of the torque -D omega in body axes: its diagonal, or three rows.")
        .required()
        .example("[0.001, 0.001, 0.001]"),
};

// The body axes of the file are those of its tensor; the term wants principal axes.
LinearDampingArguments principal_damping(LinearDampingArguments a, const TermContext& at) {
  if (a.coefficients.is_diagonal && at.has_principal_axes()) return a;
  const LinearDamping in_file_axes =
      at.built("coefficients", [&] { return LinearDamping(a.coefficients.matrix, at.body()); });
  return {{at.principal(in_file_axes.matrix()), false}};
}

MadeTerms made_linear_damping(const LinearDampingArguments& a, const TermContext& at) {
  const Mat3& D = a.coefficients.matrix;
  return at.built("coefficients", [&]() -> AnyPerturbation {
    if (a.coefficients.is_diagonal)
      return {at.name("damping"), LinearDamping(Vec3{D(0, 0), D(1, 1), D(2, 2)})};
    return {at.name("damping"), LinearDamping(D, at.body())};
  });
}

}  // namespace

PerturbationKind damping_kind() {
  PerturbationKind kind = perturbation_kind<LinearDampingArguments>(
      "damping", "A torque against the angular velocity, in proportion to it.", linear_damping_keys,
      made_linear_damping, {}, principal_damping);
  kind.on_body = true;
  kind.class_name = "LinearDamping";
  kind.equations = "u = -D w, w = I^-1 g.";
  return kind;
}

namespace {

struct InternalDampingArguments {
  std::optional<Vec3> k;
  bool grows;
  std::optional<double> wobble_time;
  std::optional<double> rate;
};

constexpr KindKey<InternalDampingArguments> internal_damping_keys[] = {
    quantity_key<&InternalDampingArguments::k>(
        "k", Dimension::number,
        "Of v = k g x omega, along the principal axes; in one over momentum.")
        .alternative()
        .example("[0.01, 0.01, 0.01]"),
    flag_key<&InternalDampingArguments::grows>(
        "grows", "Whether k is multiplied by the momentum; it is then in one over its square.")
        .otherwise("false"),
    quantity_key<&InternalDampingArguments::wobble_time>(
        "wobble_time", Dimension::time,
        "Time in which a small wobble about the axis of the largest moment falls by e.")
        .alternative()
        .example("\"100 d\"")
        .positive(),
    quantity_key<&InternalDampingArguments::rate>(
        "rate", Dimension::rate, "The rate of rotation about that axis at which it does.")
        .alternative()
        .example("\"360 deg/d\"")
        .positive(),
};

InternalDampingArguments principal_internal_damping(InternalDampingArguments a,
                                                    const TermContext& at) {
  if (a.k) return a;
  if (a.grows) at.refuse("grows", "expected a key k as well");
  const Vec3& I = at.body().moments();
  a.k = at.built("kind", [&] {
    return InternalDamping::of_wobble(at.body(), *a.wobble_time,
                                      *a.rate * std::max({I.x, I.y, I.z}))
        .coefficients();
  });
  a.wobble_time = a.rate = std::nullopt;
  return a;
}

MadeTerms made_internal_damping(const InternalDampingArguments& a, const TermContext& at) {
  return at.built("k", [&]() -> AnyPerturbation {
    return {at.name("internal damping"), InternalDamping(*a.k, a.grows)};
  });
}

}  // namespace

PerturbationKind internal_damping_kind() {
  PerturbationKind kind = perturbation_kind<InternalDampingArguments>(
      "internal-damping", "Friction inside the body: energy falls, angular momentum stays.",
      internal_damping_keys, made_internal_damping, {}, principal_internal_damping);
  kind.on_body = true;
  kind.sets = "wobble_time+rate|k";
  kind.equations =
      "v = k g x w, w = I^-1 g: no torque, and I^-1 g + v is the angular velocity. For\n"
      "I = (A, A, C) the angle J from axis 3 to g obeys\n"
      "tan J = tan J0 exp(-k (C - A) G^2 t / (A C)).";
  return kind;
}

namespace {

constexpr KindKey<DampedMaterial> anelastic_damping_keys[] = {
    body_radius_key<&DampedMaterial::radius>(),
    quantity_key<&DampedMaterial::rigidity>("rigidity", Dimension::pressure,
                                            "Of the material of the body.")
        .required()
        .example("\"1 GPa\"")
        .positive(),
    quantity_key<&DampedMaterial::quality_factor>("quality_factor", Dimension::number,
                                                  "Q of its oscillations.")
        .required()
        .example("100")
        .positive(),
    quantity_key<&DampedMaterial::density>("body_density", Dimension::density,
                                           "Mean density of the body.")
        .required()
        .example("\"2000 kg/m3\"")
        .positive(),
    quantity_key<&DampedMaterial::shape_factor>(
        "shape_factor", Dimension::number,
        "K3 squared: about 0.1 for elongated bodies, 0.01 for nearly spherical ones.")
        .otherwise("0.1")
        .positive(),
};

MadeTerms made_anelastic_damping(const DampedMaterial& material, const TermContext& at) {
  return at.built("kind", [&]() -> AnyPerturbation {
    return {at.name("internal damping"), InternalDamping::of_material(at.body(), material)};
  });
}

}  // namespace

PerturbationKind anelastic_damping_kind() {
  PerturbationKind kind = perturbation_kind<DampedMaterial>(
      "anelastic-damping", "Friction inside the body, from the material that it is made of.",
      anelastic_damping_keys, made_anelastic_damping,
      {{"burns1973",
        "Burns, J. A., Safronov, V. S. (1973). Asteroid nutation angles. Monthly Notices of the "
        "Royal Astronomical Society 165, 403-411.",
        "the time in which a wobble dies"}});
  kind.on_body = true;
  kind.equations =
      "As InternalDamping with k in proportion to |g|: a small wobble falls by e in\n"
      "wobble_time(material, rate) at any rate.";
  return kind;
}

namespace {

// A Kane damper is no term: a scenario has at most one.
struct KaneDamperArguments {
  double sphere_moment;
  double friction;
  std::optional<Vec3> rate_relative;
};

constexpr KindKey<KaneDamperArguments> kane_damper_keys[] = {
    quantity_key<&KaneDamperArguments::sphere_moment>(
        "sphere_moment", Dimension::moment,
        "Moment of inertia of the sphere about its centre; the moments of the body are those of "
        "both.")
        .required()
        .example("0.1"),
    quantity_key<&KaneDamperArguments::friction>(
        "friction", Dimension::damping, "Torque on the sphere per rate relative to the body.")
        .required()
        .example("0.01"),
    quantity_key<&KaneDamperArguments::rate_relative>(
        "rate_relative", Dimension::rate,
        "Rate of the sphere relative to the body at t = 0, along the body axes; left out, it turns "
        "with the body.")
        .example("[0.0, 0.0, 0.0]"),
};

MadeTerms made_kane_damper(const KaneDamperArguments& a, const TermContext& at) {
  if (!(a.friction >= 0.0)) at.refuse("friction", "expected a friction that is not negative");
  const KaneDamper damper = at.built("sphere_moment", [&] {
    const KaneDamper one(a.sphere_moment, a.friction);
    one.require_room(at.body());
    return one;
  });
  return DamperAtStart{damper, a.rate_relative ? at.principal(*a.rate_relative) : Vec3{}};
}

}  // namespace

PerturbationKind kane_damper_kind() {
  PerturbationKind kind = perturbation_kind<KaneDamperArguments>(
      "kane-damper", "A sphere in a cavity of the body, with viscous friction between them.",
      kane_damper_keys, made_kane_damper,
      {{"kane1966",
        "Kane, T. R., Barba, P. M. (1966). Effects of energy dissipation on a spinning satellite. "
        "AIAA Journal 4, 1392-1394.",
        "a sphere in a cavity that damps"}});
  kind.has_terms = false;
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
