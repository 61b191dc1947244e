// SPDX-License-Identifier: MIT
#include "tables/two_line_elements.hpp"

#include <optional>
#include <span>
#include <string_view>

#include "tables/detail/line_reader.hpp"
#include "tables/detail/packed_file.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// 69 characters, of which some may have been lost.
bool is_element_line(std::string_view line, char number) {
  return line.size() > 60 && line.size() < 75 && line[0] == number && line[1] == ' ' &&
         line.find(',') == std::string_view::npos;
}

}  // namespace

bool has_two_line_elements(const std::string& path) {
  constexpr int looked_at = 3;
  PackedFile file(path);
  const ByteSource source = [&file](std::span<char> bytes) { return file.read(bytes); };
  LineReader lines(source);
  bool first = false;
  for (int read = 0; read < looked_at;) {
    const std::optional<std::string_view> line = lines.next();
    if (!line) return false;
    if (line->empty() || line->starts_with('#')) continue;
    if (first) return is_element_line(*line, '2');
    first = is_element_line(*line, '1');
    ++read;
  }
  return false;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
