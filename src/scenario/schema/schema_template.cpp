// SPDX-License-Identifier: MIT
// The words of `polhode init`: every kind that a scenario may hold.
#include <algorithm>
#include <string>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/scenario/schema.hpp"
#include "scenario/detail/template_text.hpp"
#include "text/words.hpp"

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

std::vector<std::string_view> tables_in(const Schema& schema, std::string_view table) {
  std::vector<std::string_view> names;
  for (const Key* key : keys_of(schema, table))
    if (key->type == KeyType::table) names.push_back(key_name(key->path));
  return names;
}

// The words of the key `kind` at the top that have a table of their own.
std::vector<std::string_view> experiments(const Schema& schema) {
  std::vector<std::string_view> names;
  for (const KindText& one : schema.kinds)
    if (one.table.empty()) names.push_back(one.kind);
  return names;
}

// A word of `polhode init`, and what it makes.
struct Template {
  std::string_view sort;
  std::string word;
  TemplateSubject subject;
};

// Of a kind of orbit: what goes round on it.
TemplateSubject on_orbit(const Schema& schema, std::string_view kind) {
  const KindText* const text = detail::text_of(schema, orbit_table, kind);
  if (text != nullptr && text->over_ages) return {.experiment = "obliquity", .orbit = kind};
  return {.perturbation = "gravity-gradient", .orbit = kind};
}

TemplateSubject experiment_of(std::string_view kind) {
  return {.experiment = kind,
          .orbit = kind == "obliquity" ? std::string_view("shipped") : std::string_view()};
}

// A name that a sort before has is known as frame.NAME.
std::vector<Template> templates(const Schema& schema) {
  std::vector<Template> all;
  const auto add = [&](std::string_view sort, const std::vector<std::string_view>& names,
                       const auto& subject, std::string_view table) {
    for (const std::string_view name : names) {
      const bool is_taken = std::any_of(all.begin(), all.end(),
                                        [&](const Template& one) { return one.word == name; });
      all.push_back(
          {sort, (is_taken ? std::string(table) + "." : "") + std::string(name), subject(name)});
    }
  };
  using Name = std::string_view;
  add(
      "chart", state_charts(schema), [](Name name) { return TemplateSubject{.chart = name}; },
      "state");
  add(
      "perturbation", kinds_of(schema, perturbation_table),
      [](Name name) { return TemplateSubject{.perturbation = name}; }, "perturbation");
  add("experiment", experiments(schema), experiment_of, "kind");
  add(
      "orbit", kinds_of(schema, orbit_table), [&](Name name) { return on_orbit(schema, name); },
      "orbit");
  add(
      "frame", tables_in(schema, frame_table),
      [](Name name) { return TemplateSubject{.frame = name}; }, "frame");
  add(
      "method", kinds_of(schema, method_table),
      [](Name name) { return TemplateSubject{.perturbation = "constant-torque", .method = name}; },
      "method");
  add(
      "observation", kinds_of(schema, observation_table),
      [](Name name) { return TemplateSubject{.experiment = "fit", .observation = name}; },
      "observation");
  add(
      "output format", tables_in(schema, output_table),
      [](Name name) { return TemplateSubject{.format = name}; }, "output");
  return all;
}

std::string unknown_template(std::string_view name, const Schema& schema) {
  std::string expected;
  std::vector<std::string> words;
  const std::vector<TemplateSort> sorts = scenario_templates(schema);
  for (const TemplateSort& one : sorts) {
    const bool vowel = std::string_view("aeio").find(one.sort.front()) != std::string_view::npos;
    expected += expected.empty() ? "" : &one == &sorts.back() ? " or " : ", ";
    expected += (vowel ? "an " : "a ") + std::string(one.sort) + " (";
    for (const std::string& word : one.words) {
      expected += (&word == one.words.data() ? "" : ", ") + word;
      words.push_back(word);
    }
    expected += ")";
  }
  const std::vector<std::string_view> known(words.begin(), words.end());
  const std::string_view near = detail::nearest(name, known);
  return "got \"" + std::string(name) + "\"; expected " + expected +
         (near.empty() ? "" : "; did you mean " + std::string(near) + "?");
}

}  // namespace

std::vector<std::string_view> state_charts(const Schema& schema) {
  return tables_in(schema, state_table);
}

std::vector<TemplateSort> scenario_templates(const Schema& schema) {
  std::vector<TemplateSort> sorts;
  for (const Template& one : templates(schema)) {
    if (sorts.empty() || sorts.back().sort != one.sort) sorts.push_back({one.sort, {}});
    sorts.back().words.push_back(one.word);
  }
  return sorts;
}

std::string scenario_template(std::string_view name, const Schema& schema,
                              std::string_view program) {
  const std::vector<Template> all = templates(schema);
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Template& one) { return one.word == name; });
  if (found == all.end()) throw DomainError(unknown_template(name, schema));
  return detail::template_text(found->subject, schema, program);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
