// SPDX-License-Identifier: MIT
// What readers of light curves share: magnitudes become fluxes, and what a file may hold.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "polhode/tables/light_curve_file.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

constexpr std::size_t largest_light_file = std::size_t{256} << 20;

// DomainError for more bytes than that.
void require_size(std::string_view text, const std::string& shown);
// A magnitude beyond 100 is none: the reason, or nothing.
std::string magnitude_flaw(double magnitude);
// Points that hold magnitudes and their errors get fluxes in their place. Relative ones have the
// mean 1 then.
void take_magnitudes(LightSession& session);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
