// SPDX-License-Identifier: MIT
// Mean attitudes and the spread about them, one member at a time or many on SIMD packs.
#include "ensemble/attitude_moments.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ensemble/attitude_spread.hpp"
#include "ensemble/detail/attitude_sums.hpp"
#include "ensemble/detail/moment_sums.hpp"
#include "ensemble/detail/number_list.hpp"
#include "polhode/detail/math/trigonometry.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

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

namespace {

using detail::SpreadSums;
constexpr double no_spread = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_passes = 50;

// A lane of its own for one attitude, so that it has the bits of many.
using One = Pack<InstructionSet::baseline>;

bool is_finite(const Quaternion& q) {
  return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
}

Quaternion unit_reference(const Quaternion& q) {
  const Quaternion unit = normalized(q);
  if (!is_finite(unit))
    throw DomainError("AttitudeSpread: reference " +
                      polhode::detail::tuple_text({q.w, q.x, q.y, q.z}) +
                      " is no attitude; expected a finite quaternion other than 0");
  return unit;
}

Eigen::Matrix3d symmetric(const double* triangle) {
  Eigen::Matrix3d A;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) A(i, j) = A(j, i) = *triangle++;
  return A;
}
Mat3 rows(const Eigen::Matrix3d& A) {
  Mat3 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = A(i, j);
  return m;
}
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d A;
  A << 0.0, -v(2), v(1), v(2), 0.0, -v(0), -v(1), v(0), 0.0;
  return A;
}

// r exp(d / 2), w >= 0
Quaternion turned(const Quaternion& r, const Eigen::Vector3d& d) {
  const double half = 0.5 * d.norm();
  const double s = half == 0.0 ? 0.5 : 0.5 * std::sin(half) / half;
  const Quaternion q = normalized(r * Quaternion{std::cos(half), s * d(0), s * d(1), s * d(2)});
  return q.w < 0.0 ? Quaternion{-q.w, -q.x, -q.y, -q.z} : q;
}

// What bounds the derivatives of J within an angle: docs/design/0039-statistics.md.
struct Bend {
  double second;   // |F''| <= second |d|^2
  double c;        // (1 - h) / theta^2
  double stretch;  // |J|

  explicit Bend(double theta) {
    if (theta < 1e-3) {  // the leading terms, rounded up
      second = 0.42 * theta;
      c = 0.0834;
      stretch = 1.0 + theta;
      return;
    }
    const double half = 0.5 * theta, sine = std::sin(half);
    const double cotangent = std::cos(half) / sine, h = half * cotangent;
    const double slope = 0.5 * cotangent - 0.5 * half / (sine * sine);  // of h
    c = (1.0 - h) / (theta * theta);
    stretch = half / sine;
    second = 0.25 * theta + 0.5 * (1.0 - h) + std::abs(slope + 2.0 * (1.0 - h) / theta) +
             2.0 * (1.0 - h) / theta * stretch;
  }
};

}  // namespace

AttitudeSpread::AttitudeSpread(const Quaternion& reference)
    : reference_(unit_reference(reference)) {}

void AttitudeSpread::add(std::int64_t member, const Quaternion& given) {
  const One r[4] = {reference_.w, reference_.x, reference_.y, reference_.z};
  const auto turn_to = [&](const Quaternion& q) {
    const One numbers[4] = {q.w, q.x, q.y, q.z};
    return SpreadSums::turn<InstructionSet::baseline>(r, numbers);
  };
  auto turn = turn_to(given);
  const double square = turn.square.lanes[0];
  if (!(square > SpreadSums::least_square && square < SpreadSums::most_square)) {
    const Quaternion unit = normalized(given);
    if (!is_finite(unit)) return left_out_.add(member);
    turn = turn_to(unit);
  }
  SpreadSums::Sums<One> sums;
  SpreadSums::each(*this, sums, [](const double& from, One& to) { to = One(from); });
  SpreadSums::add(sums, turn, One(static_cast<double>(member)));
  SpreadSums::each(*this, sums, [](double& to, const One& from) { to = from.lanes[0]; });
}

