// SPDX-License-Identifier: MIT
// Kinds of [[observation]]: the library's, and one that a program adds.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/detail/scenario/fit_plan.hpp"
#include "polhode/run/fit.hpp"
#include "polhode/run/run.hpp"
#include "polhode/run/simulate.hpp"
#include "polhode/scenario/scenario.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using ::testing::HasSubstr;

struct Gyro {
  Vec3 axis;
  double sigma;
};
constexpr io::KindKey<Gyro> gyro_keys[] = {
    io::quantity_key<&Gyro::axis>("axis", io::Dimension::number, "The axis.")
        .otherwise("[0, 0, 1]"),
    io::quantity_key<&Gyro::sigma>("sigma", io::Dimension::rate, "The error.")
        .required()
        .positive()
        .example("1"),
};
io::ObservedRows made_gyro(const Gyro& a, const io::TermContext& at) {
  if (!(norm(a.axis) > 0.0)) at.refuse("axis", "expected a vector that is not 0");
  return io::observed_rows(
      {.columns = {{"about", io::Dimension::rate}, {"tilt", io::Dimension::angle}},
       .sigmas = {a.sigma, 0.001},
       .numbers =
           [a](double, const Quaternion& q, const Vec3& w, std::span<double> numbers) {
             const Vec3 up = rotate(q, Vec3{0.0, 0.0, 1.0});
             numbers[0] = dot(w, a.axis) / norm(a.axis);
             numbers[1] = std::atan2(up.y, up.x);
           }},
      at);
}
io::ObservationKind gyro() {
  io::ObservationKind kind =
      io::observation_kind<Gyro>("gyro", "Rates about an axis.", gyro_keys, made_gyro);
  kind.citations = {{"gyro2026", "A. Author (2026).", "the gyroscope"}};
  return kind;
}
io::Kinds kinds() { return io::default_kinds().with(gyro()); }

const std::string head =
    "schema = 1\nkind = \"fit\"\nunits = { angle = \"deg\" }\n[body]\nmoments = [1, 1.7, 2.2]\n"
    "[state.attitude-rate]\nquaternion = [0.9, 0.2, 0.3, 0.1]\nomega_body = [10, 20, 30]\n"
    "[time]\nstop = 20\ncount = 41\n[free]\nunknowns = [\"attitude\", \"rate\"]\n";
const std::string table =
    "[[observation]]\nkind = \"gyro\"\nfile = \"gyro.csv\"\ntimes = \"at-body\"\nsigma = 0.1\n";
const std::string attitudes =
    "[[observation]]\nkind = \"attitude\"\nfile = \"q.csv\"\ntimes = \"at-body\"\nsigma = 0.5\n";

std::string error_of(const std::string& text, const io::Kinds& of = kinds()) {
  return test::message_of([&] { io::scenario_from_text(text, "f.toml", of); });
}

using ObservationFiles = test::InTempFolder;

TEST_F(ObservationFiles, AFileOfOneIsSimulatedAndFitted) {
  const io::Scenario scenario =
      io::scenario_from_text(head + table + attitudes, path("f.toml"), kinds());
  EXPECT_EQ(io::require_fit(scenario).observations.front().kind, "gyro");
  EXPECT_EQ(io::simulated(scenario, 0).measurements.size(), 41U);
  io::write_simulation(scenario, path("."), false);
  const io::FitReport report = io::fit_scenario(scenario);
  ASSERT_TRUE(report.is_found());
  EXPECT_EQ(report.observed.measurements.size(), 41U);
  EXPECT_EQ(report.observed.seen.numbers(), 41U * 5U);
  const fit::SpinSolution& found = report.solutions.front().raw;
  EXPECT_LT(norm(found.state.w_F - io::spin_state(scenario.rotation()).w_F), budget::measured_rate);
  EXPECT_LT(found.result.chi_square, 2.0 * found.degrees_of_freedom);
  EXPECT_THAT(io::fit_text(scenario, report),
              HasSubstr("41 attitudes, 41 rows of gyro (205 numbers)"));
  EXPECT_THAT(io::fit_json(scenario, report), HasSubstr("\"measurements\": 41"));
  std::vector<std::string> cited;
  for (const io::Citation& one : io::citations(scenario)) cited.emplace_back(one.key);
  EXPECT_THAT(cited, ::testing::Contains("gyro2026"));
}

