// SPDX-License-Identifier: MIT
// A file as a whole: of any length around the pieces it is read in, up to a limit, or none.
#include "text/file_bytes.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>

namespace polhode {
namespace {

std::string written(const std::string& bytes) {
  const std::string path = std::filesystem::path(::testing::TempDir()) / "polhode-unit-file-bytes";
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string bytes_of_length(std::size_t length) {
  std::string bytes(length, ' ');
  for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<char>(i * i % 127);
  return bytes;
}

TEST(FileBytes, AreAllOfThem) {
  for (const std::size_t length : {0U, 1U, 65535U, 65536U, 65537U, 200000U}) {
    const std::string bytes = bytes_of_length(length), path = written(bytes);
    EXPECT_TRUE(detail::file_bytes(path) == bytes) << length;
    EXPECT_TRUE(detail::file_bytes(path, 65536) == bytes.substr(0, 65536)) << length;
    EXPECT_TRUE(detail::file_bytes(path, 3) == bytes.substr(0, 3)) << length;
    std::filesystem::remove(path);
  }
}

TEST(FileBytes, AreNoneOfWhatCannotBeRead) {
  const std::string path = written("x");
  std::filesystem::remove(path);
  EXPECT_FALSE(detail::file_bytes(path).has_value());
  EXPECT_EQ(errno, ENOENT);
  EXPECT_FALSE(detail::file_bytes(::testing::TempDir()).has_value());
  EXPECT_EQ(errno, EISDIR);
}

}  // namespace
}  // namespace polhode
