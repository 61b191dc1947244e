// SPDX-License-Identifier: MIT
// Kinds of perturbations, orbits and experiments that Python describes (python/polhode/kinds.py).
#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "interface/choice.hpp"
#include "interface/python_function.hpp"
#include "io/io_parts.hpp"
#include "polhode/error.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/text/detail/key_form.hpp"
#include "polhode/text/separated.hpp"
#include "terms/orbit_value.hpp"
#include "terms/term_value.hpp"

namespace polhode::python {

namespace {

// The keys of a kind and the texts that they and its description refer to.
struct KindTexts {
  std::deque<std::string> words;
  std::string_view sets;
  std::vector<Key> keys;
  std::vector<Citation> citations;

  std::string_view own(nb::handle text) { return words.emplace_back(nb::cast<std::string>(text)); }
};

constexpr std::array key_forms = {
    std::pair{"number", KeyType::number}, std::pair{"numbers", KeyType::numbers},
    std::pair{"matrix", KeyType::matrix}, std::pair{"integer", KeyType::integer},
    std::pair{"flag", KeyType::boolean},  std::pair{"text", KeyType::text},
    std::pair{"file", KeyType::text},     std::pair{"name", KeyType::name},
    std::pair{"word", KeyType::choice},
};

// True if one of the sets "times+rates|file" has the key.
bool is_in(std::string_view sets, std::string_view name) {
  for (const std::string_view set : separated(sets, '|'))
    if (std::ranges::count(separated(set, '+'), name) > 0) return true;
  return false;
}

// Reads the fields of polhode.kinds.Key, which has checked them.
Key key_of(nb::handle from, std::string_view sets, KindTexts& texts) {
  const auto form = nb::cast<std::string>(from.attr("form"));
  const auto known =
      std::ranges::find(key_forms, form, [](const auto& one) { return std::string(one.first); });
  const bool required = nb::cast<bool>(from.attr("required"));
  const std::string_view name = texts.own(from.attr("name"));
  const nb::handle limit = from.attr("range");
  return {.path = name,
          .type = known->second,
          .presence = required            ? Presence::required
                      : is_in(sets, name) ? Presence::alternative
                                          : Presence::optional,
          .dimension = nb::cast<Dimension>(from.attr("dimension")),
          .length = nb::cast<int>(from.attr("length")),
          .allowed = texts.own(from.attr("_allowed")),
          .fallback = texts.own(from.attr("_default_toml")),
          .example = texts.own(from.attr("_example_toml")),
          .help = texts.own(from.attr("help")),
          .is_file = form == "file",
          .range = limit.equal(nb::str("positive"))       ? Range::positive
                   : limit.equal(nb::str("not_negative")) ? Range::not_negative
                                                          : Range::any};
}

std::shared_ptr<KindTexts> texts_of(nb::handle kind) {
  auto texts = std::make_shared<KindTexts>();
  texts->sets = texts->own(kind.attr("sets"));
  for (const nb::handle key : nb::iter(kind.attr("keys")))
    texts->keys.push_back(key_of(key, texts->sets, *texts));
  for (const nb::handle c : nb::iter(kind.attr("citations")))
    texts->citations.push_back({texts->own(c[0]), texts->own(c[1]), texts->own(c[2])});
  return texts;
}

// Inputs of the function of a kind: the values of its table and the context. Null after the call.
struct KindInputs {
  const KindTexts* texts;
  const KeyValues* values;
  const TermContext* term = nullptr;
  const OrbitContext* orbit = nullptr;
};

class KindTable {
 public:
  explicit KindTable(std::shared_ptr<const KindInputs*> table) : table_(std::move(table)) {}

  const KindInputs& table() const {
    if (*table_ == nullptr)
      throw nb::value_error(
          "the table of a kind can be read only while its function makes the thing: expected "
          "variables of yours for what is needed later");
    return **table_;
  }
  const KeyValues& values() const { return *table().values; }
  const TermContext& term() const {
    if (table().term == nullptr)
      throw nb::attribute_error("only the table of a perturbation has body and orbits");
    return *table().term;
  }

