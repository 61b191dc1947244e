// SPDX-License-Identifier: MIT
// Surfaces of section.
#include <memory>

#include "charts/states.hpp"
#include "interface/records.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "motion/dynamics_values.hpp"
#include "polhode/analysis/section.hpp"
#include "polhode/error.hpp"

namespace polhode::python {

namespace {

template <class Point>
struct PythonSection : Records<Point> {
  using Rows = Records<Point>;
  Outcome outcome;
  Statistics statistics;
  std::string method;
};

template <class Point>
void bind_section_class(nb::module_& m, const char* name, const char* doc,
                        std::initializer_list<RecordColumn<Point>> columns) {
  using Section = PythonSection<Point>;
  nb::class_<Section> c(m, name, doc);
  def_records(c, columns);
  def_pickle(c, &Section::outcome, &Section::statistics, &Section::method);
  c.def_prop_ro(
       "states",
       [](const Section& of) {
         return of.template states<RotorState>(
             [](const Point& p) -> const RotorState& { return p.s; });
       },
       "The points as a RotorState of shape (N,).")
      .def_ro("outcome", &Section::outcome, "How the run ended.")
      .def_ro("statistics", &Section::statistics, "What the run cost.")
      .def_ro("method", &Section::method, "In words.")
      .def("__repr__", [name = std::string(name)](const Section& s) {
        return "<" + name + ": " + counted(s.rows().size(), "point") + "; " + s.method + ">";
      });
}

template <class Made>
auto made_without_gil(const char* function, const Made& made) {
  const Progress look = signal_check();
  auto found = [&] {
    const WithoutGil released;
    return made(look);
  }();
  warn_of(found.outcome, function);
  using Point = typename decltype(found.points)::value_type;
  return PythonSection<Point>{Records<Point>(std::move(found.points)), found.outcome,
                              found.statistics, found.method};
}

PythonSection<analysis::AndoyerPoint> andoyer(const PythonProblem& python_problem,
                                              OneOf<analysis::AndoyerAngle> angle, double value,
                                              OneOf<Crossing> crossing,
                                              std::optional<double> period, double epoch) {
  analysis::SectionSurface surface =
      analysis::AndoyerSurface{choice<analysis::AndoyerAngle>(angle, "angle"), value,
                               choice<Crossing>(crossing, "crossing")};
  if (period) surface = analysis::Strobe{*period, epoch};
  const Problem problem = problem_of(python_problem);
  return made_without_gil("andoyer_section", [&](const Progress& look) {
    return analysis::andoyer_section(problem, surface, look);
  });
}

PythonSection<analysis::SpinOrbitPoint> spin_orbit(
    const PythonProblem& python_problem,
    const std::variant<KeplerOrbit, PrecessingKeplerOrbit>& orbit) {
  const Problem problem = problem_of(python_problem);
  return made_without_gil("spin_orbit_section", [&](const Progress& look) {
    return std::visit([&](const auto& o) { return analysis::spin_orbit_section(problem, o, look); },
                      orbit);
  });
}

}  // namespace

void bind_section(nb::module_& m) {
  nb::enum_<analysis::AndoyerAngle>(m, "AndoyerAngle", "One of Andoyer's angles.",
                                    nb::is_arithmetic())
      .value("l", analysis::AndoyerAngle::l, "in the equator of the body")
      .value("g", analysis::AndoyerAngle::g, "in the plane normal to the angular momentum")
      .value("h", analysis::AndoyerAngle::h, "of its node");
  using A = analysis::AndoyerPoint;
  bind_section_class<A>(m, "AndoyerSection",
                        R"(The points of a surface of section in Andoyer's elements.

Made by andoyer_section. .t, .l, .g, .h, .L, .G, .H: (N,), read-only views, in the order of the
run; angles in (-pi, pi].)",
                        {{"t", [](const A& p) { return &p.t; }, "(N,): the times."},
                         {"l", [](const A& p) { return &p.andoyer.l; }, "(N,): l, rad."},
                         {"g", [](const A& p) { return &p.andoyer.g; }, "(N,): g, rad."},
                         {"h", [](const A& p) { return &p.andoyer.h; }, "(N,): h, rad."},
                         {"L", [](const A& p) { return &p.andoyer.L; }, "(N,): L."},
                         {"G", [](const A& p) { return &p.andoyer.G; }, "(N,): G."},
                         {"H", [](const A& p) { return &p.andoyer.H; }, "(N,): H."}});
  using S = analysis::SpinOrbitPoint;
  bind_section_class<S>(
      m, "SpinOrbitSection", R"(The rotation at every pericentre of an orbit.

Made by spin_orbit_section. .t, .angle, .spin, .tilt: (N,), read-only views, in the order of the
run. Where the tilt is 0 (or pi) the body turns about the normal, and angle and spin say all.)",
      {{"t", [](const S& p) { return &p.t; }, "(N,): the times of the pericentres."},
       {"angle", [](const S& p) { return &p.angle; },
        "(N,): of body axis 1 from the pericentre, modulo half a turn, in (-pi/2, pi/2]."},
       {"spin", [](const S& p) { return &p.spin; },
        "(N,): of the inertial angular velocity about the normal, over the mean motion."},
       {"tilt", [](const S& p) { return &p.tilt; },
        "(N,): of body axis 3 from the normal, 0 to pi."}});
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
