// SPDX-License-Identifier: MIT
// Andoyer's general method in any six variables that Python writes.
#include "polhode/system/andoyer_method.hpp"

#include "charts/dual_state.hpp"
#include "interface/python_function.hpp"
#include "motion/system_functions.hpp"
#include "motion/system_value.hpp"

namespace polhode::python {

namespace {

using D = Dual<double, 7>;

template <std::size_t N>
bool read(nb::handle items, std::array<D, N>& out) {
  if (PySequence_Check(items.ptr()) == 0 || nb::len(items) != N) return false;
  for (std::size_t i = 0; i < N; ++i)
    if (!from_python(items[i], out[i])) return false;
  return true;
}

// f(z), or f(z, t) where it takes two arguments: the hub state as (q, g).
class PythonVariables {
 public:
  PythonVariables(nb::handle function, const char* where)
      : function_(std::make_shared<PythonFunction>(function, std::string(where) + ": f")) {
    const nb::object parameters =
        nb::module_::import_("inspect").attr("signature")(function).attr("parameters");
    takes_time_ = nb::len(parameters) >= 2;
  }

  BasicRotorState<D> operator()(const rates::Variables<D>& z, const D& t) const {
    const WithGil acquired;
    nb::list items;
    for (const D& x : z) items.append(to_python(x));
    const nb::object array = object_array(items);
    nb::object returned = takes_time_ ? (*function_)(array, to_python(t)) : (*function_)(array);
    if (nb::isinstance<DualState>(returned))
      returned = nb::make_tuple(returned.attr("q"), returned.attr("g"));
    std::array<D, 4> q;
    std::array<D, 3> g;
    const bool pair = PySequence_Check(returned.ptr()) != 0 && nb::len(returned) == 2;
    if (!pair || !read(returned[0], q) || !read(returned[1], g))
      function_->refuse(returned,
                        "a RotorState of Duals, or (q, g): 4 and 3 numbers, floats or Duals "
                        "made of z");
    return {{q[0], q[1], q[2], q[3]}, {g[0], g[1], g[2]}};
  }

 private:
  SharedFunction function_;
  bool takes_time_ = false;
};

// out = of(t, z) at every position of times and variables that broadcast.
template <class Of>
FloatArray at_all(nb::handle z, nb::handle t, std::initializer_list<std::size_t> inner, Of of) {
  std::vector<Numbers> both;
  both.emplace_back(z, "z", std::initializer_list<std::size_t>{6});
  both.emplace_back(t, "t");
  const Shape shape = broadcast(both);
  Result out(shape, inner);
  for_each(size_of(shape), [&](std::size_t k) {
    const double* first = both[0].at(k);
    rates::Variables<double> variables;
    std::copy_n(first, 6, variables.begin());
    of(both[1][k], variables, out.at(k));
  });
  return out.take();
}

using VariablesFunction = Typed<"typing.Callable[..., tuple[typing.Any, typing.Any]]">;

}  // namespace

void bind_andoyer_method(nb::module_& m) {
  const std::string point = "z: numpy.typing.ArrayLike, t: numpy.typing.ArrayLike = 0.0";
  m.def(
      "lagrange_brackets",
      [](VariablesFunction f, ArrayLike z, ArrayLike t) {
        const PythonVariables of(f, "lagrange_brackets");
        return at_all(z, t, {6, 6}, [&](double at, const rates::Variables<double>& x, double* out) {
          put(out, rates::lagrange_brackets(of, x, at));
        });
      },
      "f"_a, "z"_a, "t"_a = 0.0,
      R"(Lagrange brackets [z_k, z_l] of any six variables: (..., 6, 6). [SA "linear"]

f : f(z) -> (q, g), or f(z, t): the state of six variables, (6,) of Dual, written with NumPy's
    functions; q (4,) of any length, g (3,) along the body axes. Or a state that to_rotor made:
    lambda z: to_rotor(AndoyerState(*z)).
z : (..., 6), where.)");
  m.def(
      "canonical_defect",
      [](VariablesFunction f, ArrayLike z, ArrayLike t) -> Floats {
        const PythonVariables of(f, "canonical_defect");
        return at_all(z, t, {}, [&](double at, const rates::Variables<double>& x, double* out) {
          *out = rates::canonical_defect(of, x, at);
        });
      },
      "f"_a, "z"_a, "t"_a = 0.0,
      "How far six variables are from canonical at z (..., 6), three coordinates, then their "
      "momenta: a few roundings for a canonical set, of order one for another. f as in "
      "lagrange_brackets.");
  m.def(
      "equations_of_motion",
      [](const PythonSystem& system, ArrayLike t, ArrayLike z, VariablesFunction f) {
        const PythonVariables of(f, "equations_of_motion");
        return at_all(z, t, {6}, [&](double at, const rates::Variables<double>& x, double* out) {
          for (const double rate : rates::equations_of_motion(system, at, x, of)) *out++ = rate;
        });
      },
      "system"_a, "t"_a, "z"_a, "f"_a,
      "dz/dt (..., 6) of any six variables, canonical or not, under a system: Andoyer's general "
      "method. f as in lagrange_brackets; NaN where it is singular. [SA \"linear\"]");
}

}  // namespace polhode::python
