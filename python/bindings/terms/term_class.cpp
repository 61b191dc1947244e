// SPDX-License-Identifier: MIT
#include "terms/term_class.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace polhode::python {

namespace {

std::string name_of(const std::string& type, nb::handle name, nb::handle function) {
  if (nb::isinstance<nb::str>(name)) return nb::cast<std::string>(name);
  if (!name.is_none())
    throw nb::type_error((type + ": name: got " + class_name(name) + "; expected a str").c_str());
  if (function.is_valid() && nb::hasattr(function, "__name__"))
    return nb::cast<std::string>(nb::str(nb::object(function.attr("__name__"))));
  return type;
}

// Lines of at most 100 columns, all but the first indented.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line, word;
  while (words >> word) {
    if (!line.empty() && line.size() + 1 + word.size() > 100) {
      lines += line + "\n";
      line = "   ";
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line;
}

std::string docstring(const TermClass& of) {
  std::string text = of.summary + "\n\nParameters\n----------";
  for (const TermArgument& a : of.arguments) text += "\n" + wrapped(a.name + " : " + a.help);
  return of.notes.empty() ? text : text + "\n\n" + of.notes;
}

std::string signature(const TermClass& of) {
  std::string text = "def __init__(self";
  for (const TermArgument& a : of.arguments) {
    text += ", " + a.name + ": " + a.type;
    if (!a.otherwise.empty()) text += " = " + a.otherwise;
  }
  return text + ") -> None";
}

std::size_t place_of(const TermClass& of, std::string_view name) {
  const auto found = std::ranges::find(of.arguments, name, &TermArgument::name);
  return static_cast<std::size_t>(found - of.arguments.begin());
}

// One object for each argument, None for what is left out.
std::vector<nb::object> bound(const TermClass& of, const nb::args& args, const nb::kwargs& named) {
  std::vector<nb::object> given(of.arguments.size());
  if (args.size() > given.size()) throw nb::next_overload();
  for (std::size_t i = 0; i < args.size(); ++i) given[i] = nb::object(args[i]);
  for (const auto& [key, value] : named) {
    const std::size_t i = place_of(of, nb::cast<std::string>(key));
    if (i == given.size() || given[i].is_valid()) throw nb::next_overload();
    given[i] = nb::borrow(value);
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (!given[i].is_valid()) given[i] = nb::none();
    if (of.arguments[i].otherwise.empty() && given[i].is_none()) throw nb::next_overload();
  }
  return given;
}

PythonTerm term_of(const TermClass& of, const nb::args& args, const nb::kwargs& named) {
  const std::vector<nb::object> given = bound(of, args, named);
  const bool is_function = !given.empty() && of.arguments.front().name == "function";
  const std::size_t named_at = place_of(of, "name");
  const std::string name = name_of(of.name, named_at < given.size() ? given[named_at] : nb::none(),
                                   is_function ? nb::handle(given.front()) : nb::handle());
  Making at{of.name, name, of.name + " \"" + name + "\""};
  MadeTerm made = of.made(at, given);
  Recipe recipe{"", {}, std::move(made.arguments), std::move(at.functions)};
  for (const TermArgument& a : of.arguments) recipe.names.push_back(a.name.c_str());
  return {of, std::move(made.parts), std::move(recipe)};
}

// One C++ type per Python class.
template <std::size_t number>
struct TermOf : PythonTerm {
  explicit TermOf(PythonTerm term) : PythonTerm(std::move(term)) {}
};

template <std::size_t number>
void bind_class(nb::module_& m, TermClass& of) {
  using C = TermOf<number>;
  nb::class_<C, PythonTerm> c(m, of.name.c_str(), docstring(of).c_str(),
                              nb::type_slots(recipe_slots<C>()));
  c.def(
      "__init__",
      [&of](C* self, const nb::args& args, const nb::kwargs& named) {
        new (self) C(term_of(of, args, named));
      },
      nb::sig(signature(of).c_str()));
  nb::list names;
  for (std::size_t i = 0; i < of.arguments.size(); ++i) {
    const TermArgument& a = of.arguments[i];
    names.append(a.name);
    if (a.shown.empty()) continue;
    const bool is_array = a.shown.starts_with("numpy");
    c.def_prop_ro(
        a.name.c_str(),
        [i, is_array](const C& term) -> nb::object {
          const nb::object kept = term.recipe.argument(i);
          if (!is_array || kept.is_none()) return kept;
          return real_array(kept, "");
        },
        a.help.c_str(), nb::sig(("def " + a.name + "(self) -> " + a.shown).c_str()));
  }
  c.attr("__match_args__") = nb::tuple(names);
  of.type = c;
}

using Bind = void (*)(nb::module_&, TermClass&);
template <std::size_t... numbers>
constexpr std::array<Bind, sizeof...(numbers)> binds(std::index_sequence<numbers...>) {
  return {bind_class<numbers>...};
}
// As many as there may be.
constexpr std::array bind_number = binds(std::make_index_sequence<24>());

// They outlive every term, and the interpreter.
std::deque<TermClass>& classes() {
  static auto& all = *new std::deque<TermClass>;
  return all;
}

// The base of the classes that Python makes.
struct RegisteredTerm : PythonTerm {
  explicit RegisteredTerm(PythonTerm term) : PythonTerm(std::move(term)) {}
};

void bind_registered(nb::module_& m) {
  nb::class_<RegisteredTerm, PythonTerm>(m, "_RegisteredTerm",
                                         "A term of a kind that polhode.kinds registers.",
                                         nb::type_slots(recipe_slots<RegisteredTerm>()))
      .def("__init__", [](RegisteredTerm* self, std::size_t number, const nb::args& args,
                          const nb::kwargs& named) {
        new (self) RegisteredTerm(term_of(classes().at(number), args, named));
      });
  m.def("_set_term_type", [](std::size_t number, nb::handle type) {
    classes().at(number).type = type.inc_ref();  // for good, as the description
  });
}

bool all_of(const PythonTerm& term, bool (AnyPerturbation::*is)() const) {
  return std::ranges::all_of(term.parts, [&](const AnyPerturbation& part) { return (part.*is)(); });
}

std::vector<double> breakpoints(const PythonTerm& term) {
  std::vector<double> all;
  for (const AnyPerturbation& part : term.parts) {
    const std::vector<double> own = part.breakpoints();
    all.insert(all.end(), own.begin(), own.end());
  }
  std::ranges::sort(all);
  return all;
}

double time_scale(const PythonTerm& term) {
  double least = std::numeric_limits<double>::infinity();
  for (const AnyPerturbation& part : term.parts) least = std::min(least, part.time_scale());
  return least;
}

// (name, value, sort) of the keys that files have of a term, but for what is left out.
nb::list term_table(const PythonTerm& term) {
  nb::list table;
  for (std::size_t i = 0; term.of != nullptr && i < term.of->arguments.size(); ++i) {
    const TermArgument& a = term.of->arguments[i];
    const nb::object value = term.recipe.argument(i);
    if (!a.key.empty() && !value.is_none()) table.append(nb::make_tuple(a.name, value, a.key));
  }
  return table;
}

}  // namespace

TermArgument name_argument() {
  return {"name", "str | None", "stands in messages; None: that of the function, or of the class.",
          "None"};
}

void add_term_class(nb::module_& m, TermClass of) {
  const std::size_t number = classes().size();
  if (number == bind_number.size()) throw std::logic_error("more classes of terms than types");
  bind_number[number](m, classes().emplace_back(std::move(of)));
}

nb::tuple add_registered_class(TermClass of) {
  const TermClass& kept = classes().emplace_back(std::move(of));
  nb::list names;
  for (const TermArgument& a : kept.arguments) names.append(a.name);
  return nb::make_tuple(classes().size() - 1, kept.name, signature(kept), docstring(kept),
                        nb::tuple(names));
}

// The last one: a kind may be registered again.
const TermClass* class_of_kind(std::string_view kind) {
  const auto found = std::find_if(classes().rbegin(), classes().rend(),
                                  [&](const TermClass& one) { return one.kind == kind; });
  return found == classes().rend() ? nullptr : &*found;
}

void bind_perturb(nb::module_& m) {
  using P = PythonTerm;
  nb::class_<P> c(m, "AnyPerturbation",
                  "A term of a System: what every kind of term can be asked.\n\n"
                  "Each kind of [[perturbation]] has a class, as GravityGradient; TorqueTerm, "
                  "HamiltonianTerm and\nMomentumTerm make terms of functions.",
                  nb::type_slots(recipe_slots<P>()));
  c.def_prop_ro(
       "name", [](const P& p) { return p.name(); }, "Stands for the term in messages.")
      .def_prop_ro(
          "kind",
          [](const P& p) -> std::optional<std::string> {
            if (p.of == nullptr || p.of->kind.empty()) return std::nullopt;
            return p.of->kind;
          },
          "The word for it in a scenario; None: it has no place there.")
      .def_prop_ro(
          "arguments", [](const P& p) { return p.recipe.by_name(); },
          "What it was made from, by name.")
      .def_prop_ro(
          "supports_energy",
          [](const P& p) { return all_of(p, &AnyPerturbation::supports_energy); },
          "Whether it has an energy H', of which its effect is the derivative.")
      .def_prop_ro(
          "supports_flow", [](const P& p) { return all_of(p, &AnyPerturbation::supports_flow); },
          "Whether its own motion is known exactly, as Splitting needs.")
      .def_prop_ro(
          "is_kick", [](const P& p) { return all_of(p, &AnyPerturbation::is_kick); },
          "Whether it is a torque of time and attitude alone.")
      .def_prop_ro(
          "supports_any_real",
          [](const P& p) { return all_of(p, &AnyPerturbation::supports_any_real); },
          "Whether double-double runs and state transitions can use it.")
      .def_prop_ro(
          "breakpoints", [](const P& p) { return array_of(breakpoints(p)); },
          "(n,): the times at which it is not smooth, where integrate ends a step.")
      .def_prop_ro(
          "supports_switches",
          [](const P& p) {
            return std::ranges::any_of(p.parts, &AnyPerturbation::supports_switches);
          },
          "Whether it can name switching functions, at whose zeros Collocation and Adaptive "
          "end a step.")
      .def_prop_ro(
          "time_scale", time_scale,
          "A quarter of a turn of what it follows, the default of largest_step; inf where it "
          "knows none.");
  def_recipe<P>(c, [](const P& term) { return "\"" + term.name() + "\""; });
  m.def("_term_table", term_table);
  bind_term_values(m);
  bind_kind_terms(m);
  bind_registered(m);
}

}  // namespace polhode::python
