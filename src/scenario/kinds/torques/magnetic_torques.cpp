// SPDX-License-Identifier: MIT
// [[perturbation]] of kinds "residual-dipole" and "eddy-currents": torques in a magnetic field.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "polhode/ephemeris/ephemeris.hpp"
#include "polhode/perturb/magnetic_torque.hpp"
#include "polhode/scenario/perturbation_kind.hpp"
#include "scenario/detail/built_in_kinds.hpp"
#include "scenario/detail/clock.hpp"
#include "scenario/detail/reference_axes.hpp"
#include "scenario/kinds/torques/shared_keys.hpp"
#include "scenario/tables/state.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

enum class FieldSource { coefficients, earth };

struct DipoleArguments {
  std::optional<std::string> orbit;
  std::optional<Vec3> constant_field;
  FieldSource field;
  std::optional<Vec3> gauss;
  std::optional<double> reference_radius;
  std::optional<Vec3> pole;
  std::optional<double> rotation_rate;
  std::optional<double> meridian;
  std::optional<double> meridian_epoch;
};

constexpr std::string_view earth_field = "field = \"earth\"";

// Of arguments A that derive from these.
template <class A>
constexpr std::array<KindKey<A>, 9> dipole_keys = {
    name_key<&DipoleArguments::orbit, A>(
        "orbit",
        "The name of a table [orbit.NAME]: where what has the magnetic field is, or the body as "
        "seen from there. May be left out with constant_field alone.")
        .example("\"earth\"")
        .shown(),
    quantity_key<&DipoleArguments::constant_field, A>(
        "constant_field", Dimension::magnetic_field,
        "A field that is the same everywhere and at any time, in inertial axes, in place of that "
        "of a dipole.")
        .example("{ value = [0.0, 0.0, 20000.0], unit = \"nT\" }"),
    choice_key<&DipoleArguments::field, A, FieldSource::coefficients, FieldSource::earth>(
        "field", "coefficients|earth",
        "earth: the dipole of the IGRF and the orientation of the Earth at state.epoch, in place "
        "of the keys gauss to meridian_epoch.")
        .otherwise("\"coefficients\""),
    quantity_key<&DipoleArguments::gauss, A>(
        "gauss", Dimension::magnetic_field,
        "Gauss coefficients g10, g11, h11 of the dipole field, as the IGRF lists them.")
        .example("{ value = [-29442.0, -1501.0, 4797.1], unit = \"nT\" }")
        .shown()
        .unused_with(earth_field),
    quantity_key<&DipoleArguments::reference_radius, A>("reference_radius", Dimension::length,
                                                        "The radius that belongs to them.")
        .example("\"6371.2 km\"")
        .positive()
        .shown()
        .unused_with(earth_field),
    pole_key<&DipoleArguments::pole, A>().unused_with(earth_field),
    quantity_key<&DipoleArguments::rotation_rate, A>(
        "rotation_rate", Dimension::rate,
        "How fast it turns; may be left out if g11 and h11 are 0.")
        .example("\"360.98564736629 deg/d\"")
        .shown()
        .unused_with(earth_field),
    quantity_key<&DipoleArguments::meridian, A>(
        "meridian", Dimension::angle,
        "Where the meridian of longitude 0 is at the time `meridian_epoch`: from inertial axis 1, "
        "or, where the pole is not axis 3, from the ascending node of its equator. May be left out "
        "if g11 and h11 are 0.")
        .example("\"0 deg\"")
        .shown()
        .unused_with(earth_field),
    quantity_key<&DipoleArguments::meridian_epoch, A>("meridian_epoch", Dimension::time,
                                                      "The time t that the meridian belongs to.")
        .otherwise("0")
        .unused_with(earth_field),
};

Citation dipole_citation() {
  return {"thebault2015",
          "Thebault, E., et al. (2015). International Geomagnetic Reference Field: the 12th "
          "generation. Earth, Planets and Space 67, 79.",
          "the dipole field and its Gauss coefficients"};
}

// The Earth's orientation at t = 0 along the axes of the state.
PrimaryRotation earth_at_epoch(const TermContext& at, const Clock& clock, const std::string& axes) {
  const Mat3 R = ephemeris::j2000_from_earth(clock.epoch, clock.dut1);
  const auto column = [&](int k) {
    return in_other_axes(Vec3{R(0, k), R(1, k), R(2, k)}, "equator-J2000", axes);
  };
  const Vec3 pole = column(2), greenwich = column(0);
  const Vec3 node = cross(Vec3{0.0, 0.0, 1.0}, pole);
  const double meridian = std::atan2(dot(cross(node, greenwich), pole), dot(node, greenwich));
  return {.pole = pole,
          .rate = at.units().to_core(ephemeris::earth_rotation_rate, "rad/s", Dimension::rate),
          .meridian = meridian,
          .epoch = 0.0};
}

