// SPDX-License-Identifier: MIT
// Kinds of perturbations, orbits, experiments, columns and observations that Python describes
// (python/polhode/kinds.py).
#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "interface/batch.hpp"
#include "interface/choice.hpp"
#include "interface/python_function.hpp"
#include "io/io_parts.hpp"
#include "motion/samples.hpp"
#include "motion/system_value.hpp"
#include "polhode/error.hpp"
#include "polhode/scenario/kinds.hpp"
#include "polhode/text/detail/key_form.hpp"
#include "polhode/text/separated.hpp"
#include "terms/orbit_value.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

// The keys of a kind and the texts that they and its description refer to.
struct KindTexts {
  std::deque<std::string> words;
  std::string_view sets;
  std::vector<io::Key> keys;
  std::vector<io::Citation> citations;

  std::string_view own(nb::handle text) { return words.emplace_back(nb::cast<std::string>(text)); }
};

constexpr std::array key_forms = {
    std::pair{"number", io::KeyType::number}, std::pair{"numbers", io::KeyType::numbers},
    std::pair{"matrix", io::KeyType::matrix}, std::pair{"integer", io::KeyType::integer},
    std::pair{"flag", io::KeyType::boolean},  std::pair{"text", io::KeyType::text},
    std::pair{"file", io::KeyType::text},     std::pair{"name", io::KeyType::name},
    std::pair{"word", io::KeyType::choice},
};

// True if one of the sets "times+rates|file" has the key.
bool is_in(std::string_view sets, std::string_view name) {
  for (const std::string_view set : io::separated(sets, '|'))
    if (std::ranges::count(io::separated(set, '+'), name) > 0) return true;
  return false;
}

// Reads the fields of polhode.kinds.Key, which has checked them.
io::Key key_of(nb::handle from, std::string_view sets, KindTexts& texts) {
  const auto form = nb::cast<std::string>(from.attr("form"));
  const auto known =
      std::ranges::find(key_forms, form, [](const auto& one) { return std::string(one.first); });
  const bool required = nb::cast<bool>(from.attr("required"));
  const std::string_view name = texts.own(from.attr("name"));
  const nb::handle limit = from.attr("range");
  return {.path = name,
          .type = known->second,
          .presence = required            ? io::Presence::required
                      : is_in(sets, name) ? io::Presence::alternative
                                          : io::Presence::optional,
          .dimension = nb::cast<io::Dimension>(from.attr("dimension")),
          .length = nb::cast<int>(from.attr("length")),
          .allowed = texts.own(from.attr("_allowed")),
          .fallback = texts.own(from.attr("_default_toml")),
          .example = texts.own(from.attr("_example_toml")),
          .help = texts.own(from.attr("help")),
          .is_file = form == "file",
          .range = limit.equal(nb::str("positive"))       ? io::Range::positive
                   : limit.equal(nb::str("not_negative")) ? io::Range::not_negative
                                                          : io::Range::any};
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
  const io::KeyValues* values;
  const io::TermContext* term = nullptr;
  const io::OrbitContext* orbit = nullptr;
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
  const io::KeyValues& values() const { return *table().values; }
  const io::TermContext& term() const {
    if (table().term == nullptr)
      throw nb::attribute_error(
          "only the table of a perturbation or an observation has body and orbits");
    return *table().term;
  }

  const io::Key& key(const std::string& name) const {
    for (const io::Key& key : table().texts->keys)
      if (key.path == name) return key;
    std::string known;
    for (const io::Key& key : table().texts->keys)
      known += (known.empty() ? "" : ", ") + std::string(key.path);
    throw nb::key_error(("got \"" + name + "\"; expected a key of the kind: " + known).c_str());
  }
  bool has(const std::string& name) const {
    const std::vector<io::Key>& keys = table().texts->keys;
    return std::ranges::find(keys, name, &io::Key::path) != keys.end() && values().has(name);
  }
  nb::list names() const {
    nb::list all;
    for (const io::Key& key : table().texts->keys)
      all.append(nb::str(key.path.data(), key.path.size()));
    return all;
  }

  nb::object value(const std::string& name) const {
    const io::Key& key = this->key(name);
    const io::KeyValues& at = values();
    if (!at.has(name)) return nb::none();
    switch (key.type) {
      case io::KeyType::number:
        return nb::float_(at.number(name));
      case io::KeyType::numbers:
        return nb::cast(array_of(at.numbers(name)));
      case io::KeyType::matrix:
        return nb::cast(array_of(io::detail::KeyForm<Mat3>::read(at, name)));
      case io::KeyType::integer:
        return nb::int_(at.integer(name));
      case io::KeyType::boolean:
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
    for (const io::Key& key : texts_->keys) io::detail::require_allowed(*inputs.values, key);
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
      if (has_place) throw io::ScenarioError(text);
      throw DomainError(text);
    } catch (const nb::builtin_exception& error) {
      throw DomainError(error.what());
    }
  }

 private:
  SharedFunction function_;
  std::shared_ptr<const KindTexts> texts_;
};

