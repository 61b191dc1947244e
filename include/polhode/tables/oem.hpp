// SPDX-License-Identifier: MIT
// Orbit Ephemeris Messages (CCSDS 502.0-B, text form): positions and velocities of an object.
//
// Units       those of the file, km and km/s; seconds from the first row of the file.
// Domain      versions 1.0, 2.0 and 3.0, any number of segments; accelerations and covariance
//             matrices are skipped. Time systems UTC, TAI, TT, TDB, GPS.
// Accuracy    the nearest double; dates to a nanosecond.
// Errors      DomainError "FILE:LINE: ..." for the first thing wrong: fields, dates that do not
//             rise, keywords that are missing.
// Cost        about a microsecond per row.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

struct OemSegment {
  std::string object_name;
  std::string object_id;
  std::string center;
  std::string frame;       // REF_FRAME
  std::size_t frame_line;  // of the file, from 1: where it stands
  std::string time_system;
  std::string start;  // where interpolation may begin: USEABLE_START_TIME or START_TIME
  std::string stop;   // and end
  std::vector<std::string> epochs;  // of the rows, as the file has them
  std::vector<double> t;            // s from the first row of the file
  std::vector<Vec3> position;       // km, from the centre to the object
  std::vector<Vec3> velocity;       // km/s
};

struct OrbitEphemeris {
  std::string version;
  std::string creation_date;
  std::string originator;
  std::vector<OemSegment> segments;  // one or more, each with rows
};

// `name` stands for the file in messages.
OrbitEphemeris oem_from_text(std::string_view text, const std::string& name);
// Files of at most 1 GiB.
OrbitEphemeris read_oem(const std::string& path);

}  // namespace io
}  // namespace v0
}  // namespace polhode
