// SPDX-License-Identifier: MIT
// Prescribed torques: constant in the body or in space, or interpolated in a table.
#include "polhode/perturb/torque_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/constant_torque.hpp"

namespace polhode {
inline namespace v0 {

ConstantTorque::ConstantTorque(const Vec3& u, std::optional<SpaceAxes> axes) : u_(u), axes_(axes) {
  if (!std::isfinite(u.x) || !std::isfinite(u.y) || !std::isfinite(u.z))
    throw DomainError("ConstantTorque: torque " + detail::tuple_text({u.x, u.y, u.z}) +
                      " must be finite");
}

ConstantTorque ConstantTorque::in_body(const Vec3& u_B) { return {u_B, std::nullopt}; }

ConstantTorque ConstantTorque::in_space(const Vec3& u, SpaceAxes axes) { return {u, axes}; }

namespace {

using detail::number_text;

std::vector<TorqueRow> checked(std::vector<TorqueRow> rows) {
  if (rows.empty()) throw DomainError("TorqueTable: rows must not be empty");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TorqueRow& row = rows[i];
    if (!std::isfinite(row.t) || !std::isfinite(row.torque.x) || !std::isfinite(row.torque.y) ||
        !std::isfinite(row.torque.z))
      throw DomainError("TorqueTable: row " + std::to_string(i + 1) + " " +
                        detail::tuple_text({row.t, row.torque.x, row.torque.y, row.torque.z}) +
                        " must be finite");
    if (i > 0 && !(row.t > rows[i - 1].t))
      throw DomainError("TorqueTable: time " + number_text(row.t) + " of row " +
                        std::to_string(i + 1) + " must be later than " +
                        number_text(rows[i - 1].t) + " of the row before");
  }
  return rows;
}

// The weighted harmonic mean of the slopes on both sides, 0 at an extremum.
double inner_slope(double h0, double h1, double d0, double d1) {
  if (!(d0 * d1 > 0.0)) return 0.0;
  const double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

// The parabola's slope at the first of three rows, made to keep the shape.
double end_slope(double h0, double h1, double d0, double d1) {
  const double d = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (!(d * d0 > 0.0)) return 0.0;
  if (!(d0 * d1 > 0.0) && std::abs(d) > 3.0 * std::abs(d0)) return 3.0 * d0;
  return d;
}

// Every row where the pieces on both sides are not the same polynomial.
std::vector<double> breaks_of(const std::vector<TorqueRow>& rows, const TorqueTable::Rules& rules) {
  using Between = TorqueTable::Between;
  const Vec3 none;
  std::vector<double> breaks;
  const std::size_t last = rows.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const Vec3& u = rows[k].torque;
    const bool first_of_zero = k == 0 && rules.outside == TorqueTable::Outside::zero && u == none;
    bool smooth = false;
    if (rules.between == Between::step) {
      smooth = first_of_zero || (k > 0 && k < last && u == rows[k - 1].torque) ||
               (k == 0 && rules.outside == TorqueTable::Outside::hold);
    } else if (k > 0 && k < last) {
      smooth = u == rows[k - 1].torque && u == rows[k + 1].torque;
    }
    if (!smooth) breaks.push_back(rows[k].t);
  }
  return breaks;
}

}  // namespace

TorqueTable::TorqueTable(std::vector<TorqueRow> rows, const Rules& rules)
    : rows_(std::make_shared<const std::vector<TorqueRow>>(checked(std::move(rows)))),
      breaks_(std::make_shared<const std::vector<double>>(breaks_of(*rows_, rules))),
      rules_(rules) {}

TorqueTable::Piece TorqueTable::piece(double t) const {
  const std::vector<TorqueRow>& rows = *rows_;
  const bool before = t<rows.front().t, after = t> rows.back().t;
  if (before || after) {
    const TorqueRow& row = before ? rows.front() : rows.back();
    if (rules_.outside == Outside::refuse)
      throw DomainError("TorqueTable: time " + number_text(t) + " is " +
                        (before ? "before the first row, " : "after the last row, ") +
                        number_text(row.t) + ": give rows for all of the run, or outside = zero " +
                        "or hold");
    return {row.t, {rules_.outside == Outside::hold ? row.torque : Vec3{}, {}, {}, {}}};
  }
  const auto next = std::upper_bound(rows.begin(), rows.end(), t,
                                     [](double x, const TorqueRow& row) { return x < row.t; });
  const auto k = static_cast<std::size_t>(next - rows.begin()) - 1;
  // NaN comes here too, and stays NaN by its s
  return inner_piece(std::min(k, rows.size() - 1));
}

TorqueTable::Piece TorqueTable::inner_piece(std::size_t k) const {
  const std::vector<TorqueRow>& rows = *rows_;
  const TorqueRow& a = rows[k];
  if (k + 1 == rows.size()) {  // at the last row, or NaN
    return {a.t, {a.torque, {}, {}, {}}};
  }
  if (rules_.between == Between::step) return {a.t, {a.torque, {}, {}, {}}};
  const double h = rows[k + 1].t - a.t;
  const Vec3 mean = (1.0 / h) * (rows[k + 1].torque - a.torque);
  if (rules_.between == Between::linear) return {a.t, {a.torque, mean, {}, {}}};
  const Vec3 m0 = slope(k), m1 = slope(k + 1);
  return {a.t,
          {a.torque, m0, (1.0 / h) * (3.0 * mean - 2.0 * m0 - m1),
           (1.0 / (h * h)) * (m0 + m1 - 2.0 * mean)}};
}

Vec3 TorqueTable::slope(std::size_t k) const {
  const std::vector<TorqueRow>& rows = *rows_;
  const std::size_t last = rows.size() - 1;
  const auto length = [&](std::size_t i) { return rows[i + 1].t - rows[i].t; };
  const auto mean = [&](std::size_t i) {
    return (1.0 / length(i)) * (rows[i + 1].torque - rows[i].torque);
  };
  if (last == 1) return mean(0);
  Vec3 m;
  for (int i = 0; i < 3; ++i) {
    if (k == 0)
      m[i] = end_slope(length(0), length(1), mean(0)[i], mean(1)[i]);
    else if (k == last)
      m[i] = end_slope(length(k - 1), length(k - 2), mean(k - 1)[i], mean(k - 2)[i]);
    else
      m[i] = inner_slope(length(k - 1), length(k), mean(k - 1)[i], mean(k)[i]);
  }
  return m;
}

}  // namespace v0
}  // namespace polhode
