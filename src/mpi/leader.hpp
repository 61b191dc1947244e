// SPDX-License-Identifier: MIT
// Rank 0 while a stage goes on: hands out its cells in order, one by one as processes come free,
// computes some itself, and takes what comes back in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "mpi/messages.hpp"
#include "mpi/own_cells.hpp"
#include "polhode/ensemble/executor.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {

class Leader {
 public:
  // `ranks` processes, this one included, that compute as many cells at a time as this one.
  Leader(OwnCells& own, int ranks, const ExecutorWork& work, const ExecutorStage& stage,
         const Executor::Take& take);

  // Until all are taken, or one has failed: ExecutorError. What `look` or `take` throws passes
  // through. Nothing is under way afterwards.
  void run(const std::function<void()>& look);

 private:
  void go_on(const std::function<void()>& look);
  // Whether something was there to be done.
  bool hand_out();
  bool collect();
  bool take_next();
  // Whether so much waits, while the next one is there, that what arrives has to wait with those
  // who sent it.
  bool has_enough() const;
  void keep(int rank, Cell cell);
  void drop_all();

  OwnCells& own_;
  const ExecutorWork& work_;
  const Executor::Take& take_;
  std::int64_t next_;                     // to be handed out
  std::int64_t taken_;                    // all before it are
  std::int64_t stop_;                     // before it, where all goes well
  std::vector<int> under_way_;            // by rank
  std::map<std::int64_t, Cell> waiting_;  // for those before them
  std::size_t waiting_bytes_ = 0;
  bool drops_ = false;
};

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
