// SPDX-License-Identifier: MIT
// Satellites under any perturbation in a moving frame, and their elements in any gauge.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "charts/states.hpp"
#include "interface/dual_number.hpp"
#include "interface/gil.hpp"
#include "interface/object_slots.hpp"
#include "interface/recipe.hpp"
#include "interface/signals.hpp"
#include "motion/dynamics_values.hpp"
#include "motion/frame_value.hpp"
#include "motion/system_functions.hpp"
#include "polhode/dynamics/satellite_path.hpp"
#include "polhode/system/satellite_system.hpp"

namespace polhode::python {

namespace {

using Satellites = Batch<satellites::SatelliteState>;

satellites::SatelliteState checked(const satellites::SatelliteState& s) {
  require_finite("SatelliteState: r", {s.r.x, s.r.y, s.r.z});
  require_finite("SatelliteState: p", {s.p.x, s.p.y, s.p.z});
  return s;
}

constexpr Chart<satellites::SatelliteState, 2> satellite_chart{
    "SatelliteState",
    R"(Position r (..., 3) and momentum per unit mass p (..., 3) of a satellite, along a frame.

Without a perturbation that depends on p, the momentum is the velocity relative to inertial axes.
One state or an array of states: the arguments broadcast. ValueError for numbers that are not
finite.)",
    {{{"r", "Position, length; (..., 3).", offsetof(satellites::SatelliteState, r), Kind::vector},
      {"p", "Momentum per unit mass, length per time; (..., 3).",
       offsetof(satellites::SatelliteState, p), Kind::vector}}},
    checked};

// Python's H(t, r, p) on Duals.
class PythonOrbitalEnergy {
 public:
  explicit PythonOrbitalEnergy(SharedFunction function) : function_(std::move(function)) {}

  template <Real T>
  T operator()(const T& t, const satellites::BasicSatelliteState<T>& s) const {
    const WithGil acquired;
    const nb::object returned = (*function_)(time(t), to_python(s.r), to_python(s.p));
    T out(0.0);
    if (!from_python(returned, out))
      function_->refuse(returned, "a number, the energy: a float, or a Dual made of r and p");
    return out;
  }

 private:
  template <class T>
  static nb::object time(const T& t) {
    if constexpr (std::same_as<T, Dual<DoubleDouble, 6>>)
      return to_python(t);
    else
      return nb::float_(to_double(t));
  }
  SharedFunction function_;
};

struct PythonOrbitalPerturbation : satellites::OrbitalPerturbation {
  PythonOrbitalPerturbation(satellites::OrbitalPerturbation of, Recipe made_from)
      : satellites::OrbitalPerturbation(std::move(of)), recipe(std::move(made_from)) {}

  Recipe recipe;
};

void bind_perturbation(nb::module_& m) {
  using P = PythonOrbitalPerturbation;
  nb::class_<P> c(m, "OrbitalPerturbation",
                  R"(An energy H'(t, r, p) per unit mass that perturbs a Kepler orbit.

Parameters
----------
function : H(t, r, p) -> energy; r (3,) and p (3,) are object arrays of Duals along the frame, t a
    float or a Dual. Written with + - * / ** @ and NumPy's functions; dH'/dr and dH'/dp follow by
    dual numbers.

Examples
--------
>>> drift = polhode.OrbitalPerturbation(lambda t, r, p: 1e-6 * r[0] * p[1])
)",
                  nb::type_slots(recipe_slots<P>()));
  c.def(
       "__init__",
       [](P* self,
          Typed<"typing.Callable[[typing.Any, typing.Any, typing.Any], Dual | float]"> function) {
         const auto shared = std::make_shared<PythonFunction>(function, "OrbitalPerturbation");
         new (self) P(satellites::OrbitalPerturbation(PythonOrbitalEnergy(shared)),
                      recipe_of("", {"function"}, nb::make_tuple(function), {shared}));
       },
       "function"_a)
      .def_static(
          "oblateness",
          [](double gm, double J2, double radius) {
            return P(
                satellites::oblateness(gm, J2, radius),
                recipe_of("oblateness", {"gm", "J2", "radius"}, nb::make_tuple(gm, J2, radius)));
          },
          "gm"_a, "J2"_a, "radius"_a,
          "The oblateness of a planet about the third axis of the frame: gm J2 radius^2 / r^3 "
          "P_2(z/r). ValueError unless the numbers are finite and the radius is positive.");
  def_recipe<P>(c, [](const P&) { return std::string("OrbitalPerturbation"); });
}

