// SPDX-License-Identifier: MIT
// Perturbation terms, and those that Python writes.
#include "choice.hpp"
#include "dual_number.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/constant_torque.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/linear_damping.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "states.hpp"
#include "term_binding.hpp"
#include "term_value.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

// One C++ type per Python class.
struct GravityGradientTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct ConstantTorqueTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct LinearDampingTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct PythonTorqueTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};
struct PythonHamiltonianTerm : PythonTerm {
  using PythonTerm::PythonTerm;
};

// Python's H(t, state) as the generic callable that HamiltonianTerm differentiates.
class PythonHamiltonian {
 public:
  explicit PythonHamiltonian(SharedFunction function) : function_(std::move(function)) {}

  template <Real T>
  T operator()(const T& t, const BasicRotorState<T>& s) const {
    const WithGil acquired;
    const nb::object returned = (*function_)(time(t), state(s));
    T out(0.0);
    if (!from_python(returned, out))
      function_->refuse(returned, "a number, the energy: a float, or a Dual made of the state");
    return out;
  }

 private:
  // No variable moves the time: a float, except where that would round it.
  template <class T>
  static nb::object time(const T& t) {
    if constexpr (std::same_as<T, DoubleDouble> || std::same_as<T, Dual<DoubleDouble, 6>>)
      return to_python(t);
    else
      return nb::float_(to_double(t));
  }
  static nb::object state(const RotorState& s) { return nb::cast(Rotors::one(s)); }
  template <class T>
  static nb::object state(const BasicRotorState<T>& s);

  SharedFunction function_;
};

// What RotorState is to floats.
struct DualState {
  nb::object q;
  nb::object g;
};

template <class T>
nb::object PythonHamiltonian::state(const BasicRotorState<T>& s) {
  return nb::cast(DualState{to_python(s.q), to_python(s.g)});
}

// Python's torque(t, state), on double alone.
class PythonTorque {
 public:
  explicit PythonTorque(SharedFunction function) : function_(std::move(function)) {}

  Vec3 operator()(const double& t, const RotorState& s) const {
    const WithGil acquired;
    return function_->three_numbers((*function_)(t, Rotors::one(s)),
                                    "3 numbers, the torque along the body axes");
  }

 private:
  SharedFunction function_;
};

// A term that its user says to be a torque of time and attitude alone, for Splitting.
template <class Term>
struct KickOf {
  static constexpr bool kick = true;
  Term term;
  std::string label;

  template <Real T>
    requires PerturbationOn<Term, T>
  BasicEffect<T> effect(const BasicSetting<T>& at) const {
    const BasicEffect<T> e = term.effect(at);
    const T zero(0.0);
    for (const T& v : {e.v.x, e.v.y, e.v.z})
      if (v < zero || v > zero)  // not NaN
        throw DomainError(label + ": depends on the momentum, but was said to be a kick");
    return e;
  }
  template <Real T>
    requires Hamiltonian<Term, T>
  T energy(const BasicSetting<T>& at) const {
    return term.energy(at);
  }
};

template <class Term>
AnyPerturbation user_term(const std::string& name, const std::string& label, Term term, bool kick) {
  if (kick) return {name, KickOf<Term>{std::move(term), label}};
  return {name, std::move(term)};
}

// Of C, the Python class of a term `Term<F>` of a Python function.
template <class C, template <class> class Term, class F>
void make_user_term(C* self, const char* type, nb::handle function, nb::handle name, bool kick) {
  const std::string called = name_of(name, type, function), label = labelled(type, called);
  const auto shared = std::make_shared<PythonFunction>(function, label);
  new (self) C(
      user_term(called, label, Term<F>(F(shared)), kick),
      recipe_of("", {"function", "name", "kick"}, nb::make_tuple(function, name, kick), {shared}));
}

