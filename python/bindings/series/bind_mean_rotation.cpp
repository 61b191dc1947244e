// SPDX-License-Identifier: MIT
// Mean rotation under a gravity gradient.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "charts/states.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "polhode/secular/gravity_gradient_theory.hpp"
#include "series/series_value.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;
using Means = Batch<secular::MeanRotation>;

secular::MeanRotation checked(const secular::MeanRotation& m) {
  require_finite("MeanRotation", {m.phi_l, m.phi_g, m.phi_h, m.I_l, m.I_g, m.I_h});
  return m;
}

constexpr Chart<secular::MeanRotation, 6> mean_chart{
    "MeanRotation",
    R"(Sadov's variables in the axes of an orbit, or their means over what was averaged away.

Angles phi_l, phi_g, phi_h (rad), which grow without bound, and actions I_l, I_g, I_h (momenta).
z is the normal of the orbit, x points to the pericentre. One set, or an array of any shape.)",
    {{{"phi_l", "Angle of the motion in the body, rad.", offsetof(secular::MeanRotation, phi_l)},
      {"phi_g", "Angle of the precession about the momentum, rad.",
       offsetof(secular::MeanRotation, phi_g)},
      {"phi_h", "Node of the plane normal to the momentum on the orbit, from the pericentre, rad.",
       offsetof(secular::MeanRotation, phi_h)},
      {"I_l", "Action of the motion in the body, a momentum.",
       offsetof(secular::MeanRotation, I_l)},
      {"I_g", "Size of the angular momentum.", offsetof(secular::MeanRotation, I_g)},
      {"I_h", "Its part along the normal of the orbit.", offsetof(secular::MeanRotation, I_h)}}},
    checked};

struct Rates {
  secular::GravityGradientTheory::Values all;
};
void put(double* out, const Rates& rates) { std::copy(rates.all.begin(), rates.all.end(), out); }

template <class S>
const S& single(const Batch<S>& states, const char* name) {
  if (states.shape().empty()) return states[0];
  throw DomainError("GravityGradientTheory: " + std::string(name) + ": got shape " +
                    text_of(states.shape()) + "; expected one");
}

// What it was made from, and what came of it.
struct PythonTheory {
  Body body;
  KeplerOrbit orbit;
  RotorState state;
  double t, gm;
  secular::GravityGradientTheory theory;
};

PythonTheory made(const Body& body, const KeplerOrbit& orbit, const RotorState& state, double t,
                  double gm, const secular::GravityGradientOptions& options) {
  const WithoutGil released;
  return {body, orbit, state, t, gm, {body, gm, orbit, state, t, options}};
}

// f(set, t) of sets and times that broadcast.
template <class S, class F>
auto at_times(const Batch<S>& sets, const ArrayLike& t, F f) {
  Numbers times(t, "t");
  return mapped(sets, times, f);
}

// At times of any shape.
template <class S>
using AtTimes = std::vector<S> (secular::GravityGradientTheory::*)(double,
                                                                   const secular::MeanRotation&,
                                                                   std::span<const double>, double,
                                                                   const Progress&) const;
template <class S>
Batch<S> moved(const PythonTheory& of, AtTimes<S> by, double t0, const Means& mean,
               const ArrayLike& times, double tolerance) {
  const Numbers at(times, "times");
  std::vector<double> all;
  for (std::size_t k = 0; k < size_of(at.shape()); ++k) all.push_back(at[k]);
  const secular::MeanRotation& start = single(mean, "mean");
  const Progress look = signal_check();
  const std::vector<S> found = [&] {
    const WithoutGil released;
    return (of.theory.*by)(t0, start, all, tolerance, look);
  }();
  return Batch<S>::filled(
      at.shape(), [&](S* out) { std::uninitialized_copy(found.begin(), found.end(), out); });
}

