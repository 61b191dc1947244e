// SPDX-License-Identifier: MIT
// The generating functions of Serret's and Sadov's transformations, and the sets of Kinoshita and
// of Fukushima and Ishizaki.
#include <vector>

#include "charts/states.hpp"
#include "interface/value.hpp"
#include "polhode/free/fukushima_ishizaki.hpp"
#include "polhode/free/generating_function.hpp"
#include "polhode/free/kinoshita.hpp"

namespace polhode::python {

namespace {

free::GeneratingFunction checked(const free::GeneratingFunction& s) {
  require_finite("GeneratingFunction",
                 {s.S, s.Phi, s.Theta, s.Psi, s.g0, s.h, s.minus_t0, s.minus_T});
  return s;
}
free::SadovGeneratingFunction checked(const free::SadovGeneratingFunction& s) {
  require_finite("SadovGeneratingFunction", {s.W, s.V, s.L, s.G, s.H, s.phi_l, s.phi_g, s.phi_h});
  return s;
}
free::SadovQuadratures checked(const free::SadovQuadratures& s) {
  require_finite("SadovQuadratures", {s.z, s.I_l, s.dI_l_dlambda, s.dlambda_dI_l, s.dlambda_dI_g,
                                      s.L_dl, s.dL_dlambda_dl, s.phi_l, s.phi_g_minus_g});
  return s;
}
KinoshitaState checked(const KinoshitaState& s) {
  require_finite("KinoshitaState", {s.l, s.g, s.h, s.L, s.G, s.H});
  if (s.region != SadovRegion::short_axis && s.region != SadovRegion::long_axis)
    throw DomainError("KinoshitaState: region: expected a SadovRegion");
  if (s.lobe != 1 && s.lobe != -1) throw DomainError("KinoshitaState: lobe: expected 1 or -1");
  return s;
}
FukushimaIshizakiState checked(const FukushimaIshizakiState& s) {
  require_finite("FukushimaIshizakiState", {s.l0, s.g0, s.h, s.L0, s.G, s.H, s.t0});
  return s;
}

constexpr Chart<free::GeneratingFunction, 8> generating_chart{
    "GeneratingFunction",
    R"(The function S that turns Euler's variables into Serret's constants, with its derivatives.

S(phi, theta, psi; G, H, T; t), an action; Phi, Theta, Psi: by the angles; g0, h (rad), minus_t0:
by G, H, T; minus_T: by t, the Jacobi equation. [SA (43), (51), (55)-(62)])",
    {{{"S", "The function, an action.", offsetof(free::GeneratingFunction, S)},
      {"Phi", "dS/dphi, a momentum.", offsetof(free::GeneratingFunction, Phi)},
      {"Theta", "dS/dtheta, a momentum.", offsetof(free::GeneratingFunction, Theta)},
      {"Psi", "dS/dpsi, a momentum.", offsetof(free::GeneratingFunction, Psi)},
      {"g0", "dS/dG, rad.", offsetof(free::GeneratingFunction, g0)},
      {"h", "dS/dH, rad.", offsetof(free::GeneratingFunction, h)},
      {"minus_t0", "dS/dT, a time: -t0.", offsetof(free::GeneratingFunction, minus_t0)},
      {"minus_T", "dS/dt, an energy: -T.", offsetof(free::GeneratingFunction, minus_T)}}},
    checked};

constexpr Chart<free::SadovGeneratingFunction, 8> sadov_generating_chart{
    "SadovGeneratingFunction",
    R"(The function W that turns Andoyer's variables into Sadov's, with its derivatives.

W(l, g, h; I_l, I_g, I_h) = I_g g + I_h h + V(l; I_l, I_g), actions. L, G, H: by l, g, h; phi_l,
phi_g, phi_h (rad): by I_l, I_g, I_h. [SA "ActioTransf", "transf. eqs"])",
    {{{"W", "The function, an action.", offsetof(free::SadovGeneratingFunction, W)},
      {"V", "Its part that depends on l, the integral of L dl; an action.",
       offsetof(free::SadovGeneratingFunction, V)},
      {"L", "dW/dl, a momentum.", offsetof(free::SadovGeneratingFunction, L)},
      {"G", "dW/dg, a momentum.", offsetof(free::SadovGeneratingFunction, G)},
      {"H", "dW/dh, a momentum.", offsetof(free::SadovGeneratingFunction, H)},
      {"phi_l", "dW/dI_l, rad.", offsetof(free::SadovGeneratingFunction, phi_l)},
      {"phi_g", "dW/dI_g, rad.", offsetof(free::SadovGeneratingFunction, phi_g)},
      {"phi_h", "dW/dI_h, rad.", offsetof(free::SadovGeneratingFunction, phi_h)}}},
    checked};

