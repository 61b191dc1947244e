// SPDX-License-Identifier: MIT
// Facet shapes, their mass properties, and surfaces that light and air act on.
#include <nanobind/operators.h>

#include "interface/arrays.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/yorp.hpp"
#include "polhode/shape/mass_properties.hpp"
#include "polhode/shape/surface.hpp"
#include "polhode/tables/obj.hpp"

namespace polhode::python {

namespace {

std::size_t rows_of(const Numbers& numbers, const char* expected) {
  if (numbers.shape().size() == 1) return numbers.shape()[0];
  throw nb::value_error((std::string(numbers.name()) + ": got leading shape " +
                         text_of(numbers.shape()) + "; expected " + expected)
                            .c_str());
}

shape::FacetShape shape_from(nb::handle vertices, nb::handle triangles) {
  const Numbers v(vertices, "vertices", {3}), t(triangles, "triangles", {3});
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < rows_of(v, "(N, 3)"); ++k)
    points.push_back({v.at(k)[0], v.at(k)[1], v.at(k)[2]});
  std::vector<shape::FacetShape::Triangle> facets;
  for (std::size_t k = 0; k < rows_of(t, "(M, 3)"); ++k) {
    shape::FacetShape::Triangle facet{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double place = t.at(k)[i];
      if (!(place >= 0.0 && place < 4294967296.0) || place != static_cast<std::uint32_t>(place))
        throw nb::value_error("triangles: expected places in the list of vertices, from 0");
      facet[i] = static_cast<std::uint32_t>(place);
    }
    facets.push_back(facet);
  }
  return {std::move(points), std::move(facets)};
}

// (N, ...) of what `value(i)` gives for each of `count`.
template <class Value>
FloatArray stacked(std::size_t count, std::initializer_list<std::size_t> inner, Value value) {
  Result out({count}, inner);
  for (std::size_t i = 0; i < count; ++i) put(out.at(i), value(i));
  return out.take();
}

template <std::size_t size>
FloatArray moments_array(const std::array<double, size>& m) {
  return stacked(size, {}, [&](std::size_t i) { return m[i]; });
}

void bind_facet_shape(nb::module_& m) {
  using S = shape::FacetShape;
  nb::class_<S> c(m, "FacetShape", R"(The surface of a body as a mesh of triangles.

Parameters
----------
vertices : (N, 3), any unit of length.
triangles : (M, 3), places in the list of vertices, from 0; counterclockwise as seen from outside.

ValueError names the vertex or the facet, counted from 1: not finite, no such vertex, no area.)");
  c.def(
       "__init__", [](S* self, ArrayLike v, ArrayLike t) { new (self) S(shape_from(v, t)); },
       "vertices"_a, "triangles"_a)
      .def_prop_ro(
          "vertices",
          [](const S& s) {
            return stacked(s.vertices().size(), {3},
                           [&](std::size_t i) { return s.vertices()[i]; });
          },
          "(N, 3).")
      .def_prop_ro(
          "triangles", [](const S& s) -> Typed<"numpy.typing.NDArray[numpy.uint32]"> {
            return stacked(s.triangles().size(), {3},
                           [&](std::size_t i) {
                             const auto& t = s.triangles()[i];
                             return Vec3{double(t[0]), double(t[1]), double(t[2])};
                           })
                .attr("astype")("uint32");
          },
          "(M, 3), from 0.")
      .def_prop_ro(
          "centres",
          [](const S& s) {
            return stacked(s.facets().size(), {3},
                           [&](std::size_t i) { return s.facets()[i].centre; });
          },
          "(M, 3): of the facets.")
      .def_prop_ro(
          "normals",
          [](const S& s) {
            return stacked(s.facets().size(), {3},
                           [&](std::size_t i) { return s.facets()[i].normal; });
          },
          "(M, 3): of length 1.")
      .def_prop_ro(
          "areas",
          [](const S& s) {
            return stacked(s.facets().size(), {},
                           [&](std::size_t i) { return s.facets()[i].area; });
          },
          "(M,): of the facets.")
      .def_prop_ro("area", &S::area, "Of all facets.")
      .def_prop_ro("open_edge", &S::open_edge,
                   "The first edge without a facet on its other side, in words; empty where the "
                   "mesh is closed.")
      .def(
          "moved",
          [](const S& s, ArrayLike origin, double factor) {
            return s.moved(vec3(origin, "origin"), factor);
          },
          "origin"_a, "factor"_a = 1.0, "x -> factor (x - origin).")
      .def("__len__", [](const S& s) { return s.facets().size(); })
      .def("__repr__",
           [](const S& s) {
             return "<FacetShape: " + std::to_string(s.vertices().size()) + " vertices, " +
                    std::to_string(s.facets().size()) + " facets>";
           })
      .def("__copy__", [](const S& s) { return s; })
      .def("__reduce__", [](nb::handle_t<S> self) {
        return nb::make_tuple(nb::handle(self.type()),
                              nb::make_tuple(self.attr("vertices"), self.attr("triangles")));
      });
  m.def("read_obj", &io::read_obj, "path"_a,
        "FacetShape of a Wavefront OBJ file. ValueError: FILE:LINE: what is wrong.");
}

void bind_mass(nb::module_& m) {
  using P = shape::MassProperties;
  nb::class_<P>(m, "MassProperties",
                "Of a closed shape of constant density, in the axes of its mesh: mass_properties.")
      .def_ro("volume", &P::volume, "Inside the mesh.")
      .def_ro("mass", &P::mass, "Density times volume.")
      .def_prop_ro(
          "centre", [](const P& p) { return array_of(p.centre); }, "(3,): of mass.")
      .def_prop_ro(
          "inertia", [](const P& p) { return array_of(p.inertia); },
          "(3, 3): tensor about the centre; inertia[0][1] is minus the integral of x y dm.")
      .def_prop_ro(
          "third", [](const P& p) { return moments_array(p.moments.third); },
          "(10,): integrals of xxx xxy xxz xyy xyz xzz yyy yyz yzz zzz over the mass, about the "
          "centre.")
      .def_prop_ro(
          "fourth", [](const P& p) { return moments_array(p.moments.fourth); },
          "(15,): integrals of xxxx xxxy xxxz xxyy xxyz xxzz xyyy xyyz xyzz xzzz yyyy yyyz yyzz "
          "yzzz zzzz.")
      .def_prop_ro(
          "principal_moments",
          [](const P& p) { return shape::principal_moments(p, shape::body(p)); },
          "MassMoments along the principal axes of `body`: `third` and `fourth` are arguments of "
          "GravityGradient.")
      .def_prop_ro(
          "body", [](const P& p) { return shape::body(p); }, "Its Body, with the principal axes.")
      .def("__repr__",
           [](const P& p) { return "<MassProperties: mass " + std::to_string(p.mass) + ">"; });
  m.def(
      "mass_properties", &shape::mass_properties, "shape"_a, "density"_a,
      "MassProperties of a closed FacetShape filled with a constant density (mass per cube of the "
      "shape's unit of length, whose units the results have). ValueError names an "
      "edge of a mesh that is not closed; facets inward; a density that is not positive.");
}

constexpr std::size_t columns = 12;

Surface surface_from(nb::handle rows) {
  const Numbers n(rows, "rows", {columns});
  std::vector<SurfaceFacet> facets;
  for (std::size_t k = 0; k < rows_of(n, "(N, 12)"); ++k) {
    const double* x = n.at(k);
    facets.push_back(
        {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6], {x[7], x[8], x[9], x[10], x[11]}});
  }
  return Surface(std::move(facets));
}

