// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "polhode/error.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/run/run.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/separated.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

namespace fs = std::filesystem;

class SinkTest : public test::InTempFolder {
 protected:
  const std::vector<io::ColumnGroup> groups_{{"t", {{"t", "s"}}},
                                             {"g", {{"g1", "1"}, {"g2", "1"}}}};
  const io::Provenance provenance_{"9.9",    "A title", "f.toml", "x = 1\ny = 2\n",
                                   {"note"}, {"paper"}};
};

TEST_F(SinkTest, CsvSaysWhereItIsFrom) {
  const auto sink = io::open_sink(path("a.csv"), groups_, provenance_);
  sink->push(std::vector<double>{0.0, 1.5, -2.0});
  sink->finish();
  EXPECT_EQ(text("a.csv"),
            "# polhode 9.9\n# A title\n# note\n# cite: paper\n# scenario: f.toml\n"
            "# | x = 1\n# | y = 2\n# units: t [s], g1 [1], g2 [1]\nt,g1,g2\n0,1.5,-2\n");
}

TEST_F(SinkTest, CsvNumbersReadBackBitForBit) {
  std::mt19937_64 random(7);
  std::vector<double> numbers{0.0, -0.0, 5e-324, 1.7976931348623157e308, 0.1, 1.0 / 3.0};
  while (numbers.size() < 3000) {
    const std::uint64_t bits = random();
    double x = 0.0;
    std::memcpy(&x, &bits, sizeof x);
    if (std::isfinite(x)) numbers.push_back(x);
  }
  const auto sink = io::open_sink(path("a.csv"), groups_, {});
  sink->push(numbers);
  sink->finish();
  std::string csv = text("a.csv");
  csv.erase(0, csv.find("t,g1,g2\n") + 8);
  std::replace(csv.begin(), csv.end(), '\n', ',');
  csv.pop_back();
  const std::vector<std::string_view> fields = io::separated(csv, ',');
  ASSERT_EQ(fields.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double back = std::strtod(std::string(fields[i]).c_str(), nullptr);
    EXPECT_EQ(std::signbit(back), std::signbit(numbers[i]));
    EXPECT_EQ(back, numbers[i]);
  }
}

TEST_F(SinkTest, AFileHasItsNameOnlyWhenItIsComplete) {
  for (const char* name : {"a.csv", "a.h5"}) {
    const std::string part = path(name) + ".part";
    {
      const auto sink = io::open_sink(path(name), groups_, provenance_);
      sink->push(std::vector<double>{0.0, 1.0, 2.0});
      EXPECT_TRUE(fs::exists(part)) << name;
      EXPECT_FALSE(fs::exists(path(name))) << name;
    }
    EXPECT_TRUE(fs::exists(part)) << name;  // the run ended without finish()
    EXPECT_FALSE(fs::exists(path(name))) << name;
    const auto sink = io::open_sink(path(name), groups_, provenance_);
    sink->finish();
    EXPECT_FALSE(fs::exists(part)) << name;
    EXPECT_TRUE(fs::exists(path(name))) << name;
  }
}

TEST_F(SinkTest, AnUnfinishedRunLeavesTheOldFile) {
  for (const char* name : {"a.csv", "a.h5"}) {
    std::ofstream(path(name)) << "old";
    const auto sink = io::open_sink(path(name), groups_, provenance_);
    sink->push(std::vector<double>{0.0, 1.0, 2.0});
    EXPECT_EQ(text(name), "old");
  }
}

TEST_F(SinkTest, PathsThatCannotBeOutputs) {
  EXPECT_THROW(io::open_sink(path(""), groups_, {}), DomainError);
  EXPECT_THROW(io::open_sink(path("no/such/folder.csv"), groups_, {}), DomainError);
  EXPECT_THROW(io::open_sink(path("no/such/folder.h5"), groups_, {}), DomainError);
  EXPECT_THROW(io::open_sink(path("a.xlsx"), groups_, {}), DomainError);
  EXPECT_THROW(io::open_sink(path("a"), groups_, {}), DomainError);
  fs::create_directories(path("folder.h5"));
  fs::create_directories(path("folder.csv"));
  EXPECT_THROW(io::open_sink(path("folder.h5"), groups_, {}), DomainError);
  EXPECT_THROW(io::open_sink(path("folder.csv"), groups_, {}), DomainError);
  EXPECT_FALSE(fs::exists(path("folder.h5") + ".part"));
}