void bind_any(nb::module_& m) {
  nb::enum_<SpaceAxes>(m, "SpaceAxes", "The axes of a vector that is not the body's own.",
                       nb::is_arithmetic())
      .value("inertial", SpaceAxes::inertial, "those that do not turn")
      .value("reference", SpaceAxes::reference, "those of the frame S of the system");
  using P = PythonTerm;
  nb::class_<P> c(m, "AnyPerturbation",
                  R"(A term of a System: what every kind of term can be asked.

Made by GravityGradient, HigherGravity, OblateGravity, TidalTorque, ConstantTorque, TorqueTable,
LinearDamping, InternalDamping, SolarPressure, AtmosphericDrag, ResidualDipole, EddyCurrents,
TorqueTerm, HamiltonianTerm.)",
                  nb::type_slots(recipe_slots<P>()));
  c.def_prop_ro(
       "name", [](const P& p) { return p.name(); }, "Stands for the term in messages.")
      .def_prop_ro(
          "arguments", [](const P& p) { return p.recipe.by_name(); },
          nb::for_getter(nb::sig("def arguments(self) -> dict[str, typing.Any]")),
          "What it was made from, by name.")
      .def_prop_ro(
          "supports_energy", [](const P& p) { return p.supports_energy(); },
          "Whether it has an energy H', of which its effect is the derivative.")
      .def_prop_ro(
          "supports_flow", [](const P& p) { return p.supports_flow(); },
          "Whether its own motion is known exactly, as Splitting needs.")
      .def_prop_ro(
          "is_kick", [](const P& p) { return p.is_kick(); },
          "Whether it is a torque of time and attitude alone.")
      .def_prop_ro(
          "supports_any_real", [](const P& p) { return p.supports_any_real(); },
          "Whether double-double runs and state transitions can use it.")
      .def_prop_ro(
          "breakpoints", [](const P& p) { return array_of(p.breakpoints()); },
          nb::for_getter(nb::sig("def breakpoints(self) -> numpy.typing.NDArray[numpy.float64]")),
          "(n,): the times at which it is not smooth, where integrate ends a step.");
  def_term<P>(c);
}

void bind_gravity(nb::module_& m) {
  using C = GravityGradientTerm;
  nb::class_<C, PythonTerm> c(m, "GravityGradient",
                              R"(The torque of a point mass on a rigid body (MacCullagh).

H' = gm / (2 r^3) (3 n.I n - tr I), u = (3 gm / r^3) n x I n, n = r / |r| in body axes.

Parameters
----------
gm : of the attracting point mass, length^3 / time^2. ValueError unless positive.
orbit : KeplerOrbit, PrecessingKeplerOrbit, TableOrbit, or any function t -> 3 numbers: the
    position of the mass from the body or of the body from the mass.
axes : of those positions: SpaceAxes, or its name.
name : stands in messages.

The moments of the body may be in any unit of moment; lengths of gm and of the orbit must agree. A
function in Python works on float alone: not with Precision.double_double.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, double gm, nb::handle orbit, nb::handle axes, nb::handle name) {
         const auto of = choice<SpaceAxes>(axes, "axes");
         make_along(self, "GravityGradient", orbit, name,
                    {{"gm", "orbit", "axes", "name"}, nb::make_tuple(gm, orbit, of, name)},
                    [&](const std::string& called, const auto& o) {
                      return AnyPerturbation(called, GravityGradient(gm, o, of));
                    });
       },
       nb::arg("gm"), nb::arg("orbit"), nb::arg("axes") = SpaceAxes::inertial,
       nb::arg("name") = nb::none(),
       nb::sig("def __init__(self, gm: float, orbit: KeplerOrbit | PrecessingKeplerOrbit | "
               "TurnedKeplerOrbit | TableOrbit | typing.Callable[[float], numpy.typing.ArrayLike], "
               "axes: SpaceAxes | str = "
               "'inertial', name: str | None = None) -> None"))
      .def_prop_ro(
          "gm", [](const C& term) { return term.recipe.argument(0); },
          nb::for_getter(nb::sig("def gm(self) -> float")), "Of the attracting point mass.")
      .def_prop_ro(
          "orbit", [](const C& term) { return term.recipe.argument(1); },
          nb::for_getter(nb::sig("def orbit(self) -> typing.Any")),
          "The very object that was given.")
      .def_prop_ro(
          "axes", [](const C& term) { return term.recipe.argument(2); },
          nb::for_getter(nb::sig("def axes(self) -> SpaceAxes")), "Of the positions of the orbit.");
  def_term<C>(c);
}

