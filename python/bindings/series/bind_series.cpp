// SPDX-License-Identifier: MIT
// Symbols, series and their algebra.
#include <algorithm>

#include "interface/value.hpp"
#include "polhode/secular/lie_transform.hpp"
#include "polhode/series/product.hpp"
#include "polhode/series/series_text.hpp"
#include "polhode/series/taylor_coefficient.hpp"
#include "series/series_value.hpp"

namespace polhode::python {

namespace {

using Keep = std::optional<series::Truncation>;
series::Truncation kept(const Keep& keep) { return keep.value_or(series::Truncation{}); }

// f of a series, of whichever type; without the GIL.
template <class F>
PythonSeries made(const PythonSeries& a, F f) {
  const WithoutGil released;
  return std::visit([&](const auto& s) { return PythonSeries{f(s)}; }, a.s);
}
// f(a, b): exact if both are.
template <class F>
auto of_both(const PythonSeries& a, const PythonSeries& b, F f) {
  const WithoutGil released;
  if (a.has_functions() || b.has_functions()) {
    series::detail::require_same(a.symbols(), b.symbols());
    return f(std::get<2>(a.s), std::get<2>(b.s));
  }
  if (a.is_exact() && b.is_exact()) return f(std::get<0>(a.s), std::get<0>(b.s));
  return f(a.doubles(), b.doubles());
}
template <class F>
PythonSeries made(const PythonSeries& a, const PythonSeries& b, F f) {
  return of_both(a, b, [&](const auto& x, const auto& y) { return PythonSeries{f(x, y)}; });
}

struct PythonTerm {
  SeriesNumber coefficient;
  Counts powers;
  std::string function;
  Counts multiples;
};

template <class T>
PythonTerm term_of(const series::Symbols& symbols, const series::Term<T>& term) {
  PythonTerm out{
      term.c, {}, term.key.function() == series::Trigonometric::sine ? "sin" : "cos", {}};
  for (int i = 0; i < symbols.exponents().count(); ++i)
    if (const int n = series::exponent(symbols, term.key, i); n != 0)
      out.powers[symbols.variables()[static_cast<std::size_t>(i)]] = n;
  for (int i = 0; i < symbols.multipliers().count(); ++i)
    if (const int k = series::multiplier(symbols, term.key, i); k != 0)
      out.multiples[symbols.angles()[static_cast<std::size_t>(i)]] = k;
  return out;
}
std::vector<PythonTerm> terms_of(const PythonSeries& a) {
  std::vector<PythonTerm> terms;
  const auto add = [&](const auto& s) {
    for (const auto& term : s.terms()) terms.push_back(term_of(s.symbols(), term));
  };
  if (a.is_exact())
    add(std::get<0>(a.s));
  else
    add(a.doubles());
  return terms;
}

template <class T>
series::Series<T> series_of_terms(const series::Symbols& symbols,
                                  const std::vector<PythonTerm>& all) {
  std::vector<series::Term<T>> terms;
  for (const PythonTerm& term : all) {
    if (term.function != "cos" && term.function != "sin")
      throw DomainError("Series: the function '" + term.function + "'; expected cos or sin");
    const series::Trigonometric function =
        term.function == "sin" ? series::Trigonometric::sine : series::Trigonometric::cosine;
    const series::TermKey key =
        series::packed(symbols, pairs_of(term.powers), pairs_of(term.multiples), function);
    const auto coefficient = [](const auto& c) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (std::is_same_v<C, double> && std::is_same_v<T, double>)
        return finite(c);
      else if constexpr (std::is_constructible_v<T, C>)
        return static_cast<T>(c);
      else
        return T();  // a double among rationals: series_of_terms<double> is called then
    };
    terms.push_back({key, std::visit(coefficient, term.coefficient)});
  }
  return series::Series<T>(symbols, std::move(terms));
}
PythonSeries of_terms(const series::Symbols& symbols, const std::vector<PythonTerm>& terms) {
  const bool exact = std::all_of(terms.begin(), terms.end(),
                                 [](const auto& term) { return term.coefficient.index() == 0; });
  if (!symbols.values().empty())
    return {series::collected<MomentumFunction>(series_of_terms<double>(symbols, terms))};
  if (exact) return {series_of_terms<series::Rational>(symbols, terms)};
  return {series_of_terms<double>(symbols, terms)};
}

PythonSeries read(const series::Symbols& symbols, const std::string& text, bool exact) {
  const WithoutGil released;
  if (!symbols.values().empty()) return {series::series_from_text<MomentumFunction>(symbols, text)};
  if (exact) return {series::series_from_text<series::Rational>(symbols, text)};
  return {series::series_from_text<double>(symbols, text)};
}
PythonSeries of_csv(const series::Symbols& symbols, const std::string& table, bool exact) {
  const WithoutGil released;
  if (!symbols.values().empty()) return {series::series_from_csv<MomentumFunction>(symbols, table)};
  if (exact) return {series::series_from_csv<series::Rational>(symbols, table)};
  return {series::series_from_csv<double>(symbols, table)};
}
std::string text_of_series(const PythonSeries& a) {
  return std::visit([](const auto& s) { return series::text(s); }, a.s);
}
std::string latex_of(const PythonSeries& a) {
  return std::visit([](const auto& s) { return series::latex(s); }, a.s);
}
std::string csv_of(const PythonSeries& a) {
  return std::visit([](const auto& s) { return series::csv(s); }, a.s);
}
std::size_t size_of(const PythonSeries& a) {
  return a.has_functions() ? a.doubles().size()
                           : std::visit([](const auto& s) { return s.size(); }, a.s);
}
// None for series whose coefficients are numbers.
std::optional<int> known_degree_of(const PythonSeries& a) {
  if (!a.has_functions()) return std::nullopt;
  int least = MomentumFunction::highest_degree;
  for (const auto& term : std::get<2>(a.s).terms()) least = std::min(least, term.c.known());
  return least;
}

PythonSeries quotient(const PythonSeries& a, const PythonSeries& b) {
  return made(a, b,
              [](const auto& x, const auto& y) { return series::product(x, series::inverse(y)); });
}
PythonSeries integral_of(const PythonSeries& a, const Operands& rates, double least) {
  return with_numbers_of(a, are_exact(a.symbols(), rates), [&]<class T>() {
    const series::Series<T> f = as<T>(a);
    const std::vector<series::AngleRate<T>> all = rates_of<T>(a.symbols(), rates);
    const WithoutGil released;
    return PythonSeries{series::integral(f, all, least)};
  });
}
secular::TransformSize transform_size_of(const PythonSeries& h, const series::Truncation& keep,
                                         const Operands& clocks) {
  return with_numbers_of(h, are_exact(h.symbols(), clocks), [&]<class T>() {
    secular::Elimination<T> problem{as<T>(h), keep, {}};
    problem.clocks = rates_of<T>(h.symbols(), clocks);
    const WithoutGil released;
    return secular::transform_size(problem);
  });
}
PythonSeries with_angles(const PythonSeries& a, const std::map<std::string, Counts>& sums) {
  std::vector<series::AngleSum> all;
  for (const auto& [angle, sum] : sums) all.push_back({angle, pairs_of(sum)});
  return made(a, [&](const auto& s) { return series::angles_replaced(s, all); });
}

void bind_symbols(nb::module_& m) {
  using S = series::Symbols;
  using Pairs = std::vector<std::tuple<std::string, std::string>>;
  const auto pairs = [](const S& s) {
    Pairs all;
    for (const series::ConjugatePair& pair : s.pairs())
      all.emplace_back(pair.coordinate, pair.momentum);
    return all;
  };
  using Values = std::map<std::string, double>;
  const auto values = [](const S& s) {
    Values all;
    for (std::size_t i = 0; i < s.values().size(); ++i) all[s.variables()[i]] = s.values()[i];
    return all;
  };
  const auto made = [](const std::vector<std::string>& variables,
                       const std::vector<std::string>& angles, const Pairs& all,
                       const Values& chosen) {
    if (chosen.size() > static_cast<std::size_t>(MomentumFunction::variable_count))
      throw DomainError("Symbols: values: " + std::to_string(chosen.size()) +
                        " variables; expected at most " +
                        std::to_string(MomentumFunction::variable_count));
    std::vector<series::ConjugatePair> conjugate;
    for (const auto& [q, p] : all) conjugate.push_back({q, p});
    return S(variables, angles, std::move(conjugate), {chosen.begin(), chosen.end()});
  };
  bind_made_value<S>(
      m, "Symbols", R"doc(The names that series are written in.

Parameters
----------
variables : what has exponents: momenta, parameters, coordinates that are no angles.
angles : what stands in cosines and sines, rad.
pairs : (coordinate, momentum) of each degree of freedom: dq/dt = dH/dp, dp/dt = -dH/dq.
values : of up to three momenta or parameters, the first of `variables`. Coefficients of series are
    then functions of them, sqrt(G^2 - L^2) or 1/(G + L): Taylor polynomials of degree 6 about
    these values, in floats. Results hold near the values.

Examples
--------
>>> names = Symbols(["L", "G", "k"], ["l", "g"], [("l", "L"), ("g", "G")],
...                 values={"L": 0.6, "G": 1.0})
>>> round(Series(names, "k*sqrt(G^2 - L^2)*sin(l)")(L=0.61, G=1.0, k=1.0, l=0.5), 9)
0.379897474

Up to 12 variables and 12 angles. A name is a letter or _ and then letters, digits, _ or ', and not
cos or sin. Exponents and multipliers are integers below 2^14 in size for up to 3 variables or
angles, 2^10 for 5, 2^5 for 9, 2^3 for 12. ValueError for names that break this.)doc",
      made,
      field(
          "variables", [](const S& s) { return s.variables(); }, "Their names."),
      field(
          "angles", [](const S& s) { return s.angles(); }, "Their names.",
          std::vector<std::string>()),
      field("pairs", pairs, "(coordinate, momentum) each.", Pairs()),
      field("values", values, "Of the first variables, to expand about.", Values()).but_quiet());