constexpr Chart<free::SadovQuadratures, 9> quadratures_chart{
    "SadovQuadratures",
    R"(The integrals of L dl and dL/dlambda dl that lead from Andoyer's variables to Sadov's.

Those over a loop are I_l and its derivatives, those from z = 0 are L_dl and dL_dlambda_dl. All for
L > 0. [SA "changeAction", "IellSadov", "quad L dl", "phiSadov"])",
    {{{"z", "Auxiliary angle of l, rad.", offsetof(free::SadovQuadratures, z)},
      {"I_l", "(1/2pi) of the loop integral of L dl, an action.",
       offsetof(free::SadovQuadratures, I_l)},
      {"dI_l_dlambda", "dI_l/dlambda at constant I_g.",
       offsetof(free::SadovQuadratures, dI_l_dlambda)},
      {"dlambda_dI_l", "dlambda/dI_l at constant I_g.",
       offsetof(free::SadovQuadratures, dlambda_dI_l)},
      {"dlambda_dI_g", "dlambda/dI_g at constant I_l.",
       offsetof(free::SadovQuadratures, dlambda_dI_g)},
      {"L_dl", "Integral of L dl from z = 0, an action.", offsetof(free::SadovQuadratures, L_dl)},
      {"dL_dlambda_dl", "Integral of dL/dlambda dl from z = 0.",
       offsetof(free::SadovQuadratures, dL_dlambda_dl)},
      {"phi_l", "Sadov's angle, rad.", offsetof(free::SadovQuadratures, phi_l)},
      {"phi_g_minus_g", "phi_g less Andoyer's g, rad.",
       offsetof(free::SadovQuadratures, phi_g_minus_g)}}},
    checked};

constexpr Chart<KinoshitaState, 8> kinoshita_chart{
    "KinoshitaState",
    R"(Kinoshita's action-angle variables (1972): angles l, g, h (rad), actions L, G, H.

The averages of Andoyer's variables, and these themselves for an axisymmetric body; l = phi_l +
pi/2, g = phi_g, h = phi_h of Sadov's set. region and lobe as in SadovState. The original paper was
not available, so the origin of l is a convention. [SA section 5])",
    {{{"l", "Angle of the motion in the body, rad.", offsetof(KinoshitaState, l)},
      {"g", "Angle of the precession about the angular momentum, rad.",
       offsetof(KinoshitaState, g)},
      {"h", "Node of the invariable plane, rad.", offsetof(KinoshitaState, h)},
      {"L", "Action of the motion in the body, a momentum.", offsetof(KinoshitaState, L)},
      {"G", "Size of the angular momentum.", offsetof(KinoshitaState, G)},
      {"H", "Part of the momentum along the frame's third axis.", offsetof(KinoshitaState, H)},
      enum_field<SadovRegion>("region", "About which axis the momentum circulates, a SadovRegion.",
                              offsetof(KinoshitaState, region), "SadovRegion",
                              static_cast<int>(SadovRegion::short_axis)),
      {"lobe", "Sign of the momentum along the long axis in the long-axis region: 1 or -1.",
       offsetof(KinoshitaState, lobe), Kind::integer, nullptr, nullptr, 1}}},
    checked};

constexpr Chart<FukushimaIshizakiState, 7> fukushima_ishizaki_chart{
    "FukushimaIshizakiState",
    R"(Fukushima and Ishizaki's elements (1994): Andoyer's variables at an epoch t0.

l0, g0, h (rad), L0, G, H (momenta): constants of free rotation. The original takes initial values
of a modification of Andoyer's variables; it was not available, so these are Andoyer's own. [SA
(96)-(99)])",
    {{{"l0", "Andoyer's l at the epoch, rad.", offsetof(FukushimaIshizakiState, l0)},
      {"g0", "Andoyer's g at the epoch, rad.", offsetof(FukushimaIshizakiState, g0)},
      {"h", "Node of the invariable plane, rad.", offsetof(FukushimaIshizakiState, h)},
      {"L0", "Andoyer's L at the epoch.", offsetof(FukushimaIshizakiState, L0)},
      {"G", "Size of the angular momentum.", offsetof(FukushimaIshizakiState, G)},
      {"H", "Part of the momentum along the frame's third axis.",
       offsetof(FukushimaIshizakiState, H)},
      {"t0", "The epoch, in the unit of time.", offsetof(FukushimaIshizakiState, t0)}}},
    checked};

