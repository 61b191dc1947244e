// SPDX-License-Identifier: MIT
// [body] shape, and what is said of shapes.
#include <gmock/gmock.h>

#include <string>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/perturb/atmospheric_drag.hpp"
#include "polhode/perturb/solar_pressure.hpp"
#include "polhode/run/shape_report.hpp"
#include "polhode/scenario/scenario.hpp"
#include "temp_folder.hpp"

namespace polhode {
namespace {

using ::testing::HasSubstr;

// Half edges 1, 2, 3 about (5, 0, 0).
const char* const box =
    "v 4 -2 -3\nv 6 -2 -3\nv 6 2 -3\nv 4 2 -3\nv 4 -2 3\nv 6 -2 3\nv 6 2 3\nv 4 2 3\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string scenario_text(const std::string& body) {
  return "schema = 1\n[units]\nmoment = \"kg m2\"\nlength = \"m\"\n[body]\n" + body +
         "[state.attitude-rate]\nquaternion = [1, 0, 0, 0]\nomega_body = [0, 0, 1]\n";
}

std::string refusal(const std::string& text, const std::string& name) {
  return test::message_of<io::ScenarioError>([&] { io::scenario_from_text(text, name); });
}

TEST(ScenarioShape, GivesTheTensor) {
  const test::TempFolder folder;
  folder.write("box.obj", box);
  const std::string path =
      folder.write("s.toml", scenario_text("shape = \"box.obj\"\ndensity = \"2 g/cm3\"\n"
                                           "scale = \"10 cm\"\n"));
  const io::Scenario s = io::read_scenario(path);
  const double mass = 2000.0 * 48e-3;
  const Vec3 want{mass * 13e-2 / 3.0, mass * 10e-2 / 3.0, mass * 5e-2 / 3.0};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(s.rotation().body.moments()[k], want[k],
                4.0 * budget::shape_mass * 0x1p-52 * want.x)
        << k;
  ASSERT_NE(s.rotation().shape, nullptr);
  EXPECT_EQ(s.rotation().shape->file, "box.obj");
  EXPECT_NEAR(s.rotation().shape->inside.mass, mass, 4.0 * budget::shape_mass * 0x1p-52 * mass);
  EXPECT_NEAR(s.rotation().shape->inside.centre.x, 0.5, 4.0 * budget::shape_mass * 0x1p-52);
}

TEST(ScenarioShape, RefusesInOneLine) {
  const test::TempFolder folder;
  folder.write("box.obj", box);
  folder.write("open.obj", std::string(box).substr(0, std::string(box).rfind('f')));
  const std::string name = folder.write("s.toml", "");
  const auto said = [&](const std::string& body) { return refusal(scenario_text(body), name); };
  EXPECT_THAT(said("shape = \"box.obj\"\ndensity = -1\nscale = 1\n"),
              HasSubstr("s.toml:7:11: body.density: got -1; expected a positive density"));
  EXPECT_THAT(said("shape = \"open.obj\"\ndensity = 1\nscale = 1\n"),
              HasSubstr("body.shape: got \"open.obj\"; mass_properties: the mesh is not closed: "
                        "edge 1-4 of facet 2 has no facet on its other side"));
  EXPECT_THAT(said("shape = \"none.obj\"\ndensity = 1\nscale = 1\n"),
              HasSubstr("none.obj: cannot be read: No such file"));
  EXPECT_THAT(said("moments = [1, 2, 2]\nscale = 2\n"), HasSubstr("body.scale: got 2; expected"));
  EXPECT_THAT(said("shape = \"box.obj\"\nscale = 1\n"), HasSubstr("density"));
  const std::string no_scale = "shape = \"box.obj\"\ndensity = 1\n";
  const std::string expected =
      "body.scale: got nothing; expected the length of one unit of the mesh";
  EXPECT_THAT(said(no_scale), HasSubstr(expected + ", such as \"1 m\""));
  EXPECT_THAT(refusal("schema = 1\n[body]\n" + no_scale + "[state.andoyer]\nL = 1\nG = 2\n", name),
              HasSubstr(expected + ", such as 1"));
}

// The torque of the file's term is that of the term built by hand, in the body axes of its tensor.
std::string lit(const std::string& rest) {
  return "schema = 1\n[units]\nmoment = \"kg m2\"\nlength = \"m\"\n[body]\n"
         "tensor = [[2, 0.1, 0], [0.1, 3, 0], [0, 0, 4]]\n"
         "[state.attitude-rate]\nquaternion = [1, 2, 3, 4]\nomega_body = [0, 0, 0.1]\n"
         "[orbit.sat]\ngm = 4e14\nsemi_major_axis = 7e6\ninclination = 0.5\n"
         "[orbit.sun]\ngm = 1.3e20\nsemi_major_axis = 1.5e11\n" +
         rest;
}
const char* const panel =
    "[[surface]]\nposition = [0, 2, 0]\nnormal = [1, 0, 1]\narea = 3\nsides = 2\n"
    "specular = 0.2\ndiffuse = 0.3\n";
const char* const sunlight =
    "[[perturbation]]\nkind = \"solar-pressure\"\norbit = \"sat\"\nsun = \"sun\"\n"
    "pressure = \"4.5e-6 N/m2\"\npressure_distance = \"1 au\"\n";

TEST(ScenarioSurface, SunlightAsByHand) {
  const io::Scenario s = io::scenario_from_text(
      lit(std::string(panel) + sunlight +
          "shadow = \"cone\"\nshadow_radius = \"6378 km\"\nsun_radius = \"695700 km\"\n"),
      "s.toml");
  const Quaternion conj_FB = conj(s.rotation().body.q_FB());
  const Surface plate =
      Surface::of_plate(rotate(conj_FB, Vec3{0, 2, 0}), rotate(conj_FB, Vec3{1, 0, 1}), 3.0,
                        {.specular = 0.2, .diffuse = 0.3}, true);
  const SolarPressure term(plate, {4.5e-6, 149597870700.0}, {io::any_orbit(s.rotation().orbits[0])},
                           {io::any_orbit(s.rotation().orbits[1])}, Shadow::cone(6378e3, 695700e3));
  for (const double t : {0.0, 1000.0, 3000.0, 5000.0}) {
    const Setting at{s.rotation().body, t, io::initial_state(s), {}};
    const Vec3 want = term.effect(at).u;
    EXPECT_LE(norm(s.rotation().terms[0].effect(at).u - want),
              budget::surface_eps * 0x1p-52 * norm(want));
  }
  EXPECT_EQ(s.rotation().terms[0].name(),
            "solar pressure on 2 facets, orbit sat, Sun sun, shadow cone");
}

TEST(ScenarioSurface, DragAsByHand) {
  const io::Scenario s = io::scenario_from_text(
      lit(std::string(panel) +
          "[[perturbation]]\nkind = \"drag\"\norbit = \"sat\"\ndensity = \"1e-12 kg/m3\"\n"
          "density_radius = \"6978 km\"\nscale_height = \"60 km\"\nair_rate = 7.3e-5\n"),
      "s.toml");
  const AtmosphericDrag term(
      *s.rotation().surface,
      {.density = 1e-12, .radius = 6978e3, .scale_height = 60e3, .rotation = {0, 0, 7.3e-5}},
      {io::any_orbit(s.rotation().orbits[0])});
  const Setting at{s.rotation().body, 500.0, io::initial_state(s), {}};
  EXPECT_GT(norm(term.effect(at).u), 0.0);
  EXPECT_EQ(s.rotation().terms[0].effect(at), term.effect(at));
}

TEST(ScenarioSurface, MeshAboutTheCentreOfMass) {
  const test::TempFolder folder;
  folder.write("box.obj", box);
  const std::string path =
      folder.write("s.toml", scenario_text("shape = \"box.obj\"\ndensity = 1\nscale = 1\n") +
                                 "[[surface]]\nshape = \"box.obj\"\nscale = 1\n"
                                 "[[surface]]\nshape = \"box.obj\"\n"
                                 "centre_of_mass = [4, 0, 0]\nscale = 2\n");
  const io::Scenario s = io::read_scenario(path);
  ASSERT_EQ(s.rotation().surface->facets().size(), 24U);
  Vec3 sum[2];
  for (std::size_t i = 0; i < 24; ++i)
    sum[i / 12] = sum[i / 12] +
                  s.rotation().surface->facets()[i].area * s.rotation().surface->facets()[i].centre;
  EXPECT_LE(norm(sum[0]), budget::surface_eps * 0x1p-52 * 100.0);
  EXPECT_NEAR(sum[1].x, 6.0 * 4.0 * 88.0, budget::surface_eps * 0x1p-52 * 2000.0);
}

TEST(ScenarioSurface, RefusesInOneLine) {
  const auto said = [&](const std::string& rest) { return refusal(lit(rest), "s.toml"); };
  const std::string plate = panel;
  EXPECT_THAT(said(sunlight), HasSubstr("expected a table [[surface]], since it acts on facets"));
  EXPECT_THAT(said(plate + "emitted = 2\n" + sunlight),
              HasSubstr("surface[0].emitted: got 2; expected a fraction from 0 to 1"));
  EXPECT_THAT(said(plate + sunlight + "shadow = \"cone\"\nshadow_radius = 1\n"),
              HasSubstr("shadow: got \"cone\"; expected a key sun_radius as well"));
  EXPECT_THAT(said(plate + "[[perturbation]]\nkind = \"drag\"\norbit = \"sat\"\ndensity = -1\n"
                           "air_rate = 0\n"),
              HasSubstr("density: got -1; expected a density that is not negative"));
  EXPECT_THAT(said("[[surface]]\nposition = [0, 0, 0]\nnormal = [0, 0, 0]\narea = 1\n"),
              HasSubstr("surface[0].normal: got"));
  EXPECT_THAT(said("[[surface]]\nposition = [0, 0, 0]\nnormal = [0, 0, 1]\narea = 0\n"),
              HasSubstr("surface[0].area: got 0; expected a positive area"));
}

TEST(ShapeReport, TableReadsBackAsTheBody) {
  const test::TempFolder folder;
  const std::string obj = folder.write("box.obj", box);
  const std::string path =
      folder.write("s.toml", scenario_text("shape = \"box.obj\"\ndensity = 3\nscale = 1\n"));
  const io::Scenario s = io::read_scenario(path);
  const std::string table = io::body_table(s.rotation().shape->inside, s.units());
  const io::Scenario again =
      io::scenario_from_text(scenario_text(table.substr(std::string("[body]\n").size())), "x");
  EXPECT_EQ(again.rotation().body.moments(), s.rotation().body.moments());
  const std::string lines = io::summary_table(
      io::shape_summary(s.rotation().shape->mesh, s.rotation().shape->inside, s.units()));
  EXPECT_THAT(lines, HasSubstr("144 kg"));
  EXPECT_THAT(lines, HasSubstr("48 m3"));
}

}  // namespace
}  // namespace polhode
