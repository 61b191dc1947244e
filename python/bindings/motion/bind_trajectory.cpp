// SPDX-License-Identifier: MIT
// What a run leaves behind: samples as views onto the memory of C++, events, outcome, cost.
#include <nanobind/ndarray.h>

#include "charts/states.hpp"
#include "interface/object_slots.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "io/columns.hpp"
#include "motion/samples.hpp"
#include "motion/system_value.hpp"
#include "motion/trajectory_value.hpp"
#include "polhode/error.hpp"
#include "polhode/trajectory/save_at.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode::python {

namespace {

using ColumnNames = Typed<"str | collections.abc.Sequence[str]">;

using Rotors = Batch<RotorState>;
// The state of a pickle that has one.
const RotorState& only(const Rotors& state) {
  if (!state.shape().empty()) throw nb::value_error("a pickle of several states; expected one");
  return state[0];
}

// "failed at t = 3.5: what to try"
std::string text_of(const Outcome& outcome) {
  if (outcome.status == Outcome::Status::completed) return "completed";
  const std::string where = " at t = " + number_text(outcome.t);
  return outcome.ok() ? "stopped by an event" + where : "failed" + where + ": " + outcome.advice;
}

// start, stop, step, rows and the times of a list: what made it. A step of 0 is a count.
using SaveAtParts = std::tuple<double, double, double, std::int64_t, std::vector<double>>;

SaveAtParts parts_of(const SaveAt& s) {
  std::vector<double> times;
  for (std::int64_t k = 0; s.is_list() && k < s.size(); ++k) times.push_back(s[k]);
  return {s.start(), s.stop(), s.step(), s.size(), std::move(times)};
}

SaveAt made_of(const SaveAtParts& parts) {
  const auto& [start, stop, step, rows, times] = parts;
  if (!times.empty() || rows == 0) return SaveAt::times(times);
  return step == 0.0 ? SaveAt::count(start, stop, rows) : SaveAt::steps(start, stop, step);
}

void bind_save_at(nb::module_& m) {
  nb::class_<SaveAt>(m, "SaveAt", R"(The times of the samples of a run.

Made by steps, count or times; a sequence of floats. A time is rounded once, never accumulated.)")
      .def_static("steps", &SaveAt::steps, "start"_a, "stop"_a, "step"_a,
                  "start + k step up to stop; step leads from start towards stop, either way.")
      .def_static("count", &SaveAt::count, "start"_a, "stop"_a, "rows"_a,
                  "rows times from start to stop, both included.")
      .def_static(
          "times", [](ArrayLike times) { return save_at_of(times, "times"); }, "times"_a,
          "The times themselves, (N,), in the order of the run.")
      .def("__len__", &SaveAt::size)
      .def(
          "__getitem__",
          [](const SaveAt& s, std::int64_t k) {
            const std::int64_t at = k < 0 ? k + s.size() : k;
            if (at < 0 || at >= s.size())
              throw nb::index_error(
                  ("SaveAt: row " + std::to_string(k) + " of " + std::to_string(s.size())).c_str());
            return s[at];
          },
          "k"_a)
      .def("__copy__", [](const SaveAt& s) { return s; })
      .def(
          "__deepcopy__", [](const SaveAt& s, nb::handle) { return s; }, "memo"_a)
      .def("__getstate__", parts_of)
      .def("__setstate__",
           [](SaveAt& s, const SaveAtParts& parts) { new (&s) SaveAt(made_of(parts)); })
      .def(
          "__eq__", [](const SaveAt& a, const SaveAt& b) { return parts_of(a) == parts_of(b); },
          nb::is_operator(), "other"_a)
      .def("__hash__",
           [](const SaveAt& s) { return nb::hash(nb::make_tuple(s.start(), s.stop(), s.size())); })
      .def("__repr__", [](const SaveAt& s) {
        const std::string rows = "<SaveAt: " + std::to_string(s.size()) + " times";
        if (s.size() == 0) return rows + ">";
        return rows + " from " + number_text(s[0]) + " to " + number_text(s[s.size() - 1]) + ">";
      });
}

void bind_outcome(nb::module_& m) {
  nb::class_<Outcome> c(m, "Outcome", "How a run ended. Only `completed` reached its end.");
  nb::enum_<Outcome::Status>(c, "Status", "How a run ended.", nb::is_arithmetic())
      .value("completed", Outcome::Status::completed, "it reached the end asked for")
      .value("stopped_by_event", Outcome::Status::stopped_by_event, "an event that stops was met")
      .value("failed", Outcome::Status::failed, "it could not go on: see advice");
  c.def(
       "__init__",
       [](Outcome* self, OneOf<Outcome::Status> status, double t, const std::string& advice) {
         new (self) Outcome{choice<Outcome::Status>(status, "status"), t, advice};
       },
       "status"_a, "t"_a, "advice"_a = "")
      .def_ro("status", &Outcome::status, "Which of the three.")
      .def_ro("t", &Outcome::t, "Where it ended.")
      .def_ro("advice", &Outcome::advice, "Of a run that failed: what happened, and what to try.")
      .def_prop_ro("ok", &Outcome::ok, "Whether it did not fail.")
      .def("__repr__", [](const Outcome& o) { return "<Outcome: " + text_of(o) + ">"; });
  def_value(c, [](const Outcome& o) { return nb::make_tuple(o.status, o.t, o.advice); });
}

void bind_statistics(nb::module_& m) {
  using S = Statistics;
  bind_value<S>(m, "Statistics", "What a run cost.", field("steps", &S::steps, "Steps accepted."),
                field("rejected", &S::rejected, "Steps tried, and repeated shorter."),
                field("evaluations", &S::evaluations,
                      "Evaluations of the terms, all of them together counted once."));
}

SystemState state_of(const Rotors& s, nb::handle damper_rate) {
  const RotorState& rotor = only(s);
  return {rotor.q, rotor.g, vec3(damper_rate, "damper_rate")};
}

void bind_event_record(nb::module_& m) {
  nb::class_<EventRecord>(m, "EventRecord", "A crossing that the function of an event met.")
      .def_ro("name", &EventRecord::name, "Of the event.")
      .def_ro("t", &EventRecord::t, "When it was.")
      .def_prop_ro(
          "s", [](const EventRecord& e) { return Rotors::one(e.s); }, "The state there.")
      .def_ro("direction", &EventRecord::direction,
              "1: rising as time ran; -1: falling; 0: a touch.")
      .def_prop_ro(
          "damper_rate", [](const EventRecord& e) { return array_of(e.s.damper_rate); },
          "(3,): rate of a damper there.")
      .def("__repr__",
           [](const EventRecord& e) {
             return "<EventRecord: " + e.name + " at t = " + number_text(e.t) +
                    (e.direction > 0 ? ", rising>"
                                     : (e.direction < 0 ? ", falling>" : ", touching>"));
           })
      .def("__getstate__",
           [](const EventRecord& e) {
             return nb::make_tuple(e.name, e.t, Rotors::one(e.s), e.direction,
                                   array_of(e.s.damper_rate));
           })
      .def("__setstate__",
           [](EventRecord& e,
              const std::tuple<std::string, double, Rotors, int, nb::object>& state) {
             const auto& [name, t, s, direction, rate] = state;
             new (&e) EventRecord{name, t, state_of(s, rate), direction};
           });
}

Rotors states_of(const PythonTrajectory& trajectory) {
  return trajectory.states<RotorState>([](const Sample& s) -> const RotorState& { return s.s; });
}

// As many states as times, in as long as it takes: Ctrl-C ends it.
Rotors states_at(const PythonTrajectory& trajectory, ArrayLike times) {
  constexpr std::size_t few = 16;  // not worth giving up the GIL
  const Numbers t(times, "t");
  const std::size_t n = size_of(t.shape());
  return Rotors::filled(t.shape(), [&](RotorState* out) {
    if (n <= few) {
      for (std::size_t k = 0; k < n; ++k) out[k] = trajectory.run.at(t[k]);
      return;
    }
    const Progress look = signal_check();
    const WithoutGil released;
    for (std::size_t k = 0; k < n; ++k) {
      out[k] = trajectory.run.at(t[k]);
      if (look) look(t[k]);
    }
  });
}

FloatArray damper_rates_at(const PythonTrajectory& trajectory, ArrayLike times) {
  const Numbers t(times, "t");
  Result rates(t.shape(), {3});
  for_each(size_of(t.shape()),
           [&](std::size_t k) { put(rates.at(k), trajectory.run.at(t[k]).damper_rate); });
  return rates.take();
}

Typed<"dict[str, numpy.typing.NDArray[numpy.float64]]"> columns_of_trajectory(
    const PythonTrajectory& self, ColumnNames names, Typed<"System"> system) {
  const Trajectory& trajectory = self.run;
  nb::dict table;
  table["t"] = self.column([](const Sample& s) { return &s.t; });
  const nb::object states = nb::cast(states_of(self));
  const auto put_columns = [&](const nb::object& array, std::initializer_list<const char*> of) {
    int i = 0;
    for (const char* name : of) table[name] = array[nb::make_tuple(nb::ellipsis(), i++)];
  };
  put_columns(states.attr("q"), {"qw", "qx", "qy", "qz"});
  put_columns(states.attr("g"), {"g1", "g2", "g3"});
  std::vector<std::string> wanted = names_of(names);
  std::erase_if(wanted, [&](const std::string& name) {
    return name == "q" || name == "g" || table.contains(name.c_str());
  });
  if (wanted.empty()) return table;
  if (system.is_none())
    throw nb::value_error(("columns: \"" + wanted.front() + "\" needs system=").c_str());
  const System& of = system_of(system, "columns: system");
  const double start = trajectory.start();
  const SystemState initial = trajectory.at(start);
  const double initial_energy =
      any_needs_energy(wanted)
          ? energy(of.damper() ? at_damper_rate(of, initial.damper_rate) : of, start, initial)
          : 0.0;
  for (const auto& [name, numbers] : columns_of(of, self.rows(), wanted, initial_energy))
    if (!table.contains(name)) table[name] = numbers;
  return table;
}

// Without dense output, which is the method's own: at() says so afterwards.
nb::tuple trajectory_state(const PythonTrajectory& self) {
  const Trajectory& run = self.run;
  const SystemState initial = run.at(run.start());
  return nb::make_tuple(self.bytes(), run.start(), Rotors::one(initial),
                        array_of(initial.damper_rate), run.events(), run.outcome(),
                        run.statistics(), run.method());
}
using State = std::tuple<nb::bytes, double, Rotors, nb::object, std::vector<EventRecord>, Outcome,
                         Statistics, std::string>;
void restore(PythonTrajectory& trajectory, const State& state) {
  const auto& [rows, start, initial, rate, events, outcome, statistics, method] = state;
  new (&trajectory) PythonTrajectory(Trajectory({.initial = {start, state_of(initial, rate)},
                                                 .samples = Records<Sample>(rows).rows(),
                                                 .events = events,
                                                 .outcome = outcome,
                                                 .statistics = statistics,
                                                 .method = method,
                                                 .dense = {}}));
}

std::string shown(const PythonTrajectory& trajectory) {
  const Trajectory& r = trajectory.run;
  std::string text = "<Trajectory: " + counted(trajectory.rows().size(), "sample") +
                     ", t = " + number_text(r.start()) + " to " + number_text(r.stop()) + "; " +
                     r.method() + ", " + std::to_string(r.statistics().steps) + " steps; ";
  if (!r.events().empty()) text += counted(r.events().size(), "event") + "; ";
  return text + text_of(r.outcome()) + ">";
}

// polhode._tables, which knows pandas and xarray, makes the table.
nb::object table_of(const PythonTrajectory& self, const char* kind, ColumnNames names,
                    Typed<"System"> system) {
  const Trajectory& trajectory = self.run;
  nb::dict notes;
  notes["method"] = trajectory.method();
  notes["outcome"] = text_of(trajectory.outcome());
  return nb::module_::import_("polhode._tables")
      .attr(kind)(columns_of_trajectory(self, names, system), notes);
}

void bind_tables(nb::class_<PythonTrajectory>& c) {
  c.def("columns", columns_of_trajectory, "names"_a = nb::make_tuple(), "system"_a = nb::none(),
        R"(Columns by name, each (N,): t, qw ... qz, g1 ... g3, then those asked for.

Parameters
----------
names : groups ("andoyer", "omega", "energy") or single columns ("theta"), named as in
    scenario files; a name that is both, as "g", is the group.
system : of the run; needed for anything but t, q, g.

The library is scale-free: rad and the run's own unit of time. Components of vectors are along
the principal axes. "dE" is E less that at the start. ValueError for an unknown name.)");
  c.def(
      "to_pandas",
      [](const PythonTrajectory& self, ColumnNames columns, Typed<"System"> system)
          -> Typed<"pandas.DataFrame"> { return table_of(self, "to_pandas", columns, system); },
      "columns"_a = nb::none(), "system"_a = nb::none(),
      "The columns (see columns()) as a pandas.DataFrame, with index t; method and outcome in "
      ".attrs.");
  c.def(
      "to_xarray",
      [](const PythonTrajectory& self, ColumnNames columns, Typed<"System"> system)
          -> Typed<"xarray.Dataset"> { return table_of(self, "to_xarray", columns, system); },
      "columns"_a = nb::none(), "system"_a = nb::none(),
      "The columns (see columns()) as an xarray.Dataset along t; method and outcome in .attrs.");
}

}  // namespace

