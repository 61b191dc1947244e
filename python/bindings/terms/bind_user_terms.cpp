// SPDX-License-Identifier: MIT
// Terms that Python writes.
#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "charts/states.hpp"
#include "interface/value.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/user_terms.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

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

template <class T>
nb::object PythonHamiltonian::state(const BasicRotorState<T>& s) {
  return nb::cast(dual_rotor(s.q, s.g));
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

// The same on given sides of its switching functions.
class PythonSwitchedTorque {
 public:
  explicit PythonSwitchedTorque(SharedFunction function) : function_(std::move(function)) {}

  Vec3 operator()(const double& t, const RotorState& s, std::span<const double> sides) const {
    const WithGil acquired;
    return function_->three_numbers((*function_)(t, Rotors::one(s), array_of(sides)),
                                    "3 numbers, the torque along the body axes");
  }

 private:
  SharedFunction function_;
};

// Python's torque(t, states) of many times and states at a time.
class PythonArrayTorque {
 public:
  PythonArrayTorque(SharedFunction function, double time_scale)
      : function_(std::move(function)), time_scale_(time_scale) {}

  double time_scale() const { return time_scale_; }
  Effect effect(const Setting& at) const {
    Vec3 u;
    torques(std::span(&at.t, 1), std::span(&at.s, 1), std::span(&u, 1));
    return {{}, u};
  }
  std::unique_ptr<StageTerm> on_stages(const Body&) const {
    return std::make_unique<Stages>(*this);
  }

 private:
  // One call for all stages of a sweep.
  class Stages final : public StageTerm {
   public:
    explicit Stages(const PythonArrayTorque& term) : term_(term) {}

    void begin(const StageTimes& times, std::span<const double>) override {
      times_.assign(times.t.begin(), times.t.begin() + times.count);
      states_.resize(times.count);
      torques_.resize(times.count);
    }
    void add_to(StageEffects& effects, const StageStates& states) override {
      for (std::size_t i = 0; i < times_.size(); ++i) {
        const auto x = [&](std::size_t n) { return states.rows[n][i]; };
        states_[i] = {{x(0), x(1), x(2), x(3)}, {x(4), x(5), x(6)}};
      }
      term_.torques(times_, states_, torques_);
      for (std::size_t i = 0; i < times_.size(); ++i)
        for (int n = 0; n < 3; ++n) effects.u[static_cast<std::size_t>(n)][i] += torques_[i][n];
    }
    bool adds_rate() const override { return false; }

   private:
    const PythonArrayTorque& term_;
    std::vector<double> times_;
    std::vector<RotorState> states_;
    std::vector<Vec3> torques_;
  };

  void torques(std::span<const double> t, std::span<const RotorState> s, std::span<Vec3> u) const {
    const WithGil acquired;
    const Shape shape{t.size()};
    const nb::object returned = (*function_)(
        array_of(t),
        Rotors::filled(shape, [&](RotorState* out) { std::copy(s.begin(), s.end(), out); }));
    try {
      Numbers numbers(returned, "", {3});
      numbers.broadcast(shape);
      for (std::size_t i = 0; i < u.size(); ++i)
        u[i] = {numbers.at(i)[0], numbers.at(i)[1], numbers.at(i)[2]};
      return;
    } catch (const nb::builtin_exception&) {
    } catch (const DomainError&) {
    } catch (const nb::python_error& error) {  // NumPy's, of shapes
      if (!error.matches(PyExc_ValueError)) throw;
    }
    function_->refuse(returned, "(n, 3) numbers, the torques along the body axes at n times");
  }

  SharedFunction function_;
  double time_scale_;
};

// Python's switches(t, state): one number or several.
class PythonSwitches {
 public:
  explicit PythonSwitches(SharedFunction function) : function_(std::move(function)) {}

  std::vector<double> operator()(double t, const RotorState& s) const {
    const WithGil acquired;
    const nb::object returned = (*function_)(t, Rotors::one(s));
    try {
      Numbers numbers(returned, "");
      if (numbers.shape().size() <= 1) {
        std::vector<double> values(size_of(numbers.shape()));
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = numbers[i];
        return values;
      }
    } catch (const nb::builtin_exception&) {
    }
    function_->refuse(returned, "a number or (n,) numbers, the switching functions");
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
  std::unique_ptr<StageTerm> on_stages(const Body& body) const
    requires requires(const Term& of, const Body& b) { of.on_stages(b); }
  {
    return term.on_stages(body);
  }
  std::vector<double> switches(const Setting& at) const
    requires Switching<Term>
  {
    return term.switches(at);
  }
  double time_scale() const
    requires Timed<Term>
  {
    return term.time_scale();
  }
};

template <class Term>
AnyPerturbation user_term(const std::string& name, const std::string& label, Term term, bool kick) {
  if (kick) return {name, KickOf<Term>{std::move(term), label}};
  return {name, std::move(term)};
}

// Of an argument that may be left out, and what stands for it then.
template <class T>
T taken(const nb::object& x, T otherwise) {
  if (x.is_none()) return otherwise;
  try {
    return nb::cast<T>(x);
  } catch (const nb::cast_error&) {
    throw nb::next_overload();
  }
}

MadeTerm made_torque(Making& at, std::span<const nb::object> given) {
  const nb::object &function = given[0], &switches = given[3];
  const bool kick = taken(given[2], false), arrays = taken(given[5], false);
  require_plain(given[4], "time_scale");
  const auto time_scale = taken(given[4], std::optional<double>());
  const nb::tuple kept = nb::make_tuple(function, given[1], kick, switches, time_scale, arrays);
  if (arrays && !switches.is_none())
    throw nb::value_error(
        (at.label + ": arrays: got True; expected False for a torque with switches").c_str());
  if (time_scale && !(*time_scale > 0.0))
    throw nb::value_error(
        (at.label + ": time_scale: got " + number_text(*time_scale) + "; expected a positive time")
            .c_str());
  const double time = time_scale.value_or(std::numeric_limits<double>::infinity());
  const auto torque = std::make_shared<PythonFunction>(function, at.label);
  at.functions.push_back(torque);
  if (arrays) return {{user_term(at.name, at.label, PythonArrayTorque(torque, time), kick)}, kept};
  if (switches.is_none())
    return {{user_term(at.name, at.label, TorqueTerm(PythonTorque(torque), time), kick)}, kept};
  const auto signs = std::make_shared<PythonFunction>(switches, at.label + ": switches");
  at.functions.push_back(signs);
  return {{user_term(at.name, at.label,
                     SwitchedTorqueTerm(PythonSwitchedTorque(torque), PythonSwitches(signs), time),
                     kick)},
          kept};
}

TermClass torque_class() {
  constexpr const char* torque_type = "typing.Callable[..., numpy.typing.ArrayLike]";
  constexpr const char* switches_type =
      "typing.Callable[[float, RotorState], numpy.typing.ArrayLike]";
  return {
      .name = "TorqueTerm",
      .summary = "Any torque, written in Python.",
      .notes =
          R"(A pulse within one step is stepped over where neither switches nor time_scale is
given: at loose tolerances steps are long. A torque that drives its own switching function back to
zero from both sides is refused when it gets there: give it a dead zone.

It is called on float alone: ValueError from runs with Precision.double_double and from
state_transitions. It has no energy. What it raises passes through;
TypeError or ValueError, naming the term, for what is not three numbers; NaN is a number.)",
      .arguments =
          {{"function", torque_type,
            "f(t, s) -> 3 components along the body axes, momentum per time; t a float, s "
            "one RotorState in the reference frame. With `switches` it is f(t, s, sides).",
            "", torque_type},
           name_argument(),
           {"kick", "bool",
            "True says that it depends on time and attitude alone, so that Splitting can use it.",
            "False", "bool"},
           {"switches", std::string(switches_type) + " | None",
            "g(t, s) -> (n,) switching functions of a torque that jumps, or has a kink, "
            "where one of them is zero; smooth there. Collocation and Adaptive end a step at each, "
            "and call the function with sides (n,), +1.0 or -1.0: what it takes for the "
            "signs of g, so that it is smooth at the zero.",
            "None", std::string(switches_type) + " | None"},
           {"time_scale", "float | None",
            "the time in which the torque comes and goes: the default of largest_step.", "None"},
           {"arrays", "bool",
            "True says that it takes times (n,) and a RotorState of shape (n,), and "
            "returns (n, 3): Collocation then calls it once for all stages of a step.",
            "False", "bool"}},
      .made = made_torque};
}

MadeTerm made_hamiltonian(Making& at, std::span<const nb::object> given) {
  const bool kick = taken(given[2], false);
  at.functions.push_back(std::make_shared<PythonFunction>(given[0], at.label));
  const HamiltonianTerm<PythonHamiltonian> term{PythonHamiltonian(at.functions[0])};
  return {{user_term(at.name, at.label, term, kick)}, nb::make_tuple(given[0], given[1], kick)};
}

TermClass hamiltonian_class() {
  constexpr const char* type = "typing.Callable[[typing.Any, typing.Any], Dual | float]";
  return {
      .name = "HamiltonianTerm",
      .summary = R"(Any energy H'(t, state), written in Python. [SA (107)]

v = dH'/dg and u = -dH'/d(theta_B) follow by dual numbers, so that they cannot disagree with the
energy; also second derivatives, for state transitions and canonical_state.)",
      .notes = R"(What it raises passes through; TypeError, naming the term, for what is no number.

>>> HamiltonianTerm(lambda t, s: 0.1 * (attitude_matrix(s.q) @ [0, 0, 1])[2] ** 2, name="field"))",
      .arguments =
          {{"function", type,
            "H(t, s) -> energy. s.q (4,) and s.g (3,) are arrays of numbers (s a "
            "RotorState) or of Dual (s a DualState), in the reference frame; t is a float, "
            "a Dual in double-double runs. Written with + - * / ** @, NumPy's functions, "
            "and attitude_matrix(s.q), which takes vectors from the reference frame to the "
            "body. It may depend on q through products of two components.",
            "", type},
           name_argument(),
           {"kick", "bool",
            "True says that it does not depend on s.g, so that Splitting can use it; "
            "ValueError where it does.",
            "False", "bool"}},
      .made = made_hamiltonian};
}

