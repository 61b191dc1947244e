// SPDX-License-Identifier: MIT
// Defaults that change the physics are required or shown.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "polhode/run/summary.hpp"
#include "polhode/scenario/scenario.hpp"
#include "scenario_text.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string head = test::scenario_text(
    "[orbit.o]\ngm = 398600.4\nsemi_major_axis = 7000\n",
    {.units = "[units]\nmoment = \"kg m2\"\nlength = \"km\"\n",
     .state = "[state]\nepoch = \"2013-05-07T10:57:14.5 UTC\"\naxes = \"equator-J2000\"\n",
     .rate = "omega_body = [0, 0, 0.1]\n"});
const std::string plate = "[[surface]]\nposition = [0, 0, 0]\nnormal = [0, 0, 1]\narea = 1e-6\n";
const std::string dipole =
    "[[perturbation]]\nkind = \"residual-dipole\"\norbit = \"o\"\n"
    "moment = { value = [0, 0, 1], unit = \"A m2\" }\n";
const std::string numbers =
    "gauss = { value = [-29442.0, -1501.0, 4797.1], unit = \"nT\" }\nreference_radius = 6371.2\n";

std::string said(const std::string& rest, const std::string& top = head) {
  try {
    return io::summary_table(io::summary(io::scenario_from_text(top + rest, "s.toml")));
  } catch (const io::ScenarioError& error) {
    return error.what();
  }
}

TEST(Defaults, ThatChangeThePhysicsAreRequired) {
  struct Row {
    std::string rest, message;
  };
  const std::string drag =
      plate + "[[perturbation]]\nkind = \"drag\"\norbit = \"o\"\ndensity = 1\n";
  std::string no_axes = head;
  no_axes.replace(no_axes.find("equator-J2000"), 13, "inertial");
  for (const Row& row :
       {Row{drag, "air_rate"},
        Row{dipole, "perturbation[0].gauss: got nothing; expected the Gauss coefficients"},
        Row{dipole + numbers,
            "perturbation[0].rotation_rate: got nothing; expected the rotation rate of the field"},
        Row{dipole + numbers + "rotation_rate = 0\n",
            "perturbation[0].meridian: got nothing; expected the angle of the prime meridian"},
        Row{dipole + numbers + "field = \"earth\"\n",
            "unit = \"nT\" }; expected it to be left out with field"},
        Row{plate + "[[surface]]\nshape = \"box.obj\"\n",
            "surface[1].scale: got nothing; expected the length of one unit of the mesh"}})
    EXPECT_THAT(said(row.rest), HasSubstr(row.message)) << row.rest;
  EXPECT_THAT(said(dipole + "field = \"earth\"\n", no_axes), HasSubstr("expected axes = "));
  // a dipole along the pole is the same however it turns
  EXPECT_THAT(said(dipole + "gauss = [-3e-5, 0, 0]\nreference_radius = 6371.2\n"),
              HasSubstr("residual dipole, orbit o\n"));
}

TEST(Defaults, OfKeysThatDoNotApplyAreRejectedIfTheyAreWritten) {
  const std::string constant =
      "[[perturbation]]\nkind = \"residual-dipole\"\nmoment = { value = [0, 0, 1], unit = "
      "\"A m2\" }\nconstant_field = [0, 0, 1]\n";
  EXPECT_THAT(said(constant), HasSubstr("constant field"));
  for (const char* const line :
       {"orbit = \"o\"", "field = \"earth\"", "gauss = [1, 0, 0]", "reference_radius = 1",
        "pole = [0, 0, 1]", "rotation_rate = 0", "meridian = 0", "meridian_epoch = 0"}) {
    const std::string text(line);
    EXPECT_THAT(said(constant + text + "\n"),
                HasSubstr("perturbation[0].constant_field: got [0, 0, 1]; expected none with " +
                          text.substr(0, text.find(' '))));
  }
  const std::string gradient = "[[perturbation]]\nkind = \"gravity-gradient\"\norbit = \"o\"\n";
  EXPECT_THAT(said(gradient + "pole = [0, 0, 1]\n"),
              HasSubstr("perturbation[0].pole: got [0, 0, 1]; expected a key J2 as well"));
}

