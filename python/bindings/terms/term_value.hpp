// SPDX-License-Identifier: MIT
// Terms and orbits, as Python holds them.
#pragma once

#include "interface/recipe.hpp"
#include "polhode/perturb/any_perturbation.hpp"

namespace polhode::python {

// Python's class AnyPerturbation, the base of all terms: nb::cast<const PythonTerm&>(object) is an
// AnyPerturbation.
struct PythonTerm : AnyPerturbation {
  explicit PythonTerm(AnyPerturbation term, Recipe made_from = {})
      : AnyPerturbation(std::move(term)), recipe(std::move(made_from)) {}

  Recipe recipe;
};

}  // namespace polhode::python