void AttitudeSpread::add(std::int64_t first, std::span<const RotorState> states) {
  for (const RotorState& s : states) add(first++, s.q);
}

void AttitudeSpread::merge(const AttitudeSpread& later) {
  if (!(later.reference_ == reference_)) {
    const auto text = [](const Quaternion& q) {
      return polhode::detail::tuple_text({q.w, q.x, q.y, q.z});
    };
    throw DomainError("AttitudeSpread::merge: got moments about " + text(later.reference_) +
                      "; expected about " + text(reference_));
  }
  left_out_.merge(later.left_out_);
  if (later.count_ == 0.0) return;
  if (count_ == 0.0) {
    std::copy_n(later.mean_, 3, mean_);
    std::copy_n(later.products_, 6, products_);
  } else {
    detail::merge_moments(later.mean_, later.products_, later.count_, 3, count_, mean_, products_);
  }
  for (int k = 0; k < 6; ++k) bend_[k] += later.bend_[k];
  count_ += later.count_;
  if (later.farthest_ > farthest_) {
    farthest_ = later.farthest_;
    farthest_member_ = later.farthest_member_;
  }
}

Vec3 AttitudeSpread::mean_vector() const {
  return count_ == 0.0 ? Vec3{no_spread, no_spread, no_spread} : Vec3{mean_[0], mean_[1], mean_[2]};
}

Mat3 AttitudeSpread::covariance() const {
  return rows(symmetric(products_) / (count_ < 2.0 ? no_spread : count_ - 1.0));
}

Extreme AttitudeSpread::farthest() const {
  return {count_ == 0.0 ? no_spread : farthest_, static_cast<std::int64_t>(farthest_member_)};
}

std::optional<FrechetMean> AttitudeSpread::frechet() const {
  if (count_ == 0.0) return std::nullopt;
  const Eigen::Vector3d m(mean_[0], mean_[1], mean_[2]);
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity(), products = symmetric(products_);
  const Eigen::Matrix3d bend = symmetric(bend_) / count_;
  const Eigen::Matrix3d hessian = one + bend - bend.trace() * one;
  const Eigen::Vector3d d = (hessian - 0.5 * cross_matrix(m)).partialPivLu().solve(m);
  // a right angle, as of two opposite attitudes, less rounding
  const double step = d.norm(), most = 0.5 * pi<double>() * (1.0 - 1e-9);
  const double mean_square = products.trace() / count_;
  if (!(mean_square < most * most) || !(step < pi<double>())) return std::nullopt;

  const Eigen::Matrix3d to_mean = one - 0.5 * cross_matrix(d);
  const Eigen::Matrix3d about_mean = to_mean * products * to_mean.transpose();
  FrechetMean found{turned(reference_, d),
                    rows(about_mean / (count_ < 2.0 ? no_spread : count_ - 1.0)), infinity,
                    infinity};
  // x + e: |F| <= K d^2 / 2 at x, and the Hessian stays above half of what it is at r
  const double lowest =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(hessian, Eigen::EigenvaluesOnly)
          .eigenvalues()(0);
  const double reach = farthest_ + 2.0 * step;
  if (!(reach < pi<double>() && lowest > 0.0)) return found;
  const Bend bound(reach);
  const double error = bound.second * step * step / lowest;
  if (!(error <= step && bound.second * (step + error) <= 0.5 * lowest)) return found;
  found.mean_error = error;
  const double of_each = bound.c * step * farthest_ * std::sqrt(mean_square + m.squaredNorm()) +
                         0.5 * bound.second * step * step + bound.stretch * error;
  const double width = (1.0 + 0.5 * step) * std::sqrt(mean_square);
  found.covariance_error =
      (2.0 * width + of_each) * of_each * (count_ < 2.0 ? no_spread : count_ / (count_ - 1.0));
  return found;
}

