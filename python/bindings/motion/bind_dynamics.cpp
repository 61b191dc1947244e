// SPDX-License-Identifier: MIT
// Methods, events, problems, and the functions that integrate them. A problem is made of Python
// objects, which become one of C++ for the time of a run.

#include <chrono>
#include <functional>
#include <optional>

#include "charts/states.hpp"
#include "interface/choice.hpp"
#include "interface/records.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "motion/dynamics_values.hpp"
#include "motion/frame_value.hpp"
#include "motion/samples.hpp"
#include "motion/system_value.hpp"
#include "motion/trajectory_value.hpp"
#include "polhode/dynamics/free_events.hpp"
#include "polhode/dynamics/integrate.hpp"
#include "polhode/error.hpp"

namespace polhode::python {

namespace {

using Rotors = Batch<RotorState>;

// A condition has no zero: as a number it would jump from 0 to 1, and never be an event.
void require_no_truth(nb::handle value, const std::string& label) {
  const std::string kind = class_name(value);
  if (kind != "bool" && kind != "bool_") return;  // NumPy 1 writes the latter
  throw nb::type_error(
      (label + ": the function returned a bool; expected a number that is zero at the event")
          .c_str());
}

}  // namespace

// The objects outlive the run, which copies the function without the GIL: hence a bare pointer.
Event event_of(const PythonEvent& event) {
  const auto function = [f = event.function.ptr(), label = "event \"" + event.name + "\""](
                            double t, const SystemState& s) {
    const WithGil acquired;
    const nb::object value = staying_put([&] { return nb::handle(f)(t, Rotors::one(s)); });
    if (!PyFloat_Check(value.ptr())) require_no_truth(value, label);
    return number(value, label.c_str());
  };
  return {event.name, function, event.crossing, event.stops, event.period, event.interval};
}

Problem problem_of(const PythonProblem& p) {
  const System& system = nb::cast<const PythonSystem&>(p.system);
  const RotorState& s = nb::cast<const Rotors&>(p.initial)[0];
  Problem problem{system,     {s.q, s.g, p.damper_rate}, p.start, p.stop, method_of(p.method), {},
                  p.continues};
  for (const nb::handle event : p.events)
    problem.events.push_back(event_of(nb::cast<const PythonEvent&>(event)));
  return problem;
}

Problem problem_without_events(const PythonProblem& p) {
  Problem problem = problem_of(p);
  problem.events.clear();
  return problem;
}

void warn_of(const Outcome& outcome, const char* function) {
  if (outcome.ok()) return;
  const std::string t = number_text(outcome.t);
  const std::string text =
      std::string(function) + ": the run failed at t = " + t + ": " + outcome.advice;
  constexpr Py_ssize_t caller = 2;  // of the wrapper (python/polhode/_signatures.py)
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text.c_str(), caller) != 0) throw nb::python_error();
}