TEST(ObservationKinds, SchemaAndTemplateKnowIt) {
  EXPECT_THAT(io::json_schema(kinds().schema()), HasSubstr("\"gyro\""));
  const io::Scenario made =
      io::scenario_from_text(io::scenario_template("gyro", kinds().schema()), "t.toml", kinds());
  EXPECT_EQ(io::require_fit(made).observations.front().rows.columns.size(), 3U);
  EXPECT_THAT(error_of(head + table, io::default_kinds()), HasSubstr("got \"gyro\""));
}

TEST(ObservationKinds, MistakesAreReportedAtTheirPlace) {
  const test::Rejected rows[] = {
      {head + table + "axis = [0, 0, 0]\n",
       "observation[0].axis: got [0, 0, 0]; expected a vector"},
      {head + table + "form = \"vector\"\n", "observation[0].form"},
      {head + table.substr(0, table.find("sigma")), "observation[0].sigma: got nothing"},
      {head + table + "light_time = 1\n", "expected none of times at the body"},
      {head + table + "time_format = \"JD\"\n", "expected a key time_scale as well"},
  };
  test::expect_rejected([](const std::string& text) { return error_of(text); }, rows);
}

TEST(ObservationKinds, WhatIsNoKindIsRejected) {
  const auto error = [](const auto& change) {
    io::ObservationKind kind = gyro();
    kind.name = "other";
    change(kind);
    return test::message_of([&] { static_cast<void>(kinds().with(kind)); });
  };
  EXPECT_EQ(error([](io::ObservationKind&) {}), "");
  EXPECT_THAT(error([](io::ObservationKind& k) { k.name = "rate"; }),
              HasSubstr("observation \"rate\" is there; expected another name"));
  EXPECT_THAT(error([](io::ObservationKind& k) { k.made = {}; }),
              HasSubstr("got no function that makes it; expected one"));
  EXPECT_THAT(error([](io::ObservationKind& k) { k.keys[0].path = "times"; }),
              HasSubstr("key \"times\" is one of all observations; expected another name"));
  EXPECT_THAT(error([](io::ObservationKind& k) { k.help = {}; }), HasSubstr("got no text"));
}

TEST(ObservationKinds, MeasurementsAreChecked) {
  const auto function = std::make_shared<const fit::MotionFunction>(
      [](double t, const Quaternion&, const Vec3&, std::span<double> numbers) { numbers[0] = t; });
  const auto error = [&](const auto& change) {
    fit::Measurement one{1.0, {2.0}, {0.1}, function};
    change(one);
    return test::message_of([&] { fit::check(fit::Snapshots{{}, {}, {}, {one}}); });
  };
  EXPECT_EQ(error([](fit::Measurement&) {}), "");
  EXPECT_THAT(error([](fit::Measurement& m) { m.t = NAN; }), HasSubstr("measurement 1: t = "));
  EXPECT_THAT(error([](fit::Measurement& m) { m.sigmas = {0.0}; }), HasSubstr("must be positive"));
  EXPECT_THAT(error([](fit::Measurement& m) {
                m.sigmas = {1.0, 1.0};
              }),
              HasSubstr("one error for each"));
  EXPECT_THAT(error([](fit::Measurement& m) { m.seen = {INFINITY}; }), HasSubstr("must be finite"));
  EXPECT_THAT(error([](fit::Measurement& m) { m.function = nullptr; }), HasSubstr("no function"));
}

}  // namespace
}  // namespace polhode
