// SPDX-License-Identifier: MIT
#include <string>

#include "interface/arrays.hpp"
#include "io/io_parts.hpp"
#include "motion/samples.hpp"
#include "polhode/tables/aem.hpp"

namespace polhode::python {
namespace {

using AemSelf = nb::handle_t<io::AemSegment>;

// A view onto the vectors of a segment; (0, ...) for none.
template <class Item>
FloatArray aem_rows(AemSelf self, const std::vector<Item>& rows,
                    std::initializer_list<std::size_t> inner) {
  return view_of(reinterpret_cast<const double*>(rows.data()), rows.size(), sizeof(Item), inner,
                 self);
}

void bind_segment(nb::module_& m) {
  nb::class_<io::AemSegment>(m, "AemSegment", R"(A segment of an Attitude Ephemeris Message.

q takes components along frame_b to those along frame_a, scalar first, as long as the file has it;
omega is the angular velocity of frame_b relative to frame_a along the axes of frame_b.)")
      .def_ro("object_name", &io::AemSegment::object_name, "OBJECT_NAME of the message.")
      .def_ro("object_id", &io::AemSegment::object_id, "OBJECT_ID of the message.")
      .def_ro("center", &io::AemSegment::center, "CENTER_NAME, or empty.")
      .def_ro("frame_a", &io::AemSegment::frame_a, "REF_FRAME_A of the message.")
      .def_ro("frame_b", &io::AemSegment::frame_b, "REF_FRAME_B of the message.")
      .def_ro("time_system", &io::AemSegment::time_system,
              "TIME_SYSTEM of the message: \"UTC\", \"TDB\", ...")
      .def_ro("attitude_type", &io::AemSegment::attitude_type,
              "ATTITUDE_TYPE of the message: \"QUATERNION\", ...")
      .def_ro("start", &io::AemSegment::start, "START_TIME.")
      .def_ro("stop", &io::AemSegment::stop, "STOP_TIME.")
      .def_ro("epochs", &io::AemSegment::epochs, "The dates of the rows, as the file has them.")
      .def_prop_ro(
          "t",
          [](AemSelf self) { return aem_rows(self, nb::cast<const io::AemSegment&>(self).t, {}); },
          "(N,): seconds from the first row of the file.")
      .def_prop_ro(
          "q",
          [](AemSelf self) {
            return aem_rows(self, nb::cast<const io::AemSegment&>(self).q_AB, {4});
          },
          "(N, 4): frame_b to frame_a, scalar first.")
      .def_prop_ro(
          "omega", [](AemSelf self) -> Typed<"numpy.typing.NDArray[numpy.float64] | None"> {
            const io::AemSegment& segment = nb::cast<const io::AemSegment&>(self);
            if (segment.w_AB_B.empty()) return nb::none();
            return aem_rows(self, segment.w_AB_B, {3});
          },
          "(N, 3): rad/s along frame_b; None where the file has none.")
      .def_prop_ro(
          "spin_rate", [](AemSelf self) -> Typed<"numpy.typing.NDArray[numpy.float64] | None"> {
            const io::AemSegment& segment = nb::cast<const io::AemSegment&>(self);
            if (segment.w3.empty()) return nb::none();
            return aem_rows(self, segment.w3, {});
          },
          "(N,): of SPIN, the angular velocity along axis 3 of frame_b in rad/s; otherwise None.")
      .def("__len__", [](const io::AemSegment& s) { return s.t.size(); })
      .def("__repr__", [](const io::AemSegment& s) {
        return "<AemSegment: " + s.object_name + ", " + std::to_string(s.t.size()) + " rows from " +
               s.start + " " + s.time_system + ">";
      });
}

}  // namespace

void bind_aem(nb::module_& m) {
  bind_segment(m);
  nb::class_<io::AttitudeEphemeris>(m, "AttitudeEphemeris",
                                    "What a CCSDS Attitude Ephemeris Message holds.")
      .def_ro("version", &io::AttitudeEphemeris::version, "CCSDS_AEM_VERS.")
      .def_ro("creation_date", &io::AttitudeEphemeris::creation_date,
              "CREATION_DATE of the message.")
      .def_ro("originator", &io::AttitudeEphemeris::originator, "ORIGINATOR of the message.")
      .def_ro("comments", &io::AttitudeEphemeris::comments, "Those of the header, a line each.")
      .def_ro("segments", &io::AttitudeEphemeris::segments, "One or more, each with rows.")
      .def("__repr__", [](const io::AttitudeEphemeris& e) {
        return "<AttitudeEphemeris: version " + e.version + ", " +
               std::to_string(e.segments.size()) + " segments>";
      });
  m.def(
      "read_aem",
      [](Typed<"str | os.PathLike[str]"> path) {
        const nb::module_ os = nb::module_::import_("os");
        const nb::bytes name = nb::bytes(nb::object(os.attr("fsencode")(path)));
        return io::read_aem({name.c_str(), name.size()});
      },
      "path"_a,
      R"(The attitudes of a CCSDS Attitude Ephemeris Message (KVN text, version 1.0 or 2.0).

A path that ends in .gz is unpacked. ValueError "FILE:LINE: ..." for the first thing wrong. The
parser knows quaternions and Euler angles, alone, with derivatives or angular velocity, and SPIN;
both directions of the rotation. It rejects QUATERNION/RATE and EULER_ANGLE/RATE of version 1, whose
rates some programs take for derivatives of angles and others for an angular velocity.)");
}

}  // namespace polhode::python