struct PythonSatelliteSystem : satellites::SatelliteSystem {
  PythonSatelliteSystem(satellites::SatelliteSystem system, nb::object frame, nb::tuple terms)
      : satellites::SatelliteSystem(std::move(system)),
        python_frame(std::move(frame)),
        python_terms(std::move(terms)) {}

  Typed<"Frame"> python_frame;
  Typed<"tuple[OrbitalPerturbation, ...]"> python_terms;
};

void make_satellite_system(PythonSatelliteSystem* self, double gm, Typed<"Frame | None"> frame,
                           Typed<"collections.abc.Iterable[OrbitalPerturbation]"> terms) {
  nb::object of = frame_or_inertial(frame, "SatelliteSystem");
  nb::tuple all = nb::tuple(terms);
  std::vector<satellites::OrbitalPerturbation> values;
  for (const nb::handle term : all) {
    if (!nb::isinstance<PythonOrbitalPerturbation>(term))
      throw nb::type_error(
          ("SatelliteSystem: terms: got " + class_name(term) + "; expected OrbitalPerturbation")
              .c_str());
    values.push_back(nb::cast<const PythonOrbitalPerturbation&>(term));
  }
  const Frame& value = nb::cast<const PythonFrame&>(of);
  satellites::SatelliteSystem system(gm, value, std::move(values));
  new (self) PythonSatelliteSystem(std::move(system), std::move(of), std::move(all));
}

nb::tuple arguments_of(const PythonSatelliteSystem& s) {
  return nb::make_tuple(s.gm(), s.python_frame, s.python_terms);
}

void bind_system_class(nb::module_& m) {
  using S = PythonSatelliteSystem;
  nb::class_<S> c(m, "SatelliteSystem",
                  R"(A satellite about a planet: a Kepler orbit, perturbations and a moving frame.

H = p^2/2 - gm/r + H'(t, r, p) - mu . (r x p), mu the rate of the frame. Hamilton's equations of it
are dr/dt = p + dH'/dp - mu x r, dp/dt = -gm r/r^3 - dH'/dr - mu x p. [SA (101), (108)]

Parameters
----------
gm : gravitational parameter of the planet, length^3 / time^2, positive.
frame : Frame whose axes r and p refer to; None: inertial axes.
terms : sequence of OrbitalPerturbation.

Examples
--------
>>> gm, J2, radius = 4.28284e13, 1.96e-3, 3.396e6
>>> system = polhode.satellites.SatelliteSystem(
...     gm, polhode.Frame.precessing([0, 0.43, 0.9], 1e-10),
...     [polhode.OrbitalPerturbation.oblateness(gm, J2, radius)])
)",
                  nb::type_slots(object_slots<S, &S::python_frame, &S::python_terms>()));
  c.def("__init__", make_satellite_system, "gm"_a, "frame"_a = nb::none(),
        "terms"_a = nb::make_tuple())
      .def_prop_ro(
          "gm", [](const S& s) { return s.gm(); }, "Gravitational parameter of the planet.")
      .def_prop_ro(
          "frame", [](const S& s) { return s.python_frame; }, "The very object that was given.")
      .def_prop_ro(
          "terms", [](const S& s) { return s.python_terms; }, "The very objects that were given.");
  def_object(
      c, [](const S& s) { return arguments_of(s); },
      [](const S& s) {
        return "SatelliteSystem" + nb::cast<std::string>(nb::repr(arguments_of(s)));
      });
}

