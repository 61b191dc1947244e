// SPDX-License-Identifier: MIT
// Kepler orbits, tables, and Python functions that serve as orbits.
#include "interface/batch.hpp"
#include "interface/dual_number.hpp"
#include "interface/value.hpp"
#include "polhode/error.hpp"
#include "terms/orbit_value.hpp"

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
                  "anomaly; the last in addition to the mean motion.");
  c.def(
       "__init__",
       [](R* self, double node, double argument, double mean_anomaly) {
         new (self) R{node, argument, mean_anomaly};
       },
       nb::arg("node") = 0.0, nb::arg("argument") = 0.0, nb::arg("mean_anomaly") = 0.0)
      .def_ro("node", &R::node, "Of the node, rad per time.")
      .def_ro("argument", &R::argument, "Of the argument of the pericentre, rad per time.")
      .def_ro("mean_anomaly", &R::mean_anomaly,
              "Of the mean anomaly in addition to the mean motion, rad per time.")
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
  m.def("mean_elements", &mean_elements, nb::arg("osculating"), nb::arg("J2"),
        nb::arg("equatorial_radius"),
        R"(The KeplerElements that j2_rates takes, of those of a state about an oblate body.

The axis a of the mean ellipse has the energy of the state, to first order in J2:
1/a = 1/a_s + J2 R^2 ((1 - 3 z^2/r^2)/r^3 - (1 - 3/2 sin^2 i)/(a^3 (1 - e^2)^(3/2))), a_s and r at
the epoch. The other elements are left as they are, with their terms of short period.

Parameters
----------
osculating : KeplerElements of a state (KeplerOrbit.from_state), inclination (rad) against the
    equator of the body. ValueError for a hyperbola.
J2, equatorial_radius : of the body; the radius in the unit of length of the elements. ValueError
    where J2 is so large that no ellipse has that energy.

Returns
-------
KeplerElements with another pericentre.)");
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
FloatArray along(const O& orbit, nb::handle t) {
  if (nb::isinstance<PythonDual>(t))
    return std::visit(
        [&](const auto& at) -> nb::object {
          using D = std::decay_t<decltype(at)>;
          constexpr bool second = !std::same_as<O, KeplerOrbit> &&
                                  (std::same_as<Of, Velocity> || is_dual<typename D::Scalar>);
          if constexpr (!second)
            return to_python(Of{}(orbit, at));
          else
            throw nb::type_error(
                "this orbit has no second derivative: Dual times of first order alone");
        },
        nb::cast<const PythonDual&>(t).x);
  const Numbers times(t, "t");
  return mapped_numbers(times, {3}, [&](double at) { return Of{}(orbit, at); });
}

template <class O>
void def_path(nb::class_<O>& c) {
  c.def(
       "position",
       [](const O& orbit, Typed<"numpy.typing.ArrayLike | Dual"> t) {
         return along<Position>(orbit, t);
       },
       nb::arg("t"),
       "(..., 3) at times t of any shape, in the axes of the elements. NaN in, NaN out. A Dual "
       "gives Duals.")
      .def(
          "velocity",
          [](const O& orbit, Typed<"numpy.typing.ArrayLike | Dual"> t) {
            return along<Velocity>(orbit, t);
          },
          nb::arg("t"), "(..., 3): the derivative of the position.")
      .def(
          "__call__",
          [](const O& orbit, Typed<"numpy.typing.ArrayLike | Dual"> t) {
            return along<Position>(orbit, t);
          },
          nb::arg("t"), "position(t): an orbit serves where a function of time does.");
}

