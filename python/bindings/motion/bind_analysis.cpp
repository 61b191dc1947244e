// SPDX-License-Identifier: MIT
// Indicators of chaos along a run.
#include "interface/records.hpp"
#include "interface/signals.hpp"
#include "interface/value.hpp"
#include "motion/dynamics_values.hpp"
#include "polhode/analysis/chaos_indicator.hpp"
#include "polhode/error.hpp"

namespace polhode::python {

namespace {

struct PythonIndicator : Records<analysis::ChaosSample> {
  using Rows = Records<analysis::ChaosSample>;
  analysis::DeviationBy by;
  Outcome outcome;
  Statistics statistics;
  std::string method;
  double momentum_scale;
  double mean_megno;  // at the last sample
  double lyapunov_time;
};

analysis::Deviation deviation_of(nb::handle value) {
  const Numbers six(value, "deviation", {6});
  if (!six.shape().empty()) throw nb::value_error("deviation: expected six numbers");
  const double* const d = six.at(0);
  return {{d[0], d[1], d[2]}, {d[3], d[4], d[5]}};
}

PythonIndicator indicator(const PythonProblem& python_problem,
                          Typed<"SaveAt | numpy.typing.ArrayLike"> samples, ArrayLike deviation,
                          double momentum_scale, double distance, bool neighbour) {
  const Problem problem = problem_without_events(python_problem);
  const SaveAt times =
      samples.is_none() ? SaveAt::times({problem.stop}) : save_at_of(samples, "samples");
  analysis::ChaosOptions options{
      .momentum_scale = momentum_scale, .distance = distance, .neighbour = neighbour};
  if (!deviation.is_none()) options.deviation = deviation_of(deviation);
  const Progress look = signal_check();
  analysis::ChaosIndicator found = [&] {
    const WithoutGil released;
    return analysis::chaos_indicator(problem, times, options, look);
  }();
  warn_of(found.outcome, "chaos_indicator");
  const double megno = found.mean_megno(), time = found.lyapunov_time();
  return {Records(std::move(found.samples)),
          found.by,
          found.outcome,
          found.statistics,
          found.method,
          found.momentum_scale,
          megno,
          time};
}

void bind_indicator_class(nb::module_& m) {
  nb::enum_<analysis::DeviationBy>(m, "DeviationBy", "How a deviation is carried along a run.",
                                   nb::is_arithmetic())
      .value("variational", analysis::DeviationBy::variational, "by the derivative of the motion")
      .value("neighbour", analysis::DeviationBy::neighbour,
             "as a second motion, brought back when far");
  using P = PythonIndicator;
  nb::class_<P> c(m, "ChaosIndicator", R"(How a deviation has grown along a run.

.t, .growth, .lyapunov, .megno, .mean_megno: (N,), read-only views, one number for each sample.
growth is ln(|d| / |d(0)|), lyapunov = growth / t its Lyapunov indicator (1/time), megno and
mean_megno those of Cincotta and Simo (2000): the mean tends to 2 for a regular motion, to half
the Lyapunov exponent times t for a chaotic one. Time counts from the start of the run.)");
  using S = analysis::ChaosSample;
  def_records<S>(c, {{"t", [](const S& s) { return &s.t; }, "(N,): the times."},
                     {"growth", [](const S& s) { return &s.growth; },
                      "(N,): ln of the length over that at the start."},
                     {"lyapunov", [](const S& s) { return &s.lyapunov; },
                      "(N,): growth over the time since the start."},
                     {"megno", [](const S& s) { return &s.megno; }, "(N,): MEGNO."},
                     {"mean_megno", [](const S& s) { return &s.mean_megno; },
                      "(N,): its mean over the run so far."}});
  def_pickle(c, &P::by, &P::outcome, &P::statistics, &P::method, &P::momentum_scale, &P::mean_megno,
             &P::lyapunov_time);
  c.def_ro("lyapunov_time", &P::lyapunov_time,
           "1 / lyapunov at the last sample; of a regular motion it grows with the run.")
      .def_ro("by", &P::by, "How the deviation was carried.")
      .def_ro("outcome", &P::outcome, "How the run ended.")
      .def_ro("statistics", &P::statistics, "What the run cost.")
      .def_ro("method", &P::method, "In words.")
      .def_ro("momentum_scale", &P::momentum_scale,
              "What changes of the momentum were compared with.")
      .def("__repr__", [](const P& p) {
        return "<ChaosIndicator: mean MEGNO " + number_text(p.mean_megno) + ", Lyapunov time " +
               number_text(p.lyapunov_time) + "; " + p.method + ">";
      });
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

Adaptive and VariationOfConstants: by the variational equations; Collocation and Splitting: by the
derivative of their steps. With a term on floats alone (TorqueTerm), and for a splitting of terms
that are no kicks: by a second motion; .by says so. Releases the GIL; Ctrl-C raises
KeyboardInterrupt. (Benettin et al. 1976; Cincotta and Simo 2000))");
}

}  // namespace polhode::python
