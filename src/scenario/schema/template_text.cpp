// SPDX-License-Identifier: MIT
// The text of a scenario to start from.
#include "scenario/detail/template_text.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::frame_table;
using detail::kinds_of;
using detail::method_table;
using detail::observation_table;
using detail::orbit_table;
using detail::output_table;
using detail::perturbation_table;
using detail::state_table;
using detail::TemplateSubject;
using detail::text_of;

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
  if (key.type == KeyType::epoch || key.path == "state.dut1" || key.path == "time.error")
    return false;
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
    case KeyType::square:
      return "[[1]]";
    case KeyType::key_list:
      return "[\"body.moments[0]\"]";
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
  inline_table += " }";
  return key.path.ends_with("[]") ? "[" + inline_table + "]" : inline_table;
}

constexpr std::string_view obliquity = "obliquity";
constexpr std::string_view planet_table = "planet";
constexpr std::string_view surface_table = "surface[]";
constexpr std::string_view free_table = "free";
constexpr std::string_view fit_table = "fit";
constexpr std::string_view scan_table = "fit.scan";
constexpr std::string_view light_table = "light";
constexpr std::string_view of_light = "light-curve";
constexpr std::string_view motion_tables[] = {"frame",     "orbit",  "perturbation[]",
                                              "surface[]", "method", "event[]"};

bool is_motion(std::string_view table) {
  const std::string_view first = table.substr(0, table.find('.'));
  return std::find(std::begin(motion_tables), std::end(motion_tables), first) !=
         std::end(motion_tables);
}

// Tables of a kind each, whose keys that may be left out are comments.
bool is_of_kinds(std::string_view table) { return is_motion(table) || table == observation_table; }

// A fit is a rotation with what was observed of it.
bool is_rotation(const TemplateSubject& subject) {
  return subject.experiment == "rotation" || subject.experiment == "fit";
}

std::string_view without_quotes(std::string_view text) { return text.substr(1, text.size() - 2); }

// Whether a key of a table of this kind has a line that is no comment.
bool is_shown(const Schema& schema, const Key& key, std::string_view kind) {
  const std::string_view path = key_table(key.path);
  const bool may_be_left_out =
      key.presence == Presence::optional && !is_required(key, kind) && !key.in_template;
  return stands(schema, key, kind) &&
         !((is_of_kinds(path) || path == "body" || path == planet_table || path == light_table ||
            path == scan_table) &&
           may_be_left_out);
}

bool is_orbit_name(const Schema& schema, const Key& key, const TemplateSubject& subject) {
  if (key.type != KeyType::name || !is_shown(schema, key, subject.perturbation)) return false;
  const std::string_view table = key_table(key.path);
  if (table == perturbation_table)
    return !subject.perturbation.empty() && belongs(key, subject.perturbation);
  return !subject.frame.empty() && key_table(table) == frame_table &&
         key_name(table) == subject.frame;
}

