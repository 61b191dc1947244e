// SPDX-License-Identifier: MIT
#include "run/ensemble/failures.hpp"

#include <algorithm>
#include <vector>

#include "output/closing_notes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::size_t reasons_shown = 3;

std::string text_of(const EnsembleReport::Failure& failure) {
  return "member " + std::to_string(failure.member) + ": " + failure.why;
}

}  // namespace

void say_failures(Sink& sink, std::span<const EnsembleReport::Failure> failures,
                  std::int64_t failed, std::int64_t members) {
  if (failed == 0) return;
  std::vector<std::string> notes = {std::to_string(failed) + " of " + std::to_string(members) +
                                    " members"};
  for (const EnsembleReport::Failure& failure :
       failures.first(std::min(failures.size(), failures_named)))
    notes.push_back(text_of(failure));
  close_with(sink, "failed", notes);
}

std::string all_failed_text(const std::string& name,
                            std::span<const EnsembleReport::Failure> failures,
                            std::int64_t members) {
  std::string text =
      name + ": " +
      (members == 1 ? "the one member" : "all " + std::to_string(members) + " members") +
      " failed, so that there are no results";
  const std::size_t shown = std::min(failures.size(), reasons_shown);
  for (std::size_t i = 0; i < shown; ++i) text += "\n  " + text_of(failures[i]);
  return failures.size() > shown ? text + "\n  ..." : text;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
