// SPDX-License-Identifier: MIT
// [[perturbation]] kind = "gravity-gradient": a point mass, and what the table adds to it.
#include "polhode/perturb/gravity_gradient.hpp"

#include <array>
#include <optional>
#include <string>
#include <variant>

#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct Arguments {
  std::string orbit;
  std::optional<double> gm;
  std::optional<std::array<double, 10>> third_moments;
  std::optional<std::array<double, 15>> fourth_moments;
  OrbitOf orbit_of;
  std::optional<double> J2;
  std::optional<Vec3> pole;
  std::optional<double> primary_radius;
  SpaceAxes axes;
};

constexpr KindKey<Arguments> keys[] = {
    orbit_key<&Arguments::orbit>(),
    gm_key<&Arguments::gm>(),
    quantity_key<&Arguments::third_moments>(
        "third_moments", Dimension::moment3,
        "Integrals of x^a y^b z^c dm of degree 3 from the centre of mass along the body axes, in "
        "the order xxx xxy xxz xyy xyz xzz yyy yyz yzz zzz.")
        .example("[0, 0, 0, 0, 0, 0, 0, 0, 0, 0]"),
    quantity_key<&Arguments::fourth_moments>(
        "fourth_moments", Dimension::moment4,
        "The same of degree 4: xxxx xxxy xxxz xxyy xxyz xxzz xyyy xyyz xyzz xzzz yyyy yyyz yyzz "
        "yzzz zzzz.")
        .example("[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]"),
    orbit_of_key<&Arguments::orbit_of, OrbitOf::body, OrbitOf::attractor>(),
    quantity_key<&Arguments::J2>("J2", Dimension::number, "Oblateness of the attracting body.")
        .example("1.08263e-3"),
    pole_key<&Arguments::pole>(),
    quantity_key<&Arguments::primary_radius>(
        "primary_radius", Dimension::length,
        "Equatorial radius of the attracting body, that J2 belongs to.")
        .example("\"6378.137 km\""),
    axes_key<&Arguments::axes>(),
};

Arguments principal(Arguments a, const TermContext& at) {
  at.orbit("orbit");  // named first if both are wrong
  a.gm = at.gm("gm", "orbit");
  if (!a.J2) {
    for (const char* const key : {"primary_radius", "pole"})
      if (at.is_explicit(key)) at.refuse(key, "expected a key J2 as well");
    a.pole.reset();
  }
  if (at.has_principal_axes()) return a;
  const Mat3 R = rotation_matrix(conj(at.q_FB()));
  if (a.third_moments)
    a.third_moments = shape::rotated(shape::MassMoments{*a.third_moments, {}}, R).third;
  if (a.fourth_moments)
    a.fourth_moments = shape::rotated(shape::MassMoments{{}, *a.fourth_moments}, R).fourth;
  return a;
}

// None where the table has no moments.
std::optional<shape::MassMoments> moments_of(const Arguments& a) {
  if (!a.third_moments && !a.fourth_moments) return std::nullopt;
  return shape::MassMoments{a.third_moments.value_or(std::array<double, 10>{}),
                            a.fourth_moments.value_or(std::array<double, 15>{})};
}

void require_side(const Arguments& a, const TermContext& at) {
  if (a.third_moments && !at.is_explicit("orbit_of"))
    at.refuse("third_moments",
              "expected a key orbit_of as well, \"body\" or \"attractor\": whose path the orbit is "
              "as seen from the other, since gravity of degree 3 changes sign with it");
}

std::optional<Oblateness> oblateness_of(const Arguments& a, const TermContext& at) {
  if (!a.J2) return std::nullopt;
  if (!a.primary_radius)
    at.refuse("J2",
              "expected a key primary_radius as well, the equatorial radius that J2 belongs to");
  require_pole(at, "pole");
  return at.built("J2", [&] { return Oblateness{*a.J2, *a.primary_radius, a.pole.value()}; });
}

// Degree 2 once, and what else the table has.
MadeTerms made(const Arguments& a, const TermContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  const std::optional<shape::MassMoments> moments = moments_of(a);
  require_side(a, at);
  const std::optional<Oblateness> oblate = oblateness_of(a, at);
  const std::string of_orbit = ", orbit " + orbit.name;
  // of the orbit's own type: nothing is called through a pointer in the inner loop
  return std::visit(
      [&](const auto& motion) {
        std::vector<AnyPerturbation> terms;
        terms.emplace_back(at.name("gravity gradient" + of_orbit),
                           GravityGradient(*a.gm, motion, a.axes));
        if (moments)
          terms.emplace_back(at.name("gravity of degrees 3 and 4" + of_orbit),
                             HigherGravity(*a.gm, motion, *moments, a.orbit_of, a.axes));
        if (oblate)
          terms.push_back(at.built("J2", [&]() -> AnyPerturbation {
            return {at.name("gravity of J2" + of_orbit),
                    OblateGravity(*a.gm, motion, *oblate, a.axes)};
          }));
        return terms;
      },
      orbit.motion);
}

}  // namespace

PerturbationKind gravity_gradient_kind() {
  PerturbationKind kind = perturbation_kind<Arguments>(
      "gravity-gradient",
      "Gravity of a point mass, of degree 2; with moments of the body of degrees 3 and 4, and with "
      "the oblateness of what attracts it, where the table has them.",
      keys, made, {}, principal);
  kind.equations =
      "H' = gm / (2 r^3) (3 n.I n - tr I), u = (3 gm / r^3) n x I n, n = r / |r| in body axes.\n"
      "Moments of degrees 3 and 4 add their part of H' = -gm integral dm / |r - x|, J2 that of "
      "the\n"
      "field -gm / r (1 - J2 (R / r)^2 P2(sin latitude)) on the moments of inertia.";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
