// SPDX-License-Identifier: MIT
#include "polhode/tables/convert.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/error.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/separated.hpp"

namespace polhode {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string rotor_header = "t,qw,qx,qy,qz,g1,g2,g3\n";
const std::string rotor_row = "7,0.5,0.1,-0.7,0.5,0.3,-0.2,1.1\n";

struct Outcome {
  std::string out;
  std::string error;
};

// `piece`: how much the source hands over at a time.
Outcome converted(const std::string& from, const std::string& to, const std::string& in,
                  std::size_t piece = std::string::npos) {
  Outcome outcome;
  std::string_view rest = in;
  const io::ByteSource source = [&](std::span<char> buffer) {
    const std::size_t count = std::min<std::size_t>({rest.size(), buffer.size(), piece});
    std::copy_n(rest.data(), count, buffer.data());
    rest.remove_prefix(count);
    return count;
  };
  try {
    io::convert({from, to, Body(1.0, 2.0, 2.5)}, "in.csv", source,
                [&](std::string_view bytes) { outcome.out += bytes; });
  } catch (const DomainError& error) {
    outcome.error = error.what();
  }
  return outcome;
}

std::vector<double> last_row(const std::string& csv) {
  const std::size_t end = csv.find_last_not_of('\n'), begin = csv.rfind('\n', end);
  std::vector<double> numbers;
  const std::string row = csv.substr(begin + 1, end - begin);
  for (const std::string_view field : io::separated(row, ','))
    numbers.push_back(std::stod(std::string(field)));
  return numbers;
}

TEST(Convert, EveryChartComesBack) {
  const std::vector<double> start = last_row(rotor_header + rotor_row);
  const double length = std::sqrt(start[1] * start[1] + start[2] * start[2] + start[3] * start[3] +
                                  start[4] * start[4]);
  for (const io::ChartKind& chart : io::default_charts()) {
    const std::string name(chart.name);
    const Outcome there = converted("rotor", name, rotor_header + rotor_row);
    ASSERT_EQ(there.error, "") << name;
    const Outcome back = converted(name, "rotor", there.out);
    ASSERT_EQ(back.error, "") << name;
    const std::vector<double> end = last_row(back.out);
    ASSERT_EQ(end.size(), start.size()) << name;
    EXPECT_EQ(end[0], 7.0) << name;
    const double sign = end[1] * start[1] < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = 1; i < 5; ++i)
      EXPECT_NEAR(sign * end[i], start[i] / length, budget::io_convert) << name;
    for (std::size_t i = 5; i < 8; ++i) EXPECT_NEAR(end[i], start[i], budget::io_convert) << name;
  }
}

TEST(Convert, ChartColumnsAreFoundByNameOthersPassThrough) {
  const Outcome result =
      converted("rotor", "andoyer",
                "name,g3,qw,qx,qy,qz,g1,g2,note\n\"a, b\",1,1,0,0,0,0,1,\"x \"\"y\"\"\"\nc,1,1,0,0,"
                "0,0,1,\n");
  EXPECT_EQ(result.error, "");
  EXPECT_THAT(result.out, StartsWith("name,l,g,h,L,G,H,note\n\"a, b\",0,"));
  EXPECT_THAT(result.out, HasSubstr(",\"x \"\"y\"\"\"\nc,0,"));
}

TEST(Convert, CommentsBlankLinesAndLineEnds) {
  const std::string plain = "# one\n" + rotor_header + "# two\n" + rotor_row;
  std::string dos = "\xef\xbb\xbf# one\r\n\r\n" + rotor_header + "# two\n\n" + rotor_row;
  dos.pop_back();
  dos += "\r";
  const std::string expected = converted("rotor", "euler", plain).out;
  EXPECT_THAT(expected, StartsWith("# one\nt,phi,theta,psi,Phi,Theta,Psi\n# two\n7,"));
  EXPECT_EQ(converted("rotor", "euler", dos).out, expected);
  for (const std::size_t piece : {1U, 2U, 7U, 100U})
    EXPECT_EQ(converted("rotor", "euler", plain, piece).out, expected);
}

