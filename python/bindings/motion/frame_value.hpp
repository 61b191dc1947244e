// SPDX-License-Identifier: MIT
// Frame, as Python holds it.
#pragma once

#include <string>

#include "interface/recipe.hpp"
#include "polhode/frame/frame.hpp"

namespace polhode {
inline namespace v0 {

// Python compares whatever it holds.
inline bool operator==(const FrameMotion& a, const FrameMotion& b) {
  return a.q_IS == b.q_IS && a.mu_S == b.mu_S;
}

}  // namespace v0
}  // namespace polhode

namespace polhode::python {

// Python's class Frame: nb::cast<const PythonFrame&>(object) is a Frame.
struct PythonFrame : Frame {
  explicit PythonFrame(Frame frame, Recipe made_from = {})
      : Frame(std::move(frame)), recipe(std::move(made_from)) {}

  Recipe recipe;
};

// A Frame as an argument; None is the inertial frame. TypeError for others: `where` starts the
// message.
inline nb::object frame_or_inertial(nb::handle frame, const char* where) {
  if (frame.is_none()) return nb::type<PythonFrame>().attr("inertial")();
  if (!nb::isinstance<PythonFrame>(frame))
    throw nb::type_error(
        (std::string(where) + ": frame: got " + class_name(frame) + "; expected a Frame").c_str());
  return nb::borrow(frame);
}

}  // namespace polhode::python
