// SPDX-License-Identifier: MIT
// Attitude Ephemeris Messages (CCSDS 504.0-B, text form) as a run writes them: what PATH.aem needs
// to know beyond its rows. polhode/tables/aem.hpp reads them and says what their numbers mean.
//
// Equations   those of polhode/tables/aem.hpp.
// Units       seconds; in the file dates, degrees, degrees per second.
// Domain      version 1.0 (2008) or 2.0 (2024), one segment, A inertial, B the body axes of the
//             scenario.
// Accuracy    numbers are the shortest that read back to the same double; dates are rounded to a
//             nanosecond.
// Errors      none here; open_sink refuses what an AEM cannot hold.
// Cost        about a microsecond per row.
#pragma once

#include <string>

namespace polhode {
inline namespace v0 {

// [output.aem]; an empty text is left to what the scenario says.
struct AemOptions {
  enum class Form { quaternion, quaternion_rate, euler, spin };
  Form form = Form::quaternion;
  int version = 1;
  bool scalar_first = false;
  bool body_to_frame = false;  // ATTITUDE_DIR = B2A
  std::string object_name = {};
  std::string object_id = {};
  std::string originator = "POLHODE";
  std::string creation_date = {};
  std::string center = {};
  std::string frame_a = {};
  std::string frame_b = "SC_BODY_1";
};

// What an AEM needs of a scenario besides its rows.
struct AemOutput {
  AemOptions options;
  std::string name;   // of the object, where the options have none
  std::string epoch;  // of t = 0
  std::string axes;
  bool moving_frame = false;
  double seconds = 1.0;  // in the unit of time of the rows
  double first = 0.0;    // times of the rows, in that unit
  double last = 0.0;
  bool rising = true;  // whether each row is later than the one before
};

}  // namespace v0
}  // namespace polhode
