// SPDX-License-Identifier: MIT
// Tables of nutation.
#include <algorithm>
#include <optional>
#include <string>

#include "interface/arrays.hpp"
#include "interface/batch.hpp"
#include "interface/choice.hpp"
#include "interface/gil.hpp"
#include "interface/signals.hpp"
#include "io/io_parts.hpp"
#include "polhode/detail/scenario/planet_nutation.hpp"
#include "polhode/ephemeris/ephemeris.hpp"

namespace polhode::python {

namespace {

secular::PlanetAxis axis_of(nb::handle value) { return choice<secular::PlanetAxis>(value, "axis"); }

FloatArray pair_of(const secular::NutationOffset& of) {
  const double both[] = {of.longitude, of.obliquity};
  return array_of(both);
}

nb::dict columns_of(const secular::NutationTheory& theory, nb::handle axis, bool oppolzer) {
  const secular::PlanetAxis of = axis_of(axis);
  const std::vector<secular::NutationTerm>& terms =
      oppolzer ? theory.oppolzer_terms(of) : theory.terms(of);
  nb::dict columns;
  const auto add = [&](const std::string& name, const auto& number) {
    std::vector<double> column;
    for (const secular::NutationTerm& term : terms) column.push_back(number(term));
    columns[name.c_str()] = array_of(std::span<const double>(column));
  };
  for (std::size_t i = 0; i < theory.arguments().size(); ++i)
    add(theory.arguments()[i],
        [i](const secular::NutationTerm& t) { return double(t.multipliers[i]); });
  add("rate", [](const secular::NutationTerm& t) { return t.rate; });
  const auto add_wave = [&](const secular::NutationWave secular::NutationTerm::*of_term,
                            const std::string& end) {
    add("longitude_sine" + end, [=](const auto& t) { return (t.*of_term).longitude_sine; });
    add("longitude_cosine" + end, [=](const auto& t) { return (t.*of_term).longitude_cosine; });
    add("obliquity_cosine" + end, [=](const auto& t) { return (t.*of_term).obliquity_cosine; });
    add("obliquity_sine" + end, [=](const auto& t) { return (t.*of_term).obliquity_sine; });
  };
  add_wave(&secular::NutationTerm::wave, "");
  add_wave(&secular::NutationTerm::change, "_change");
  return columns;
}

FloatArray values_at(const secular::NutationTheory& theory, nb::handle axis, const ArrayLike& t) {
  const secular::PlanetAxis of = axis_of(axis);
  Numbers in[] = {Numbers(t, "t")};
  const Shape shape = broadcast(in);
  Result result(shape, {2});
  for_each(size_of(shape), [&](std::size_t k) {
    const secular::NutationOffset now = theory.at(of, in[0][k]);
    result.at(k)[0] = now.longitude;
    result.at(k)[1] = now.obliquity;
  });
  return result.take();
}

FloatArray iau_at(const ArrayLike& T) {
  Numbers in[] = {Numbers(T, "T")};
  const Shape shape = broadcast(in);
  Result result(shape, {2});
  for_each(size_of(shape), [&](std::size_t k) {
    const ephemeris::IauNutation now = ephemeris::iau_nutation(in[0][k]);
    result.at(k)[0] = now.longitude;
    result.at(k)[1] = now.obliquity;
  });
  return result.take();
}

secular::NutationTheory made(const std::string& planet, double T, std::optional<double> ellipticity,
                             std::optional<double> triaxiality, std::optional<double> spin_rate,
                             std::optional<double> obliquity, std::optional<double> satellite_mass,
                             int order, double least) {
  const WithoutGil released;
  return io::nutation_theory(
      {planet, T, ellipticity, triaxiality, spin_rate, obliquity, satellite_mass, order, least});
}

using T = secular::NutationTheory;

nb::class_<T> bound_class(nb::module_& m) {
  return nb::class_<T>(m, "NutationTheory", R"(Precession and nutation of a rigid planet, s and rad.

Made by nutation_theory. Kinoshita (1977): Poisson terms by a Lie transform to the second order,
Oppolzer terms from Euler's equations.)")
      .def_prop_ro("arguments", &T::arguments, "Names of the arguments: l, lp, F, D, Om.")
      .def_prop_ro(
          "at_epoch", [](const T& t) { return array_of(std::span<const double>(t.at_epoch())); },
          "(k,): the arguments at the epoch, rad.")
      .def_prop_ro(
          "rates", [](const T& t) { return array_of(std::span<const double>(t.rates())); },
          "(k,): their rates, rad/s.")
      .def_prop_ro(
          "precession", [](const T& t) { return pair_of(t.precession()); },
          "(2,): rates of longitude and obliquity of the mean axis on the ecliptic of date, rad/s.")
      .def_prop_ro(
          "relative_offset", [](const T& t) { return pair_of(t.relative_offset()); },
          R"((2,): longitude and obliquity, rad, to be added to the axis of rotation for the rate
relative to the moving ecliptic. (SA 4.4.5))")
      .def_prop_ro("folding", &T::folding,
                   "The largest coefficient of the torque at the border of the grid, over its "
                   "largest.");
}

void def_axes(nb::class_<T>& c) {
  c.def(
       "terms",
       [](const T& t, nb::handle axis, bool oppolzer) { return columns_of(t, axis, oppolzer); },
       "axis"_a = "figure", "oppolzer"_a = false,
       nb::sig("def terms(self, axis: PlanetAxis | str = 'figure', oppolzer: bool = False) -> "
               "dict[str, Annotated[NDArray[numpy.float64], dict(shape=(None,))]]"),
       R"(The terms of an axis, largest first, as columns (n,).

Parameters
----------
axis : "momentum", "figure" or "rotation".
oppolzer : the Oppolzer terms alone, the axis less that of the momentum.

Returns
-------
dict
    The multiplier of each argument by its name; rate of the combination, rad/s; longitude_sine,
    longitude_cosine, obliquity_cosine, obliquity_sine, rad; and their changes with _change
    behind, rad/s.)")
      .def(
          "offset", [](const T& t, nb::handle axis) { return pair_of(t.offset(axis_of(axis))); },
          "axis"_a = "figure",
          nb::sig("def offset(self, axis: PlanetAxis | str = 'figure') -> "
                  "Annotated[NDArray[numpy.float64], dict(shape=(2,))]"),
          "(2,): constant part of longitude and obliquity against the mean momentum, rad.")
      .def(
          "at",
          [](const T& t, const ArrayLike& time, nb::handle axis) {
            return values_at(t, axis, time);
          },
          "t"_a, "axis"_a = "figure",
          nb::sig("def at(self, t: ArrayLike, axis: PlanetAxis | str = 'figure') -> "
                  "NDArray[numpy.float64]"),
          R"(Nutation in longitude and obliquity, (..., 2) rad, offset included.

Parameters
----------
t : (...), s from the epoch.
axis : "momentum", "figure" or "rotation".)")
      .def("__repr__", [](const T& t) {
        return "<NutationTheory: " + std::to_string(t.terms(secular::PlanetAxis::figure).size()) +
               " terms of the axis of figure>";
      });
}

}  // namespace

void bind_nutation(nb::module_& m) {
  nb::enum_<secular::PlanetAxis>(m, "PlanetAxis",
                                 "Which axis of a planet: a string with its name will do.")
      .value("momentum", secular::PlanetAxis::momentum, "Of the angular momentum.")
      .value("figure", secular::PlanetAxis::figure, "Of the largest moment.")
      .value("rotation", secular::PlanetAxis::rotation, "Of the inertial angular velocity.");
  nb::class_<T> c = bound_class(m);
  def_axes(c);
  m.def("nutation_theory", made, "planet"_a = "earth", nb::kw_only(), "T"_a = 0.0,
        "ellipticity"_a = nb::none(), "triaxiality"_a = nb::none(), "spin_rate"_a = nb::none(),
        "obliquity"_a = nb::none(), "satellite_mass"_a = nb::none(), "order"_a = 2,
        "least"_a = 5e-12,
        R"(The theory of nutation of the rigid Earth under Moon and Sun, or of Venus or Mars.

Parameters
----------
planet : "earth", "venus" or "mars".
T : of the epoch, Julian centuries of TDB from J2000.
ellipticity : H = (C - (A + B)/2) / C; left out, like all that follow, that of the planet.
triaxiality : (B - A) / C.
spin_rate : rad/s.
obliquity : of the mean equator on the orbit of date, rad.
satellite_mass : mass of the Moon over that of the Earth.
order : of the Lie transform, 1 or 2.
least : smaller terms are left out, rad; 5e-12 is 1 uas.

Returns
-------
NutationTheory

ValueError for other planets and for numbers out of range. Releases the GIL. (Kinoshita 1977))");
  m.def("iau_nutation", iau_at, "T"_a,
        nb::sig("def iau_nutation(T: ArrayLike) -> NDArray[numpy.float64]"),
        R"(Nutation of the real Earth in longitude and obliquity, (..., 2) rad: IAU 2000A, by ERFA.

Parameters
----------
T : (...), Julian centuries of TDB from J2000.

On mean ecliptic and equator of date, without the free core nutation; NaN for NaN.
(Mathews et al. 2002))");
}

}  // namespace polhode::python
