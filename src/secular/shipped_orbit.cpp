// SPDX-License-Identifier: MIT
// The files of data/orbits stand in the library itself, so that it finds them wherever it lies.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/secular/orbit_history.hpp"

// POLHODE_ORBITS is the folder.
#define POLHODE_FILE(symbol, file)                                                             \
  __asm__(".pushsection .rodata\n.balign 16\n" #symbol ":\n.incbin \"" POLHODE_ORBITS "/" file \
          "\"\n.byte 0\n.popsection\n");                                                       \
  extern "C" const unsigned char symbol[] __attribute__((visibility("hidden")))

POLHODE_FILE(polhode_orbit_of_earth, "earth.i32");
POLHODE_FILE(polhode_orbit_of_mars, "mars.i32");

namespace polhode {
inline namespace v0 {
namespace secular {
namespace {

constexpr std::array<std::string_view, 2> names = {"earth", "mars"};
constexpr double unit = 1e-9;

// Four little-endian integers, whatever the machine's order is.
std::array<std::int32_t, 4> four(const unsigned char* bytes, std::size_t row) {
  std::array<std::int32_t, 4> numbers{};
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint32_t x = 0;
    for (std::size_t b = 0; b < 4; ++b)
      x |= static_cast<std::uint32_t>(bytes[16 * row + 4 * i + b]) << (8 * b);
    numbers[i] = static_cast<std::int32_t>(x);
  }
  return numbers;
}

ElementTable table_of(const unsigned char* bytes, double year) {
  const auto [count, first, interval, zero] = four(bytes, 0);
  std::vector<double> times;
  std::vector<OrbitElements> rows;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const auto [a, b, c, d] = four(bytes, k + 1);
    times.push_back((1e3 * first + static_cast<double>(k) * interval) * year);
    rows.push_back({unit * a, unit * b, unit * c, unit * d});
  }
  return {std::move(times), rows};
}

}  // namespace

std::span<const std::string_view> shipped_orbit_names() { return names; }

ElementTable shipped_orbit(std::string_view name, double year) {
  if (name == "earth") return table_of(polhode_orbit_of_earth, year);
  if (name == "mars") return table_of(polhode_orbit_of_mars, year);
  throw DomainError("shipped_orbit: got \"" + std::string(name) + "\"; expected earth or mars");
}

}  // namespace secular
}  // namespace v0
}  // namespace polhode
