// SPDX-License-Identifier: MIT
// Magnetic fields of a planet, and the torques of dipoles and eddy currents in them.
#include "polhode/perturb/magnetic_torque.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "math/number_text.hpp"
#include "perturb/detail/friction_matrix.hpp"
#include "polhode/error.hpp"
#include "polhode/perturb/magnetic_field.hpp"

namespace polhode {
inline namespace v0 {

namespace {

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
std::string vector_text(const Vec3& v) { return detail::tuple_text({v.x, v.y, v.z}); }

Vec3 unit_pole(const PrimaryRotation& primary) {
  const double length = norm(primary.pole);
  if (!(length > 0.0) || !std::isfinite(length))
    throw DomainError("PrimaryRotation: pole " + vector_text(primary.pole) +
                      " must be finite and not zero");
  return (1.0 / length) * primary.pole;
}

}  // namespace

namespace detail {

void field_without_rate() {
  throw DomainError(
      "FieldAlongOrbit: this orbit or this field has no derivative by time: leave out the rate of "
      "the field");
}

}  // namespace detail

Quaternion axes_at_epoch(const PrimaryRotation& primary) {
  const Vec3 pole = unit_pole(primary);
  if (!std::isfinite(primary.rate) || !std::isfinite(primary.meridian) ||
      !std::isfinite(primary.epoch))
    throw DomainError("PrimaryRotation: rate, meridian and epoch " +
                      detail::tuple_text({primary.rate, primary.meridian, primary.epoch}) +
                      " must be finite");
  const double across = std::hypot(pole.x, pole.y);
  const double node = across > 0.0 ? std::atan2(pole.x, -pole.y) : 0.0;
  return rotation_z(node) * rotation_x(std::atan2(across, pole.z)) * rotation_z(primary.meridian);
}

DipoleField::DipoleField(const Vec3& strength, const PrimaryRotation& primary)
    : strength_(strength), primary_(primary), angle_(0.0, primary.rate, primary.epoch) {
  if (!finite(strength))
    throw DomainError("DipoleField: strength " + vector_text(strength) + " must be finite");
  const Vec3 K = rotate(axes_at_epoch(primary), strength), pole = unit_pole(primary);
  along_ = dot(pole, K) * pole;
  across_ = K - along_;
  side_ = cross(pole, K);
}

double DipoleField::time_scale() const {
  const double rate = std::fabs(primary_.rate);
  return rate > 0.0 ? 0.5 * std::numbers::pi / rate : std::numeric_limits<double>::infinity();
}

DipoleField DipoleField::from_gauss(const GaussCoefficients& gauss, double reference_radius,
                                    const PrimaryRotation& primary) {
  if (!(reference_radius > 0.0) || !std::isfinite(reference_radius))
    throw DomainError("DipoleField: reference radius " + detail::number_text(reference_radius) +
                      " must be positive and finite");
  const double a3 = reference_radius * reference_radius * reference_radius;
  return DipoleField(a3 * Vec3{gauss.g11, gauss.h11, gauss.g10}, primary);
}

ConstantField::ConstantField(const Vec3& field) : field_(field) {
  if (!finite(field))
    throw DomainError("ConstantField: field " + vector_text(field) + " must be finite");
}

template <class F>
void DipoleField::each_angle(const TimeRows& times, InstructionSet set, const F& f) const {
  constexpr std::size_t block = 16;
  for (std::size_t first = 0; first < times.count; first += block) {
    const std::size_t count = std::min(block, times.count - first);
    double sine[block], cosine[block];
    angle_.at(TimeRows{count, times.t + first}, sine, cosine, set);
    for (std::size_t i = 0; i < count; ++i) f(first + i, sine[i], cosine[i]);
  }
}

void DipoleField::fields(const TimeRows& times, const VectorRows& x, const VectorRows& field,
                         InstructionSet set) const {
  each_angle(times, set, [&](std::size_t i, double s, double c) {
    field.set(i, field_of(strength_of(SinCos<double>{s, c}), x.at(i)));
  });
}

void DipoleField::motions(const TimeRows& times, const VectorRows& x, const VectorRows& v,
                          const VectorRows& field, const VectorRows& rate,
                          InstructionSet set) const {
  using D = Dual<double, 1>;
  const double turn = angle_.rate();
  each_angle(times, set, [&](std::size_t i, double s, double c) {
    const Vec3 at = x.at(i), along = v.at(i);
    const SinCos<D> angle{D(s, {turn * c}), D(c, {-(turn * s)})};
    const BasicVec3<D> B =
        field_of(strength_of(angle),
                 BasicVec3<D>{D(at.x, {along.x}), D(at.y, {along.y}), D(at.z, {along.z})});
    field.set(i, detail::values_of(B));
    rate.set(i, {B.x.derivative[0], B.y.derivative[0], B.z.derivative[0]});
  });
}

namespace detail {

void require_dipole(const Vec3& m) {
  if (!std::isfinite(m.x) || !std::isfinite(m.y) || !std::isfinite(m.z))
    throw DomainError("ResidualDipole: moment " + tuple_text({m.x, m.y, m.z}) + " must be finite");
}

Mat3 checked_magnetic_tensor(const Mat3& M) {
  return friction_matrix(M, "EddyCurrents: magnetic tensor");
}

void require_field_rate(bool has_rate) {
  if (!has_rate)
    throw DomainError(
        "EddyCurrents: this field has no derivative by time: expected FieldRate::left_out, or an "
        "orbit and a field that take Dual times");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
