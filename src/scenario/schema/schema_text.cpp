// SPDX-License-Identifier: MIT
// The table of keys as a reference page and as a scenario to start from.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "polhode/error.hpp"
#include "polhode/scenario/schema.hpp"
#include "text/nearest.hpp"
#include "text/word_list.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::string_view state_table = "state";

std::string value_in_words(const Key& key) {
  const std::string what(dimension_name(key.dimension));
  const std::string each = key.dimension == Dimension::number ? "number" : what.substr(2);
  switch (key.type) {
    case KeyType::table:
      return "table";
    case KeyType::integer:
      return key.allowed.empty() ? "whole number" : "";
    case KeyType::number:
      return each == "number" ? each : what.substr(what.find(' ') + 1);
    case KeyType::numbers:
      return (key.length > 0 ? std::to_string(key.length) + " x " : "array of ") +
             what.substr(what.find(' ') + 1);
    case KeyType::matrix:
      return "3 x 3 x " + what.substr(what.find(' ') + 1);
    case KeyType::linear_map:
      return "3 x " + what.substr(what.find(' ') + 1) + ", or 3 x 3";
    case KeyType::boolean:
      return "`true`, `false`";
    case KeyType::text:
      return "text";
    case KeyType::name:
      return "name";
    case KeyType::unit:
      return "unit";
    case KeyType::choice:
      return "";
    case KeyType::choices:
      return "array of ";
    case KeyType::columns:
      return "array of names or numbers of columns";
    case KeyType::units:
      return "array of units";
    case KeyType::epoch:
      return "date and scale";
  }
  return {};
}

std::string value_cell(const Key& key) {
  std::string cell = value_in_words(key);
  const bool quoted = key.type == KeyType::choice || key.type == KeyType::choices;
  if (key.range == Range::positive) cell += ", positive";
  if (key.range == Range::not_negative) cell += ", not negative";
  bool first = true;
  for (const std::string_view word : separated(key.allowed, '|')) {
    if (!first) cell += ", ";
    first = false;
    cell += quoted ? "`\"" + std::string(word) + "\"`" : "`" + std::string(word) + "`";
  }
  return cell;
}

std::string default_cell(const Schema& schema, const Key& key) {
  if (key.presence == Presence::required) return "required";
  if (!key.needed_by.empty())
    return "required with " + detail::one_of(separated(key.needed_by, '|'), "`");
  if (key.presence == Presence::optional)
    return key.fallback.empty() || key.fallback == "{}" ? ""
                                                        : "`" + std::string(key.fallback) + "`";
  for (const Alternatives& row : schema.alternatives) {
    if (row.table != key_table(key.path)) continue;
    for (const std::string_view set : separated(row.sets, '|')) {
      const std::vector<std::string_view> names = separated(set, '+');
      if (std::find(names.begin(), names.end(), key_name(key.path)) != names.end()) return "one of";
    }
  }
  return "";
}

std::string set_in_words(std::string_view sets) {
  std::string words;
  const std::vector<std::string_view> list = separated(sets, '|');
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i > 0) words += i + 1 == list.size() ? " or " : ", ";
    const std::vector<std::string_view> names = separated(list[i], '+');
    for (std::size_t j = 0; j < names.size(); ++j)
      words += (j > 0 ? " with `" : "`") + std::string(names[j]) + "`";
  }
  return words;
}

// "With kind `a` or `b`: ".
std::string kinds_in_words(const Key& key) {
  if (key.kinds.empty()) return "";
  return "With kind " + detail::one_of(separated(key.kinds, '|'), "`") + ": ";
}

std::string heading(const Key* table) {
  if (table == nullptr) return "## Top of the file\n\n";
  std::string path;
  for (const char c : table->path)
    if (c != '[' && c != ']') path += c;
  const bool array = table->path.ends_with("[]");
  return "## `" + std::string(array ? "[[" : "[") + path + (array ? "]]" : "]") + "`\n\n" +
         std::string(table->help) + "\n\n";
}

// What each kind of the table is.
void append_kinds(std::string& page, const Schema& schema, std::string_view table) {
  bool any = false;
  for (const KindText& one : schema.kinds) {
    if (one.table != table) continue;
    page += "- `\"" + std::string(one.kind) + "\"`: " + std::string(one.text) + "\n";
    any = true;
  }
  if (any) page += "\n";
}

void append_section(std::string& page, const Schema& schema, const Key* table) {
  const std::string_view path = table == nullptr ? std::string_view() : table->path;
  page += heading(table);
  for (const Alternatives& row : schema.alternatives)
    if (row.table == path)
      page += (row.kinds.empty()
                   ? "Exactly"
                   : "With kind " + detail::one_of(separated(row.kinds, '|'), "`") + " exactly") +
              std::string(" one of: ") + set_in_words(row.sets) + ".\n\n";
  append_kinds(page, schema, path);
  page += "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const Key* key : keys_of(schema, path))
    page += "| `" + std::string(key_name(key->path)) + "` | " + value_cell(*key) + " | " +
            default_cell(schema, *key) + " | " + kinds_in_words(*key) + std::string(key->help) +
            " |\n";
  page += "\n";
}