// a(t) of a MomentumTerm: a constant vector, or a Python function of time.
class PythonRate {
 public:
  explicit PythonRate(const Vec3& constant) : constant_(constant) {}
  explicit PythonRate(SharedFunction function) : constant_{}, function_(std::move(function)) {}

  // No variable moves the time: it is a float, except where that would round it.
  template <Real T>
  BasicVec3<T> operator()(const T& t) const {
    if (function_ == nullptr) return {T(constant_.x), T(constant_.y), T(constant_.z)};
    const WithGil acquired;
    if constexpr (std::same_as<T, DoubleDouble>) {
      const nb::object returned = (*function_)(to_python(t));
      BasicVec3<T> a;
      bool is_good = nb::hasattr(returned, "__len__") && nb::len(returned) == 3;
      for (int k = 0; k < 3 && is_good; ++k) is_good = from_python(returned[k], a[k]);
      if (!is_good) function_->refuse(returned, "3 numbers, the rate a: floats or Duals");
      return a;
    } else {
      const Vec3 a = function_->three_numbers((*function_)(to_double(t)), "3 numbers, the rate a");
      return {T(a.x), T(a.y), T(a.z)};
    }
  }

 private:
  Vec3 constant_;
  SharedFunction function_;
};

MadeTerm made_momentum(Making& at, std::span<const nb::object> given) {
  const nb::object& a = given[0];
  const std::string axes = taken(given[1], std::string("body"));
  std::optional<SpaceAxes> of;
  if (axes == "inertial") of = SpaceAxes::inertial;
  if (axes == "reference") of = SpaceAxes::reference;
  if (!of && axes != "body")
    throw nb::value_error(
        (at.label + ": axes: got \"" + axes + R"("; expected "body", "reference" or "inertial")")
            .c_str());
  if (PyCallable_Check(a.ptr()) == 0) {
    const Vec3 constant = vec3(a, "a");
    return {{AnyPerturbation(at.name, MomentumTerm(PythonRate(constant), of))},
            nb::make_tuple(tuple_of(constant), axes, given[2])};
  }
  at.functions.push_back(std::make_shared<PythonFunction>(a, at.label));
  return {{AnyPerturbation(at.name, MomentumTerm(PythonRate(at.functions[0]), of))},
          nb::make_tuple(a, axes, given[2])};
}

TermClass momentum_class() {
  constexpr const char* type =
      "numpy.typing.ArrayLike | typing.Callable[[float], numpy.typing.ArrayLike]";
  return {
      .name = "MomentumTerm",
      .summary = "An energy linear in the angular momentum, H' = a . g: a rotor or a moving frame.",
      .notes =
          R"(v = a; along axes in space u = a x g. Its own motion is a rotation: Splitting takes it.
A rotor of constant momentum h in the body has a = -I^-1 h; a frame of rate mu has a = -mu.
[SA (107), (118)]

>>> wheel = MomentumTerm(-np.array([0, 0, 0.2]) / body.moments, name="wheel"))",
      .arguments = {{"a", type, "(3,), rad per time, or a function of time that returns it.", "",
                     type},
                    {"axes", "str", "of a: \"body\", \"reference\" or \"inertial\".", "'body'",
                     "str"},
                    name_argument()},
      .made = made_momentum};
}

}  // namespace

void bind_user_terms(nb::module_& m) {
  add_term_class(m, torque_class());
  add_term_class(m, hamiltonian_class());
  add_term_class(m, momentum_class());
}

}  // namespace polhode::python
