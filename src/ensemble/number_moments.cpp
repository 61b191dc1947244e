// SPDX-License-Identifier: MIT
// Moments of numbers and of angles.
#include "ensemble/number_moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ensemble/angle_moments.hpp"
#include "ensemble/detail/moment_sums.hpp"
#include "ensemble/detail/number_list.hpp"
#include "math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

namespace {

constexpr double no_moment = std::numeric_limits<double>::quiet_NaN();
// The numbers of a triangle stay few.
constexpr int most_numbers = 1000;

std::size_t checked_count(int size) {
  if (size < 1 || size > most_numbers)
    throw DomainError("NumberMoments: got " + std::to_string(size) +
                      " numbers a member; expected 1 to " + std::to_string(most_numbers));
  return static_cast<std::size_t>(size);
}

}  // namespace

NumberMoments::NumberMoments(int size) : size_(size) {
  const std::size_t k = checked_count(size);
  sums_.assign(k + k * (k + 1) / 2, 0.0);
  extremes_.assign(2 * k, {no_moment, -1});
}

void NumberMoments::add(std::int64_t member, std::span<const double> numbers) {
  const auto k = static_cast<std::size_t>(size_);
  if (numbers.size() != k)
    throw DomainError("NumberMoments::add: got " + std::to_string(numbers.size()) +
                      " numbers of member " + std::to_string(member) + "; expected " +
                      std::to_string(k));
  double zero = 0.0;  // NaN if one is not finite
  for (const double x : numbers) zero += x - x;
  if (zero != 0.0) return left_out_.add(member);
  ++count_;
  detail::add_to_any_moments(numbers.data(), k, 1.0 / static_cast<double>(count_), sums_.data(),
                             products());
  for (std::size_t i = 0; i < k; ++i) {
    Extreme &least = extremes_[2 * i], &greatest = extremes_[2 * i + 1];
    if (!(numbers[i] >= least.value)) least = {numbers[i], member};
    if (!(numbers[i] <= greatest.value)) greatest = {numbers[i], member};
  }
}

void NumberMoments::merge(const NumberMoments& later) {
  if (later.size_ != size_)
    throw DomainError("NumberMoments::merge: got moments of " + std::to_string(later.size_) +
                      " numbers; expected of " + std::to_string(size_));
  left_out_.merge(later.left_out_);
  if (later.count_ == 0) return;
  if (count_ == 0) {
    sums_ = later.sums_;
    extremes_ = later.extremes_;
  } else {
    detail::merge_moments(later.sums_.data(), later.products(), static_cast<double>(later.count_),
                          static_cast<std::size_t>(size_), static_cast<double>(count_),
                          sums_.data(), products());
    for (std::size_t i = 0; i < extremes_.size(); i += 2) {
      if (later.extremes_[i].value < extremes_[i].value) extremes_[i] = later.extremes_[i];
      if (later.extremes_[i + 1].value > extremes_[i + 1].value)
        extremes_[i + 1] = later.extremes_[i + 1];
    }
  }
  count_ += later.count_;
}

std::size_t NumberMoments::checked(const char* function, int i) const {
  if (i < 0 || i >= size_)
    throw DomainError("NumberMoments::" + std::string(function) + ": got number " +
                      std::to_string(i) + "; expected 0 to " + std::to_string(size_ - 1));
  return static_cast<std::size_t>(i);
}

double NumberMoments::mean(int i) const {
  const std::size_t k = checked("mean", i);
  return count_ == 0 ? no_moment : sums_[k];
}

double NumberMoments::covariance(int i, int j) const {
  const std::size_t a = checked("covariance", std::max<int>(i, j));
  const std::size_t b = checked("covariance", std::min<int>(i, j));
  return count_ < 2 ? no_moment : products()[a * (a + 1) / 2 + b] / static_cast<double>(count_ - 1);
}

double NumberMoments::deviation(int i) const { return std::sqrt(covariance(i, i)); }

Extreme NumberMoments::least(int i) const { return extremes_[2 * checked("least", i)]; }
Extreme NumberMoments::greatest(int i) const { return extremes_[2 * checked("greatest", i) + 1]; }

std::vector<double> NumberMoments::numbers() const {
  std::vector<double> all{static_cast<double>(count_)};
  detail::append(all, sums_);
  for (const Extreme& e : extremes_) {
    all.push_back(e.value);
    all.push_back(static_cast<double>(e.member));
  }
  detail::append(all, left_out_.numbers());
  return all;
}

NumberMoments NumberMoments::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("NumberMoments::restored", numbers);
  NumberMoments found(size_);
  found.count_ = reader.integer();
  reader.read(found.sums_);
  for (Extreme& e : found.extremes_) {
    e.value = reader.number();
    if (std::isnan(e.value) != (found.count_ == 0))
      reader.refuse("NaN of no member, else a number");
    e.member = reader.integer(-1);
  }
  found.left_out_ = LeftOut(reader);
  reader.finish();
  return found;
}

void AngleMoments::add(std::int64_t member, double angle) {
  if (!std::isfinite(angle)) return left_out_.add(member);
  // of a pack, so that all processors have the same
  const auto of = sincos(Pack<InstructionSet::baseline>(angle));
  cosine_ += of.cos.lanes[0];
  sine_ += of.sin.lanes[0];
  ++count_;
}

void AngleMoments::merge(const AngleMoments& later) {
  cosine_ += later.cosine_;
  sine_ += later.sine_;
  count_ += later.count_;
  left_out_.merge(later.left_out_);
}

double AngleMoments::resultant() const {
  return std::hypot(cosine_, sine_) / static_cast<double>(count_);
}

std::optional<double> AngleMoments::mean() const {
  if (count_ == 0 || !detail::tells_a_mean(resultant(), static_cast<double>(count_)))
    return std::nullopt;
  return std::atan2(sine_, cosine_);
}

double AngleMoments::deviation() const {
  const double R = resultant();
  return R >= 1.0 ? 0.0 : std::sqrt(-2.0 * std::log(R));
}

std::vector<double> AngleMoments::numbers() const {
  std::vector<double> all{static_cast<double>(count_), cosine_, sine_};
  detail::append(all, left_out_.numbers());
  return all;
}

AngleMoments AngleMoments::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("AngleMoments::restored", numbers);
  AngleMoments found;
  found.count_ = reader.integer();
  for (double* sum : {&found.cosine_, &found.sine_}) {
    *sum = reader.number();
    if (!(std::abs(*sum) <= 1.001 * static_cast<double>(found.count_)))
      reader.refuse("a sum of the cosines or sines of " + std::to_string(found.count_) + " angles");
  }
  found.left_out_ = LeftOut(reader);
  reader.finish();
  return found;
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
