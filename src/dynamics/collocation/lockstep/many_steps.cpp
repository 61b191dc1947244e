// SPDX-License-Identifier: MIT
#include "dynamics/collocation/lockstep/many_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// One lane of a row of lanes, and one row of a body's own.
void spread(const StageRow& from, double* row, std::size_t lane, std::size_t stages) {
  for (std::size_t i = 0; i < stages; ++i) row[i * body_lanes + lane] = from[i];
}
void collect(const double* row, StageRow& to, std::size_t lane, std::size_t stages) {
  for (std::size_t i = 0; i < stages; ++i) to[i] = row[i * body_lanes + lane];
}

}  // namespace

bool ManySteps::go_together(const RotorStages& a, const RotorStages& b) {
  return a.scheme().stages == b.scheme().stages && a.terms().size() == b.terms().size() &&
         a.step().has_rate == b.step().has_rate && a.step().has_frame == b.step().has_frame;
}

void ManySteps::gather(const RotorStages& from, std::size_t lane) {
  const RotorStep& s = from.step();
  const std::size_t stages = scheme_.stages;
  for (std::size_t n = 0; n < 7; ++n) {
    lanes_.y[n][lane] = s.y[n];
    lanes_.carry[n][lane] = s.carry[n];
  }
  lanes_.inverse_momentum[lane] = inverse_momentum(s.y);
  spread(s.hb, lanes_.hb(), lane, stages);
  if (s.has_frame)
    for (std::size_t n = 0; n < 3; ++n) spread(s.mu_S[n], lanes_.mu_S(n), lane, stages);
  for (std::size_t k = 0; k < is_shared_.size(); ++k) {
    if (!is_shared_[k]) continue;
    double* row = of_time_[k][0].data();
    for (const StageRow& of_time : from.terms()[k]->law()->of_time()) {
      spread(of_time, row, lane, stages);
      row += lanes_.stride();
    }
  }
  gather_guess(from.waiting(), lane);
}

void ManySteps::gather_guess(const RotorStages::Guess& guess, std::size_t lane) {
  const std::size_t stages = scheme_.stages;
  for (std::size_t n = 0; n < 7; ++n) {
    if (guess.rates != nullptr)
      spread((*guess.rates)[n], lanes_.kept(n), lane, stages);
    else
      spread(StageRow{}, lanes_.kept(n), lane, stages);
  }
  if (guess.rates == nullptr) return;
  // degree 1 at the stages says all of them
  const StageMatrix& to = *guess.at_stages;
  const auto is_there = [&](std::size_t j) {
    for (std::size_t i = 0; i < stages; ++i)
      if (to[j][i] != lanes_.at_stages(j, i)[lane]) return false;
    return true;
  };
  if (is_there(1) && is_there(0)) return;
  for (std::size_t j = 0; j < stages; ++j)
    for (std::size_t i = 0; i < stages; ++i) lanes_.at_stages(j, i)[lane] = to[j][i];
}

// What of the lanes is of the bodies, and not of their steps.
void ManySteps::group(Bodies bodies) {
  const RotorStages& first = *bodies[0].stages;
  lanes_.has_rate = first.step().has_rate;
  lanes_.has_frame = first.step().has_frame;
  for (std::size_t lane = 0; lane < body_lanes; ++lane) {
    const RotorStages& body = *bodies[lane < bodies.size() ? lane : 0].stages;
    const RotorConstants& c = body.constants();
    for (std::size_t n = 0; n < 3; ++n) {
      const int axis = static_cast<int>(n);
      lanes_.half_inverse[n][lane] = c.half_inverse[n].hi;
      lanes_.half_inverse_rest[n][lane] = c.half_inverse[n].lo;
      lanes_.euler[n][lane] = c.euler[axis];
      lanes_.moments[n][lane] = body.moments()[axis];
    }
  }
  is_shared_.assign(first.terms().size(), true);
  of_time_.resize(is_shared_.size());
  is_grouped_ = true;
  for (std::size_t k = 0; k < is_shared_.size(); ++k) {
    const StageLaw* own = first.terms()[k]->law();
    for (const BodyStep& body : bodies) {
      const StageLaw* other = body.stages->terms()[k]->law();
      is_shared_[k] = is_shared_[k] && own != nullptr && other != nullptr && own->serves(*other);
    }
    if (is_shared_[k])
      of_time_[k].resize(std::max<std::size_t>(own->of_time().size(), 1) * scheme_.stages);
  }
}

// A switching function takes the law of a body from it in some steps.
void ManySteps::find_shared_laws(Bodies bodies) {
  if (!is_grouped_) group(bodies);
  for (std::size_t k = 0; k < is_shared_.size(); ++k)
    for (const BodyStep& body : bodies)
      if (is_shared_[k] && body.stages->terms()[k]->law() == nullptr) is_shared_[k] = false;
}

