// SPDX-License-Identifier: MIT
// Kepler orbits, and Python functions that serve as orbits.
#include "batch.hpp"
#include "dual_number.hpp"
#include "orbit_value.hpp"
#include "polhode/error.hpp"
#include "value.hpp"

namespace polhode::python {

namespace {

constexpr const char* three_numbers = "3 numbers, a position";

nb::tuple arguments_of(const KeplerElements& e) {
  return nb::make_tuple(e.gm, e.pericentre, e.eccentricity, e.inclination, e.node, e.argument,
                        e.mean_anomaly, e.epoch);
}

std::string repr_of(const KeplerElements& e) {
  return "KeplerElements(gm=" + number_text(e.gm) + ", pericentre=" + number_text(e.pericentre) +
         ", eccentricity=" + number_text(e.eccentricity) +
         ", inclination=" + number_text(e.inclination) + ", node=" + number_text(e.node) +
         ", argument=" + number_text(e.argument) + ", mean_anomaly=" + number_text(e.mean_anomaly) +
         ", epoch=" + number_text(e.epoch) + ")";
}

void bind_elements(nb::module_& m) {
  using E = KeplerElements;
  nb::class_<E> c(m, "KeplerElements",
                  R"(The elements of an ellipse or a hyperbola about a point mass.

Parameters
----------
gm : gravitational parameter, length^3 / time^2.
pericentre : distance a (1 - e); pericentre_distance(a, e) makes it.
eccentricity : 0 <= e < 1 or e > 1.
inclination, node, argument : rad; argument of the pericentre from the node.
mean_anomaly : rad, at `epoch`; 0 where the epoch is a time of pericentre.
epoch : time.

Any consistent units. ValueError for elements of no orbit.)");
  c.def(
       "__init__",
       [](E* self, double gm, double pericentre, double eccentricity, double inclination,
          double node, double argument, double mean_anomaly, double epoch) {
         const E e{gm, pericentre, eccentricity, inclination, node, argument, mean_anomaly, epoch};
         require_valid(e, "KeplerElements");
         new (self) E(e);
       },
       nb::arg("gm"), nb::arg("pericentre"), nb::arg("eccentricity"), nb::arg("inclination") = 0.0,
       nb::arg("node") = 0.0, nb::arg("argument") = 0.0, nb::arg("mean_anomaly") = 0.0,
       nb::arg("epoch") = 0.0)
      .def_ro("gm", &E::gm, "Gravitational parameter, length^3 / time^2.")
      .def_ro("pericentre", &E::pericentre, "Distance a (1 - e).")
      .def_ro("eccentricity", &E::eccentricity, "e; above 1 for a hyperbola.")
      .def_ro("inclination", &E::inclination, "rad.")
      .def_ro("node", &E::node, "Longitude of the ascending node, rad.")
      .def_ro("argument", &E::argument, "Of the pericentre, from the node, rad.")
      .def_ro("mean_anomaly", &E::mean_anomaly, "At the epoch, rad.")
      .def_ro("epoch", &E::epoch, "Time of the mean anomaly.")
      .def("__repr__", [](const E& e) { return repr_of(e); });
  def_value(c, [](const E& e) { return arguments_of(e); });
  m.def("mean_motion", &mean_motion, nb::arg("elements"), "n = sqrt(gm / |a|^3), rad per time.");
  m.def("semi_major_axis", &semi_major_axis, nb::arg("elements"),
        "a = pericentre / (1 - e): negative for a hyperbola.");
  m.def("pericentre_distance", &pericentre_distance, nb::arg("semi_major_axis"),
        nb::arg("eccentricity"), "a (1 - e): the pericentre that KeplerElements asks for.");
}

void bind_rates(nb::module_& m) {
  using R = SecularRates;
  nb::class_<R> c(m, "SecularRates",
                  "Uniform rates (rad per time) of node, argument of the pericentre and mean "
                  "anomaly; the last beside the mean motion.");
  c.def(
       "__init__",
       [](R* self, double node, double argument, double mean_anomaly) {
         new (self) R{node, argument, mean_anomaly};
       },
       nb::arg("node") = 0.0, nb::arg("argument") = 0.0, nb::arg("mean_anomaly") = 0.0)
      .def_ro("node", &R::node, "Of the node, rad per time.")
      .def_ro("argument", &R::argument, "Of the argument of the pericentre, rad per time.")
      .def_ro("mean_anomaly", &R::mean_anomaly,
              "Of the mean anomaly beside the mean motion, rad per time.")
      .def("__repr__", [](const R& r) {
        return "SecularRates(node=" + number_text(r.node) +
               ", argument=" + number_text(r.argument) +
               ", mean_anomaly=" + number_text(r.mean_anomaly) + ")";
      });
  def_value(c, [](const R& r) { return nb::make_tuple(r.node, r.argument, r.mean_anomaly); });
  m.def("j2_rates", &j2_rates, nb::arg("elements"), nb::arg("J2"), nb::arg("equatorial_radius"),
        "SecularRates of first order about an oblate body: its J2, its equatorial radius in the "
        "unit of length of the elements, whose inclination is against its equator. ValueError for "
        "a hyperbola.");
}

struct Position {
  template <class O, class T>
  auto operator()(const O& orbit, const T& t) const {
    return orbit.position(t);
  }
};
struct Velocity {
  template <class O, class T>
  auto operator()(const O& orbit, const T& t) const {
    return orbit.velocity(t);
  }
};

// At times of any shape, or at a time that carries derivatives: for frames that follow an orbit.
template <class Of, class O>
nb::object along(const O& orbit, nb::handle t) {
  if (nb::isinstance<PythonDual>(t))
    return std::visit(
        [&](const auto& at) -> nb::object {
          using D = std::decay_t<decltype(at)>;
          constexpr bool second = std::same_as<O, PrecessingKeplerOrbit> &&
                                  (std::same_as<Of, Velocity> || is_dual<typename D::Scalar>);
          if constexpr (!second)
            return to_python(Of{}(orbit, at));
          else
            throw nb::type_error("PrecessingKeplerOrbit: has no second derivative");
        },
        nb::cast<const PythonDual&>(t).x);
  const Numbers times(t, "t");
  return mapped_numbers(times, {3}, [&](double at) { return Of{}(orbit, at); });
}

std::string signature(const char* name) {
  return std::string("def ") + name +
         "(self, t: numpy.typing.ArrayLike | Dual) -> numpy.typing.NDArray[numpy.float64]";
}

template <class O>
void def_motion(nb::class_<O>& c) {
  c.def(
       "position", [](const O& orbit, nb::handle t) { return along<Position>(orbit, t); },
       nb::arg("t"), nb::sig(signature("position").c_str()),
       "(..., 3) at times t of any shape, in the axes of the elements. NaN in, NaN out. A Dual "
       "gives Duals.")
      .def(
          "velocity", [](const O& orbit, nb::handle t) { return along<Velocity>(orbit, t); },
          nb::arg("t"), nb::sig(signature("velocity").c_str()),
          "(..., 3): the derivative of the position.")
      .def(
          "__call__", [](const O& orbit, nb::handle t) { return along<Position>(orbit, t); },
          nb::arg("t"), nb::sig(signature("__call__").c_str()),
          "position(t): an orbit serves where a function of time does.")
      .def_prop_ro(
          "elements", [](const O& o) { return o.elements(); }, "At their epoch.")
      .def_prop_ro(
          "gm", [](const O& o) { return o.gm(); }, "Gravitational parameter.");
}

void bind_kepler(nb::module_& m) {
  using O = KeplerOrbit;
  nb::class_<O> c(m, "KeplerOrbit", R"(Motion about a point mass, an ellipse or a hyperbola.

KeplerOrbit(elements: KeplerElements), or KeplerOrbit.from_state. Positions to rounding after any
number of orbits.)");
  c.def(nb::init<const KeplerElements&>(), nb::arg("elements"))
      .def_static(
          "from_state",
          [](nb::handle position, nb::handle velocity, double gm, double epoch) {
            return O::from_state(vec3(position, "position"), vec3(velocity, "velocity"), gm, epoch);
          },
          nb::arg("position"), nb::arg("velocity"), nb::arg("gm"), nb::arg("epoch") = 0.0,
          nb::sig("def from_state(position: numpy.typing.ArrayLike, velocity: "
                  "numpy.typing.ArrayLike, gm: float, epoch: float = 0.0) -> KeplerOrbit"),
          "From position (3,) and velocity (3,) at `epoch`. ValueError where their angular "
          "momentum "
          "is 0, or the orbit is a parabola.")
      .def_prop_ro("mean_motion", &O::mean_motion, "n, rad per time.")
      .def("__repr__", [](const O& o) { return "KeplerOrbit(" + repr_of(o.elements()) + ")"; })
      .def(
          "__eq__", [](const O& a, const O& b) { return a.elements() == b.elements(); },
          nb::is_operator(), nb::arg("other"))
      .def("__hash__", [](const O& o) { return nb::hash(arguments_of(o.elements())); })
      .def("__copy__", [](const O& o) { return o; })
      .def("__reduce__", [](nb::handle_t<O> self) {
        return nb::make_tuple(nb::handle(self.type()),
                              nb::make_tuple(nb::cast<const O&>(self).elements()));
      });
  def_motion(c);
}

void bind_precessing(nb::module_& m) {
  using O = PrecessingKeplerOrbit;
  nb::class_<O> c(m, "PrecessingKeplerOrbit",
                  R"(A Kepler orbit whose node, pericentre and mean anomaly advance uniformly.

elements: KeplerElements at their epoch; rates: SecularRates, as j2_rates gives them.)");
  c.def(nb::init<const KeplerElements&, const SecularRates&>(), nb::arg("elements"),
        nb::arg("rates"))
      .def_prop_ro(
          "rates", [](const O& o) { return o.rates(); }, "Of node, pericentre and mean anomaly.")
      .def("__repr__",
           [](nb::handle_t<O> self) {
             const O& o = nb::cast<const O&>(self);
             return "PrecessingKeplerOrbit(" + repr_of(o.elements()) + ", " +
                    nb::cast<std::string>(nb::repr(nb::cast(o.rates()))) + ")";
           })
      .def(
          "__eq__",
          [](const O& a, const O& b) {
            return a.elements() == b.elements() && a.rates() == b.rates();
          },
          nb::is_operator(), nb::arg("other"))
      .def("__hash__", [](const O& o) { return nb::hash(arguments_of(o.elements())); })
      .def("__copy__", [](const O& o) { return o; })
      .def("__reduce__", [](nb::handle_t<O> self) {
        const O& o = nb::cast<const O&>(self);
        return nb::make_tuple(nb::handle(self.type()), nb::make_tuple(o.elements(), o.rates()));
      });
  def_motion(c);
}

}  // namespace

Vec3 FunctionOrbit::position(double t) const {
  const WithGil acquired;
  return function_->three_numbers((*function_)(t), three_numbers);
}

BasicVec3<DoubleDouble> FunctionOrbit::position(const DoubleDouble&) const {
  throw DomainError(function_->label() +
                    ": a Python function works on float alone: not with Precision.double_double");
}

AnyPythonOrbit orbit_of(nb::handle orbit, const std::string& label,
                        std::vector<SharedFunction>& functions) {
  if (nb::isinstance<KeplerOrbit>(orbit)) return nb::cast<const KeplerOrbit&>(orbit);
  if (nb::isinstance<PrecessingKeplerOrbit>(orbit))
    return nb::cast<const PrecessingKeplerOrbit&>(orbit);
  functions.push_back(std::make_shared<PythonFunction>(orbit, label));
  return FunctionOrbit(functions.back());
}

void bind_orbit(nb::module_& m) {
  bind_elements(m);
  bind_rates(m);
  bind_kepler(m);
  bind_precessing(m);
}

}  // namespace polhode::python
