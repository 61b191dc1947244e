// SPDX-License-Identifier: MIT
// Times of a scenario as people type and read them.
#pragma once

#include <string>

#include "polhode/scenario/scenario.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A core time: of a number in the unit of time of the file, or of a date, in the scale of the epoch
// where it has none. DomainError with the word for what is neither, and for a date without an
// epoch.
double time_of_word(const Scenario& scenario, const std::string& word);
// "1996-11-25T19:48 UTC"; empty where the file has no epoch.
std::string date_of_time(const Scenario& scenario, double t);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
