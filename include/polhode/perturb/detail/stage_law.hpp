// SPDX-License-Identifier: MIT
// The law of a term as those see it who ask for several bodies at a time.
#pragma once

#include <concepts>
#include <span>

#include "polhode/perturb/detail/law_on_stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class StageLaw {
 public:
  virtual ~StageLaw() = default;
  // Whether one does for the bodies of both: the same law, with the same numbers.
  virtual bool serves(const StageLaw& other) const = 0;
  // What the term has said of the step to come.
  virtual std::span<const StageRow> of_time() const = 0;
  virtual void add_to(const LawRows& rows) const = 0;
};

template <class Law>
class StageLawOf : public StageLaw {
 public:
  // A law of a user's may throw: each body is asked by itself.
  bool serves(const StageLaw& other) const override {
    if constexpr (LibraryLaw<Law> && std::equality_comparable<Law>) {
      const auto* same = dynamic_cast<const StageLawOf*>(&other);
      return same != nullptr && law_itself() == same->law_itself();
    } else {
      return false;
    }
  }
  virtual Law law_itself() const = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
