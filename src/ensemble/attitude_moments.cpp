// SPDX-License-Identifier: MIT
#include "polhode/ensemble/attitude_moments.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ensemble/detail/attitude_sums.hpp"
#include "ensemble/detail/number_list.hpp"
#include "ensemble/detail/resultant.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::AttitudeSums;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Where M_ij, j >= i, stands.
constexpr int place(int i, int j) { return i * (7 - i) / 2 + j; }
static_assert(place(3, 3) == 9);

}  // namespace

void AttitudeMoments::add(std::int64_t member, const Quaternion& q) {
  auto all = AttitudeSums::products(q.w, q.x, q.y, q.z);
  if (!(std::abs(all.square - 1.0) <= AttitudeSums::unit_slack)) {
    const Quaternion unit = normalized(q);
    all = AttitudeSums::products(unit.w, unit.x, unit.y, unit.z);
    if (!(all.square > 0.5 && all.square < 2.0)) return left_out_.add(member);
    for (double& p : all.p) p /= all.square;
  }
  for (int k = 0; k < 10; ++k) sums_[k] += all.p[k];
  ++count_;
}

void AttitudeMoments::add(std::int64_t first, std::span<const RotorState> states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    double sums[10];  // in registers while all is usual
    std::copy_n(sums_, 10, sums);
    const std::size_t begin = i;
    for (; i < states.size(); ++i) {
      const Quaternion& q = states[i].q;
      const auto all = AttitudeSums::products(q.w, q.x, q.y, q.z);
      if (!(std::abs(all.square - 1.0) <= AttitudeSums::unit_slack)) break;
      for (int k = 0; k < 10; ++k) sums[k] += all.p[k];
    }
    std::copy_n(sums, 10, sums_);
    count_ += static_cast<std::int64_t>(i - begin);
    if (i < states.size()) add(first + static_cast<std::int64_t>(i), states[i].q);
  }
}

void AttitudeMoments::merge(const AttitudeMoments& later) {
  for (int k = 0; k < 10; ++k) sums_[k] += later.sums_[k];
  count_ += later.count_;
  left_out_.merge(later.left_out_);
}

double AttitudeMoments::moment(int i, int j) const {
  const int low = std::min<int>(i, j), high = std::max<int>(i, j);
  if (low < 0 || high > 3)
    throw DomainError("AttitudeMoments::moment: got components " + std::to_string(i) + " and " +
                      std::to_string(j) + "; expected 0 to 3");
  return count_ == 0 ? nan : sums_[place(low, high)] / static_cast<double>(count_);
}

PrincipalAttitudes AttitudeMoments::principal() const {
  PrincipalAttitudes found;
  if (count_ == 0) {
    found.values.fill(nan);
    found.axes.fill({nan, nan, nan, nan});
    return found;
  }
  Eigen::Matrix4d M;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) M(i, j) = moment(i, j);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(M);
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector4d v = solver.eigenvectors().col(3 - k);
    const double sign = v(0) < 0.0 ? -1.0 : 1.0;
    const auto at = static_cast<std::size_t>(k);
    found.values[at] = solver.eigenvalues()(3 - k);
    found.axes[at] = normalized(Quaternion{sign * v(0), sign * v(1), sign * v(2), sign * v(3)});
  }
  return found;
}

std::optional<Quaternion> AttitudeMoments::mean() const {
  if (count_ == 0) return std::nullopt;
  const PrincipalAttitudes p = principal();
  const double r = (p.values[0] - p.values[1]) / (p.values[0] + p.values[1]);
  if (!detail::tells_a_mean(r, static_cast<double>(count_))) return std::nullopt;
  return p.axes[0];
}

double AttitudeMoments::concentration() const { return (4.0 * principal().values[0] - 1.0) / 3.0; }

std::vector<double> AttitudeMoments::numbers() const {
  std::vector<double> all{static_cast<double>(count_)};
  detail::append(all, sums_);
  detail::append(all, left_out_.numbers());
  return all;
}

AttitudeMoments AttitudeMoments::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("AttitudeMoments::restored", numbers);
  AttitudeMoments found;
  found.count_ = reader.integer();
  for (double& sum : found.sums_) {
    sum = reader.number();
    if (!(std::abs(sum) <= 1.001 * static_cast<double>(found.count_)))
      reader.refuse("a sum of products of " + std::to_string(found.count_) + " unit quaternions");
  }
  found.left_out_ = LeftOut(reader);
  reader.finish();
  return found;
}

}  // namespace v0
}  // namespace polhode
