// SPDX-License-Identifier: MIT
// Tables of numbers in text files: what is read, and what is refused where.
#include "tables/number_table.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "message_of.hpp"
#include "polhode/error.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class NumberTableFile : public test::InTempFolder {
 protected:
  const std::string& holding(const std::string& text) {
    write(path_, text);
    return path_;
  }
  const std::string& packed(const std::string& text) {
    gzFile file = gzopen(path_.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return path_;
  }
  std::string error_of(const std::string& text, std::vector<std::string> columns = {"1", "2"}) {
    try {
      io::read_number_table(holding(text), columns);
    } catch (const DomainError& error) {
      return std::string(error.what()).substr(path_.size());
    }
    return "";
  }

  const std::string path_ = path("table");
};

TEST_F(NumberTableFile, ColumnsAreFoundByName) {
  const std::string text =
      "# of a satellite\n\nt, \"x\",y , z\n0, 1,2,3\n10,1.5e0 ,-2.5D+01,+4\r\n";
  const io::NumberTable table =
      io::read_number_table(holding(text), std::vector<std::string>{"t", "y", "x"});
  EXPECT_THAT(table.columns[0], ElementsAre(0.0, 10.0));
  EXPECT_THAT(table.columns[1], ElementsAre(2.0, -25.0));
  EXPECT_THAT(table.columns[2], ElementsAre(1.0, 1.5));
  EXPECT_THAT(table.lines, ElementsAre(4U, 5U));
  EXPECT_THAT(io::table_columns(path_), ElementsAre("t", "x", "y", "z"));
}

TEST_F(NumberTableFile, BlanksSeparateWhereThereIsNoComma) {
  const std::string text = "  0   1\t2 # first\n 10 3 4\n\n";
  const io::NumberTable table =
      io::read_number_table(holding(text), std::vector<std::string>{"3", "1"});
  EXPECT_THAT(table.columns[0], ElementsAre(2.0, 4.0));
  EXPECT_THAT(table.columns[1], ElementsAre(0.0, 10.0));
  EXPECT_THAT(io::table_columns(path_), ElementsAre("1", "2", "3"));
}

TEST_F(NumberTableFile, SemicolonsSeparateToo) {
  const io::NumberTable table =
      io::read_number_table(holding("t;x;y;\n0; 1;\n10;2;4\n"), std::vector<std::string>{"x", "t"});
  EXPECT_THAT(table.columns[0], ElementsAre(1.0, 2.0));
  EXPECT_THAT(table.columns[1], ElementsAre(0.0, 10.0));
  EXPECT_EQ(error_of("t;x\n0;1,5\n"), ":2: column 2: \"1,5\" is not a number");
}

TEST_F(NumberTableFile, TheLastFieldMayBeEmpty) {
  const std::vector<std::string> columns = {"t", "e"};
  const std::vector<io::FieldReader> readers = {
      io::number_from_field, [](std::string_view field) { return field.empty() ? -1.0 : 0.5; }};
  for (const char separator : {',', ';'})
    for (const std::string head : {"t,f,e\n", "# t f e\n", "# t,f,e,\n"}) {
      std::string text = head + "0,1,\n1,2,0.1\n2,3,\n";
      std::ranges::replace(text, ',', separator);
      const io::NumberTable table = io::read_number_table(holding(text), columns, readers);
      EXPECT_THAT(table.columns[1], ElementsAre(-1.0, 0.5, -1.0)) << text;
      EXPECT_THAT(io::table_columns(path_), ElementsAre("t", "f", "e")) << text;
    }
}

TEST_F(NumberTableFile, ASeparatorAtTheEndIsNoColumn) {
  EXPECT_THAT(io::table_columns(holding("0,1,2,\n1,2,3,\n")), ElementsAre("1", "2", "3"));
  EXPECT_THAT(io::table_columns(holding("# t x\n0,1,\n1,2,\n")), ElementsAre("t", "x"));
  EXPECT_EQ(error_of("0,1,\n", {"1", "4"}), ":1: has 2 columns; expected one of number 4");
}

TEST_F(NumberTableFile, LinesMayGoUnchecked) {
  const std::vector<std::string> columns = {"t", "x"};
  const std::vector<io::FieldReader> readers(2, io::number_from_field);
  const std::vector<std::size_t> unchecked = {3, 4};
  const io::NumberTable table =
      io::read_number_table(holding("t,x\n0,1\n1,nan\nend\n2,3\n"), columns, readers, unchecked);
  EXPECT_THAT(table.lines, ElementsAre(2U, 3U, 4U, 5U));
  EXPECT_EQ(table.columns[0][1], 1.0);
  EXPECT_TRUE(std::isnan(table.columns[1][1]));
  EXPECT_TRUE(std::isnan(table.columns[0][2]));
  EXPECT_EQ(table.columns[1][3], 3.0);
}

TEST_F(NumberTableFile, ACommentRightAboveNamesTheColumns) {
  holding("# made by hand\n# t rho\n0 1\n");
  EXPECT_THAT(io::table_columns(path_), ElementsAre("t", "rho"));
  holding("# made by somebody else\n0 1\n");
  EXPECT_THAT(io::table_columns(path_), ElementsAre("1", "2"));
  holding("# nothing but this\n");
  EXPECT_THAT(io::table_columns(path_), IsEmpty());
}

TEST_F(NumberTableFile, HeaderAndRowsMayBeSeparatedEachInItsWay) {
  const io::NumberTable table =
      io::read_number_table(holding("t,x\n0 1\n1 2\n"), std::vector<std::string>{"t", "x"});
  EXPECT_THAT(table.columns[1], ElementsAre(1.0, 2.0));
}

