// SPDX-License-Identifier: MIT
// Magnetic fields, the residual dipole and eddy currents.
#include "charts/states.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

// Python's f(t), or f(t, x) where there is an orbit: on double alone.
class FunctionField {
 public:
  FunctionField(SharedFunction function, std::optional<AnyPythonOrbit> orbit)
      : function_(std::move(function)), orbit_(std::move(orbit)) {}

  static bool has_rate() { return false; }

  Vec3 field(const double& t, const double&) const {
    constexpr const char* expected = "3 numbers, the field along inertial axes";
    std::optional<Vec3> x;
    if (orbit_) x = std::visit([&](const auto& o) { return o.position(t); }, *orbit_);
    const WithGil acquired;
    if (!x) return function_->three_numbers((*function_)(t), expected);
    return function_->three_numbers((*function_)(t, array_of(*x)), expected);
  }
  BasicFieldMotion<double> motion(const double& t, const double& rest) const {
    return {field(t, rest), {}};
  }

 private:
  SharedFunction function_;
  std::optional<AnyPythonOrbit> orbit_;
};

// The field at the place of the body, given to `made`, which makes a term of it.
template <class Made>
AnyPerturbation with_field(Making& at, nb::handle field, nb::handle orbit, const Made& made) {
  std::optional<AnyPythonOrbit> path;
  if (!orbit.is_none()) path = orbit_of(orbit, at.label + ": orbit", at.functions);
  if (nb::isinstance<DipoleField>(field)) {
    if (!path) throw nb::value_error((at.label + ": a DipoleField needs an orbit").c_str());
    const auto& dipole = nb::cast<const DipoleField&>(field);
    return std::visit([&](const auto& motion) { return made(FieldAlongOrbit(motion, dipole)); },
                      *path);
  }
  if (PyCallable_Check(field.ptr()) == 0) return made(ConstantField(vec3(field, "field")));
  at.functions.push_back(std::make_shared<PythonFunction>(field, at.label + ": field"));
  return made(FunctionField(at.functions.back(), path));
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
  ;
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

using FieldLike =
    Typed<"DipoleField | numpy.typing.ArrayLike | typing.Callable[..., numpy.typing.ArrayLike]">;

auto field_argument() {
  return argument<FieldLike>(
      "field",
      "DipoleField; 3 numbers, a constant field along inertial axes; or a function, f(t) -> 3 "
      "numbers, f(t, x) with the position x where an orbit is given.");
}
auto orbit_argument() {
  return argument<Any>("orbit",
                       "as for GravityGradient, inertial axes: the position of the body or, for a "
                       "DipoleField, of the "
                       "primary. None for a field without a place.",
                       nb::none());
}

void bind_dipole(nb::module_& m) {
  bind_term<"ResidualDipole">(
      m, "The torque m x B on a magnetic moment of the body.\n\nH' = -m.B.", "",
      [](Making& at, const Vec3& moment, nb::handle field, nb::handle orbit) {
        return with_field(at, field, orbit, [&](const auto& local) {
          return AnyPerturbation(at.name, ResidualDipole(moment, local));
        });
      },
      argument<Vec3>("moment", "(3,), m along the principal body axes, torque per field."),
      field_argument(), orbit_argument(), term_name());
}

void bind_eddy(nb::module_& m) {
  bind_term<"EddyCurrents">(
      m,
      R"(The torque on the eddy currents in a conducting body that turns in a magnetic field.

u = (M (w x B - dB/dt)) x B, w = I^-1 g, dB/dt along the orbit.)",
      "",
      [](Making& at, const Tensor& tensor, nb::handle field, nb::handle orbit, bool has_rate) {
        const FieldRate rate = has_rate ? FieldRate::along_orbit : FieldRate::left_out;
        return with_field(at, field, orbit, [&](const auto& local) {
          return AnyPerturbation(at.name, EddyCurrents(tensor.matrix, local, rate));
        });
      },
      argument<Tensor>("tensor",
                       "M, one number, the diagonal (3,) in principal body axes, or a symmetric "
                       "matrix (3, 3) that drives no motion; torque per rate and field squared."),
      field_argument(), orbit_argument(),
      argument<bool>(
          "field_rate",
          "whether dB/dt counts; False: u = (M (w x B)) x B. A function in Python has no "
          "derivative: ValueError unless False.",
          true),
      term_name());
}

}  // namespace

void bind_magnetic(nb::module_& m) {
  bind_field(m);
  bind_dipole(m);
  bind_eddy(m);
}

}  // namespace polhode::python
