// SPDX-License-Identifier: MIT
// Histories of many spin axes on one orbit.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/dynamics/model.hpp"
#include "polhode/error.hpp"
#include "polhode/secular/orbit_history.hpp"
#include "polhode/secular/spin_precession.hpp"
#include "secular/detail/spin_axes.hpp"

namespace polhode {
inline namespace v0 {
namespace secular {
namespace detail {
namespace {

// The spin axes of up to N bodies on one orbit, as one state of the common loop.
template <std::size_t N>
struct SpinBlock {
  std::array<double, 3 * N> column{};  // x of all, y, z

  SpinAxis axis(std::size_t i) const { return {{column[i], column[N + i], column[2 * N + i]}}; }
  void put(std::size_t i, const SpinAxis& axis) {
    column[i] = axis.s.x;
    column[N + i] = axis.s.y;
    column[2 * N + i] = axis.s.z;
  }
  bool is_lost(std::size_t i) const {
    const Vec3 s = axis(i).s;
    return !std::isfinite(s.x + s.y + s.z);
  }
  bool operator==(const SpinBlock&) const = default;
};
template <std::size_t N, class Visit>
void each_number(SpinBlock<N>& block, Visit&& visit) {
  for (double& x : block.column) visit(x);
}

template <std::size_t N>
struct RateBlock {
  std::array<double, N> star{}, satellites{}, geodetic{}, drift{};
};

// The model of a block. It goes on while one of its axes does.
template <std::size_t N>
struct SpinBlockModel {
  using State = SpinBlock<N>;
  static constexpr std::string_view name = SpinPrecession<OrbitHistory>::name;

  OrbitHistory orbit;
  std::shared_ptr<const RateBlock<N>> rates;
  std::size_t count;
  decltype(&turned_in_lanes<InstructionSet::baseline>) turned;

  State frozen(std::span<const FrozenPart> parts, State axes) const {
    std::array<FrozenOrbit, most_frozen_parts> orbits;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const OrbitPlane at = orbit.plane(parts[k].t);
      orbits[k] = {parts[k].t, parts[k].h, at.e2, orbit_normal(at)};
    }
    turned({orbits.data(), parts.size()},
           {count, rates->star.data(), rates->satellites.data(), rates->geodetic.data(),
            rates->drift.data()},
           axes.column.data(), N);
    return axes;
  }
  bool goes_on(const State& at) const {
    for (std::size_t i = 0; i < count; ++i)
      if (!at.is_lost(i)) return true;
    return false;
  }
};

}  // namespace
}  // namespace detail

namespace {

// Bodies that share one look at the orbit; few of them copy less.
constexpr std::size_t most_at_once = 256, few = 32;

using detail::SpinBlock;
using detail::SpinBlockModel;
using Turned = decltype(&detail::turned_in_lanes<InstructionSet::baseline>);

Turned turned_by([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return &detail::turned_in_lanes<InstructionSet::avx512>;
  if (set == InstructionSet::avx2) return &detail::turned_in_lanes<InstructionSet::avx2>;
#endif
  return &detail::turned_in_lanes<InstructionSet::baseline>;
}

void require_finite(const PrecessionRates& rates) {
  for (const double rate : {rates.star, rates.satellites, rates.geodetic, rates.drift})
    if (!std::isfinite(rate))
      throw DomainError("rates: got " + polhode::detail::number_text(rate) +
                        "; expected finite rates");
}

// One that starts, under its index among all; its axis as it was given.
struct SpinningBody {
  std::size_t index;
  PrecessionRates rates;
  SpinAxis start;
};

class Histories {
 public:
  Histories(OrbitHistory orbit, double epoch, const SaveAt& times, const Splitting& method,
            std::span<SpinAxis> results, const Progress& progress, InstructionSet set)
      : orbit_(std::move(orbit)),
        epoch_(epoch),
        times_(times),
        rows_(static_cast<std::size_t>(times.size())),
        method_(method),
        results_(results),
        progress_(progress),
        turned_(turned_by(set)) {}

  std::vector<LostSpin> of(std::span<const PrecessionRates> rates,
                           std::span<const SpinAxis> starts) {
    std::vector<SpinningBody> block;
    block.reserve(most_at_once);
    for (std::size_t i = 0; i < results_.size() / rows_; ++i) {
      try {
        const SpinningBody one{i, rates[rates.size() == 1 ? 0 : i],
                               starts[starts.size() == 1 ? 0 : i]};
        spin_axis(one.start.s);  // refuses
        require_finite(one.rates);
        require_drift(one.rates, epoch_, times_[times_.size() - 1]);
        block.push_back(one);
      } catch (const DomainError& e) {
        lost_.push_back({i, {Outcome::Status::failed, epoch_, e.what()}});
      }
      if (block.size() == most_at_once) run(std::exchange(block, {}));
    }
    run(block);
    std::sort(lost_.begin(), lost_.end(),
              [](const LostSpin& a, const LostSpin& b) { return a.index < b.index; });
    return std::move(lost_);
  }

 private:
  void run(const std::vector<SpinningBody>& bodies) {
    if (bodies.empty()) return;
    if (bodies.size() <= few)
      run_block<few>(bodies);
    else
      run_block<most_at_once>(bodies);
  }

  template <std::size_t N>
  static BasicProblem<SpinBlockModel<N>> problem_of(const std::vector<SpinningBody>& bodies,
                                                    const Histories& of) {
    const auto rates = std::make_shared<detail::RateBlock<N>>();
    SpinBlock<N> start;
    for (std::size_t i = 0; i < N; ++i) {
      start.put(i, i < bodies.size() ? spin_axis(bodies[i].start.s) : SpinAxis{{0.0, 0.0, 1.0}});
      if (i >= bodies.size()) continue;
      rates->star[i] = bodies[i].rates.star;
      rates->satellites[i] = bodies[i].rates.satellites;
      rates->geodetic[i] = bodies[i].rates.geodetic;
      rates->drift[i] = bodies[i].rates.drift;
    }
    return {SpinBlockModel<N>{of.orbit_, rates, bodies.size(), of.turned_}, start, of.epoch_,
            of.times_[of.times_.size() - 1], of.method_};
  }

  SpinAxis& row(std::size_t body, std::size_t k) { return results_[body * rows_ + k]; }

  template <std::size_t N>
  void run_block(const std::vector<SpinningBody>& bodies) {
    using Block = SpinBlock<N>;
    BasicProblem<SpinBlockModel<N>> problem = problem_of<N>(bodies, *this);
    std::size_t k = 0;
    Block last = problem.initial;
    const BasicSampleSink<Block> keep = [&](std::span<const BasicSample<Block>> samples) {
      for (const BasicSample<Block>& at : samples) {
        for (std::size_t i = 0; i < bodies.size(); ++i) row(bodies[i].index, k) = at.s.axis(i);
        ++k;
      }
      last = samples.back().s;
    };
    const Outcome outcome = integrate(problem, times_, keep, progress_).outcome();
    if (!outcome.ok()) {
      // those that were lost before the others
      problem.stop = outcome.t;
      const SaveAt end = SaveAt::times({outcome.t});
      integrate(
          problem, end, [&](auto samples) { last = samples.back().s; }, progress_);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (last.is_lost(i))
        run_alone(bodies[i]);
      else if (!outcome.ok())
        lost_.push_back({bodies[i].index, outcome});
    }
  }

  // Of a body that was lost on the way, where and why.
  void run_alone(const SpinningBody& body) {
    using Model = SpinPrecession<OrbitHistory>;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < rows_; ++k) row(body.index, k) = {{nan, nan, nan}};
    std::size_t k = 0;
    const BasicSampleSink<SpinAxis> keep = [&](std::span<const BasicSample<SpinAxis>> samples) {
      for (const BasicSample<SpinAxis>& at : samples) row(body.index, k++) = at.s;
    };
    const BasicProblem<Model> problem{Model(orbit_, body.rates), body.start, epoch_,
                                      times_[times_.size() - 1], method_};
    lost_.push_back({body.index, integrate(problem, times_, keep, progress_).outcome()});
  }

  OrbitHistory orbit_;
  double epoch_;
  const SaveAt& times_;
  std::size_t rows_;
  Splitting method_;
  std::span<SpinAxis> results_;
  const Progress& progress_;
  Turned turned_;
  std::vector<LostSpin> lost_;
};

void require_fitting(const char* what, std::size_t got, std::size_t bodies) {
  if (got != bodies && got != 1)
    throw DomainError("spin_histories: got " + std::to_string(got) + " " + what + " and room for " +
                      std::to_string(bodies) + " bodies; expected as many, or one for all");
}

// Rows on the other side of the epoch, or beyond a later one, would not be met.
void require_outward(const SaveAt& times, double epoch) {
  const auto fail = [&](double t, double later, const char* how) {
    throw DomainError("spin_histories: got times " + polhode::detail::number_text(t) + " and " +
                      polhode::detail::number_text(later) + ", " + how + " the epoch " +
                      polhode::detail::number_text(epoch) +
                      "; expected times that run away from it");
  };
  const double last = times[times.size() - 1];
  for (std::int64_t k = 0; k < times.size(); ++k)
    if ((last - epoch) * (times[k] - epoch) < 0.0) fail(times[k], last, "on two sides of");
  for (std::int64_t k = 1; k < times.size(); ++k)
    if (std::abs(times[k - 1] - epoch) > std::abs(times[k] - epoch))
      fail(times[k - 1], times[k], "running towards");
}

}  // namespace

std::vector<LostSpin> spin_histories(const OrbitHistory& orbit,
                                     std::span<const PrecessionRates> rates,
                                     std::span<const SpinAxis> starts, double epoch,
                                     const SaveAt& times, const Splitting& method,
                                     std::span<SpinAxis> results, const Progress& progress,
                                     InstructionSet set) {
  if (!supports(set))
    throw DomainError("spin_histories: got " + std::string(instruction_set_name(set)) +
                      "; expected instructions that this processor has");
  polhode::require_valid(Method(method));
  const auto rows = static_cast<std::size_t>(times.size());
  if (rows == 0) throw DomainError("spin_histories: got no times; expected one or more");
  require_outward(times, epoch);
  if (results.size() % rows != 0)
    throw DomainError("spin_histories: got room for " + std::to_string(results.size()) +
                      " axes and " + std::to_string(rows) +
                      " times; expected as many for each body");
  const std::size_t bodies = results.size() / rows;
  require_fitting("rates", rates.size(), bodies);
  require_fitting("starts", starts.size(), bodies);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::fill(results.begin(), results.end(), SpinAxis{{nan, nan, nan}});
  return Histories(orbit, epoch, times, method, results, progress, set).of(rates, starts);
}

}  // namespace secular
}  // namespace v0
}  // namespace polhode
