// SPDX-License-Identifier: MIT
// A Python class for each kind of [[perturbation]], from its keys: an orbit, a body or a surface
// stands where a file names one.
#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "polhode/scenario/kinds.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "polhode/text/separated.hpp"
#include "terms/term_class.hpp"

namespace polhode::python {

namespace {

// "GravityGradient" of "gravity-gradient".
std::string name_of_class(const io::PerturbationKind& kind) {
  std::string name(kind.class_name);
  if (!name.empty()) return name;
  for (const std::string_view part : io::separated(kind.name, '-')) {
    name += static_cast<char>(std::toupper(static_cast<unsigned char>(part.front())));
    name += part.substr(1);
  }
  return name;
}

constexpr const char* moving_orbits =
    "KeplerOrbit | PrecessingKeplerOrbit | TurnedKeplerOrbit | TableOrbit";
constexpr const char* other_orbits =
    " | HistoryOrbit | typing.Callable[[float], numpy.typing.ArrayLike]";
constexpr const char* fields =
    "DipoleField | numpy.typing.ArrayLike | typing.Callable[..., numpy.typing.ArrayLike]";

// What files alone have: a program gives the rows themselves, and the field as an object.
bool is_of_files(const io::PerturbationKind& kind, const io::Key& key) {
  return key.is_file || key.type == io::KeyType::unit || key.type == io::KeyType::columns ||
         (kind.in_field && key.path == "field");
}

std::vector<const io::Key*> keys_of(const io::PerturbationKind& kind) {
  std::vector<const io::Key*> all;
  for (const io::Key& key : kind.keys)
    if (!is_of_files(kind, key)) all.push_back(&key);
  return all;
}
const io::Key* key_named(const io::PerturbationKind& kind, std::string_view name) {
  const auto found = std::ranges::find(kind.keys, name, &io::Key::path);
  return found == kind.keys.end() || is_of_files(kind, *found) ? nullptr : &*found;
}

// Of its sets of keys those that a program can give.
std::vector<std::string_view> sets_of(const io::PerturbationKind& kind) {
  std::vector<std::string_view> all;
  for (const std::string_view set : io::separated(kind.sets, '|'))
    if (std::ranges::all_of(io::separated(set, '+'), [&](std::string_view name) {
          return key_named(kind, name) != nullptr;
        }))
      all.push_back(set);
  return all;
}

bool is_required(const io::PerturbationKind& kind, const io::Key& key) {
  if (key.presence == io::Presence::required) return true;
  const std::vector<std::string_view> sets = sets_of(kind);
  return sets.size() == 1 && std::ranges::count(io::separated(sets[0], '+'), key.path) > 0;
}

std::string replaced(std::string text, std::string_view old, std::string_view by) {
  if (const std::size_t place = text.find(old); place != std::string::npos)
    text.replace(place, old.size(), by);
  return text;
}

std::string dimension_text(const io::Key& key) {
  std::string text(key.dimension == io::Dimension::number ? "a number"
                                                          : io::dimension_name(key.dimension));
  if (key.range == io::Range::positive) text += ", positive";
  if (key.range == io::Range::not_negative) text += ", not negative";
  return text;
}

// "a length, positive. The radius that ..."
std::string help_of(const io::Key& key) {
  const std::string help(key.help);
  switch (key.type) {
    case io::KeyType::number:
      return dimension_text(key) + ". " + help;
    case io::KeyType::numbers:
      return (key.length == 0 ? "(n,)" : "(" + std::to_string(key.length) + ",)") + ", " +
             dimension_text(key) + " each. " + help;
    case io::KeyType::linear_map:
      return "one number, (3,) or (3, 3), " + dimension_text(key) + " each. " + help;
    case io::KeyType::matrix:
      return "(3, 3), " + dimension_text(key) + " each. " + help;
    case io::KeyType::choice: {
      std::string words;
      for (const std::string_view word : io::separated(key.allowed, '|'))
        words += (words.empty() ? "\"" : ", \"") + std::string(word) + "\"";
      return words + ". " + help;
    }
    case io::KeyType::name:
      return replaced(help, "The name of a table [orbit.NAME]", "the orbit");
    default:
      return help;
  }
}

struct TypeTexts {
  std::string taken;
  std::string shown;
};
TypeTexts types_of(const io::PerturbationKind& kind, const io::Key& key) {
  const std::string orbits = std::string(moving_orbits) + (kind.needs_velocity ? "" : other_orbits);
  switch (key.type) {
    case io::KeyType::number:
      return {"float", "float"};
    case io::KeyType::numbers:
    case io::KeyType::linear_map:
    case io::KeyType::matrix:
      return {"numpy.typing.ArrayLike", "numpy.typing.NDArray[numpy.float64]"};
    case io::KeyType::integer:
      return {"int", "int"};
    case io::KeyType::boolean:
      return {"bool", "bool"};
    case io::KeyType::choice:
    case io::KeyType::text:
      return {"str", "str"};
    case io::KeyType::name:
      return {orbits, orbits};
    default:
      throw std::logic_error("a key of a perturbation that Python has no form for: " +
                             std::string(key.path));
  }
}

// Of a key in the table that `Scenario.build` writes.
std::string sort_of(const io::Key& key) {
  if (key.type == io::KeyType::name) return "orbit";
  if (key.dimension == io::Dimension::angle) return "angle";
  return key.dimension == io::Dimension::rate ? "rate" : "number";
}

nb::object no_orbit(const std::string& name) {
  throw std::logic_error("a default that names the orbit " + name);
}

TermArgument argument_of(const io::PerturbationKind& kind, const io::Key& key,
                         std::span<const io::KeyValue> defaults) {
  TypeTexts types = types_of(kind, key);
  std::string otherwise;
  const auto value = std::ranges::find(defaults, key.path, &io::KeyValue::key);
  if (value != defaults.end()) {
    otherwise = repr_text(python_value(key, *value, no_orbit));
  } else if (!is_required(kind, key)) {
    otherwise = "None";
    types.taken += " | None";
    types.shown += " | None";
  }
  return {std::string(key.path), types.taken, help_of(key), otherwise, types.shown, sort_of(key)};
}

std::vector<TermArgument> arguments_of(const io::PerturbationKind& kind,
                                       std::span<const io::KeyValue> defaults) {
  std::vector<TermArgument> all;
  if (kind.on_surface)
    all.push_back({"surface", "Surface", "along the principal axes of the body.", "", "Surface"});
  const std::vector<const io::Key*> keys = keys_of(kind);
  for (const bool required : {true, false})
    for (const io::Key* key : keys)
      if (is_required(kind, *key) == required) all.push_back(argument_of(kind, *key, defaults));
  if (kind.in_field)
    all.push_back({"field", std::string(fields) + " | None",
                   "in place of the keys of a dipole: a DipoleField, three numbers, a constant "
                   "field along inertial axes, or a function, f(t) -> 3 numbers, f(t, x) with the "
                   "position x if an orbit is given.",
                   "None", std::string(fields) + " | None"});
  if (kind.on_body)
    all.push_back({"body", "Body | None",
                   "the one that it acts on, where the arguments do not say all; None: not needed.",
                   "None", "Body | None"});
  all.push_back(name_argument());
  return all;
}

// ---- from Python's arguments to terms

// A kind and its arguments while a term is made.
class TermMaker {
 public:
  TermMaker(const io::PerturbationKind& kind, std::span<const io::KeyValue> defaults,
            const std::vector<TermArgument>& rows, Making& at, std::span<const nb::object> given)
      : kind_(kind), defaults_(defaults), rows_(rows), at_(at), given_(given) {
    parts_.orbits = &orbits_;
    parts_.name = at.name;
  }

