// SPDX-License-Identifier: MIT
// Terms put together to a sum, as text and as LaTeX.
#pragma once

#include <string>

#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

// "(G - 1)", or "G" if the value is 0.
std::string displacement_text(const std::string& name, double value);
// The name of a variable, or its displacement if it has a value.
std::string base_text(const Symbols& symbols, int variable);

// Adds coefficient * product to the text of a sum; a coefficient of 1 goes where it can.
void add_term(std::string& sum, std::string coefficient, const std::string& product,
              const char* times);
std::string latex(const Symbols& symbols, const TermKey& key);
// "3/4" becomes a fraction, "1e-5" a power of ten.
std::string latex_number(const std::string& number);

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