void append_comment(std::string& page, std::string_view text) {
  constexpr std::size_t width = 96;
  while (text.size() > width) {
    const std::size_t end = text.rfind(' ', width);
    if (end == std::string_view::npos) break;
    page += "# " + std::string(text.substr(0, end)) + "\n";
    text.remove_prefix(end + 1);
  }
  page += "# " + std::string(text) + "\n";
}

// The keys of the first set of each row of alternatives stand; the others are shown as comments,
// and so is the epoch, with what belongs to it: a date that is not the user's own must not slip
// into their files.
bool stands(const Schema& schema, const Key& key, std::string_view kind) {
  if (key.type == KeyType::epoch || key.path == "state.dut1") return false;
  if (key.presence != Presence::alternative) return true;
  const std::string_view name = key_name(key.path);
  for (const Alternatives& row : schema.alternatives) {
    if (row.table != key_table(key.path) || !belongs(row, kind)) continue;
    const std::vector<std::string_view> names = separated(separated(row.sets, '|').front(), '+');
    if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  }
  return false;
}

std::string in_quotes(std::string_view word) { return '"' + std::string(word) + '"'; }

// What a key without an example is given: something that it takes.
std::string stand_in(const Key& key) {
  const std::string word(separated(key.allowed, '|').empty() ? std::string_view()
                                                             : separated(key.allowed, '|').front());
  std::string numbers = "1";
  for (int i = 1; i < key.length; ++i) numbers += ", 1";
  switch (key.type) {
    case KeyType::table:
      return "{}";
    case KeyType::number:
      return "1";
    case KeyType::integer:
      return word.empty() ? "1" : word;
    case KeyType::numbers:
      return "[" + numbers + "]";
    case KeyType::matrix:
      return "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
    case KeyType::linear_map:
      return "[1, 1, 1]";
    case KeyType::boolean:
      return "false";
    case KeyType::text:
    case KeyType::name:
      return in_quotes(key_name(key.path));
    case KeyType::unit:
      return in_quotes("s");
    case KeyType::choice:
      return in_quotes(word);
    case KeyType::choices:
      return "[" + in_quotes(word) + "]";
    case KeyType::columns:
      return "[1]";
    case KeyType::units:
      return "[\"1\"]";
    case KeyType::epoch:
      return in_quotes("2000-01-01T12:00:00 TT");
  }
  return {};
}

// A table below [state.CHART] is written in one line: pole = { longitude = 250, latitude = -75 }
std::string example_value(const Schema& schema, const Key& key) {
  if (!key.example.empty()) return std::string(key.example);
  if (key.type != KeyType::table)
    return key.fallback.empty() ? stand_in(key) : std::string(key.fallback);
  std::string inline_table;
  for (const Key* part : keys_of(schema, key.path))
    if (stands(schema, *part, {}))
      inline_table += (inline_table.empty() ? "{ " : ", ") + std::string(key_name(part->path)) +
                      " = " + example_value(schema, *part);
  return inline_table + " }";
}

// What a template is made for: a chart, a kind of perturbation, or an experiment from outside.
struct Subject {
  std::string_view chart;
  std::string_view perturbation;  // empty: free rotation
  std::string_view experiment = "rotation";
  std::string_view orbit = {};  // the kind of its orbits, where an experiment has one
};

// Of an experiment that goes round one: the kind of it that needs no file.
std::string_view orbit_of(std::string_view experiment) {
  return experiment == "obliquity" ? "shipped" : std::string_view();
}

bool is_rotation(const Subject& subject) { return subject.experiment == "rotation"; }

// The words of the key `kind` that have a table of their own.
std::vector<std::string_view> own_experiments(const Schema& schema) {
  std::vector<std::string_view> names;
  for (const KindText& one : schema.kinds)
    if (one.table.empty()) names.push_back(one.kind);
  return names;
}

constexpr std::string_view perturbation_table = "perturbation[]";
constexpr std::string_view planet_table = "planet";
constexpr std::string_view orbit_table = "orbit.*";
constexpr std::string_view surface_table = "surface[]";
constexpr std::string_view motion_tables[] = {"frame",     "orbit",  "perturbation[]",
                                              "surface[]", "method", "event[]"};

bool is_motion(std::string_view table) {
  const std::string_view first = table.substr(0, table.find('.'));
  return std::find(std::begin(motion_tables), std::end(motion_tables), first) !=
         std::end(motion_tables);
}