  MadeTerm made() {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!given_[i].is_none()) take(rows_[i], given_[i]);
    require_one_set();
    io::TermsOfProgram terms = made_terms();
    nb::list kept;
    for (std::size_t i = 0; i < rows_.size(); ++i) kept.append(kept_of(terms.uses, rows_[i], i));
    MadeTerm result{{}, nb::tuple(kept)};
    if (auto* const one = std::get_if<AnyPerturbation>(&terms.made))
      result.parts = {std::move(*one)};
    else
      result.parts = std::get<std::vector<AnyPerturbation>>(std::move(terms.made));
    return result;
  }

 private:
  // Texts of values are for messages only: they take longer than the term.
  io::TermsOfProgram made_terms() {
    try {
      return io::made_terms(kind_, values_, defaults_, parts_, at_.type);
    } catch (const DomainError&) {
      for (io::KeyValue& value : values_) value.shown = repr_text(object_of(value));
      return io::made_terms(kind_, values_, defaults_, parts_, at_.type);
    }
  }

  nb::object given(std::string_view name) const {
    const auto row = std::ranges::find(rows_, name, &TermArgument::name);
    return row == rows_.end() ? nb::none() : given_[static_cast<std::size_t>(row - rows_.begin())];
  }

  void take(const TermArgument& row, const nb::object& x) {
    if (row.name == "surface") {
      parts_.surface = &cast<Surface>(x);
    } else if (row.name == "body") {
      parts_.body = &cast<Body>(x);
    } else if (row.name == "field") {
      take_field(x);
    } else if (!row.key.empty()) {
      values_.push_back(value_of(*key_named(kind_, row.name), row.name.c_str(), x));
    }
  }

