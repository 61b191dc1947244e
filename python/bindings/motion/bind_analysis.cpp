// SPDX-License-Identifier: MIT
// Indicators of chaos along a run.
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "motion/dynamics_values.hpp"
#include "motion/samples.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/error.hpp"

namespace polhode::python {

namespace {

using Self = nb::handle_t<ChaosIndicator>;

const ChaosIndicator& of(Self self) { return nb::cast<const ChaosIndicator&>(self); }

template <double ChaosSample::*field>
FloatArray column(Self self) {
  const std::vector<ChaosSample>& rows = of(self).samples;
  const double* first = rows.empty() ? nullptr : &(rows.front().*field);
  return view_of(first, rows.size(), sizeof(ChaosSample), {}, self);
}

Deviation deviation_of(nb::handle value) {
  const Numbers six(value, "deviation", {6});
  if (!six.shape().empty()) throw nb::value_error("deviation: expected six numbers");
  const double* const d = six.at(0);
  return {{d[0], d[1], d[2]}, {d[3], d[4], d[5]}};
}

ChaosIndicator indicator(const PythonProblem& python_problem,
                         Typed<"SaveAt | numpy.typing.ArrayLike"> samples, ArrayLike deviation,
                         double momentum_scale, double distance, bool neighbour) {
  const Problem problem = rotor_problem_of(python_problem, "chaos_indicator");
  const SaveAt times =
      samples.is_none() ? SaveAt::times({problem.stop}) : save_at_of(samples, "samples");
  ChaosOptions options{
      .momentum_scale = momentum_scale, .distance = distance, .neighbour = neighbour};
  if (!deviation.is_none()) options.deviation = deviation_of(deviation);
  const Progress look = signal_check();
  ChaosIndicator found = [&] {
    const WithoutGil released;
    return chaos_indicator(problem, times, options, look);
  }();
  warn_of(found.outcome, "chaos_indicator");
  return found;
}

nb::tuple pickled(Self self) {
  const ChaosIndicator& c = of(self);
  nb::list rows;
  for (const ChaosSample& row : c.samples)
    rows.append(nb::make_tuple(row.t, row.growth, row.lyapunov, row.megno, row.mean_megno));
  return nb::make_tuple(rows, c.by, c.outcome, c.statistics, c.method, c.momentum_scale);
}

using Row = std::tuple<double, double, double, double, double>;
void restore(ChaosIndicator& c, const std::tuple<std::vector<Row>, DeviationBy, Outcome, Statistics,
                                                 std::string, double>& state) {
  const auto& [rows, by, outcome, statistics, method, scale] = state;
  new (&c) ChaosIndicator{{}, by, outcome, statistics, method, scale};
  for (const auto& [t, growth, lyapunov, megno, mean] : rows)
    c.samples.push_back({t, growth, lyapunov, megno, mean});
}

void bind_indicator_class(nb::module_& m) {
  nb::enum_<DeviationBy>(m, "DeviationBy", "How a deviation is carried along a run.",
                         nb::is_arithmetic())
      .value("variational", DeviationBy::variational, "by the derivative of the motion")
      .value("neighbour", DeviationBy::neighbour, "as a second motion, brought back when far");
  nb::class_<ChaosIndicator> c(m, "ChaosIndicator", R"(How a deviation has grown along a run.

.t, .growth, .lyapunov, .megno, .mean_megno: (N,), read-only views, one number for each sample.
growth is ln(|d| / |d(0)|), lyapunov = growth / t its Lyapunov indicator (1/time), megno and
mean_megno those of Cincotta and Simo (2000): the mean tends to 2 for a regular motion, to half
the Lyapunov exponent times t for a chaotic one. Time counts from the start of the run.)");
  const auto def = [&](const char* name, FloatArray (*view)(Self), const char* doc) {
    c.def_prop_ro(name, view, doc);
  };
  def("t", column<&ChaosSample::t>, "(N,): the times.");
  def("growth", column<&ChaosSample::growth>, "(N,): ln of the length over that at the start.");
  def("lyapunov", column<&ChaosSample::lyapunov>, "(N,): growth over the time since the start.");
  def("megno", column<&ChaosSample::megno>, "(N,): MEGNO.");
  def("mean_megno", column<&ChaosSample::mean_megno>, "(N,): its mean over the run so far.");
  c.def_prop_ro("lyapunov_time", &ChaosIndicator::lyapunov_time,
                "1 / lyapunov at the last sample; of a regular motion it grows with the run.")
      .def_ro("by", &ChaosIndicator::by, "How the deviation was carried.")
      .def_ro("outcome", &ChaosIndicator::outcome, "How the run ended.")
      .def_ro("statistics", &ChaosIndicator::statistics, "What the run cost.")
      .def_ro("method", &ChaosIndicator::method, "In words.")
      .def_ro("momentum_scale", &ChaosIndicator::momentum_scale,
              "What changes of the momentum were compared with.")
      .def("__len__", [](const ChaosIndicator& self) { return self.samples.size(); })
      .def("__repr__",
           [](const ChaosIndicator& self) {
             return "<ChaosIndicator: mean MEGNO " + number_text(self.mean_megno()) +
                    ", Lyapunov time " + number_text(self.lyapunov_time()) + "; " + self.method +
                    ">";
           })
      .def("__copy__", [](Self self) { return self; })  // immutable
      .def(
          "__deepcopy__", [](Self self, nb::handle) { return self; }, "memo"_a)
      .def("__getstate__", pickled)
      .def("__setstate__", restore);
}

}  // namespace

void bind_analysis(nb::module_& m) {
  bind_indicator_class(m);
  m.def("chaos_indicator", indicator, "problem"_a, "samples"_a = nb::none(),
        "deviation"_a = nb::none(), "momentum_scale"_a = 0.0, "distance"_a = 1e-8,
        "neighbour"_a = false,
        R"(Lyapunov indicator and MEGNO along a run.

Parameters
----------
problem : its events are not looked for.
samples : SaveAt, or times (N,) from start towards stop; None: the stop alone.
deviation : (6,), at the start: a small turn about the body axes (rad) and a change of the momentum
    over its scale. Its length does not matter. None: one that lies along no axis.
momentum_scale : what a change of momentum is compared with; 0 takes |g| at the start.
distance : of a second motion, where there is one.
neighbour : take a second motion even where derivatives are there.

Returns
-------
ChaosIndicator
    Also of a run that could not go on, with its samples so far and a RuntimeWarning.

Adaptive and VariationOfConstants: by the variational equations; Splitting: by the derivative of
its steps. With a term on floats alone (TorqueTerm), and for a splitting of terms that are no
kicks: by a second motion; .by says so. Releases the GIL; Ctrl-C raises KeyboardInterrupt.
(Benettin et al. 1976; Cincotta and Simo 2000))");
}

}  // namespace polhode::python
