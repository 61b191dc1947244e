// SPDX-License-Identifier: MIT
// Kepler orbits, tables, and Python functions that serve as orbits.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "interface/batch.hpp"
#include "interface/dual_number.hpp"
#include "interface/value.hpp"
#include "polhode/error.hpp"
#include "terms/orbit_value.hpp"

namespace polhode::python {

namespace {

constexpr const char* three_numbers = "3 numbers, a position";

void bind_elements(nb::module_& m) {
  using E = KeplerElements;
  bind_made_value<E>(
      m, "KeplerElements",
      R"(The elements of an ellipse or a hyperbola about a point mass.

Parameters
----------
gm : gravitational parameter, length^3 / time^2.
pericentre : distance a (1 - e); pericentre_distance(a, e) makes it.
eccentricity : 0 <= e < 1 or e > 1.
inclination, node, argument : rad; argument of the pericentre from the node.
mean_anomaly : rad, at `epoch`; 0 where the epoch is a time of pericentre.
epoch : time.

Any consistent units. ValueError for elements of no orbit.)",
      [](auto... numbers) {
        const E e{numbers...};
        require_valid(e, "KeplerElements");
        return e;
      },
      field("gm", &E::gm, "Gravitational parameter, length^3 / time^2."),
      field("pericentre", &E::pericentre, "Distance a (1 - e)."),
      field("eccentricity", &E::eccentricity, "e; above 1 for a hyperbola."),
      field("inclination", &E::inclination, "rad.", 0.0),
      field("node", &E::node, "Longitude of the ascending node, rad.", 0.0),
      field("argument", &E::argument, "Of the pericentre, from the node, rad.", 0.0),
      field("mean_anomaly", &E::mean_anomaly, "At the epoch, rad.", 0.0),
      field("epoch", &E::epoch, "Time of the mean anomaly.", 0.0));
  m.def("mean_motion", &mean_motion, "elements"_a, "n = sqrt(gm / |a|^3), rad per time.");
  m.def("semi_major_axis", &semi_major_axis, "elements"_a,
        "a = pericentre / (1 - e): negative for a hyperbola.");
  m.def("pericentre_distance", &pericentre_distance, "semi_major_axis"_a, "eccentricity"_a,
        "a (1 - e): the pericentre that KeplerElements asks for.");
}

void bind_rates(nb::module_& m) {
  using R = SecularRates;
  bind_value<R>(
      m, "SecularRates",
      "Uniform rates of node, argument of the pericentre, mean anomaly (in addition to the mean "
      "motion) and inclination, rad per time, and of the eccentricity, per time.",
      field("node", &R::node, "Of the node, rad per time.", 0.0),
      field("argument", &R::argument, "Of the argument of the pericentre, rad per time.", 0.0),
      field("mean_anomaly", &R::mean_anomaly,
            "Of the mean anomaly in addition to the mean motion, rad per time.", 0.0),
      field("inclination", &R::inclination, "Of the inclination, rad per time.", 0.0),
      field("eccentricity", &R::eccentricity, "Of the eccentricity, per time.", 0.0));
  m.def("j2_rates", &j2_rates, "elements"_a, "J2"_a, "equatorial_radius"_a,
        "SecularRates of first order about an oblate body: its J2, its equatorial radius in the "
        "unit of length of the elements, whose inclination is against its equator. ValueError for "
        "a hyperbola.");
  m.def("mean_elements", &mean_elements, "osculating"_a, "J2"_a, "equatorial_radius"_a,
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

using Time = Typed<"numpy.typing.ArrayLike | Dual">;

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
       "position", [](const O& orbit, Time t) { return along<Position>(orbit, t); }, "t"_a,
       "(..., 3) at times t of any shape, in the axes of the elements. NaN in, NaN out. A Dual "
       "gives Duals.")
      .def(
          "velocity", [](const O& orbit, Time t) { return along<Velocity>(orbit, t); }, "t"_a,
          "(..., 3): the derivative of the position.")
      .def(
          "__call__", [](const O& orbit, Time t) { return along<Position>(orbit, t); }, "t"_a,
          "position(t): an orbit serves where a function of time does.");
}

template <class O>
void def_motion(nb::class_<O>& c) {
  def_path(c);
  c.def_prop_ro(
      "gm", [](const O& o) { return o.gm(); }, "Gravitational parameter.");
}

void bind_kepler(nb::module_& m) {
  using O = KeplerOrbit;
  nb::class_<O> c(m, "KeplerOrbit", R"(Motion about a point mass, an ellipse or a hyperbola.

KeplerOrbit(elements: KeplerElements), or KeplerOrbit.from_state. Positions to rounding after any
number of orbits.)");
  c.def(nb::init<const KeplerElements&>(), "elements"_a)
      .def_static(
          "from_state",
          [](ArrayLike position, ArrayLike velocity, double gm, double epoch) {
            return O::from_state(vec3(position, "position"), vec3(velocity, "velocity"), gm, epoch);
          },
          "position"_a, "velocity"_a, "gm"_a, "epoch"_a = 0.0,
          "From position (3,) and velocity (3,) at `epoch`. ValueError where their angular "
          "momentum "
          "is 0, or the orbit is a parabola.")
      .def_prop_ro("elements", &O::elements, "At their epoch.")
      .def_prop_ro("mean_motion", &O::mean_motion, "n, rad per time.")
      .def_prop_ro(
          "state",
          [](const O& o) -> std::optional<std::tuple<FloatArray, FloatArray>> {
            if (!o.state()) return std::nullopt;
            return std::tuple(array_of(o.state()->position), array_of(o.state()->velocity));
          },
          "Position and velocity at the epoch of the elements where it was made of them: they say "
          "more than the elements do.")
      .def("__repr__",
           [](const O& o) { return "KeplerOrbit(" + repr_text(nb::cast(o.elements())) + ")"; })
      .def(
          "__eq__", [](const O& a, const O& b) { return a == b; }, nb::is_operator(), "other"_a)
      .def("__hash__", [](const O& o) { return nb::hash(nb::cast(o.elements())); })
      .def("__copy__", [](const O& o) { return o; })
      .def("__reduce__", [](nb::handle_t<O> self) {
        const O& o = nb::cast<const O&>(self);
        if (!o.state()) return remade(self, nb::make_tuple(o.elements()));
        return remade(self,
                      nb::make_tuple(array_of(o.state()->position), array_of(o.state()->velocity),
                                     o.gm(), o.elements().epoch),
                      "from_state");
      });
  def_motion(c);
}

void bind_precessing(nb::module_& m) {
  using O = PrecessingKeplerOrbit;
  auto c = bind_made_value<O>(
      m, "PrecessingKeplerOrbit",
      R"(A Kepler orbit whose elements, all but the axis, change uniformly.

elements: KeplerElements at their epoch; rates: SecularRates, as j2_rates gives them. The velocity
is the derivative of the position, with the rates of all elements in it. NaN where the eccentricity
has left [0, 1): before first_time and from last_time on. ValueError for rates that are not finite,
a mean anomaly that does not rise, an eccentricity of a hyperbola that changes.)",
      [](const auto&... parts) { return O(parts...); },
      field("elements", &O::elements, "At their epoch."),
      field("rates", &O::rates, "Of node, pericentre, mean anomaly, inclination, eccentricity."));
  c.def_prop_ro("first_time", &O::first_time,
                "From when on the eccentricity is in [0, 1); -inf where it stays.")
      .def_prop_ro("last_time", &O::last_time, "Until when; inf where it stays.");
  def_motion(c);
}