  using T = series::Truncation;
  bind_made_value<T>(
      m, "Truncation", R"(Which terms are kept: those up to an order.

Parameters
----------
weights : of small variables; the order of a term is the sum of weight times exponent.
order : the highest that is kept.
most_bytes : of memory for one product, or for one Lie transform, else it is refused before it
    starts. The digits of long fractions come on top.

Without weights every term is kept.)",
      [](const Counts& weights, int order, std::size_t most_bytes) {
        return T{pairs_of(weights), order, most_bytes};
      },
      field(
          "weights", [](const T& t) { return Counts(t.weights.begin(), t.weights.end()); },
          "Of small variables.", Counts()),
      field("order", &T::order, "The highest that is kept.", 0),
      field("most_bytes", &T::most_bytes, "Of memory for one product or transform.", T{}.most_bytes)
          .but_quiet());
}

void bind_terms(nb::module_& m) {
  using T = PythonTerm;
  bind_value<T>(
      m, "SeriesTerm", R"(A term of a series: coefficient * powers * cos or sin(multiples).

Parameters
----------
coefficient : a Fraction or an int where the series is exact, else a float.
powers : the exponent of each variable.
function : "cos" or "sin".
multiples : the multiplier of each angle.)",
      field("coefficient", &T::coefficient, "A Fraction, or a float."),
      field("powers", &T::powers, "The exponent of each variable that it has.", Counts()),
      field("function", &T::function, "\"cos\", or \"sin\".", std::string("cos")),
      field("multiples", &T::multiples, "The multiplier of each angle that it has.", Counts()));
  using P = series::ProductSize;
  bind_value<P>(m, "ProductSize", "What a product of two series will take: upper bounds.",
                field("pairs", &P::pairs, "Of terms that are multiplied."),
                field("terms", &P::terms, "Of the result."),
                field("bytes", &P::bytes, "Of memory while it is made."));
  using L = secular::TransformSize;
  bind_value<L>(m, "TransformSize", "What a Lie transform will take, by its order from 0 on.",
                field("terms", &L::terms, "Of a series of each order, at most."),
                field("bytes", &L::bytes, "Of memory, if the order is the last."),
                field("counted", &L::counted,
                      "The last order that was counted; what follows is extrapolated."));
}

