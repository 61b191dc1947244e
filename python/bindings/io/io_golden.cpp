// SPDX-License-Identifier: MIT
#include "interface/batch.hpp"
#include "io/io_parts.hpp"
#include "motion/samples.hpp"
#include "polhode/run/golden.hpp"

namespace polhode::python {

namespace {

using CaseSelf = nb::handle_t<GoldenCase>;

// A view onto one member of every sample.
template <class Member>
FloatArray samples_of(CaseSelf self, Member member, std::initializer_list<std::size_t> inner) {
  const std::vector<GoldenSample>& samples = nb::cast<const GoldenCase&>(self).samples;
  const auto* first = reinterpret_cast<const double*>(&(samples.front().*member));
  return view_of(first, samples.size(), sizeof(GoldenSample), inner, self);
}

void bind_case(nb::module_& m) {
  nb::class_<GoldenCase>(m, "GoldenCase", R"(An exact torque-free rotation to test an engine with.

Start from q0 (w, x, y, z; body to inertial; q0 means q0/|q0|) and omega0 (body axes) with the
principal moments; after the times t the attitudes are q, with w >= 0, and the angular velocities
omega, each to `bound`: |q - exact| for one of the two signs, and |omega - exact|/|omega|.)")
      .def_ro("name", &GoldenCase::name, "What files call it.")
      .def_ro("description", &GoldenCase::description, "One sentence: which motion it is.")
      .def_ro("regime", &GoldenCase::regime, "Of its motion, a Regime.")
      .def_prop_ro(
          "moments", [](const GoldenCase& c) { return array_of(c.moments); },
          "About the body axes, in any order.")
      .def_prop_ro(
          "q0", [](const GoldenCase& c) { return array_of(c.q0); },
          "Attitude at t = 0, as it is to be given: few digits, not of length 1.")
      .def_prop_ro(
          "omega0", [](const GoldenCase& c) { return array_of(c.omega0); },
          "Angular velocity at t = 0, body axes.")
      .def_ro("bound", &GoldenCase::bound, "No sample is farther from the exact one.")
      .def_prop_ro(
          "t", [](CaseSelf self) { return samples_of(self, &GoldenSample::t, {}); }, "(N,): times.")
      .def_prop_ro(
          "q", [](CaseSelf self) { return samples_of(self, &GoldenSample::q, {4}); },
          "(N, 4): attitudes, w >= 0.")
      .def_prop_ro(
          "omega", [](CaseSelf self) { return samples_of(self, &GoldenSample::omega, {3}); },
          "(N, 3): angular velocities, body axes.")
      .def("__len__", [](const GoldenCase& c) { return c.samples.size(); })
      .def("__repr__", [](const GoldenCase& c) {
        return "<GoldenCase: " + c.name + ", " + std::to_string(c.samples.size()) + " samples>";
      });
}

}  // namespace

void bind_golden(nb::module_& m) {
  bind_case(m);
  m.def("golden_cases", &golden_cases,
        "Exact torque-free rotations over every regime, for the tests of other engines.");
  m.def(
      "write_golden",
      [](Typed<"str | os.PathLike[str]"> folder) {
        const nb::module_ os = nb::module_::import_("os");
        const nb::bytes path = nb::bytes(nb::object(os.attr("fsencode")(folder)));
        write_golden({path.c_str(), path.size()}, golden_cases());
      },
      "folder"_a,
      "Writes golden.json and golden.csv into a folder, which is made if it is not there.");
  m.def("regime_name", &regime_name, "regime"_a, "\"short_axis\", as files call it.");
}

}  // namespace polhode::python