TEST_F(SinkTest, AFullDiskIsAnError) {
  EXPECT_THROW(io::open_sink("/dev/full", groups_, {}), io::OutputError);
}

TEST_F(SinkTest, EqualRunsGiveEqualFiles) {
  for (const char* name : {"a", "b"})
    for (const char* extension : {".csv", ".h5"}) {
      const auto sink = io::open_sink(path(std::string(name) + extension), groups_, provenance_);
      sink->push(std::vector<double>(3 * 5000, 0.25));
      sink->push(std::vector<double>(3 * 7, 0.5));
      sink->finish();
    }
  EXPECT_EQ(text("a.csv"), text("b.csv"));
  EXPECT_EQ(text("a.h5"), text("b.h5"));
  EXPECT_GT(text("a.h5").size(), 3U * 5007U * 8U);
}

TEST(RowLayout, NoTwoColumnsShareAName) {
  std::vector<std::string> all;
  for (const std::string_view group : io::column_group_names()) all.emplace_back(group);
  std::vector<std::string> names;
  for (const bool equatorial : {true, false}) {
    const io::RowLayout layout(all, io::Units(), io::Branch::in_columns, io::default_columns(),
                               {equatorial, "TT"});
    for (const io::ColumnGroup& group : layout.groups())
      for (const io::Column& column : group.columns)
        if (equatorial || column.name.starts_with("pole_")) names.push_back(column.name);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_EQ(names.size(), io::column_names().size() + 2);  // t, date
  EXPECT_EQ(io::column_dimension("I_g"), io::Dimension::momentum);
  EXPECT_EQ(io::column_dimension("I_m"), io::Dimension::angle);
}

// Every group of a free motion in inertial axes: canonical is osculating, relative is inertial.
TEST(RowLayout, NothingMovesWithoutAFrameOrATerm) {
  const Body body(1.0, 2.0, 2.5);
  const RotorState s{{0.5, 0.5, 0.5, 0.5}, {0.1, 0.4, 2.0}};
  const System system(body);
  const auto value = [&](const char* name) {
    return io::scalar_column(name, system, 0.25).value({0.3, {s}});
  };
  for (const auto& [canonical, osculating] :
       {std::pair{"l", "l_osc"}, std::pair{"H", "H_osc"}, std::pair{"Theta", "Theta_osc"},
        std::pair{"w2", "w2_rel"}, std::pair{"qx", "Qx"}, std::pair{"I_r", "I_r_rel"}})
    EXPECT_EQ(value(canonical), value(osculating)) << canonical;
  EXPECT_EQ(value("v1"), 0.0);
  EXPECT_DOUBLE_EQ(value("w2"), 0.2);
  EXPECT_DOUBLE_EQ(value("dE"), 0.005 + 0.04 + 0.8 - 0.25);
  EXPECT_THROW(io::scalar_column("t", system, 0.0), DomainError);
}

TEST(RowLayout, NamesAreUniqueInTheOrderAskedFor) {
  const std::vector<std::string> all{"serret", "q",     "omega",   "omega_inertial",
                                     "g",      "euler", "andoyer", "sadov"};
  const io::RowLayout layout(all, io::Units("h", "deg", "kg m2"));
  std::string names;
  for (const io::ColumnGroup& group : layout.groups())
    for (const io::Column& column : group.columns) names += column.name + " ";
  EXPECT_EQ(names,
            "t g0 t0 T h G H qw qx qy qz w1 w2 w3 W1 W2 W3 g1 g2 g3 phi theta psi Phi Theta Psi "
            "l g L phi_l phi_g phi_h I_l I_g I_h ");
  EXPECT_EQ(layout.width(), 35U);
  EXPECT_EQ(layout.groups()[1].columns[2].unit, "kg m2/h2");
  EXPECT_EQ(layout.groups()[3].columns[0].unit, "deg/h");
  const std::vector<std::string> twice{"q", "q"}, unknown{"omegas"};
  EXPECT_THROW(io::RowLayout(twice, io::Units()), DomainError);
  EXPECT_THROW(io::RowLayout(unknown, io::Units()), DomainError);
}

}  // namespace
}  // namespace polhode
