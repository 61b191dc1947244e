// SPDX-License-Identifier: MIT
#include "polhode/mpi/mpi_ranks.hpp"

#include <mpi.h>

#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "mpi/leader.hpp"
#include "mpi/messages.hpp"
#include "mpi/own_cells.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {
namespace {

using detail::Cell;
using detail::Message;
using detail::Subject;

void answer(Cell cell) { detail::send(0, {.subject = Subject::answer, .cell = std::move(cell)}); }

class MpiRanks final : public Ranks {
 public:
  explicit MpiRanks(int threads) : own_(threads) {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiRanks() override {
    if (leads())
      for (int rank = 1; rank < size_; ++rank) detail::send(rank, {.subject = Subject::end});
    if (!leads() && !ended_) MPI_Abort(MPI_COMM_WORLD, 1);  // the leader waits for its cells
    MPI_Finalize();
  }

  int processes() const override { return size_; }
  int at_a_time() const override { return size_ * own_.threads(); }
  bool leads() const override { return rank_ == 0; }

  void run(ExecutorWork& work, const ExecutorStage& stage, const Take& take,
           const std::function<void()>& look) override {
    for (int rank = 1; rank < size_; ++rank) detail::send(rank, {.subject = Subject::stage});
    std::string bytes = stage.bytes;
    detail::broadcast(bytes);
    work.begin(bytes);
    detail::Leader(own_, size_, work, stage, take).run(look);
  }

  void serve(const MakeWork& make) override {
    std::unique_ptr<ExecutorWork> work;
    std::string failure;  // why cells cannot be computed
    detail::Patience patience;
    for (;;) {
      const std::optional<Message> message = detail::received();
      if (message && message->subject == Subject::end) {
        ended_ = true;
        return;
      }
      if (message && message->subject == Subject::stage) failure = begun(make, work);
      if (message && message->subject == Subject::drop) own_.drop();
      if (message && message->subject == Subject::cell) {
        if (failure.empty())
          own_.add(*work, message->cell.index);
        else
          answer({message->cell.index, Cell::Fate::failed, failure});
      }
      const std::optional<Cell> cell = own_.next();
      if (cell) answer(*cell);
      if (message || cell)
        patience.renew();
      else
        patience.wait();
    }
  }

 private:
  // The stage that the leader tells; why it cannot begin.
  std::string begun(const MakeWork& make, std::unique_ptr<ExecutorWork>& work) {
    std::string stage;
    detail::broadcast(stage);
    own_.resume();
    try {
      if (!work) work = make();
      work->begin(stage);
      return {};
    } catch (const std::exception& error) {
      return error.what();
    }
  }

  int rank_ = 0;
  int size_ = 1;
  bool ended_ = false;  // of one that serves: whether the leader has said so
  detail::OwnCells own_;
};

}  // namespace

std::unique_ptr<Ranks> mpi_ranks(int threads) {
  if (threads < 1)
    throw DomainError("mpi_ranks: threads " + std::to_string(threads) + " must be at least 1");
  auto ranks = std::make_unique<MpiRanks>(threads);
  if (ranks->processes() == 1) return nullptr;
  return ranks;
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