  const Key& key(const std::string& name) const {
    for (const Key& key : table().texts->keys)
      if (key.path == name) return key;
    std::string known;
    for (const Key& key : table().texts->keys)
      known += (known.empty() ? "" : ", ") + std::string(key.path);
    throw nb::key_error(("got \"" + name + "\"; expected a key of the kind: " + known).c_str());
  }
  bool has(const std::string& name) const {
    const std::vector<Key>& keys = table().texts->keys;
    return std::ranges::find(keys, name, &Key::path) != keys.end() && values().has(name);
  }
  nb::list names() const {
    nb::list all;
    for (const Key& key : table().texts->keys)
      all.append(nb::str(key.path.data(), key.path.size()));
    return all;
  }

  nb::object value(const std::string& name) const {
    const Key& key = this->key(name);
    const KeyValues& at = values();
    if (!at.has(name)) return nb::none();
    switch (key.type) {
      case KeyType::number:
        return nb::float_(at.number(name));
      case KeyType::numbers:
        return nb::cast(array_of(at.numbers(name)));
      case KeyType::matrix:
        return nb::cast(array_of(polhode::detail::KeyForm<Mat3>::read(at, name)));
      case KeyType::integer:
        return nb::int_(at.integer(name));
      case KeyType::boolean:
        return nb::bool_(at.flag(name));
      default:
        return nb::cast(key.is_file ? at.file_at(name) : at.word(name));
    }
  }

 private:
  std::shared_ptr<const KindInputs*> table_;
};

// The function of a kind. A ValueError becomes an error of the file, and so does a result of
// another type than expected.
class KindFunction {
 public:
  KindFunction(nb::handle kind, const char* sort, std::shared_ptr<const KindTexts> texts)
      : function_(std::make_shared<PythonFunction>(
            kind.attr("made"),
            std::string(sort) + " \"" + nb::cast<std::string>(kind.attr("name")) + "\"")),
        texts_(std::move(texts)) {}

  // Applies `convert` to the returned object.
  template <class Convert>
  auto call(KindInputs inputs, const Convert& convert) const {
    const WithGil acquired;
    inputs.texts = texts_.get();
    for (const Key& key : texts_->keys) polhode::detail::require_allowed(*inputs.values, key);
    const auto shared = std::make_shared<const KindInputs*>(&inputs);
    struct ClearOnExit {
      const KindInputs*& inputs;
      ~ClearOnExit() { inputs = nullptr; }
    } clear{*shared};
    try {
      return convert((*function_)(KindTable(shared)), *function_);
    } catch (nb::python_error& error) {
      const nb::object core = nb::module_::import_("polhode._core");
      const bool has_place = error.matches(core.attr("ScenarioError"));
      if (!has_place && !error.matches(PyExc_ValueError)) throw;
      const auto text = nb::cast<std::string>(nb::str(error.value()));
      if (has_place) throw ScenarioError(text);
      throw DomainError(text);
    } catch (const nb::builtin_exception& error) {
      throw DomainError(error.what());
    }
  }

