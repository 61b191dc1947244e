// SPDX-License-Identifier: MIT
// Every input of tests/fuzz/corpus, with which `make fuzz` begins, and damaged copies of it: the
// fuzz targets abort on a failure, and give -1 for what is of no use to libFuzzer.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" {
int fuzz_aem(const std::uint8_t* data, std::size_t size);
int fuzz_alcdef(const std::uint8_t* data, std::size_t size);
int fuzz_convert(const std::uint8_t* data, std::size_t size);
int fuzz_lc(const std::uint8_t* data, std::size_t size);
int fuzz_obj(const std::uint8_t* data, std::size_t size);
int fuzz_oem(const std::uint8_t* data, std::size_t size);
int fuzz_scenario(const std::uint8_t* data, std::size_t size);
int fuzz_series(const std::uint8_t* data, std::size_t size);
}

namespace {

struct Target {
  const char* name;
  int (*one_input)(const std::uint8_t*, std::size_t);
};
constexpr Target targets[] = {{"aem", fuzz_aem},           {"alcdef", fuzz_alcdef},
                              {"convert", fuzz_convert},   {"lc", fuzz_lc},
                              {"obj", fuzz_obj},           {"oem", fuzz_oem},
                              {"scenario", fuzz_scenario}, {"series", fuzz_series}};
constexpr int damaged_copies = 40;

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Cut short, and one byte changed.
void replay_damaged(const Target& target, const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) return;
  std::mt19937_64 random(bytes.size());
  for (int k = 0; k < damaged_copies; ++k) {
    std::vector<std::uint8_t> other = bytes;
    other[random() % other.size()] = static_cast<std::uint8_t>(random());
    EXPECT_LE(target.one_input(other.data(), other.size()), 0);
    EXPECT_LE(target.one_input(bytes.data(), random() % bytes.size()), 0);
  }
}

TEST(FuzzCorpus, EveryInputIsReadOrRejectedInOrder) {
  for (const Target& target : targets) {
    const std::filesystem::path folder = std::filesystem::path(POLHODE_CORPUS) / target.name;
    EXPECT_LE(target.one_input(nullptr, 0), 0);
    if (!exists(folder)) continue;
    std::size_t files = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
      SCOPED_TRACE(file.path().string());
      const std::vector<std::uint8_t> bytes = bytes_of(file.path());
      EXPECT_LE(target.one_input(bytes.data(), bytes.size()), 0);
      replay_damaged(target, bytes);
      ++files;
    }
    EXPECT_GT(files, 0u) << target.name;
  }
}

}  // namespace