// The values of the keys, for the Python object of the term.
std::vector<io::KeyValue> said_of(const KindTexts& texts, const io::KeyValues& at) {
  std::vector<io::KeyValue> all;
  for (const io::Key& key : texts.keys) {
    if (!at.has(key.path)) continue;
    io::KeyValue value{.key = key.path};
    if (key.type == io::KeyType::boolean)
      value.whole = at.flag(key.path) ? 1 : 0;
    else if (key.type == io::KeyType::integer)
      value.whole = at.integer(key.path);
    else if (key.type == io::KeyType::number || key.type == io::KeyType::numbers ||
             key.type == io::KeyType::matrix)
      value.numbers = at.numbers(key.path);
    else
      value.words = {at.word(key.path)};
    all.push_back(std::move(value));
  }
  return all;
}

io::MadeTerms terms_of(const nb::object& made, const PythonFunction& function) {
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
bool take_orbit(nb::handle made, io::ScenarioOrbit& orbit) {
  if (!nb::isinstance<O>(made)) return false;
  orbit.motion = nb::cast<const O&>(made);
  return true;
}

// An orbit, or an orbit and the gravitational parameter of the attracting body.
io::ScenarioOrbit orbit_of_kind(const nb::object& made, const PythonFunction& function,
                                const std::string& kind) {
  nb::object path = made, gm = nb::none();
  if (nb::isinstance<nb::tuple>(made) && nb::len(made) == 2) {
    path = made[0];
    gm = made[1];
  }
  // no motion has a default
  const KeplerElements circle{.gm = 1.0, .pericentre = 1.0, .eccentricity = 0.0};
  io::ScenarioOrbit orbit{.motion = KeplerOrbit(circle), .gm = std::nullopt, .text = kind};
  if (!take_orbit<KeplerOrbit>(path, orbit) && !take_orbit<PrecessingKeplerOrbit>(path, orbit) &&
      !take_orbit<TurnedKeplerOrbit>(path, orbit) && !take_orbit<TableOrbit>(path, orbit))
    function.refuse(made,
                    "a KeplerOrbit, PrecessingKeplerOrbit, TurnedKeplerOrbit or TableOrbit, or "
                    "(orbit, gm)");
  if (!gm.is_none()) orbit.gm = number(gm, "gm");
  const KeplerElements* const elements = io::kepler_elements(orbit);
  if (!orbit.gm && elements != nullptr) orbit.gm = elements->gm;
  return orbit;
}

bool is_column_name(std::string_view name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name != "t" && std::ranges::all_of(name, is_plain);
}

// The numbers that a function has returned, as many as there is room for.
void read_numbers(const nb::object& returned, std::span<double> row, const PythonFunction& function,
                  const std::string& expected) {
  try {
    const Numbers numbers(returned, "");
    if (size_of(numbers.shape()) == row.size()) {
      std::copy_n(numbers.at(0), row.size(), row.begin());
      return;
    }
  } catch (const nb::builtin_exception&) {
  }
  function.refuse(returned, (counted(row.size(), "number") + expected).c_str());
}

// [(name, dimension), ...], as a list of structs with these members.
template <class Column>
std::vector<Column> columns_of(nb::handle given, const nb::object& made,
                               const PythonFunction& function) {
  std::vector<Column> columns;
  for (const nb::handle column : nb::iter(given)) {
    std::string name;
    if (!nb::isinstance<nb::sequence>(column) || nb::len(column) != 2 ||
        !nb::try_cast(nb::object(column[0]), name) || !is_column_name(name) ||
        std::ranges::count(columns, name, &Column::name) > 0)
      function.refuse(
          made,
          "columns of (name, dimension), each name of letters, digits and _, other than "
          "t, and there once");
    columns.push_back({std::move(name), choice<io::Dimension>(column[1], "dimension")});
  }
  if (columns.empty()) function.refuse(made, "at least one column");
  return columns;
}

// {"columns": [(name, dimension), ...], "formula": f(t) -> numbers}
io::CustomExperiment experiment_of(const nb::object& made, const PythonFunction& function,
                                   const io::ExperimentContext& at, std::string_view kind) {
  nb::dict parts;
  if (!nb::try_cast(made, parts) || parts.size() != 2 || !parts.contains("columns") ||
      !parts.contains("formula"))
    function.refuse(made, R"({"columns": [(name, dimension), ...], "formula": f(t) -> numbers})");
  io::CustomExperiment own{
      .kind = std::string(kind),
      .rows = at.rows(),
      .columns = columns_of<io::CustomColumn>(nb::object(parts["columns"]), made, function)};
  const auto formula = std::make_shared<PythonFunction>(nb::object(parts["formula"]),
                                                        function.label() + ": formula");
  own.formula = [formula](double t, std::span<double> row) {
    const WithGil acquired;
    read_numbers((*formula)(t), row, *formula, ", those of the columns at that time");
  };
  return own;
}

// The names of the parameters of a function that have no default, in their order.
std::vector<std::string> parameters_of(nb::handle function, const std::string& label) {
  const nb::object names =
      nb::module_::import_("polhode.kinds").attr("_parameters")(label, function);
  std::vector<std::string> all;
  for (const nb::handle name : nb::iter(names)) all.push_back(nb::cast<std::string>(name));
  return all;
}

fit::MotionFunction motion_function(const nb::object& given, const std::string& label) {
  const std::vector<std::string> inputs = parameters_of(given, label);
  for (const std::string& name : inputs)
    if (name != "t" && name != "q" && name != "omega")
      throw DomainError(label + ": got the parameter \"" + name + "\"; expected t, q or omega");
  const auto function = std::make_shared<PythonFunction>(given, label);
  return [function, inputs](double t, const Quaternion& q, const Vec3& w_F,
                            std::span<double> numbers) {
    const WithGil acquired;
    nb::list arguments;
    for (const std::string& name : inputs)
      arguments.append(name == "t"   ? nb::object(nb::float_(t))
                       : name == "q" ? nb::cast(array_of(q))
                                     : nb::cast(array_of(w_F)));
    read_numbers((*function)(*nb::tuple(arguments)), numbers, *function, ", one for each column");
  };
}

// {"columns": [(name, dimension), ...], "sigma": numbers, "function": f(...) -> numbers}
io::ObservedRows observation_of(const nb::object& made, const PythonFunction& function,
                                const io::TermContext& at) {
  nb::dict parts;
  if (!nb::try_cast(made, parts) || parts.size() != 3 || !parts.contains("columns") ||
      !parts.contains("sigma") || !parts.contains("function"))
    function.refuse(made, R"({"columns": [(name, dimension), ...], "sigma": numbers, )"
                          R"("function": f(t, q, omega) -> numbers})");
  io::MeasuredRows rows{
      .columns = columns_of<io::MeasuredColumn>(nb::object(parts["columns"]), made, function),
      .sigmas = {},
      .numbers = {}};
  const nb::object sigma = parts["sigma"];
  const Numbers sigmas(sigma, "sigma");
  for (std::size_t i = 0; i < size_of(sigmas.shape()); ++i) rows.sigmas.push_back(sigmas.at(0)[i]);
  rows.numbers = motion_function(nb::object(parts["function"]), function.label() + ": function");
  return io::observed_rows(std::move(rows), at);
}

io::Kinds with_perturbation(const io::Kinds& kinds, nb::handle kind) {
  const auto texts = texts_of(kind);
  const KindFunction function(kind, "perturbation", texts);
  return kinds.with(io::PerturbationKind{
      .name = texts->own(kind.attr("name")),
      .help = texts->own(kind.attr("help")),
      .keys = texts->keys,
      .sets = texts->sets,
      .citations = texts->citations,
      .made =
          [function, texts](const io::TermContext& at) {
            // in other axes the numbers of the file are not those of an object
            if (at.has_principal_axes()) at.note(said_of(*texts, at));
            return function.call({.texts = nullptr, .values = &at, .term = &at}, terms_of);
          },
      .on_surface = nb::cast<bool>(kind.attr("on_surface"))});
}

io::Kinds with_orbit(const io::Kinds& kinds, nb::handle kind) {
  const auto texts = texts_of(kind);
  const KindFunction function(kind, "orbit", texts);
  const std::string_view name = texts->own(kind.attr("name"));
  return kinds.with(io::OrbitKind{.name = name,
                                  .help = texts->own(kind.attr("help")),
                                  .keys = texts->keys,
                                  .sets = texts->sets,
                                  .citations = texts->citations,
                                  .made = [function, name](const io::OrbitContext& at) {
                                    return function.call(
                                        {.texts = nullptr, .values = &at, .orbit = &at},
                                        [&](const nb::object& made, const PythonFunction& by) {
                                          return orbit_of_kind(made, by, std::string(name));
                                        });
                                  }});
}

io::Kinds with_experiment(const io::Kinds& kinds, nb::handle kind) {
  const auto texts = texts_of(kind);
  const KindFunction function(kind, "experiment", texts);
  const std::string_view name = texts->own(kind.attr("name"));
  return kinds.with(io::ExperimentKind{
      .name = name,
      .help = texts->own(kind.attr("help")),
      .keys = texts->keys,
      .made =
          [function, name](const io::ExperimentContext& at) {
            return function.call({.texts = nullptr, .values = &at},
                                 [&](const nb::object& made, const PythonFunction& by) {
                                   return experiment_of(made, by, at, name);
                                 });
          },
      .citations = texts->citations});
}

io::Kinds with_observation(const io::Kinds& kinds, nb::handle kind) {
  const auto texts = texts_of(kind);
  const KindFunction function(kind, "observation", texts);
  return kinds.with(io::ObservationKind{
      .name = texts->own(kind.attr("name")),
      .help = texts->own(kind.attr("help")),
      .keys = texts->keys,
      .sets = texts->sets,
      .made =
          [function](io::Observation& of, const io::TermContext& at) {
            of.rows = function.call({.texts = nullptr, .values = &at, .term = &at},
                                    [&](const nb::object& made, const PythonFunction& by) {
                                      return observation_of(made, by, at);
                                    });
          },
      .citations = texts->citations});
}

// An argument of the function of a group of columns: numbers of another group, which are computed
// without the GIL, and the object that is made of these or of the row.
struct RowInput {
  std::function<io::ColumnNumbers(const io::RowSample&)> numbers;
  std::function<nb::object(const io::RowSample&, const io::ColumnNumbers&)> object;
};

RowInput group_input(const io::ColumnKind& group) {
  return {group.numbers,
          [width = group.columns.size()](const io::RowSample&, const io::ColumnNumbers& x) {
            return nb::cast(array_of(std::span(x).first(width)));
          }};
}
RowInput column_input(const io::ColumnKind& group, std::string_view column) {
  const auto place = static_cast<std::size_t>(
      std::ranges::find(group.columns, column, &io::GroupColumn::name) - group.columns.begin());
  return {group.numbers, [place](const io::RowSample&, const io::ColumnNumbers& x) -> nb::object {
            return nb::float_(x[place]);
          }};
}

// What a parameter of this name is given.
RowInput input_of(const std::string& name, const io::ColumnKinds& known, const std::string& shown) {
  if (name == "t")
    return {{}, [](const io::RowSample& row, const io::ColumnNumbers&) -> nb::object {
              return nb::float_(row.t);
            }};
  if (name == "state")
    return {{}, [](const io::RowSample& row, const io::ColumnNumbers&) {
              return nb::cast(Batch<RotorState>::one(row.state));
            }};
  if (name == "system")
    return {{}, [](const io::RowSample& row, const io::ColumnNumbers&) {
              return nb::cast(PythonSystem(row.system));
            }};
  const io::ColumnKind* const group = known.group(name);
  if (group != nullptr && !group->is_date) return group_input(*group);
  if (const io::ColumnKind* const owner = known.of_column(name)) return column_input(*owner, name);
  throw DomainError(shown + ": function: got the parameter \"" + name +
                    "\"; expected t, state, system, or the name of a group or a column of numbers");
}

io::ColumnNumbers called_on_row(const io::RowSample& row, const PythonFunction& function,
                                const std::vector<RowInput>& inputs, std::size_t width) {
  std::vector<io::ColumnNumbers> given(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i].numbers) given[i] = inputs[i].numbers(row);
  const WithGil acquired;
  nb::list arguments;
  for (std::size_t i = 0; i < inputs.size(); ++i) arguments.append(inputs[i].object(row, given[i]));
  io::ColumnNumbers numbers{};
  read_numbers(function(*nb::tuple(arguments)), std::span(numbers).first(width), function,
               ", one for each column");
  return numbers;
}