// Puts the coefficients of the Earth's field at t = 0 in place of the word.
void replace_earth(DipoleArguments& a, const TermContext& at) {
  if (a.field != FieldSource::earth) return;
  const std::string axes = state_table(at.file_values())->axes;
  if (axes == "inertial")
    at.refuse("field",
              "expected axes = \"equator-J2000\" or \"ecliptic-J2000\" in [state] as well, "
              "and epoch");
  const Clock clock = clock_of(at.file_values(), at.key_path("field"));
  at.built("field", [&] {
    const Vec3 g = ephemeris::igrf_dipole(clock.epoch);
    const auto core = [&](double x) {
      return at.units().to_core(x, "nT", Dimension::magnetic_field);
    };
    const PrimaryRotation earth = earth_at_epoch(at, clock, axes);
    a.field = FieldSource::coefficients;
    a.gauss = {core(g.x), core(g.y), core(g.z)};
    a.reference_radius = at.units().to_core(ephemeris::igrf_radius_km, "km", Dimension::length);
    a.pole = earth.pole;
    a.rotation_rate = earth.rate;
    a.meridian = earth.meridian;
    a.meridian_epoch = earth.epoch;
  });
}

// A constant field has no place, axis or coefficients.
void require_one_field(DipoleArguments& a, const TermContext& at) {
  if (!a.constant_field) return;
  for (const char* const key : {"orbit", "field", "gauss", "reference_radius", "pole",
                                "rotation_rate", "meridian", "meridian_epoch"})
    if (at.is_explicit(key)) at.refuse("constant_field", std::string("expected none with ") + key);
  a.pole.reset();
  a.meridian_epoch.reset();
}

bool is_earth(const TermContext& at) { return at.word("field") == "earth"; }

// The note of the Earth's dipole in a summary; empty for others.
std::string field_note(const DipoleArguments& a, const TermContext& at) {
  if (!is_earth(at)) return {};
  const Vec3 g = ephemeris::igrf_dipole(clock_of(at.file_values(), at.key_path("field")).epoch);
  return fmt::format(
      ", the Earth's dipole of the epoch (IGRF-14: {:.1f}, {:.1f}, {:.1f} nT; "
      "pole {:.9f}, {:.9f}, {:.9f}, meridian {:.6f} {})",
      g.x, g.y, g.z, a.pole->x, a.pole->y, a.pole->z,
      at.units().from_core(*a.meridian, Dimension::angle), at.units().angle());
}

void require_dipole_keys(const DipoleArguments& a, const TermContext& at) {
  if (!a.gauss)
    at.refuse("gauss", "expected the Gauss coefficients g10, g11, h11, or field = \"earth\"");
  if (!a.reference_radius)
    at.refuse("reference_radius", "expected the radius that belongs to gauss");
  const bool turns_show = a.gauss->y != 0.0 || a.gauss->z != 0.0;
  if (turns_show && !a.rotation_rate)
    at.refuse("rotation_rate", "expected the rotation rate of the field; 0 for a fixed field");
  if (turns_show && !a.meridian)
    at.refuse("meridian", "expected the angle of the prime meridian at t = meridian_epoch");
  require_pole(at, "pole");
}

DipoleField dipole_of(const DipoleArguments& a, const TermContext& at) {
  if (!is_earth(at)) require_dipole_keys(a, at);
  const PrimaryRotation primary{.pole = a.pole.value(),
                                .rate = a.rotation_rate.value_or(0.0),
                                .meridian = a.meridian.value_or(0.0),
                                .epoch = a.meridian_epoch.value()};
  if (primary.pole == Vec3{}) at.refuse("pole", "expected a vector that is not zero");
  return at.built("gauss", [&] {
    const Vec3& g = *a.gauss;
    return DipoleField::from_gauss({g.x, g.y, g.z}, *a.reference_radius, primary);
  });
}