  template <class C>
  static const C& cast(nb::handle x) {
    if (!nb::isinstance<C>(x)) throw nb::next_overload();
    return nb::cast<const C&>(x);
  }

  io::KeyValue value_of(const io::Key& key, const char* name, const nb::object& x) {
    io::KeyValue value{.key = key.path};
    switch (key.type) {
      case io::KeyType::number:
        value.numbers = {number_of(x, name)};
        break;
      case io::KeyType::numbers:
        value.numbers = numbers_of(x, name, key.length);
        break;
      case io::KeyType::linear_map:
        value.numbers = map_of(x, name);
        break;
      case io::KeyType::matrix:
        value.numbers = map_of(x, name);
        if (value.numbers.size() != 9)
          throw nb::value_error((std::string(name) + ": expected the shape (3, 3)").c_str());
        break;
      case io::KeyType::integer:
        if (!PyLong_Check(x.ptr()) || !nb::try_cast(x, value.whole)) throw nb::next_overload();
        break;
      case io::KeyType::text:
        if (!nb::isinstance<nb::str>(x)) throw nb::next_overload();
        value.words = {nb::cast<std::string>(x)};
        break;
      case io::KeyType::boolean:
        if (!PyBool_Check(x.ptr())) throw nb::next_overload();
        value.whole = x.is(nb::bool_(true)) ? 1 : 0;
        break;
      case io::KeyType::choice:
        value.words = {word_of(key, name, x)};
        break;
      default:
        orbits_.push_back(orbit_value(name, x));
        value.words = {orbits_.back().name};
    }
    return value;
  }

  static double number_of(const nb::object& x, const char* name) {
    require_plain(x, name);
    try {
      return nb::cast<double>(x);
    } catch (const nb::cast_error&) {
      throw nb::next_overload();
    }
  }

  static std::vector<double> numbers_of(const nb::object& x, const char* name, int length) {
    const std::string expected =
        length == 0 ? "one dimension" : "(" + std::to_string(length) + ",)";
    const Numbers numbers(x, name);
    const Shape& shape = numbers.shape();
    if (shape.size() != 1 || shape[0] == 0 ||
        (length > 0 && shape[0] != static_cast<std::size_t>(length)))
      throw nb::value_error(
          (std::string(name) + ": got shape " + python::text_of(shape) + "; expected " + expected)
              .c_str());
    return {numbers.at(0), numbers.at(0) + shape[0]};
  }

  static std::vector<double> map_of(const nb::object& x, const char* name) {
    const Numbers numbers(x, name);
    const Shape& shape = numbers.shape();
    if (shape.empty()) return {numbers[0], numbers[0], numbers[0]};
    if (shape != Shape{3} && shape != Shape{3, 3})
      throw nb::value_error((std::string(name) + ": got shape " + python::text_of(shape) +
                             "; expected (), (3,) or (3, 3)")
                                .c_str());
    return {numbers.at(0), numbers.at(0) + size_of(shape)};
  }

