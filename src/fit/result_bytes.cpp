// SPDX-License-Identifier: MIT
#include "fit/result_bytes.hpp"

#include <cstdint>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {
namespace {

template <class E>
void serialize_word(Archive& bytes, E& word) {
  auto number = static_cast<std::int64_t>(word);
  bytes(number);
  if (bytes.reads()) word = static_cast<E>(number);
}

void serialize(Archive& bytes, LeastSquaresResult& r) {
  serialize_word(bytes, r.end);
  bytes.all(r.sentence, r.iterations, r.evaluations, r.x, r.numbers, r.chi_square, r.cost, r.bound);
}

void serialize(Archive& bytes, UnknownsCovariance& c) {
  bytes.all(c.names, c.matrix);
  bytes.list(c.weak, [&](UnknownsCovariance::Combination& one) {
    bytes.all(one.is_determined, one.direction, one.sentence);
  });
}

void serialize(Archive& bytes, SpinState& s) { bytes.all(s.t0, s.q, s.w_F, s.inertia_F); }

void serialize(Archive& bytes, ConvexShape& shape) {
  int degree = shape.image.degree(), rows = shape.image.rows();
  bytes.all(degree, rows);
  if (bytes.reads()) shape.image = light::GaussianImage(degree, rows);
  bytes(shape.coefficients);
}

// The place of the shape among those of LightShape, then its numbers.
void serialize(Archive& bytes, LightShape& shape, const KnownBody& known) {
  std::uint64_t place = shape.index();
  bytes(place);
  if (bytes.reads() && place == 1) shape = ConvexShape{light::GaussianImage(0, 1), {}};
  if (bytes.reads() && place == 2) {
    if (!known || !known->is_mesh())
      throw DomainError("CellJournal: a result is of a mesh that this search does not have");
    shape = known->shape;
  }
  if (auto* e = std::get_if<light::Ellipsoid>(&shape)) bytes.all(e->a, e->b, e->c);
  if (auto* c = std::get_if<ConvexShape>(&shape)) serialize(bytes, *c);
}

}  // namespace

void serialize(Archive& bytes, LightModel& body, const KnownBody& known) {
  serialize(bytes, body.spin);
  serialize(bytes, body.shape, known);
  bytes.all(body.law.single, body.law.multiple);
}

void serialize(Archive& bytes, LightTrial& trial, const KnownBody& known) {
  serialize(bytes, trial.body, known);
  bytes(trial.cost);
}

void serialize(Archive& bytes, LightSolution& found, const KnownBody& known) {
  serialize(bytes, found.body, known);
  serialize(bytes, found.result);
  serialize(bytes, found.covariance);
  serialize_word(bytes, found.periods.mode);
  bytes.all(found.factors, found.degrees_of_freedom, found.periods.precession_period,
            found.periods.rotation_period, found.pole, found.notes);
  serialize_word(bytes, found.loss.kind);
  bytes.all(found.loss.scale, found.points);
  bytes.list(found.terms, [&](CostTerm& term) { bytes.all(term.name, term.value); });
}

void serialize(Archive& bytes, FoundLight& found, const KnownBody& known) {
  serialize(bytes, found.solution, known);
  bytes.all(found.periods, found.starts, found.of, found.sentence, found.ellipsoid.a,
            found.ellipsoid.b, found.ellipsoid.c);
  serialize_word(bytes, found.beside);
  serialize_word(bytes, found.image);
  serialize(bytes, found.begun, known);
}

void serialize(Archive& bytes, SpinSolution& found) {
  serialize(bytes, found.state);
  serialize(bytes, found.result);
  serialize(bytes, found.covariance);
  bytes.all(found.error_factor, found.degrees_of_freedom, found.attitude_rms, found.notes,
            found.held);
}

void serialize(Archive& bytes, RefinedPair& refined) {
  FourierFit& fit = refined.fit;
  bytes.all(fit.f1, fit.f2, fit.chi_square, fit.degrees_of_freedom, fit.rank, fit.unknowns,
            fit.condition, fit.constants);
  bytes.list(fit.terms,
             [&](FourierTerm& term) { bytes.all(term.j, term.k, term.cosine, term.sine); });
  bytes.all(refined.converged, refined.sigma_f1, refined.sigma_f2, refined.correlation,
            refined.scale, refined.iterations);
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
