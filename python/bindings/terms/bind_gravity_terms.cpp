// SPDX-License-Identifier: MIT
// Gravity beyond the gradient of a point mass, and tides.
#include "polhode/perturb/higher_gravity.hpp"
#include "polhode/perturb/oblate_gravity.hpp"
#include "polhode/perturb/tidal_torque.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

MassMoments of_points(ArrayLike masses, ArrayLike positions) {
  Numbers both[] = {Numbers(masses, "masses"), Numbers(positions, "positions", {3})};
  const Shape shape = broadcast(both);
  std::vector<PointMass> points;
  for (std::size_t k = 0; k < size_of(shape); ++k) {
    const double* x = both[1].at(k);
    points.push_back({both[0][k], {x[0], x[1], x[2]}});
  }
  return mass_moments<double>(points);
}

void bind_moments(nb::module_& m) {
  using M = MassMoments;
  bind_value<M>(m, "MassMoments",
                R"(Inertia integrals of degree 3 and 4: of x^a y^b z^c dm from the centre of mass.

Parameters
----------
third : (10,), mass length^3, in the order xxx xxy xxz xyy xyz xzz yyy yyz yzz zzz.
fourth : (15,), mass length^4: xxxx xxxy xxxz xxyy xxyz xxzz xyyy xyyz xyzz xzzz yyyy yyyz yyzz
    yzzz zzzz.)",
                field("third", &M::third, "(10,): of degree 3."),
                field("fourth", &M::fourth, "(15,): of degree 4."))
      .def_static("of_points", of_points, "masses"_a, "positions"_a,
                  "Of point masses: (n,) or one number, and positions (n, 3), which are taken as "
                  "they are: from the centre of mass.")
      .def(
          "rotated",
          [](const M& self, ArrayLike matrix) { return rotated(self, mat3(matrix, "matrix")); },
          "matrix"_a, "Along the axes in which x becomes matrix @ x, a rotation (3, 3).");
}

void bind_higher(nb::module_& m) {
  nb::enum_<OrbitOf>(m, "OrbitOf", "Whose path an orbit is, as seen from the other.",
                     nb::is_arithmetic())
      .value("attractor", OrbitOf::attractor, "the attracting mass as seen from the body")
      .value("body", OrbitOf::body, "the body as seen from the attracting mass");
  bind_term<"HigherGravity">(
      m,
      R"(What a point mass does to a body's moments of degree 3 and 4.

From H' = -gm integral dm / |r - x|, degrees 3 and 4 of the series in 1/r. Degree 2 is not here: add
GravityGradient as well.)",
      "",
      [](Making& at, double gm, nb::handle orbit, const auto& moments, OrbitOf of, SpaceAxes axes) {
        return along(at, orbit, [&](const auto& o) {
          return HigherGravity(gm, o, nb::cast<const MassMoments&>(moments), of, axes);
        });
      },
      argument<double>("gm",
                       "of the attracting point mass, length^3 / time^2. ValueError unless "
                       "positive."),
      argument<Orbit>("orbit", "as for GravityGradient."),
      argument<MassMoments>("moments",
                            "MassMoments about the centre of mass along the principal "
                            "axes of the body."),
      argument<OrbitOf>("orbit_of",
                        "OrbitOf or its name: degree 3 changes sign with the direction "
                        "of the orbit."),
      argument<SpaceAxes>("axes", "of the orbit: SpaceAxes, or its name.", "inertial"),
      term_name());
}

void bind_oblate(nb::module_& m) {
  using O = Oblateness;
  bind_value<O>(
      m, "Oblateness",
      "J2 of an attracting body, the equatorial radius that it belongs to, and its "
      "pole (3,), of any length, along the axes of the orbit.",
      field("J2", &O::J2, "A pure number."), field("radius", &O::radius, "A length."),
      field("pole", &O::pole, "(3,): the axis of figure.", nb::make_tuple(0.0, 0.0, 1.0)));
  bind_term<"OblateGravity">(
      m,
      R"(What the J2 of the attracting body adds to the gravity gradient.

The field is -gm / r (1 - J2 (R / r)^2 P2(sin latitude)); its part in J2 acts on the moments of
inertia. The point mass is not here: add GravityGradient as well.)",
      "",
      [](Making& at, double gm, nb::handle orbit, const auto& oblateness, SpaceAxes axes) {
        return along(at, orbit, [&](const auto& o) {
          return OblateGravity(gm, o, nb::cast<const O&>(oblateness), axes);
        });
      },
      argument<double>("gm", "of the attracting body. ValueError unless positive."),
      argument<Orbit>("orbit", "as for GravityGradient."),
      argument<O>("oblateness",
                  "Oblateness. ValueError for a radius that is not positive, for a "
                  "pole of length 0."),
      argument<SpaceAxes>("axes", "of the orbit and the pole: SpaceAxes, or its name.", "inertial"),
      term_name());
}

void bind_tide(nb::module_& m) {
  using B = TidalBody;
  bind_value<B>(m, "TidalBody",
                "What lags: the Love number k2, the time lag, and the radius that k2 belongs to.",
                field("k2", &B::k2, "A pure number."), field("lag", &B::lag, "A time."),
                field("radius", &B::radius, "A length."));
  bind_term<"TidalTorque">(
      m,
      R"(The torque on a tidal bulge that lags by a constant time (Mignard).

u = 3 k2 gm M R^5 lag / r^8 ((r.w) r - r^2 w + r x dr/dt), w = I^-1 g.)",
      "ValueError unless gm, mass and the radius are positive, k2 and the lag not negative.",
      [](Making& at, double gm, double mass, nb::handle orbit, const auto& body) {
        const AnyPythonOrbit any = orbit_of(orbit, at.label + ": orbit", at.functions);
        return std::visit(
            [&](const auto& o) -> AnyPerturbation {
              if constexpr (OrbitOn<std::remove_cvref_t<decltype(o)>, Dual<double, 1>>)
                return {at.name, TidalTorque(gm, mass, o, nb::cast<const B&>(body))};
              else
                throw nb::type_error((at.label + ": orbit: got " + class_name(orbit) +
                                      "; expected an orbit with a velocity, as KeplerOrbit")
                                         .c_str());
            },
            any);
      },
      argument<double>("gm", "of the perturbing point mass, length^3 / time^2."),
      argument<double>("mass", "its mass, in the unit of the moments over length^2."),
      argument<MovingOrbit>("orbit",
                            "any orbit but a callable, in inertial axes; TypeError for what "
                            "has no velocity."),
      argument<B>("body", "TidalBody."), term_name());
}

}  // namespace

void bind_gravity_terms(nb::module_& m) {
  bind_moments(m);
  bind_higher(m);
  bind_oblate(m);
  bind_tide(m);
}

}  // namespace polhode::python
