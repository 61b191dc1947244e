// SPDX-License-Identifier: MIT
#include "polhode/tables/obj.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/shape/mass_properties.hpp"
#include "text/number_text.hpp"

namespace polhode {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& text) {
  return test::message_of([&] { io::shape_from_obj(text, "x.obj"); });
}

// A box of 2 x 4 x 6 in quads: every way of writing a corner, negative numbers, CRLF, a comment, a
// continued line, numbers in scientific form.
const char* const box =
    "# a box\r\nmtllib none.mtl\r\no box\r\n"
    "v -1 -2 -3\r\nv 1 -2 -3\r\nv 1 2 -3 1.0\nv -1 2 -3\n"
    "v -1.0e0 -2 +3\nv 10e-1 -2 3\nv 1 2 3\nv -1 2 3 0.5 0.5 0.5\n"
    "vt 0 0\nvn 0 0 1\ng sides\ns off\n"
    "f 4 3 2 1\nf 5/1 6/1 7/1 8/1\nf 1//1 2//1 6//1 5//1 # bottom\nf 2/1/1 3/1/1 \\\n 7/1/1 6/1/1\n"
    "f -6 -5 -1 -2\nf -5 -8 -4 -1";

TEST(Obj, WhatIsWrittenReadsBackBitForBit) {
  const shape::FacetShape shape =
      io::shape_from_obj(box, "box.obj").moved({0.1, 0.2, 0.3}, 1.0 / 3.0);
  const shape::FacetShape back = io::shape_from_obj(io::obj_text(shape), "back.obj");
  ASSERT_EQ(back.vertices().size(), shape.vertices().size());
  for (std::size_t i = 0; i < back.vertices().size(); ++i)
    EXPECT_EQ(back.vertices()[i], shape.vertices()[i]);
  ASSERT_EQ(back.triangles().size(), shape.triangles().size());
  for (std::size_t i = 0; i < back.triangles().size(); ++i)
    EXPECT_EQ(back.triangles()[i], shape.triangles()[i]);
}

TEST(Obj, ReadsWhatTheFormatAllows) {
  const shape::FacetShape shape = io::shape_from_obj(std::string("\xef\xbb\xbf") + box, "box.obj");
  EXPECT_EQ(shape.vertices().size(), 8U);
  EXPECT_EQ(shape.triangles().size(), 12U);
  EXPECT_EQ(shape.open_edge(), "");
  const shape::MassProperties p = shape::mass_properties(shape, 1.0);
  EXPECT_NEAR(p.volume, 48.0, budget::shape_mass * 0x1p-52 * 48.0);
  EXPECT_EQ(shape.triangles()[1], (shape::FacetShape::Triangle{3, 1, 0}));  // a fan about its first
}

// An L of area 4 and perimeter 10, drawn out to a prism of height 1; one end from either side.
const char* const concave =
    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n"
    "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 3 1\nv 0 3 1\n"
    "f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";

// "f 7 8 9", from its corner `first` on.
std::string face(std::vector<int> corners, std::size_t first) {
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
  std::string text = "f";
  for (const int corner : corners) text += " " + std::to_string(corner);
  return text + "\n";
}

TEST(Obj, ConcaveFacesAreFilledOnceWhereverTheyBegin) {
  for (std::size_t first = 0; first < 6; ++first) {
    const shape::FacetShape shape = io::shape_from_obj(
        concave + face({6, 5, 4, 3, 2, 1}, first) + face({7, 8, 9, 10, 11, 12}, first), "x.obj");
    EXPECT_EQ(shape.open_edge(), "") << first;
    EXPECT_NEAR(shape.area(), 18.0, budget::shape_mass * 0x1p-52 * 18.0) << first;
    EXPECT_NEAR(shape::mass_properties(shape, 1.0).volume, 4.0, budget::shape_mass * 0x1p-52 * 4.0);
  }
}

// A box of 2 x 6 x 4 with a ninth vertex on an edge, which two faces have as a corner.
TEST(Obj, AVertexOnAnEdgeIsACornerWhereverTheFaceBegins) {
  const std::string others =
      "v -1 -3 -2\nv -1 -3 2\nv -1 3 -2\nv -1 3 2\nv 1 -3 -2\nv 1 -3 2\nv 1 3 -2\nv 1 3 2\n"
      "v 1 0 2\nf 1 2 4 3\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\n";
  for (std::size_t first = 0; first < 5; ++first) {
    const shape::FacetShape shape = io::shape_from_obj(
        others + face({8, 9, 6, 5, 7}, first) + face({6, 9, 8, 4, 2}, first), "x.obj");
    EXPECT_EQ(shape.open_edge(), "") << first;
    EXPECT_NEAR(shape::mass_properties(shape, 1.0).volume, 48.0,
                budget::shape_mass * 0x1p-52 * 48.0);
  }
}

