// SPDX-License-Identifier: MIT
// Quantiles of numbers, and of the times of first events.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "ensemble/detail/number_list.hpp"
#include "ensemble/first_events.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/bins.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

namespace {

constexpr double no_quantile = std::numeric_limits<double>::quiet_NaN();
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr std::int64_t most_exact = std::int64_t{1} << 31;

void check_part(const char* function, double p) {
  if (!(p >= 0.0 && p <= 1.0))
    throw DomainError("Quantiles::" + std::string(function) +
                      ": got p = " + polhode::detail::number_text(p) + "; expected 0 to 1");
}

// a + f (b - a), within them
double interpolated(double a, double b, double f) {
  return f == 0.0 || a == b ? a : std::clamp(a * (1.0 - f) + b * f, a, b);
}

}  // namespace

Quantiles::Quantiles(Bins bins, std::int64_t exact)
    : bins_(std::move(bins)), exact_(exact), least_(unbounded), greatest_(-unbounded) {
  if (exact < 0 || exact > most_exact)
    throw DomainError("Quantiles: got " + std::to_string(exact) +
                      " numbers to be exact with; expected 0 to 2^31");
}

void Quantiles::count_in_bins() {
  if (!cells_.empty()) return;
  cells_.assign(bins_.count() + 2, 0);
  for (const double x : values_) ++cells_[bins_.index(x)];
  values_ = {};
}

void Quantiles::add(std::int64_t member, double x) {
  if (!std::isfinite(x)) return left_out_.add(member);
  if (count_++ == exact_) count_in_bins();
  least_ = std::min(least_, x);
  greatest_ = std::max(greatest_, x);
  if (cells_.empty())
    values_.push_back(x);
  else
    ++cells_[bins_.index(x)];
}

void Quantiles::merge(const Quantiles& later) {
  if (!(later.bins_ == bins_) || later.exact_ != exact_)
    throw DomainError("Quantiles::merge: got other bins, or other than " + std::to_string(exact_) +
                      " numbers to be exact with (" + std::to_string(later.exact_) +
                      "); expected the same");
  if (count_ + later.count_ > exact_) count_in_bins();
  if (cells_.empty())
    detail::append(values_, later.values_);
  else if (!later.cells_.empty())
    detail::merge_cells(cells_, later.cells_);
  else
    for (const double x : later.values_) ++cells_[bins_.index(x)];
  count_ += later.count_;
  least_ = std::min(least_, later.least_);
  greatest_ = std::max(greatest_, later.greatest_);
  left_out_.merge(later.left_out_);
}

// Of what is in a bin.
Bounds Quantiles::bounds_of(std::size_t bin) const {
  const std::span<const double> e = bins_.edges();
  const double low = bin == 0 ? least_ : e[bin - 1];
  const double high = bin == e.size() ? greatest_ : e[bin];
  return {std::max(low, least_), std::min(high, greatest_)};
}

Bounded Quantiles::ranked(std::int64_t k) const {
  if (k < 0 || k >= count_)
    throw DomainError("Quantiles::ranked: got rank " + std::to_string(k) + " of " +
                      std::to_string(count_) + " numbers; expected 0 to " +
                      std::to_string(count_ - 1));
  if (k == 0) return {least_, least_, least_};
  if (k == count_ - 1) return {greatest_, greatest_, greatest_};
  if (cells_.empty()) {
    std::vector<double> values = values_;
    const auto at = values.begin() + k;
    std::nth_element(values.begin(), at, values.end());
    return {*at, *at, *at};
  }
  std::size_t bin = 0;
  for (std::int64_t before = cells_[0]; before <= k; before += cells_[bin]) ++bin;
  const Bounds within = bounds_of(bin);
  const bool outside = bin == 0 || bin > bins_.count();
  const double middle =
      outside ? interpolated(within.lowest, within.highest, 0.5) : bins_.middle(bin);
  return {std::clamp(middle, within.lowest, within.highest), within.lowest, within.highest};
}

Bounded Quantiles::quantile(double p) const {
  check_part("quantile", p);
  if (count_ == 0) return {no_quantile, no_quantile, no_quantile};
  const double h = static_cast<double>(count_ - 1) * p;
  const auto k = std::min(static_cast<std::int64_t>(h), count_ - 1);
  const double f = h - static_cast<double>(k);
  const Bounded a = ranked(k), b = f == 0.0 ? a : ranked(k + 1);
  return {interpolated(a.value, b.value, f), interpolated(a.lowest, b.lowest, f),
          interpolated(a.highest, b.highest, f)};
}

