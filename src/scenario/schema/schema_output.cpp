// SPDX-License-Identifier: MIT
// The table of scenario keys: what the rows hold. The keys of a format of files stand in its own
// source.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
    {.path = "output", .fallback = "{}", .help = "What the rows hold."},
    {.path = "output.columns",
     .type = choices,
     .allowed = "q|omega|omega_inertial|g|euler|andoyer|sadov|serret|q_inertial|omega_rel|"
                "convective|andoyer_osc|euler_osc|axes|axes_rel|damper|energy",
     .fallback = "[\"q\", \"omega\"]",
     .example = "[\"q\", \"omega\", \"andoyer\"]",
     .help = "Groups of columns after t. A column that two groups share is written once."},
};

}  // namespace

SchemaPart output_keys() { return {keys, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