void bind_torque(nb::module_& m) {
  using C = ConstantTorqueTerm;
  nb::class_<C, PythonTerm> c(m, "ConstantTorque",
                              R"(A torque that is constant in body axes or in space.

ConstantTorque.in_body(u_B), ConstantTorque.in_space(u, axes): momentum per time, no energy.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def_static(
       "in_body",
       [](nb::handle u_B, nb::handle name) {
         const Vec3 u = vec3(u_B, "u_B");
         return C(AnyPerturbation(name_of(name, "ConstantTorque"), ConstantTorque::in_body(u)),
                  recipe_of("in_body", {"u_B", "name"}, nb::make_tuple(tuple_of(u), name)));
       },
       nb::arg("u_B"), nb::arg("name") = nb::none(),
       nb::sig("def in_body(u_B: numpy.typing.ArrayLike, name: str | None = None) -> "
               "ConstantTorque"),
       "Constant along the principal body axes: (3,). ValueError for a component that is not "
       "finite.")
      .def_static(
          "in_space",
          [](nb::handle u, nb::handle axes, nb::handle name) {
            const Vec3 given = vec3(u, "u");
            const auto of = choice<SpaceAxes>(axes, "axes");
            return C(AnyPerturbation(name_of(name, "ConstantTorque"),
                                     ConstantTorque::in_space(given, of)),
                     recipe_of("in_space", {"u", "axes", "name"},
                               nb::make_tuple(tuple_of(given), of, name)));
          },
          nb::arg("u"), nb::arg("axes") = SpaceAxes::inertial, nb::arg("name") = nb::none(),
          nb::sig("def in_space(u: numpy.typing.ArrayLike, axes: SpaceAxes | str = "
                  "'inertial', name: str | None = None) -> ConstantTorque"),
          "Constant (3,) in inertial axes, or in those of the reference frame.")
      .def_prop_ro(
          "u", [](const C& term) { return array_of(vec3(term.recipe.argument(0), "u")); },
          nb::for_getter(nb::sig("def u(self) -> numpy.typing.NDArray[numpy.float64]")),
          "(3,): its components, in body axes where `axes` is None.")
      .def_prop_ro(
          "axes",
          [](const C& term) {
            return term.recipe.names.size() == 3 ? term.recipe.argument(1) : nb::object(nb::none());
          },
          nb::for_getter(nb::sig("def axes(self) -> SpaceAxes | None")),
          "Those in space; None: body axes.");
  def_term<C>(c);
}

// One number, a diagonal, or a matrix with its body.
LinearDamping damping_of(nb::handle D, nb::handle body) {
  const Numbers any(D, "D");
  if (any.shape().empty()) return LinearDamping(any[0]);
  if (any.shape() == Shape{3}) return LinearDamping(vec3(D, "D"));
  if (any.shape() != Shape{3, 3})
    throw nb::value_error(
        ("LinearDamping: D: got shape " + text_of(any.shape()) + "; expected (), (3,) or (3, 3)")
            .c_str());
  if (body.is_none())
    throw nb::value_error("LinearDamping: a matrix D needs the body: LinearDamping(D, body)");
  return LinearDamping(mat3(D, "D"), nb::cast<const Body&>(body));
}

void bind_damping(nb::module_& m) {
  using C = LinearDampingTerm;
  nb::class_<C, PythonTerm> c(m, "LinearDamping",
                              R"(Viscous friction against inertial axes: u = -D w, w = I^-1 g.

Parameters
----------
D : one number, the diagonal (3,) in principal body axes, or a symmetric matrix (3, 3) that drives
    no motion; torque per rate.
body : the one that a matrix will be applied to.
name : stands in messages.

ValueError for a matrix that is not finite, not symmetric, or would drive the body.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, nb::handle D, nb::handle body, nb::handle name) {
         if (!body.is_none() && !nb::isinstance<Body>(body))
           throw nb::type_error(
               ("LinearDamping: body: got " + class_name(body) + "; expected a Body").c_str());
         const LinearDamping damping = damping_of(D, body);
         const bool full = Numbers(D, "D").shape().size() == 2;
         const Mat3& matrix = damping.matrix();
         const nb::object kept =
             full ? rows_of(matrix) : nb::make_tuple(matrix(0, 0), matrix(1, 1), matrix(2, 2));
         new (self) C(AnyPerturbation(name_of(name, "LinearDamping"), damping),
                      recipe_of("", {"D", "body", "name"}, nb::make_tuple(kept, body, name)));
       },
       nb::arg("D"), nb::arg("body") = nb::none(), nb::arg("name") = nb::none(),
       nb::sig(
           "def __init__(self, D: numpy.typing.ArrayLike, body: Body | None = None, name: str | "
           "None = None) -> None"))
      .def_prop_ro(
          "matrix",
          [](const C& term) {
            const nb::object D = term.recipe.argument(0);
            if (Numbers(D, "D").shape().size() == 2) return array_of(mat3(D, "D"));
            const Vec3 d = vec3(D, "D");
            return array_of(Mat3{{{d.x, 0.0, 0.0}, {0.0, d.y, 0.0}, {0.0, 0.0, d.z}}});
          },
          nb::for_getter(nb::sig("def matrix(self) -> numpy.typing.NDArray[numpy.float64]")),
          "(3, 3): D in principal body axes.");
  def_term<C>(c);
}