void def_maps(nb::class_<PythonTheory>& c) {
  using T = PythonTheory;
  c.def(
       "mean",
       [](const T& of, const ArrayLike& t, const Rotors& state) {
         return at_times(state, t,
                         [&](const RotorState& s, double at) { return of.theory.mean(at, s); });
       },
       "t"_a, "state"_a,
       R"(Mean elements of osculating states at times t, which broadcast.

The inverse of osculating to rounding. ValueError for a state in another mode or lobe, or with
actions farther from those of the theory than it holds.)")
      .def(
          "osculating",
          [](const T& of, const ArrayLike& t, const Means& mean) {
            return at_times(mean, t, [&](const secular::MeanRotation& m, double at) {
              return of.theory.osculating(at, m);
            });
          },
          "t"_a, "mean"_a,
          R"(States with these mean elements at times t: short periods restored.

t and mean broadcast. ValueError as for mean.)")
      .def(
          "elements",
          [](const T& of, const ArrayLike& t, const Rotors& state) {
            return at_times(state, t, [&](const RotorState& s, double at) {
              return of.theory.elements(at, s);
            });
          },
          "t"_a, "state"_a,
          "Sadov's variables of states in the axes of the orbit: the osculating elements, angles "
          "in (-pi, pi].")
      .def(
          "state_of",
          [](const T& of, const Means& elements) {
            return mapped(elements,
                          [&](const secular::MeanRotation& m) { return of.theory.state_of(m); });
          },
          "elements"_a, "The states with these Sadov's variables: elements, backwards.")
      .def(
          "rates",
          [](const T& of, const ArrayLike& t, const Means& mean) {
            Numbers times(t, "t");
            return mapped_numbers(mean, times, {6}, [&](const secular::MeanRotation& m, double at) {
              return Rates{of.theory.rates(DoubleDouble(at), of.theory.values<double>(m))};
            });
          },
          "t"_a, "mean"_a,
          "(..., 6): time derivatives of the mean phi_l, phi_g, phi_h (rad per time), I_l, I_g and "
          "I_h; those of I_l and I_g are 0.");
}

void def_runs(nb::class_<PythonTheory>& c) {
  using T = PythonTheory;
  c.def(
       "means",
       [](const T& of, double t0, const Means& mean, const ArrayLike& times, double tolerance) {
         return moved<secular::MeanRotation>(of, &secular::GravityGradientTheory::means, t0, mean,
                                             times, tolerance);
       },
       "t0"_a, "mean"_a, "times"_a, "tolerance"_a = 1e-12,
       R"(Mean elements at times of the motion that has these at t0.

Parameters
----------
t0 : a time.
mean : MeanRotation, one.
times : of any shape and order, before and after t0.
tolerance : of Adaptive, which integrates the mean Hamiltonian; rad, and relative to I_g.

Releases the GIL; Ctrl-C raises KeyboardInterrupt. ValueError for times that are not finite.)")
      .def(
          "states",
          [](const T& of, double t0, const Means& mean, const ArrayLike& times, double tolerance) {
            return moved<RotorState>(of, &secular::GravityGradientTheory::states, t0, mean, times,
                                     tolerance);
          },
          "t0"_a, "mean"_a, "times"_a, "tolerance"_a = 1e-12,
          R"(States at times of the motion that has these mean elements at t0.

osculating(times, means(t0, mean, times, tolerance)), with the same arguments.)");
}

