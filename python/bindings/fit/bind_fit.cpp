// SPDX-License-Identifier: MIT
// What all fits share, and fits of snapshots.
#include "fit/bind_fit.hpp"

#include <utility>

#include "fit/spin_problem.hpp"

namespace polhode::python {

namespace {

const char* end_word(fit::LeastSquaresResult::End end) {
  switch (end) {
    case fit::LeastSquaresResult::End::converged:
      return "converged";
    case fit::LeastSquaresResult::End::no_descent:
      return "no_descent";
    case fit::LeastSquaresResult::End::iteration_limit:
      return "iteration_limit";
    case fit::LeastSquaresResult::End::no_value:
      break;
  }
  return "no_value";
}

// (numbers, derivatives or None), or None where there is no value.
nb::object residuals_at(const PythonResiduals& of, const ArrayLike& x, bool derivatives) {
  const std::size_t n = of.function.unknowns(), m = of.function.size();
  const Numbers at(x, "x", {n});
  if (!at.shape().empty())
    throw nb::value_error(("x: expected (" + std::to_string(n) + ",), the unknowns").c_str());
  Result numbers({m}), jacobian({derivatives ? m : 0, n});
  bool has_value = false;
  {
    const WithoutGil released;
    has_value = of.function.at({at.at(0), n}, {numbers.at(0), m},
                               {jacobian.at(0), derivatives ? m * n : 0});
  }
  if (!has_value) return nb::none();
  if (!derivatives) return nb::make_tuple(numbers.take(), nb::none());
  return nb::make_tuple(numbers.take(), jacobian.take());
}

// (name, start, low, high) of each unknown.
nb::list unknowns_of(const PythonResiduals& of) {
  nb::list list;
  for (const fit::Unknown& u : of.function.problem().unknowns)
    list.append(nb::make_tuple(u.name, u.start, u.low, u.high));
  return list;
}

nb::object triangle_of(const PythonResiduals& of) {
  const auto& triangle = of.function.problem().triangle;
  if (!triangle) return nb::none();
  return nb::make_tuple(triangle->a, triangle->b);
}

void bind_residuals(nb::module_& m) {
  nb::class_<PythonResiduals>(m, "_Residuals")
      .def("at", residuals_at)
      .def_prop_ro("unknowns", unknowns_of)
      .def_prop_ro("triangle", triangle_of)
      .def_prop_ro("data", [](const PythonResiduals& of) { return of.function.data(); })
      .def_prop_ro("size", [](const PythonResiduals& of) { return of.function.size(); })
      .def("state", [](const PythonResiduals& of, const ArrayLike& x) {
        const std::size_t n = of.function.unknowns();
        const Numbers at(x, "x", {n});
        return of.state({at.at(0), n});
      });
}

Mat3 matrix_at(const double* x) {
  Mat3 m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = x[i];
  return m;
}

fit::Snapshots snapshots_of(nb::handle attitudes, nb::handle directions, nb::handle rates) {
  fit::Snapshots seen;
  seen.attitudes = rows_of_table<fit::ObservedAttitude>(
      attitudes, "attitudes", 14, [](const double* x) -> fit::ObservedAttitude {
        return {x[0], {x[1], x[2], x[3], x[4]}, matrix_at(x + 5)};
      });
  seen.directions = rows_of_table<fit::ObservedDirection>(
      directions, "directions", 8, [](const double* x) -> fit::ObservedDirection {
        return {x[0], vector_at(x + 1), vector_at(x + 4), x[7]};
      });
  seen.rates = rows_of_table<fit::ObservedRate>(rates, "rates", 13,
                                                [](const double* x) -> fit::ObservedRate {
                                                  return {x[0], vector_at(x + 1), matrix_at(x + 4)};
                                                });
  return seen;
}

using Prior = std::tuple<std::vector<std::string>, std::vector<double>, std::vector<double>>;

SpinProblem spin_problem(const nb::tuple& start, const nb::tuple& seen,
                         const std::vector<std::string>& unknowns, const std::vector<Prior>& priors,
                         const nb::object& attitude_prior, const std::string& loss, double scale,
                         double error_factor, bool scales_errors, int most_iterations) {
  fit::SpinFit fit;
  fit.start = spin_of(start);
  fit.seen = snapshots_of(seen[0], seen[1], seen[2]);
  fit.unknowns = {false, false, false, false};
  for (const std::string& name : unknowns) {
    bool& which = name == "attitude"  ? fit.unknowns.attitude
                  : name == "rate"    ? fit.unknowns.rate
                  : name == "moments" ? fit.unknowns.moment_ratios
                                      : fit.unknowns.products;
    which = true;
  }
  for (const auto& [names, mean, covariance] : priors)
    fit.priors.push_back({names, mean, covariance});
  if (!attitude_prior.is_none()) {
    const Numbers row(attitude_prior, "attitude_prior", {13});
    const double* const x = row.at(0);
    fit.attitude_prior = fit::ObservedAttitude{0.0, {x[0], x[1], x[2], x[3]}, matrix_at(x + 4)};
  }
  fit.loss = loss_of(loss, scale);
  fit.error_factor = error_factor;
  fit.scales_errors = scales_errors;
  fit.most_iterations = most_iterations;
  return {fit};
}

nb::tuple fitted(const SpinProblem& problem) {
  fit::SpinSolution found;
  {
    const WithoutGil released;
    found = fit::fit_spin(problem.fit);
  }
  nb::dict parts = solution_dict(found);
  return nb::make_tuple(parts, FoundSpinSolution{std::move(found)});
}

// (q, w, covariances) at some times.
nb::tuple predicted_at(const SpinProblem& problem, const FoundSpinSolution& found,
                       const ArrayLike& times) {
  const Numbers t(times, "times");
  const std::size_t n = size_of(t.shape());
  const std::vector<fit::PredictedAttitude> all =
      fit::predicted(problem.fit, found.solution, {t.at(0), n});
  Result q({n}, {4}), w({n}, {3}), covariance({n}, {3, 3});
  for (std::size_t k = 0; k < n; ++k) {
    put(q.at(k), all[k].q);
    put(w.at(k), all[k].w_F);
    put(covariance.at(k), all[k].covariance);
  }
  return nb::make_tuple(q.take(), w.take(), covariance.take());
}

PythonResiduals residuals_of(const SpinProblem& problem) {
  const auto& [fit, drive] = problem;
  return {fit::ResidualFunction(drive ? fit::least_squares_of(fit, *drive)
                                      : fit::least_squares_of(fit)),
          [problem](std::span<const double> x) -> nb::object {
            return spin_parts(problem.drive ? fit::state_at(problem.fit, *problem.drive, x)
                                            : fit::state_at(problem.fit, x));
          }};
}

constexpr std::pair<const char*, fit::Loss::Kind> loss_kinds[] = {
    {"squared", fit::Loss::Kind::squared},
    {"huber", fit::Loss::Kind::huber},
    {"soft_l1", fit::Loss::Kind::soft_l1},
    {"cauchy", fit::Loss::Kind::cauchy}};

}  // namespace

fit::Loss loss_of(const std::string& kind, double scale) {
  for (const auto& [name, value] : loss_kinds)
    if (kind == name) return {value, scale};
  throw nb::value_error(
      ("loss: got '" + kind + "'; expected one of squared huber soft_l1 cauchy").c_str());
}

nb::tuple loss_parts(const fit::Loss& loss) {
  const char* word = "";
  for (const auto& [name, kind] : loss_kinds)
    if (kind == loss.kind) word = name;
  return nb::make_tuple(word, loss.scale);
}

fit::SpinState spin_of(const nb::tuple& parts) {
  return {nb::cast<double>(parts[0]), quaternion(parts[1], "q"), vec3(parts[2], "w"),
          mat3(parts[3], "inertia")};
}

nb::tuple spin_parts(const fit::SpinState& s) {
  return nb::make_tuple(s.t0, array_of(s.q), array_of(s.w_F), array_of(s.inertia_F));
}

nb::dict dict_of(const fit::LeastSquaresResult& result, const fit::UnknownsCovariance& covariance,
                 double degrees_of_freedom, const std::vector<std::string>& notes) {
  nb::dict d;
  d["names"] = nb::tuple(nb::cast(covariance.names));
  d["values"] = array_of(std::span<const double>(result.x));
  d["covariance"] = array_of(std::span<const double>(covariance.matrix));
  d["residuals"] = array_of(std::span<const double>(result.numbers));
  d["chi_square"] = result.chi_square;
  d["cost"] = result.cost;
  d["degrees_of_freedom"] = degrees_of_freedom;
  d["iterations"] = result.iterations;
  d["evaluations"] = result.evaluations;
  d["end"] = end_word(result.end);
  d["sentence"] = result.sentence;
  nb::list bound;
  for (const std::size_t k : result.bound) bound.append(covariance.names.at(k));
  d["bound"] = nb::tuple(bound);
  d["notes"] = nb::tuple(nb::cast(notes));
  return d;
}

nb::dict solution_dict(const fit::SpinSolution& found) {
  nb::dict d = dict_of(found.result, found.covariance, found.degrees_of_freedom, found.notes);
  d["state"] = spin_parts(found.state);
  d["error_factor"] = found.error_factor;
  d["attitude_rms"] = found.attitude_rms;
  return d;
}

void bind_spin_fit(nb::module_& m) {
  const nb::class_<FoundSpinSolution> found(m, "_FoundSpinSolution");
  nb::class_<SpinProblem>(m, "_SpinProblem")
      .def("fit", fitted)
      .def("predicted", predicted_at)
      .def("residuals", residuals_of);
  m.def("_spin_problem", spin_problem, "start"_a, "seen"_a, "unknowns"_a, "priors"_a,
        "attitude_prior"_a.none(), "loss"_a, "scale"_a, "error_factor"_a, "scales_errors"_a,
        "most_iterations"_a);
}

void bind_fit(nb::module_& m) {
  bind_residuals(m);
  bind_spin_fit(m);
  bind_light_fit(m);
  bind_scan(m);
  bind_scenario_fit(m);
  bind_light_scenario_fit(m);
}

}  // namespace polhode::python
