// SPDX-License-Identifier: MIT
#include "scenario/kinds/frames/rate_formula.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr int most_power = 20;

// Reads one text, from the left.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool is_at_end() {
    skip();
    return at_ == text_.size();
  }
  bool takes(std::string_view word) {
    skip();
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  bool is_number() {
    skip();
    return at_ < text_.size() &&
           (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.');
  }
  double number() {
    if (!is_number()) fail("a number");
    double x = 0.0;
    const char* const first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), x);
    if (error != std::errc{} || !std::isfinite(x)) fail("a finite number");
    at_ += static_cast<std::size_t>(end - first);
    return x;
  }
  // -1 or 1; 0 if there is none.
  double sign() { return takes("-") ? -1.0 : takes("+") ? 1.0 : 0.0; }

  [[noreturn]] void fail(const std::string& expected) {
    skip();
    throw DomainError("expected " + expected + " at \"" + std::string(text_.substr(at_, 20)) +
                      "\", character " + std::to_string(at_ + 1) +
                      "; a rate is a sum of terms such as 5e-3, 1e-5*t, 2e-7*t^2, "
                      "3e-4*cos(0.1*t + 0.2) and 3e-4*sin(0.1*t)");
  }

 private:
  void skip() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

// A product of numbers and at most one of: a power of t, a sine or a cosine of a*t + b.
struct FormulaTerm {
  double factor = 1.0;
  int power = 0;
  bool has_wave = false, is_sine = false;
  double frequency = 0.0, phase = 0.0;
};

// Reads a*t + b, in any order, and the bracket that closes it.
void read_line(Reader& in, FormulaTerm& term) {
  bool first = true;
  while (first || !in.takes(")")) {
    double factor = in.sign();
    if (factor == 0.0) {
      if (!first) in.fail("+, - or )");
      factor = 1.0;
    }
    first = false;
    bool has_t = in.takes("t");
    if (!has_t) factor *= in.number();
    while (in.takes("*")) {
      if (!has_t && in.takes("t"))
        has_t = true;
      else
        factor *= in.number();
    }
    (has_t ? term.frequency : term.phase) += factor;
  }
}

void read_factor(Reader& in, FormulaTerm& term) {
  const bool is_free = term.power == 0 && !term.has_wave;
  if (in.is_number()) {
    term.factor *= in.number();
  } else if (is_free && (in.takes("cos(") || (term.is_sine = in.takes("sin(")))) {
    term.has_wave = true;
    read_line(in, term);
  } else if (is_free && in.takes("t")) {
    term.power = 1;
    if (!in.takes("^")) return;
    const double power = in.number();
    if (!(power >= 1.0) || power > most_power || power != std::floor(power))
      in.fail("a whole power from 1 to " + std::to_string(most_power) + " before");
    term.power = static_cast<int>(power);
  } else {
    in.fail(is_free ? "a number, t, sin( or cos(" : "a number");
  }
}

}  // namespace

RateFormula::RateFormula(std::string_view text) {
  Reader in(text);
  bool first = true;
  while (!in.is_at_end() || first) {
    FormulaTerm term;
    const double sign = in.sign();
    if (sign == 0.0 && !first) in.fail("+, - or *");
    if (sign < 0.0) term.factor = -1.0;
    first = false;
    do read_factor(in, term);
    while (in.takes("*"));
    if (!std::isfinite(term.factor) || !std::isfinite(term.frequency) || !std::isfinite(term.phase))
      in.fail("finite numbers before the end of the term");
    if (term.has_wave && term.frequency != 0.0) {
      const double phase = term.is_sine ? term.phase - 0.5 * std::numbers::pi : term.phase;
      waves_.push_back({term.factor, term.frequency, phase});
      continue;
    }
    if (term.has_wave) term.factor *= term.is_sine ? std::sin(term.phase) : std::cos(term.phase);
    const auto n = static_cast<std::size_t>(term.power);
    if (powers_.size() <= n) powers_.resize(n + 1, 0.0);
    powers_[n] += term.factor;
  }
}

RateFormula RateFormula::in_units(double time, double rate) const {
  RateFormula made = *this;
  for (std::size_t n = 0; n < made.powers_.size(); ++n)
    made.powers_[n] *= rate / std::pow(time, static_cast<double>(n));
  for (Wave& w : made.waves_) {
    w.amplitude *= rate;
    w.frequency /= time;
  }
  return made;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
