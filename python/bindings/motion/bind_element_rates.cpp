// SPDX-License-Identifier: MIT
// Equations of motion of elements in any gauge.
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "charts/states.hpp"
#include "interface/dual_number.hpp"
#include "interface/gil.hpp"
#include "interface/python_function.hpp"
#include "motion/system_functions.hpp"
#include "motion/system_value.hpp"
#include "polhode/system/element_rates.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

// Python's Phi(C, t), with C an object array of six Duals and t a Dual.
class PythonPhi {
 public:
  explicit PythonPhi(SharedFunction function) : function_(std::move(function)) {}

  BasicVec3<Tangent> operator()(const rates::Gauge::Elements& C, const Tangent& t) const {
    const WithGil acquired;
    nb::list elements;
    for (const Tangent& x : C) elements.append(to_python(x));
    const nb::object array = nb::module_::import_("numpy").attr("array")(elements);
    const nb::object returned = (*function_)(array, to_python(t));
    BasicVec3<Tangent> phi;
    bool is_good = nb::hasattr(returned, "__len__") && nb::len(returned) == 3;
    for (int k = 0; k < 3 && is_good; ++k) is_good = from_python(returned[k], phi[k]);
    if (!is_good)
      function_->refuse(returned,
                        "3 numbers, the convective term: floats, or Duals "
                        "made of C and t");
    return phi;
  }

 private:
  SharedFunction function_;
};

}  // namespace

rates::Gauge gauge_of(nb::handle gauge) {
  if (nb::isinstance<nb::str>(gauge)) {
    const auto word = nb::cast<std::string>(gauge);
    if (word == "canonical") return rates::Gauge::canonical();
    if (word == "osculating") return rates::Gauge::osculating();
    throw nb::value_error(("gauge: got \"" + word +
                           R"("; expected "canonical", "osculating" or a function Phi(C, t))")
                              .c_str());
  }
  return rates::Gauge(PythonPhi(std::make_shared<PythonFunction>(gauge, "gauge")));
}

namespace {

constexpr const char* rates_doc =
    R"(Equations of motion of elements of the free rotor, in any gauge: dC/dt. [SA (104)-(111)]

Elements are those of a free motion that has the attitude of the body. The angular velocity of the
body is that of the free motion plus the convective term Phi. Canonical elements have Phi = dH'/dg
and obey Hamilton's equations; osculating elements have Phi = 0, the Lagrange constraint, so that
the free motion touches the true one; any other Phi(C, t) is a gauge as well.

Parameters
----------
system : body, frame and perturbations.
t : float or array, broadcast with the elements.
elements : AndoyerState, FukushimaIshizakiState (Andoyer's variables at an epoch, the modified
    Andoyer set), SerretState or SadovState, of any shape.
gauge : "canonical", "osculating", or a function Phi(C, t) that returns the convective term (3,)
    along the body axes, rad per time, of an object array C (6,) and a time t that are Duals.

Returns
-------
array (..., 6): angles first, then momenta, in the order of the fields; of Serret's elements
g0, h, -t0, G, H, T.

Raises
------
ValueError at a singularity of the set, and where the linear system for dC/dt is singular.

Examples
--------
>>> body = polhode.Body(3, 4, 6)
>>> state = polhode.rotor_state(body, [1, 0, 0, 0], [0.4, 0.2, 0.3])
>>> system = polhode.System(body, polhode.Frame.precessing([0, 0.6, 0.8], 0.01))
>>> C = polhode.charts.elements_of_state(system, 0.0, state, "andoyer", "osculating")
>>> polhode.rates.element_rates(system, 0.0, C, "osculating").shape
(6,)
)";

template <class C>
void bind_set(nb::module_& m) {
  m.def(
      "element_rates",
      [](const PythonSystem& system, ArrayLike t, const Batch<C>& elements, AnyGauge gauge) {
        const rates::Gauge of = gauge_of(gauge);
        Numbers times(t, "t");
        return mapped_numbers(elements, times, {6}, [&](const C& one, double at) {
          return rates::element_rates(system, at, one, of);
        });
      },
      "system"_a, "t"_a, "elements"_a, "gauge"_a = "canonical", rates_doc);
  m.def(
      "element_state",
      [](const PythonSystem& system, ArrayLike t, const Batch<C>& elements, AnyGauge gauge) {
        const rates::Gauge of = gauge_of(gauge);
        Numbers times(t, "t");
        return mapped(elements, times, [&](const C& one, double at) {
          return rates::element_state(system, at, one, of);
        });
      },
      "system"_a, "t"_a, "elements"_a, "gauge"_a = "canonical",
      "The canonical states (q, g) of bodies with these elements in this gauge: angular_velocity "
      "of them is the inertial and the relative angular velocity. Arguments as element_rates.");
  m.def(
      "element_convective_term",
      [](const PythonSystem& system, ArrayLike t, const Batch<C>& elements, AnyGauge gauge) {
        const rates::Gauge of = gauge_of(gauge);
        Numbers times(t, "t");
        return mapped_numbers(elements, times, {3}, [&](const C& one, double at) {
          return rates::element_convective_term(system, at, one, of);
        });
      },
      "system"_a, "t"_a, "elements"_a, "gauge"_a = "canonical",
      "Phi (..., 3), rad per time along the body axes: the angular velocity relative to the frame "
      "less that of the free motion of the elements. Arguments as element_rates. [SA (106)]");
}

template <class C>
nb::object of_state(const System& system, ArrayLike t, const Rotors& states,
                    const rates::Gauge& gauge, const C& like = {}) {
  Numbers times(t, "t");
  return nb::cast(mapped(states, times, [&](const RotorState& s, double at) {
    return rates::elements_of_state(system, at, s, like, gauge);
  }));
}

}  // namespace

void bind_element_rates(nb::module_& m) {
  bind_set<AndoyerState>(m);
  bind_set<FukushimaIshizakiState>(m);
  bind_set<SerretState>(m);
  bind_set<SadovState>(m);
  m.def(
      "elements_of_state",
      [](const PythonSystem& system, ArrayLike t, const Rotors& states, const std::string& chart,
         AnyGauge gauge, std::optional<double> t0)
          -> Typed<"AndoyerState | FukushimaIshizakiState | SerretState | SadovState"> {
        const rates::Gauge of = gauge_of(gauge);
        if (t0 && chart != "fukushima-ishizaki")
          throw nb::value_error("elements_of_state: t0 goes with the chart \"fukushima-ishizaki\"");
        if (chart == "andoyer") return of_state<AndoyerState>(system, t, states, of);
        if (chart == "serret") return of_state<SerretState>(system, t, states, of);
        if (chart == "sadov") return of_state<SadovState>(system, t, states, of);
        if (chart == "fukushima-ishizaki")
          return of_state(system, t, states, of,
                          FukushimaIshizakiState{0, 0, 0, 0, 0, 0, t0.value_or(0.0)});
        throw nb::value_error(
            ("elements_of_state: got the chart \"" + chart +
             R"("; expected "andoyer", "fukushima-ishizaki", "serret" or "sadov")")
                .c_str());
      },
      "system"_a, "t"_a, "state"_a, "chart"_a, "gauge"_a = "canonical", "t0"_a = nb::none(),
      "The elements of canonical states, in the chart \"andoyer\", \"fukushima-ishizaki\" (with "
      "its "
      "epoch t0; None: 0), \"serret\" or \"sadov\" and a gauge: the inverse of element_state. "
      "Other "
      "arguments as element_rates.");
}

}  // namespace polhode::python
