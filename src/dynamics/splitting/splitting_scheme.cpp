// SPDX-License-Identifier: MIT
// Published coefficients.
//   order 4          Blanes and Moan, J. Comput. Appl. Math. 142 (2002) 313, S6
//   order 6, 8       Kahan and Li, Math. Comp. 66 (1997) 1089, s9odr6a and s17odr8a
//   ABA864, ABA1064  Blanes, Casas, Farres, Laskar, Makazaga and Murua, Appl. Numer. Math. 68
//   (2013)
//                    58, tables 3 and 4
#include "polhode/dynamics/detail/splitting_scheme.hpp"

#include <cstddef>
#include <utility>

#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using Fractions = std::vector<double>;

// The first half, and whether its last entry is the middle one or is repeated.
Fractions palindrome(Fractions half, bool has_middle) {
  for (std::size_t i = half.size() - (has_middle ? 1 : 0); i-- > 0;) half.push_back(half[i]);
  return half;
}

// The middle entry closes the sum to 1, rounded once.
Fractions closed(Fractions half) {
  DoubleDouble rest = 1.0;
  for (const double x : half) rest -= 2.0 * x;
  half.push_back(rest.hi);
  return palindrome(std::move(half), true);
}

// Order-2 steps of the sizes gamma, the neighbours' outer parts taken together.
SplittingCoefficients composition(const Fractions& gamma, bool exact_kick) {
  Fractions outer;
  double before = 0.0;
  for (const double x : gamma) {
    outer.push_back(0.5 * (before + x));
    before = x;
  }
  outer.push_back(0.5 * before);
  if (exact_kick) return {false, gamma, outer};
  return {true, outer, gamma};
}

Fractions kahan_li_6() {
  return closed({0.39216144400731413927925056, 0.33259913678935943859974864,
                 -0.70624617255763935980996482, 0.08221359629355080023149045});
}

Fractions kahan_li_8() {
  return closed({0.13020248308889008087881763, 0.56116298177510838456196441,
                 -0.38947496264484728640807860, 0.15884190655515560089621075,
                 -0.39590389413323757733623154, 0.18453964097831570709183254,
                 0.25837438768632204729397911, 0.29501172360931029887096624});
}

SplittingCoefficients blanes_moan_4() {
  const Fractions outer{0.0792036964311957, 0.353172906049774, -0.0420650803577195};
  const Fractions inner{0.209515106613362, -0.143851773179818};
  Fractions half = inner;
  half.push_back(0.5 - (inner[0] + inner[1]));
  return {false, palindrome(half, false), closed(outer)};
}

SplittingCoefficients aba864() {
  const Fractions a{
      0.0711334264982231177779387300061549964174, 0.241153427956640098736487795326289649618,
      0.521411761772814789212136078067994229991, -0.333698616227678005726562603400438876027};
  return {
      true, palindrome(a, false),
      closed({0.183083687472197221961703757166430291072, 0.310782859898574869507522291054262796375,
              -0.0265646185119588006972121379164987592663})};
}

SplittingCoefficients aba1064() {
  const Fractions b{
      0.09585888083707521061077150377145884776921, 0.2044461531429987806805077839164344779763,
      0.2170703479789911017143385924306336714532, -0.01737538195906509300561788011852699719871};
  return {
      true,
      closed(
          {0.03809449742241219545697532230863756534060, 0.1452987161169137492940200726606637497442,
           0.2076276957255412507162056113249882065158, 0.4359097036515261592231548624010651844006}),
      palindrome(b, false)};
}

}  // namespace

SplittingCoefficients splitting_coefficients(SplittingScheme scheme, bool exact_kick) {
  switch (scheme) {
    case SplittingScheme::order2:
      break;
    case SplittingScheme::order4:
      return blanes_moan_4();
    case SplittingScheme::order6:
      return composition(kahan_li_6(), exact_kick);
    case SplittingScheme::order8:
      return composition(kahan_li_8(), exact_kick);
    case SplittingScheme::ABA864:
      return aba864();
    case SplittingScheme::ABA1064:
      return aba1064();
  }
  return composition({1.0}, exact_kick);
}

bool composes_order2(SplittingScheme scheme) {
  return scheme == SplittingScheme::order2 || scheme == SplittingScheme::order6 ||
         scheme == SplittingScheme::order8;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
