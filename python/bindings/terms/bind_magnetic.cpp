// SPDX-License-Identifier: MIT
// Magnetic fields, the residual dipole and eddy currents.
#include "charts/states.hpp"
#include "interface/value.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "terms/term_binding.hpp"

namespace polhode::python {

namespace {

struct ResidualDipoleTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct EddyCurrentsTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};

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
AnyPerturbation with_field(nb::handle field, nb::handle orbit, const std::string& label,
                           std::vector<SharedFunction>& functions, const Made& made) {
  std::optional<AnyPythonOrbit> path;
  if (!orbit.is_none()) path = orbit_of(orbit, label + ": orbit", functions);
  if (nb::isinstance<DipoleField>(field)) {
    if (!path) throw nb::value_error((label + ": a DipoleField needs an orbit").c_str());
    const auto& dipole = nb::cast<const DipoleField&>(field);
    return std::visit([&](const auto& motion) { return made(FieldAlongOrbit(motion, dipole)); },
                      *path);
  }
  if (PyCallable_Check(field.ptr()) == 0) return made(ConstantField(vec3(field, "field")));
  functions.push_back(std::make_shared<PythonFunction>(field, label + ": field"));
  return made(FunctionField(functions.back(), path));
}

// A number, a diagonal or a matrix.
Mat3 tensor_of(nb::handle tensor) {
  const Numbers any(tensor, "tensor");
  if (any.shape() == Shape{3, 3}) return mat3(tensor, "tensor");
  Vec3 d;
  if (any.shape().empty()) {
    d = {any[0], any[0], any[0]};
  } else if (any.shape() == Shape{3}) {
    d = vec3(tensor, "tensor");
  } else {
    throw nb::value_error(("EddyCurrents: tensor: got shape " + text_of(any.shape()) +
                           "; expected (), (3,) or (3, 3)")
                              .c_str());
  }
  return {{{d.x, 0.0, 0.0}, {0.0, d.y, 0.0}, {0.0, 0.0, d.z}}};
}

PrimaryRotation primary_of(nb::handle pole, double rate, double meridian, double epoch) {
  return {vec3(pole, "pole"), rate, meridian, epoch};
}

nb::tuple arguments_of(const DipoleField& d) {
  const PrimaryRotation& p = d.primary();
  return nb::make_tuple(tuple_of(d.strength()), tuple_of(p.pole), p.rate, p.meridian, p.epoch);
}

void bind_field(nb::module_& m) {
  using F = DipoleField;
  nb::class_<F> c(m, "DipoleField", R"(The dipole field of a primary that turns.

B = (3 (K.n) n - K) / r^3, n = x / r; K turns with the primary.

Parameters
----------
strength : (3,), K = mu_0 m / (4 pi) along the axes of the primary, field times length^3.
pole : (3,), of any length, in inertial axes: axis 3 of the primary, about which it turns.
rate : of the turning, rad per time.
meridian : angle of axis 1 of the primary at `epoch`, from inertial axis 1 where the pole is axis 3
    (the Earth: Greenwich sidereal time), else from the ascending node of its equator.
epoch : time of the meridian.

ValueError for numbers that are not finite, and for a pole of no length.)");
  c.def(
       "__init__",
       [](F* self, ArrayLike strength, ArrayLike pole, double rate, double meridian, double epoch) {
         new (self) F(vec3(strength, "strength"), primary_of(pole, rate, meridian, epoch));
       },
       nb::arg("strength"), nb::arg("pole") = nb::make_tuple(0.0, 0.0, 1.0), nb::arg("rate") = 0.0,
       nb::arg("meridian") = 0.0, nb::arg("epoch") = 0.0)
      .def_static(
          "from_gauss",
          [](double g10, double g11, double h11, double reference_radius, ArrayLike pole,
             double rate, double meridian, double epoch) {
            return F::from_gauss({g10, g11, h11}, reference_radius,
                                 primary_of(pole, rate, meridian, epoch));
          },
          nb::arg("g10"), nb::arg("g11"), nb::arg("h11"), nb::arg("reference_radius"),
          nb::arg("pole") = nb::make_tuple(0.0, 0.0, 1.0), nb::arg("rate") = 0.0,
          nb::arg("meridian") = 0.0, nb::arg("epoch") = 0.0,
          "From the Gauss coefficients of degree one, as the IGRF lists them, with their radius.")
      .def(
          "field",
          [](const F& f, double t, ArrayLike x) { return array_of(f.field(t, vec3(x, "x"))); },
          nb::arg("t"), nb::arg("x"), "(3,): B at the time t and the place x (3,), inertial axes.")
      .def_prop_ro(
          "strength", [](const F& f) { return array_of(f.strength()); },
          "(3,): K along the axes of the primary.")
      .def_prop_ro(
          "pole", [](const F& f) { return array_of(f.primary().pole); }, "(3,): as given.")
      .def_prop_ro(
          "rate", [](const F& f) { return f.primary().rate; }, "Of the turning, rad per time.")
      .def_prop_ro(
          "meridian", [](const F& f) { return f.primary().meridian; }, "At the epoch, rad.")
      .def_prop_ro(
          "epoch", [](const F& f) { return f.primary().epoch; }, "Time of the meridian.")
      .def("__repr__", [](const F& f) {
        return "DipoleField" + nb::cast<std::string>(nb::repr(arguments_of(f)));
      });
  def_value(c, [](const F& f) { return arguments_of(f); });
}

constexpr const char* field_parameters =
    R"(field : DipoleField; 3 numbers, a constant field along inertial axes; or a function,
    f(t) -> 3 numbers, f(t, x) with the position x where an orbit is given.
orbit : as for GravityGradient, inertial axes: the position of the body or, for a DipoleField, of
    the primary. None for a field without a place.
name : stands in messages.
)";

