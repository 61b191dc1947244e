// SPDX-License-Identifier: MIT
// A commented scenario to start from.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "polhode/scenario/schema.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// The paths of the tables that templates know, in the schema.
inline constexpr std::string_view state_table = "state";
inline constexpr std::string_view perturbation_table = "perturbation[]";
inline constexpr std::string_view observation_table = "observation[]";
inline constexpr std::string_view orbit_table = "orbit.*";
inline constexpr std::string_view frame_table = "frame";
inline constexpr std::string_view method_table = "method";
inline constexpr std::string_view output_table = "output";

// What a template is made for. Its parts are names of kinds.
struct TemplateSubject {
  std::string_view chart = "attitude-rate";
  std::string_view perturbation = {};  // empty: free rotation
  std::string_view experiment = "rotation";
  std::string_view orbit = {};  // of all of its orbits; empty: the first kind that there is
  std::string_view frame = {};
  std::string_view method = {};       // empty: that of the example
  std::string_view format = {};       // of output, where it has keys
  std::string_view observation = {};  // of a fit; empty: that of the example
};

std::string template_text(const TemplateSubject& subject, const Schema& schema,
                          std::string_view program);

// The words of the key `kind` of a table.
std::vector<std::string_view> kinds_of(const Schema& schema, std::string_view table);
// What is said of one of them; null where nothing is.
const KindText* text_of(const Schema& schema, std::string_view table, std::string_view kind);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
