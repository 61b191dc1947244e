// SPDX-License-Identifier: MIT
// [output.NAME]: what a scenario asks of a format of files.
#include <utility>

#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

OptionValues option_values(const Values& values, const OutputFormat& format,
                           const std::string& table) {
  std::map<std::string, OptionValue, std::less<>> by_name;
  for (const OptionKey& option : format.keys) {
    const std::string key(option.key().path);
    const std::string path = table + "." + key;
    if (!has(values, path)) continue;
    const Value& value = value_at(values, path);
    by_name.emplace(key, OptionValue{.word = value.words.empty() ? "" : value.words[0],
                                     .number = value.numbers.empty() ? 0.0 : value.numbers[0],
                                     .whole = value.whole});
  }
  return OptionValues(std::move(by_name));
}

std::any options_of(const Values& values, const OutputFormat& format, const std::string& table,
                    const std::string& name) {
  if (!format.options) return {};
  try {
    return format.options(option_values(values, format, table));
  } catch (const OptionError& error) {
    const std::string path = table + "." + error.key;
    refuse(values, has(values, path) ? path : table, name, error.what());
  } catch (const DomainError& error) {
    refuse(values, table, name, error.what());
  }
}

}  // namespace

FormatOptions format_options_of(const Values& values, const OutputFormats& formats,
                                const std::string& name) {
  FormatOptions options;
  for (const OutputFormat& format : formats.all()) {
    const std::string table = "output." + format.name;
    if (has(values, table)) options.emplace(format.name, options_of(values, format, table, name));
  }
  return options;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
