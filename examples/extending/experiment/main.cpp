// SPDX-License-Identifier: MIT
// The program `polhode` with a kind of experiment of its own, "colombos-top".
#include <numbers>
#include <span>

#include "colombos_top.hpp"
#include "polhode/cli/command_line.hpp"

namespace {

using polhode::io::Dimension;
using polhode::io::KindKey;
using polhode::io::quantity_key;

struct Arguments {
  double precession;
  double node_rate;
  double inclination;
  double obliquity;
};

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::precession>("precession", Dimension::rate, "The constant alpha.")
        .required()
        .example("\"20 arcsec/yr\""),
    quantity_key<&Arguments::node_rate>("node_rate", Dimension::rate, "Of the orbit's node.")
        .required()
        .example("\"-18 arcsec/yr\""),
    quantity_key<&Arguments::inclination>("inclination", Dimension::angle, "Of the orbit.")
        .required()
        .example("\"2 deg\""),
    quantity_key<&Arguments::obliquity>("obliquity", Dimension::angle, "At t = 0, node behind.")
        .required()
        .example("\"25 deg\""),
};

polhode::io::CustomExperiment made(const Arguments& a, const polhode::io::ExperimentContext& at) {
  const ColombosTop top{a.precession, a.inclination, a.node_rate};
  const double tilt = a.obliquity - a.inclination;  // n leans the other way
  const SpinAxis start{{0.0, std::sin(tilt), std::cos(tilt)}};
  return polhode::io::custom_experiment<ColombosTop>(
      "colombos-top", at,
      {.model = top,
       .initial = start,
       .columns = {{"obliquity", Dimension::angle},
                   {"x", Dimension::number},
                   {"y", Dimension::number},
                   {"z", Dimension::number},
                   {"K", Dimension::rate}},
       .row =
           [top](const polhode::BasicSample<SpinAxis>& at_t, std::span<double> row) {
             const polhode::Vec3 s = at_t.s.s, n = top.normal(at_t.t);
             row[0] = std::atan2(norm(cross(s, n)), dot(s, n));
             row[1] = s.x;
             row[2] = s.y;
             row[3] = s.z;
             row[4] = top.energy(at_t.t, s);
           },
       .facts = {{"period", "period of precession at this obliquity",
                  2.0 * std::numbers::pi / std::abs(a.precession * std::cos(a.obliquity)),
                  Dimension::time}}});
}

polhode::io::ExperimentKind colombos_top() {
  return polhode::io::experiment_kind<Arguments>(
      "colombos-top", "The spin axis of a planet whose orbit precesses at a constant rate.", keys,
      made,
      {{"colombo1966",
        "Colombo, G. (1966). Cassini's second and third laws. The Astronomical Journal 71, "
        "891-896.",
        "the motion of the axis"}});
}

}  // namespace

int main(int argc, char** argv) {
  return polhode::command_line(argc, argv, polhode::io::default_kinds().with(colombos_top()));
}