void bind_turned(nb::module_& m) {
  using O = TurnedKeplerOrbit;
  auto c = bind_made_value<O>(
      m, "TurnedKeplerOrbit",
      R"(A PrecessingKeplerOrbit whose elements are in axes turned about axis 1.

`angle` (rad) turns the axes of the elements into those of the positions.)",
      [](const auto&... parts) { return O(parts...); },
      field("orbit", &O::orbit, "In the axes of its elements."),
      field("angle", &O::angle, "From those axes to these, about axis 1, rad."));
  c.def_static("from_equator", &O::from_equator, "orbit"_a,
               "Elements along the equator of J2000, positions along the ecliptic.")
      .def_static("from_ecliptic", &O::from_ecliptic, "orbit"_a,
                  "Elements along the ecliptic of J2000, positions along the equator.")
      .def_prop_ro("gm", &O::gm, "Gravitational parameter.");
  def_path(c);
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

}  // namespace

void warn_of_coarse_rows(const char* what, double error, double noticeable, const char* of) {
  if (error <= noticeable) return;
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%.1g", error);
  const std::string text =
      std::string(what) +
      (std::isnan(error)
           ? std::string(": the interpolation error cannot be estimated from so few rows")
           : std::string(": rows that are too far apart: between them the interpolation errs by "
                         "about ") +
                 number.data() + " of " + of);
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw nb::python_error();
}

namespace {

void bind_table(nb::module_& m) {
  using O = TableOrbit;
  nb::class_<O> c(m, "TableOrbit", R"(A path through tabulated positions, of high order.

Parameters
----------
times : (N,), rising, evenly spaced or not.
positions : (N, 3).
velocities : (N, 3), or None: with them the polynomials are Hermite's.
order : even, up to 16; with velocities a multiple of 4, up to 32. 0 stands for 10 and 12. If
    spacings vary by a factor of 30 or more, use 12 or less: the highest orders lose accuracy.
overhang : a time, at most the mean spacing: so far the polynomials at the ends go on beyond them.

position(t) is NaN outside the table. A UserWarning for rows that are too far apart:
interpolation_error above 1e-4, or NaN. ValueError for times that do not rise, numbers that are not
finite, too few rows.)");
  c.def(
       "__init__",
       [](O* self, ArrayLike times, ArrayLike positions, ArrayLike velocities, int order,
          double overhang) {
         O made(table_of(times, positions, velocities), order, overhang);
         warn_of_coarse_rows("TableOrbit", interpolation_error(made), 1e-4, "the distance");
         new (self) O(std::move(made));
       },
       "times"_a, "positions"_a, "velocities"_a = nb::none(), "order"_a = 0, "overhang"_a = 0.0)
      .def_prop_ro("order", &O::order, "Of the interpolation: degree plus one.")
      .def_prop_ro(
          "interpolation_error", [](const O& o) { return interpolation_error(o); },
          "About the largest error between rows, as a fraction of the distance, estimated from the "
          "neighbouring orders, or from two or three rows with their velocities; NaN for two or "
          "three rows without.")
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
          "__eq__", [](const O& a, const O& b) { return a == b; }, nb::is_operator(), "other"_a,
          "Of the same rows and order.")
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
  if (nb::isinstance<secular::HistoryOrbit>(orbit))
    return nb::cast<const secular::HistoryOrbit&>(orbit);
  if (PyCallable_Check(orbit.ptr()) == 0) {
    const bool elements = nb::isinstance<KeplerElements>(orbit);
    throw nb::type_error((label + ": got a " + class_name(orbit) + "; expected an orbit, " +
                          (elements ? "KeplerOrbit(elements)" : "such as KeplerOrbit") +
                          ", or a function of time")
                             .c_str());
  }
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
