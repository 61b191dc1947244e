// SPDX-License-Identifier: MIT
// Keys that several kinds of torque share.
#pragma once

#include <optional>
#include <string_view>

#include "polhode/perturb/effect.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "polhode/text/kind_key.hpp"
#include "scenario/tables/state.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

template <auto at, class A = Owner<at>>
consteval auto orbit_key() {
  return name_key<at, A>(
             "orbit",
             "The name of a table [orbit.NAME]: where the attracting point mass is, or what the "
             "body goes round.")
      .required()
      .example("\"earth\"");
}

template <auto at>
consteval auto gm_key() {
  return quantity_key<at>(
             "gm", Dimension::gm,
             "Gravitational parameter of the attracting mass; left out, that of the orbit.")
      .example("\"398600.4418 km3/s2\"")
      .positive();
}

template <auto at, auto body, auto attractor>
consteval auto orbit_of_key() {
  return choice_key<at, body, attractor>(
             "orbit_of", "body|attractor",
             "Whose path the orbit is as seen from the other: the body's, or that of what attracts "
             "it, which it goes round. With third_moments it may not be left out.")
      .otherwise("\"body\"");
}

template <auto at, class A = Owner<at>>
consteval auto pole_key() {
  return quantity_key<at, A>(
             "pole", Dimension::number,
             "Pole of the attracting body, that J2 belongs to, or about which its magnetic field "
             "turns; in inertial axes, of any length.")
      .otherwise("[0.0, 0.0, 1.0]");
}

// The default, axis 3, is a pole of the equator but of no planet along the ecliptic.
inline void require_pole(const TermContext& at, std::string_view key) {
  if (!at.is_explicit(key) && state_table(at.file_values())->axes == "ecliptic-J2000")
    at.refuse(key, "expected the pole along the ecliptic, in which this file has its axes");
}

template <auto at>
consteval auto body_radius_key() {
  return quantity_key<at>("radius", Dimension::length,
                          "Radius of the rotating body, that k2 belongs to.")
      .required()
      .example("\"1 km\"")
      .positive();
}

// The axes of positions.
template <auto at>
consteval auto axes_key() {
  return choice_key<at, SpaceAxes::inertial, SpaceAxes::reference>(
             "axes", "inertial|reference",
             "The axes of the positions: inertial ones, or those of the reference frame.")
      .otherwise("\"inertial\"");
}

// The axes of a torque.
enum class TorqueAxes { body, inertial, reference };
template <auto at>
consteval auto torque_axes_key() {
  return choice_key<at, TorqueAxes::body, TorqueAxes::inertial, TorqueAxes::reference>(
             "axes", "body|inertial|reference",
             "The axes of its components: those of the body, inertial ones, or those of the "
             "reference frame.")
      .otherwise("\"body\"");
}
// nullopt for the axes of the body.
inline std::optional<SpaceAxes> space_axes(TorqueAxes axes) {
  if (axes == TorqueAxes::body) return std::nullopt;
  return axes == TorqueAxes::inertial ? SpaceAxes::inertial : SpaceAxes::reference;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
