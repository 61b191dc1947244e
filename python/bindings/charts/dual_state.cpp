// SPDX-License-Identifier: MIT
#include "charts/dual_state.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <variant>
#include <vector>

#include "charts/states.hpp"
#include "interface/object_slots.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/chart_jacobian.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"

namespace polhode::python {

namespace {

// The numbers of a vector field; empty if the value is no sequence of that length.
std::vector<nb::object> items_of_vector(nb::handle value, std::size_t size) {
  std::vector<nb::object> items;
  if (!nb::hasattr(value, "__len__") || nb::len(value) != size) return items;
  for (std::size_t i = 0; i < size; ++i) items.emplace_back(value[i]);
  return items;
}
std::size_t size_of_field(const Field& field) {
  return field.kind == Kind::vector ? 3 : field.kind == Kind::quaternion ? 4 : 1;
}
// True for a Dual, and for an object array whose only item is a Dual.
bool is_dual_number(nb::handle value) {
  if (nb::isinstance<PythonDual>(value)) return true;
  const nb::object item = item_of(value);
  return item.is_valid() && nb::isinstance<PythonDual>(item);
}
bool has_dual(const Field& field, nb::handle value) {
  if (size_of_field(field) == 1) return is_dual_number(value);
  const bool is_list = PyList_Check(value.ptr()) != 0 || PyTuple_Check(value.ptr()) != 0;
  const bool is_array = nb::hasattr(value, "dtype") && nb::hasattr(value, "__len__");
  if (!is_list && !(is_array && nb::cast<std::string>(value.attr("dtype").attr("kind")) == "O"))
    return false;
  const std::vector<nb::object> items = items_of_vector(value, size_of_field(field));
  return std::any_of(items.begin(), items.end(),
                     [](const nb::object& x) { return is_dual_number(x); });
}

// The first Dual of a state, whose kind all of its numbers become.
const PythonDual::Number& kind_of(const DualState& s) {
  for (const auto& [name, value] : s.fields) {
    if (nb::isinstance<PythonDual>(value)) return nb::cast<const PythonDual&>(value).x;
    if (!nb::hasattr(value, "__len__")) continue;
    for (std::size_t i = 0; i < nb::len(value); ++i)
      if (const nb::object x = value[i]; nb::isinstance<PythonDual>(x))
        return nb::cast<const PythonDual&>(x).x;
  }
  throw nb::type_error((s.chart + ": expected a Dual among its numbers").c_str());
}

template <class D>
D number_of(const DualState& s, const char* field, nb::handle value) {
  D x(0.0);
  if (!from_python(value, x))
    throw nb::type_error((s.chart + ": " + field + ": got " +
                          nb::cast<std::string>(nb::repr(value)) +
                          "; expected floats and Duals of one kind")
                             .c_str());
  return x;
}
template <class D>
D number_of(const DualState& s, const char* field) {
  return number_of<D>(s, field, s.fields[field]);
}

template <class D>
BasicRotorState<D> rotor_of(const DualState& s) {
  const auto x = [&](const char* field) { return number_of<D>(s, field); };
  if (s.chart == "AndoyerState")
    return to_rotor(BasicAndoyerState<D>{x("l"), x("g"), x("h"), x("L"), x("G"), x("H")});
  if (s.chart == "EulerState")
    return to_rotor(
        BasicEulerState<D>{x("phi"), x("theta"), x("psi"), x("Phi"), x("Theta"), x("Psi")});
  if (s.chart == "PoincareState")
    return to_rotor(BasicPoincareState<D>{x("sigma"), x("Q1"), x("Q2"), x("G"), x("P1"), x("P2"),
                                          choice<Pole>(s.fields["pole_J"], "pole_J"),
                                          choice<Pole>(s.fields["pole_I"], "pole_I")});
  if (s.chart != "RotorState")
    throw nb::type_error(("to_rotor: got a DualState of " + s.chart +
                          "; expected one of RotorState, EulerState, AndoyerState or "
                          "PoincareState; EulerRates need a body")
                             .c_str());
  const nb::object q = s.fields["q"], g = s.fields["g"];
  const auto of = [&](const char* field, const nb::object& v, std::size_t i) {
    return number_of<D>(s, field, nb::object(v[i]));
  };
  return {
      normalized(BasicQuaternion<D>{of("q", q, 0), of("q", q, 1), of("q", q, 2), of("q", q, 3)}),
      {of("g", g, 0), of("g", g, 1), of("g", g, 2)}};
}

template <class D>
BasicVec3<D> body_rate(const Body& body, const BasicRotorState<D>& s) {
  const Vec3& I = body.moments();
  return {s.g.x / D(I.x), s.g.y / D(I.y), s.g.z / D(I.z)};
}

// f(rotor) on the numbers of the state.
template <class F>
nb::object on_rotor(const DualState& s, const F& f) {
  return std::visit(
      [&](const auto& kind) -> nb::object { return f(rotor_of<std::decay_t<decltype(kind)>>(s)); },
      kind_of(s));
}

nb::object state_of(const char* chart,
                    std::initializer_list<std::pair<const char*, nb::object>> fields) {
  DualState s{chart, {}};
  for (const auto& [name, value] : fields) s.fields[name] = value;
  return nb::cast(std::move(s));
}

// Serret's and Sadov's elements have formulas in double: their first derivatives are those of the
// Jacobian of the set.
template <class D>
inline constexpr bool is_first_order = false;
template <int N>
inline constexpr bool is_first_order<Dual<double, N>> = true;

template <class F>
nb::object on_first_order(const DualState& s, const char* set, const F& f) {
  return std::visit(
      [&](const auto& kind) -> nb::object {
        using D = std::decay_t<decltype(kind)>;
        if constexpr (is_first_order<D>) {
          return f(kind);
        } else {
          throw nb::type_error((std::string(set) +
                                ": has first derivatives in double only; expected no double-double "
                                "run and no second derivatives, or another chart")
                                   .c_str());
        }
      },
      kind_of(s));
}

// The state s with the derivatives that C has, by B = d(theta_B, g_B)/dC.
template <class D>
nb::object rotor_along(const RotorState& s, const Matrix6& B, const std::array<D, 6>& C) {
  BasicQuaternion<D> q{s.q.w, s.q.x, s.q.y, s.q.z};
  BasicVec3<D> g{s.g.x, s.g.y, s.g.z};
  for (std::size_t n = 0; n < D::size; ++n) {
    std::array<double, 6> by{};
    for (std::size_t k = 0; k < 6; ++k) by[k] = C[k].derivative[n];
    const std::array<double, 6> x = B * by;
    const Quaternion dq = s.q * Quaternion{0.0, 0.5 * x[0], 0.5 * x[1], 0.5 * x[2]};
    q.w.derivative[n] = dq.w;
    q.x.derivative[n] = dq.x;
    q.y.derivative[n] = dq.y;
    q.z.derivative[n] = dq.z;
    for (int k = 0; k < 3; ++k) g[k].derivative[n] = x[static_cast<std::size_t>(k) + 3];
  }
  return nb::cast(dual_rotor(q, g));
}
// Elements C of the state r, by B^-1.
template <class D>
std::array<D, 6> elements_along(const BasicRotorState<D>& r, const Matrix6& inverse,
                                const std::array<double, 6>& C) {
  std::array<D, 6> elements;
  for (std::size_t k = 0; k < 6; ++k) elements[k] = D(C[k]);
  const Quaternion back = conj(Quaternion{r.q.w.value, r.q.x.value, r.q.y.value, r.q.z.value});
  for (std::size_t n = 0; n < D::size; ++n) {
    const Quaternion turn = back * Quaternion{r.q.w.derivative[n], r.q.x.derivative[n],
                                              r.q.y.derivative[n], r.q.z.derivative[n]};
    const std::array<double, 6> x =
        inverse * std::array<double, 6>{2.0 * turn.x,        2.0 * turn.y,
                                        2.0 * turn.z,        r.g.x.derivative[n],
                                        r.g.y.derivative[n], r.g.z.derivative[n]};
    for (std::size_t k = 0; k < 6; ++k) elements[k].derivative[n] = x[k];
  }
  return elements;
}
template <class D>
RotorState value_of(const BasicRotorState<D>& r) {
  return {{r.q.w.value, r.q.x.value, r.q.y.value, r.q.z.value},
          {r.g.x.value, r.g.y.value, r.g.z.value}};
}

int whole_of(const DualState& s, const char* field) {
  return nb::cast<int>(nb::object(s.fields[field]));
}

nb::object rotor_of_serret(const Body& body, const DualState& s, double t) {
  return on_first_order(s, "SerretState", [&]<class D>(const D&) {
    const auto x = [&](const char* field) { return number_of<D>(s, field); };
    const std::array<D, 6> C{x("g0"), x("h"), -x("t0"), x("G"), x("H"), x("T")};
    const SerretState c{C[0].value,
                        C[1].value,
                        -C[2].value,
                        C[3].value,
                        C[4].value,
                        C[5].value,
                        whole_of(s, "sign_g1"),
                        whole_of(s, "sign_g3")};
    return rotor_along(to_rotor(body, c, t), chart_jacobian(body, c, t), C);
  });
}
nb::object rotor_of_sadov(const Body& body, const DualState& s) {
  return on_first_order(s, "SadovState", [&]<class D>(const D&) {
    const auto x = [&](const char* field) { return number_of<D>(s, field); };
    const std::array<D, 6> C{x("phi_l"), x("phi_g"), x("phi_h"), x("I_l"), x("I_g"), x("I_h")};
    const SadovState c{C[0].value,
                       C[1].value,
                       C[2].value,
                       C[3].value,
                       C[4].value,
                       C[5].value,
                       choice<SadovRegion>(s.fields["region"], "region"),
                       whole_of(s, "lobe")};
    return rotor_along(to_rotor(body, c), chart_jacobian(body, c), C);
  });
}

nb::object serret_of(const Body& body, const DualState& s, double t) {
  return on_first_order(s, "SerretState", [&]<class D>(const D&) {
    const BasicRotorState<D> r = rotor_of<D>(s);
    const RotorState state = value_of(r);
    const SerretState c = to_serret(FreeRotation(body, state, t), t);
    const std::array<D, 6> C =
        elements_along(r, inverse_chart_jacobian(state.g, chart_jacobian(body, c, t)),
                       {c.g0, c.h, -c.t0, c.G, c.H, c.T});
    return state_of("SerretState", {{"g0", to_python(C[0])},
                                    {"h", to_python(C[1])},
                                    {"t0", to_python(-C[2])},
                                    {"G", to_python(C[3])},
                                    {"H", to_python(C[4])},
                                    {"T", to_python(C[5])},
                                    {"sign_g1", nb::int_(c.sign_g1)},
                                    {"sign_g3", nb::int_(c.sign_g3)}});
  });
}
nb::object sadov_of(const Body& body, const DualState& s) {
  return on_first_order(s, "SadovState", [&]<class D>(const D&) {
    const BasicRotorState<D> r = rotor_of<D>(s);
    const RotorState state = value_of(r);
    const SadovState c = to_sadov(body, state);
    const std::array<D, 6> C =
        elements_along(r, inverse_chart_jacobian(state.g, chart_jacobian(body, c)),
                       {c.phi_l, c.phi_g, c.phi_h, c.I_l, c.I_g, c.I_h});
    return state_of("SadovState", {{"phi_l", to_python(C[0])},
                                   {"phi_g", to_python(C[1])},
                                   {"phi_h", to_python(C[2])},
                                   {"I_l", to_python(C[3])},
                                   {"I_g", to_python(C[4])},
                                   {"I_h", to_python(C[5])},
                                   {"region", nb::cast(c.region)},
                                   {"lobe", nb::int_(c.lobe)}});
  });
}

void bind_dual_conversions(nb::module_& m) {
  m.def(
      "to_rotor",
      [](const DualState& s) {
        return on_rotor(s, [](const auto& r) { return nb::cast(dual_rotor(r.q, r.g)); });
      },
      "state"_a, "The RotorState of Duals of such a state in any chart.");
  m.def(
      "to_rotor",
      [](const Body& body, const DualState& s, double t) -> nb::object {
        if (s.chart == "SerretState") return rotor_of_serret(body, s, t);
        if (s.chart == "SadovState") return rotor_of_sadov(body, s);
        return std::visit(
            [&](const auto& kind) {
              using D = std::decay_t<decltype(kind)>;
              const auto x = [&](const char* field) { return number_of<D>(s, field); };
              const BasicRotorState<D> r =
                  to_rotor(body, BasicEulerRates<D>{x("phi"), x("theta"), x("psi"), x("phi_dot"),
                                                    x("theta_dot"), x("psi_dot")});
              return nb::cast(dual_rotor(r.q, r.g));
            },
            kind_of(s));
      },
      "body"_a, "state"_a, "t"_a = 0.0,
      "The RotorState of EulerRates, of a SadovState or at time t of a SerretState of Duals.");
  m.def(
      "to_serret",
      [](const Body& body, const DualState& s, double t) { return serret_of(body, s, t); },
      "body"_a, "state"_a, "t"_a = 0.0, "Serret's elements of a state of Duals at time t.");
  m.def(
      "to_sadov", [](const Body& body, const DualState& s) { return sadov_of(body, s); }, "body"_a,
      "state"_a, "Sadov's variables of a state of Duals.");
  m.def(
      "to_andoyer",
      [](const DualState& s) {
        return on_rotor(s, [](const auto& r) {
          const auto a = to_andoyer(r);
          return state_of("AndoyerState", {{"l", to_python(a.l)},
                                           {"g", to_python(a.g)},
                                           {"h", to_python(a.h)},
                                           {"L", to_python(a.L)},
                                           {"G", to_python(a.G)},
                                           {"H", to_python(a.H)}});
        });
      },
      "state"_a, "Andoyer variables of a state of Duals.");
  m.def(
      "to_euler",
      [](const DualState& s) {
        return on_rotor(s, [](const auto& r) {
          const auto e = to_euler(r);
          return state_of("EulerState", {{"phi", to_python(e.phi)},
                                         {"theta", to_python(e.theta)},
                                         {"psi", to_python(e.psi)},
                                         {"Phi", to_python(e.Phi)},
                                         {"Theta", to_python(e.Theta)},
                                         {"Psi", to_python(e.Psi)}});
        });
      },
      "state"_a, "Euler angles and momenta of a state of Duals.");
  m.def(
      "to_euler_rates",
      [](const Body& body, const DualState& s) {
        return on_rotor(s, [&](const auto& r) {
          const auto e = to_euler_rates(body, r);
          return state_of("EulerRates", {{"phi", to_python(e.phi)},
                                         {"theta", to_python(e.theta)},
                                         {"psi", to_python(e.psi)},
                                         {"phi_dot", to_python(e.phi_dot)},
                                         {"theta_dot", to_python(e.theta_dot)},
                                         {"psi_dot", to_python(e.psi_dot)}});
        });
      },
      "body"_a, "state"_a, "Euler angles and their rates of a state of Duals.");
  m.def(
      "to_poincare",
      [](const DualState& s, OneOf<Pole> J, OneOf<Pole> I) {
        const Pole pole_J = choice<Pole>(J, "pole_J"), pole_I = choice<Pole>(I, "pole_I");
        return on_rotor(s, [&](const auto& r) {
          const auto p = to_poincare(r, pole_J, pole_I);
          return state_of("PoincareState", {{"sigma", to_python(p.sigma)},
                                            {"Q1", to_python(p.Q1)},
                                            {"Q2", to_python(p.Q2)},
                                            {"G", to_python(p.G)},
                                            {"P1", to_python(p.P1)},
                                            {"P2", to_python(p.P2)},
                                            {"pole_J", nb::cast(p.pole_J)},
                                            {"pole_I", nb::cast(p.pole_I)}});
        });
      },
      "state"_a, "pole_J"_a, "pole_I"_a, "Poincare-type variables of a state of Duals.");
}

void bind_dual_functions(nb::module_& m) {
  m.def(
      "kinetic_energy",
      [](const Body& body, const DualState& s) {
        return on_rotor(
            s, [&](const auto& r) { return to_python(0.5 * dot(r.g, body_rate(body, r))); });
      },
      "body"_a, "state"_a, "T of a state of Duals, a Dual.");
  m.def(
      "angular_velocity",
      [](const Body& body, const DualState& s) {
        return on_rotor(s, [&](const auto& r) { return to_python(body_rate(body, r)); });
      },
      "system"_a, "state"_a, "omega_B (3,) of a state of Duals.");
  m.def(
      "inertial_angular_velocity",
      [](const Body& body, const DualState& s) {
        return on_rotor(s,
                        [&](const auto& r) { return to_python(rotate(r.q, body_rate(body, r))); });
      },
      "body"_a, "state"_a, "The same in inertial components.");
  m.def(
      "inertial_momentum",
      [](const DualState& s) {
        return on_rotor(s, [](const auto& r) { return to_python(inertial_momentum(r)); });
      },
      "state"_a, "Angular momentum (3,) in inertial components of a state of Duals.");
}

}  // namespace

nb::object dual_state_of(const char* chart, std::span<const Field> fields, const nb::args& args,
                         const nb::kwargs& named) {
  if (args.size() + named.size() > fields.size()) return {};
  DualState s{chart, {}};
  bool any = false;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const Field& field = fields[i];
    nb::object value;
    if (i < args.size())
      value = args[i];
    else if (named.contains(field.name))
      value = named[field.name];
    else if (field.kind == Kind::integer)
      value = field.member != nullptr ? field.member(field.standard) : nb::int_(field.standard);
    else
      return {};
    any = any || has_dual(field, value);
    s.fields[field.name] = value;
  }
  if (!any) return {};
  for (const Field& field : fields) {
    const std::size_t size = size_of_field(field);
    const nb::object value = s.fields[field.name];
    if (size == 1) {
      if (const nb::object item = item_of(value); item.is_valid()) s.fields[field.name] = item;
      continue;
    }
    nb::list items;
    for (const nb::object& x : items_of_vector(value, size)) items.append(x);
    if (nb::len(items) != size)
      throw nb::type_error((s.chart + ": " + field.name + ": expected " + std::to_string(size) +
                            " numbers, floats or Duals")
                               .c_str());
    s.fields[field.name] = object_array(items);
  }
  return nb::cast(std::move(s));
}

