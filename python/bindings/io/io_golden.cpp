// SPDX-License-Identifier: MIT
#include "interface/records.hpp"
#include "io/io_parts.hpp"
#include "polhode/run/golden.hpp"

namespace polhode::python {

namespace {

struct PythonCase : io::GoldenCase, Records<io::GoldenSample> {
  explicit PythonCase(const io::GoldenCase& of) : io::GoldenCase(of), Records(of.samples) {}
};

void bind_case(nb::module_& m) {
  nb::class_<PythonCase> c(m, "GoldenCase", R"(An exact torque-free rotation to test an engine with.

Start from q0 (w, x, y, z; body to inertial; q0 means q0/|q0|) and omega0 (body axes) with the
principal moments; after the times t the attitudes are q, with w >= 0, and the angular velocities
omega, each to `bound`: |q - exact| for one of the two signs, and |omega - exact|/|omega|.)");
  c.def_ro("name", &PythonCase::name, "What files call it.")
      .def_ro("description", &PythonCase::description, "One sentence: which motion it is.")
      .def_ro("regime", &PythonCase::regime, "Of its motion, a Regime.")
      .def_prop_ro(
          "moments", [](const PythonCase& of) { return array_of(of.moments); },
          "About the body axes, in any order.")
      .def_prop_ro(
          "q0", [](const PythonCase& of) { return array_of(of.q0); },
          "Attitude at t = 0, as it is to be given: few digits, not of length 1.")
      .def_prop_ro(
          "omega0", [](const PythonCase& of) { return array_of(of.omega0); },
          "Angular velocity at t = 0, body axes.")
      .def_ro("bound", &PythonCase::bound, "No sample is farther from the exact one.")
      .def("__repr__", [](const PythonCase& of) {
        return "<GoldenCase: " + of.name + ", " + std::to_string(of.rows().size()) + " samples>";
      });
  using S = io::GoldenSample;
  def_records<S>(c, {{"t", [](const S& s) { return &s.t; }, "(N,): times."},
                     {"q", [](const S& s) { return &s.q.w; }, "(N, 4): attitudes, w >= 0.", {4}},
                     {"omega",
                      [](const S& s) { return &s.omega.x; },
                      "(N, 3): angular velocities, body axes.",
                      {3}}});
}

}  // namespace

void bind_golden(nb::module_& m) {
  bind_case(m);
  m.def(
      "golden_cases",
      [] {
        std::vector<PythonCase> cases;
        for (const io::GoldenCase& one : io::golden_cases()) cases.emplace_back(one);
        return cases;
      },
      "Exact torque-free rotations over every regime, for the tests of other engines.");
  m.def(
      "write_golden",
      [](Typed<"str | os.PathLike[str]"> folder) {
        const nb::module_ os = nb::module_::import_("os");
        const nb::bytes path = nb::bytes(nb::object(os.attr("fsencode")(folder)));
        io::write_golden({path.c_str(), path.size()}, io::golden_cases());
      },
      "folder"_a,
      "Writes golden.json and golden.csv into a folder, which is made if it is not there.");
  m.def("regime_name", &io::regime_name, "regime"_a, "\"short_axis\", as files call it.");
}

}  // namespace polhode::python