void bind_motion(nb::module_& m) {
  using Path = BasicTrajectory<satellites::SatelliteState>;
  m.def(
      "satellite_rates",
      [](const PythonSatelliteSystem& system, ArrayLike t, const Satellites& states) {
        Numbers times(t, "t");
        return mapped_numbers(
            states, times, {6}, [&](const satellites::SatelliteState& s, double at) {
              const satellites::SatelliteState rate = satellites::satellite_rates(system, at, s);
              return std::array<double, 6>{rate.r.x, rate.r.y, rate.r.z,
                                           rate.p.x, rate.p.y, rate.p.z};
            });
      },
      "system"_a, "t"_a, "state"_a,
      "(dr/dt, dp/dt) (..., 6) of a satellite: Hamilton's equations in the frame of the system.");
  m.def(
      "energy",
      [](const PythonSatelliteSystem& system, ArrayLike t, const Satellites& states) -> Floats {
        Numbers times(t, "t");
        return mapped_numbers(states, times, {},
                              [&](const satellites::SatelliteState& s, double at) {
                                return satellites::energy(system, at, s);
                              });
      },
      "system"_a, "t"_a, "state"_a,
      "The Hamiltonian of a satellite (...), per unit mass; constant if nothing depends on time.");
  nb::class_<Path>(m, "SatellitePath", "The motion of a satellite, made by satellite_path.")
      .def_prop_ro("start", &Path::start, "Its first time.")
      .def_prop_ro("stop", &Path::stop, "Its last time.")
      .def_prop_ro("outcome", &Path::outcome, "How the run ended.")
      .def_prop_ro("statistics", &Path::statistics, "What it cost.")
      .def(
          "at",
          [](const Path& path, ArrayLike t) {
            const Numbers times(t, "t");
            return mapped(times, [&](double at) { return path.at(at); });
          },
          "t"_a, "SatelliteState at times t of any shape; ValueError outside of the run.");
  m.def(
      "satellite_path",
      [](const PythonSatelliteSystem& system, const Satellites& state, double start, double stop,
         Typed<"Adaptive | Collocation | None"> method) {
        if (!state.shape().empty())
          throw nb::value_error("satellite_path: state: expected one state");
        const Method chosen = method.is_none() ? Method(satellites::default_path_method)
                                               : method_of(method, "satellite_path");
        const Progress look = signal_check();
        Path path = [&] {
          const WithoutGil released;
          return satellites::satellite_path(system, state[0], start, stop, chosen, look);
        }();
        warn_of(path.outcome(), "satellite_path");
        return path;
      },
      "system"_a, "state"_a, "start"_a, "stop"_a, "method"_a = nb::none(),
      R"(Integrates position and momentum of a satellite, with dense output.

Parameters
----------
system : SatelliteSystem.
state : one SatelliteState at `start`.
start, stop : times; stop may lie before start.
method : Collocation or Adaptive; None: Collocation with the tolerance 1e-15.

Returns
-------
SatellitePath, whose at(t) is the state at any time of the run.

Warns
-----
RuntimeWarning if the run fails, for example at the centre of the planet.)");
}

constexpr const char* rates_doc =
    R"(Equations of motion of a satellite's elements, in any gauge: dC/dt (..., 6).

Elements are those of a Kepler orbit with the position of the satellite and a velocity u of its own:
dr/dt = u + Phi. Canonical elements have Phi = dH'/dp - mu x r and obey Hamilton's equations;
osculating elements have Phi = 0; any Phi(C, t) is a gauge as well. [SA (96), (104)-(107)]

Parameters
----------
system : SatelliteSystem.
t : float or array, broadcast with the elements.
elements : (..., 6). "delaunay": l, g, h, L, G, H; "keplerian": a, e, i, Omega, omega, M; rad,
    referred to the axes of the frame.
gauge : "canonical", "osculating", or a function Phi(C, t) that returns the convective term (3,)
    along the frame, length per time, of an object array C (6,) and a time t that are Duals.
chart : "delaunay" or "keplerian".

Raises
------
ValueError for an orbit that is not bound, at e = 0 and i = 0 or pi, and where the linear system for
dC/dt is singular.)";

satellites::OrbitalSet set_of(const std::string& chart, const char* function) {
  if (chart == "delaunay") return satellites::OrbitalSet::delaunay;
  if (chart == "keplerian") return satellites::OrbitalSet::keplerian;
  throw nb::value_error((std::string(function) + ": got the chart \"" + chart +
                         R"("; expected "delaunay" or "keplerian" for a satellite)")
                            .c_str());
}

