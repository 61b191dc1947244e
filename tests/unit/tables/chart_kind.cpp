// SPDX-License-Identifier: MIT
// A chart is described once: ours, and one that a program of somebody else adds.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "modified_spherical.hpp"
#include "polhode/error.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/tables/convert.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using polhode::test::message_of;
using test::modified_spherical;
using test::Worst;
using ::testing::Contains;
using ::testing::HasSubstr;

using Word = std::string_view;

// A number without a dimension, a sentence or an example does not compile; nor does an option.
template <class T, class... Arguments>
constexpr bool is_made_of = std::is_constructible_v<T, Arguments...>;
static_assert(is_made_of<io::ChartVariable, Word, io::Dimension, Word, Word>);
static_assert(!is_made_of<io::ChartVariable, Word, io::Dimension, Word>);
static_assert(!is_made_of<io::ChartVariable, Word, Word, Word>);
static_assert(!is_made_of<io::ChartVariable, Word>);
static_assert(!is_made_of<io::ChartVariable>);
static_assert(is_made_of<io::ChartOption, Word, Word, Word, Word, Word>);
static_assert(!is_made_of<io::ChartOption, Word, Word, Word>);

RotorState start() { return {unit_quaternion(0.5, 0.1, -0.7, 0.5), {0.3, -0.2, 1.1}}; }

double difference(const RotorState& a, const RotorState& b) {
  const double sign = a.q.w * b.q.w + a.q.x * b.q.x + a.q.y * b.q.y + a.q.z * b.q.z < 0.0 ? -1 : 1;
  Worst worst;
  for (const double x : {a.q.w - sign * b.q.w, a.q.x - sign * b.q.x, a.q.y - sign * b.q.y,
                         a.q.z - sign * b.q.z, norm(a.g - b.g)})
    worst.add(std::fabs(x));
  return worst.value();
}

TEST(ChartKind, EveryChartComesBackAtEveryTime) {
  const Body body(2.0, 1.0, 2.5);
  for (const io::ChartKind& chart : io::with_chart(io::default_charts(), modified_spherical))
    for (const double t : {0.0, 3.5}) {
      const io::ChartPlace place{&body, t};
      const io::ChartNumbers numbers = chart.from_hub(start(), place);
      const io::ChartNumbers row = io::to_columns(chart, numbers);
      const io::ChartNumbers back = io::completed(chart, io::from_columns(chart, row), place);
      EXPECT_LE(difference(chart.to_hub(back, place), start()), budget::io_convert) << chart.name;
      for (std::size_t i = 0; i < chart.variables.size() + io::branch_columns(chart).size(); ++i)
        EXPECT_TRUE(std::isfinite(row[i])) << chart.name << " " << i;
    }
}

TEST(ChartKind, AStateGivesItsMotion) {
  const Body body(2.0, 1.0, 2.5);
  for (const io::ChartKind& chart : io::default_charts()) {
    const io::ChartPlace place{&body, 0.0};
    const io::ChartState state{chart, io::completed(chart, chart.from_hub(start(), place), place)};
    EXPECT_LE(difference(free_rotation(body, state).at(0.0), start()), budget::io_elements)
        << chart.name;
  }
}

// Rows write a column once: what two charts call alike must be one number.
TEST(ChartKind, ColumnsOfOneNameAreOneNumber) {
  const Body body(2.0, 1.0, 2.5);
  std::set<std::string_view> names;
  std::map<std::string_view, double> columns;
  for (const io::ChartKind& chart : io::default_charts()) {
    EXPECT_TRUE(names.insert(chart.name).second) << chart.name;
    EXPECT_TRUE(chart.help.ends_with('.')) << chart.name;
    if (!chart.in_scenarios) continue;
    const io::ChartNumbers numbers = chart.from_hub(start(), {&body, 0.0});
    for (std::size_t i = 0; i < chart.variables.size(); ++i) {
      const auto [known, is_new] = columns.emplace(chart.variables[i].column, numbers[i]);
      EXPECT_NEAR(known->second, numbers[i], budget::io_elements)
          << chart.name << " " << known->first;
    }
  }
  EXPECT_TRUE(columns.contains("sigma_pi_0"));
}

