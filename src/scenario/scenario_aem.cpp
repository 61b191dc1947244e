// SPDX-License-Identifier: MIT
// [output.aem]: what a scenario asks of an Attitude Ephemeris Message.
#include <algorithm>

#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "text/civil_time.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using Form = AemOptions::Form;

constexpr std::size_t longest_line = 250;  // the standard allows 254 characters

void require_ascii(const Values& values, const std::string& key, const std::string& name) {
  if (!has(values, key)) return;
  const std::string& text = word(values, key);
  const bool good =
      !text.empty() && text.size() <= longest_line / 2 &&
      std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
  if (!good) refuse(values, key, name, "expected 1 to 125 printable ASCII characters");
}

Form form_of(const std::string& word) {
  if (word == "quaternion-rate") return Form::quaternion_rate;
  if (word == "euler") return Form::euler;
  return word == "spin" ? Form::spin : Form::quaternion;
}

}  // namespace

AemOptions aem_options_of(const Values& values, const std::string& name) {
  if (!has(values, "output.aem")) return {};
  const std::string path = "output.aem.";
  const auto text = [&](const char* key) {
    require_ascii(values, path + key, name);
    return has(values, path + key) ? word(values, path + key) : std::string();
  };
  AemOptions options{.form = form_of(word(values, path + "form")),
                     .version = static_cast<int>(value_at(values, path + "version").whole),
                     .scalar_first = word(values, path + "quaternion_type") == "FIRST",
                     .body_to_frame = word(values, path + "direction") == "B2A",
                     .object_name = text("object_name"),
                     .object_id = text("object_id"),
                     .originator = text("originator"),
                     .creation_date = text("creation_date"),
                     .center = text("center"),
                     .frame_a = text("frame_a"),
                     .frame_b = text("frame_b")};
  if (!options.creation_date.empty() && !civil_time(options.creation_date, true))
    refuse(values, path + "creation_date", name, "expected a date such as 2026-01-31T12:00:00");
  if (options.scalar_first && options.version == 2)
    refuse(values, path + "quaternion_type", name, "expected \"LAST\" in version 2");
  if (options.body_to_frame && (options.version == 2 || options.form != Form::quaternion))
    refuse(values, path + "direction", name,
           "expected \"A2B\": B2A is of form quaternion and version 1 alone");
  return options;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