void bind_dual_state(nb::module_& m) {
  nb::class_<DualState>(
      m, "DualState",
      R"(A state of Duals: what a chart class makes of Duals, and what functions are called with.

It has the fields of its class: q (4,) and g (3,) of a RotorState, l, g, h, L, G, H of an
AndoyerState; vectors are object arrays. to_rotor, to_andoyer, to_euler, to_poincare, to_serret,
to_sadov, kinetic_energy, angular_velocity and inertial_momentum take it, so that an energy can be
written in any chart:

>>> tilt = polhode.HamiltonianTerm(lambda t, s: 0.1 * polhode.to_andoyer(s).H ** 2)
)",
      nb::type_slots(object_slots<DualState, &DualState::fields>()))
      .def_ro("chart", &DualState::chart, "The name of its class: \"RotorState\".")
      .def(
          "__getattr__",
          [](const DualState& s, const std::string& name) -> Any {
            if (s.fields.contains(name.c_str())) return nb::object(s.fields[name.c_str()]);
            throw nb::attribute_error(
                ("a DualState of " + s.chart + " has no \"" + name + "\"").c_str());
          },
          "name"_a)
      .def("__dir__", [](const DualState& s) { return s.fields.keys(); })
      .def("__repr__", [](const DualState& s) {
        std::string text;
        for (const auto& [name, value] : s.fields)
          text += (text.empty() ? "" : ", ") + nb::cast<std::string>(name) + "=" +
                  nb::cast<std::string>(nb::repr(value));
        return "DualState of " + s.chart + "(" + text + ")";
      });
  bind_dual_conversions(m);
  bind_dual_functions(m);
}

}  // namespace polhode::python