TEST(Defaults, AreInTheSummaryWithTheNumbersOfTheTorques) {
  const std::string text = said(plate + dipole + "field = \"earth\"\n");
  EXPECT_THAT(text, HasSubstr("the Earth's dipole of the epoch (IGRF-14: "));
  EXPECT_THAT(text, Not(HasSubstr("meridian_epoch")));  // the dipole of the epoch has its own
  EXPECT_THAT(text, ContainsRegex(" nT; pole [^ ]+, [^ ]+, 0.99999[0-9]+, meridian [0-9.-]+ "));
  EXPECT_THAT(said(plate + dipole + "gauss = [-3e-5, 0, 0]\nreference_radius = 6371.2\n"),
              HasSubstr("meridian_epoch = 0, pole = [0, 0, 1]"));
  EXPECT_THAT(text, HasSubstr("moment = { value = [0, 0, 1], unit = \"A m2\" }"));
  EXPECT_THAT(text, HasSubstr("surface[0], not in the file"));
  EXPECT_THAT(text, HasSubstr("specular = 0"));
  const test::TempFolder folder;
  folder.write("box.obj",
               "v 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\nv 0 0 1\nv 3 0 1\nv 3 2 1\nv 0 2 1\n"
               "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const io::Scenario of_mesh = io::read_scenario(
      folder.write("s.toml", head + "[[surface]]\nshape = \"box.obj\"\nscale = \"1 m\"\n"));
  EXPECT_THAT(io::summary_table(io::summary(of_mesh)),
              HasSubstr("0.003 x 0.002 x 0.001 km, area 2.2e-05 km2, 12 facets"));
  const io::Scenario dimensionless = io::read_scenario(
      folder.write("n.toml",
                   "schema = 1\n[body]\nshape = \"box.obj\"\ndensity = 1\nscale = 1\n"
                   "[state.andoyer]\nL = 1\nG = 2\n"));
  const std::string plain = io::summary_table(io::summary(dimensionless));
  EXPECT_THAT(plain, HasSubstr("3 x 2 x 1, area 22, 12 facets"));
  EXPECT_THAT(plain, ContainsRegex("state.andoyer, not in the file +g = 0, h = 0, l = 0, H = G\n"));
}

// Between them the interpolation is worthless, and nothing said so.
TEST(Defaults, CoarseTablesOfElementsAreWarnedOfOrRejected) {
  const test::TempFolder folder;
  const auto text = [&](double spacing, const std::string& more, bool radians = false) {
    std::string rows = "t,e,i,Omega,omega\n";
    const double unit = radians ? 1.0 : 180.0 / 3.141592653589793;
    const auto angle = [&](double x) {
      return std::to_string(unit * (radians ? std::fmod(x, 6.283) : x));
    };
    for (double t = -200.0; t <= 400.0; t += spacing)
      rows += std::to_string(1e3 * t) + "," + std::to_string(0.05 + 0.02 * std::cos(t / 15.0)) +
              "," + std::to_string(unit * 0.03) + "," + angle(-t / 11.0) + "," + angle(t / 8.0) +
              "\n";
    folder.write("mars.csv", rows);
    const std::string path = folder.write(
        "s.toml",
        "schema = 1\nkind = \"obliquity\"\n[units]\ntime = \"yr\"\nangle = \"deg\"\n[planet]\n"
        "name = \"mars\"\norbit = \"m\"\n[orbit.m]\nkind = \"elements\"\nfile = \"mars.csv\"\n"
        "columns = [\"t\", \"e\", \"i\", \"Omega\", \"omega\"]\n"
        "units = [\"yr\", \"1\", \"deg\", \"deg\", \"deg\"]\n" +
            more + "[time]\nstop = 300000\nstep = 10000\n");
    try {
      std::string all;
      for (const std::string& warning : io::warnings(io::read_scenario(path)))
        all += warning + "\n";
      return all;
    } catch (const io::ScenarioError& error) {
      return std::string(error.what());
    }
  };
  const std::string axes = "axes = \"invariable-plane\"\n";
  EXPECT_THAT(text(20.0, ""), HasSubstr("axes"));
  EXPECT_EQ(text(1.0, axes), "");
  EXPECT_THAT(text(20.0, axes), HasSubstr("rows that are too far apart: between them"));
  EXPECT_THAT(text(40.0, axes), HasSubstr("or allow_coarse = true in its table"));
  EXPECT_THAT(text(40.0, axes + "allow_coarse = true\n"),
              HasSubstr("orbit.m.file: got \"mars.csv\"; rows that are too far apart"));
  EXPECT_THAT(
      text(1.0, axes, true),
      HasSubstr("the column Omega is declared in degrees, and none of its numbers exceeds"));
}

}  // namespace
}  // namespace polhode