namespace {

using ProgressFunction = Typed<"collections.abc.Callable[[float], object]">;
using SinkFunction = Typed<"collections.abc.Callable[..., object]">;
using EventFunction = Typed<"collections.abc.Callable[[EventRecord], object]">;
using CheckpointFunction = Typed<"collections.abc.Callable[[Checkpoint], object]">;

// Signals, then the caller's function.
Progress listener(nb::handle progress) {
  Progress look = signal_check(), report = progress_to(progress);
  if (!report) return look;
  return [look, report](double t) {
    if (look) look(t);
    report(t);
  };
}

PyObject* function_in(nb::handle value, const char* name) {
  if (value.is_none()) return nullptr;
  if (PyCallable_Check(value.ptr()) == 0)
    throw nb::type_error((std::string(name) + ": expected a function").c_str());
  return value.ptr();  // the objects outlive the run
}

// A block of samples as sink(t, states): its own memory.
// Of a system with a damper, sink(t, states, rates).
void give_block(PyObject* sink, std::span<const Sample> block, bool with_damper) {
  const WithGil acquired;
  staying_put([&] {
    Result times({block.size()});
    for (std::size_t k = 0; k < block.size(); ++k) *times.at(k) = block[k].t;
    const Rotors states = Rotors::filled({block.size()}, [&](RotorState* out) {
      for (std::size_t k = 0; k < block.size(); ++k) out[k] = block[k].s;
    });
    if (!with_damper) return nb::handle(sink)(times.take(), states);
    Result rates({block.size()}, {3});
    for (std::size_t k = 0; k < block.size(); ++k) put(rates.at(k), block[k].s.damper_rate);
    return nb::handle(sink)(times.take(), states, rates.take());
  });
}

struct StreamArguments {
  nb::handle samples;
  nb::handle sink;
  nb::handle events;
  nb::handle checkpoint;
  double checkpoint_seconds;
};

Streams streams_of(const StreamArguments& arguments, bool with_damper) {
  Streams streams;
  if (PyObject* const sink = function_in(arguments.sink, "sink"))
    streams.samples = [sink, with_damper](std::span<const Sample> block) {
      give_block(sink, block, with_damper);
    };
  if (PyObject* const events = function_in(arguments.events, "events"))
    streams.events = [events](const EventRecord& event) {
      const WithGil acquired;
      staying_put([&] { return nb::handle(events)(event); });
    };
  PyObject* const checkpoint = function_in(arguments.checkpoint, "keep_checkpoint");
  if (checkpoint == nullptr) return streams;
  using Clock = std::chrono::steady_clock;
  const std::chrono::duration<double> pause(arguments.checkpoint_seconds);
  streams.checkpoint_due = [pause, last = Clock::now(), calls = 0](double) mutable {
    if (++calls % 16 != 0 || Clock::now() - last < pause) return false;
    last = Clock::now();
    return true;
  };
  streams.checkpoint = [checkpoint](const Checkpoint& now) {
    const WithGil acquired;
    staying_put([&] { return nb::handle(checkpoint)(now); });
  };
  return streams;
}

PythonTrajectory streamed(const PythonProblem& python_problem, const StreamArguments& arguments,
                          nb::handle progress, const Checkpoint* from) {
  if (arguments.samples.is_none())
    throw nb::type_error("integrate: samples: got None; expected a SaveAt or times for a sink");
  const Problem problem = problem_of(python_problem);
  const SaveAt times = save_at_of(arguments.samples, "samples");
  const Streams streams = streams_of(arguments, problem.system.damper().has_value());
  const Progress look = listener(progress);
  Trajectory trajectory = [&] {
    const WithoutGil released;
    return from == nullptr ? integrate(problem, times, streams, look)
                           : resume(problem, times, *from, streams, look);
  }();
  warn_of(trajectory.outcome(), from == nullptr ? "integrate" : "resume");
  return PythonTrajectory(std::move(trajectory));
}

PythonTrajectory integrated(const PythonProblem& python_problem,
                            Typed<"SaveAt | numpy.typing.ArrayLike"> samples, bool dense,
                            const ProgressFunction& progress, const SinkFunction& sink,
                            const EventFunction& events, const CheckpointFunction& checkpoint,
                            double checkpoint_seconds, double most_bytes) {
  if (!(most_bytes > 0.0))
    throw nb::value_error(
        ("integrate: most_bytes: got " + number_text(most_bytes) + "; expected a positive number")
            .c_str());
  if (!sink.is_none())
    return streamed(python_problem, {samples, sink, events, checkpoint, checkpoint_seconds},
                    progress, nullptr);
  if (!events.is_none() || !checkpoint.is_none())
    throw nb::type_error("integrate: events and keep_checkpoint go with a sink; got sink None");
  const Problem problem = problem_of(python_problem);
  Keep keep{.dense = dense, .most_bytes = most_bytes};
  if (!samples.is_none()) keep.samples = save_at_of(samples, "samples");
  const Progress look = listener(progress);
  Trajectory trajectory = [&] {
    const WithoutGil released;
    return integrate(problem, keep, look);
  }();
  warn_of(trajectory.outcome(), "integrate");
  return PythonTrajectory(std::move(trajectory),
                          dense ? nb::object(python_problem.system) : nb::object());
}

PythonTrajectory resumed(const PythonProblem& python_problem,
                         Typed<"SaveAt | numpy.typing.ArrayLike"> samples, const Checkpoint& from,
                         const SinkFunction& sink, const ProgressFunction& progress,
                         const EventFunction& events, const CheckpointFunction& checkpoint,
                         double checkpoint_seconds) {
  return streamed(python_problem, {samples, sink, events, checkpoint, checkpoint_seconds}, progress,
                  &from);
}

std::vector<EventRecord> free_events_of(const FreeRotation& motion,
                                        Typed<"collections.abc.Iterable[Event]"> events,
                                        double start, double stop, Typed<"Frame"> frame,
                                        const ProgressFunction& progress) {
  const nb::tuple all = events_of(events, "free_events");
  std::vector<Event> wanted;
  for (const nb::handle event : all)
    wanted.push_back(event_of(nb::cast<const PythonEvent&>(event)));
  if (!frame.is_none() && !nb::isinstance<PythonFrame>(frame))
    throw nb::type_error(
        ("free_events: frame: got " + class_name(frame) + "; expected a Frame").c_str());
  const Frame seen_from =
      frame.is_none() ? Frame::inertial() : Frame(nb::cast<const PythonFrame&>(frame));
  const Progress look = listener(progress);
  FreeEvents found = [&] {
    const WithoutGil released;
    return free_events(motion, wanted, start, stop, seen_from, look);
  }();
  warn_of(found.outcome, "free_events");
  return std::move(found.events);
}

void bind_free_events(nb::module_& m) {
  m.def("free_events", free_events_of, "motion"_a, "events"_a, "start"_a, "stop"_a,
        "frame"_a = nb::none(), nb::kw_only(), "progress"_a = nb::none(),
        R"(The events of a free rotation, found on its closed form: nothing is integrated.

Parameters
----------
motion : FreeRotation, in inertial axes.
events : Events, in any number; as those of a Problem.
start, stop : either may be the larger, and both as far from the motion's epoch as may be: the work
    is that of the turns between them.
frame : a Frame from which the motion is seen; None: inertial axes.
progress : called as progress(t), some ten times a second.

Returns
-------
list of EventRecord
    In order of time, up to the first event that stops. A RuntimeWarning where an event was NaN.

Releases the GIL; Ctrl-C raises KeyboardInterrupt. What an event raises passes through.)");
}

void bind_checkpoint(nb::module_& m) {
  const auto made = [](Checkpoint* self, const nb::bytes& bytes) {
    new (self) Checkpoint(std::string(bytes.c_str(), bytes.size()));
  };
  const auto bytes = [](const Checkpoint& c) {
    return nb::bytes(c.bytes().data(), c.bytes().size());
  };
  nb::class_<Checkpoint>(m, "Checkpoint",
                         R"(A run between two steps, to the last bit: integrate gives it out.

resume goes on from it. Checkpoint(bytes) takes what .bytes gave, from a file perhaps.
ValueError for other bytes.)")
      .def("__init__", made, "bytes"_a)
      .def_prop_ro("bytes", bytes, "All of it, to keep.")
      .def_prop_ro("t", &Checkpoint::t, "Where the run stood.")
      .def("__eq__", [](const Checkpoint& a, const Checkpoint& b) { return a == b; })
      .def("__eq__", [](const Checkpoint&, nb::handle) { return false; })
      .def("__hash__", [](const Checkpoint& c) { return std::hash<std::string>()(c.bytes()); })
      .def("__repr__",
           [](const Checkpoint& c) { return "<Checkpoint: t = " + number_text(c.t()) + ">"; })
      .def("__getstate__", bytes)
      .def("__setstate__", made);
  m.def("resume", resumed, "problem"_a, "samples"_a, "checkpoint"_a, "sink"_a, nb::kw_only(),
        "progress"_a = nb::none(), "events"_a = nb::none(), "keep_checkpoint"_a = nb::none(),
        "checkpoint_seconds"_a = 60.0,
        R"(The rest of a run of `integrate` with a sink, from a checkpoint of it.

Parameters
----------
problem, samples : those of the run. Functions in Python cannot be compared; the rest is.
checkpoint : where it goes on.
sink, progress, events, checkpoint_seconds : as in integrate.
keep_checkpoint : as in integrate.

Returns
-------
Trajectory
    Without samples; outcome and statistics are those of the whole run. What the sinks of both
    parts get, one behind the other, is what that of the straight run gets, to the last bit.

ValueError for a checkpoint of another problem, saying what differs.)");
}

struct TransitionRows : Records<TransitionSample> {
  using Rows = Records<TransitionSample>;
};

TransitionRows transition_rows(const PythonProblem& python_problem,
                               Typed<"SaveAt | numpy.typing.ArrayLike"> samples) {
  const Problem problem = problem_without_events(python_problem);
  const SaveAt times = save_at_of(samples, "samples");
  const Progress look = signal_check();
  const WithoutGil released;
  return {Records(state_transitions(problem, times, look))};
}

void bind_transitions(nb::module_& m) {
  nb::class_<TransitionRows> c(m, "TransitionSamples",
                               R"(States along a run, with their derivatives by the first one.

.t (N,), .states (RotorState, shape (N,)), .transition (N, 6, 6): read-only views without a copy.
Rows and columns of a matrix are (dtheta_B, dg_B): a small rotation of the body about its axes
(rad), and the change of the momentum along them.)");
  using S = TransitionSample;
  def_records<S>(c, {{"t", [](const S& s) { return &s.t; }, "(N,): the times."},
                     {"transition",
                      [](const S& s) { return &s.transition.a[0][0]; },
                      "(N, 6, 6): the state transition matrices.",
                      {6, 6}}});
  def_pickle(c);
  c.def_prop_ro(
       "states",
       [](const TransitionRows& r) {
         return r.states<RotorState>([](const S& s) -> const RotorState& { return s.s; });
       },
       "The states, of shape (N,).")
      .def("__repr__", [](const TransitionRows& r) {
        return "<TransitionSamples: " + std::to_string(r.rows().size()) + " samples>";
      });
  m.def("state_transitions", transition_rows, "problem"_a, "samples"_a,
        R"(The state transition matrix along a run.

Parameters
----------
problem : its events are not looked for.
samples : SaveAt, or times (N,) from start towards stop.

Adaptive and VariationOfConstants: by the variational equations. Collocation and Splitting: the
derivative of their own steps, of a splitting symplectic; terms of a splitting must be kicks.
ValueError for a run that cannot go on, and for a term in Python on floats alone (TorqueTerm).
Ctrl-C raises KeyboardInterrupt.)");
}

}  // namespace