// Spirals and combs, tilted in space: the area is that of the trapezoids below their edges, and no
// triangle of it looks the other way.
TEST(Obj, WindingFacesHaveTheAreaOfTheirPolygon) {
  for (const int teeth : {3, 10, 60}) {
    std::vector<std::array<double, 2>> corners;
    for (int k = 0; k < teeth; ++k) {
      const double a = 0.35 * k, r = 1.0 + 0.2 * k;
      corners.push_back({r * std::cos(a), r * std::sin(a)});
    }
    for (int k = teeth; k-- > 0;) {
      const double a = 0.35 * k, r = 1.1 + 0.2 * k;
      corners.push_back({r * std::cos(a), r * std::sin(a)});
    }
    std::string text;
    std::vector<int> order;
    double area = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [x, y] = corners[k];
      const auto [u, v] = corners[(k + 1) % corners.size()];
      area += 0.5 * (x * v - u * y);
      text += "v " + detail::number_text(x) + " " + detail::number_text(y) + " " +
              detail::number_text(0.75 * y) + "\n";  // tilted: areas grow by 1.25
      order.push_back(static_cast<int>(k) + 1);
    }
    const shape::FacetShape shape =
        io::shape_from_obj(text + face(order, corners.size() / 2), "x.obj");
    ASSERT_EQ(shape.triangles().size(), corners.size() - 2);
    EXPECT_NEAR(shape.area(), 1.25 * std::fabs(area), budget::shape_mass * 0x1p-52 * 100.0);
    for (const shape::Facet& f : shape.facets()) EXPECT_GT(f.normal.z * area, 0.0);
  }
}

TEST(Obj, FacetsMayStandBeforeTheirVertices) {
  EXPECT_EQ(io::shape_from_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", "x").area(), 0.5);
}

TEST(Obj, VerticesInOnePlaceAreOne) {
  std::string text;
  const shape::FacetShape shape = io::shape_from_obj(box, "box.obj");
  int count = 0;
  for (const shape::FacetShape::Triangle& t : shape.triangles()) {
    for (const std::uint32_t i : t) {
      const Vec3& v = shape.vertices()[i];
      text +=
          "v " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
    }
    count += 3;
    text += "f -3 -2 -1\n";
  }
  const shape::FacetShape soup = io::shape_from_obj(text, "soup.obj");
  EXPECT_EQ(soup.vertices().size(), static_cast<std::size_t>(count));
  EXPECT_TRUE(soup.is_closed());
}

TEST(Obj, OneLineSaysWhatIsWrongAndWhere) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\n";
  EXPECT_EQ(refusal(""), "x.obj: has no facets; expected a Wavefront OBJ file");
  EXPECT_EQ(refusal(v), "x.obj: has no facets; expected a Wavefront OBJ file");
  EXPECT_EQ(refusal(v + "f 1 2 3\n"), "x.obj:5: a facet with no area: corners 1, 2, 3");
  EXPECT_EQ(refusal(v + "\n# c\nf 1 2 2\n"), "x.obj:7: a facet with no area: corners 1, 2, 2");
  EXPECT_EQ(refusal(v + "f 1 2 3 4\n"), "");  // a corner on an edge
  EXPECT_THAT(refusal(v + "f 1 2 3 2\n"), HasSubstr("x.obj:5: a face with no area, or one that"));
  EXPECT_THAT(refusal(v + "f 1 3 2 4\n"),
              HasSubstr("x.obj:5: a face that crosses or touches itself: edges 1 to 3 and 3 to 2"));
  const std::string w = "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 1\nv 2 1 0\nv 2 -1 0\nv 0 3 3\n";
  EXPECT_THAT(refusal(w + "v 1 2 0\nf 1 3 2 8\n"), HasSubstr("x.obj:9: a face that crosses"));
  EXPECT_THAT(refusal(w + "f 1 2 3 5 6\n"),
              HasSubstr("x.obj:8: a face that crosses or touches itself: edges 1 to 2 and 5 to 6"));
  EXPECT_EQ(refusal(w + "f 1 2 3 4\n"), "");  // not quite flat
  EXPECT_THAT(refusal(w + "f 1 2 3 7\n"), HasSubstr("x.obj:8: a face that is not flat: vertex"));
  EXPECT_THAT(refusal(v + "f 0 1 4\n"), HasSubstr("x.obj:5: got \"0\"; expected the number of a"));
  EXPECT_EQ(refusal(v + "f 1 2 5\n"), "x.obj:5: got \"5\"; there are 4 vertices");
  EXPECT_EQ(refusal(v + "f 1 2 -5\n"), "x.obj:5: got \"-5\"; there are only 4 vertices before it");
  EXPECT_EQ(refusal(v + "f 1 2\n"), "x.obj:5: got a facet of 2 corners; expected at least 3");
  EXPECT_THAT(refusal(v + "f 1 2 4.0\n"), HasSubstr("x.obj:5: got \"4.0\"; expected the number"));
  EXPECT_THAT(refusal(v + "f 1 2 4/1/1/1\n"), HasSubstr("expected i, i/t, i//n or i/t/n"));
  EXPECT_THAT(refusal(v + "f 1 2 4/x\n"), HasSubstr("x.obj:5: got \"4/x\""));
  EXPECT_THAT(refusal("v 0 nan 0\n"), HasSubstr("x.obj:1: got \"nan\"; expected a finite number"));
  EXPECT_THAT(refusal("v 0 1e999 0\n"), HasSubstr("x.obj:1: got \"1e999\"; expected a number in"));
  EXPECT_THAT(refusal("v 0 1,5 0\n"), HasSubstr("x.obj:1: got \"1,5\"; expected a number"));
  EXPECT_EQ(refusal("v 0 1\n"), "x.obj:1: got 2 numbers; expected v x y z");
  EXPECT_THAT(refusal("solid cube\n"), HasSubstr("x.obj:1: got \"solid\"; expected a statement"));
  EXPECT_THAT(refusal("f 99999999999999999999 1 2"), HasSubstr("x.obj:1: got"));
}

TEST(Obj, FilesThatCannotBeRead) {
  for (const char* path : {"/nonexistent/a.obj", "/", "/dev/null"}) {
    EXPECT_REJECTED(io::read_obj(path), std::string(path) + ": ");
  }
}

}  // namespace
}  // namespace polhode
