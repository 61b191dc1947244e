// SPDX-License-Identifier: MIT
// Words in messages: the nearest known one, text from outside, lists.
#include "text/words.hpp"

#include <gmock/gmock.h>

#include <span>
#include <string>
#include <string_view>

#include "polhode/text/separated.hpp"

namespace polhode {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Nearest, CountsHalfEdits) {
  EXPECT_EQ(detail::edit_distance("", "ab"), 4);
  EXPECT_EQ(detail::edit_distance("phi", "Phi"), 1);
  EXPECT_EQ(detail::edit_distance("moments", "momnets"), 2);
  EXPECT_EQ(detail::edit_distance("kitten", "sitting"), 6);
}

TEST(Nearest, OffersSlipsOnly) {
  constexpr std::string_view known[] = {"precession_period", "rotation_period", "pole", "mode"};
  EXPECT_EQ(detail::nearest("presession_period", known), "precession_period");
  EXPECT_EQ(detail::nearest("Pole", known), "pole");
  EXPECT_EQ(detail::nearest("rota", known), "rotation_period");
  EXPECT_EQ(detail::nearest("x", known), "");
  EXPECT_EQ(detail::nearest("colour", known), "");
  EXPECT_EQ(detail::nearest(std::string(100000, 'p'), known), "");
}

TEST(Printable, IsOneLineOfAscii) {
  EXPECT_EQ(detail::printable("a b~"), "a b~");
  EXPECT_EQ(detail::printable("a\nb\x7f\xff"), "a\\x0ab\\x7f\\xff");
  EXPECT_EQ(detail::printable(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(detail::printable(std::string(61, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(detail::printable("abc", 2), "ab...");
}

TEST(Separated, HasAPartBetweenAnyTwoSeparators) {
  EXPECT_THAT(separated("", '|'), IsEmpty());
  EXPECT_THAT(separated("a", '|'), ElementsAre("a"));
  EXPECT_THAT(separated("a,b||c|", '|'), ElementsAre("a,b", "", "c", ""));
}

TEST(WordList, EndsWithOr) {
  constexpr std::string_view words[] = {"a", "b", "c"};
  EXPECT_EQ(detail::one_of(words), "a, b or c");
  EXPECT_EQ(detail::one_of(std::span(words).first(2), "\""), "\"a\" or \"b\"");
  EXPECT_EQ(detail::one_of(std::span(words).first(1)), "a");
  EXPECT_EQ(detail::sets_in_words("stop+step|at"), "stop with step, at");
}

}  // namespace
}  // namespace polhode