io::Kinds with_columns(const io::Kinds& kinds, nb::handle kind) {
  const auto texts = std::make_shared<KindTexts>();
  io::ColumnKind made{.name = texts->own(kind.attr("name")),
                      .help = texts->own(kind.attr("help")),
                      .columns = {},
                      .numbers = {}};
  for (const nb::handle column : nb::iter(kind.attr("columns")))
    made.columns.emplace_back(texts->own(column[0]), nb::cast<io::Dimension>(column[1]));
  for (const nb::handle c : nb::iter(kind.attr("citations")))
    made.citations.push_back({texts->own(c[0]), texts->own(c[1]), texts->own(c[2])});
  const std::string shown = "column group \"" + std::string(made.name) + "\"";
  std::vector<RowInput> inputs;
  for (const nb::handle input : nb::iter(kind.attr("_inputs"))) {
    const auto name = nb::cast<std::string>(input);
    inputs.push_back(input_of(name, kinds.columns(), "Kinds: " + shown));
    made.needs_energy = made.needs_energy || kinds.columns().needs_energy(name);
    made.needs_damper = made.needs_damper || kinds.columns().needs_damper(name);
  }
  made.numbers = [function = std::make_shared<PythonFunction>(kind.attr("function"), shown), inputs,
                  texts, width = made.columns.size()](const io::RowSample& row) {
    return called_on_row(row, *function, inputs, width);
  };
  return kinds.with(std::move(made));
}

