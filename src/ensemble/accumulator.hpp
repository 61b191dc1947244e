// SPDX-License-Identifier: MIT
// Accumulator: what a statistic of an ensemble keeps of the members that it has seen: a value of
// bounded size that grows by members, takes in that of later members, and is a list of numbers.
//
// Units       those of what is added.
// Domain      every class of this folder with `restored`. Members are numbered from 0 and added in
//             their order; `merge` takes the accumulator of members that come later, of the same
//             shape (as many numbers, the same bins, the same reference). Counts go to 2^53.
// Accuracy    numbers() and restored() are exact. A merge into an empty accumulator is a copy. The
//             result of a list of accumulators merged in order depends on the list alone.
// Errors      DomainError from merge for another shape, from restored for numbers that no
//             accumulator of this shape has.
// Cost        numbers() is as long as what is kept.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace ensemble {

// restored(numbers) is a new accumulator of the shape of this one, with those numbers.
template <class A>
concept Accumulator =
    std::copyable<A> && requires(A all, const A& later, std::span<const double> numbers) {
      all.merge(later);
      { later.numbers() } -> std::same_as<std::vector<double>>;
      { later.restored(numbers) } -> std::same_as<A>;
    };

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