template <class F>
void def_operator(nb::class_<PythonSeries>& c, const char* name, const char* reflected, F f) {
  using S = PythonSeries;
  c.def(
      name, [f](const S& a, const Operand& b) { return f(a, series_of(a.symbols(), b)); },
      nb::is_operator(), "other"_a);
  c.def(
      reflected, [f](const S& a, const Operand& b) { return f(series_of(a.symbols(), b), a); },
      nb::is_operator(), "other"_a);
}

void def_arithmetic(nb::class_<PythonSeries>& c) {
  using S = PythonSeries;
  const auto sum = [](const S& a, const S& b) {
    return made(a, b, [](const auto& x, const auto& y) { return x + y; });
  };
  const auto difference = [](const S& a, const S& b) {
    return made(a, b, [](const auto& x, const auto& y) { return x - y; });
  };
  const auto times = [](const S& a, const S& b) {
    return made(a, b, [](const auto& x, const auto& y) { return x * y; });
  };
  def_operator(c, "__add__", "__radd__", sum);
  def_operator(c, "__sub__", "__rsub__", difference);
  def_operator(c, "__mul__", "__rmul__", times);
  def_operator(c, "__truediv__", "__rtruediv__", quotient);
  c.def("__neg__", [](const S& a) { return made(a, [](const auto& s) { return -s; }); });
  c.def(
      "__pow__",
      [](const S& a, int n) { return made(a, [&](const auto& s) { return series::power(s, n); }); },
      nb::is_operator(), "n"_a);
  // numpy.float64(2.0) * a is a product, not an array of objects
  c.attr("__array_ufunc__") = nb::none();
}

