// SPDX-License-Identifier: MIT
// custom_experiment: an experiment from outside, from a model that integrate() moves.
//
// Equations   those of the model (polhode/dynamics/model.hpp).
// Units       core units; columns are written in those of the file.
// Domain      a model with a state of any numbers. It starts at t = 0 and goes to the first row,
//             then along the rows; events are looked for from the first row on.
// Accuracy    that of the method.
// Errors      DomainError without columns. What integrate() refuses comes with the run.
// Cost        one copy of the problem. To compile: the loop, for the state of the model.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/error.hpp"
#include "polhode/run/detail/integrated_run.hpp"
#include "polhode/run/detail/rows_maker.hpp"
#include "polhode/scenario/experiment_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

template <class M>
struct ModelExperiment {
  using State = typename M::State;

  M model;
  State initial;                      // at t = 0
  std::vector<CustomColumn> columns;  // behind t
  // The numbers of the columns, in core units.
  std::function<void(const BasicSample<State>&, std::span<double>)> row;
  std::vector<SummaryItem> facts = {};
  std::vector<BasicEvent<State>> events = {};
};

template <class M>
CustomExperiment custom_experiment(std::string kind, const ExperimentContext& at,
                                   ModelExperiment<M> of) {
  using S = typename M::State;
  if (of.columns.empty())
    throw DomainError("custom_experiment: " + kind + ": got no columns; expected one or more");
  at.require_method(FrozenModel<M>);
  const SaveAt& rows = at.rows();
  std::vector<std::string> event_names;
  for (const BasicEvent<S>& event : of.events) event_names.push_back(event.name);
  const BasicProblem<M> problem{std::move(of.model),   of.initial,  0.0,
                                rows[rows.size() - 1], at.method(), std::move(of.events)};
  const auto write = [columns = of.columns, row = std::move(of.row), units = at.units()](
                         std::span<const BasicSample<S>> samples, std::span<double> numbers) {
    const std::size_t width = columns.size() + 1;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const std::span<double> one = numbers.subspan(k * width, width);
      one[0] = units.from_core(samples[k].t, Dimension::time);
      row(samples[k], one.subspan(1));
      for (std::size_t i = 0; i < columns.size(); ++i)
        one[i + 1] = units.from_core(one[i + 1], columns[i].dimension);
    }
  };
  auto run = [problem, rows, write](detail::RowWriter& writer, const detail::RunControl& control) {
    const detail::RowsOfMotion<M> motion{problem, rows, write};
    return detail::integrated_run(motion, writer, control).report;
  };
  return {.kind = std::move(kind),
          .rows = rows,
          .columns = std::move(of.columns),
          .method = at.method(),
          .facts = std::move(of.facts),
          .has_events = !problem.events.empty(),
          .event_names = std::move(event_names),
          .identity = polhode::detail::state_bytes(problem.initial),
          .maker = std::make_shared<const detail::RowsMaker>(detail::RowsMaker{std::move(run)})};
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
