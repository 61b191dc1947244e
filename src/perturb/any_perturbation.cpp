// SPDX-License-Identifier: MIT
#include "polhode/perturb/any_perturbation.hpp"

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void term_cannot(const std::string& name, std::string_view what) {
  throw DomainError("AnyPerturbation: term \"" + name + "\" " + std::string(what));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
