// SPDX-License-Identifier: MIT
// Numbers are written as std::to_chars writes them, character by character.
#include "text/number_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace {

std::string ours(double x) {
  char text[polhode::detail::longest_number];
  return {text, polhode::detail::write_number(text, x)};
}

std::string of_the_standard_library(double x) {
  char text[polhode::detail::longest_number];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

void expect_same(double x) {
  for (const double of : {x, -x, std::nextafter(x, 0.0), std::nextafter(x, HUGE_VAL)})
    ASSERT_EQ(ours(of), std::isnan(of) ? "nan" : of_the_standard_library(of));
}

TEST(NumberText, IsThatOfTheStandardLibraryAtAnyBits) {
  std::mt19937_64 engine(1);
  for (int i = 0; i < 50000; ++i) expect_same(std::bit_cast<double>(engine()));
}

TEST(NumberText, IsThatOfTheStandardLibraryAtUsualSizes) {
  std::mt19937_64 engine(2);
  for (int i = 0; i < 50000; ++i) {
    const double unit = std::ldexp(static_cast<double>(engine() >> 11U), -53);
    const double power = std::pow(10.0, static_cast<int>(engine() % 26) - 10);
    expect_same(unit);
    expect_same(unit * power);
    expect_same(std::round(unit * 1e4) * power);
    expect_same(i * 0.01);
    expect_same(i * power);
  }
}

TEST(NumberText, IsThatOfTheStandardLibraryAtPowers) {
  for (int e = -1074; e < 1024; ++e)
    for (const double factor : {1.0, 3.0}) expect_same(std::ldexp(factor, e));
  for (int k = -323; k < 309; ++k)
    for (const char* digits : {"1", "2", "5", "9", "15", "99", "1234567", "72057594037927936"})
      expect_same(std::strtod((digits + ("e" + std::to_string(k))).c_str(), nullptr));
}

TEST(NumberText, IsThatOfTheStandardLibraryWhereThereIsNoNumber) {
  for (const double x : {0.0, -0.0, HUGE_VAL, -HUGE_VAL})
    EXPECT_EQ(ours(x), of_the_standard_library(x));
}

// The sign of a NaN is that of the processor's 0 / 0, and says nothing.
TEST(NumberText, HasNoSignWhereThereIsNoNumber) {
  for (const double x : {std::nan(""), -std::nan("")}) EXPECT_EQ(ours(x), "nan");
}

}  // namespace
