// SPDX-License-Identifier: MIT
// Attitude Ephemeris Messages (CCSDS 504.0-B, text form): what such a file holds. A run writes them
// by polhode/output/aem_options.hpp.
//
// Equations   q_AB = q1 i + q2 j + q3 k + qc takes components along the axes B to those along A,
//             v_A = q v_B q*, for ATTITUDE_DIR A2B: the vector part is the axis times sin(angle/2)
//             of the rotation that carries the axes A into the axes B. B2A is its conjugate. Euler
//             angles of "313" are phi, theta, psi; SPIN_ALPHA = phi - 90 deg, SPIN_DELTA = 90 deg -
//             theta, SPIN_ANGLE = psi, of the body axis 3.
// Units       seconds from the first row of the first segment; radians per second. In the file:
//             dates, degrees, degrees per second.
// Domain      versions 1.0 (2008) and 2.0 (2024), any number of segments; quaternions and Euler
//             angles of any sequence, alone, with derivatives or with angular velocity (of A2B);
//             SPIN. The types .../RATE of version 1 are rejected: programs take their rates for
//             derivatives of angles or for an angular velocity. Time systems UTC, TAI, TT, TDB,
//             GPS.
// Accuracy    numbers are the shortest that read back to the same double; dates are rounded to a
//             nanosecond.
// Errors      DomainError "FILE:LINE: ..." for the first thing wrong in a file.
// Cost        about a microsecond per row.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

struct AemSegment {
  std::string object_name;
  std::string object_id;
  std::string center;
  std::string frame_a;
  std::string frame_b;
  std::string time_system;
  std::string attitude_type;
  std::string start;                // START_TIME
  std::string stop;                 // STOP_TIME
  std::vector<std::string> epochs;  // of the rows, as the file has them
  std::vector<double> t;            // s from the first row of the file
  std::vector<Quaternion> q_AB;     // v_A = q v_B q*, as long as in the file
  std::vector<Vec3> w_AB_B;         // of B relative to A, along B; empty where the file has none
  std::vector<double> w3;           // only its component along axis 3 of B, of SPIN; or empty
};

struct AttitudeEphemeris {
  std::string version;
  std::string creation_date;
  std::string originator;
  std::vector<std::string> comments;
  std::vector<AemSegment> segments;  // one or more, each with rows
};

// `name` stands for the file in messages.
AttitudeEphemeris aem_from_text(std::string_view text, const std::string& name);
// Files of at most 1 GiB.
AttitudeEphemeris read_aem(const std::string& path);
// Its rows as a CSV table: t, qw, qx, qy, qz and, if a segment has them, w1, w2, w3 (only w3 of
// SPIN), empty in rows without; with several segments, their number. DomainError for segments of
// different objects or frames.
std::string aem_csv(const AttitudeEphemeris& ephemeris);

}  // namespace io
}  // namespace v0
}  // namespace polhode
