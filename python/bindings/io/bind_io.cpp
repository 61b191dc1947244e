// SPDX-License-Identifier: MIT
// Scenarios and what belongs to them. The classes Scenario and Results are Python's
// (python/polhode/_scenarios.py, _results.py); _Scenario is the value behind them.
#include "charts/states.hpp"
#include "interface/arrays.hpp"
#include "io/io_parts.hpp"
#include "motion/dynamics_values.hpp"
#include "polhode/detail/output/row_dates.hpp"
#include "polhode/error.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/changes.hpp"
#include "polhode/text/separated.hpp"

namespace polhode::python {

namespace {

nb::str text(std::string_view words) { return nb::str(words.data(), words.size()); }

// Of the class that the chart names; its numbers by name where there is none.
nb::object state_of(const io::ChartState& state) {
  nb::dict fields;
  std::size_t place = 0;
  for (const io::ChartVariable& variable : state.chart.variables)
    fields[text(variable.name)] = state.numbers.at(place++);
  for (const io::ChartOption& option : state.chart.options)
    fields[text(option.name)] = state.numbers.at(place++);
  for (const io::ChartField& field : state.chart.state_fields)
    fields[text(field.name)] = text(field.word);
  if (state.chart.state_class.empty()) return fields;
  return nb::module_::import_("polhode._core").attr(text(state.chart.state_class))(**fields);
}

// The state as the file gives it; an attitude with a rate is the hub state.
nb::object state_object(const io::Scenario& scenario) {
  return std::visit(
      [&](const auto& s) -> nb::object {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, io::AttitudeRate>)
          return nb::cast(Batch<RotorState>::one(io::initial_state(scenario)));
        else if constexpr (std::is_same_v<S, io::ChartState>)
          return state_of(s);
        else
          return nb::cast(Batch<S>::one(s));
      },
      scenario.rotation().state);
}

// The charts of [state]: (name, class, {field: word}, [(number, is an angle)], [(option, words)]).
nb::list state_charts_list() {
  nb::list charts;
  for (const io::ChartKind& chart : io::default_charts()) {
    if (!chart.in_scenarios) continue;
    nb::dict fields;
    for (const io::ChartField& field : chart.state_fields)
      fields[text(field.name)] = text(field.word);
    nb::list numbers, options;
    for (const io::ChartVariable& variable : chart.variables)
      numbers.append(
          nb::make_tuple(text(variable.name), variable.dimension == io::Dimension::angle));
    for (const io::ChartOption& option : chart.options)
      options.append(
          nb::make_tuple(text(option.name), names_list(io::separated(option.words, '|'))));
    charts.append(
        nb::make_tuple(text(chart.name), text(chart.state_class), fields, numbers, options));
  }
  return charts;
}

// The kind of a method in a file, and the names of its keys.
nb::tuple method_table(nb::handle method) {
  const std::string name = method_traits(method_of(method)).kind;
  static const io::Kinds kinds = io::default_kinds();
  nb::list keys;
  for (const io::Key& key : kinds.method(name)->keys) keys.append(text(key.path));
  return nb::make_tuple(name, keys);
}

// [(group, [(column, unit), ...]), ...], t first.
nb::list groups_of(const io::Scenario& scenario) {
  nb::list groups;
  for (const io::ColumnGroup& group : io::row_groups(scenario)) {
    nb::list columns;
    for (const io::Column& column : group.columns)
      columns.append(nb::make_tuple(column.name, column.unit));
    groups.append(nb::make_tuple(group.name, columns));
  }
  return groups;
}

std::string changed_by(const std::string& text, const std::string& key, const std::string& value) {
  try {
    return io::changed_text(text, std::vector<io::ScenarioChange>{{key, value}});
  } catch (const io::ChangeError& error) {
    throw DomainError(std::string("replace: ") + error.what());
  }
}

// The columns whose numbers are times, shown as dates.
nb::list date_columns_of(const io::Scenario& scenario) {
  nb::list names;
  for (const io::ColumnGroup& group : io::row_groups(scenario))
    for (const io::Column& column : group.columns)
      if (column.is_date) names.append(column.name);
  return names;
}

// The dates of times of rows.
nb::list dates_of(const io::Scenario& scenario, const std::vector<double>& times) {
  const io::RowDates dates(io::row_groups(scenario), io::run_facts(scenario));
  nb::list texts;
  for (const double t : times) texts.append(dates.text(t));
  return texts;
}

nb::list citations_of(const io::Scenario& scenario) {
  nb::list list;
  for (const io::Citation& c : io::citations(scenario))
    list.append(nb::make_tuple(std::string(c.key), std::string(c.text), std::string(c.reason),
                               io::bibtex(c)));
  return list;
}

}  // namespace

