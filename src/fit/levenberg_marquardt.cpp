// SPDX-License-Identifier: MIT
#include "fit/detail/levenberg_marquardt.hpp"

#include <unsupported/Eigen/LevenbergMarquardt>

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {
namespace {

using Status = Eigen::LevenbergMarquardtSpace::Status;

// The relative reduction of the sum of squares, and of the step, that is no longer worth a step.
constexpr double least_reduction = 1e-13, least_step = 1e-14;
// What stands for a number without a value: its step is not taken.
constexpr double beyond = 1e150;
// Numbers this small are rounding: in standard errors.
constexpr double exact = 1e-11;
// Trial steps, in units of iterations.
constexpr int trials = 10;

struct Functor : Eigen::DenseFunctor<double> {
  Functor(const Numbers& f, std::size_t inputs, std::size_t values)
      : DenseFunctor(static_cast<int>(inputs), static_cast<int>(values)),
        numbers(f),
        y(inputs),
        rows(inputs * values) {}

  bool evaluate(const InputType& at, ValueType& f, double* jacobian) {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = at[static_cast<Eigen::Index>(i)];
    return numbers(y, f.data(), jacobian) && f.allFinite();
  }
  int operator()(const InputType& at, ValueType& f) {
    if (!evaluate(at, f, nullptr)) f.setConstant(beyond);
    return 0;
  }
  int df(const InputType& at, JacobianType& jacobian) {
    ValueType f(values());
    if (!evaluate(at, f, rows.data())) return -1;
    using RowByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    jacobian = Eigen::Map<const RowByRow>(rows.data(), values(), inputs());
    return jacobian.allFinite() ? 0 : -1;
  }

  // Of the variables, each times the length of its column: the unit of the method's steps. 0
  // without derivatives.
  double scaled_length(const InputType& at) {
    JacobianType jacobian(values(), inputs());
    if (df(at, jacobian) != 0) return 0.0;
    double sum = 0.0;
    for (Eigen::Index j = 0; j < at.size(); ++j) {
      const double length = jacobian.col(j).norm();
      const double scaled = (length == 0.0 ? 1.0 : length) * at[j];  // as the method has it
      sum += scaled * scaled;
    }
    return std::sqrt(sum);
  }

  const Numbers& numbers;
  std::vector<double> y;
  std::vector<double> rows;
};

Descent::End end_of(Status status) {
  switch (status) {
    case Status::RelativeReductionTooSmall:
    case Status::RelativeErrorTooSmall:
    case Status::RelativeErrorAndReductionTooSmall:
    case Status::CosinusTooSmall:
    case Status::FtolTooSmall:
    case Status::XtolTooSmall:
    case Status::GtolTooSmall:
      return Descent::End::small_step;
    case Status::TooManyFunctionEvaluation:
      return Descent::End::iteration_limit;
    default:
      return Descent::End::no_value;
  }
}

}  // namespace

Descent levenberg_marquardt(const Numbers& f, const Within& is_within, std::size_t numbers,
                            std::vector<double> y, int most_iterations, double first_step) {
  Functor functor(f, y.size(), numbers);
  Eigen::LevenbergMarquardt<Functor> method(functor);
  method.setFtol(least_reduction);
  method.setXtol(least_step);
  method.setMaxfev(static_cast<Eigen::Index>(trials) * most_iterations);
  Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(y.data(), std::ssize(y));
  Descent found;
  if (first_step > 0.0) {
    const double scaled = functor.scaled_length(at);
    method.setFactor(scaled > 0.0 ? first_step / scaled : first_step);
  }
  Status status = method.minimizeInit(at);
  if (status != Status::ImproperInputParameters && method.fnorm() < beyond) {
    status = Status::Running;
    const double least = exact * std::sqrt(static_cast<double>(numbers));
    const auto ends_within = [&] {
      for (std::size_t i = 0; i < y.size(); ++i) y[i] = at[static_cast<Eigen::Index>(i)];
      return is_within(y);
    };
    bool stays = true;
    // at most most_iterations, each of few trials
    while (stays && status == Status::Running && found.iterations < most_iterations) {
      if (method.fnorm() <= least) break;
      status = method.minimizeOneStep(at);
      ++found.iterations;
      stays = ends_within();
    }
    const bool has_value = status == Status::Running || end_of(status) != Descent::End::no_value;
    found.end = !stays && has_value         ? Descent::End::on_bound
                : status != Status::Running ? end_of(status)
                : method.fnorm() <= least   ? Descent::End::small_step
                                            : Descent::End::iteration_limit;
  }
  found.evaluations = static_cast<int>(method.nfev());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = at[static_cast<Eigen::Index>(i)];
  found.y = std::move(y);
  return found;
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