// The orbits that the examples of a subject name, each once.
std::vector<std::string> example_orbits(const Schema& schema, const TemplateSubject& subject) {
  std::vector<std::string> names;
  if (subject.experiment == obliquity) return {"mars"};
  for (const Key& key : schema.keys) {
    if (!is_orbit_name(schema, key, subject)) continue;
    const std::string value = example_value(schema, key);
    const std::string name(without_quotes(value));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

bool needs_surface(const Schema& schema, std::string_view kind) {
  const KindText* const text = text_of(schema, perturbation_table, kind);
  return text != nullptr && text->on_surface;
}

// Whether its orbit has a date and axes of the sky.
bool is_dated(const Schema& schema, const TemplateSubject& subject) {
  const KindText* const text = text_of(schema, orbit_table, subject.orbit);
  return text != nullptr && text->is_dated;
}

// Whether the orbits of the template give no gm, so that what names one needs its own.
bool needs_gm(const Schema& schema, const TemplateSubject& subject) {
  if (subject.orbit.empty() || is_dated(schema, subject)) return false;
  for (const Key* key : keys_of(schema, orbit_table))
    if (key_name(key->path) == "gm" && belongs(*key, subject.orbit) &&
        is_shown(schema, *key, subject.orbit))
      return false;
  return true;
}

// What a word of the key `kind` stands for; empty where nothing is said of it.
std::string_view kind_text(const Schema& schema, std::string_view table, std::string_view kind) {
  const KindText* const text = text_of(schema, table, kind);
  return text == nullptr ? std::string_view() : text->text;
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

bool is_physical(const Schema& schema, const TemplateSubject& subject) {
  const std::string_view kind = subject.perturbation;
  for (const Key* key :
       keys_of(schema, is_rotation(subject) ? perturbation_table : subject.experiment)) {
    const bool is_own = !is_rotation(subject) || (!kind.empty() && !key->kinds.empty());
    if (is_own && belongs(*key, kind) && is_shown(schema, *key, kind) && needs_mass(schema, *key))
      return true;
  }
  return false;
}

// Whether a symbol is one of seconds, or of what is so many of them.
bool is_time(std::string_view symbol) {
  for (const KnownUnit& known : known_units())
    if (known.symbol == symbol) return symbol == "s" || is_time(known.base);
  return false;
}

// The unit of time in a unit, "arcsec/yr"; empty where it has none.
std::string_view time_in(std::string_view unit) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  while (!unit.empty()) {
    std::size_t end = 0;
    while (end < unit.size() && is_letter(unit[end])) ++end;
    const std::string_view word = unit.substr(0, end);
    if (is_time(word)) return word;
    unit.remove_prefix(std::max<std::size_t>(end, 1));
  }
  return {};
}

// The unit of time of an experiment: that of the first of its examples that has one.
std::string time_unit(const Schema& schema, std::string_view experiment) {
  if (experiment == obliquity) return "kyr";
  if (const KindText* const text = text_of(schema, {}, experiment);
      text != nullptr && !text->time_unit.empty())
    return std::string(text->time_unit);
  for (const Key* key : keys_of(schema, experiment)) {
    if (key->dimension == Dimension::number || key->type == KeyType::unit) continue;
    const std::string unit = unit_of(schema, *key);
    const std::string_view time = time_in(unit);
    if (!time.empty()) return std::string(time);
  }
  return "s";
}

// A sentence as the text of a title, without its full stop.
std::string title_of(std::string_view sentence) {
  if (sentence.ends_with('.')) sentence.remove_suffix(1);
  std::string text;
  for (const char c : sentence) {
    if (c == '"' || c == '\\') text += '\\';
    text += c == '\n' || c == '\t' ? ' ' : c;
  }
  return in_quotes(text);
}

const Key& key_at(const Schema& schema, std::string_view path) {
  return *std::find_if(schema.keys.begin(), schema.keys.end(),
                       [&](const Key& key) { return key.path == path; });
}

// Whether a table has lines of its own in the template of this subject.
bool is_section(const Schema& schema, const Key& key, const TemplateSubject& subject) {
  if (key.type != KeyType::table) return false;
  if (!is_rotation(subject)) {
    const bool is_own = key_table(key.path).empty() && key.presence == Presence::required &&
                        belongs(key, subject.experiment);
    return is_own || key.path == "units" || key.path == "time" ||
           (key.path == output_table && subject.experiment == obliquity) ||
           (key.path == orbit_table && !subject.orbit.empty());
  }
  if (!belongs(key, subject.experiment)) return false;
  const std::string_view table = key_table(key.path), name = key_name(key.path);
  if (table == state_table) return name == subject.chart;
  if (table == frame_table) return name == subject.frame;
  if (table == output_table) return name == subject.format;
  if (key.path == light_table) return subject.observation == of_light;
  if (key.path == surface_table) return needs_surface(schema, subject.perturbation);
  if (key.path == orbit_table) return !example_orbits(schema, subject).empty();
  if (!table.empty() || key.path == key_table(orbit_table) || key.path == frame_table ||
      key.path == "map" || key.path == "ensemble")
    return false;
  return !is_motion(key.path) || !subject.perturbation.empty();
}

std::string section_name(std::string_view path, std::string_view orbit) {
  if (path == orbit_table) return "[orbit." + std::string(orbit) + "]";
  if (path.ends_with("[]")) return "[[" + std::string(key_name(path)) + "]]";
  return "[" + std::string(path) + "]";
}

// The word of the key `kind` of a table, in this template; empty where the table has no such key.
std::string_view kind_in(const Key& kind, const TemplateSubject& subject) {
  const std::string_view table = key_table(kind.path);
  if (table.empty()) return subject.experiment;
  if (table == perturbation_table) return subject.perturbation;
  if (table == orbit_table && !subject.orbit.empty()) return subject.orbit;
  if (table == method_table && !subject.method.empty()) return subject.method;
  if (table == observation_table && !subject.observation.empty()) return subject.observation;
  return without_quotes(kind.example);
}

// What rows over ages look like.
struct KeyExample {
  std::string_view path, value;
};
constexpr KeyExample over_ages[] = {
    {"time.stop", "-5000"},
    {"time.step", "1"},
    {"time.count", "5001"},
    {"time.at", "[0.0, -1.0, -10.0]"},
    {"output.columns", "[\"obliquity\", \"precession\", \"climatic_precession\"]"}};

// A night of four hours.
constexpr KeyExample of_light_curves[] = {{"units.time", "\"min\""},
                                          {"units.length", "\"au\""},
                                          {"state.axes", "\"ecliptic-J2000\""},
                                          {"time.stop", "240"},
                                          {"time.step", "2"},
                                          {"time.count", "121"},
                                          {"observation[].name", "\"first-night\""},
                                          {"observation[].file", "\"night.csv\""},
                                          {"observation[].orbit", "\"body\""},
                                          {"free.unknowns", "[\"attitude\", \"rate\", \"shape\"]"},
                                          {"fit.from", "\"search\""}};
constexpr std::string_view how_to_begin =
    "Light curves: say your file and its columns in [[observation]], how the vectors to Sun and "
    "observer are found there, and in [fit.scan] which periods are looked at. All else may stay: "
    "a search does not look at the numbers of [body], [state.attitude-rate] and [time].";

// The value of a key in this template.
std::string value_in(const Schema& schema, const Key& key, const TemplateSubject& subject) {
  const bool physical = is_physical(schema, subject);
  if (key.path == "title" && !is_rotation(subject))
    return title_of(kind_text(schema, {}, subject.experiment));
  if (subject.experiment == obliquity)
    for (const KeyExample& one : over_ages)
      if (one.path == key.path) return std::string(one.value);
  if (subject.observation == of_light)
    for (const KeyExample& one : of_light_curves)
      if (one.path == key.path) return std::string(one.value);
  if (key.path == "observation[].file" && !subject.observation.empty())
    return in_quotes(std::string(subject.observation) + "s.csv");
  if (key.path == "units.time" && !is_rotation(subject))
    return in_quotes(time_unit(schema, subject.experiment));
  if (key.path == "units.angle" && !is_rotation(subject))
    if (const KindText* const text = text_of(schema, {}, subject.experiment);
        text != nullptr && !text->angle_unit.empty())
      return in_quotes(std::string(text->angle_unit));
  if (key.path == "units.time" && physical) return "\"s\"";
  if (key.path == "units.moment" && physical) return "\"kg m2\"";
  if (key.path == "state.axes" && is_dated(schema, subject)) return "\"equator-J2000\"";
  return example_value(schema, key);
}

// Keys that say something of light curves alone, of everything else alone, and of neither here.
constexpr std::string_view for_light[] = {"fit.from", "fit.rotation", "fit.sessions",
                                          "fit.within_factor"};
constexpr std::string_view for_others[] = {"fit.iterations", "fit.tolerance", "fit.starts",
                                           "fit.rate_spread", "fit.within"};
constexpr std::string_view for_sessions = "simulate.sessions";

bool concerns(const Key& key, const TemplateSubject& subject) {
  const auto is_among = [&](const auto& paths) {
    return std::find(std::begin(paths), std::end(paths), key.path) != std::end(paths);
  };
  const bool is_light = subject.observation == of_light;
  if (key.path == for_sessions) return false;
  return !(is_light ? is_among(for_others) : is_among(for_light));
}

// Whether a key that may be left out has a line that is no comment, in this template.
bool is_wanted(const Schema& schema, const Key& key, const TemplateSubject& subject) {
  const std::string_view table = key_table(key.path), name = key_name(key.path);
  if (name == "kind") return table == orbit_table && !subject.orbit.empty();
  if (key.path == "state.epoch") return is_dated(schema, subject);
  return table == perturbation_table && name == "gm" && needs_gm(schema, subject);
}

// `orbit` is the name of an orbit, where that is the table.
void append_example(std::string& page, const Schema& schema, const Key* table,
                    const TemplateSubject& subject, std::string_view orbit = {}) {
  const std::string_view path = table == nullptr ? std::string_view() : table->path;
  if (table != nullptr) {
    page += "\n";
    append_comment(page, table->help);
    page += section_name(path, orbit) + "\n";
  }
  std::string_view kind;
  for (const Key* key : keys_of(schema, path)) {
    // [output.aem] names an object: what is not the user's own must not slip into their files
    const bool table_line = key->type == KeyType::table &&
                            (table == nullptr || is_motion(path) || path == state_table ||
                             path == output_table || path == free_table || path == fit_table);
    if (table_line || !belongs(*key, kind) || !concerns(*key, subject)) continue;
    std::string value = value_in(schema, *key, subject);
    std::string_view text;
    if ((table == nullptr || is_of_kinds(path)) && key_name(key->path) == "kind") {
      kind = kind_in(*key, subject);
      value = in_quotes(kind);
      text = kind_text(schema, path, kind);
    }
    append_comment(page, text.empty() ? key->help : text);
    const bool stands_here = is_shown(schema, *key, kind) || is_wanted(schema, *key, subject);
    page += (stands_here ? "" : "# ") + std::string(key_name(key->path)) + " = " + value + "\n";
  }
}

}  // namespace

std::vector<std::string_view> detail::kinds_of(const Schema& schema, std::string_view table) {
  for (const Key* key : keys_of(schema, table))
    if (key_name(key->path) == "kind") return separated(key->allowed, '|');
  return {};
}

const KindText* detail::text_of(const Schema& schema, std::string_view table,
                                std::string_view kind) {
  for (const KindText& one : schema.kinds)
    if (one.table == table && one.kind == kind) return &one;
  return nullptr;
}

std::string detail::template_text(const TemplateSubject& subject, const Schema& schema,
                                  std::string_view program) {
  const bool is_ours = program == "polhode";
  std::string page =
      "# A scenario for " + std::string(program) + ". Every key: " +
      (is_ours ? "docs/reference/scenario.md" : std::string(program) + " schema keys") + "\n";
  if (subject.observation == of_light) append_comment(page, how_to_begin);
  append_example(page, schema, nullptr, subject);
  for (const Key& key : schema.keys) {
    if (!is_section(schema, key, subject)) continue;
    if (key.path != orbit_table) {
      append_example(page, schema, &key, subject);
      if (key.path == fit_table && subject.observation == of_light)
        append_example(page, schema, &key_at(schema, scan_table), subject);
      continue;
    }
    for (const std::string& orbit : example_orbits(schema, subject))
      append_example(page, schema, &key, subject, orbit);
  }
  return page;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
