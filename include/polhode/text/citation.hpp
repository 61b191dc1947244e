// SPDX-License-Identifier: MIT
// Citation: a work that something rests on, and what is taken from it.
//
// Domain      texts are constant data: they outlive every kind and scenario.
// Cost        bibtex searches 33 kB of text.
#pragma once

#include <string>
#include <string_view>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace io {

struct Citation {
  std::string_view key;     // "sadov1970"
  std::string_view text;    // authors, year, title, place
  std::string_view reason;  // what is taken from it
};

// Its entry of docs/references.bib, for BibTeX. A work that has none there, of a kind of your own,
// is @misc{key, howpublished = {text}}.
std::string bibtex(const Citation& citation);

}  // namespace io
}  // namespace v0
}  // namespace polhode
