// SPDX-License-Identifier: MIT
// Surfaces of section.
#include <memory>

#include "charts/states.hpp"
#include "interface/batch.hpp"
#include "interface/choice.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "motion/dynamics_values.hpp"
#include "motion/samples.hpp"
#include "polhode/analysis/section.hpp"
#include "polhode/error.hpp"

namespace polhode::python {

namespace {

// The points are next to the rest: arrays keep what they look at, and no more.
template <class Point>
struct PythonSection {
  std::shared_ptr<const std::vector<Point>> points;
  Outcome outcome;
  Statistics statistics;
  std::string method;
};

template <class Point>
PythonSection<Point> python_section(BasicSection<Point> section) {
  return {std::make_shared<const std::vector<Point>>(std::move(section.points)), section.outcome,
          section.statistics, section.method};
}

// A number of every point, from where it lies in the first.
template <class Point>
FloatArray numbers_of(const PythonSection<Point>& section, const double& (*of)(const Point&)) {
  const auto& points = section.points;
  const double* first = points->empty() ? nullptr : &of(points->front());
  return view_of(first, points->size(), sizeof(Point), {}, keeper(points));
}

template <class Point, class State>
Batch<State> batch_of(const PythonSection<Point>& section, State Point::*field) {
  const auto& points = section.points;
  if (points->empty()) return Batch<State>::filled({0}, [](State*) {});
  return Batch<State>({points->size()}, points, &(points->front().*field), sizeof(Point));
}

template <class Point>
struct Column {
  const char* name;
  const double& (*of)(const Point&);
  const char* doc;
};

using A = AndoyerPoint;
constexpr Column<A> andoyer_columns[] = {
    {"t", [](const A& p) -> const double& { return p.t; }, "(N,): the times."},
    {"l", [](const A& p) -> const double& { return p.andoyer.l; }, "(N,): l, rad."},
    {"g", [](const A& p) -> const double& { return p.andoyer.g; }, "(N,): g, rad."},
    {"h", [](const A& p) -> const double& { return p.andoyer.h; }, "(N,): h, rad."},
    {"L", [](const A& p) -> const double& { return p.andoyer.L; }, "(N,): L."},
    {"G", [](const A& p) -> const double& { return p.andoyer.G; }, "(N,): G."},
    {"H", [](const A& p) -> const double& { return p.andoyer.H; }, "(N,): H."}};
using S = SpinOrbitPoint;
constexpr Column<S> spin_orbit_columns[] = {
    {"t", [](const S& p) -> const double& { return p.t; }, "(N,): the times of the pericentres."},
    {"angle", [](const S& p) -> const double& { return p.angle; },
     "(N,): of body axis 1 from the pericentre, modulo half a turn, in (-pi/2, pi/2]."},
    {"spin", [](const S& p) -> const double& { return p.spin; },
     "(N,): of the inertial angular velocity about the normal, over the mean motion."},
    {"tilt", [](const S& p) -> const double& { return p.tilt; },
     "(N,): of body axis 3 from the normal, 0 to pi."}};

template <class Point>
using Pickle = std::tuple<nb::bytes, Outcome, Statistics, std::string>;

template <class Point>
void bind_section_class(nb::module_& m, const char* name, const char* doc,
                        std::span<const Column<Point>> columns) {
  using Section = PythonSection<Point>;
  nb::class_<Section> c(m, name, doc);
  for (const Column<Point>& column : columns) {
    c.def_prop_ro(
        column.name, [of = column.of](const Section& s) { return numbers_of(s, of); }, column.doc);
  }
  c.def_prop_ro(
       "states", [](const Section& s) { return batch_of(s, &Point::s); },
       "The points as a RotorState of shape (N,).")
      .def_ro("outcome", &Section::outcome, "How the run ended.")
      .def_ro("statistics", &Section::statistics, "What the run cost.")
      .def_ro("method", &Section::method, "In words.")
      .def("__len__", [](const Section& s) { return s.points->size(); })
      .def("__repr__",
           [name = std::string(name)](const Section& s) {
             return "<" + name + ": " + counted(s.points->size(), "point") + "; " + s.method + ">";
           })
      .def("__copy__", [](nb::handle_t<Section> self) { return self; })  // immutable
      .def(
          "__deepcopy__", [](nb::handle_t<Section> self, nb::handle) { return self; }, "memo"_a)
      .def("__getstate__",
           [](const Section& s) {
             return nb::make_tuple(nb::bytes(s.points->data(), s.points->size() * sizeof(Point)),
                                   s.outcome, s.statistics, s.method);
           })
      .def("__setstate__", [](Section& s, const Pickle<Point>& state) {
        const auto& [bytes, outcome, statistics, method] = state;
        if (bytes.size() % sizeof(Point) != 0)
          throw nb::value_error("this pickle is of another version or machine");
        auto points = std::make_shared<std::vector<Point>>(bytes.size() / sizeof(Point));
        std::memcpy(points->data(), bytes.data(), bytes.size());
        new (&s) Section{std::move(points), outcome, statistics, method};
      });
}

template <class Made>
auto made_without_gil(const char* function, const Made& made) {
  const Progress look = signal_check();
  auto section = [&] {
    const WithoutGil released;
    return python_section(made(look));
  }();
  warn_of(section.outcome, function);
  return section;
}

PythonSection<A> andoyer(const PythonProblem& python_problem, OneOf<AndoyerAngle> angle,
                         double value, OneOf<Crossing> crossing, std::optional<double> period,
                         double epoch) {
  SectionSurface surface = AndoyerSurface{choice<AndoyerAngle>(angle, "angle"), value,
                                          choice<Crossing>(crossing, "crossing")};
  if (period) surface = Strobe{*period, epoch};
  const DampedProblem problem = problem_of(python_problem);
  return made_without_gil("andoyer_section", [&](const Progress& look) {
    return andoyer_section(problem, surface, look);
  });
}

PythonSection<S> spin_orbit(const PythonProblem& python_problem,
                            const std::variant<KeplerOrbit, PrecessingKeplerOrbit>& orbit) {
  const DampedProblem problem = problem_of(python_problem);
  return made_without_gil("spin_orbit_section", [&](const Progress& look) {
    return std::visit([&](const auto& o) { return spin_orbit_section(problem, o, look); }, orbit);
  });
}

}  // namespace

void bind_section(nb::module_& m) {
  nb::enum_<AndoyerAngle>(m, "AndoyerAngle", "One of Andoyer's angles.", nb::is_arithmetic())
      .value("l", AndoyerAngle::l, "in the equator of the body")
      .value("g", AndoyerAngle::g, "in the plane normal to the angular momentum")
      .value("h", AndoyerAngle::h, "of its node");
  bind_section_class<A>(m, "AndoyerSection",
                        R"(The points of a surface of section in Andoyer's elements.

Made by andoyer_section. .t, .l, .g, .h, .L, .G, .H: (N,), read-only views, in the order of the
run; angles in (-pi, pi].)",
                        andoyer_columns);
  bind_section_class<S>(m, "SpinOrbitSection", R"(The rotation at every pericentre of an orbit.

Made by spin_orbit_section. .t, .angle, .spin, .tilt: (N,), read-only views, in the order of the
run. Where the tilt is 0 (or pi) the body turns about the normal, and angle and spin say all.)",
                        spin_orbit_columns);
  m.def("andoyer_section", andoyer, "problem"_a, "angle"_a = "g", "value"_a = 0.0,
        "crossing"_a = "rising", "period"_a = nb::none(), "epoch"_a = 0.0,
        R"(A surface of section of a run in Andoyer's elements, as for the plane of l and L.

Parameters
----------
problem : its events are not looked for.
angle : AndoyerAngle, or its name: the surface is where this angle passes a value; g or h for the
    plane of l and L.
value : of the angle, rad, modulo a turn.
crossing : Crossing, or its name: which passes count, as time runs.
period : in place of an angle: points at epoch + k period, k whole, as of a torque that is periodic.
epoch : one of these times.

Returns
-------
AndoyerSection
    Also of a run that could not go on, with its points so far and a RuntimeWarning.

The elements are the canonical ones in the reference frame of the system. Steps are kept short
enough for every pass to be seen; ValueError for a Splitting with a step too long for that.
Releases the GIL; Ctrl-C raises KeyboardInterrupt. [SA section 3.2, (84)])");
  m.def("spin_orbit_section", spin_orbit, "problem"_a, "orbit"_a,
        R"(The rotation at every pericentre of an orbit: the classical section of spin and orbit.

Parameters
----------
problem : its events are not looked for.
orbit : an ellipse in inertial axes, with an eccentricity above 0.

Returns
-------
SpinOrbitSection
    angle of body axis 1 projected onto the plane of the orbit, from the pericentre; spin, the
    angular velocity about the normal over the anomalistic mean motion; tilt of body axis 3 from the
    normal. Also of a run that could not go on, with its points so far and a RuntimeWarning.

Axis 1 is the long axis of a body whose moments ascend. ValueError for a circle and for a hyperbola.
Releases the GIL; Ctrl-C raises KeyboardInterrupt. (Wisdom, Peale and Mignard 1984))");
}

}  // namespace polhode::python