void def_products(nb::class_<PythonSeries>& c) {
  using S = PythonSeries;
  c.def(
      "product",
      [](const S& a, const S& b, const Keep& keep) {
        return made(
            a, b, [&](const auto& x, const auto& y) { return series::product(x, y, kept(keep)); });
      },
      "other"_a, "keep"_a = nb::none(),
      "The product up to the order of `keep`. ValueError before it starts, with an estimate, where "
      "it may need more memory than keep.most_bytes.");
  c.def(
      "product_size",
      [](const S& a, const S& b, const Keep& keep) {
        return of_both(a, b, [&](const auto& x, const auto& y) {
          return series::product_size(x, y, kept(keep));
        });
      },
      "other"_a, "keep"_a = nb::none(), "What a product will take, without making it.");
  c.def("transform_size", transform_size_of, "keep"_a, "clocks"_a = Operands(),
        R"(What LieTransform will take of this Hamiltonian, without making it.

Exponents and multipliers that can be reached are counted order by order, without coefficients, for
a tenth of a second; orders beyond that are extrapolated.

Parameters
----------
keep : Truncation by small parameters, as for the transform.
clocks : rates of angles without a momentum, as for the transform.

ValueError for what a LieTransform refuses of the part of order 0, the orders and the clocks.)");
  c.def(
      "power",
      [](const S& a, int n, const Keep& keep) {
        return made(a, [&](const auto& s) { return series::power(s, n, kept(keep)); });
      },
      "n"_a, "keep"_a = nb::none(),
      "The power up to the order of `keep`; n < 0 for one term without an angle alone.");
  c.def(
      "bracket",
      [](const S& a, const S& b, const Keep& keep) {
        return made(
            a, b, [&](const auto& x, const auto& y) { return series::bracket(x, y, kept(keep)); });
      },
      "other"_a, "keep"_a = nb::none(),
      "Poisson's {self, other}, the sum over pairs (q, p) of df/dq dg/dp - df/dp dg/dq.");
  c.def(
      "truncated",
      [](const S& a, const series::Truncation& keep) {
        return made(a, [&](const auto& s) { return series::truncated(s, keep); });
      },
      "keep"_a, "The terms up to the order of `keep`.");
  c.def(
      "part_of_order",
      [](const S& a, const series::Truncation& weights, int order) {
        return made(a, [&](const auto& s) { return series::part_of_order(s, weights, order); });
      },
      "weights"_a, "order"_a, "The terms of one order alone, by the weights of a Truncation.");
}

void def_calculus(nb::class_<PythonSeries>& c) {
  using S = PythonSeries;
  c.def(
      "derivative",
      [](const S& a, const std::string& name) {
        return made(a, [&](const auto& s) { return series::derivative(s, name); });
      },
      "name"_a, "By a variable or an angle.");
  c.def(
      "mean",
      [](const S& a, const std::vector<std::string>& angles) {
        return made(a, [&](const auto& s) { return series::mean(s, angles); });
      },
      "angles"_a, "The mean over each of these angles: the terms that have none of them.");
  c.def("integral", integral_of, "rates"_a, "least"_a = 0.0,
        R"(The integral along angles that advance, without a constant.

S with sum of w_i dS/dphi_i = self.

Parameters
----------
rates : of each angle that advances: a number, or a series without angles. The rate of the
    combination of angles of each term must be one term.
least : the smallest coefficient of a rate to divide by.

ValueError that names the combination of angles whose rate is zero, below the bound or a sum of
different terms.)");
  c.def(
      "substituted",
      [](const S& a, const std::string& name, const Operand& s, const Keep& keep) {
        return made(a, series_of(a.symbols(), s), [&](const auto& x, const auto& y) {
          return series::substituted(x, name, y, kept(keep));
        });
      },
      "name"_a, "s"_a, "keep"_a = nb::none(), "The variable `name` replaced by s.");
  c.def(
      "displaced",
      [](const S& a, const std::string& name, const Operand& d, const Keep& keep) {
        return made(a, series_of(a.symbols(), d), [&](const auto& x, const auto& y) {
          return series::displaced(x, name, y, kept(keep));
        });
      },
      "name"_a, "d"_a, "keep"_a = nb::none(),
      "The variable or angle `name` replaced by itself and d: Taylor's series, which must end. So "
      "the d of an angle needs an order above 0 in `keep`.");
  c.def("angles_replaced", with_angles, "sums"_a,
        "Angles replaced, all at once, by sums of multiples of angles: {\"l\": {\"l\": 1, \"g\": "
        "-1}}.");
}