TEST(ChartKind, OptionsAreWordsAndNumbers) {
  constexpr io::ChartOption sign{"s", "1|-1", "1", "A sign.", "1"};
  constexpr io::ChartOption region{"r", "SAM|LAM", "", "A region.", "\"SAM\""};
  EXPECT_EQ(io::option_number(sign, "-1"), -1.0);
  EXPECT_EQ(io::option_number(region, "LAM"), 1.0);
  EXPECT_TRUE(std::isnan(io::option_number(sign, "2")));
  EXPECT_TRUE(std::isnan(io::option_number(region, "lam")));
  EXPECT_EQ(io::option_word(sign, -1.0), "-1");
  EXPECT_EQ(io::option_word(region, 0.0), "SAM");
  EXPECT_EQ(io::option_word(region, 2.0), "");
  EXPECT_EQ(io::option_word(region, std::numeric_limits<double>::quiet_NaN()), "");
}

TEST(ChartKind, AnOptionThatIsLeftOutIsFound) {
  const Body body(1.0, 2.0, 2.5);
  const io::ChartKind& sadov = *io::chart_named("sadov");
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto region = [&](double I_l, double given) {
    return io::completed(sadov, {0.1, 0.2, 0.3, I_l, 1.0, 0.5, given, none}, {&body})[6];
  };
  EXPECT_EQ(region(0.99, none), 0.0);
  EXPECT_EQ(region(0.01, none), 1.0);
  EXPECT_EQ(region(0.01, 0.0), 0.0);
  EXPECT_EQ(io::completed(sadov, {0.1, 0.2, 0.3, 0.9, 1.0, 0.5, none, none}, {&body})[7], 1.0);
  const io::ChartKind& serret = *io::chart_named("serret");
  EXPECT_MESSAGE(io::completed(serret, {1, 1, 1, 1, 1, 1, 0.5, 1}, {&body}),
                 "a column of signs must hold 1 or -1");
}

TEST(ChartKind, WhatIsNoChartIsRefused) {
  const auto error = [](const auto& change) {
    io::ChartKind chart = modified_spherical;
    change(chart);
    return message_of([&] { io::with_chart(io::default_charts(), chart); });
  };
  EXPECT_EQ(error([](io::ChartKind& c) { c.name = "serret"; }),
            "chart \"serret\": the name is taken");
  EXPECT_EQ(error([](io::ChartKind& c) { c.name = "my chart"; }),
            "chart \"my chart\": expected a name of letters, digits, - and _");
  EXPECT_THAT(error([](io::ChartKind& c) { c.to_hub = nullptr; }), HasSubstr("expected to_hub"));
  EXPECT_THAT(error([](io::ChartKind& c) { c.variables = {}; }), HasSubstr("expected variables"));
  EXPECT_THAT(error([](io::ChartKind& c) { c.is_constant = true; }), HasSubstr("from_motion"));
  constexpr std::size_t order[] = {1, 0}, twice[] = {0, 1, 2, 3, 4, 4},
                        beyond[] = {0, 1, 2, 3, 4, 6};
  EXPECT_THAT(error([&](io::ChartKind& c) { c.column_order = order; }), HasSubstr("column_order"));
  EXPECT_THAT(error([&](io::ChartKind& c) { c.column_order = twice; }), HasSubstr("column_order"));
  EXPECT_THAT(error([&](io::ChartKind& c) { c.column_order = beyond; }), HasSubstr("column_order"));
  constexpr Word columns[] = {"side"};
  EXPECT_THAT(error([&](io::ChartKind& c) { c.branch_columns = columns; }),
              HasSubstr("to_columns"));
  const std::string names = "expected names of letters, digits, - and _, none twice";
  constexpr io::ChartVariable one{"x", io::Dimension::number, "A number.", "1"};
  const io::ChartVariable two[] = {one, one};
  EXPECT_THAT(error([&](io::ChartKind& c) { c.variables = two; }), HasSubstr(names));
  constexpr io::ChartVariable spaced[] = {{"my x", io::Dimension::number, "A number.", "1"}};
  EXPECT_THAT(error([&](io::ChartKind& c) { c.variables = spaced; }), HasSubstr(names));
  constexpr io::ChartVariable same[] = {{"x", io::Dimension::number, "A number.", "1"},
                                        {"y", io::Dimension::number, "A number.", "1", "x"}};
  EXPECT_THAT(error([&](io::ChartKind& c) { c.variables = same; }), HasSubstr(names));
  constexpr io::ChartOption taken[] = {{"l", "1|-1", "1", "A sign.", "1"}};
  EXPECT_THAT(error([&](io::ChartKind& c) { c.options = taken; }), HasSubstr(names));
  constexpr io::ChartOption lost[] = {{"side", "near|far", "left", "A side.", "\"near\""}};
  EXPECT_THAT(error([&](io::ChartKind& c) { c.options = lost; }), HasSubstr("one of its words"));
  constexpr io::ChartOption open[] = {{"side", "near|far", "", "A side.", "\"near\""}};
  EXPECT_THAT(error([&](io::ChartKind& c) { c.options = open; }), HasSubstr("one of its words"));
  EXPECT_THAT(error([](io::ChartKind& c) { c.help = {}; }), HasSubstr("one sentence"));
  const std::vector<io::ChartVariable> many(io::most_chart_numbers + 1, one);
  EXPECT_THAT(error([&](io::ChartKind& c) { c.variables = many; }),
              HasSubstr("at most 16 numbers"));
  EXPECT_EQ(error([](io::ChartKind&) {}), "");
}

