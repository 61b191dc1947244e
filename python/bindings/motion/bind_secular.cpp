// SPDX-License-Identifier: MIT
// Spin axes over ages.
#include <cstring>
#include <tuple>
#include <utility>

#include "interface/records.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "motion/dynamics_values.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "polhode/secular/tidal_spin.hpp"
#include "terms/orbit_value.hpp"

namespace polhode::python {

namespace {

secular::ElementTable table_of(nb::handle times, nb::handle e, nb::handle i, nb::handle node,
                               nb::handle argument, int order) {
  Numbers in[] = {Numbers(times, "times"), Numbers(e, "eccentricity"), Numbers(i, "inclination"),
                  Numbers(node, "node"), Numbers(argument, "argument")};
  const Shape shape = broadcast(in);
  if (shape.size() != 1)
    throw nb::value_error(
        ("ElementTable: got shape " + text_of(shape) + "; expected columns (N,)").c_str());
  std::vector<double> at;
  std::vector<secular::OrbitElements> rows;
  for (std::size_t k = 0; k < shape[0]; ++k) {
    at.push_back(in[0][k]);
    try {
      rows.push_back(secular::orbit_elements(in[1][k], in[2][k], in[3][k], in[4][k]));
    } catch (const DomainError& error) {
      throw DomainError("ElementTable: row " + std::to_string(k) + ": " + error.what());
    }
  }
  return {std::move(at), rows, order};
}

std::vector<secular::SeriesTerm> terms_of(nb::handle rows, const char* name) {
  const Numbers numbers(rows, name, {3});
  if (numbers.shape().size() > 1)
    throw nb::value_error((std::string(name) + ": got shape " + text_of(numbers.shape()) +
                           " of rows; expected the shape (n, 3)")
                              .c_str());
  std::vector<secular::SeriesTerm> terms;
  for (std::size_t k = 0; k < size_of(numbers.shape()); ++k)
    terms.push_back({numbers.at(k)[0], numbers.at(k)[1], numbers.at(k)[2]});
  return terms;
}

// Pickles hold numbers as bytes.
template <class T>
nb::bytes bytes_of(const std::vector<T>& numbers) {
  return nb::bytes(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}
template <class T>
std::vector<T> numbers_of(const nb::bytes& bytes) {
  if (bytes.size() % sizeof(T) != 0)
    throw nb::value_error("a pickle of elements over ages: its bytes are damaged");
  std::vector<T> numbers(bytes.size() / sizeof(T));
  std::memcpy(numbers.data(), bytes.c_str(), bytes.size());
  return numbers;
}

using TableState = std::tuple<nb::bytes, nb::bytes, int>;
TableState state_of(const secular::ElementTable& table) {
  std::vector<secular::OrbitElements> rows;
  for (std::size_t k = 0; k < table.times().size(); ++k) rows.push_back(table.row(k));
  return {bytes_of(table.times()), bytes_of(rows), table.order()};
}
using SeriesState = std::tuple<nb::bytes, nb::bytes>;

// Copies, pickles and equality by the numbers.
void def_copies(nb::class_<secular::ElementTable>& c) {
  c.def("__getstate__", state_of)
      .def("__setstate__",
           [](secular::ElementTable& self, const TableState& state) {
             const auto rows = numbers_of<secular::OrbitElements>(std::get<1>(state));
             new (&self) secular::ElementTable(numbers_of<double>(std::get<0>(state)), rows,
                                               std::get<2>(state));
           })
      .def(
          "__eq__",
          [](const secular::ElementTable& a, const secular::ElementTable& b) { return a == b; },
          nb::is_operator());
}
void def_copies(nb::class_<secular::ElementSeries>& c) {
  c.def("__getstate__",
        [](const secular::ElementSeries& of) {
          return SeriesState{bytes_of(of.ellipse_terms()), bytes_of(of.plane_terms())};
        })
      .def("__setstate__",
           [](secular::ElementSeries& self, const SeriesState& state) {
             new (&self)
                 secular::ElementSeries(numbers_of<secular::SeriesTerm>(std::get<0>(state)),
                                        numbers_of<secular::SeriesTerm>(std::get<1>(state)));
           })
      .def(
          "__eq__",
          [](const secular::ElementSeries& a, const secular::ElementSeries& b) { return a == b; },
          nb::is_operator());
}

void bind_orbits(nb::module_& m) {
  nb::class_<secular::ElementTable> table(m, "ElementTable",
                                          R"(An orbit that changes over ages, from a table.

Parameters
----------
times : (N,), rising, of any cadence.
eccentricity : (N,), from 0 to below 1.
inclination, node, argument : (N,), rad, along the reference axes; argument of the pericentre from
    the node. Jumps by a turn do not matter: what is interpolated is e cos(varpi), sin(i/2)
    cos(Omega) and their like.
order : of the interpolation, as of a TableOrbit; 0: 10.

A UserWarning for rows that are too far apart: interpolation_error above 1e-3, or NaN. ValueError
names the row of elements of no ellipse, and times that do not rise.)");
  table
      .def(
          "__init__",
          [](secular::ElementTable* self, const ArrayLike& times, const ArrayLike& e,
             const ArrayLike& i, const ArrayLike& node, const ArrayLike& argument, int order) {
            secular::ElementTable made = table_of(times, e, i, node, argument, order);
            warn_of_coarse_rows("ElementTable", made.interpolation_error(), 1e-3,
                                "the largest eccentricity or inclination");
            new (self) secular::ElementTable(std::move(made));
          },
          "times"_a, "eccentricity"_a, "inclination"_a, "node"_a, "argument"_a, "order"_a = 0)
      .def_prop_ro("interpolation_error", &secular::ElementTable::interpolation_error,
                   "About the largest error between rows, of the largest eccentricity or "
                   "inclination; NaN for too few rows to tell.")
      .def_prop_ro("first_time", &secular::ElementTable::first_time, "Where the table begins.")
      .def_prop_ro("last_time", &secular::ElementTable::last_time, "Where it ends.")
      .def("__repr__", [](const secular::ElementTable& t) {
        return "<ElementTable: " + number_text(t.first_time()) + " to " +
               number_text(t.last_time()) + ">";
      });
  def_copies(table);
  nb::class_<secular::ElementSeries> series(m, "ElementSeries",
                                            R"(An orbit that changes over ages, from a series.

e exp(i varpi) and sin(i/2) exp(i Omega) as sums of A exp(i (nu t + phi)) (Laskar 1988).

Parameters
----------
ellipse, plane : (n, 3), rows of frequency nu (rad per time), amplitude A, phase phi (rad).

ValueError where the amplitudes of one add up to 1 or more, and for numbers that are not finite.)");
  series
      .def(
          "__init__",
          [](secular::ElementSeries* self, const ArrayLike& ellipse, const ArrayLike& plane) {
            new (self)
                secular::ElementSeries(terms_of(ellipse, "ellipse"), terms_of(plane, "plane"));
          },
          "ellipse"_a, "plane"_a)
      .def("__repr__", [](const secular::ElementSeries&) { return "<ElementSeries>"; });
  def_copies(series);
}

using Elements = std::variant<secular::ElementTable, secular::ElementSeries>;

Elements elements_of(const secular::OrbitHistory& of) {
  return of.table() != nullptr ? Elements(*of.table()) : Elements(*of.series());
}

void bind_history_orbit(nb::module_& m) {
  using O = secular::HistoryOrbit;
  nb::class_<O> c(m, "HistoryOrbit",
                  R"(Where a planet is on an orbit that changes over ages.

For what is not averaged over the year: an orbit of terms such as GravityGradient, and of
spin_history.

Parameters
----------
elements : ElementTable or ElementSeries.
gm : of the star, length^3 / time^2 in the time of the elements.
semi_major_axis : it stays, and with it the mean motion.
longitude : the mean longitude at t = 0, rad, from axis 1 of the equinoctial axes.

ValueError for gm or semi_major_axis that is not positive.)");
  c.def(
       "__init__",
       [](O* self, const Elements& elements, double gm, double a, double longitude) {
         new (self)
             O(std::visit([](const auto& of) { return secular::OrbitHistory(of); }, elements), gm,
               a, longitude);
       },
       "elements"_a, "gm"_a, "semi_major_axis"_a, "longitude"_a = 0.0)
      .def_prop_ro(
          "elements", [](const O& o) { return elements_of(o.elements()); },
          "ElementTable or ElementSeries.")
      .def_prop_ro("gm", &O::gm, "Of the star, length^3 / time^2.")
      .def_prop_ro("semi_major_axis", &O::semi_major_axis, "A length.")
      .def_prop_ro("longitude", &O::longitude, "The mean one at t = 0, rad.")
      .def_prop_ro("mean_motion", &O::mean_motion, "sqrt(gm / a^3), rad per time.")
      .def("__repr__",
           [](const O& o) {
             return "<HistoryOrbit: a = " + number_text(o.semi_major_axis()) +
                    ", gm = " + number_text(o.gm()) + ">";
           })
      .def("__reduce__", [](nb::handle_t<O> self) {
        const O& o = nb::cast<const O&>(self);
        return nb::make_tuple(
            nb::handle(self.type()),
            nb::make_tuple(elements_of(o.elements()), o.gm(), o.semi_major_axis(), o.longitude()));
      });
  const auto position = [](const O& o, const ArrayLike& t) {
    return mapped_numbers(Numbers(t, "t"), {3}, [&](double at) { return o.position(at); });
  };
  c.def("position", position, "t"_a,
        "(..., 3) at times t of any shape, in the axes of the elements; NaN beyond them.")
      .def("__call__", position, "t"_a,
           "position(t): an orbit serves where a function of time does.");
}

void bind_rates(nb::module_& m) {
  using R = secular::PrecessionRates;
  bind_value<R>(m, "PrecessionRates",
                R"(What turns the spin axis of a planet, in rad per time.

Parameters
----------
star : of the star, on a circle; star_precession makes it of physical data.
satellites : of satellites, whatever the planet's eccentricity; satellite_precession.
geodetic : forwards, about the normal of the orbit; geodetic_precession.
drift : by which fraction per time star and satellites grow from t = 0 on, as by tides.)",
                field("star", &R::star, "Of the star, on a circle."),
                field("satellites", &R::satellites, "Of satellites.", 0.0),
                field("geodetic", &R::geodetic, "Forwards, about the normal.", 0.0),
                field("drift", &R::drift, "Fraction per time.", 0.0).but_quiet());
  m.def(
      "rates_of_precession",
      [](double rate, double obliquity, double eccentricity, double satellites) {
        return secular::rates_of_precession(rate, std::cos(obliquity), eccentricity * eccentricity,
                                            satellites);
      },
      "rate"_a, "obliquity"_a, "eccentricity"_a = 0.0, "satellites"_a = 0.0,
      R"(The PrecessionRates with which the equinox goes back at a rate that was observed.

Parameters
----------
rate : rad per time, by the torques of star and satellites, without geodetic precession.
obliquity, eccentricity : at the time of the rate; rad.
satellites : their torque over that of the star on a circle.)");
  m.def("star_precession", &secular::star_precession, "ellipticity"_a, "spin_rate"_a, "gm"_a,
        "semi_major_axis"_a,
        "3/2 gm / a^3 E / w: E = (C - (A + B)/2) / C of the planet, w its spin rate; gm of the "
        "star.");
  m.def("satellite_precession", &secular::satellite_precession, "ellipticity"_a, "spin_rate"_a,
        "gm"_a, "semi_major_axis"_a, "eccentricity"_a = 0.0, "inclination"_a = 0.0,
        "The same of a satellite that goes round far outside the planet, at a mean inclination "
        "(rad) against the planet's orbit (Laskar and Robutel 1993).");
  m.def(
      "inner_satellites_factor",
      [](double J2, double inertia_factor, const ArrayLike& mass, const ArrayLike& distance,
         const ArrayLike& mean_motion) {
        Numbers in[] = {Numbers(mass, "mass"), Numbers(distance, "distance"),
                        Numbers(mean_motion, "mean_motion")};
        std::vector<secular::InnerSatellite> all;
        for (std::size_t k = 0, n = size_of(broadcast(in)); k < n; ++k)
          all.push_back({in[0][k], in[1][k], in[2][k]});
        return secular::inner_satellites_factor(J2, inertia_factor, all);
      },
      "J2"_a, "inertia_factor"_a, "mass"_a, "distance"_a, "mean_motion"_a,
      R"(By what satellites that stay in the equator multiply star (Ward and Hamilton 2004).

Parameters
----------
J2, inertia_factor : of the planet; C / M R^2.
mass, distance, mean_motion : of the satellites, (N,) or numbers: m / M, a / R, and n over the spin
    rate.)");
  m.def("geodetic_precession", &secular::geodetic_precession, "gm"_a, "semi_major_axis"_a,
        "light_speed"_a, "De Sitter's, of a planet on a circle: 3/2 (gm / a)^(3/2) / (a c^2).");
}

struct SpinRow {
  double t;
  Vec3 s;
  double spin;
  double distance;
  secular::SpinAngles angles;
  double eccentricity;
};

struct SpinHistory : Records<SpinRow> {
  using Rows = Records<SpinRow>;
  Outcome outcome;
  Statistics statistics;
  std::string method;
};

template <class E>
secular::SpinPrecession<E> model_of(const E& orbit, const secular::PrecessionRates& rates) {
  return {orbit, rates};
}
secular::SpinOnOrbit model_of(const secular::HistoryOrbit& orbit,
                              const secular::PrecessionRates& rates) {
  if (rates.satellites != 0.0 || rates.geodetic != 0.0 || rates.drift != 0.0)
    throw nb::value_error("rates: got more than star; expected star alone on a HistoryOrbit");
  return {orbit, rates.star};
}

template <class Orbit>
secular::OrbitElements elements_at(const Orbit& orbit, double t) {
  if constexpr (std::is_same_v<Orbit, secular::HistoryOrbit>)
    return orbit.elements().at(t);
  else
    return orbit.at(t);
}

template <class M, class Orbit>
SpinHistory history_on(const M& model, const Orbit& orbit, const typename M::State& start,
                       double epoch, const SaveAt& times, const Method& method) {
  using S = typename M::State;
  const BasicProblem<M> problem{model, start, epoch, times[times.size() - 1], method};
  const Progress look = signal_check();
  const BasicTrajectory<S> run = [&] {
    const WithoutGil released;
    return integrate(problem, Keep{.samples = times, .dense = false}, look);
  }();
  warn_of(run.outcome(), "spin_history");
  std::vector<SpinRow> rows;
  for (const BasicSample<S>& at : run.samples()) {
    const secular::OrbitElements o = elements_at(orbit, at.t);
    const secular::TidalSpin state = secular::tidal_spin(at.s);
    rows.push_back({at.t, state.s, state.spin, state.distance, secular::spin_angles({state.s}, o),
                    secular::eccentricity(o)});
  }
  return {Records(std::move(rows)), run.outcome(), run.statistics(), run.method()};
}

template <class Orbit>
SpinHistory with_tides(const Orbit& orbit, const secular::PrecessionRates& rates,
                       const secular::TidalRates& tides, const secular::SpinAxis& start,
                       double epoch, const SaveAt& times, const Method& method) {
  if constexpr (std::is_same_v<Orbit, secular::HistoryOrbit>) {
    throw nb::value_error("tides: expected none on a HistoryOrbit");
  } else {
    return history_on(secular::TidalPrecession<Orbit>(orbit, rates, tides), orbit,
                      secular::TidalSpin{start.s}, epoch, times, method);
  }
}

// Rows on the other side of the epoch would not be met.
void require_one_side(const SaveAt& times, double epoch) {
  const double last = times[times.size() - 1];
  const auto fail = [&](double t, const char* how) {
    throw nb::value_error(("times: got " + number_text(t) + " and " + number_text(last) + ", " +
                           how + " the epoch " + number_text(epoch) +
                           "; expected times that run away from it")
                              .c_str());
  };
  for (std::int64_t k = 0; k < times.size(); ++k)
    if ((last - epoch) * (times[k] - epoch) < 0.0) fail(times[k], "on two sides of");
  if (std::abs(times[0] - epoch) > std::abs(last - epoch)) fail(times[0], "running towards");
}

SpinHistory history(
    const std::variant<secular::ElementTable, secular::ElementSeries, secular::HistoryOrbit>& orbit,
    const secular::PrecessionRates& rates, const ArrayLike& pole,
    const Typed<"SaveAt | numpy.typing.ArrayLike">& times,
    const Typed<"Adaptive | Collocation | Splitting">& method, double epoch,
    const std::optional<secular::TidalRates>& tides) {
  const SaveAt at = save_at_of(times, "times");
  if (at.size() == 0) throw nb::value_error("times: got none; expected one or more");
  require_one_side(at, epoch);
  for (const double rate : {rates.star, rates.satellites, rates.geodetic, rates.drift})
    if (!std::isfinite(rate))
      throw nb::value_error(
          ("rates: got " + number_text(rate) + "; expected finite rates").c_str());
  secular::require_drift(rates, epoch, at[at.size() - 1]);
  if (const auto* const table = std::get_if<secular::ElementTable>(&orbit))
    if (!(epoch >= table->first_time() && epoch <= table->last_time()))
      throw nb::value_error(("epoch: got " + number_text(epoch) +
                             "; expected one that the table "
                             "covers, " +
                             number_text(table->first_time()) + " to " +
                             number_text(table->last_time()))
                                .c_str());
  const secular::SpinAxis start = secular::spin_axis(vec3(pole, "pole"));
  const Method by =
      method.is_none() ? Method(default_model_method) : method_of(method, "spin_history");
  return std::visit(
      [&](const auto& elements) {
        if (!tides) return history_on(model_of(elements, rates), elements, start, epoch, at, by);
        return with_tides(elements, rates, *tides, start, epoch, at, by);
      },
      orbit);
}

void bind_history(nb::module_& m) {
  using R = SpinRow;
  using H = SpinHistory;
  nb::class_<H> c(m, "SpinHistory", R"(The spin axis of a planet over ages.

Made by spin_history; columns (N,) are read-only views.)");
  def_records<R>(
      c, {{"t", [](const R& r) { return &r.t; }, "(N,): the times."},
          {"s",
           [](const R& r) { return &r.s.x; },
           "(N, 3): unit vectors along the spin, reference axes.",
           {3}},
          {"spin", [](const R& r) { return &r.spin; },
           "(N,): its rate over that at the epoch; 1 without tides."},
          {"distance", [](const R& r) { return &r.distance; },
           "(N,): of the satellite, over that at the epoch; 1 without tides."},
          {"obliquity", [](const R& r) { return &r.angles.obliquity; },
           "(N,): angle from the normal of the orbit, rad."},
          {"precession", [](const R& r) { return &r.angles.precession; },
           "(N,): by how much the equinox has gone back in the orbit, rad, in (-pi, pi]; NaN at "
           "obliquity 0 and pi."},
          {"pericentre", [](const R& r) { return &r.angles.pericentre; },
           "(N,): longitude of the pericentre from the moving equinox, rad."},
          {"climatic_precession", [](const R& r) { return &r.angles.climatic_precession; },
           "(N,): e sin(pericentre)."},
          {"eccentricity", [](const R& r) { return &r.eccentricity; }, "(N,): of the orbit."}});
  def_pickle(c, &H::outcome, &H::statistics, &H::method);
  c.def_ro("outcome", &H::outcome, "How the run ended.")
      .def_ro("statistics", &H::statistics, "What the run cost.")
      .def_ro("method", &H::method, "In words.")
      .def("__repr__", [](const H& h) {
        return "<SpinHistory: " + counted(h.rows().size(), "sample") + "; " + h.method + ">";
      });
  m.def("spin_history", history, "orbit"_a, "rates"_a, "pole"_a, "times"_a, "method"_a = nb::none(),
        "epoch"_a = 0.0, "tides"_a = nb::none(),
        R"(The spin axis of a planet on an orbit that changes over ages.

Averaged over the rotation and over the orbit: ds/dt = (alpha(e) (s.n) - g) s x n. On a HistoryOrbit
over the rotation alone, which takes steps of weeks.

Parameters
----------
orbit : ElementTable, ElementSeries or HistoryOrbit, along reference axes of any kind.
rates : PrecessionRates, in the unit of time of the orbit; on a HistoryOrbit the star alone.
pole : (3,), at the epoch, along the reference axes; its length does not matter.
times : SaveAt, or times (N,), away from the epoch in one direction.
method : Adaptive, Collocation, Splitting (fast: Splitting(10, "order8") in kyr); None: Adaptive().
epoch : when the pole is where it is.
tides : TidalRates, or None. With them the spin slows down, the satellite goes away, and the rates
    of precession, those at the epoch, change as they do.

Returns
-------
SpinHistory
    Also of a run that could not go on, as beyond the end of a table, with a RuntimeWarning.

Releases the GIL; Ctrl-C raises KeyboardInterrupt. (Laskar and Robutel 1993; Touma and Wisdom
1993))");
}

}  // namespace

void bind_secular(nb::module_& m) {
  bind_orbits(m);
  bind_history_orbit(m);
  bind_rates(m);
  bind_history(m);
}

}  // namespace polhode::python