nb::list names_list(const std::vector<std::string_view>& names) {
  nb::list list;
  for (const std::string_view name : names) list.append(text(name));
  return list;
}

nb::list lines_of(const std::vector<io::SummaryLine>& lines) {
  nb::list list;
  for (const io::SummaryLine& line : lines)
    list.append(nb::make_tuple(line.key, line.label, line.numbers, line.text, line.unit));
  return list;
}

void bind_io(nb::module_& m) {
  // after DomainError: the last translator is asked first
  nb::exception<io::ScenarioError>(m, "ScenarioError", nb::object(m.attr("DomainError")))
      .attr("__doc__") = "Every mistake of a scenario, one line each: FILE:LINE:COLUMN: KEY: ...";
  nb::exception<io::OutputError>(m, "OutputError", PyExc_RuntimeError).attr("__doc__") =
      "A disk that is full, a folder that is gone: the run failed, its input was right.";
  bind_units(m);
  bind_kinds(m);
  bind_golden(m);
  bind_aem(m);
  bind_nutation(m);
  bind_oem(m);
  bind_command_line(m);
  nb::class_<io::Scenario> c(m, "_Scenario");
  c.def_static("from_text",
               [](const nb::bytes& text, const std::string& name, const io::Kinds& kinds) {
                 return io::scenario_from_text({text.c_str(), text.size()}, name, kinds);
               })
      .def_prop_ro("name", [](const io::Scenario& s) -> const auto& { return s.document.name; })
      .def_prop_ro("warnings", [](const io::Scenario& s) { return io::warnings(s); })
      .def_prop_ro("text", [](const io::Scenario& s) -> const auto& { return s.document.text; })
      .def_prop_ro("title", [](const io::Scenario& s) -> const auto& { return s.document.title; })
      .def_prop_ro("units", [](const io::Scenario& s) -> const auto& { return s.units(); })
      .def_prop_ro("body", [](const io::Scenario& s) -> const auto& { return s.rotation().body; })
      .def_prop_ro("chart", [](const io::Scenario& s) -> const auto& { return s.rotation().chart; })
      .def_prop_ro("epoch", [](const io::Scenario& s) -> const auto& { return s.rotation().epoch; })
      .def_prop_ro("axes", [](const io::Scenario& s) -> const auto& { return s.rotation().axes; })
      .def_prop_ro("columns", [](const io::Scenario& s) -> const auto& { return s.output.columns; })
      .def_prop_ro("time", [](const io::Scenario& s) -> const auto& { return io::row_times(s); })
      .def_prop_ro("state", state_object)
      .def_prop_ro(
          "initial_state",
          [](const io::Scenario& s) { return Batch<RotorState>::one(io::initial_state(s)); })
      .def_prop_ro("damper_rate",
                   [](const io::Scenario& s) { return array_of(s.rotation().damper_rate); })
      .def_prop_ro("free_rotation", [](const io::Scenario& s) { return io::free_rotation(s); })
      .def_prop_ro("method",
                   [](const io::Scenario& s) { return object_of(io::propagation_method(s)); })
      .def_prop_ro("propagation", io::propagation_text)
      .def_prop_ro("path", [](const io::Scenario& s) { return s.document.path; })
      .def_prop_ro("groups", groups_of)
      .def_prop_ro("date_columns", date_columns_of)
      .def("dates", dates_of)
      .def_prop_ro("citations", citations_of)
      .def_prop_ro("summary", [](const io::Scenario& s) { return lines_of(io::summary(s)); });
  bind_objects(c);
  bind_run(m, c);
  bind_executor_work(m);
  bind_map(m, c);
  bind_ensemble(m, c);
  // (start, stop, step or None) of steps and counts; None of a list
  m.def("_save_at_parts", [](const SaveAt& s) -> nb::object {
    if (s.is_list() || s.size() == 0) return nb::none();
    const nb::object step = s.step() == 0.0 ? nb::none() : nb::object(nb::float_(s.step()));
    return nb::make_tuple(s.start(), s.stop(), step);
  });
  m.def("_shown_number", &io::shown_number);
  m.def("_changed_text", changed_by);
  m.def("_state_charts", state_charts_list);
  m.def("_method_table", method_table);
}

}  // namespace polhode::python
