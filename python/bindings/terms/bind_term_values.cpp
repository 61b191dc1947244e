// SPDX-License-Identifier: MIT
// Values that terms are described by: moments of mass, a material, a magnetic field.
#include "interface/value.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/magnetic_field.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

shape::MassMoments of_points(ArrayLike masses, ArrayLike positions) {
  Numbers both[] = {Numbers(masses, "masses"), Numbers(positions, "positions", {3})};
  const Shape shape = broadcast(both);
  std::vector<shape::PointMass> points;
  for (std::size_t k = 0; k < size_of(shape); ++k) {
    const double* x = both[1].at(k);
    points.push_back({both[0][k], {x[0], x[1], x[2]}});
  }
  return shape::mass_moments<double>(points);
}

void bind_moments(nb::module_& m) {
  using M = shape::MassMoments;
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
          [](const M& self, ArrayLike matrix) {
            return shape::rotated(self, mat3(matrix, "matrix"));
          },
          "matrix"_a, "Along the axes in which x becomes matrix @ x, a rotation (3, 3).");
}

void bind_material(nb::module_& m) {
  using D = DampedMaterial;
  bind_value<D>(m, "DampedMaterial",
                R"(A material and the size of a body, in the units of the system.

Parameters
----------
rigidity : mu, a pressure.
quality_factor : Q.
density : rho.
radius : the mean one.
shape_factor : K3^2, about 0.1 for elongated bodies, 0.01 for nearly spherical ones.)",
                field("rigidity", &D::rigidity, "mu."),
                field("quality_factor", &D::quality_factor, "Q."),
                field("density", &D::density, "rho."), field("radius", &D::radius, "The mean one."),
                field("shape_factor", &D::shape_factor, "K3^2.", 0.1));
  m.def("wobble_time", &wobble_time, "material"_a, "rate"_a,
        "mu Q / (rho K3^2 R^2 rate^3): the time in which a small wobble about the axis of the "
        "largest moment falls by e at this rate of rotation (Burns and Safronov 1973). ValueError "
        "unless all are positive.");
}

PrimaryRotation primary_of(nb::handle pole, double rate, double meridian, double epoch) {
  return {vec3(pole, "pole"), rate, meridian, epoch};
}

template <auto member>
auto of_primary(const DipoleField& f) {
  return f.primary().*member;
}

void bind_field(nb::module_& m) {
  using F = DipoleField;
  auto c = bind_made_value<F>(
      m, "DipoleField", R"(The dipole field of a primary that turns.

B = (3 (K.n) n - K) / r^3, n = x / r; K turns with the primary.

Parameters
----------
strength : (3,), K = mu_0 m / (4 pi) along the axes of the primary, field times length^3.
pole : (3,), of any length, in inertial axes: axis 3 of the primary, about which it turns.
rate : of the turning, rad per time.
meridian : angle of axis 1 of the primary at `epoch`, from inertial axis 1 where the pole is axis 3
    (the Earth: Greenwich sidereal time), else from the ascending node of its equator.
epoch : time of the meridian.

ValueError for numbers that are not finite, and for a pole of no length.)",
      [](const Vec3& strength, const Vec3& pole, double rate, double meridian, double epoch) {
        return F(strength, PrimaryRotation{pole, rate, meridian, epoch});
      },
      field("strength", &F::strength, "(3,): K along the axes of the primary."),
      field("pole", of_primary<&PrimaryRotation::pole>, "(3,): as given.",
            nb::make_tuple(0.0, 0.0, 1.0)),
      field("rate", of_primary<&PrimaryRotation::rate>, "Of the turning, rad per time.", 0.0),
      field("meridian", of_primary<&PrimaryRotation::meridian>, "At the epoch, rad.", 0.0),
      field("epoch", of_primary<&PrimaryRotation::epoch>, "Time of the meridian.", 0.0));
  c.def_static(
       "from_gauss",
       [](double g10, double g11, double h11, double reference_radius, ArrayLike pole, double rate,
          double meridian, double epoch) {
         return F::from_gauss({g10, g11, h11}, reference_radius,
                              primary_of(pole, rate, meridian, epoch));
       },
       "g10"_a, "g11"_a, "h11"_a, "reference_radius"_a, "pole"_a = nb::make_tuple(0.0, 0.0, 1.0),
       "rate"_a = 0.0, "meridian"_a = 0.0, "epoch"_a = 0.0,
       "From the Gauss coefficients of degree one, as the IGRF lists them, with their radius.")
      .def(
          "field",
          [](const F& f, double t, ArrayLike x) { return array_of(f.field(t, vec3(x, "x"))); },
          "t"_a, "x"_a, "(3,): B at the time t and the place x (3,), inertial axes.");
}

}  // namespace

void bind_term_values(nb::module_& m) {
  bind_moments(m);
  bind_material(m);
  bind_field(m);
}

}  // namespace polhode::python
