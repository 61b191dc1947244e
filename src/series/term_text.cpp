// SPDX-License-Identifier: MIT
#include "polhode/series/detail/term_text.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

constexpr std::array<std::string_view, 35> greek = {
    "alpha", "beta",  "gamma",   "delta", "epsilon", "varepsilon", "zeta",  "eta",   "theta",
    "iota",  "kappa", "lambda",  "mu",    "nu",      "xi",         "pi",    "rho",   "sigma",
    "tau",   "phi",   "upsilon", "chi",   "psi",     "omega",      "Phi",   "Gamma", "Delta",
    "Theta", "Xi",    "Lambda",  "Pi",    "Sigma",   "Psi",        "Omega", "varpi"};

std::string latex_word(std::string_view word) {
  const bool is_greek = std::find(greek.begin(), greek.end(), word) != greek.end();
  return (is_greek ? "\\" : "") + std::string(word);
}

// "phi_l" is \phi_{l}, "e" is e, "Om" is \mathrm{Om}.
std::string latex_name(std::string_view name) {
  const std::size_t bar = name.find('_', 1);
  const std::string_view stem = name.substr(0, bar);
  std::string out = latex_word(stem);
  if (out.size() == stem.size() && stem.size() > 1 && stem[1] != '\'')
    out = "\\mathrm{" + out + "}";
  if (bar != std::string_view::npos && bar + 1 < name.size()) {
    std::string index = latex_word(name.substr(bar + 1));
    std::replace(index.begin(), index.end(), '_', ',');
    out += "_{" + index + "}";
  }
  return out;
}

}  // namespace

void add_term(std::string& sum, std::string coefficient, const std::string& product,
              const char* times) {
  const bool negative = coefficient.starts_with('-');
  if (negative) coefficient.erase(0, 1);
  if (sum.empty())
    sum += negative ? "-" : "";
  else
    sum += negative ? " - " : " + ";
  if (product == "1")
    sum += coefficient;
  else
    sum += coefficient == "1" ? product : coefficient + times + product;
}

std::string latex(const Symbols& symbols, const TermKey& key) {
  std::string product;
  const auto add = [](std::string& to, const char* between, const std::string& what) {
    if (!to.empty()) to += between;
    to += what;
  };
  for (int i = 0; i < symbols.exponents().count(); ++i) {
    const int n = exponent(symbols, key, i);
    if (n == 0) continue;
    const std::string name = latex_name(symbols.variables()[static_cast<std::size_t>(i)]);
    if (n == 1)
      add(product, " ", name);
    else if (name.find('\'') == std::string::npos)
      add(product, " ", name + "^{" + std::to_string(n) + "}");
    else  // a prime is an exponent already
      add(product, " ", "{" + name + "}^{" + std::to_string(n) + "}");
  }
  std::string angle;
  for (int i = 0; i < symbols.multipliers().count(); ++i) {
    const int n = multiplier(symbols, key, i);
    if (n == 0) continue;
    if (n < 0)
      angle += angle.empty() ? "-" : " - ";
    else
      add(angle, " + ", "");
    if (std::abs(n) != 1) angle += std::to_string(std::abs(n)) + " ";
    angle += latex_name(symbols.angles()[static_cast<std::size_t>(i)]);
  }
  if (!angle.empty())
    add(product, " ", (key.function() == Trigonometric::sine ? "\\sin(" : "\\cos(") + angle + ")");
  return product.empty() ? "1" : product;
}

std::string latex_number(const std::string& number) {
  const std::string sign = number.starts_with('-') ? "-" : "";
  const std::string digits = number.substr(sign.size());
  if (const std::size_t slash = digits.find('/'); slash != std::string::npos)
    return sign + "\\frac{" + digits.substr(0, slash) + "}{" + digits.substr(slash + 1) + "}";
  if (const std::size_t e = digits.find('e'); e != std::string::npos) {
    std::string power = digits.substr(e + 1);
    const bool negative = power.starts_with('-');
    power.erase(0, std::min(power.find_first_not_of("+-0"), power.size() - 1));
    return sign + digits.substr(0, e) + " \\cdot 10^{" + (negative ? "-" : "") + power + "}";
  }
  return number;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