// made(field, note), a term in the field at the place of the body.
template <class Made>
AnyPerturbation in_field(const DipoleArguments& a, const TermContext& at, const Made& made) {
  if (at.field() != nullptr) return made(*at.field(), std::string());
  if (a.constant_field)
    return made(ConstantField(*a.constant_field), std::string(", constant field"));
  const ScenarioOrbit& orbit = at.orbit("orbit");
  const DipoleField dipole = dipole_of(a, at);
  const std::string note = ", orbit " + orbit.name + field_note(a, at);
  return std::visit([&](const auto& motion) { return made(FieldAlongOrbit(motion, dipole), note); },
                    orbit.motion);
}

struct ResidualDipoleArguments : DipoleArguments {
  Vec3 moment;
};

constexpr std::array moment_keys = {
    quantity_key<&ResidualDipoleArguments::moment>("moment", Dimension::magnetic_moment,
                                                   "Magnetic moment of the body, along its axes.")
        .required()
        .example("{ value = [0.0, 0.0, 1.0], unit = \"A m2\" }"),
};
constexpr auto residual_dipole_keys =
    polhode::io::joined(dipole_keys<ResidualDipoleArguments>, moment_keys);

ResidualDipoleArguments principal_dipole(ResidualDipoleArguments a, const TermContext& at) {
  require_one_field(a, at);
  replace_earth(a, at);
  a.moment = at.principal(a.moment);
  return a;
}

MadeTerms made_residual_dipole(const ResidualDipoleArguments& a, const TermContext& at) {
  return in_field(a, at, [&](const auto& field, const std::string& note) -> AnyPerturbation {
    return {at.name("residual dipole" + note), ResidualDipole(a.moment, field)};
  });
}

}  // namespace

PerturbationKind residual_dipole_kind() {
  PerturbationKind kind = perturbation_kind<ResidualDipoleArguments>(
      "residual-dipole", "A magnetic moment of the body in a magnetic field.", residual_dipole_keys,
      made_residual_dipole, {dipole_citation()}, principal_dipole);
  kind.in_field = true;
  kind.equations = "u = m x B, H' = -m.B.";
  return kind;
}

namespace {

struct EddyCurrentArguments : DipoleArguments {
  LinearMap tensor;
  bool field_rate;
};

constexpr std::array tensor_keys = {
    quantity_key<&EddyCurrentArguments::tensor>(
        "tensor", Dimension::magnetic_tensor,
        "Magnetic tensor M of the torque (M (omega x B - dB/dt)) x B in body axes: its diagonal, "
        "or three rows.")
        .required()
        .example("{ value = [500, 500, 500], unit = \"S m4\" }"),
    flag_key<&EddyCurrentArguments::field_rate>(
        "field_rate", "Whether dB/dt along the orbit counts; false: currents by omega x B alone.")
        .otherwise("true"),
};
constexpr auto eddy_current_keys =
    polhode::io::joined(dipole_keys<EddyCurrentArguments>, tensor_keys);

EddyCurrentArguments principal_eddy(EddyCurrentArguments a, const TermContext& at) {
  require_one_field(a, at);
  replace_earth(a, at);
  a.tensor = at.built("tensor", [&]() -> LinearMap {
    const EddyCurrents in_file_axes(a.tensor.matrix, ConstantField({}));  // refuses
    return {at.principal(in_file_axes.tensor()), false};
  });
  return a;
}

MadeTerms made_eddy_currents(const EddyCurrentArguments& a, const TermContext& at) {
  const FieldRate rate = a.field_rate ? FieldRate::along_orbit : FieldRate::left_out;
  return in_field(a, at, [&](const auto& field, const std::string& note) {
    return at.built("tensor", [&]() -> AnyPerturbation {
      return {at.name("eddy currents" + note), EddyCurrents(a.tensor.matrix, field, rate)};
    });
  });
}

}  // namespace

PerturbationKind eddy_currents_kind() {
  PerturbationKind kind = perturbation_kind<EddyCurrentArguments>(
      "eddy-currents", "Currents that a magnetic field induces in a body that turns in it.",
      eddy_current_keys, made_eddy_currents,
      {{"praly2012",
        "Praly, N., Hillion, M., Bonnal, C., Laurent-Varin, J., Petit, N. (2012). Study on the "
        "eddy current damping of the spin dynamics of space debris from the Ariane launcher upper "
        "stages. Acta Astronautica 76, 145-153.",
        "the torque on eddy currents"},
       dipole_citation()},
      principal_eddy);
  kind.in_field = true;
  kind.equations = "u = (M (w x B - dB/dt)) x B, w = I^-1 g, dB/dt along the orbit.";
  return kind;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