// f of states of two kinds at times, broadcast together.
template <class A, class B, class F>
auto mapped_pairs(const Batch<A>& first, const Batch<B>& second, Numbers& t, F f) {
  using To = std::decay_t<decltype(f(first[0], second[0], 0.0))>;
  const Shape pairs = broadcast(first.shape(), second.shape(), "angles", "state");
  const Shape shape = broadcast(pairs, t.shape(), "states", t.name());
  t.broadcast(shape);
  const Lane of_first(first.shape(), shape), of_second(second.shape(), shape);
  return Batch<To>::filled(shape, [&](To* out) {
    for_each(size_of(shape),
             [&](std::size_t k) { out[k] = f(first[of_first(k)], second[of_second(k)], t[k]); });
  });
}

void bind_serret_function(nb::module_& m) {
  bind_states<8>(m, generating_chart);
  m.def(
      "generating_function",
      [](const Body& body, const Batch<EulerAngles>& angles, const Batch<SerretState>& states,
         ArrayLike t) {
        Numbers times(t, "t");
        return mapped_pairs(angles, states, times,
                            [&](const EulerAngles& q, const SerretState& c, double at) {
                              return free::generating_function(body, q, c, at);
                            });
      },
      "body"_a, "angles"_a, "state"_a, "t"_a,
      R"(The generating function S(q; G, H, T; t) of section 3.1, with all its derivatives.

Parameters
----------
body : Body
angles : EulerAngles
    The attitude q, of any shape; 0 < theta < pi.
state : SerretState
    G, H, T are the arguments of S. The rest chooses the branch: the signs, and g0, h, t0 (any real
    numbers) of a near motion. The result has the momenta nearest to those of that motion at t, and
    g0, h, t0 nearest to its own. Along the motion S is continuous.
t : array_like
    Times.

Returns
-------
GeneratingFunction
    Of the shape that all arguments broadcast to.

Raises
------
ValueError
    theta outside (0, pi), |H| >= G, T outside (G^2/2I3, G^2/2I1) or outside the range that the
    attitude has with G and H.

Examples
--------
>>> body = polhode.Body(3, 4, 6)
>>> c = polhode.SerretState(g0=0.1, h=0.2, t0=0.3, G=1.0, H=0.4, T=0.11)
>>> q = polhode.charts.EulerAngles(0.3, 1.0, 0.2)
>>> f = polhode.free.generating_function(body, q, c, 0.0)
>>> s = polhode.to_rotor(polhode.EulerState(q.phi, q.theta, q.psi, f.Phi, f.Theta, f.Psi))
>>> bool(abs(polhode.kinetic_energy(body, s) + f.minus_T) < 1e-15)
True

[SA (36)-(62)])");
  m.def(
      "serret_branches",
      [](const Body& body, const Batch<EulerAngles>& angles, double G, double H, double T,
         double t) {
        if (!angles.shape().empty())
          throw nb::value_error("serret_branches: expected one EulerAngles");
        std::vector<Batch<SerretState>> all;
        for (const SerretState& c : free::serret_branches(body, angles[0], G, H, T, t))
          all.push_back(Batch<SerretState>::one(c));
        return all;
      },
      "body"_a, "angles"_a, "G"_a, "H"_a, "T"_a, "t"_a = 0.0,
      R"(The free motions with given G, H, T that have an attitude at time t.

One for each branch of the generating function, up to four on each lobe.

Parameters
----------
body : Body
angles : EulerAngles
    One attitude.
G, H, T : float
    Angular momentum, its part along the frame's third axis, kinetic energy.
t : float
    The time.

Returns
-------
list of SerretState
    At least one; g0 and h in (-pi, pi], t0 nearest to t.

Raises
------
ValueError
    As generating_function: there is no such motion.

Examples
--------
>>> q = polhode.charts.EulerAngles(0.3, 1.0, 0.2)
>>> len(polhode.free.serret_branches(polhode.Body(3, 4, 6), q, G=1.0, H=0.4, T=0.11))
2

[SA (51)])");
}