FloatArray rows_array(const Surface& s) {
  Result out({s.facets().size()}, {columns});
  for (std::size_t k = 0; k < s.facets().size(); ++k) {
    const SurfaceFacet& f = s.facets()[k];
    double* x = out.at(k);
    put(x, f.centre);
    put(x + 3, f.normal);
    const double rest[] = {f.area,
                           f.finish.specular,
                           f.finish.diffuse,
                           f.finish.emitted,
                           f.finish.normal_accommodation,
                           f.finish.tangential_accommodation};
    std::copy(std::begin(rest), std::end(rest), x + 6);
  }
  return out.take();
}

void bind_surface(nb::module_& m) {
  using S = Surface;
  nb::class_<S> c(m, "Surface", R"(Flat facets with what light and air need to know of them.

Surface.of_shape, Surface.of_plate, and + joins two. Along the principal axes of the body, centres
from its centre of mass. `rows` (N, 12): centre, normal, area, specular, diffuse, emitted,
normal_accommodation, tangential_accommodation. Fractions of the light: mirrored, scattered by
Lambert's law, and of what is absorbed the part that leaves at once as heat. ValueError names the
facet, counted from 1, and its wrong number.)");
  c.def(
       "__init__", [](S* self, ArrayLike rows) { new (self) S(surface_from(rows)); }, "rows"_a)
      .def_static(
          "of_shape",
          [](const shape::FacetShape& shape, ArrayLike centre, double specular, double diffuse,
             double emitted, double normal, double tangential) {
            return S::of_shape(shape, vec3(centre, "centre"),
                               {specular, diffuse, emitted, normal, tangential});
          },
          "shape"_a, "centre"_a, "specular"_a = 0.0, "diffuse"_a = 0.0, "emitted"_a = 0.0,
          "normal_accommodation"_a = 1.0, "tangential_accommodation"_a = 1.0,
          "Every facet of a mesh, `centre` its centre of mass.")
      .def_static(
          "of_plate",
          [](ArrayLike centre, ArrayLike direction, double area, double specular, double diffuse,
             double emitted, double normal, double tangential, bool both_sides) {
            return S::of_plate(vec3(centre, "centre"), vec3(direction, "normal"), area,
                               {specular, diffuse, emitted, normal, tangential}, both_sides);
          },
          "centre"_a, "normal"_a, "area"_a, "specular"_a = 0.0, "diffuse"_a = 0.0,
          "emitted"_a = 0.0, "normal_accommodation"_a = 1.0, "tangential_accommodation"_a = 1.0,
          "both_sides"_a = false,
          "A flat plate: centre (3,) and normal (3,) along the body axes, in units of length; area "
          "in "
          "their square. The fractions are from 0 to 1, specular + diffuse at most 1. With both "
          "sides, "
          "two facets. ValueError for others.")
      .def(
          "along", [](const S& s, ArrayLike q_FB) { return s.along(quaternion(q_FB, "q_FB")); },
          "q_FB"_a,
          "The same facets along axes B: q_FB is the rotation from them to those of this surface, "
          "as Body.q_FB.")
      .def_prop_ro("rows", rows_array, "(N, 12).")
      .def("__len__", [](const S& s) { return s.facets().size(); })
      .def(
          "__add__",
          [](const S& a, const S& b) {
            const Surface parts[] = {a, b};
            return joined(parts);
          },
          nb::is_operator(), "other"_a)
      .def(
          "__eq__", [](const S& a, const S& b) { return a == b; }, nb::is_operator(), "other"_a)
      .def("__hash__", [](const S& s) { return s.facets().size(); })
      .def("__repr__",
           [](const S& s) { return "<Surface: " + std::to_string(s.facets().size()) + " facets>"; })
      .def("__copy__", [](const S& s) { return s; })
      .def("__reduce__", [](nb::handle_t<S> self) {
        return nb::make_tuple(nb::handle(self.type()), nb::make_tuple(self.attr("rows")));
      });
}

