// SPDX-License-Identifier: MIT
// CellJournal: results of cells as bytes, so that a search that was interrupted does not compute
// them again.
//
// Domain      work that calls ordered_parallel_for with the same cells in the same order each time:
//             each call is a stage of the journal, and its results stand there in order.
// Accuracy    a result is kept to the last bit: what follows from it is the same.
// Errors      DomainError for bytes that end too early, and for results of other work.
// Cost        the bytes of all results, in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

class CellJournal {
 public:
  // Called after each new result, one call after the other.
  std::function<void()> added = {};

  // The stages that were begun, with their results.
  void serialize(Archive& bytes) {
    bytes(stages_);
    if (!bytes.reads()) return;
    begun_ = 0;
    left_ = results();
  }

  std::size_t results() const {
    std::size_t all = 0;
    for (const std::vector<std::string>& stage : stages_) all += stage.size();
    return all;
  }
  // True until the results that were read have all been used again.
  bool is_replaying() const { return left_ > 0; }

  // sink(k, cell(k)) for k = 0 to count - 1: the next stage. `visit(bytes, result)` visits the
  // numbers of a result.
  template <class Cell, class Sink, class Visit>
  void run(std::int64_t count, int threads, const Cell& cell, const Sink& sink,
           const Visit& visit) {
    using Result = std::invoke_result_t<const Cell&, std::int64_t>;
    const std::size_t place = begun_++;
    if (place == stages_.size()) stages_.emplace_back();
    const std::int64_t known = std::ssize(stages_[place]);
    if (known > count) throw other_work();
    for (std::int64_t k = 0; k < known; ++k) {
      Archive bytes(stages_[place][static_cast<std::size_t>(k)]);
      Result result{};
      visit(bytes, result);
      if (!bytes.is_done()) throw other_work();
      --left_;
      sink(k, std::as_const(result));
    }
    ordered_parallel_for(known, count, threads, cell, [&](std::int64_t k, const Result& result) {
      Archive bytes;
      Result visited = result;
      visit(bytes, visited);
      stages_[place].push_back(bytes.bytes());
      sink(k, result);
      if (added) added();
    });
  }

 private:
  static DomainError other_work() {
    return DomainError("CellJournal: its results are those of other work");
  }

  std::vector<std::vector<std::string>> stages_;
  std::size_t begun_ = 0;  // stages
  std::size_t left_ = 0;   // results that were read and not used yet
};

// The same with a journal, or without one.
template <class Cell, class Sink, class Visit>
void ordered_parallel_for(CellJournal* journal, std::int64_t count, int threads, const Cell& cell,
                          const Sink& sink, const Visit& visit) {
  if (journal != nullptr) return journal->run(count, threads, cell, sink, visit);
  ordered_parallel_for(0, count, threads, cell, sink);
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