std::vector<double> AttitudeSpread::numbers() const {
  std::vector<double> all{reference_.w, reference_.x, reference_.y, reference_.z, count_};
  detail::append(all, mean_);
  detail::append(all, products_);
  detail::append(all, bend_);
  detail::append(all, std::vector{farthest_, farthest_member_});
  detail::append(all, left_out_.numbers());
  return all;
}

AttitudeSpread AttitudeSpread::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("AttitudeSpread::restored", numbers);
  AttitudeSpread found(reference_);
  Quaternion& r = found.reference_;
  for (double* x : {&r.w, &r.x, &r.y, &r.z}) *x = reader.number();
  if (!(std::abs(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z - 1.0) < 1e-12))
    reader.refuse("the last of a unit quaternion");
  found.count_ = static_cast<double>(reader.integer());
  reader.read(found.mean_);
  reader.read(found.products_);
  reader.read(found.bend_);
  found.farthest_ = reader.number();
  if (!(found.farthest_ <= 3.1416 && found.farthest_ >= (found.count_ == 0.0 ? -1.0 : 0.0)))
    reader.refuse("an angle up to pi, or -1 of none");
  found.farthest_member_ = static_cast<double>(reader.integer(-1));
  found.left_out_ = LeftOut(reader);
  reader.finish();
  return found;
}

std::optional<FrechetMean> frechet_mean(std::span<const RotorState> states) {
  AttitudeMoments moments;
  moments.add(0, states);
  if (moments.count() == 0) return std::nullopt;
  Quaternion x = moments.principal().axes[0];
  double before = infinity;
  for (int pass = 0; pass < most_passes; ++pass) {
    AttitudeSpread spread(x);
    spread.add(0, states);
    const auto found = spread.frechet();
    if (!found) return std::nullopt;
    const double step = 2.0 * norm(Vec3{(conj(x) * found->mean).x, (conj(x) * found->mean).y,
                                        (conj(x) * found->mean).z});
    if (step < 1e-14 || (step < 1e-12 && step >= before)) return found;
    before = step;
    x = found->mean;
  }
  return std::nullopt;
}

namespace {

// kernel<isa>(...) of the set, of rows that fit.
template <class Accumulator, class Kernels>
void added_in_lanes(std::span<Accumulator> epochs, std::int64_t first,
                    std::span<const RotorState> states, InstructionSet set,
                    const Kernels& kernels) {
  if (epochs.empty() ? !states.empty() : states.size() % epochs.size() != 0)
    throw DomainError("add_rows: got " + std::to_string(states.size()) + " states at " +
                      std::to_string(epochs.size()) + " epochs; expected as many, or a multiple");
  if (!supports(set))
    throw DomainError("add_rows: got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
  if (states.empty()) return;
  const auto add = [&](auto kernel) {
    kernel(epochs.data(), epochs.size(), first, states.data(), states.size() / epochs.size());
  };
#if defined(__x86_64__)
  if (set == InstructionSet::avx512)
    return add(kernels.template operator()<InstructionSet::avx512>());
  if (set == InstructionSet::avx2) return add(kernels.template operator()<InstructionSet::avx2>());
#endif
  add(kernels.template operator()<InstructionSet::baseline>());
}

}  // namespace

void add_rows(std::span<AttitudeMoments> epochs, std::int64_t first,
              std::span<const RotorState> states, InstructionSet set) {
  added_in_lanes(epochs, first, states, set,
                 []<InstructionSet isa>() { return &detail::add_attitude_rows<isa>; });
}

void add_rows(std::span<AttitudeSpread> epochs, std::int64_t first,
              std::span<const RotorState> states, InstructionSet set) {
  added_in_lanes(epochs, first, states, set,
                 []<InstructionSet isa>() { return &detail::add_spread_rows<isa>; });
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