// f(elements, t) at every position of elements and times that broadcast.
template <class F>
void at_all(ArrayLike elements, ArrayLike t, F f) {
  std::vector<Numbers> both;
  both.emplace_back(elements, "elements", std::initializer_list<std::size_t>{6});
  both.emplace_back(t, "t");
  const Shape shape = broadcast(both);
  f(shape, [&](std::size_t k) {
    satellites::OrbitalElements C;
    std::copy_n(both[0].at(k), 6, C.begin());
    return std::pair(C, both[1][k]);
  });
}

void bind_elements(nb::module_& m) {
  m.def(
      "element_rates",
      [](const PythonSatelliteSystem& system, ArrayLike t, ArrayLike elements, AnyGauge gauge,
         const std::string& chart) {
        const rates::Gauge of = gauge_of(gauge);
        const satellites::OrbitalSet set = set_of(chart, "element_rates");
        nb::object rates;
        at_all(elements, t, [&](const Shape& shape, const auto& at) {
          Result result(shape, {6});
          for_each(size_of(shape), [&](std::size_t k) {
            const auto [C, time] = at(k);
            put(result.at(k), element_rates(system, time, C, set, of));
          });
          rates = nb::cast(result.take());
        });
        return rates;
      },
      "system"_a, "t"_a, "elements"_a, "gauge"_a = "canonical", "chart"_a = "delaunay", rates_doc);
  m.def(
      "element_convective_term",
      [](const PythonSatelliteSystem& system, ArrayLike t, ArrayLike elements, AnyGauge gauge,
         const std::string& chart) {
        const rates::Gauge of = gauge_of(gauge);
        const satellites::OrbitalSet set = set_of(chart, "element_convective_term");
        nb::object terms;
        at_all(elements, t, [&](const Shape& shape, const auto& at) {
          Result result(shape, {3});
          for_each(size_of(shape), [&](std::size_t k) {
            const auto [C, time] = at(k);
            put(result.at(k), element_convective_term(system, time, C, set, of));
          });
          terms = nb::cast(result.take());
        });
        return terms;
      },
      "system"_a, "t"_a, "elements"_a, "gauge"_a = "canonical", "chart"_a = "delaunay",
      "Phi (..., 3) of a satellite's elements: the velocity relative to the frame less that of the "
      "Kepler orbit. Arguments as element_rates.");
  m.def(
      "element_state",
      [](const PythonSatelliteSystem& system, ArrayLike t, ArrayLike elements, AnyGauge gauge,
         const std::string& chart) {
        const rates::Gauge of = gauge_of(gauge);
        const satellites::OrbitalSet set = set_of(chart, "element_state");
        std::optional<Satellites> states;
        at_all(elements, t, [&](const Shape& shape, const auto& at) {
          states = Satellites::filled(shape, [&](satellites::SatelliteState* out) {
            for_each(size_of(shape), [&](std::size_t k) {
              const auto [C, time] = at(k);
              out[k] = element_state(system, time, C, set, of);
            });
          });
        });
        return *states;
      },
      "system"_a, "t"_a, "elements"_a, "gauge"_a = "canonical", "chart"_a = "delaunay",
      "The states (r, p) of satellites with these elements in this gauge. Arguments as "
      "element_rates.");
  m.def(
      "elements_of_state",
      [](const PythonSatelliteSystem& system, ArrayLike t, const Satellites& states,
         const std::string& chart, AnyGauge gauge) {
        const rates::Gauge of = gauge_of(gauge);
        const satellites::OrbitalSet set = set_of(chart, "elements_of_state");
        Numbers times(t, "t");
        return mapped_numbers(states, times, {6},
                              [&](const satellites::SatelliteState& s, double at) {
                                return elements_of_state(system, at, s, set, of);
                              });
      },
      "system"_a, "t"_a, "state"_a, "chart"_a, "gauge"_a = "canonical",
      "The elements (..., 6) of a satellite's states in the chart \"delaunay\" or \"keplerian\" "
      "and a gauge: the inverse of element_state.");
}

}  // namespace

void bind_satellite(nb::module_& m) {
  bind_states<2>(m, satellite_chart);
  bind_perturbation(m);
  bind_system_class(m);
  bind_motion(m);
  bind_elements(m);
}

}  // namespace polhode::python