template <class O>
void def_motion(nb::class_<O>& c) {
  def_path(c);
  c.def_prop_ro(
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
          [](ArrayLike position, ArrayLike velocity, double gm, double epoch) {
            return O::from_state(vec3(position, "position"), vec3(velocity, "velocity"), gm, epoch);
          },
          nb::arg("position"), nb::arg("velocity"), nb::arg("gm"), nb::arg("epoch") = 0.0,
          "From position (3,) and velocity (3,) at `epoch`. ValueError where their angular "
          "momentum "
          "is 0, or the orbit is a parabola.")
      .def_prop_ro("mean_motion", &O::mean_motion, "n, rad per time.")
      .def_prop_ro(
          "state",
          [](const O& o) -> std::optional<std::tuple<FloatArray, FloatArray>> {
            if (!o.state()) return std::nullopt;
            return std::tuple(array_of(o.state()->position), array_of(o.state()->velocity));
          },
          "Position and velocity at the epoch of the elements where it was made of them: they say "
          "more than the elements do.")
      .def("__repr__", [](const O& o) { return "KeplerOrbit(" + repr_of(o.elements()) + ")"; })
      .def(
          "__eq__", [](const O& a, const O& b) { return a == b; }, nb::is_operator(),
          nb::arg("other"))
      .def("__hash__", [](const O& o) { return nb::hash(arguments_of(o.elements())); })
      .def("__copy__", [](const O& o) { return o; })
      .def("__reduce__", [](nb::handle_t<O> self) {
        const O& o = nb::cast<const O&>(self);
        if (!o.state())
          return nb::make_tuple(nb::handle(self.type()), nb::make_tuple(o.elements()));
        const nb::object made =
            nb::module_::import_("operator")
                .attr("methodcaller")("from_state", array_of(o.state()->position),
                                      array_of(o.state()->velocity), o.gm(), o.elements().epoch);
        return nb::make_tuple(made, nb::make_tuple(nb::handle(self.type())));
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

void bind_turned(nb::module_& m) {
  using O = TurnedKeplerOrbit;
  nb::class_<O> c(m, "TurnedKeplerOrbit",
                  R"(A PrecessingKeplerOrbit whose elements are in axes turned about axis 1.

`angle` (rad) turns the axes of the elements into those of the positions.)");
  c.def(nb::init<const PrecessingKeplerOrbit&, double>(), nb::arg("orbit"), nb::arg("angle"))
      .def_static("from_equator", &O::from_equator, nb::arg("orbit"),
                  "Elements along the equator of J2000, positions along the ecliptic.")
      .def_static("from_ecliptic", &O::from_ecliptic, nb::arg("orbit"),
                  "Elements along the ecliptic of J2000, positions along the equator.")
      .def_prop_ro(
          "orbit", [](const O& o) { return o.orbit(); }, "In the axes of its elements.")
      .def_prop_ro("angle", &O::angle, "From those axes to these, about axis 1, rad.")
      .def_prop_ro("gm", &O::gm, "Gravitational parameter.")
      .def("__repr__", [](const O& o) {
        return "TurnedKeplerOrbit(" + nb::cast<std::string>(nb::repr(nb::cast(o.orbit()))) + ", " +
               number_text(o.angle()) + ")";
      });
  def_path(c);
  def_value(c, [](const O& o) { return nb::make_tuple(o.orbit(), o.angle()); });
}

// Rows of three numbers.
std::vector<Vec3> rows_of(nb::handle value, const char* name, std::size_t count) {
  const Numbers rows(value, name, {3});
  if (rows.shape() != Shape{count})
    throw nb::value_error((std::string(name) + ": expected the shape (" + std::to_string(count) +
                           ", 3), a row for each time")
                              .c_str());
  std::vector<Vec3> vectors;
  for (std::size_t k = 0; k < count; ++k)
    vectors.push_back({rows.at(k)[0], rows.at(k)[1], rows.at(k)[2]});
  return vectors;
}

PositionTable table_of(nb::handle times, nb::handle positions, nb::handle velocities) {
  const Numbers t(times, "times");
  if (t.shape().size() != 1) throw nb::value_error("times: expected one dimension");
  PositionTable table;
  for (std::size_t k = 0; k < t.shape()[0]; ++k) table.times.push_back(t[k]);
  table.positions = rows_of(positions, "positions", table.times.size());
  if (!velocities.is_none())
    table.velocities = rows_of(velocities, "velocities", table.times.size());
  return table;
}

FloatArray array_of_rows(const std::vector<Vec3>& rows) {
  Result result({rows.size()}, {3});
  for (std::size_t k = 0; k < rows.size(); ++k) put(result.at(k), rows[k]);
  return result.take();
}

nb::tuple arguments_of(const TableOrbit& o) {
  Result times({o.table().times.size()});
  for (std::size_t k = 0; k < o.table().times.size(); ++k) put(times.at(k), o.table().times[k]);
  const nb::object velocities =
      o.has_velocities() ? array_of_rows(o.table().velocities) : nb::none();
  return nb::make_tuple(times.take(), array_of_rows(o.table().positions), velocities, o.order(),
                        o.overhang());
}

void bind_table(nb::module_& m) {
  using O = TableOrbit;
  nb::class_<O> c(m, "TableOrbit", R"(A path through tabulated positions, of high order.

Parameters
----------
times : (N,), rising, evenly spaced or not.
positions : (N, 3).
velocities : (N, 3), or None: with them the polynomials are Hermite's.
order : even, up to 16; with velocities a multiple of 4, up to 32. 0 stands for 10 and 12.
overhang : a time, at most the mean spacing: so far the polynomials at the ends go on beyond them.

position(t) is NaN outside the table. ValueError for times that do not rise, numbers that are not
finite, too few rows.)");
  c.def(
       "__init__",
       [](O* self, ArrayLike times, ArrayLike positions, ArrayLike velocities, int order,
          double overhang) {
         new (self) O(table_of(times, positions, velocities), order, overhang);
       },
       nb::arg("times"), nb::arg("positions"), nb::arg("velocities") = nb::none(),
       nb::arg("order") = 0, nb::arg("overhang") = 0.0)
      .def_prop_ro("order", &O::order, "Of the interpolation: degree plus one.")
      .def_prop_ro("first_time", &O::first_time, "Where the table begins.")
      .def_prop_ro("last_time", &O::last_time, "Where it ends.")
      .def_prop_ro("overhang", &O::overhang, "How far the polynomials at the ends go on.")
      .def_prop_ro("is_evenly_spaced", &O::is_evenly_spaced, "To the rounding of the times.")
      .def_prop_ro("has_velocities", &O::has_velocities, "Whether it was made of them, too.")
      .def_prop_ro(
          "times", [](const O& o) -> FloatArray { return nb::object(arguments_of(o)[0]); }, "(N,)")
      .def_prop_ro(
          "positions", [](const O& o) { return array_of_rows(o.table().positions); }, "(N, 3)")
      .def_prop_ro(
          "velocities", [](const O& o) -> Typed<"numpy.typing.NDArray[numpy.float64] | None"> {
            return nb::object(arguments_of(o)[2]);
          },
          "(N, 3), or None.")
      .def(
          "__eq__", [](const O& a, const O& b) { return a == b; }, nb::is_operator(),
          nb::arg("other"), "Of the same rows and order.")
      .def("__hash__",
           [](const O& o) {
             return nb::hash(nb::make_tuple(o.first_time(), o.last_time(), o.table().times.size()));
           })
      .def("__repr__",
           [](const O& o) {
             return "TableOrbit(" + std::to_string(o.table().times.size()) + " rows from " +
                    number_text(o.first_time()) + " to " + number_text(o.last_time()) +
                    ", order=" + std::to_string(o.order()) + ")";
           })
      .def("__copy__", [](const O& o) { return o; })
      .def("__reduce__", [](nb::handle_t<O> self) {
        return nb::make_tuple(nb::handle(self.type()), arguments_of(nb::cast<const O&>(self)));
      });
  def_path(c);
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
  if (nb::isinstance<TurnedKeplerOrbit>(orbit)) return nb::cast<const TurnedKeplerOrbit&>(orbit);
  if (nb::isinstance<TableOrbit>(orbit)) return nb::cast<const TableOrbit&>(orbit);
  functions.push_back(std::make_shared<PythonFunction>(orbit, label));
  return FunctionOrbit(functions.back());
}

void bind_orbit(nb::module_& m) {
  bind_elements(m);
  bind_rates(m);
  bind_kepler(m);
  bind_precessing(m);
  bind_turned(m);
  bind_table(m);
  bind_ephemeris(m);
}

}  // namespace polhode::python