 private:
  SharedFunction function_;
  std::shared_ptr<const KindTexts> texts_;
};

MadeTerms terms_of(const nb::object& made, const PythonFunction& function) {
  if (nb::isinstance<PythonTerm>(made)) return nb::cast<const PythonTerm&>(made).parts;
  std::vector<AnyPerturbation> terms;
  const bool several = nb::isinstance<nb::list>(made) || nb::isinstance<nb::tuple>(made);
  if (several)
    for (const nb::handle one : nb::iter(made)) {
      if (!nb::isinstance<PythonTerm>(one)) function.refuse(made, "a term or a list of terms");
      const std::vector<AnyPerturbation>& parts = nb::cast<const PythonTerm&>(one).parts;
      terms.insert(terms.end(), parts.begin(), parts.end());
    }
  if (terms.empty()) function.refuse(made, "a term or a list of terms");
  return terms;
}

template <class O>
bool take_orbit(nb::handle made, ScenarioOrbit& orbit) {
  if (!nb::isinstance<O>(made)) return false;
  orbit.motion = nb::cast<const O&>(made);
  return true;
}

// An orbit, or an orbit and the gravitational parameter of the attracting body.
ScenarioOrbit orbit_of_kind(const nb::object& made, const PythonFunction& function,
                            const std::string& kind) {
  nb::object path = made, gm = nb::none();
  if (nb::isinstance<nb::tuple>(made) && nb::len(made) == 2) {
    path = made[0];
    gm = made[1];
  }
  // no motion has a default
  const KeplerElements circle{.gm = 1.0, .pericentre = 1.0, .eccentricity = 0.0};
  ScenarioOrbit orbit{.motion = KeplerOrbit(circle), .gm = std::nullopt, .text = kind};
  if (!take_orbit<KeplerOrbit>(path, orbit) && !take_orbit<PrecessingKeplerOrbit>(path, orbit) &&
      !take_orbit<TurnedKeplerOrbit>(path, orbit) && !take_orbit<TableOrbit>(path, orbit))
    function.refuse(made,
                    "a KeplerOrbit, PrecessingKeplerOrbit, TurnedKeplerOrbit or TableOrbit, or "
                    "(orbit, gm)");
  if (!gm.is_none()) orbit.gm = number(gm, "gm");
  const KeplerElements* const elements = kepler_elements(orbit);
  if (!orbit.gm && elements != nullptr) orbit.gm = elements->gm;
  return orbit;
}

bool is_column_name(std::string_view name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name != "t" && std::ranges::all_of(name, is_plain);
}

// {"columns": [(name, dimension), ...], "formula": f(t) -> numbers}
CustomExperiment experiment_of(const nb::object& made, const PythonFunction& function,
                               const ExperimentContext& at, std::string_view kind) {
  nb::dict parts;
  if (!nb::try_cast(made, parts) || parts.size() != 2 || !parts.contains("columns") ||
      !parts.contains("formula"))
    function.refuse(made, R"({"columns": [(name, dimension), ...], "formula": f(t) -> numbers})");
  CustomExperiment own{.kind = std::string(kind), .rows = at.rows(), .columns = {}};
  for (const nb::handle column : nb::iter(parts["columns"])) {
    std::string name;
    if (!nb::isinstance<nb::sequence>(column) || nb::len(column) != 2 ||
        !nb::try_cast(nb::object(column[0]), name) || !is_column_name(name) ||
        std::ranges::count(own.columns, name, &CustomColumn::name) > 0)
      function.refuse(
          made,
          "columns of (name, dimension), each name of letters, digits and _, other than "
          "t, and there once");
    own.columns.push_back({std::move(name), choice<Dimension>(column[1], "dimension")});
  }
  if (own.columns.empty()) function.refuse(made, "at least one column");
  const auto formula = std::make_shared<PythonFunction>(nb::object(parts["formula"]),
                                                        function.label() + ": formula");
  own.formula = [formula](double t, std::span<double> row) {
    const WithGil acquired;
    const nb::object returned = (*formula)(t);
    const std::string expected =
        std::to_string(row.size()) + " numbers, those of the columns at that time";
    try {
      const Numbers numbers(returned, "");
      if (size_of(numbers.shape()) == row.size()) {
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = numbers.at(0)[k];
        return;
      }
    } catch (const nb::builtin_exception&) {
    }
    formula->refuse(returned, expected.c_str());
  };
  return own;
}

Kinds with_perturbation(const Kinds& kinds, nb::handle kind) {
  const auto texts = texts_of(kind);
  const KindFunction function(kind, "perturbation", texts);
  return kinds.with(PerturbationKind{
      .name = texts->own(kind.attr("name")),
      .help = texts->own(kind.attr("help")),
      .keys = texts->keys,
      .sets = texts->sets,
      .citations = texts->citations,
      .made =
          [function](const TermContext& at) {
            return function.call({.texts = nullptr, .values = &at, .term = &at}, terms_of);
          },
      .on_surface = nb::cast<bool>(kind.attr("on_surface"))});
}

Kinds with_orbit(const Kinds& kinds, nb::handle kind) {
  const auto texts = texts_of(kind);
  const KindFunction function(kind, "orbit", texts);
  const std::string_view name = texts->own(kind.attr("name"));
  return kinds.with(OrbitKind{.name = name,
                              .help = texts->own(kind.attr("help")),
                              .keys = texts->keys,
                              .sets = texts->sets,
                              .citations = texts->citations,
                              .made = [function, name](const OrbitContext& at) {
                                return function.call(
                                    {.texts = nullptr, .values = &at, .orbit = &at},
                                    [&](const nb::object& made, const PythonFunction& by) {
                                      return orbit_of_kind(made, by, std::string(name));
                                    });
                              }});
}

Kinds with_experiment(const Kinds& kinds, nb::handle kind) {
  const auto texts = texts_of(kind);
  const KindFunction function(kind, "experiment", texts);
  const std::string_view name = texts->own(kind.attr("name"));
  return kinds.with(ExperimentKind{.name = name,
                                   .help = texts->own(kind.attr("help")),
                                   .keys = texts->keys,
                                   .made =
                                       [function, name](const ExperimentContext& at) {
                                         return function.call(
                                             {.texts = nullptr, .values = &at},
                                             [&](const nb::object& made, const PythonFunction& by) {
                                               return experiment_of(made, by, at, name);
                                             });
                                       },
                                   .citations = texts->citations});
}

void bind_table(nb::module_& m) {
  nb::class_<KindTable>(m, "KindTable",
                        R"(The values of one table of a scenario, given to the function of a kind.

table["limit"] is the value of a key, in core units: a float, an array, an int, a bool or a str;
None if the key is left out and has no default. A file is given by its path.)")
      .def("__getitem__", &KindTable::value, "key"_a)
      .def("__contains__", &KindTable::has, "key"_a)
      .def("keys", &KindTable::names)
      .def("__iter__", [](const KindTable& of) { return nb::iter(of.names()); })
      .def_prop_ro(
          "units", [](const KindTable& of) { return of.values().units(); },
          "The units of the file.")
      .def_prop_ro(
          "body", [](const KindTable& of) { return of.term().body(); },
          "The body; of a perturbation.")
      .def(
          "principal",
          [](const KindTable& of, const ArrayLike& x) {
            return array_of(of.term().principal(vec3(x, "x")));
          },
          "x"_a, "A vector (3,) along the body axes of the file, along the principal axes.")
      .def_prop_ro(
          "surface", [](const KindTable& of) { return of.term().surface(); },
          "What the tables [[surface]] describe, along the principal axes; ScenarioError if there "
          "are none.")
      .def(
          "orbit",
          [](const KindTable& of, const std::string& key) {
            return orbit_object(of.term().orbit(of.key(key).path));
          },
          "key"_a, "The orbit that the key names; ScenarioError if the file has no such orbit.")
      .def(
          "gm",
          [](const KindTable& of, const std::string& key, const std::string& orbit) {
            return of.term().gm(of.key(key).path, of.key(orbit).path);
          },
          "key"_a, "orbit"_a,
          "The gravitational parameter that a key gives, or that of the orbit that another names.")
      .def_prop_ro(
          "span", [](const KindTable& of) -> Typed<"tuple[float, float] | None"> {
            if (of.table().orbit == nullptr)
              throw nb::attribute_error("only the table of an orbit has a span");
            const std::optional<TimeSpan> span = of.table().orbit->run_span();
            if (!span) return Typed<"tuple[float, float] | None">(nb::none());
            return Typed<"tuple[float, float] | None">(nb::make_tuple(span->first, span->last));
          },
          "The first and the last time of the run, t = 0 included; None without [time]. Of an "
          "orbit.")
      .def(
          "refuse",
          [](const KindTable& of, const std::string& key, const std::string& message) {
            of.values().refuse(of.key(key).path, message);
          },
          "key"_a, "message"_a,
          "Raises a ScenarioError at the place of the key: \"expected ...\".");
}

}  // namespace

void bind_kinds(nb::module_& m) {
  bind_table(m);
  nb::class_<Kinds>(m, "_Kinds")
      .def("with_perturbation", with_perturbation)
      .def("with_orbit", with_orbit)
      .def("with_experiment", with_experiment)
      .def("schema", [](const Kinds& kinds) { return json_schema(kinds.schema()); })
      .def("template", [](const Kinds& kinds, const std::string& word) {
        return scenario_template(word, kinds.schema());
      });
  m.def("_default_kinds", [] { return default_kinds(); });
  // A scenario that is alive at exit and whose functions see it, as those of a script do, is a
  // cycle through C++: its end is that of the process.
  m.def("_allow_alive_at_exit", [] { nb::set_leak_warnings(false); });
}

}  // namespace polhode::python
