// SPDX-License-Identifier: MIT
// Goal G13: a million states (t, q, omega: 8 doubles) into files on the disk's page cache, in CSV
// and HDF5 by polhode, raw by write(2), in text by std::to_chars and fprintf. Nanoseconds of CPU
// per state. Arguments: seed, repetitions, folder.
#include <fcntl.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "polhode/output/output_format.hpp"
#include "samples.hpp"

namespace peers {
namespace {

constexpr std::size_t width = 8, rows = 1u << 18;

std::vector<double> states(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<double> numbers(width * rows);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = i % width == 0 ? 0.01 * static_cast<double>(i / width)
                                : std::ldexp(static_cast<double>(engine() >> 11U), -52) - 1.0;
  return numbers;
}

void raw(const std::string& path, const std::vector<double>& numbers) {
  const int file = open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
  const char* at = reinterpret_cast<const char*>(numbers.data());
  std::size_t left = numbers.size() * sizeof(double);
  while (left > 0) {
    const ssize_t written = write(file, at, std::min<std::size_t>(left, 1u << 20));
    if (written <= 0) std::abort();
    at += written;
    left -= static_cast<std::size_t>(written);
  }
  close(file);
}

void shortest(const std::string& path, const std::vector<double>& numbers) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  std::vector<char> text(1u << 20);
  std::size_t used = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (used + 64 > text.size()) {
      std::fwrite(text.data(), 1, used, file);
      used = 0;
    }
    const auto end = std::to_chars(text.data() + used, text.data() + text.size(), numbers[i]);
    used = static_cast<std::size_t>(end.ptr - text.data());
    text[used++] = i % width == width - 1 ? '\n' : ',';
  }
  std::fwrite(text.data(), 1, used, file);
  std::fclose(file);
}

void printed(const std::string& path, const std::vector<double>& numbers) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  for (std::size_t i = 0; i < numbers.size() / 8; ++i)  // slow: an eighth of the rows
    std::fprintf(file, "%.17g%c", numbers[i], i % width == width - 1 ? '\n' : ',');
  std::fclose(file);
}

void by_polhode(const std::string& path, const std::vector<double>& numbers) {
  const std::vector<polhode::io::ColumnGroup> groups{
      {"t", {{"t", "s"}}},
      {"q", {{"q0", "1"}, {"q1", "1"}, {"q2", "1"}, {"q3", "1"}}},
      {"omega", {{"omega1", "rad/s"}, {"omega2", "rad/s"}, {"omega3", "rad/s"}}}};
  const auto sink = polhode::io::open_sink(path, groups, {});
  constexpr std::size_t block = 1024 * width;
  for (std::size_t i = 0; i < numbers.size(); i += block)
    sink->push(std::span(numbers).subspan(i, std::min<std::size_t>(block, numbers.size() - i)));
  sink->finish();
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace peers

int main(int argc, char** argv) {
  using namespace peers;
  const std::string folder = std::string(argc > 3 ? argv[3] : ".") + "/";
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 5;
  const std::vector<double> numbers = states(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1);
  const double n = static_cast<double>(rows);
  compare("G13", "binary",
          {{"polhode HDF5 as runs write it", [&] { by_polhode(folder + "a.h5", numbers); }, n},
           {"raw write(2)", [&] { raw(folder + "a.raw", numbers); }, n}},
          repetitions);
  compare("G13", "text",
          {{"polhode CSV", [&] { by_polhode(folder + "a.csv", numbers); }, n},
           {"std::to_chars", [&] { shortest(folder + "b.csv", numbers); }, n},
           {"fprintf %.17g", [&] { printed(folder + "c.csv", numbers); }, n / 8.0}},
          repetitions);
  for (const char* name : {"a.raw", "b.csv", "c.csv"}) std::filesystem::remove(folder + name);
}
