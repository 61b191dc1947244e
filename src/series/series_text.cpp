// SPDX-License-Identifier: MIT
// Series as text: words and numbers of a formula, rows of CSV, and terms as plain text or LaTeX.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "polhode/error.hpp"
#include "polhode/series/detail/csv_rows.hpp"
#include "polhode/series/detail/lexer.hpp"
#include "polhode/series/detail/term_text.hpp"
#include "polhode/series/detail/words.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

namespace {

std::size_t digits(std::string_view text, std::size_t i) {
  while (i < text.size() && is_digit(text[i])) ++i;
  return i;
}

// Digits, perhaps a point and a power of ten. An e without digits after it is a name.
std::size_t end_of_number(std::string_view text, std::size_t i) {
  i = digits(text, i);
  if (i < text.size() && text[i] == '.') i = digits(text, i + 1);
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    const bool is_signed = i + 1 < text.size() && (text[i + 1] == '+' || text[i + 1] == '-');
    const std::size_t power = i + (is_signed ? 2 : 1);
    if (digits(text, power) > power) i = digits(text, power);
  }
  return i;
}

std::size_t end_of_word(std::string_view text, std::size_t i) {
  if (i == text.size()) return i;
  if (is_digit(text[i]) || (text[i] == '.' && digits(text, i + 1) > i + 1))
    return end_of_number(text, i);
  if (!is_letter(text[i])) return i + 1;
  while (i < text.size() && is_name_character(text[i])) ++i;
  return i;
}

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

Lexer::Lexer(std::string_view text) : text_(text) { advance(); }

bool Lexer::is_number() const {
  return !word_.empty() && (is_digit(word_[0]) || word_.size() > 1) && !is_letter(word_[0]);
}
bool Lexer::is_name() const { return !word_.empty() && is_letter(word_[0]); }

void Lexer::advance() {
  begin_ += word_.size();
  while (begin_ < text_.size() && is_space(text_[begin_])) ++begin_;
  word_ = text_.substr(begin_, end_of_word(text_, begin_) - begin_);
}

bool Lexer::takes(std::string_view word) {
  if (word_ != word) return false;
  advance();
  return true;
}

void Lexer::expect(std::string_view word) {
  if (!takes(word)) refuse(quoted(word));
}

int Lexer::integer() {
  const bool negative = takes("-");
  int n = 0;
  const auto [end, error] = std::from_chars(word_.data(), word_.data() + word_.size(), n);
  if (error != std::errc{} || end != word_.data() + word_.size()) refuse("an integer");
  advance();
  return negative ? -n : n;
}

void Lexer::refuse(const std::string& expected) const {
  throw DomainError("series: column " + std::to_string(begin_ + 1) + ": " +
                    (word_.empty() ? "the end" : quoted(word_)) + "; expected " + expected);
}

namespace {

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    found.push_back(line.substr(0, comma));
    if (comma != std::string_view::npos) line.remove_prefix(comma + 1);
  }
  return found;
}

int integer(std::size_t line, std::string_view cell) {
  int n = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), n);
  if (error != std::errc{} || end != cell.data() + cell.size())
    refuse_row(line, cell, "is no exponent or multiplier: an integer");
  return n;
}

CsvRow row_of(const Symbols& symbols, std::size_t line, std::string_view text, bool has_known) {
  const std::vector<std::string_view> found = cells(text);
  const std::size_t variables = symbols.variables().size(), angles = symbols.angles().size();
  if (found.size() != 2 + variables + angles + (has_known ? 1 : 0))
    refuse_row(line, text, "has another number of columns than the header");
  if (found[1] != "cos" && found[1] != "sin") refuse_row(line, found[1], "is neither cos nor sin");
  std::vector<std::pair<std::string, int>> powers, multiples;
  for (std::size_t i = 0; i < variables; ++i)
    powers.emplace_back(symbols.variables()[i], integer(line, found[2 + i]));
  for (std::size_t i = 0; i < angles; ++i)
    multiples.emplace_back(symbols.angles()[i], integer(line, found[2 + variables + i]));
  const Trigonometric function = found[1] == "cos" ? Trigonometric::cosine : Trigonometric::sine;
  return {line, found[0], packed(symbols, powers, multiples, function),
          has_known ? found.back() : std::string_view()};
}

}  // namespace

void refuse_row(std::size_t line, std::string_view value, const char* why) {
  throw DomainError("series: line " + std::to_string(line) + ": " + quoted(value) + " " + why);
}

std::string csv_header(const Symbols& symbols, bool has_known) {
  std::string header = "coefficient,function";
  for (int i = 0; i < symbols.exponents().count(); ++i) header += "," + base_text(symbols, i) + "^";
  for (const std::string& name : symbols.angles()) header += "," + name;
  return header + (has_known ? ",known\n" : "\n");
}

std::string csv_row(const Symbols& symbols, const TermKey& key) {
  std::string row = key.function() == Trigonometric::sine ? ",sin" : ",cos";
  for (int i = 0; i < symbols.exponents().count(); ++i)
    row += "," + std::to_string(exponent(symbols, key, i));
  for (int i = 0; i < symbols.multipliers().count(); ++i)
    row += "," + std::to_string(multiplier(symbols, key, i));
  return row + "\n";
}

std::vector<CsvRow> csv_rows(const Symbols& symbols, std::string_view table, bool has_known) {
  std::vector<CsvRow> rows;
  std::string header = csv_header(symbols, has_known);
  header.pop_back();
  for (std::size_t line = 1; line == 1 || !table.empty(); ++line) {
    const std::size_t end = table.find('\n');
    std::string_view text = table.substr(0, end);
    table.remove_prefix(end == std::string_view::npos ? table.size() : end + 1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    if (line == 1) {
      if (text != header) refuse_row(line, text, ("is not the header " + header).c_str());
    } else if (!text.empty()) {
      rows.push_back(row_of(symbols, line, text, has_known));
    }
  }
  return rows;
}

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

std::string latex_base(const Symbols& symbols, int variable) {
  const auto i = static_cast<std::size_t>(variable);
  const std::string name = latex_name(symbols.variables()[i]);
  return i < symbols.values().size() ? displacement_text(name, symbols.values()[i]) : name;
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
    const std::string name = latex_base(symbols, i);
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
}  // namespace series
}  // namespace v0
}  // namespace polhode