void def_parts(nb::class_<PythonTheory>& c) {
  using T = PythonTheory;
  c.def_prop_ro(
       "body", [](const T& of) { return of.body; }, "The body that turns.")
      .def_prop_ro(
          "orbit", [](const T& of) { return of.orbit; }, "Where the attracting body is.")
      .def_prop_ro(
          "gm", [](const T& of) { return of.gm; }, "Of the attracting body, length^3 / time^2.")
      .def_prop_ro(
          "order", [](const T& of) { return of.theory.options().order; }, "1 or 2.")
      .def_prop_ro(
          "averages_orbit", [](const T& of) { return of.theory.options().averages_orbit; },
          "Whether the mean anomaly M is averaged away too.")
      .def_prop_ro(
          "least", [](const T& of) { return of.theory.options().least; },
          "Short periods that move angles by less are left out, rad.")
      .def_prop_ro(
          "reference", [](const T& of) { return Means::one(of.theory.reference()); },
          "The elements about whose actions coefficients are expanded.")
      .def_prop_ro(
          "mean_hamiltonian",
          [](const T& of) { return PythonSeries{of.theory.mean_hamiltonian()}; },
          "A Series in phi_h, M and the displacements I_l, I_g and I_h from the reference; k "
          "counts orders, and is 1.")
      .def_prop_ro(
          "term_count", [](const T& of) { return of.theory.term_count(); },
          "How many terms of the gravity gradient are kept.")
      .def_prop_ro(
          "rate_error", [](const T& of) { return of.theory.rate_error(); },
          "Estimated drift of the mean angles from the motion, rad per time: what the next order "
          "and the short periods that are left out would change in their rates.")
      .def("__repr__",
           [](const T& of) {
             return "<GravityGradientTheory: order " + std::to_string(of.theory.options().order) +
                    ", " + std::to_string(of.theory.term_count()) + " terms>";
           })
      .def("__copy__", [](const T& of) { return of; })
      .def(
          "__deepcopy__", [](const T& of, nb::handle) { return of; }, "memo"_a)
      .def("__getstate__",
           [](const T& of) {
             const secular::GravityGradientOptions& o = of.theory.options();
             return nb::make_tuple(of.body, of.orbit, Rotors::one(of.state), of.t, of.gm, o.order,
                                   o.averages_orbit, o.least);
           })
      .def("__setstate__",
           [](T& self,
              const std::tuple<Body, KeplerOrbit, Rotors, double, double, int, bool, double>& s) {
             const auto& [body, orbit, state, t, gm, order, averages, least] = s;
             new (&self) T(made(body, orbit, state[0], t, gm, {order, averages, least}));
           });
}

}  // namespace

void bind_mean_rotation(nb::module_& m) {
  bind_states<6>(m, mean_chart);
  using T = PythonTheory;
  nb::class_<T> c(m, "GravityGradientTheory",
                  R"(Mean elements of a rigid body under the gravity gradient of a Kepler orbit.

A Lie transform of the first or second order removes the fast angles phi_l and phi_g of Sadov's
variables, and M, the mean anomaly, if the orbit is averaged too. The body may be triaxial and turn
in short- or long-axis mode. A theory belongs to the motion through one state, and to those near it.

Parameters
----------
body : Body.
orbit : KeplerOrbit of the attracting body as seen from the body, or the other way round; an
    ellipse, eccentricity at most 0.9.
state : RotorState, one, at time t, in the axes of the orbit's elements.
t : a time.
gm : of the attracting body, length^3 / time^2; None: that of the orbit.
order : 1 or 2. Errors are of order + 1 in the strength of the torque.
averages_orbit : False keeps M in the mean Hamiltonian, and what is in resonance with it.
least : short periods that move angles by less are left out, rad. Mean angles then drift by some
    of it in each radian of rotation: see rate_error.

ValueError for a sphere, for spin about an axis, momentum along the normal of the orbit and the
separatrix, or next to them; for a resonance of phi_l, phi_g and M, with its combination; for a
torque that moves the body too far. Releases the GIL. (Hori 1966; Cochran 1972))");
  c.def(
      "__init__",
      [](T* self, const Body& body, const KeplerOrbit& orbit, const Rotors& state, double t,
         std::optional<double> gm, int order, bool averages_orbit, double least) {
        new (self) T(made(body, orbit, single(state, "state"), t, gm.value_or(orbit.gm()),
                          {order, averages_orbit, least}));
      },
      "body"_a, "orbit"_a, "state"_a, "t"_a = 0.0, nb::kw_only(), "gm"_a = nb::none(),
      "order"_a = 2, "averages_orbit"_a = true, "least"_a = 1e-15);
  def_maps(c);
  def_runs(c);
  def_parts(c);
}

}  // namespace polhode::python
