// SPDX-License-Identifier: MIT
#include <string>

#include "interface/arrays.hpp"
#include "io/io_parts.hpp"
#include "motion/samples.hpp"
#include "polhode/tables/oem.hpp"

namespace polhode::python {
namespace {

using OemSelf = nb::handle_t<io::OemSegment>;

// A view onto the vectors of a segment.
template <class Item>
FloatArray oem_rows(OemSelf self, const std::vector<Item>& rows,
                    std::initializer_list<std::size_t> inner) {
  return view_of(reinterpret_cast<const double*>(rows.data()), rows.size(), sizeof(Item), inner,
                 self);
}

}  // namespace

void bind_oem(nb::module_& m) {
  nb::class_<io::OemSegment>(m, "OemSegment",
                             "A segment of an Orbit Ephemeris Message; km and km/s.")
      .def_ro("object_name", &io::OemSegment::object_name, "OBJECT_NAME of the message.")
      .def_ro("object_id", &io::OemSegment::object_id, "OBJECT_ID of the message.")
      .def_ro("center", &io::OemSegment::center, "CENTER_NAME.")
      .def_ro("frame", &io::OemSegment::frame, "REF_FRAME.")
      .def_ro("time_system", &io::OemSegment::time_system,
              "TIME_SYSTEM of the message: \"UTC\", \"TDB\", ...")
      .def_ro("start", &io::OemSegment::start, "USEABLE_START_TIME, or else START_TIME.")
      .def_ro("stop", &io::OemSegment::stop, "USEABLE_STOP_TIME, or else STOP_TIME.")
      .def_ro("epochs", &io::OemSegment::epochs, "The dates of the rows, as the file has them.")
      .def_prop_ro(
          "t",
          [](OemSelf self) { return oem_rows(self, nb::cast<const io::OemSegment&>(self).t, {}); },
          "(N,): seconds from the first row of the file.")
      .def_prop_ro(
          "position",
          [](OemSelf self) {
            return oem_rows(self, nb::cast<const io::OemSegment&>(self).position, {3});
          },
          "(N, 3): km, from the centre to the object.")
      .def_prop_ro(
          "velocity",
          [](OemSelf self) {
            return oem_rows(self, nb::cast<const io::OemSegment&>(self).velocity, {3});
          },
          "(N, 3): km/s.")
      .def("__len__", [](const io::OemSegment& s) { return s.t.size(); })
      .def("__repr__", [](const io::OemSegment& s) {
        return "<OemSegment: " + s.object_name + ", " + std::to_string(s.t.size()) + " rows from " +
               s.start + " " + s.time_system + ">";
      });
  nb::class_<io::OrbitEphemeris>(m, "OrbitEphemeris", "What a CCSDS Orbit Ephemeris Message holds.")
      .def_ro("version", &io::OrbitEphemeris::version, "CCSDS_OEM_VERS.")
      .def_ro("creation_date", &io::OrbitEphemeris::creation_date, "CREATION_DATE of the message.")
      .def_ro("originator", &io::OrbitEphemeris::originator, "ORIGINATOR of the message.")
      .def_ro("segments", &io::OrbitEphemeris::segments, "One or more, each with rows.")
      .def("__repr__", [](const io::OrbitEphemeris& e) {
        return "<OrbitEphemeris: version " + e.version + ", " + std::to_string(e.segments.size()) +
               " segments>";
      });
  m.def(
      "read_oem",
      [](Typed<"str | os.PathLike[str]"> path) {
        const nb::module_ os = nb::module_::import_("os");
        const nb::bytes name = nb::bytes(nb::object(os.attr("fsencode")(path)));
        return io::read_oem({name.c_str(), name.size()});
      },
      "path"_a,
      R"(Positions and velocities of a CCSDS Orbit Ephemeris Message (KVN text).

ValueError "FILE:LINE: ..." for the first thing wrong. Accelerations and covariances are
skipped.)");
}

}  // namespace polhode::python
