// SPDX-License-Identifier: MIT
// Terms, as Python holds them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "interface/recipe.hpp"
#include "polhode/perturb/any_perturbation.hpp"

namespace polhode::python {

struct TermClass;

// Python's class AnyPerturbation, the base of all terms. What acts is one term or several, as a
// table [[perturbation]] makes them.
struct PythonTerm {
  explicit PythonTerm(AnyPerturbation term) : parts{std::move(term)} {}
  PythonTerm(const TermClass& made_by, std::vector<AnyPerturbation> terms, Recipe made_from)
      : parts(std::move(terms)), recipe(std::move(made_from)), of(&made_by) {}

  const std::string& name() const { return parts.front().name(); }

  std::vector<AnyPerturbation> parts;
  Recipe recipe;
  const TermClass* of = nullptr;  // null where C++ made it
};

}  // namespace polhode::python