Bounded Quantiles::part_up_to(double x) const {
  const double n = static_cast<double>(count_);
  if (count_ == 0 || std::isnan(x)) return {no_quantile, no_quantile, no_quantile};
  if (x < least_) return {0.0, 0.0, 0.0};
  if (x >= greatest_) return {1.0, 1.0, 1.0};
  if (cells_.empty()) {
    const auto up_to =
        std::count_if(values_.begin(), values_.end(), [&](double v) { return v <= x; });
    const double part = static_cast<double>(up_to) / n;
    return {part, part, part};
  }
  const std::size_t bin = bins_.index(x);
  std::int64_t before = 0;
  for (std::size_t k = 0; k < bin; ++k) before += cells_[k];
  const Bounds within = bounds_of(bin);
  const double low = static_cast<double>(before) / n;
  const double high = static_cast<double>(before + cells_[bin]) / n;
  const double width = within.highest - within.lowest;
  return {interpolated(low, high, width > 0.0 ? (x - within.lowest) / width : 0.5), low, high};
}

Bounds Quantiles::interval(double p, double z) const {
  check_part("interval", p);
  if (!(z >= 0.0 && std::isfinite(z)))
    throw DomainError("Quantiles::interval: got z = " + polhode::detail::number_text(z) +
                      "; expected a finite number of deviations, 0 or more");
  const double n = static_cast<double>(count_), reach = z * std::sqrt(n * p * (1.0 - p));
  const double low = std::floor(n * p - reach) - 1.0, high = std::ceil(n * p + reach);
  return {low < 0.0 ? -unbounded : ranked(static_cast<std::int64_t>(low)).lowest,
          high >= n ? unbounded : ranked(static_cast<std::int64_t>(high)).highest};
}

std::vector<double> Quantiles::numbers() const {
  std::vector<double> all{static_cast<double>(count_), least_, greatest_};
  if (cells_.empty())
    detail::append(all, values_);
  else
    detail::append_cells(all, cells_);
  detail::append(all, left_out_.numbers());
  return all;
}

Quantiles Quantiles::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("Quantiles::restored", numbers);
  Quantiles found(bins_, exact_);
  found.count_ = reader.integer();
  found.least_ = reader.number();
  found.greatest_ = reader.number();
  const bool has_range = std::isfinite(found.least_) && std::isfinite(found.greatest_) &&
                         found.least_ <= found.greatest_;
  if (found.count_ > 0 ? !has_range : !(found.least_ == unbounded && found.greatest_ == -unbounded))
    reader.refuse("a greatest number not below the least, " +
                  polhode::detail::number_text(found.least_) + ", both finite, or -inf of none");
  if (found.count_ > exact_) {
    found.cells_.assign(bins_.count() + 2, 0);
    detail::read_cells(reader, found.cells_, found.count_);
  } else {
    for (std::int64_t k = 0; k < found.count_; ++k) {
      found.values_.push_back(reader.number());
      if (!(found.values_.back() >= found.least_ && found.values_.back() <= found.greatest_))
        reader.refuse("one from " + polhode::detail::number_text(found.least_) + " to " +
                      polhode::detail::number_text(found.greatest_));
    }
  }
  found.left_out_ = LeftOut(reader);
  reader.finish();
  return found;
}

void FirstEvents::leave_out(std::int64_t member) {
  times_.add(member, std::numeric_limits<double>::quiet_NaN());
}

void FirstEvents::merge(const FirstEvents& later) {
  times_.merge(later.times_);
  without_ += later.without_;
}

Bounded FirstEvents::survival(double t) const {
  const auto n = static_cast<double>(count()), had = static_cast<double>(times_.count());
  if (times_.count() == 0) {
    const double all = std::isnan(t) ? t : n / n;
    return {all, all, all};
  }
  const Bounded up_to = times_.part_up_to(t);
  const auto without = [&](double part) { return (n - had * part) / n; };
  return {without(up_to.value), without(up_to.highest), without(up_to.lowest)};
}

std::optional<Bounded> FirstEvents::time_of(double p) const {
  if (!(p >= 0.0 && p <= 1.0))
    throw DomainError("FirstEvents::time_of: got p = " + polhode::detail::number_text(p) +
                      "; expected 0 to 1");
  // the least number of members that are the part p or more, but for rounding
  const double members = std::ceil(p * (1.0 - 0x1p-50) * static_cast<double>(count()));
  const auto rank = std::max<std::int64_t>(static_cast<std::int64_t>(members), 1) - 1;
  if (rank >= times_.count()) return std::nullopt;
  return times_.ranked(rank);
}

std::vector<double> FirstEvents::numbers() const {
  std::vector<double> all{static_cast<double>(without_)};
  detail::append(all, times_.numbers());
  return all;
}

FirstEvents FirstEvents::restored(std::span<const double> numbers) const {
  detail::NumberReader reader("FirstEvents::restored", numbers);
  FirstEvents found = *this;
  found.without_ = reader.integer();
  found.times_ = times_.restored(numbers.subspan(1));
  return found;
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
