// SPDX-License-Identifier: MIT
// A file as a whole: of any length around the pieces it is read in, up to a limit, or none.
#include "text/file_bytes.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

#include "temp_folder.hpp"

namespace polhode {
namespace {

using FileBytes = test::InTempFolder;

std::string bytes_of_length(std::size_t length) {
  std::string bytes(length, ' ');
  for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<char>(i * i % 127);
  return bytes;
}

TEST_F(FileBytes, AreAllOfThem) {
  for (const std::size_t length : {0U, 1U, 65535U, 65536U, 65537U, 200000U}) {
    const std::string bytes = bytes_of_length(length), path = write("x", bytes);
    EXPECT_TRUE(detail::file_bytes(path) == bytes) << length;
    EXPECT_TRUE(detail::file_bytes(path, 65536) == bytes.substr(0, 65536)) << length;
    EXPECT_TRUE(detail::file_bytes(path, 3) == bytes.substr(0, 3)) << length;
  }
}

TEST_F(FileBytes, AreNoneOfWhatCannotBeRead) {
  EXPECT_FALSE(detail::file_bytes(path("x")).has_value());
  EXPECT_EQ(errno, ENOENT);
  EXPECT_FALSE(detail::file_bytes(path("")).has_value());
  EXPECT_EQ(errno, EISDIR);
}

}  // namespace
}  // namespace polhode