void bind_yorp(nb::module_& m) {
  m.def(
      "yorp_torque",
      [](const Surface& surface, ArrayLike obliquity, ArrayLike axis) {
        const Numbers o(obliquity, "obliquity");
        const Vec3 about = vec3(axis, "axis");
        Result out(o.shape(), {3});
        for_each(size_of(o.shape()), [&](std::size_t k) {
          const secular::YorpTorque y = secular::yorp_torque(surface, o[k], about);
          put(out.at(k), Vec3{y.spin, y.obliquity, y.precession});
        });
        return out.take();
      },
      "surface"_a, "obliquity"_a, "axis"_a = nb::make_tuple(0.0, 0.0, 1.0),
      "Torque of sunlight averaged over rotation about `axis` and over the orbit, at mean pressure "
      "1: (..., 3), along the spin axis, towards larger obliquity, and of the precession. "
      "Multiply by mean_pressure. Facets do not shade each other.");
  m.def(
      "mean_pressure",
      [](double pressure, double distance, double a, double e) {
        return secular::mean_pressure({pressure, distance}, a, e);
      },
      "pressure"_a, "distance"_a, "semi_major_axis"_a, "eccentricity"_a = 0.0,
      "P d^2 / (a^2 sqrt(1 - e^2)): of sunlight with the pressure P at the distance d, over an "
      "orbit.");
}

}  // namespace

void bind_shape(nb::module_& m) {
  bind_facet_shape(m);
  bind_mass(m);
  bind_surface(m);
  bind_yorp(m);
}

}  // namespace polhode::python
