// SPDX-License-Identifier: MIT
#include "run/detail/sweep.hpp"

#include <utility>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr std::size_t numbers_per_block = 65536;

}  // namespace

Sweep::Sweep(const Scenario& scenario, CheckpointSetup setup, std::vector<ColumnGroup> groups,
             Provenance origin, RunOptions&& options)
    : scenario_(scenario),
      options_(std::move(options)),
      groups_(std::move(groups)),
      origin_(std::move(origin)),
      outputs_(std::move(setup), options_, origin_) {}

void Sweep::resume() {
  if (outputs_.continues()) serialize(outputs_.state());
  reached_before_ = reached();
  rows_before_ = rows_;
}

void Sweep::open(const Other& other) {
  outputs_.with_remedy([&] {
    outputs_.open([&](const std::string& path, const std::optional<SinkPosition>& from) {
      if (other)
        if (std::optional<CheckpointedOutput> opened = other(path, from)) return *opened;
      sinks_.push_back(open_sink(path, groups_, origin_, from, scenario_.output.formats));
      return checkpointed_output(*sinks_.back());
    });
  });
  if (options_.extra_sink) sinks_.push_back(std::move(options_.extra_sink));
}

void Sweep::keep() {
  if (outputs_.keeps()) outputs_.keep(place(), [this](Archive& bytes) { serialize(bytes); });
}

void Sweep::interrupt() {
  if (has_state()) keep();
  if (raised_) std::rethrow_exception(raised_);
  throw RunInterrupted(scenario_.document.name + ": stopped " + place().stopped, reached(),
                       outputs_.keeps());
}

int Sweep::threads() const {
  return options_.threads > 0 ? options_.threads : ensemble::hardware_threads();
}

int Sweep::workers() const {
  return options_.executor == nullptr ? threads() : options_.executor->at_a_time();
}

void Sweep::took(double left, Stage stage) {
  clock_.ended();
  if (waiting_.size() >= numbers_per_block) push_rows();
  if (stage == Stage::cells && options_.progress) {
    try {
      options_.progress({reached(), clock_.part(left)});
    } catch (...) {
      raised_ = std::current_exception();
      throw Stopped();
    }
  }
  if (stage == Stage::cells && left == 0.0) return;
  if (is_stopped()) throw Stopped();
  if (has_state() && outputs_.is_due()) keep();
}

void Sweep::require_cells_for_all(std::int64_t cells, const std::string& kind,
                                  const std::string& called, const std::string& one,
                                  const std::string& advice) const {
  const int processes = options_.executor == nullptr ? 1 : options_.executor->processes();
  if (processes <= cells) return;
  throw DomainError(scenario_.document.name + ": " + kind + ": " + std::to_string(processes) +
                    " processes for " + std::to_string(cells) + " " + called + "; expected a " +
                    one + " for each at least: fewer processes" + advice);
}

void Sweep::add_rows(std::span<const double> rows) {
  waiting_.insert(waiting_.end(), rows.begin(), rows.end());
}

void Sweep::push_rows() {
  if (waiting_.empty()) return;
  for (const std::unique_ptr<Sink>& sink : sinks_) sink->push(waiting_);
  rows_ += static_cast<std::int64_t>(waiting_.size() / row_width(groups_));
  waiting_.clear();
}

CheckpointPlace Sweep::place_among(std::int64_t size, const std::string& things) const {
  const std::string done = std::to_string(static_cast<std::int64_t>(reached())) + " of " +
                           std::to_string(size) + " " + things;
  return {done, "after " + done, "after " + done};
}

}  // namespace detail

ResumableRun::ResumableRun(std::unique_ptr<detail::Sweep> sweep) : sweep_(std::move(sweep)) {}
ResumableRun::~ResumableRun() = default;
bool ResumableRun::continues() const { return sweep_->outputs().continues(); }
bool ResumableRun::is_complete() const { return sweep_->outputs().is_complete(); }
double ResumableRun::reached() const { return sweep_->reached_before(); }
std::int64_t ResumableRun::rows() const { return sweep_->rows_before(); }

}  // namespace io
}  // namespace v0
}  // namespace polhode