void def_texts(nb::class_<PythonSeries>& c) {
  using S = PythonSeries;
  c.def("latex", latex_of, "For a formula: names of Greek letters become these letters.")
      .def("csv", csv_of, "A table: a header, and a row a term.")
      .def("__str__", text_of_series)
      .def("_repr_latex_", [](const S& a) { return "$" + latex_of(a) + "$"; })
      .def("__repr__",
           [](const S& a) {
             const std::string text = text_of_series(a);
             return "<Series of " + std::to_string(size_of(a)) +
                    (a.is_exact() ? ", exact: " : ": ") + text.substr(0, 160) +
                    (text.size() > 160 ? " ...>" : ">");
           })
      .def("__len__", [](const S& a) { return size_of(a); })
      .def(
          "__iter__", [](const S& a) { return nb::iter(nb::cast(terms_of(a))); },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[SeriesTerm]"))
      .def(
          "__call__", [](const S& a, const nb::kwargs& v) { return value_of(a, v); },
          nb::sig("def __call__(self, **values: numpy.typing.ArrayLike) -> float | "
                  "numpy.typing.NDArray[numpy.float64]"),
          "Its value where each variable and angle has this number or array; they broadcast. A "
          "name that no term has may be left out. CompiledSeries is faster for many calls.");
}

void bind_series_class(nb::module_& m) {
  using S = PythonSeries;
  nb::class_<S> c(m, "Series", R"doc(A Poisson series: sum of C a1^n1 ... am^nm cos|sin(k.phi).

Coefficients are fractions (exact) or floats. A number in a sum or product is a constant: ints and
Fractions keep a series exact, a float or a series of floats makes floats of it. If the symbols have
values, coefficients are functions of the variables with a value, kept as Taylor polynomials.

Parameters
----------
symbols : Symbols.
text : an expression: sums, products, quotients by one term without an angle, powers such as G^-2,
    parentheses, cos and sin of sums of integer multiples of angles. With values of momenta in the
    symbols also sqrt of a function of these momenta and quotients by one.
exact : False for floats. Else 0.1 is the fraction 1/10. Ignored if the symbols have values.

Examples
--------
>>> names = Symbols(["L", "G"], ["l"], [("l", "L")], values={"L": 0.6, "G": 1.0})
>>> sin_J = Series(names, "sqrt(1 - L^2/G^2)")
>>> round(sin_J(L=0.61, G=1.02), 9)
0.801466841
>>> sin_J.known_degree, sin_J.derivative("L").known_degree
(6, 5)

Text, LaTeX, terms and tables of series with such coefficients are in powers of displacements:
(L - 0.6)^2.

ValueError with the column and what was expected there; for exponents and multipliers out of range;
for two series with different symbols.)doc");
  c.def(
       "__init__",
       [](S* self, const series::Symbols& symbols, const std::string& text, bool exact) {
         new (self) S(read(symbols, text, exact));
       },
       "symbols"_a, "text"_a, "exact"_a = true)
      .def_static("of_terms", of_terms, "symbols"_a, "terms"_a,
                  "The sum of terms, in any order; exact if no coefficient is a float.")
      .def_static("of_csv", of_csv, "symbols"_a, "table"_a, "exact"_a = true,
                  "The table that csv writes, read back; its header must be that of the symbols.")
      .def_prop_ro(
          "symbols", [](const S& a) { return a.symbols(); }, "The names it is written in.")
      .def_prop_ro("exact", &S::is_exact, "Whether coefficients are fractions.")
      .def_prop_ro("known_degree", known_degree_of,
                   "The degree in the displacements from symbols.values to which all coefficients "
                   "are known: 6, less 1 for each derivative of a root or quotient. None for "
                   "coefficients that are numbers.")
      .def_prop_ro("terms", terms_of, "Its terms, sorted; iteration gives the same.")
      .def(
          "to_doubles", [](const S& a) { return a.has_functions() ? a : S{a.doubles()}; },
          "The same with the nearest floats as coefficients.");
  def_arithmetic(c);
  def_products(c);
  def_calculus(c);
  def_texts(c);
  def_value(
      c, [](const S& a) { return nb::make_tuple(a.symbols(), csv_of(a), a.is_exact()); }, "of_csv");
}

}  // namespace

void bind_series(nb::module_& m) {
  bind_symbols(m);
  bind_terms(m);
  bind_series_class(m);
  bind_compiled_series(m);
}

}  // namespace polhode::python