void bind_dynamics(nb::module_& m) {
  bind_dynamics_values(m);
  m.def("integrate", integrated, "problem"_a, "samples"_a = nb::none(), "dense"_a = true,
        nb::kw_only(), "progress"_a = nb::none(), "sink"_a = nb::none(), "events"_a = nb::none(),
        "keep_checkpoint"_a = nb::none(), "checkpoint_seconds"_a = 60.0, "most_bytes"_a = 1e9,
        R"(Integrates the equations of motion of a problem, by its method.

Parameters
----------
problem : what to integrate.
samples : SaveAt, or times (N,) in the order of the run; None: the end of every step. Times
    outside the span are left out.
dense : whether trajectory.at(t) shall answer for any t; some hundred bytes a step.
progress : called as progress(t), some ten times a second.
sink : called as sink(t, states) with blocks of at most 1024 samples, (N,) and a RotorState of shape
    (N,); of a system with a damper as sink(t, states, rates), (N, 3). The trajectory then has no
    samples and no dense output: memory does not grow.
events : with a sink: called with every EventRecord, which the trajectory then does not keep.
keep_checkpoint : with a sink: called with a Checkpoint every `checkpoint_seconds`. What it raises
    ends the run; `resume` goes on from there.
most_bytes : of memory for dense output, and for samples at the end of every step. A run that needs
    more fails there, and keeps what it has.

Returns
-------
Trajectory
    Also of a run that could not go on (NaN, a step too small): with its samples so far, an
    outcome that says what to try, and a RuntimeWarning.

Raises
------
ValueError
    For what is no problem (NaN, a splitting of a term without a flow), or samples out of order.

Releases the GIL; Ctrl-C raises KeyboardInterrupt. What an event or a term in Python raises passes
through. [SA (24), (118), (124)])");
  bind_free_events(m);
  bind_checkpoint(m);
  bind_transitions(m);
}

}  // namespace polhode::python
