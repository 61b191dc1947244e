// SPDX-License-Identifier: MIT
// Any bytes are a table that converts, or one DomainError after the rows that are good: never a
// crash, never a number that is not finite. The first two bytes choose the charts, the third how
// much of the table arrives at a time.
#include "polhode/tables/convert.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz.hpp"
#include "polhode/error.hpp"

namespace {

std::string chart(std::uint8_t byte) {
  const auto& charts = polhode::io::default_charts();
  return std::string(charts[byte % charts.size()].name);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polhode;
  if (size < 3) return -1;
  const io::Conversion conversion{chart(data[0]), chart(data[1]), Body(1.0, 2.0, 2.5)};
  const std::size_t piece = std::size_t{1} + data[2];
  std::string_view rest = fuzz::text_of(data + 3, size - 3);
  std::string out;
  try {
    io::convert(
        conversion, "fuzz",
        [&](std::span<char> buffer) {
          const std::size_t count = std::min<std::size_t>({piece, buffer.size(), rest.size()});
          std::copy_n(rest.data(), count, buffer.data());
          rest.remove_prefix(count);
          return count;
        },
        [&](std::string_view bytes) { out += bytes; });
  } catch (const DomainError& error) {
    fuzz::require_message(error.what());
  }
  fuzz::require(out.empty() || out.back() == '\n');
  return 0;
}
