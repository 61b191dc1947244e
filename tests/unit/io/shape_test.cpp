// SPDX-License-Identifier: MIT
// [body] shape, and what is said of shapes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "budgets.hpp"
#include "polhode/io/scenario.hpp"
#include "polhode/io/shape_report.hpp"

namespace polhode {
namespace {

using ::testing::HasSubstr;

// Half edges 1, 2, 3 about (5, 0, 0).
const char* const box =
    "v 4 -2 -3\nv 6 -2 -3\nv 6 2 -3\nv 4 2 -3\nv 4 -2 3\nv 6 -2 3\nv 6 2 3\nv 4 2 3\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("polhode-shape-" + std::to_string(reinterpret_cast<std::uintptr_t>(this)))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_;
};

std::string scenario_text(const std::string& body) {
  return "schema = 1\n[units]\nmoment = \"kg m2\"\nlength = \"m\"\n[body]\n" + body +
         "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0, 0, 1]\n";
}

std::string refusal(const std::string& text, const std::string& name) {
  try {
    scenario_from_text(text, name);
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ScenarioShape, GivesTheTensor) {
  const Folder folder;
  folder.write("box.obj", box);
  const std::string path =
      folder.write("s.toml", scenario_text("shape = \"box.obj\"\ndensity = \"2 g/cm3\"\n"
                                           "scale = \"10 cm\"\n"));
  const Scenario s = read_scenario(path);
  const double mass = 2000.0 * 48e-3;
  const Vec3 want{mass * 13e-2 / 3.0, mass * 10e-2 / 3.0, mass * 5e-2 / 3.0};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(s.body.moments()[k], want[k], 4.0 * budget::shape_mass * 0x1p-52 * want.x) << k;
  ASSERT_TRUE(s.shape.has_value());
  EXPECT_EQ(s.shape->file, "box.obj");
  EXPECT_NEAR(s.shape->inside.mass, mass, 4.0 * budget::shape_mass * 0x1p-52 * mass);
  EXPECT_NEAR(s.shape->inside.centre.x, 0.5, 4.0 * budget::shape_mass * 0x1p-52);
}

TEST(ScenarioShape, RefusesInOneLine) {
  const Folder folder;
  folder.write("box.obj", box);
  folder.write("open.obj", std::string(box).substr(0, std::string(box).rfind('f')));
  const std::string name = folder.write("s.toml", "");
  const auto said = [&](const std::string& body) { return refusal(scenario_text(body), name); };
  EXPECT_THAT(said("shape = \"box.obj\"\ndensity = -1\n"),
              HasSubstr("s.toml:7:11: body.density: got -1; expected a positive density"));
  EXPECT_THAT(said("shape = \"open.obj\"\ndensity = 1\n"),
              HasSubstr("body.shape: got \"open.obj\"; mass_properties: the mesh is not closed: "
                        "edge 1-4 of facet 2 has no facet on its other side"));
  EXPECT_THAT(said("shape = \"none.obj\"\ndensity = 1\n"),
              HasSubstr("none.obj: cannot be read: No such file"));
  EXPECT_THAT(said("moments = [1, 2, 2]\nscale = 2\n"), HasSubstr("body.scale: got 2; expected"));
  EXPECT_THAT(said("shape = \"box.obj\"\n"), HasSubstr("density"));
}

TEST(ShapeReport, TableReadsBackAsTheBody) {
  const Folder folder;
  const std::string obj = folder.write("box.obj", box);
  const std::string path =
      folder.write("s.toml", scenario_text("shape = \"box.obj\"\ndensity = 3\n"));
  const Scenario s = read_scenario(path);
  const std::string table = body_table(s.shape->inside, s.units);
  const Scenario again =
      scenario_from_text(scenario_text(table.substr(std::string("[body]\n").size())), "x");
  EXPECT_EQ(again.body.moments(), s.body.moments());
  const std::string lines = summary_table(shape_summary(s.shape->mesh, s.shape->inside, s.units));
  EXPECT_THAT(lines, HasSubstr("144 kg"));
  EXPECT_THAT(lines, HasSubstr("48 m3"));
}

}  // namespace
}  // namespace polhode