std::vector<std::string_view> perturbation_kinds(const Schema& schema) {
  for (const Key* key : keys_of(schema, perturbation_table))
    if (key_name(key->path) == "kind") return separated(key->allowed, '|');
  return {};
}

std::string_view without_quotes(std::string_view text) { return text.substr(1, text.size() - 2); }

// Whether a key of a table of this kind has a line that is no comment.
bool is_shown(const Schema& schema, const Key& key, std::string_view kind) {
  const std::string_view path = key_table(key.path);
  const bool may_be_left_out =
      key.presence == Presence::optional && !is_required(key, kind) && !key.in_template;
  return stands(schema, key, kind) &&
         !((is_motion(path) || path == "body" || path == planet_table) && may_be_left_out);
}

// The orbits that the examples of a kind name, each once.
std::vector<std::string> example_orbits(const Schema& schema, std::string_view kind) {
  std::vector<std::string> names;
  if (kind.empty()) return names;
  for (const Key* key : keys_of(schema, perturbation_table)) {
    if (key->type != KeyType::name || !belongs(*key, kind) || !is_shown(schema, *key, kind))
      continue;
    const std::string value = example_value(schema, *key);
    const std::string name(without_quotes(value));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

bool needs_surface(const Schema& schema, std::string_view kind) {
  return std::any_of(schema.kinds.begin(), schema.kinds.end(), [&](const KindText& one) {
    return one.table == perturbation_table && one.kind == kind && one.on_surface;
  });
}

// What a word of the key `kind` stands for; empty where nothing is said of it.
std::string_view kind_text(const Schema& schema, std::string_view table, std::string_view kind) {
  for (const KindText& one : schema.kinds)
    if (one.table == table && one.kind == kind) return one.text;
  return {};
}

// The unit of an example: of "1 km", or of { value = 1, unit = "km" }; empty of a bare number.
std::string unit_of(const Schema& schema, const Key& key) {
  const std::string value = example_value(schema, key);
  constexpr std::string_view unit = "unit = \"";
  const std::size_t at = value.find(unit);
  if (at != std::string::npos)
    return value.substr(at + unit.size(), value.find('"', at + unit.size()) - at - unit.size());
  return value.front() == '"' ? quantity_from_text(without_quotes(value)).unit : "";
}

// Whether a key is one of air, light, magnets and matter, or its example has a unit that moments
// without one cannot give.
bool needs_mass(const Schema& schema, const Key& key) {
  constexpr Dimension of_matter[] = {Dimension::density, Dimension::pressure,
                                     Dimension::magnetic_field};
  if (std::find(std::begin(of_matter), std::end(of_matter), key.dimension) != std::end(of_matter))
    return true;
  if (key.dimension == Dimension::number || key.type == KeyType::unit) return false;
  const std::string unit = unit_of(schema, key);
  try {
    if (!unit.empty()) Units("h", "deg", "1", "km").to_core(1.0, unit, key.dimension);
    return false;
  } catch (const DomainError&) {
    return true;
  }
}

bool is_physical(const Schema& schema, std::string_view kind) {
  const std::vector<const Key*> keys = keys_of(schema, perturbation_table);
  return !kind.empty() && std::any_of(keys.begin(), keys.end(), [&](const Key* key) {
    return !key->kinds.empty() && belongs(*key, kind) && is_shown(schema, *key, kind) &&
           needs_mass(schema, *key);
  });
}

// Whether a table has lines of its own in the template of this subject.
bool is_section(const Schema& schema, const Key& key, const Subject& subject) {
  if (key.type != KeyType::table) return false;
  if (!is_rotation(subject)) {
    const bool is_own = key_table(key.path).empty() && key.presence == Presence::required &&
                        belongs(key, subject.experiment);
    return is_own || key.path == "units" || key.path == "time" ||
           (key.path == orbit_table && !subject.orbit.empty());
  }
  if (!belongs(key, subject.experiment)) return false;
  if (key_table(key.path) == state_table) return key_name(key.path) == subject.chart;
  if (key.path == surface_table) return needs_surface(schema, subject.perturbation);
  if (key.path == orbit_table) return !example_orbits(schema, subject.perturbation).empty();
  if (!key_table(key.path).empty() || key.path == key_table(orbit_table) || key.path == "frame" ||
      key.path == "map")
    return false;
  return !is_motion(key.path) || !subject.perturbation.empty();
}

std::string section_name(std::string_view path, std::string_view orbit) {
  if (path == orbit_table) return "[orbit." + std::string(orbit) + "]";
  if (path.ends_with("[]")) return "[[" + std::string(key_name(path)) + "]]";
  return "[" + std::string(path) + "]";
}

// `orbit` is the name of an orbit, where that is the table.
void append_example(std::string& page, const Schema& schema, const Key* table,
                    const Subject& subject, std::string_view orbit = {}) {
  const std::string_view path = table == nullptr ? std::string_view() : table->path;
  if (table != nullptr) {
    page += "\n";
    append_comment(page, table->help);
    page += section_name(path, orbit) + "\n";
  }
  std::string_view kind;
  const bool physical = is_physical(schema, subject.perturbation);
  for (const Key* key : keys_of(schema, path)) {
    // [output.aem] names an object: what is not the user's own must not slip into their files
    const bool table_line =
        key->type == KeyType::table &&
        (table == nullptr || is_motion(path) || path == state_table || path == "output");
    if (table_line || !belongs(*key, kind)) continue;
    std::string value = example_value(schema, *key);
    if (is_motion(path) && key_name(key->path) == "kind") {
      kind = path == perturbation_table                      ? subject.perturbation
             : path == orbit_table && !subject.orbit.empty() ? subject.orbit
                                                             : without_quotes(key->example);
      value = '"' + std::string(kind) + '"';
    }
    if (key->path == "kind") {
      kind = subject.experiment;
      value = '"' + std::string(kind) + '"';
    }
    if (physical && key->path == "units.time") value = "\"s\"";
    if (!subject.orbit.empty() && key->path == "units.time") value = "\"kyr\"";
    if (physical && key->path == "units.moment") value = "\"kg m2\"";
    const std::string_view text =
        key_name(key->path) == "kind" ? kind_text(schema, path, kind) : std::string_view();
    append_comment(page, text.empty() ? key->help : text);
    const bool is_needed = key_name(key->path) == "kind" && !subject.orbit.empty();
    page += (is_needed || is_shown(schema, *key, kind) ? "" : "# ") +
            std::string(key_name(key->path)) + " = " + value + "\n";
  }
}

}  // namespace

std::string markdown_reference(const Schema& schema) {
  std::string page;
  append_section(page, schema, nullptr);
  for (const Key& key : schema.keys)
    if (key.type == KeyType::table) append_section(page, schema, &key);
  return page;
}

std::string markdown_units() {
  std::string page = "| unit | what it is | in others |\n|---|---|---|\n";
  for (const KnownUnit& unit : known_units()) {
    const std::string base = unit.base.empty() ? "" : "`" + std::string(unit.base) + "`";
    std::string factor = unit.factor == 1.0 ? "" : fmt::format("{:.12g} ", unit.factor);
    if (unit.base == "rad")
      factor =
          unit.factor > 1.0 ? "2 pi " : fmt::format("pi/{:.0f} ", std::numbers::pi / unit.factor);
    page += "| `" + std::string(unit.symbol) + "` | " + std::string(unit.name) + " | " + factor +
            base + " |\n";
  }
  return page;
}

std::vector<std::string_view> state_charts(const Schema& schema) {
  std::vector<std::string_view> charts;
  for (const Key* key : keys_of(schema, state_table))
    if (key->type == KeyType::table) charts.push_back(key_name(key->path));
  return charts;
}

std::vector<std::string_view> scenario_templates(const Schema& schema) {
  std::vector<std::string_view> names = state_charts(schema);
  for (const std::string_view kind : perturbation_kinds(schema)) names.push_back(kind);
  for (const std::string_view kind : own_experiments(schema)) names.push_back(kind);
  return names;
}

std::string scenario_template(std::string_view name, const Schema& schema,
                              std::string_view program) {
  const std::vector<std::string_view> names = scenario_templates(schema),
                                      charts = state_charts(schema);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    const std::string_view near = detail::nearest(name, names);
    throw DomainError("chart: got \"" + std::string(name) + "\"; expected " +
                      detail::one_of(names) +
                      (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
  }
  const auto is_one_of = [&](const std::vector<std::string_view>& all) {
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  const Subject subject = is_one_of(charts) ? Subject{name, {}}
                          : is_one_of(own_experiments(schema))
                              ? Subject{{}, {}, name, orbit_of(name)}
                              : Subject{"attitude-rate", name};
  const bool is_ours = program == "polhode";
  std::string page =
      "# A scenario for " + std::string(program) + ". Every key: " +
      (is_ours ? "docs/reference/scenario.md" : std::string(program) + " schema keys") + "\n";
  append_example(page, schema, nullptr, subject);
  for (const Key& key : schema.keys) {
    if (!is_section(schema, key, subject)) continue;
    if (key.path != orbit_table) append_example(page, schema, &key, subject);
    if (key.path == orbit_table && !subject.orbit.empty())
      append_example(page, schema, &key, subject, "mars");
    for (const std::string& orbit : example_orbits(schema, subject.perturbation))
      if (key.path == orbit_table) append_example(page, schema, &key, subject, orbit);
  }
  return page;
}

}  // namespace v0
}  // namespace polhode