void bind_sadov_function(nb::module_& m) {
  bind_states<8>(m, sadov_generating_chart);
  bind_states<9>(m, quadratures_chart);
  bind_value<free::SadovParameters>(
      m, "SadovParameters", "Sadov's kappa and lambda. [SA \"SadovPar\"]",
      field("kappa", &free::SadovParameters::kappa, "Constant of the body."),
      field("lambda_", &free::SadovParameters::lambda,
            "State function: below 1 in short-axis mode, above 1 in long-axis mode."));
  m.def(
      "sadov_generating_function",
      [](const Body& body, ArrayLike l, ArrayLike g, ArrayLike h, const Batch<SadovState>& states) {
        std::array<Numbers, 3> angles{Numbers(l, "l"), Numbers(g, "g"), Numbers(h, "h")};
        const Shape inner = broadcast(angles);
        const Shape shape = broadcast(inner, states.shape(), "l, g, h", "state");
        for (Numbers& angle : angles) angle.broadcast(shape);
        const Lane lane(states.shape(), shape);
        using Function = free::SadovGeneratingFunction;
        return Batch<Function>::filled(shape, [&](Function* out) {
          for_each(size_of(shape), [&](std::size_t k) {
            out[k] = free::sadov_generating_function(body, angles[0][k], angles[1][k], angles[2][k],
                                                     states[lane(k)]);
          });
        });
      },
      "body"_a, "l"_a, "g"_a, "h"_a, "state"_a,
      R"(The generating function W(l, g, h; I_l, I_g, I_h) of section 5, with all its derivatives.

Parameters
----------
body : Body
l, g, h : array_like
    Andoyer's angles of the body axes sorted by moment, rad. In the long-axis region l must be
    within the libration.
state : SadovState
    The actions are arguments of W. The rest chooses the branch: region and lobe, and near values
    of the angles (any real numbers).

Returns
-------
SadovGeneratingFunction
    Of the shape that all arguments broadcast to.

Raises
------
ValueError
    Actions outside their region or at its ends; l outside the libration.

Examples
--------
>>> body = polhode.Body(3, 4, 6)
>>> near = polhode.SadovState(0, 0, 0, I_l=0.9, I_g=1.0, I_h=0.4)
>>> f = polhode.free.sadov_generating_function(body, 2.0, 0.1, 0.2, near)
>>> bool(abs(f.W - (0.9 * f.phi_l + f.phi_g + 0.4 * f.phi_h)) < 1e-15)
True

[SA "ActioTransf", "transf. eqs"])");
  m.def("sadov_parameters", &free::sadov_parameters, "body"_a, "G"_a, "T"_a,
        R"(Sadov's kappa of a triaxial body and lambda of its motion with G and T.

Parameters
----------
body : Body
    Three different moments.
G, T : float
    Angular momentum and kinetic energy.

Returns
-------
SadovParameters

Raises
------
ValueError
    T outside [G^2/2I3, G^2/2I1), or equal moments.

Examples
--------
>>> polhode.free.sadov_parameters(polhode.Body(3, 4, 6), G=1.0, T=0.125).lambda_
1.0

[SA "SadovPar"])");
  m.def(
      "sadov_quadratures",
      [](const free::SadovParameters& p, double I_g, ArrayLike l) {
        const Numbers angles(l, "l");
        return mapped(angles, [&](double at) { return free::sadov_quadratures(p, I_g, at); });
      },
      "parameters"_a, "I_g"_a, "l"_a,
      R"(The paper's quadratures from Andoyer's to Sadov's variables, for L > 0.

Parameters
----------
parameters : SadovParameters
    kappa > 0, lambda > 0 and not 1.
I_g : float
    Size of the angular momentum.
l : array_like
    Andoyer's angle, rad, not reduced; in long-axis mode within the libration.

Returns
-------
SadovQuadratures

Raises
------
ValueError
    Parameters without integrals, or l outside the libration.

Examples
--------
>>> q = polhode.free.sadov_quadratures(polhode.free.SadovParameters(1.0, 0.5), 1.0, [1.0, 2.0])
>>> q.phi_l.shape
(2,)

[SA "IellSadov", "quad dL/dlambda", "quad L dl", "phiSadov"])");
}

void bind_kinoshita(nb::module_& m) {
  bind_states<6>(m, kinoshita_chart);
  const char* doc = R"(Kinoshita's action-angle variables of a motion at time t, or of any states.

Parameters
----------
body : Body, with state : RotorState; or a FreeRotation, which has both
t : array_like
    Times; each state is taken at its own time.

Returns
-------
KinoshitaState

Raises
------
ValueError
    A state that FreeRotation rejects.

Examples
--------
>>> body = polhode.Body(3, 4, 6)
>>> s = polhode.to_kinoshita(body, polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0]))
>>> round(s.L, 6)
1.003766