TEST(Convert, ABadRowStopsItAfterTheRowsBefore) {
  const std::string good = rotor_header + rotor_row + rotor_row;
  const std::string expected = converted("rotor", "andoyer", good).out;
  const struct {
    const char* row;
    const char* error;
  } cases[] = {
      {"7,0.5,0.1,x,0.5,0.3,-0.2,1.1", "in.csv:4: qy: got \"x\"; expected a finite number"},
      {"7,0.5,0.1,,0.5,0.3,-0.2,1.1", "in.csv:4: qy: got \"\"; expected a finite number"},
      {"7,0.5,0.1,1e999,0.5,0.3,-0.2,1", "in.csv:4: qy: got \"1e999\"; expected a finite number"},
      {"7,0.5,0.1,nan,0.5,0.3,-0.2,1.1", "in.csv:4: qy: got \"nan\"; expected a finite number"},
      {"7,0.5,0.1,1 2,0.5,0.3,-0.2,1.1", "in.csv:4: qy: got \"1 2\"; expected a finite number"},
      {"7,0.5,0.1", "in.csv:4: got fewer fields than the 8 of the header"},
      {"7,0.5,0.1,-0.7,0.5,0.3,-0.2,1.1,9", "in.csv:4: got more fields than the 8 of the header"},
      {"\"7,0.5,0.1,-0.7,0.5,0.3,-0.2,1.1", "in.csv:4: a quote does not close"},
      {"7,0,0,0,0,0.3,-0.2,1.1", "in.csv:4: unit_quaternion: (0, 0, 0, 0) must not be zero"},
      {"7,0.5,0.1,-0.7,0.5,1.7e308,1e308,1e308", "in.csv:4: G is beyond double range"},
  };
  for (const auto& [row, error] : cases) {
    const Outcome outcome = converted("rotor", "andoyer", good + row + "\n" + rotor_row);
    EXPECT_EQ(outcome.error, error);
    EXPECT_EQ(outcome.out, expected);
  }
  EXPECT_THAT(converted("andoyer", "rotor", "l,g,h,L,G,H\n1,1,1,2,1,0\n").error,
              StartsWith("in.csv:2: andoyer_state: L = 2"));
}

TEST(Convert, AnglesEndWhereTheirDigitsDo) {
  const std::string header = "l,g,h,L,G,H\n";
  EXPECT_EQ(converted("andoyer", "rotor", header + "1e10,1,1,0.5,1,0\n").error, "");
  EXPECT_EQ(converted("andoyer", "rotor", header + "1e11,1,1,0.5,1,0\n").error,
            "in.csv:2: l: got \"1e11\"; expected a finite number, angles up to 1e10");
}

TEST(Convert, ABadHeaderStopsIt) {
  EXPECT_EQ(converted("rotor", "andoyer", "").error,
            "in.csv:1: got no header line; expected one with the columns qw,qx,qy,qz,g1,g2,g3");
  EXPECT_THAT(converted("rotor", "andoyer", "# c\nt,qw,qx,qy,qz,g1,g2\n").error,
              StartsWith("in.csv:2: column g3 is missing; chart rotor needs qw,qx"));
  EXPECT_EQ(converted("rotor", "andoyer", "qw,qx,qy,qz,g1,g2,g3,qw\n").error,
            "in.csv:1: column qw is named twice");
  EXPECT_THAT(converted("rotor", "andoyr", "").error,
              HasSubstr("unknown chart \"andoyr\"; expected rotor, "));
  EXPECT_THAT(converted("rotor", "andoyr", "").error, HasSubstr("did you mean andoyer?"));
}

TEST(Convert, LinesOfAnyLengthAreHarmless) {
  const Outcome outcome =
      converted("rotor", "andoyer", rotor_header + rotor_row + std::string(3 << 20, '1'));
  EXPECT_EQ(outcome.error, "in.csv:3: a line of more than 1 MiB");
  EXPECT_EQ(outcome.out, converted("rotor", "andoyer", rotor_header + rotor_row).out);
}

TEST(Convert, AColumnOfTheNewChartIsReplaced) {
  const Outcome outcome =
      converted("rotor", "andoyer", "G,qw,qx,qy,qz,g1,g2,g3\n99,1,0,0,0,0,3,4\n");
  EXPECT_THAT(outcome.out, StartsWith("l,g,h,L,G,H\n"));
  EXPECT_EQ(last_row(outcome.out)[4], 5.0);
}

TEST(Convert, MomentsAreNeededBySomeCharts) {
  EXPECT_THROW(io::convert({"rotor", "sadov", std::nullopt}, "in", {}, {}), DomainError);
}

// Serret's elements are constants of the motion: two rows of one motion give the same.
TEST(Convert, SerretUsesTheTimeOfTheRow) {
  const Outcome elements = converted("rotor", "serret", rotor_header + rotor_row);
  const std::vector<double> at_7 = last_row(elements.out);
  std::string later = elements.out;
  later.replace(later.rfind("\n7,"), 3, "\n7.5,");
  const Outcome moved = converted("serret", "rotor", later);
  const std::vector<double> at_later = last_row(converted("rotor", "serret", moved.out).out);
  EXPECT_NE(last_row(moved.out)[5], 0.3);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_NEAR(at_later[i], at_7[i], budget::io_elements);
}

}  // namespace
}  // namespace polhode
