// SPDX-License-Identifier: MIT
// Dual numbers: arithmetic, comparisons, and the methods that NumPy's functions look for.
#include <array>
#include <cmath>

#include "interface/arrays.hpp"
#include "interface/dual_number.hpp"

namespace polhode::python {

namespace {

using Number = PythonDual::Number;

using DualOrFloat = Typed<"Dual | float">;
using DualObject = Typed<"Dual">;

nb::object not_implemented() { return nb::borrow(Py_NotImplemented); }

nb::object dual_object(const Number& x) { return nb::cast(PythonDual{x}); }

[[noreturn]] void other_kind() {
  throw nb::type_error("Dual: numbers with different derivatives do not mix");
}

// f(a, b) where b is a Dual of the same kind or a real scalar.
template <class F>
nb::object binary(const PythonDual& a, nb::handle b, F f) {
  if (nb::isinstance<PythonDual>(b)) {
    const Number& other = nb::cast<const PythonDual&>(b).x;
    return std::visit(
        [&](const auto& x) -> nb::object {
          using D = std::decay_t<decltype(x)>;
          const D* y = std::get_if<D>(&other);
          if (y == nullptr) other_kind();
          return f(x, *y);
        },
        a.x);
  }
  // an array answers for itself, item by item
  if (!is_real_scalar(b)) return not_implemented();
  const double y = real_scalar(b);
  return std::visit([&](const auto& x) -> nb::object { return f(x, y); }, a.x);
}

// x^a of a constant a, at every layer of derivatives.
double power(double x, double a) { return std::pow(x, a); }
DoubleDouble power(const DoubleDouble& x, double a) {
  if (a != std::floor(a) || std::abs(a) > 1024.0) return exp(DoubleDouble(a) * log(x));
  DoubleDouble result(1.0), square = x;
  for (int n = static_cast<int>(std::abs(a)); n != 0; n /= 2) {  // at most 11 trips
    if (n % 2 == 1) result = result * square;
    square = square * square;
  }
  return a < 0.0 ? DoubleDouble(1.0) / result : result;
}
template <Real T, int N>
Dual<T, N> power(const Dual<T, N>& x, double a) {
  if (a == 0.0) return Dual<T, N>(T(1.0));
  return x.chained(power(x.value, a), T(a) * power(x.value, a - 1.0));
}

DualObject raised(const PythonDual& a, DualOrFloat b) {
  return binary(a, b, [](const auto& x, const auto& y) {
    if constexpr (is_dual<std::decay_t<decltype(y)>>) {
      if (y.is_constant()) return dual_object(power(x, to_double(y)));
      return dual_object(exp(y * log(x)));
    } else {
      return dual_object(power(x, y));
    }
  });
}
DualObject raised_to(const PythonDual& exponent, DualOrFloat base) {
  return binary(exponent, base, [](const auto& y, const auto& x) {
    using std::log;
    using D = std::decay_t<decltype(y)>;
    if constexpr (std::same_as<std::decay_t<decltype(x)>, double>)
      return dual_object(exp(y * log(D(x))));
    else
      return dual_object(exp(y * log(x)));
  });
}

// The remainder that Python's % gives: of the sign of the divisor, which is a constant.
DualObject remainder(const PythonDual& a, DualOrFloat b) {
  return binary(a, b, [](const auto& x, const auto& y) -> nb::object {
    if constexpr (is_dual<std::decay_t<decltype(y)>>) {
      throw nb::type_error("Dual: the divisor of % must be a constant");
    } else {
      return dual_object(x - y * floor(x / y));
    }
  });
}

template <class Class>
void def_arithmetic(Class& c) {
  const auto op = [&c](const char* name, auto f) {
    c.def(
        name, [f](const PythonDual& a, DualOrFloat b) -> DualObject { return binary(a, b, f); },
        "other"_a, nb::is_operator());
  };
  op("__add__", [](const auto& x, const auto& y) { return dual_object(x + y); });
  op("__radd__", [](const auto& x, const auto& y) { return dual_object(y + x); });
  op("__sub__", [](const auto& x, const auto& y) { return dual_object(x - y); });
  op("__rsub__", [](const auto& x, const auto& y) { return dual_object(y - x); });
  op("__mul__", [](const auto& x, const auto& y) { return dual_object(x * y); });
  op("__rmul__", [](const auto& x, const auto& y) { return dual_object(y * x); });
  op("__truediv__", [](const auto& x, const auto& y) { return dual_object(x / y); });
  op("__rtruediv__", [](const auto& x, const auto& y) { return dual_object(y / x); });
  const auto direct = [&c](const char* name, auto f) {
    c.def(name, f, "other"_a, nb::is_operator());
  };
  direct("__pow__", raised);
  direct("__rpow__", raised_to);
  direct("__mod__", remainder);
  const auto compare = [&c](const char* name, auto f) {
    c.def(
        name,
        [f](const PythonDual& a, nb::handle b) -> Typed<"bool"> {
          return binary(a, b, [f](const auto& x, const auto& y) -> nb::object {
            using D = std::decay_t<decltype(x)>;
            return nb::bool_(f(x, D(y)));
          });
        },
        "other"_a, nb::is_operator());
  };
  compare("__eq__", [](const auto& x, const auto& y) { return x == y; });
  compare("__ne__", [](const auto& x, const auto& y) { return !(x == y); });
  compare("__lt__", [](const auto& x, const auto& y) { return x < y; });
  compare("__le__", [](const auto& x, const auto& y) { return x <= y; });
  compare("__gt__", [](const auto& x, const auto& y) { return x > y; });
  compare("__ge__", [](const auto& x, const auto& y) { return x >= y; });
  c.attr("__hash__") = nb::none();
}

template <class F>
DualObject unary(const PythonDual& a, F f) {
  return std::visit([&](const auto& x) -> nb::object { return dual_object(f(x)); }, a.x);
}

// NumPy's functions look for methods of their own names.
template <class Class, class F>
void def_function(Class& c, const char* name, F f) {
  c.def(
      name, [f](const PythonDual& a) { return unary(a, f); },
      (std::string("What numpy.") + name + " calls.").c_str());
}

template <class Class>
void def_elementary(Class& c) {
  def_function(c, "conjugate", [](const auto& x) { return x; });
  def_function(c, "fabs", [](const auto& x) { return abs(x); });
  def_function(c, "sqrt", [](const auto& x) { return sqrt(x); });
  def_function(c, "cbrt", [](const auto& x) {
    const auto root = power(abs(x), 1.0 / 3.0);
    return x < 0.0 ? -root : root;
  });
  def_function(c, "exp", [](const auto& x) { return exp(x); });
  def_function(c, "expm1", [](const auto& x) { return expm1(x); });
  def_function(c, "log", [](const auto& x) { return log(x); });
  def_function(c, "log1p", [](const auto& x) { return log1p(x); });
  def_function(c, "log2",
               [](const auto& x) { return log(x) / log(std::decay_t<decltype(x)>(2.0)); });
  def_function(c, "log10",
               [](const auto& x) { return log(x) / log(std::decay_t<decltype(x)>(10.0)); });
  def_function(c, "sin", [](const auto& x) { return sin(x); });
  def_function(c, "cos", [](const auto& x) { return cos(x); });
  def_function(c, "tan", [](const auto& x) { return tan(x); });
  def_function(c, "arcsin", [](const auto& x) { return asin(x); });
  def_function(c, "arccos", [](const auto& x) { return acos(x); });
  def_function(c, "arctan", [](const auto& x) { return atan(x); });
  def_function(c, "sinh", [](const auto& x) { return sinh(x); });
  def_function(c, "cosh", [](const auto& x) { return cosh(x); });
  def_function(c, "tanh", [](const auto& x) { return tanh(x); });
}

template <class Class>
void def_degrees(Class& c) {
  const auto in_radians = [](const auto& x) {
    using D = std::decay_t<decltype(x)>;
    return x * (pi<D>() / 180.0);
  };
  const auto in_degrees = [](const auto& x) {
    using D = std::decay_t<decltype(x)>;
    return x * (180.0 / pi<D>());
  };
  def_function(c, "deg2rad", in_radians);
  def_function(c, "radians", in_radians);
  def_function(c, "rad2deg", in_degrees);
  def_function(c, "degrees", in_degrees);
}

template <class Class>
void def_signs_and_pairs(Class& c) {
  const auto sign = [&c](const char* name, auto f) {
    c.def(name, [f](const PythonDual& a) { return unary(a, f); });
  };
  sign("__neg__", [](const auto& x) { return -x; });
  sign("__pos__", [](const auto& x) { return x; });
  sign("__abs__", [](const auto& x) { return abs(x); });
  const auto of_two = [&c](const char* name, auto f) {
    c.def(
        name,
        [f](const PythonDual& a, DualOrFloat b) -> DualObject {
          return binary(a, b, [f](const auto& x, const auto& y) {
            using D = std::decay_t<decltype(x)>;
            return dual_object(f(x, D(y)));
          });
        },
        "other"_a, (std::string("What numpy.") + name + " calls.").c_str());
  };
  of_two("arctan2", [](const auto& y, const auto& x) { return atan2(y, x); });
  of_two("hypot", [](const auto& x, const auto& y) { return hypot(x, y); });
}

// As items of object arrays, for whose functions NumPy calls the methods of the first operand.
nb::object boxed(nb::handle value, bool as_dual, const PythonDual& like) {
  nb::object item = nb::borrow(value);
  if (as_dual && is_real_scalar(value)) {
    const double x = real_scalar(value);
    item = std::visit(
        [x](const auto& kind) { return dual_object(std::decay_t<decltype(kind)>(x)); }, like.x);
  }
  if (!nb::isinstance<PythonDual>(item)) return item;
  nb::object box =
      nb::module_::import_("numpy").attr("empty")(nb::make_tuple(), "dtype"_a = "object");
  box.attr("__setitem__")(nb::make_tuple(), item);
  return box;
}

// __array_ufunc__: NumPy asks it for every function with a Dual among its arguments.
Any array_ufunc(nb::handle_t<PythonDual> self, Any ufunc, Text method, const nb::args& inputs,
                const nb::kwargs& options) {
  const std::string name = nb::cast<std::string>(ufunc.attr("__name__"));
  const bool plain = options.size() == 0 && nb::cast<std::string>(method) == "__call__";
  if (plain && inputs.size() == 1 && nb::hasattr(self, name.c_str()))
    return self.attr(name.c_str())();
  const bool needs_method = name == "arctan2" || name == "hypot";
  nb::list arrays;
  for (const nb::handle input : inputs)
    arrays.append(boxed(input, needs_method, nb::cast<const PythonDual&>(self)));
  return ufunc.attr(nb::str(method))(*arrays, **options);
}

template <class T>
nb::object derivative_of(const T& x) {
  using Of = typename T::Scalar;
  if constexpr (is_dual<Of>) {
    nb::list items;
    for (const Of& d : x.derivative) items.append(to_python(d));
    return object_array(items);
  } else {
    Result result({T::size});
    for (std::size_t i = 0; i < T::size; ++i) *result.at(i) = to_double(x.derivative[i]);
    return result.take();
  }
}

template <int N>
Number made(double value, const Numbers& derivative) {
  Dual<double, N> x(value);
  for (std::size_t i = 0; i < x.size; ++i) x.derivative[i] = derivative[i];
  return x;
}

Number made(double value, nb::handle derivative) {
  if (derivative.is_none()) return Tangent(value);
  const Numbers d(derivative, "derivative");
  const Shape& shape = d.shape();
  if (shape == Shape{1}) return made<1>(value, d);
  if (shape == Shape{6}) return made<6>(value, d);
  if (shape == Shape{7}) return made<7>(value, d);
  throw nb::value_error(
      ("Dual: derivative: got shape " + text_of(shape) + "; expected (1,), (6,) or (7,)").c_str());
}

std::string repr_of(nb::handle self) {
  const nb::object value = self.attr("value"), derivative = self.attr("derivative");
  return "Dual(" + nb::cast<std::string>(nb::repr(value)) + ", " +
         nb::cast<std::string>(nb::repr(nb::object(derivative.attr("tolist")()))) + ")";
}

template <class Class>
void def_parts(Class& c) {
  c.def_prop_ro(
       "value", [](const PythonDual& a) -> Typed<"float | Dual"> {
         return std::visit(
             [](const auto& x) -> nb::object {
               if constexpr (is_dual<std::decay_t<decltype(x.value)>>)
                 return to_python(x.value);
               else
                 return nb::float_(to_double(x.value));
             },
             a.x);
       },
       "float; a Dual where second derivatives are carried.")
      .def_prop_ro(
          "derivative", [](const PythonDual& a) -> Typed<"numpy.typing.NDArray[typing.Any]"> {
            return std::visit([](const auto& x) { return derivative_of(x); }, a.x);
          },
          "Array of the first derivatives.");
}

template <class Class>
void def_protocols(Class& c) {
  c.def("__bool__",
        [](const PythonDual& a) {
          return std::visit([](const auto& x) { return to_double(x) != 0.0; }, a.x);
        })
      .def("__float__",
           [](const PythonDual&) -> double {
             throw nb::type_error(
                 "a Dual is no float, which would lose its derivatives: use NumPy's functions "
                 "(np.sin, not math.sin), or .value");
           })
      .def("__repr__", [](nb::handle_t<PythonDual> self) { return repr_of(self); })
      .def("__reduce__", [](nb::handle_t<PythonDual> self) {
        return nb::make_tuple(nb::handle(self.type()),
                              nb::make_tuple(self.attr("value"), self.attr("derivative")));
      });
  c.def("__array_ufunc__", array_ufunc, "ufunc"_a, "method"_a, "inputs"_a, "options"_a);
}

}  // namespace

void bind_math(nb::module_& m) {
  nb::class_<PythonDual> c(
      m, "Dual", R"(A number with its derivatives, carried through + - * / ** and NumPy's functions.

What functions written in Python are called with: Frame.orbit_plane and its like with a time,
HamiltonianTerm with the components of a state. Write them with np.sin(x), not math.sin(x).
Comparisons look at the value alone.

Parameters
----------
value : float.
derivative : of shape (1,), (6,) or (7,); None: six zeros, a constant.)");
  c.def(
      "__init__",
      [](PythonDual* self, double value, ArrayLike derivative) {
        new (self) PythonDual{made(value, derivative)};
      },
      "value"_a, "derivative"_a = nb::none());
  def_parts(c);
  def_protocols(c);
  def_arithmetic(c);
  def_elementary(c);
  def_degrees(c);
  def_signs_and_pairs(c);
}

}  // namespace polhode::python
