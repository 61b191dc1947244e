// SPDX-License-Identifier: MIT
// FirstEvents: when each member first met with something, of members that all ran to the same time,
// some without: a survival curve.
//
// Equations   survival(t) = 1 - (members with a first time up to t) / n, n all but those left out.
// Units       that of the times.
// Domain      any finite times; a member with another is left out and named, as must be one whose
//             run ended early without the event.
// Accuracy    that of Quantiles: exact up to `exact` events, else between bounds; nothing depends
//             on the order of members or on chunks.
// Errors      DomainError as Quantiles. Of no member the survival is NaN.
// Cost        that of Quantiles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "polhode/ensemble/bins.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

class FirstEvents {
 public:
  FirstEvents(Bins times, std::int64_t exact) : times_(std::move(times), exact) {}

  void add(std::int64_t member, double first_time) { times_.add(member, first_time); }
  void add_without() { ++without_; }  // a member that ran to the end and met with nothing
  void leave_out(std::int64_t member);
  void merge(const FirstEvents& later);

  std::int64_t count() const { return times_.count() + without_; }
  std::int64_t without() const { return without_; }
  const LeftOut& left_out() const { return times_.left_out(); }
  const Quantiles& times() const { return times_; }  // of the members that had one

  // Which part of the members had none up to t.
  Bounded survival(double t) const;
  // The time by which the part p of all members had theirs; none if fewer ever had.
  std::optional<Bounded> time_of(double p) const;

  std::vector<double> numbers() const;
  FirstEvents restored(std::span<const double> numbers) const;

 private:
  Quantiles times_;
  std::int64_t without_ = 0;
};

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
