// SPDX-License-Identifier: MIT
// Methods: small values that say how a rotation is integrated.
//
// Equations   Adaptive: an explicit Runge-Kutta pair of high order on (q, g). Splitting: the exact
//             free rotation and the exact frame, composed with exact kicks or flows of the terms.
//             VariationOfConstants: the constants of the free rotation are the unknowns [SA (98)-
//             (103)], here the state at a reference epoch, which is regular everywhere.
//             Collocation: Gauss-Legendre collocation of (q, g), solved by sweeps over its stages.
// Units       steps in the unit of time of the system; tolerance is relative to |q| = 1 and to |g|.
// Domain      tolerance from 1e-15 to 1e-2 (DoubleDouble: from 1e-30); a step that is positive.
//             Splitting and VariationOfConstants: rates |g|/I from 1e-28 to 1e28 per unit of time;
//             below that, for Splitting, a body is at rest until a torque moves it.
//             Adaptive and Collocation end a step where a switching function of a term changes its
//             sign, and at breakpoints; VariationOfConstants at breakpoints; Splitting at neither.
//             A pulse of a torque that names neither may lie within one step, sooner one of
//             Collocation, whose steps are longer, and is stepped over; so is a dip of a switching
//             function that is shorter than a quarter of a step and neither a parabola nor a V:
//             give largest_step, or the term a time scale.
// Accuracy    docs/guide/which-propagator.md: measured work and precision of each.
// Errors      DomainError from the functions that make a method with a value out of range;
//             integrate checks again.
// Cost        docs/guide/which-propagator.md.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {

// The arithmetic of a run: double with compensated sums of state and time, or double-double
// throughout (terms included; some twenty times slower).
enum class Precision { compensated, double_double };

struct Adaptive {
  double tolerance = 1e-12;  // of the local error of one step
  Precision precision = Precision::compensated;
  double first_step = 0.0;  // 0: chosen
  // No step is longer. Infinite: a quarter of the shortest period among what the terms follow (an
  // orbit, a primary that turns, the frame, the time scale that a user's term gives), and no limit
  // where no term knows one.
  double largest_step = std::numeric_limits<double>::infinity();

  constexpr bool operator==(const Adaptive&) const = default;
};

// Symmetric compositions of drift (free rotation) and kick (terms). The near-integrable families
// ABA864 and ABA1064 (Blanes et al. 2013) have an error of order eps h^8 + eps^2 h^6 + eps^3 h^4
// and eps h^10 + eps^2 h^6 + eps^3 h^4 when the terms are eps times the free motion.
enum class SplittingScheme { order2, order4, order6, order8, ABA864, ABA1064 };

struct Splitting {
  double step;
  SplittingScheme scheme = SplittingScheme::ABA864;

  constexpr bool operator==(const Splitting&) const = default;
};

struct VariationOfConstants {
  double tolerance = 1e-12;  // of the local error of one step
  double largest_step = std::numeric_limits<double>::infinity();

  constexpr bool operator==(const VariationOfConstants&) const = default;
};

// Gauss-Legendre collocation of order 2 * stages, its stages computed together.
struct Collocation {
  double tolerance = 1e-12;  // of the local error of one step
  int stages = 8;            // 4, 8 or 16
  // 0: chosen by the tolerance. Else every step is so long, and the method symmetric: it keeps
  // quadratic invariants (|q|; |g| and the energy of free rotation), and is symplectic to its order
  // for terms with an energy. Nothing checks the error it makes.
  double step = 0.0;
  double largest_step = std::numeric_limits<double>::infinity();  // as in Adaptive

  constexpr bool operator==(const Collocation&) const = default;
};

// Where a run names no method: what moves a System, and what moves models of any other state, whose
// rates are too cheap for stages in lanes to save time, or may follow tables with coarse knots.
inline constexpr Collocation default_rotor_method{};
inline constexpr Adaptive default_model_method{};

// What a method is to those who need not know which one it is.
struct MethodTraits {
  std::string kind;  // as in files: "variation-of-constants"
  std::string text;  // what outputs say: "adaptive, tolerance 1e-12"; ends with the step if fixed
  // What the text leaves out. A run is resumed by a method of the same text and numbers alone.
  std::vector<double> further = {};
  std::optional<double> step = std::nullopt;  // where all steps but the last are of one length
  bool needs_flows = false;                   // of each term, and none of a damper

  bool operator==(const MethodTraits&) const = default;
};

namespace detail {
struct StepperMaker;
}

// A method from outside, made by custom_method (polhode/dynamics/custom_method.hpp). Two of equal
// traits are the same method.
struct CustomMethod {
  MethodTraits traits;
  std::shared_ptr<const detail::StepperMaker> maker;

  bool operator==(const CustomMethod& other) const { return traits == other.traits; }
};

using Method = std::variant<Adaptive, Splitting, VariationOfConstants, Collocation, CustomMethod>;

MethodTraits method_traits(const Method& method);

// Its text: "adaptive, tolerance 1e-12".
std::string method_text(const Method& method);

// DomainError when a value of the method is out of range.
void require_valid(const Method& method);

// Whether it moves any state, that of a damper or of a model too.
bool moves_any_state(const Method& method);

// The method itself where it moves models that can be frozen (polhode/dynamics/model.hpp); else
// null.
const Splitting* method_of_frozen_models(const Method& method);

}  // namespace v0
}  // namespace polhode
