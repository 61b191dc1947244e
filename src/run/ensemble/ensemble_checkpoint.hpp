// SPDX-License-Identifier: MIT
// What a checkpoint of an ensemble must agree in, and whether two machines compute alike to the
// last bit: polhode's own kernels do; sines and logarithms are those of the C library, which has
// several of each and takes one that the processor can run.
#pragma once

#include <string>
#include <vector>

#include "polhode/run/ensemble_run.hpp"
#include "run/detail/checkpoint.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A mark of what they give for some arguments.
IdentityPart elementary_functions();

// For a comparison in which they do not matter: theirs as ours, and where they differ the numbers
// of orbits and torques too, which are made with them.
void take_elementary_functions(Identity& theirs, const Identity& ours);
// Whether it is this part that two differ in, as difference() says it.
bool differs_in_elementary_functions(const std::string& difference);

// DomainError for a path that is no table.
KeptSetup setup_of_ensemble(const ScenarioEnsemble& ensemble,
                            const std::vector<ColumnGroup>& groups,
                            const std::vector<std::string>& paths, const EnsembleOptions& options);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
