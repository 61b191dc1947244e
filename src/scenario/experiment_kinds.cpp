// SPDX-License-Identifier: MIT
#include "scenario/detail/experiment_kinds.hpp"

#include <stdexcept>
#include <utility>

#include "scenario/detail/rotation_kind.hpp"
#include "scenario/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

std::vector<SchemaPart> rotation_keys(const DescribedParts& described) {
  return {body_keys(),    state_keys(),      frame_keys(),
          orbit_keys(),   described.orbits,  described.perturbations,
          surface_keys(), described.methods, event_keys(),
          time_keys()};
}

MadeExperiment make_rotation(const KindContext& of) {
  const auto base = std::make_shared<const MadeRotation>(made_rotation(of));
  return {
      base->rotation, [base](const KindContext& at, std::vector<std::string> changed) -> Remake {
        return [at, base, changed = std::move(changed)](const Values& values) {
          return Experiment(
              made_rotation({values, at.units, at.kinds, at.output, at.name}, base.get(), changed)
                  .rotation);
        };
      }};
}

constexpr ExperimentKind kinds[] = {
    {"rotation", rotation_keys, make_rotation},
};

}  // namespace

std::span<const ExperimentKind> experiment_kinds() { return kinds; }

const ExperimentKind& kind_of(const Values& values) {
  const std::string& name = word(values, "kind");
  for (const ExperimentKind& kind : kinds)
    if (kind.name == name) return kind;
  throw std::logic_error("kind: the schema allows one that has no row: " + name);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
