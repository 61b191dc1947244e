// SPDX-License-Identifier: MIT
// The sample times of a problem that are within its span.
#pragma once

#include <string>
#include <vector>

#include "polhode/dynamics/problem.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// DomainError, naming `function`, when they do not run from start to stop.
std::vector<double> sample_times(const std::string& function, const Problem& problem,
                                 const SaveAt& samples);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
