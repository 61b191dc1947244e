// SPDX-License-Identifier: MIT
// The normal form of the free triaxial rotor.
#include <cstddef>
#include <memory>

#include "charts/states.hpp"
#include "interface/value.hpp"
#include "polhode/secular/triaxial_normal_form.hpp"
#include "series/series_value.hpp"

namespace polhode::python {

namespace {

struct PythonNormalForm {
  Body body;
  int order;
  std::shared_ptr<const secular::TriaxialNormalForm> form;
};

PythonNormalForm normal_form_of(const Body& body, int order) {
  const WithoutGil released;
  return {body, order, std::make_shared<const secular::TriaxialNormalForm>(body, order)};
}

secular::RotorFrequencies unchecked(const secular::RotorFrequencies& n) { return n; }
constexpr Chart<secular::RotorFrequencies, 2> frequencies_chart{
    "RotorFrequencies",
    "Rates of the mean angles of a free rotor, n_l and n_g (rad per time).",
    {{{"n_l", "Rate of the mean l, rad per time.", offsetof(secular::RotorFrequencies, n_l)},
      {"n_g", "Rate of the mean g, rad per time.", offsetof(secular::RotorFrequencies, n_g)}}},
    unchecked};

// L and G, which broadcast.
struct Momenta {
  std::array<Numbers, 2> both;
  Shape shape;

  Momenta(const ArrayLike& L, const ArrayLike& G)
      : both{Numbers(L, "L"), Numbers(G, "G")}, shape(broadcast(both)) {}
  double L(std::size_t k) const { return both[0][k]; }
  double G(std::size_t k) const { return both[1][k]; }
};

void def_functions(nb::class_<PythonNormalForm>& c) {
  using F = PythonNormalForm;
  c.def_prop_ro(
       "triaxiality", [](const F& f) { return f.form->triaxiality(); },
       "e = (1/A - 1/B) / (1/A + 1/B - 2/C).")
      .def_prop_ro(
          "series", [](const F& f) { return PythonSeries{f.form->series()}; },
          "h(L, G, e) of the mean momenta, exact and the same of every body: the energy is a G^2/2 "
          "+ b h with a = (1/A + 1/B)/2, b = a - 1/C.")
      .def(
          "energy",
          [](const F& f, const ArrayLike& L, const ArrayLike& G) {
            const Momenta at(L, G);
            Result result(at.shape, {});
            for_each(size_of(at.shape),
                     [&](std::size_t k) { *result.at(k) = f.form->energy(at.L(k), at.G(k)); });
            return result.take();
          },
          "L"_a, "G"_a, "Kinetic energy at mean momenta, which broadcast. NaN at L = 0.")
      .def(
          "frequencies",
          [](const F& f, const ArrayLike& L, const ArrayLike& G) {
            const Momenta at(L, G);
            return Batch<secular::RotorFrequencies>::filled(
                at.shape, [&](secular::RotorFrequencies* out) {
                  for_each(size_of(at.shape),
                           [&](std::size_t k) { out[k] = f.form->frequencies(at.L(k), at.G(k)); });
                });
          },
          "L"_a, "G"_a, "Rates of the mean angles (rad per time) at mean momenta, which broadcast.")
      .def(
          "mean",
          [](const F& f, const Batch<AndoyerState>& osculating) {
            return mapped(osculating, [&](const AndoyerState& s) { return f.form->mean(s); });
          },
          "osculating"_a,
          "Mean states of osculating ones: L and G are Sadov's actions I_l and I_g, l and g his "
          "phi_l + pi/2 and phi_g.")
      .def(
          "osculating",
          [](const F& f, const Batch<AndoyerState>& mean) {
            return mapped(mean, [&](const AndoyerState& s) { return f.form->osculating(s); });
          },
          "mean"_a, "Osculating states of mean ones.")
      .def(
          "mean_error",
          [](const F& f, const Batch<AndoyerState>& osculating) {
            return mapped_numbers(osculating, {},
                                  [&](const AndoyerState& s) { return f.form->mean_error(s); });
          },
          "osculating"_a,
          "Estimated error of mean(osculating), by the last terms of its series: of l and g in "
          "rad, "
          "of L in parts of G, whichever is largest.")
      .def(
          "osculating_error",
          [](const F& f, const Batch<AndoyerState>& mean) {
            return mapped_numbers(
                mean, {}, [&](const AndoyerState& s) { return f.form->osculating_error(s); });
          },
          "mean"_a, "The same of osculating(mean).")
      .def(
          "frequency_error",
          [](const F& f, const ArrayLike& L, const ArrayLike& G) {
            const Momenta at(L, G);
            Result result(at.shape, {});
            for_each(size_of(at.shape), [&](std::size_t k) {
              *result.at(k) = f.form->frequency_error(at.L(k), at.G(k));
            });
            return result.take();
          },
          "L"_a, "G"_a, "Estimated relative error of frequencies(L, G), by their last terms.");
}

}  // namespace

void bind_normal_form(nb::module_& m) {
  bind_states<2>(m, frequencies_chart);
  using T = PythonNormalForm;
  auto c = bind_made_value<T>(m, "TriaxialNormalForm",
                              R"(The free triaxial rotor as a series in its triaxiality e.

H = (G^2 - L^2)/2 (sin^2 l/A + cos^2 l/B) + L^2/(2 C), from which a Lie transform removes l, exactly
in fractions. The mean momenta are Sadov's actions; mean angles advance at constant rates.

Parameters
----------
body : Body with moments that rise, A <= B < C.
order : the highest power of e, 1 to 16.

For rotation in short-axis mode. The series converge as those of 1/(1 - r): of osculating states
r = e (1 + sin^2 J |cos 2l|) / cos^2 J, of mean momenta r = e (2 - k)/k with
k = sin^2(pi L/(2 G)), which is 1 on the separatrix. Where r >= 1, and at L = 0, all is NaN. The
error is r^(order + 1) of the maps, the next even power of frequencies and energy: mean_error,
osculating_error and frequency_error estimate it. Any consistent units; rad.

ValueError for other moments and orders, and for the mean of a state in long-axis mode.
Releases the GIL; 14 ms at order 8. [SA 3.2, 5])",
                              normal_form_of, field("body", &T::body, "What was given."),
                              field("order", &T::order, "The highest power of the triaxiality."));
  def_functions(c);
}

}  // namespace polhode::python