void bind_trajectory(nb::module_& m) {
  bind_save_at(m);
  bind_outcome(m);
  bind_statistics(m);
  bind_event_record(m);
  nb::class_<PythonTrajectory> c(
      m, "Trajectory",
      R"(What a run leaves: samples, events, outcome, cost.

Made by integrate. .t (N,), .q (N, 4), .g (N, 3) and .states (RotorState of shape (N,)) are
read-only views onto the samples, without a copy; they keep the samples alive. q and g refer to the
reference frame and the principal axes. A pickle holds everything but dense output.)",
      nb::type_slots(object_slots<PythonTrajectory, &PythonTrajectory::system>()));
  using S = Sample;
  def_records<S>(c, {{"t", [](const S& s) { return &s.t; }, "(N,): times of the samples."},
                     {"q",
                      [](const S& s) { return &s.s.q.w; },
                      "(N, 4): attitudes (w, x, y, z), body to frame.",
                      {4}},
                     {"g",
                      [](const S& s) { return &s.s.g.x; },
                      "(N, 3): angular momenta along the principal axes.",
                      {3}},
                     {"damper_rate",
                      [](const S& s) { return &s.s.damper_rate.x; },
                      "(N, 3): rates of a damper relative to the body, along the principal axes.",
                      {3}}});
  c.def_prop_ro("states", states_of, "The samples as a RotorState of shape (N,).")
      .def("damper_rate_at", damper_rates_at, "t"_a,
           "(..., 3): the same at times of any shape, as at(t).")
      .def("at", states_at, "t"_a,
           R"(The states at times of any shape, by the dense output of the method.

ValueError outside [start, stop], and for a run without dense output. Releases the GIL.)")
      .def_prop_ro(
          "events", [](const PythonTrajectory& r) { return r.run.events(); },
          "The crossings met, in the order of the run.")
      .def_prop_ro(
          "outcome", [](const PythonTrajectory& r) { return r.run.outcome(); },
          "How the run ended.")
      .def_prop_ro(
          "statistics", [](const PythonTrajectory& r) { return r.run.statistics(); },
          "What the run cost.")
      .def_prop_ro(
          "method", [](const PythonTrajectory& r) { return r.run.method(); },
          "The method, in words.")
      .def_prop_ro(
          "start", [](const PythonTrajectory& r) { return r.run.start(); }, "Where the run began.")
      .def_prop_ro(
          "stop", [](const PythonTrajectory& r) { return r.run.stop(); },
          "Where the run really ended.")
      .def_prop_ro(
          "has_dense", [](const PythonTrajectory& r) { return r.run.has_dense(); },
          "Whether at(t) has an answer inside.")
      .def("__repr__", shown)
      .def("__getstate__", trajectory_state)
      .def("__setstate__", restore);
  bind_tables(c);
}

}  // namespace polhode::python