void bind_dipole(nb::module_& m) {
  using C = ResidualDipoleTerm;
  static const std::string text = std::string(R"(The torque m x B on a magnetic moment of the body.

H' = -m.B.

Parameters
----------
moment : (3,), m along the principal body axes, torque per field.
)") + field_parameters;
  nb::class_<C, PythonTerm> c(m, "ResidualDipole", text.c_str(), nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, ArrayLike moment,
          Typed<
              "DipoleField | numpy.typing.ArrayLike | typing.Callable[..., numpy.typing.ArrayLike]">
              field,
          Any orbit, Text name) {
         const std::string called = name_of(name, "ResidualDipole");
         const Vec3 m_B = vec3(moment, "moment");
         std::vector<SharedFunction> functions;
         const AnyPerturbation term = with_field(
             field, orbit, labelled("ResidualDipole", called), functions, [&](const auto& local) {
               return AnyPerturbation(called, ResidualDipole(m_B, local));
             });
         new (self)
             C(term, recipe_of("", {"moment", "field", "orbit", "name"},
                               nb::make_tuple(tuple_of(m_B), field, orbit, name), functions));
       },
       nb::arg("moment"), nb::arg("field"), nb::arg("orbit") = nb::none(),
       nb::arg("name") = nb::none())
      .def_prop_ro(
          "moment", [](const C& term) { return array_of(vec3(term.recipe.argument(0), "moment")); },
          "(3,): m along the principal body axes.")
      .def_prop_ro("field", given<1, "typing.Any">, "As given.")
      .def_prop_ro("orbit", given<2, "typing.Any">, "As given.");
  def_term<C>(c);
}

void bind_eddy(nb::module_& m) {
  using C = EddyCurrentsTerm;
  static const std::string text =
      std::string(
          R"(The torque on the eddy currents in a conducting body that turns in a magnetic field.

u = (M (w x B - dB/dt)) x B, w = I^-1 g, dB/dt along the orbit.

Parameters
----------
tensor : M, one number, the diagonal (3,) in principal body axes, or a symmetric matrix (3, 3) that
    drives no motion; torque per rate and field squared.
)") + field_parameters +
      R"(field_rate : whether dB/dt counts; False: u = (M (w x B)) x B. A function in Python has no
    derivative: ValueError unless False.
)";
  nb::class_<C, PythonTerm> c(m, "EddyCurrents", text.c_str(), nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, ArrayLike tensor,
          Typed<
              "DipoleField | numpy.typing.ArrayLike | typing.Callable[..., numpy.typing.ArrayLike]">
              field,
          Any orbit, bool field_rate, Text name) {
         const std::string called = name_of(name, "EddyCurrents");
         const Mat3 M = tensor_of(tensor);
         const FieldRate rate = field_rate ? FieldRate::along_orbit : FieldRate::left_out;
         std::vector<SharedFunction> functions;
         const AnyPerturbation term = with_field(
             field, orbit, labelled("EddyCurrents", called), functions, [&](const auto& local) {
               return AnyPerturbation(called, EddyCurrents(M, local, rate));
             });
         new (self) C(term, recipe_of("", {"tensor", "field", "orbit", "field_rate", "name"},
                                      nb::make_tuple(rows_of(M), field, orbit, field_rate, name),
                                      functions));
       },
       nb::arg("tensor"), nb::arg("field"), nb::arg("orbit") = nb::none(),
       nb::arg("field_rate") = true, nb::arg("name") = nb::none())
      .def_prop_ro(
          "tensor", [](const C& term) { return array_of(mat3(term.recipe.argument(0), "tensor")); },
          "(3, 3): M in principal body axes.")
      .def_prop_ro("field", given<1, "typing.Any">, "As given.")
      .def_prop_ro("orbit", given<2, "typing.Any">, "As given.")
      .def_prop_ro(
          "field_rate", [](const C& term) { return nb::cast<bool>(term.recipe.argument(3)); },
          "Whether the rate of the field along the orbit counts.");
  def_term<C>(c);
}

}  // namespace

void bind_magnetic(nb::module_& m) {
  bind_field(m);
  bind_dipole(m);
  bind_eddy(m);
}

}  // namespace polhode::python