  std::string word_of(const io::Key& key, const char* name, const nb::object& x) const {
    if (!nb::isinstance<nb::str>(x)) throw nb::next_overload();
    const auto word = nb::cast<std::string>(x);
    const std::vector<std::string_view> words = io::separated(key.allowed, '|');
    if (std::ranges::count(words, word) > 0) return word;
    std::string known;
    for (const std::string_view one : words) known += " " + std::string(one);
    throw nb::value_error(
        (at_.type + ": " + name + ": got " + repr_text(x) + "; expected one of" + known).c_str());
  }

  io::ScenarioOrbit orbit_value(const std::string& name, const nb::object& x) {
    const AnyPythonOrbit any = orbit_of(x, at_.label + ": " + name, at_.functions);
    return std::visit(
        [&](const auto& orbit) -> io::ScenarioOrbit {
          using O = std::remove_cvref_t<decltype(orbit)>;
          if constexpr (std::is_constructible_v<decltype(io::ScenarioOrbit::motion), const O&>) {
            io::ScenarioOrbit made{.name = name, .motion = orbit, .gm = std::nullopt};
            if constexpr (requires { orbit.gm(); }) made.gm = orbit.gm();
            return made;
          } else {
            if (kind_.needs_velocity)
              throw nb::type_error((at_.label + ": " + name + ": got " + class_name(x) +
                                    "; expected an orbit with a velocity, as KeplerOrbit")
                                       .c_str());
            return {.name = name, .motion = AnyOrbit(name, orbit), .gm = std::nullopt};
          }
        },
        any);
  }

  void add_numbers(std::string_view key, std::vector<double> numbers) {
    values_.push_back({.key = key, .numbers = std::move(numbers)});
  }

  void take_field(const nb::object& x) {
    if (nb::isinstance<DipoleField>(x)) {
      const auto& dipole = nb::cast<const DipoleField&>(x);
      const Vec3& K = dipole.strength();  // of Gauss coefficients at a radius of 1
      const PrimaryRotation& turns = dipole.primary();
      add_numbers("gauss", {K.z, K.x, K.y});
      add_numbers("reference_radius", {1.0});
      add_numbers("pole", {turns.pole.x, turns.pole.y, turns.pole.z});
      add_numbers("rotation_rate", {turns.rate});
      add_numbers("meridian", {turns.meridian});
      add_numbers("meridian_epoch", {turns.epoch});
      return;
    }
    if (PyCallable_Check(x.ptr()) == 0)
      return add_numbers("constant_field", numbers_of(x, "field", 3));
    const auto function = std::make_shared<PythonFunction>(x, at_.label + ": field");
    at_.functions.push_back(function);
    std::optional<AnyPythonOrbit> path;
    if (const nb::object orbit = given("orbit"); !orbit.is_none())
      path = orbit_of(orbit, at_.label + ": orbit", at_.functions);
    field_.emplace([function, path](double t) {
      constexpr const char* expected = "3 numbers, the field along inertial axes";
      std::optional<Vec3> place;
      if (path) place = std::visit([&](const auto& o) { return o.position(t); }, *path);
      const WithGil acquired;
      if (!place) return function->three_numbers((*function)(t), expected);
      return function->three_numbers((*function)(t, array_of(*place)), expected);
    });
    parts_.field = &*field_;
  }

  // Exactly one of "wobble_time+rate|k" is there.
  void require_one_set() const {
    const std::vector<std::string_view> sets = sets_of(kind_);
    if (sets.size() < 2) return;
    std::string got, expected;
    int whole = 0, alone = 0;
    for (const std::string_view set : sets) {
      std::string words;
      std::size_t count = 0;
      const std::vector<std::string_view> names = io::separated(set, '+');
      for (const std::string_view name : names) {
        words += (words.empty() ? "" : " with ") + std::string(name);
        if (given(name).is_none()) continue;
        got += (got.empty() ? "" : ", ") + std::string(name);
        ++count;
      }
      expected += (expected.empty() ? "" : ", ") + words;
      whole += count == names.size() ? 1 : 0;
      alone += count > 0 ? 1 : 0;
    }
    if (whole != 1 || alone != 1)
      throw nb::value_error((at_.type + ": got " + (got.empty() ? "none of them" : got) +
                             "; expected exactly one of " + expected)
                                .c_str());
  }

