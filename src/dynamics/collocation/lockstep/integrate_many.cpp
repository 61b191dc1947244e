// SPDX-License-Identifier: MIT
#include "polhode/dynamics/integrate_many.hpp"

#include <array>
#include <concepts>
#include <exception>
#include <memory>
#include <utility>
#include <variant>

#include "dynamics/collocation/lockstep/lockstep_run.hpp"
#include "dynamics/shown_as.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/integrate.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::body_lanes;
using detail::BodyStep;
using detail::LockstepRun;
using detail::ManySteps;

std::string text_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& e) {
    return e.what();
  } catch (...) {
    return "an exception that is not a std::exception";
  }
}

const Problem& rotor_problem(const Problem& p) { return p; }
Problem rotor_problem(const DampedProblem& p) {
  detail::checked_problem("integrate", p,
                          detail::DamperState::carried);  // no rate without a damper
  return detail::problem_of<RotorState>(p);
}
template <MotionState S>
BasicTrajectory<S> shown_as(Trajectory run) {
  if constexpr (std::same_as<S, RotorState>) {
    return run;
  } else {
    return detail::shown_run<S>(std::move(run));
  }
}

template <MotionState S>
class Lockstep {
 public:
  using ShownProblem = BasicProblem<System, S>;
  using Shown = BasicBodyRun<S>;
  using Source = std::function<ShownProblem(std::size_t)>;
  using Done = std::function<void(std::size_t, Shown)>;

  Lockstep(std::size_t count, const Source& problem, const Keep& keep, const Done& done,
           const Progress& progress)
      : count_(count), problem_(problem), keep_(keep), done_(done), progress_(progress) {
    if (!progress) return;
    watched_ = [this](double t) {
      try {
        progress_(t);
      } catch (...) {
        ended_by_ = std::current_exception();
        throw;
      }
    };
  }

  void run() {
    for (;;) {
      fill();
      if (size_ == 0) return;
      for (std::size_t k = 0; k < size_; ++k) steps_[k] = lanes_[k].run->tried();
      sweeps_->solve({steps_.data(), size_});
      for (std::size_t k = 0; k < size_; ++k) look_at(k);
      if (progress_) progress_(lanes_[0].run->time());
      remove_ended();
    }
  }

 private:
  struct Lane {
    std::size_t index = 0;
    std::unique_ptr<LockstepRun> run;
    bool has_ended = false;
  };

  // Bodies into the lanes that are free.
  void fill() {
    while (size_ < body_lanes) {
      if (!waiting_.run && !take_next()) return;
      if (size_ > 0 &&
          !ManySteps::go_together(*lanes_[0].run->tried().stages, *waiting_.run->tried().stages))
        return;
      if (size_ == 0) {
        const detail::RotorStages& first = *waiting_.run->tried().stages;
        sweeps_.emplace(first.scheme().stages, widest_instruction_set());
      }
      lanes_[size_++] = std::exchange(waiting_, {});
      sweeps_->regroup();
    }
  }
  // The next body that makes steps in lockstep; those before it end here. Whether there is one.
  bool take_next() {
    while (next_ < count_) {
      const std::size_t index = next_++;
      const ShownProblem problem = problem_(index);
      Shown whole;
      try {
        if (std::holds_alternative<Collocation>(problem.method) && !problem.system.damper()) {
          auto run = std::make_unique<LockstepRun>(rotor_problem(problem), keep_);
          if (run->goes_on()) {
            waiting_ = {index, std::move(run)};
            return true;
          }
          whole.trajectory = shown_as<S>(run->trajectory());
        } else {
          whole.trajectory = integrate(problem, keep_, watched_);
        }
      } catch (...) {
        if (ended_by_) throw;
        whole = failed(index, problem.start, std::current_exception());
      }
      done_(index, std::move(whole));
      if (progress_) progress_(problem.start);
    }
    return false;
  }

  void look_at(std::size_t k) {
    Lane& lane = lanes_[k];
    Shown whole;
    try {
      if (steps_[k].thrown) std::rethrow_exception(steps_[k].thrown);
      lane.run->solved(steps_[k].judge);
      if (lane.run->goes_on()) return;
      whole.trajectory = shown_as<S>(lane.run->trajectory());
    } catch (...) {
      whole = failed(lane.index, lane.run->time(), std::current_exception());
    }
    lane.has_ended = true;
    done_(lane.index, std::move(whole));
  }
  static Shown failed(std::size_t index, double t, const std::exception_ptr& thrown) {
    return {std::nullopt,
            "body " + std::to_string(index) + " at t = " + detail::number_text(t) + ": " +
                text_of(thrown),
            thrown};
  }
  void remove_ended() {
    for (std::size_t k = size_; k-- > 0;) {
      if (!lanes_[k].has_ended) continue;
      lanes_[k] = std::move(lanes_[--size_]);
      lanes_[size_] = {};
      sweeps_->regroup();
    }
  }

  std::size_t count_;
  const Source& problem_;
  const Keep& keep_;
  const Done& done_;
  const Progress& progress_;
  Progress watched_;             // of a body that goes alone
  std::exception_ptr ended_by_;  // what progress has thrown
  std::size_t next_ = 0;
  Lane waiting_;
  std::array<Lane, body_lanes> lanes_;
  std::array<BodyStep, body_lanes> steps_;
  std::size_t size_ = 0;
  std::optional<ManySteps> sweeps_;
};

template <MotionState S>
std::vector<BasicBodyRun<S>> all(std::span<const BasicProblem<System, S>> problems,
                                 const Keep& keep) {
  std::vector<BasicBodyRun<S>> runs(problems.size());
  integrate_many(problems.size(),
                 std::function<BasicProblem<System, S>(std::size_t)>(
                     [&](std::size_t k) { return problems[k]; }),
                 keep, [&](std::size_t k, BasicBodyRun<S> run) { runs[k] = std::move(run); });
  return runs;
}

}  // namespace

void integrate_many(std::size_t count, const std::function<Problem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, BodyRun)>& done,
                    const Progress& progress) {
  Lockstep<RotorState>(count, problem, keep, done, progress).run();
}
void integrate_many(std::size_t count, const std::function<DampedProblem(std::size_t)>& problem,
                    const Keep& keep, const std::function<void(std::size_t, DampedBodyRun)>& done,
                    const Progress& progress) {
  Lockstep<DampedRotorState>(count, problem, keep, done, progress).run();
}

std::vector<BodyRun> integrate_many(std::span<const Problem> problems, const Keep& keep) {
  return all(problems, keep);
}
std::vector<DampedBodyRun> integrate_many(std::span<const DampedProblem> problems,
                                          const Keep& keep) {
  return all(problems, keep);
}

}  // namespace v0
}  // namespace polhode
