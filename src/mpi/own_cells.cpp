// SPDX-License-Identifier: MIT
#include "mpi/own_cells.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <thread>
#include <utility>

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace detail {
namespace {

struct Dropped {};

}  // namespace

// One more thread than compute: that of the messages takes no part.
OwnCells::OwnCells(int threads)
    : threads_(threads),
      allowed_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads) + 1),
      arena_(threads, 0) {}

OwnCells::~OwnCells() {
  drop();
  Patience patience;
  while (unfinished_ > 0)
    if (!next()) patience.wait();
}

void OwnCells::add(const ExecutorWork& work, std::int64_t index) {
  ++unfinished_;
  arena_.enqueue([this, &work, index] { ended_.push(computed(work, index)); });
}

std::optional<Cell> OwnCells::next() {
  Cell cell;
  if (!ended_.try_pop(cell)) return std::nullopt;
  --unfinished_;
  return cell;
}

Cell OwnCells::computed(const ExecutorWork& work, std::int64_t index) const {
  const auto look = [this] {
    if (drops_) throw Dropped();
  };
  try {
    look();
    return {index, Cell::Fate::done, work.cell(index, look)};
  } catch (const Dropped&) {
    return {index, Cell::Fate::dropped, {}};
  } catch (const std::bad_alloc&) {
    return {index, Cell::Fate::failed, "out of memory"};
  } catch (const std::exception& error) {
    return {index, Cell::Fate::failed, error.what()};
  }
}

void Patience::wait() {
  std::this_thread::sleep_for(std::chrono::microseconds(microseconds_));
  microseconds_ = std::min(2 * microseconds_, most);
}

}  // namespace detail
}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