  nb::object object_of(const io::KeyValue& value) const {
    return python_value(*key_named(kind_, value.key), value,
                        [&](const std::string& name) { return given(name); });
  }

  nb::object kept_of(const io::TermUses& uses, const TermArgument& row, std::size_t i) const {
    if (row.name == "body") return uses.body_with_arguments ? given_[i] : nb::none();
    if (row.name == "field") return parts_.field != nullptr ? given_[i] : nb::none();
    if (row.key.empty()) return given_[i];
    for (const io::KeyValue& value : *uses.arguments)
      if (value.key == row.name) return object_of(value);
    return nb::none();
  }

  const io::PerturbationKind& kind_;
  std::span<const io::KeyValue> defaults_;
  const std::vector<TermArgument>& rows_;
  Making& at_;
  std::span<const nb::object> given_;
  std::vector<io::KeyValue> values_;
  std::vector<io::ScenarioOrbit> orbits_;
  std::optional<FieldOfTime> field_;
  io::TermParts parts_;
};

nb::tuple tuple_of_rows(const std::vector<double>& n) {
  const std::span all(n);
  return nb::make_tuple(tuple_of(all.subspan(0, 3)), tuple_of(all.subspan(3, 3)),
                        tuple_of(all.subspan(6, 3)));
}

}  // namespace

nb::object python_value(const io::Key& key, const io::KeyValue& value,
                        const std::function<nb::object(const std::string&)>& orbit) {
  switch (key.type) {
    case io::KeyType::number:
      return nb::float_(value.numbers.at(0));
    case io::KeyType::numbers:
      return tuple_of(std::span(value.numbers));
    case io::KeyType::linear_map:
    case io::KeyType::matrix:
      if (value.numbers.size() == 9) return tuple_of_rows(value.numbers);
      return tuple_of(std::span(value.numbers));
    case io::KeyType::integer:
      return nb::int_(value.whole);
    case io::KeyType::boolean:
      return nb::bool_(value.whole == 1);
    case io::KeyType::name:
      return orbit(value.words.at(0));
    default:
      return nb::str(value.words.at(0).c_str());
  }
}

namespace {

// `kind` must outlive it.
TermClass class_of(const io::PerturbationKind& kind, bool has_name = true) {
  std::vector<io::KeyValue> defaults = io::defaults_of(kind);
  std::vector<TermArgument> rows = arguments_of(kind, defaults);
  if (!has_name) rows.pop_back();
  const auto made = [&kind, rows, defaults](Making& at, std::span<const nb::object> given) {
    return TermMaker(kind, defaults, rows, at, given).made();
  };
  return {.name = name_of_class(kind),
          .kind = std::string(kind.name),
          .summary = std::string(kind.help),
          .notes = std::string(kind.equations) + (kind.equations.empty() ? "" : "\n\n") +
                   "Vectors and tensors of the body are along its principal axes.",
          .arguments = std::move(rows),
          .made = made};
}

}  // namespace

TermClass class_of_registered(io::PerturbationKind kind) {
  kind.on_body = true;         // its function may ask for it
  kind.needs_velocity = true;  // it gives its orbits to functions as objects
  for (io::Key& key : kind.keys) key.is_file = false;  // a path is an argument
  const auto& own = *new io::PerturbationKind(std::move(kind));
  return class_of(own, false);  // the function names its terms
}

void bind_kind_terms(nb::module_& m) {
  static const io::Kinds kinds = io::default_kinds();
  for (const io::PerturbationKind& kind : kinds.perturbations())
    if (kind.has_terms) add_term_class(m, class_of(kind));
}

}  // namespace polhode::python