// Calls the function of a group of columns once, for a free rotation: another number of numbers
// than it has columns is an error. What the function raises is not, since it may need another
// motion.
void try_columns(const io::Kinds& kinds, const std::string& name) {
  const System system(Body(1.0, 2.0, 3.0));
  const RotorState state{{0.5, 0.5, -0.5, 0.5}, {0.1, 0.7, 1.3}};
  const io::ColumnKind* const kind = kinds.columns().group(name);
  if (kind == nullptr) return;
  try {
    static_cast<void>(kind->numbers({system, energy(system, 0.0, state), 0.0, state}));
  } catch (const nb::python_error&) {
  }
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
            const std::optional<io::TimeSpan> span = of.table().orbit->run_span();
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
  nb::class_<io::Kinds>(m, "_Kinds")
      .def("with_perturbation", with_perturbation)
      .def("with_orbit", with_orbit)
      .def("with_experiment", with_experiment)
      .def("with_columns", with_columns)
      .def("with_observation", with_observation)
      .def("try_columns", try_columns)
      .def("term_class",
           [](const io::Kinds& kinds, const std::string& name) {
             return add_registered_class(class_of_registered(*kinds.perturbation(name)));
           })
      .def("column_names",
           [](const io::Kinds& kinds) { return names_list(io::column_names(kinds.columns())); })
      .def("column_group_names",
           [](const io::Kinds& kinds) {
             return names_list(io::column_group_names(kinds.columns()));
           })
      .def("schema", [](const io::Kinds& kinds) { return io::json_schema(kinds.schema()); })
      .def("template", [](const io::Kinds& kinds, const std::string& word) {
        return io::scenario_template(word, kinds.schema());
      });
  m.def("_default_kinds", [] { return io::default_kinds(); });
  // A scenario that is alive at exit and whose functions see it, as those of a script do, is a
  // cycle through C++: its end is that of the process.
  m.def("_allow_alive_at_exit", [] { nb::set_leak_warnings(false); });
}

}  // namespace polhode::python
