// SPDX-License-Identifier: MIT
#include "fit/result_bytes.hpp"

#include <cstdint>

namespace polhode {
inline namespace v0 {
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

void serialize(Archive& bytes, Scattering& law) { bytes.all(law.single, law.multiple); }

void serialize(Archive& bytes, LightOutcome& found) {
  serialize(bytes, found.result);
  serialize(bytes, found.covariance);
  serialize_word(bytes, found.periods.mode);
  bytes.all(found.factors, found.degrees_of_freedom, found.periods.precession_period,
            found.periods.rotation_period, found.pole, found.notes);
  serialize_word(bytes, found.loss.kind);
  bytes.all(found.loss.scale, found.points);
  bytes.list(found.terms, [&](CostTerm& term) { bytes.all(term.name, term.value); });
}

}  // namespace

void serialize(Archive& bytes, SpinState& s) { bytes.all(s.t0, s.q, s.w_F, s.inertia_F); }

void serialize(Archive& bytes, EllipsoidModel& body) {
  serialize(bytes, body.spin);
  bytes.all(body.shape.a, body.shape.b, body.shape.c);
  serialize(bytes, body.law);
}

void serialize(Archive& bytes, std::optional<ConvexModel>& body) {
  bool is_there = body.has_value();
  bytes(is_there);
  if (!is_there) return;
  int degree = body ? body->image.degree() : 0, rows = body ? body->image.rows() : 0;
  bytes.all(degree, rows);
  if (bytes.reads()) body.emplace(ConvexModel{{}, {}, GaussianImage(degree, rows), {}});
  serialize(bytes, body->spin);
  serialize(bytes, body->law);
  bytes(body->coefficients);
}

void serialize(Archive& bytes, LightSolution& found) {
  serialize(bytes, static_cast<LightOutcome&>(found));
  serialize(bytes, found.body);
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
}  // namespace v0
}  // namespace polhode