void bind_user_torque(nb::module_& m) {
  using C = PythonTorqueTerm;
  nb::class_<C, PythonTerm> c(m, "TorqueTerm", R"(Any torque, written in Python.

Parameters
----------
function : f(t, s) -> 3 components along the body axes, momentum per time; t a float, s one
    RotorState in the reference frame.
name : stands in messages; None: the name of the function.
kick : True says that it depends on time and attitude alone, so that Splitting can use it.

It is called on float alone: ValueError from runs with Precision.double_double and from
state_transitions. It has no energy. What it raises passes through;
TypeError or ValueError, naming the term, for what is not three numbers; NaN is a number.)",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, nb::handle function, nb::handle name, bool kick) {
         make_user_term<C, TorqueTerm, PythonTorque>(self, "TorqueTerm", function, name, kick);
       },
       nb::arg("function"), nb::arg("name") = nb::none(), nb::arg("kick") = false,
       nb::sig("def __init__(self, function: typing.Callable[[float, RotorState], "
               "numpy.typing.ArrayLike], name: str | None = None, kick: bool = False) -> None"))
      .def_prop_ro(
          "function", [](const C& term) { return term.recipe.argument(0); },
          nb::for_getter(nb::sig("def function(self) -> typing.Any")),
          "The very object that was given.");
  def_term<C>(c);
}

void bind_user_hamiltonian(nb::module_& m) {
  nb::class_<DualState>(m, "DualState",
                        "The state that a HamiltonianTerm's function is called with: q (4,) and g "
                        "(3,), object arrays of Dual.")
      .def_ro("q", &DualState::q, nb::for_getter(nb::sig("def q(self) -> typing.Any")),
              "(4,): attitude (w, x, y, z), body to reference frame.")
      .def_ro("g", &DualState::g, nb::for_getter(nb::sig("def g(self) -> typing.Any")),
              "(3,): angular momentum along the body axes.")
      .def("__repr__", [](const DualState& s) {
        return "DualState(q=" + nb::cast<std::string>(nb::repr(s.q)) +
               ", g=" + nb::cast<std::string>(nb::repr(s.g)) + ")";
      });
  using C = PythonHamiltonianTerm;
  nb::class_<C, PythonTerm> c(m, "HamiltonianTerm",
                              R"(Any energy H'(t, state), written in Python. [SA (107)]

v = dH'/dg and u = -dH'/d(theta_B) follow by dual numbers, so that they cannot disagree with the
energy; also second derivatives, for state transitions and canonical_state.

Parameters
----------
function : H(t, s) -> energy. s.q (4,) and s.g (3,) are arrays of numbers (s a RotorState) or of
    Dual (s a DualState), in the reference frame; t is a float, a Dual in double-double runs.
    Written with + - * / ** @, NumPy's functions, and attitude_matrix(s.q), which takes vectors from
    the reference frame to the body. It may depend on q through products of two components.
name : stands in messages; None: the name of the function.
kick : True says that it does not depend on s.g, so that Splitting can use it; ValueError where it
    does.

What it raises passes through; TypeError, naming the term, for what is no number.

>>> HamiltonianTerm(lambda t, s: 0.1 * (attitude_matrix(s.q) @ [0, 0, 1])[2] ** 2, name="field"))",
                              nb::type_slots(recipe_slots<C>()));
  c.def(
       "__init__",
       [](C* self, nb::handle function, nb::handle name, bool kick) {
         make_user_term<C, HamiltonianTerm, PythonHamiltonian>(self, "HamiltonianTerm", function,
                                                               name, kick);
       },
       nb::arg("function"), nb::arg("name") = nb::none(), nb::arg("kick") = false,
       nb::sig("def __init__(self, function: typing.Callable[[typing.Any, typing.Any], Dual | "
               "float], name: str | None = None, kick: bool = False) -> None"))
      .def_prop_ro(
          "function", [](const C& term) { return term.recipe.argument(0); },
          nb::for_getter(nb::sig("def function(self) -> typing.Any")),
          "The very object that was given.");
  def_term<C>(c);
}

}  // namespace

void bind_perturb(nb::module_& m) {
  bind_any(m);
  bind_gravity(m);
  bind_torque(m);
  bind_damping(m);
  bind_user_torque(m);
  bind_user_hamiltonian(m);
}

}  // namespace polhode::python