// A term that some bodies have to be asked for by themselves goes on from what the terms before it
// have added: sums are in the order of one body alone.
void ManySteps::ask_alone(RotorStages& body, std::size_t term, std::size_t lane) {
  RotorStep& s = body.step();
  const std::size_t stages = scheme_.stages;
  for (std::size_t n = 0; n < 7; ++n) {
    collect(lanes_.Y(n), s.Y.rows[n], lane, stages);
    std::fill(s.Y.rows[n].begin() + stages, s.Y.rows[n].begin() + filled_stages(stages),
              lanes_.y[n][lane]);
  }
  for (std::size_t n = 0; n < 3; ++n) {
    collect(lanes_.v(n), s.effects.v[n], lane, stages);
    collect(lanes_.u(n), s.effects.u[n], lane, stages);
  }
  body.terms()[term]->add_to(s.effects, s.Y);
  for (std::size_t n = 0; n < 3; ++n) {
    spread(s.effects.v[n], lanes_.v(n), lane, stages);
    spread(s.effects.u[n], lanes_.u(n), lane, stages);
    s.effects.v[n].fill(0.0);
    s.effects.u[n].fill(0.0);
  }
}

void ManySteps::ask_terms(Bodies bodies) {
  const BodyStep& any =
      *std::find_if(bodies.begin(), bodies.end(), [](const BodyStep& b) { return b.goes_on(); });
  for (std::size_t k = 0; k < is_shared_.size(); ++k) {
    if (is_shared_[k]) {
      any.stages->terms()[k]->law()->add_to({lanes_.stride(), lanes_.stride(),
                                             of_time_[k][0].data(), lanes_.Y(0),
                                             lanes_.moments[0].data(), lanes_.v(0), lanes_.u(0)});
      continue;
    }
    for (std::size_t lane = 0; lane < bodies.size(); ++lane) {
      if (!bodies[lane].goes_on()) continue;
      try {
        ask_alone(*bodies[lane].stages, k, lane);
      } catch (...) {
        bodies[lane].thrown = std::current_exception();
      }
    }
  }
}

// As RotorLanes::measure, whose rows of four stages are filled up with the start.
double ManySteps::remeasured(std::size_t lane) {
  double most = std::numeric_limits<double>::min();
  const auto see = [&most](double g) { most = std::abs(g) <= most ? most : std::abs(g); };
  for (std::size_t n = 4; n < 7; ++n) {
    const double* row = lanes_.Y(n);
    for (std::size_t i = 0; i < scheme_.stages; ++i) see(row[i * body_lanes + lane]);
    if (filled_stages(scheme_.stages) > scheme_.stages)
      see(lanes_.y[n][lane] + lanes_.carry[n][lane]);
  }
  return 1.0 / most;
}

void ManySteps::give(RotorStages::Solution& to, std::size_t lane) {
  for (std::size_t n = 0; n < 7; ++n) {
    collect(lanes_.F(n), to.rates[n], lane, scheme_.stages);
    to.end.y[n] = lanes_.end[n][lane];
    to.end.carry[n] = lanes_.end_carry[n][lane];
  }
  for (std::size_t n = 0; n < 6; ++n) collect(lanes_.drive(n), to.drive[n], lane, scheme_.stages);
}

void ManySteps::solve(Bodies bodies) {
  find_shared_laws(bodies);
  for (std::size_t lane = 0; lane < body_lanes; ++lane)
    gather(*bodies[lane < bodies.size() ? lane : 0].stages, lane);
  kernels_.place(scheme_, lanes_);
  const auto goes_on = [](const BodyStep& body) { return body.goes_on(); };
  while (std::any_of(bodies.begin(), bodies.end(), goes_on)) {
    ask_terms(bodies);
    kernels_.sweep(scheme_, lanes_);
    BodyLine has_ended{};
    bool any = false;
    for (std::size_t lane = 0; lane < bodies.size(); ++lane) {
      BodyStep& body = bodies[lane];
      if (!body.goes_on()) continue;
      const double change = lanes_.change[lane];
      if (!(change < 1.0)) lanes_.inverse_momentum[lane] = remeasured(lane);
      body.judge.see(change);
      if (body.goes_on()) continue;
      has_ended[lane] = 1.0;
      any = true;
    }
    if (any) kernels_.keep(has_ended, lanes_);
  }
  kernels_.finish(scheme_, lanes_);
  for (std::size_t lane = 0; lane < bodies.size(); ++lane) {
    const BodyStep& body = bodies[lane];
    if (!body.thrown && body.judge.end() == SweepsEnd::converged)
      give(body.stages->take_solution(), lane);
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
