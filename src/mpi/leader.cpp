// SPDX-License-Identifier: MIT
#include "mpi/leader.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "mpi/messages.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {
namespace {

constexpr std::int64_t waiting_per_thread = 4;
constexpr std::size_t most_waiting_bytes = std::size_t{1} << 30;

}  // namespace

Leader::Leader(OwnCells& own, int ranks, const ExecutorWork& work, const ExecutorStage& stage,
               const Executor::Take& take)
    : own_(own),
      work_(work),
      take_(take),
      next_(stage.first),
      taken_(stage.first),
      stop_(stage.count),
      under_way_(static_cast<std::size_t>(ranks), 0) {}

void Leader::run(const std::function<void()>& look) {
  own_.resume();
  try {
    go_on(look);
  } catch (...) {
    drop_all();
    throw;
  }
  drop_all();
}

void Leader::go_on(const std::function<void()>& look) {
  Patience patience;
  while (taken_ < stop_) {
    look();
    const bool handed = hand_out(), collected = collect(), took = take_next();
    if (handed || collected || took)
      patience.renew();
    else
      patience.wait();
  }
}

// One more than a rank computes at a time lies ready for it.
bool Leader::hand_out() {
  const int most = own_.threads() + 1;
  const auto all = static_cast<std::int64_t>(under_way_.size());
  const std::int64_t limit = std::min(stop_, taken_ + waiting_per_thread * own_.threads() * all);
  bool handed = false;
  for (int round = 0; round < most; ++round)
    for (std::size_t rank = 0; rank < under_way_.size() && next_ < limit; ++rank) {
      if (under_way_[rank] > round) continue;
      if (rank == 0)
        own_.add(work_, next_);
      else
        send(static_cast<int>(rank), {.subject = Subject::cell, .cell = {next_}});
      ++under_way_[rank];
      ++next_;
      handed = true;
    }
  return handed;
}

bool Leader::collect() {
  bool collected = false;
  while (!has_enough()) {
    std::optional<Message> message = received();
    if (!message) break;
    keep(message->rank, std::move(message->cell));
    collected = true;
  }
  while (std::optional<Cell> cell = own_.next()) {
    keep(0, std::move(*cell));
    collected = true;
  }
  return collected;
}

void Leader::keep(int rank, Cell cell) {
  --under_way_[static_cast<std::size_t>(rank)];
  if (drops_ || cell.fate == Cell::Fate::dropped) return;
  waiting_bytes_ += cell.bytes.size();
  if (cell.fate == Cell::Fate::failed)
    cell.bytes = "rank " + std::to_string(rank) + ": " + cell.bytes;
  waiting_.emplace(cell.index, std::move(cell));
}

bool Leader::take_next() {
  const auto found = waiting_.find(taken_);
  if (found == waiting_.end()) return false;
  const Cell cell = std::move(found->second);
  waiting_.erase(found);
  waiting_bytes_ -= std::min(waiting_bytes_, cell.bytes.size());
  if (cell.fate == Cell::Fate::failed) throw ExecutorError(cell.bytes);
  take_(taken_, cell.bytes);
  ++taken_;
  return true;
}

// Never while the next one is missing: it may be the one that would have to wait.
bool Leader::has_enough() const {
  return !drops_ && waiting_bytes_ > most_waiting_bytes && waiting_.contains(taken_);
}

void Leader::drop_all() {
  drops_ = true;
  waiting_.clear();
  const auto left = [&] { return std::accumulate(under_way_.begin(), under_way_.end(), 0); };
  if (left() == 0) return;
  own_.drop();
  for (std::size_t rank = 1; rank < under_way_.size(); ++rank)
    if (under_way_[rank] > 0) send(static_cast<int>(rank), {.subject = Subject::drop});
  Patience patience;
  while (left() > 0)
    if (!collect()) patience.wait();
}

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