TEST_F(NumberTableFile, AByteOrderMarkIsNoPartOfTheFirstName) {
  write(path_, "\xef\xbb\xbft,x\n1,2\n");
  EXPECT_EQ(io::table_columns(path_), (std::vector<std::string>{"t", "x"}));
}

TEST_F(NumberTableFile, CompressedFilesReadTheSame) {
  std::string text = "t,x\n";
  for (int k = 0; k < 100000; ++k) text += std::to_string(k) + "," + std::to_string(-2 * k) + "\n";
  const io::NumberTable table =
      io::read_number_table(packed(text), std::vector<std::string>{"t", "x"});
  ASSERT_EQ(table.rows(), 100000U);
  EXPECT_EQ(table.columns[1].back(), -199998.0);
  EXPECT_EQ(table.lines.back(), 100001U);
  EXPECT_LT(std::filesystem::file_size(path_), text.size() / 2);
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  EXPECT_THAT(test::message_of([&] {
                io::read_number_table(path_, std::vector<std::string>{"t", "x"});
              }),
              EndsWith("cannot be unpacked: it ends before its end"));
}

TEST_F(NumberTableFile, OfHorizonsTheRowsBetweenItsMarks) {
  const std::string text =
      "*****\nJPL/HORIZONS   1, 2, 3\n*****\n JD,  Calendar Date (TDB), X,\n*****\n$$SOE\n"
      " 1.5, A.D. 2026, 7.0E+00,\n 2.5, A.D. 2026, 8.0E+00,\n$$EOE\n***\n1, 2, 3\n";
  EXPECT_THAT(io::table_columns(holding(text)), ElementsAre("JD", "Calendar Date (TDB)", "X"));
  const io::NumberTable table =
      io::read_number_table(holding(text), std::vector<std::string>{"JD", "X"});
  EXPECT_THAT(table.columns[0], ElementsAre(1.5, 2.5));
  EXPECT_THAT(table.columns[1], ElementsAre(7.0, 8.0));
  EXPECT_THAT(table.lines, ElementsAre(7, 8));
  EXPECT_EQ(error_of("***\nX Y\n$$SOE\n1 2\n"),
            ":3: names no columns above; expected what Horizons sends with CSV_FORMAT = YES");
  EXPECT_EQ(error_of("***\nX, Y\n"),
            ":2: the file ends before $$SOE, where rows of Horizons begin");
}

TEST_F(NumberTableFile, TheFirstColumnMayBeReadInAnotherWay) {
  const io::NumberTable table = io::read_number_table(
      holding("2020-01-01 7\n2021-01-01 8\n"), std::vector<std::string>{"1", "2"},
      [](std::string_view field) { return io::number_from_field(field.substr(0, 4)); });
  EXPECT_THAT(table.columns[0], ElementsAre(2020.0, 2021.0));
}

TEST_F(NumberTableFile, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_EQ(error_of("0 1\n1 x1\n"), ":2: column 2: \"x1\" is not a number");
  EXPECT_EQ(error_of("0 1\n1 nan\n"), ":2: column 2: \"nan\" is not a finite number");
  EXPECT_EQ(error_of("0 1\n1 1e999\n"), ":2: column 2: \"1e999\" is not a finite number");
  EXPECT_EQ(error_of("0,1\n1\n"), ":2: has 1 fields; expected one in column 2");
  EXPECT_EQ(error_of("0,1\n1,\n"), ":2: column 2: \"\" is not a number");
  EXPECT_EQ(error_of("0,1\n1,,2\n"), ":2: column 2: \"\" is not a number");
  EXPECT_EQ(error_of("0 1\n", {"1", "3"}), ":1: has 2 columns; expected one of number 3");
  EXPECT_EQ(error_of("t x\n0 1\n", {"t", "X"}),
            ":2: there is no column X; expected one of t or x; did you mean x?");
  EXPECT_EQ(error_of("0 1\n", {"t", "x"}),
            ":1: no line names the columns; expected the number of column t in place of its name");
  EXPECT_THAT(error_of("t t\n0 1\n", {"t", "t"}), HasSubstr("two columns are called t"));
  EXPECT_EQ(error_of(std::string(3 << 20, '1')), ":1: is longer than 1 MiB");
  EXPECT_THAT(error_of(std::string("0 1\n0 \0\n", 8)), HasSubstr(":2: column 2: "));
  EXPECT_THROW(io::table_columns(path_ + "-is-not-there"), DomainError);
  EXPECT_THROW(io::table_columns(std::filesystem::temp_directory_path().string()), DomainError);
  EXPECT_THROW(io::table_columns("/dev/zero"), DomainError);
}

TEST_F(NumberTableFile, TimesRise) {
  const auto error = [&](const std::string& text) -> std::string {
    const io::NumberTable table =
        io::read_number_table(holding(text), std::vector<std::string>{"1"});
    try {
      io::require_rising(table, 0, "time");
    } catch (const DomainError& refused) {
      return std::string(refused.what()).substr(path_.size());
    }
    return "";
  };
  EXPECT_EQ(error("1\n2\n3\n"), "");
  EXPECT_EQ(error("1\n3\n\n2\n"), ":4: time 2 comes after 3 of line 2; expected rising values");
  EXPECT_EQ(error("1\n3\n3\n"),
            ":3: time 3 stands twice, here and in line 2; expected rising values");
}

}  // namespace
}  // namespace polhode