[SA section 5])";
  m.def(
      "to_kinoshita",
      [](const FreeRotation& motion, ArrayLike t) {
        const Numbers times(t, "t");
        return mapped(times, [&](double at) { return to_kinoshita(motion, at); });
      },
      "body"_a, "t"_a, doc);
  m.def(
      "to_kinoshita",
      [](const Body& body, const Batch<RotorState>& states, ArrayLike t) {
        Numbers times(t, "t");
        return mapped(states, times, [&](const RotorState& s, double at) {
          return to_kinoshita(FreeRotation(body, s, at), at);
        });
      },
      "body"_a, "state"_a, "t"_a = 0.0, doc);
  m.def(
      "to_rotor",
      [](const Body& body, const Batch<KinoshitaState>& states) {
        return mapped(states, [&](const KinoshitaState& s) { return to_rotor(body, s); });
      },
      "body"_a, "state"_a,
      "The quaternion-momentum state of Kinoshita's variables. ValueError for actions outside the "
      "region.");
  m.def(
      "chart_jacobian",
      [](const Body& body, const Batch<KinoshitaState>& states) {
        return mapped_numbers(states, {6, 6},
                              [&](const KinoshitaState& s) { return chart_jacobian(body, s); });
      },
      "body"_a, "state"_a, "B of Kinoshita's variables: (..., 6, 6), columns l, g, h, L, G, H.");
}

void bind_fukushima_ishizaki(nb::module_& m) {
  bind_states<6>(m, fukushima_ishizaki_chart);
  m.def(
      "to_fukushima_ishizaki",
      [](const FreeRotation& motion, ArrayLike t) {
        const Numbers epochs(t, "t");
        return mapped(epochs, [&](double at) { return to_fukushima_ishizaki(motion, at); });
      },
      "motion"_a, "t"_a,
      R"(Fukushima and Ishizaki's elements of a motion: Andoyer's variables at the epoch t.

Parameters
----------
motion : FreeRotation
t : array_like
    Epochs, t0 of the result.

Returns
-------
FukushimaIshizakiState

Raises
------
ValueError
    An epoch that is not finite.

Examples
--------
>>> body = polhode.Body(3, 4, 6)
>>> motion = polhode.FreeRotation(body, polhode.RotorState([1, 0, 0, 0], [0.1, 0.2, 1.0]))
>>> s = polhode.to_fukushima_ishizaki(motion, 2.0)
>>> bool(abs(polhode.to_rotor(body, s, 5.0).g - motion.at(5.0).g).max() < 1e-15)
True

[SA (96)-(99)])");
  m.def(
      "to_rotor",
      [](const Body& body, const Batch<FukushimaIshizakiState>& states, ArrayLike t) {
        Numbers times(t, "t");
        return mapped(states, times, [&](const FukushimaIshizakiState& s, double at) {
          return to_rotor(body, s, at);
        });
      },
      "body"_a, "state"_a, "t"_a,
      "The quaternion-momentum state at time t of Fukushima and Ishizaki's elements.");
  m.def(
      "chart_jacobian",
      [](const Body& body, const Batch<FukushimaIshizakiState>& states, ArrayLike t) {
        Numbers times(t, "t");
        return mapped_numbers(states, times, {6, 6},
                              [&](const FukushimaIshizakiState& s, double at) {
                                return chart_jacobian(body, s, at);
                              });
      },
      "body"_a, "state"_a, "t"_a,
      "B at time t of Fukushima and Ishizaki's elements: (..., 6, 6), columns l0, g0, h, L0, G, "
      "H.");
  m.def(
      "free_rotation",
      [](const Body& body, const Batch<FukushimaIshizakiState>& s) {
        if (!s.shape().empty())
          throw nb::value_error("free_rotation: expected one FukushimaIshizakiState");
        return free_rotation(body, s[0]);
      },
      "body"_a, "state"_a, "The motion with these elements, epoch t0.");
}

}  // namespace

void bind_generating(nb::module_& m) {
  bind_serret_function(m);
  bind_sadov_function(m);
  bind_kinoshita(m);
  bind_fukushima_ishizaki(m);
}

}  // namespace polhode::python
