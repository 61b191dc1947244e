// SPDX-License-Identifier: MIT
// The runs of many problems, on threads.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include "interface/plain_number.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "io/work_loop.hpp"
#include "motion/dynamics_values.hpp"
#include "motion/samples.hpp"
#include "motion/trajectory_value.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/ensemble/executor.hpp"
#include "polhode/error.hpp"

namespace polhode::python {
namespace {

struct Bodies {
  std::vector<Problem> problems;
  std::vector<nb::object> systems;
};

Bodies bodies_of(nb::handle problems) {
  Bodies bodies;
  for (const nb::handle each : problems) {
    if (!nb::isinstance<PythonProblem>(each))
      throw nb::type_error(
          ("integrate_many: problems: got " + class_name(each) + " among them; expected Problem")
              .c_str());
    const auto& problem = nb::cast<const PythonProblem&>(each);
    bodies.problems.push_back(problem_of(problem));
    bodies.systems.emplace_back(problem.system);
  }
  return bodies;
}

// What a body has come to: a Trajectory or an exception, and why it failed.
class Collected {
 public:
  Collected(const Bodies& bodies, bool dense)
      : bodies_(bodies), dense_(dense), results_(bodies.problems.size()) {}

  // Without the GIL. An interrupt ends the runs of all.
  void take(std::size_t k, BodyRun run) {
    const WithGil acquired;
    if (run.thrown) {
      failed(run.error);
      results_[k] = exception_of(run);
      return;
    }
    const Outcome& outcome = run.trajectory->outcome();
    if (!outcome.ok())
      failed("body " + std::to_string(k) + " at t = " + number_text(outcome.t) + ": " +
             outcome.advice);
    results_[k] = nb::cast(
        PythonTrajectory(std::move(*run.trajectory), dense_ ? bodies_.systems[k] : nb::object()));
  }
  nb::list list() const {
    nb::list all;
    for (const nb::object& each : results_) all.append(each);
    return all;
  }
  void warn() const {
    if (failures_ == 0) return;
    const std::string text = "integrate_many: " + std::to_string(failures_) + " of " +
                             std::to_string(results_.size()) + " runs failed; the first was " +
                             first_;
    constexpr Py_ssize_t caller = 2;  // of the wrapper (python/polhode/_signatures.py)
    if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), caller) != 0) throw nb::python_error();
  }

 private:
  void failed(const std::string& why) {
    if (failures_++ == 0) first_ = why;
  }
  static nb::object exception_of(const BodyRun& run) {
    try {
      std::rethrow_exception(run.thrown);
    } catch (const nb::python_error& e) {
      if (!e.matches(PyExc_Exception)) throw;
      return nb::borrow(e.value());
    } catch (const DomainError&) {
      return nb::module_::import_("polhode._core").attr("DomainError")(run.error);
    } catch (const std::bad_alloc&) {
      return nb::borrow(PyExc_MemoryError)(run.error);
    } catch (...) {
      return nb::borrow(PyExc_RuntimeError)(run.error);
    }
  }

  const Bodies& bodies_;
  bool dense_;
  std::vector<nb::object> results_;
  std::size_t failures_ = 0;
  std::string first_;
};

// True if the problem may call functions in Python. On several threads each call would wait for the
// GIL.
bool asks_python(const Problem& problem) {
  const std::vector<AnyPerturbation>& terms = problem.system.terms();
  return !problem.events.empty() ||
         std::any_of(terms.begin(), terms.end(),
                     [](const AnyPerturbation& term) { return !term.is_asked_together(); });
}

void integrate_on_threads(const std::vector<Problem>& problems, const Keep& keep,
                          const std::function<void(std::size_t, BodyRun)>& take) {
  WorkLoop loop("integrate_many was stopped");
  std::vector<BodyRun> runs(problems.size());
  const auto count = static_cast<std::int64_t>(runs.size());
  loop.do_work([&] {
    ensemble::ordered_parallel_for(
        0, count, ensemble::hardware_threads(),
        [&](std::int64_t index) {
          const auto k = static_cast<std::size_t>(index);
          runs[k] = integrate_body(k, problems[k], keep, [&loop](double) { loop.go_on(); });
          return k;
        },
        [&](std::int64_t, std::size_t k) { take(k, std::move(runs[k])); });
  });
}

nb::list integrated_many(Typed<"collections.abc.Iterable[Problem]"> problems,
                         Typed<"SaveAt | numpy.typing.ArrayLike"> samples, bool dense) {
  const Bodies bodies = bodies_of(problems);
  Keep keep{.dense = dense};
  if (!samples.is_none()) keep.samples = save_at_of(samples, "samples");
  Collected collected(bodies, dense);
  const auto take = [&](std::size_t k, BodyRun run) { collected.take(k, std::move(run)); };
  if (std::any_of(bodies.problems.begin(), bodies.problems.end(), asks_python)) {
    const Progress look = signal_check();
    const WithoutGil released;
    integrate_many(
        bodies.problems.size(), [&](std::size_t k) { return bodies.problems[k]; }, keep, take,
        look);
  } else {
    integrate_on_threads(bodies.problems, keep, take);
  }
  collected.warn();
  return collected.list();
}

}  // namespace

void bind_many(nb::module_& m) {
  m.def("integrate_many", integrated_many, "problems"_a, "samples"_a = nb::none(),
        "dense"_a = false,
        R"(Integrates many problems, one on each processor at a time.

One after the other where any has events, or a term in Python that is called state by state.

Parameters
----------
problems : Problem of each body.
samples : SaveAt, or times (N,) in the order of the runs, the same for all; None: the end of every
    step.
dense : whether trajectory.at(t) shall answer for any t.

Returns
-------
list of Trajectory
    That of integrate for each problem, to the last bit, in their order. A body that fails leaves
    the others as they are: a run that could not go on is a Trajectory whose outcome says so; in
    the place of one that is invalid, or whose term raised something, is the exception. One
    RuntimeWarning tells how many failed, and why the first did.

Releases the GIL; Ctrl-C raises KeyboardInterrupt. [SA (24), (118), (124)])");
}

}  // namespace polhode::python