// Somebody else's chart. What scenarios make of it: tests/unit/scenario/chart_kinds.cpp.
TEST(ChartKind, AChartFromOutsideIsConvertedAndHasColumns) {
  const std::vector<io::ChartKind> charts =
      io::with_chart(io::default_charts(), modified_spherical);
  std::string table = "t,qw,qx,qy,qz,g1,g2,g3\n0,0.5,0.1,-0.7,0.5,0.3,-0.2,1.1\n", out;
  const auto convert_with = [&](const std::string& from, const std::string& to) {
    std::string_view rest = table;
    io::convert(
        {from, to, std::nullopt}, "in.csv",
        [&](std::span<char> buffer) {
          const std::size_t count = rest.copy(buffer.data(), buffer.size());
          rest.remove_prefix(count);
          return count;
        },
        [&](std::string_view bytes) { out += bytes; }, charts);
    table = std::exchange(out, {});
  };
  convert_with("rotor", "modified-spherical");
  EXPECT_THAT(table, ::testing::StartsWith("t,l,g,h,log_G,cos_J,cos_I\n0,"));
  convert_with("modified-spherical", "andoyer");
  EXPECT_THAT(table, ::testing::StartsWith("t,l,g,h,L,G,H\n0,"));
  EXPECT_THROW(convert_with("modified-sphericle", "rotor"), DomainError);

  const io::ColumnKinds columns(charts);
  EXPECT_THAT(io::column_group_names(columns), Contains("modified-spherical"));
  EXPECT_EQ(io::column_dimension("log_G", columns), io::Dimension::number);
  EXPECT_THROW(io::column_dimension("log_G"), DomainError);
  const std::vector<std::string> groups = {"modified-spherical"};
  const io::RowLayout layout(groups, io::Units(), io::Branch::in_notes, columns);
  const Body body(1.0, 2.0, 2.5);
  const FreeRotation motion(body, start());
  std::vector<double> row(layout.width());
  layout.write_rows(motion, std::vector<double>{0.0}, row);
  EXPECT_DOUBLE_EQ(row[4], std::log(norm(start().g)));
  EXPECT_DOUBLE_EQ(row[5], start().g.z / norm(start().g));
}

}  // namespace
}  // namespace polhode
