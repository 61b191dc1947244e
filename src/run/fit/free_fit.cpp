// SPDX-License-Identifier: MIT
#include "run/detail/free_fit.hpp"

#include "polhode/scenario/fit_plan.hpp"
#include "scenario/value_access.hpp"
#include "scenario/value_reader.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void require_free_fit(const Scenario& scenario) {
  const Rotation& rotation = scenario.rotation();
  const Values& values = scenario.document.checked->values;
  if (!rotation.kinds.empty())
    refuse(values, "perturbation[0].kind", scenario.document.path,
           "expected no perturbation: a fit is one of free rotation");
  const FitDrive& drive = require_fit(scenario).drive;
  if (!drive.parameters.empty())
    refuse(values, "free.parameter[0].key", scenario.document.path,
           "expected none: light curves are fitted in free rotation");
  if (!drive.jumps.empty())
    refuse(values, "free.jump[0].kind", scenario.document.path,
           "expected none: light curves are fitted in free rotation");
  if (!rotation.frame.is_inertial())
    refuse(values, "frame", scenario.document.path,
           "expected none: a fit is one relative to inertial axes");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
