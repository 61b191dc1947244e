// SPDX-License-Identifier: MIT
// Words in messages: the nearest known one, text from outside, lists.
#include "text/words.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <string_view>

#include "polhode/text/citation.hpp"
#include "polhode/text/separated.hpp"
#include "temp_folder.hpp"
#include "text/file_bytes.hpp"
#include "text/number_text.hpp"

namespace polhode {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using FileBytes = test::InTempFolder;

TEST(Nearest, CountsHalfEdits) {
  EXPECT_EQ(io::detail::edit_distance("", "ab"), 4);
  EXPECT_EQ(io::detail::edit_distance("phi", "Phi"), 1);
  EXPECT_EQ(io::detail::edit_distance("moments", "momnets"), 2);
  EXPECT_EQ(io::detail::edit_distance("kitten", "sitting"), 6);
}

TEST(Nearest, OffersSlipsOnly) {
  constexpr std::string_view known[] = {"precession_period", "rotation_period", "pole", "mode"};
  EXPECT_EQ(io::detail::nearest("presession_period", known), "precession_period");
  EXPECT_EQ(io::detail::nearest("Pole", known), "pole");
  EXPECT_EQ(io::detail::nearest("rota", known), "rotation_period");
  EXPECT_EQ(io::detail::nearest("x", known), "");
  EXPECT_EQ(io::detail::nearest("colour", known), "");
  EXPECT_EQ(io::detail::nearest(std::string(100000, 'p'), known), "");
}

TEST(Printable, IsOneLineOfAscii) {
  EXPECT_EQ(io::detail::printable("a b~"), "a b~");
  EXPECT_EQ(io::detail::printable("a\nb\x7f\xff"), "a\\x0ab\\x7f\\xff");
  EXPECT_EQ(io::detail::printable(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(io::detail::printable(std::string(61, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(io::detail::printable("abc", 2), "ab...");
}

TEST(Separated, HasAPartBetweenAnyTwoSeparators) {
  EXPECT_THAT(io::separated("", '|'), IsEmpty());
  EXPECT_THAT(io::separated("a", '|'), ElementsAre("a"));
  EXPECT_THAT(io::separated("a,b||c|", '|'), ElementsAre("a,b", "", "c", ""));
}

TEST(WordList, EndsWithOr) {
  constexpr std::string_view words[] = {"a", "b", "c"};
  EXPECT_EQ(io::detail::one_of(words), "a, b or c");
  EXPECT_EQ(io::detail::one_of(std::span(words).first(2), "\""), "\"a\" or \"b\"");
  EXPECT_EQ(io::detail::one_of(std::span(words).first(1)), "a");
  EXPECT_EQ(io::detail::sets_in_words("stop+step|at"), "stop with step, at");
}

// Numbers are written as std::to_chars writes them, character by character.

std::string ours(double x) {
  char text[io::detail::longest_number];
  return {text, io::detail::write_number(text, x)};
}

std::string of_the_standard_library(double x) {
  char text[io::detail::longest_number];
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

// A file as a whole: of any length around the pieces it is read in, up to a limit, or none.

std::string bytes_of_length(std::size_t length) {
  std::string bytes(length, ' ');
  for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<char>(i * i % 127);
  return bytes;
}

TEST_F(FileBytes, AreAllOfThem) {
  for (const std::size_t length : {0U, 1U, 65535U, 65536U, 65537U, 200000U}) {
    const std::string bytes = bytes_of_length(length), path = write("x", bytes);
    EXPECT_TRUE(io::detail::file_bytes(path) == bytes) << length;
    EXPECT_TRUE(io::detail::file_bytes(path, 65536) == bytes.substr(0, 65536)) << length;
    EXPECT_TRUE(io::detail::file_bytes(path, 3) == bytes.substr(0, 3)) << length;
  }
}

TEST_F(FileBytes, AreNoneOfWhatCannotBeRead) {
  EXPECT_FALSE(io::detail::file_bytes(path("x")).has_value());
  EXPECT_EQ(errno, ENOENT);
  EXPECT_FALSE(io::detail::file_bytes(path("")).has_value());
  EXPECT_EQ(errno, EISDIR);
}

TEST(Citations, AnEntryIsThatOfTheReferencesWithoutOurOwnField) {
  EXPECT_EQ(io::bibtex({"sadov1970", "a text", "a reason"}).substr(0, 19), "@article{sadov1970,");
  const std::string serret = io::bibtex({"serret1866", "", ""});
  EXPECT_TRUE(serret.ends_with("  year    = {1866}\n}\n")) << serret;
  EXPECT_EQ(serret.find("nodoi"), std::string::npos);
}

TEST(Citations, AWorkOfAKindOfYourOwnIsItsTextForLatex) {
  const io::Citation own{"smith2030", "Smith & Co {2030}. 100% of \\H_2. A~B", ""};
  EXPECT_EQ(io::bibtex(own),
            "@misc{smith2030,\n  howpublished = {Smith \\& Co 2030. 100\\% of H\\_2. AB}\n}\n");
  // a key that is the end of another one is not that one
  EXPECT_EQ(io::bibtex({"1866", "t", ""}).substr(0, 11), "@misc{1866,");
}

}  // namespace
}  // namespace polhode
