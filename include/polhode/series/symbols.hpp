// SPDX-License-Identifier: MIT
// The names that a series is written in: variables, which have exponents, and angles, which have
// multipliers; which of them are conjugate; and the values of momenta about which coefficients are
// expanded.
//
// Equations   a pair (q, p) has dq/dt = dH/dp, dp/dt = -dH/dq.
// Units       angles in radians; a variable has the unit that its user gives it.
// Domain      up to 12 variables and 12 angles. A name is a letter or _ and then letters, digits,
//             _ or ', and not cos or sin. A symbol is in one pair at most. A momentum is a
//             variable; a coordinate may be an angle (Andoyer's) or a variable (Poincare's).
//             Exponents and multipliers are integers of either sign, in the range of PackedFields:
//             below 2^14 up to 3 of them, 2^10 at 5, 2^5 at 9, 2^3 at 12. Variables with a value
//             come first and are no coordinates: coefficients are functions of them
//             (taylor_coefficient.hpp), and a power of one in a key is a power of its
//             displacement from the value.
// Accuracy    exact.
// Errors      DomainError for names that break this, and for one that is not there.
// Cost        a copy shares the table; equal tables made apart are equal.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/series/packed_fields.hpp"

namespace polhode {
inline namespace v0 {

struct ConjugatePair {
  std::string coordinate, momentum;
  bool operator==(const ConjugatePair&) const = default;
};

class Symbols {
 public:
  Symbols(std::vector<std::string> variables, std::vector<std::string> angles,
          std::vector<ConjugatePair> pairs = {},
          const std::vector<std::pair<std::string, double>>& values = {});

  const std::vector<std::string>& variables() const { return table_->variables; }
  const std::vector<std::string>& angles() const { return table_->angles; }
  const std::vector<ConjugatePair>& pairs() const { return table_->pairs; }
  // The values of the first variables, in order.
  const std::vector<double>& values() const { return table_->values; }
  const PackedFields& exponents() const { return table_->exponents; }
  const PackedFields& multipliers() const { return table_->multipliers; }

  bool has_variable(std::string_view name) const;
  bool has_angle(std::string_view name) const;
  // Its place among variables() or angles(); throws where there is none.
  int variable(std::string_view name) const;
  int angle(std::string_view name) const;
  // "variables e, G; angles l, g".
  std::string names() const;
  // "G = 1, L = 0.5"; empty without values.
  std::string values_text() const;

  friend bool operator==(const Symbols& a, const Symbols& b) {
    return a.table_ == b.table_ || *a.table_ == *b.table_;
  }

 private:
  struct Table {
    std::vector<std::string> variables, angles;
    std::vector<ConjugatePair> pairs;
    std::vector<double> values;
    PackedFields exponents, multipliers;
    // The fields follow from the names.
    bool operator==(const Table& b) const {
      return variables == b.variables && angles == b.angles && pairs == b.pairs &&
             values == b.values;
    }
  };
  std::shared_ptr<const Table> table_;
};

}  // namespace v0
}  // namespace polhode
