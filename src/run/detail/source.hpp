// SPDX-License-Identifier: MIT
// Source: cells that can be computed in any order, on threads or in other processes, which exchange
// bytes (SourceWork).
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/trajectory/trajectory.hpp"
#include "run/detail/checkpointed_outputs.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class SourceWork;

// Members first to end - 1 in cells of `each`; the last cell may have fewer.
struct CellRange {
  std::int64_t first = 0, end = 0, each = 1;

  // Cells are numbered as those of a range from 0 on.
  std::int64_t first_cell() const { return first / each; }
  std::int64_t end_cell() const { return first_cell() + (end - first + each - 1) / each; }
  std::int64_t begin_of(std::int64_t cell) const {
    return std::min(end, first + (cell - first_cell()) * each);
  }
};

template <class Result>
struct Source {
  CellRange range;
  // The result of a cell, members begin to end - 1, from any thread. `look` is called now and then,
  // and what it throws passes through.
  std::function<Result(std::int64_t begin, std::int64_t end, const Progress& look)> members;
  // The same in other processes: `stage` writes what they need besides the range.
  SourceWork* work = nullptr;
  std::function<void(Archive&)> stage = {};
  std::function<void(Archive&, Result&)> serialize = {};

  Result cell(std::int64_t index, const Progress& look) const {
    return members(range.begin_of(index), range.begin_of(index + 1), look);
  }
};

// The sources of one scenario in each process of an executor. Processes that read another scenario,
// or compute other last digits, are rejected.
class SourceWork : public ensemble::ExecutorWork {
 public:
  // The bytes of a stage, whose own part `serialize` writes.
  std::string stage(CellRange range, const std::function<void(Archive&)>& serialize) const;
  void begin(const std::string& stage) final;
  std::string cell(std::int64_t index, const std::function<void()>& look) const final;
  // Keeps the input that this work refers to.
  void own(std::shared_ptr<const void> input) { input_ = std::move(input); }

 protected:
  // `kind` as messages call it: "ensemble".
  SourceWork(const Scenario& scenario, std::string kind, const std::vector<ColumnGroup>& groups,
             bool any_machine);
  // Reads the own part of a stage and calls computes().
  virtual void begin_stage(const CellRange& range, Archive& stage) = 0;
  template <class Result>
  void computes(Source<Result> source) {
    cell_ = [of = std::move(source)](std::int64_t index, const Progress& look) {
      Result result = of.cell(index, look);
      Archive bytes;
      of.serialize(bytes, result);
      return bytes.bytes();
    };
  }

 private:
  std::string name_, kind_;
  Identity identity_;
  bool any_machine_;
  std::function<std::string(std::int64_t index, const Progress& look)> cell_;  // of the last stage
  std::shared_ptr<const void> input_;
};

// The work of another process, which owns the map or ensemble of a scenario.
template <class Work, class Of>
std::unique_ptr<ensemble::ExecutorWork> work_of(Scenario scenario, bool any_machine) {
  const auto of = std::make_shared<const Of>(std::move(scenario));
  auto work = std::make_unique<Work>(*of, any_machine);
  work->own(of);
  return work;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
