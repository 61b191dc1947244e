// SPDX-License-Identifier: MIT
#include "polhode/ensemble/angle_moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ensemble/detail/number_list.hpp"
#include "ensemble/detail/resultant.hpp"
#include "polhode/math/pack_functions.hpp"

namespace polhode {
inline namespace v0 {

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

}  // namespace v0
}  // namespace polhode
