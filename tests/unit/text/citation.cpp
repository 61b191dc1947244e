// SPDX-License-Identifier: MIT
#include "polhode/text/citation.hpp"

#include <gtest/gtest.h>

namespace polhode {
namespace {

TEST(Citations, AnEntryIsThatOfTheReferencesWithoutOurOwnField) {
  EXPECT_EQ(bibtex({"sadov1970", "a text", "a reason"}).substr(0, 19), "@article{sadov1970,");
  const std::string serret = bibtex({"serret1866", "", ""});
  EXPECT_TRUE(serret.ends_with("  year    = {1866}\n}\n")) << serret;
  EXPECT_EQ(serret.find("nodoi"), std::string::npos);
}

TEST(Citations, AWorkOfAKindOfYourOwnIsItsTextForLatex) {
  const Citation own{"smith2030", "Smith & Co {2030}. 100% of \\H_2. A~B", ""};
  EXPECT_EQ(bibtex(own),
            "@misc{smith2030,\n  howpublished = {Smith \\& Co 2030. 100\\% of H\\_2. AB}\n}\n");
  // a key that is the end of another one is not that one
  EXPECT_EQ(bibtex({"1866", "t", ""}).substr(0, 11), "@misc{1866,");
}

}  // namespace
}  // namespace polhode
