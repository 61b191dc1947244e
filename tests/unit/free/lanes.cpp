// SPDX-License-Identifier: MIT
// A pack of bodies, each of another regime, has in every lane the bits that its body has alone, and
// the state of the oracle, which shares no code with either.
#include "lanes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "free/evaluate.hpp"
#include "free/prepare.hpp"
#include "oracle/free_accuracy.hpp"
#include "oracle/free_edge_cases.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/propagate.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/rotor/many_states.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace oracle;
using namespace free_test;
using namespace polhode;
using free_test::pi;
using polhode::test::Lanes;

template <std::size_t N>
using Pack = Lanes<double, N>;

// One arc and a time to read it at.
struct Arc {
  Vec3 moments;
  RotorState start;
  double t0;
  double t;
  std::string what;

  FreeRotation motion() const { return {Body(moments.x, moments.y, moments.z), start, t0}; }
  double turns() const {
    return norm(start.g) == 0.0
               ? 0.0
               : (t - t0) / oracle::detail::turn_length(FreeCase{moments, start, t0, t});
  }
};

Arc arc_of(const FreeCase& c) { return {c.moments, c.start, c.t0, c.t, description(c)}; }

template <std::size_t N>
BasicFreeKernel<Pack<N>> prepared(const Arc* arcs) {
  BasicVec3<Pack<N>> moments;
  BasicRotorState<Pack<N>> start;
  Pack<N> t0;
  for (std::size_t i = 0; i < N; ++i) {
    for (int j = 0; j < 3; ++j) {
      moments[j].lane[i] = arcs[i].moments[j];
      start.g[j].lane[i] = arcs[i].start.g[j];
    }
    start.q.w.lane[i] = arcs[i].start.q.w;
    start.q.x.lane[i] = arcs[i].start.q.x;
    start.q.y.lane[i] = arcs[i].start.q.y;
    start.q.z.lane[i] = arcs[i].start.q.z;
    t0.lane[i] = arcs[i].t0;
  }
  return prepare(moments, start, t0);
}

template <std::size_t N>
RotorState lane_of(const BasicRotorState<Pack<N>>& s, std::size_t i) {
  return {{s.q.w.lane[i], s.q.x.lane[i], s.q.y.lane[i], s.q.z.lane[i]},
          {s.g.x.lane[i], s.g.y.lane[i], s.g.z.lane[i]}};
}

// The states of N arcs in one pack, each at its own time.
template <std::size_t N>
BasicRotorState<Pack<N>> evaluated(const Arc* arcs) {
  Pack<N> t;
  for (std::size_t i = 0; i < N; ++i) t.lane[i] = arcs[i].t;
  return evaluate(prepared<N>(arcs), t);
}

template <std::size_t N>
void expect_scalar_bits(const Arc* arcs) {
  const BasicRotorState<Pack<N>> s = evaluated<N>(arcs);
  for (std::size_t i = 0; i < N; ++i)
    EXPECT_EQ(bits(lane_of(s, i)), bits(arcs[i].motion().at(arcs[i].t)))
        << arcs[i].what << ", lane " << i << ", t = " << arcs[i].t;
}

// In a drawn order that mixes the regimes, a multiple of 24 of them.
std::vector<Arc> mixed(std::vector<Arc> arcs, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::shuffle(arcs.begin(), arcs.end(), random);
  while (arcs.size() % 24 != 0) arcs.push_back(arcs[arcs.size() % 24]);
  return arcs;
}

// All of them in packs of 1, 3 and 8.
void expect_scalar_bits(const std::vector<Arc>& arcs) {
  for (std::size_t i = 0; i < arcs.size(); i += 8) expect_scalar_bits<8>(&arcs[i]);
  for (std::size_t i = 0; i < arcs.size(); i += 3) expect_scalar_bits<3>(&arcs[i]);
  for (std::size_t i = 0; i < arcs.size(); ++i) expect_scalar_bits<1>(&arcs[i]);
}

// Packs of 8 against Taylor integration with 76 digits, at every time that it can tell: to 1e20
// turns, with what the phase has lost by then. Of each pack some lanes are compared, in turn; all
// of them when POLHODE_TEST_FULL is set.
void expect_exact(const std::vector<Arc>& arcs, std::size_t sample) {
  const std::size_t lanes = std::getenv("POLHODE_TEST_FULL") != nullptr ? 8 : sample;
  std::size_t compared = 0;
  for (std::size_t first = 0; first < arcs.size(); first += 8) {
    const BasicRotorState<Pack<8>> s = evaluated<8>(&arcs[first]);
    for (std::size_t k = 0; k < lanes; ++k) {
      const std::size_t i = (first / 8 + k) % 8;
      const Arc& arc = arcs[first + i];
      const double turns = std::abs(arc.turns());
      const bool can_tell = std::abs(arc.t) < infinite && turns <= 1e20;
      if (!can_tell) continue;
      FreeBody body(arc.moments, arc.start.q, arc.start.g);
      // Before the epoch the oracle counts from half a period, whose digits hide a time of 1e-40 of
      // it.
      if (arc.t < arc.t0 && body.half_period() > Wide(1e40 * (arc.t0 - arc.t))) continue;
      const FreeError e = error_at(body, lane_of(s, i), arc.t, arc.t0);
      const double allowed = budget::free_state + budget::free_phase * 2.0 * pi * turns;
      EXPECT_LE(e.angle, allowed) << arc.what << ", lane " << i << ", t = " << arc.t;
      EXPECT_LE(e.momentum, allowed) << arc.what << ", lane " << i << ", t = " << arc.t;
      ++compared;
    }
  }
  EXPECT_GE(compared, arcs.size() * lanes / 32);
}

std::vector<Arc> regimes_at_any_time() {
  Draw draw(71, 0);
  std::vector<Arc> arcs;
  for (const NamedMotion& n : motions()) {
    for (const double t : {0.0, 0.1, -7.3, 1e6, -1e15, 1e18, 1e100, -1e308, infinite, not_a_number})
      arcs.push_back({n.moments, n.start().q.w == 0.0 ? RotorState{} : n.start(), 0.0, t, n.name});
    for (int k = 0; k < 10; ++k)
      arcs.push_back({n.moments, n.start(), draw.uniform(-1e3, 1e3),
                      draw.sign() * draw.power_of_ten(-300, 308), n.name});
  }
  return mixed(arcs, 1);
}

std::vector<Arc> drawn_bodies() {
  std::vector<Arc> arcs;
  for (const FreeCase& c : drawn_cases(72, 100)) {
    arcs.push_back(arc_of(c));
    Arc far = arc_of(c);
    far.t = 1e9 * c.t;
    arcs.push_back(far);
  }
  return mixed(arcs, 2);
}

// Needles, discs, huge and tiny units, spin about b2, 1e-30 from the separatrix.
std::vector<Arc> edges() {
  std::vector<Arc> arcs;
  std::uint64_t stream = 0;
  for (const CaseMaker maker :
       {extreme_case, extreme_momentum_case, middle_spin_case, full_moments_case, long_time_case}) {
    ++stream;
    for (std::size_t i = 0; i < 60; ++i) {
      Draw draw(73 + (stream << 32U), i);
      FreeCase c = maker(draw);
      if (maker == long_time_case) set_time(c, 1e15);
      arcs.push_back(arc_of(c));
    }
  }
  return mixed(arcs, 3);
}

// Within 1e-8 of a steady spin, of an axisymmetric and of a spherical body, and 1e-3 .. 1e-16 from
// the separatrix, next to lanes where the same is exact.
std::vector<Arc> neighbours_of_every_edge() {
  std::vector<Arc> arcs;
  const RotorState spins[] = {{{1.0, 0.2, 0.1, -0.4}, {1.0, 0.0, 0.0}},
                              {{1.0, 0.2, 0.1, -0.4}, {0.0, 1.0, 0.0}},
                              {{1.0, 0.2, 0.1, -0.4}, {0.0, 0.0, 1.0}},
                              {{1.0, 0.2, 0.1, -0.4}, {0.4, 0.3, 0.8}}};
  const Vec3 bodies[] = {{3.0, 4.0, 6.0}, {3.0, 3.0, 5.0}, {2.0, 5.0, 5.0}, {2.0, 2.0, 2.0}};
  for (const Vec3& I : bodies)
    for (const RotorState& s : spins)
      for (const double off : {0.0, 1e-8, -1e-8, 1e-150})
        for (const double t : {0.7, -33.3, 1e4}) {
          const Vec3 near{I.x * (1.0 + off), I.y, I.z * (1.0 - 0.5 * off)};
          const Vec3 g{s.g.x + off, s.g.y - off, s.g.z + 0.5 * off};
          arcs.push_back({I, {s.q, g}, 0.0, t, "momentum off"});
          arcs.push_back({near, {s.q, s.g}, 0.25, t, "moments off"});
        }
  for (double off = 1e-3; off > 5e-17; off *= 0.1)
    for (const double side : {1.0, -1.0, 0.0})
      for (const double t : {0.7, -33.3, 1e4})
        arcs.push_back(
            {bodies[0], {spins[0].q, {1.0, 0.5, 1.0 + side * off}}, 0.0, t, "separatrix off"});
  return mixed(arcs, 4);
}

TEST(Lanes, HoldEveryRegimeAtAnyTimeDrawnBodiesAndTheEdges) {
  const std::pair<std::vector<Arc>, std::size_t> cases[] = {{regimes_at_any_time(), 4},
                                                            {drawn_bodies(), 1},
                                                            {edges(), 1},
                                                            {neighbours_of_every_edge(), 1}};
  for (const auto& [arcs, step] : cases) {
    expect_scalar_bits(arcs);
    expect_exact(arcs, step);
  }
}

// What lanes compute has the same bits on every processor: checksums of results, which x86-64 and
// AArch64 share. States and times are drawn without a function of the C library.

constexpr std::size_t count = 1000;

// FNV-1a of the numbers' bytes, the least significant first.
template <class State>
std::uint64_t checksum(const std::vector<State>& states) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const State& s : states) {
    std::uint64_t words[sizeof(State) / 8];
    std::memcpy(words, &s, sizeof s);
    for (const std::uint64_t word : words)
      for (int k = 0; k < 64; k += 8) hash = (hash ^ (word >> k & 0xff)) * 0x100000001b3;
  }
  return hash;
}

struct Sample {
  std::vector<RotorState> states;
  std::vector<double> times;
};
const Sample& sample() {
  static const Sample drawn = [] {
    std::mt19937_64 engine(36);
    const auto number = [&] { return std::ldexp(static_cast<double>(engine() >> 11U), -52) - 1.0; };
    Sample s;
    for (std::size_t i = 0; i < count; ++i) {
      s.states.push_back(
          {{number(), number(), number(), number()}, {number(), number(), number()}});
      s.times.push_back(100.0 * number());
    }
    return s;
  }();
  return drawn;
}

const Body body(1.0, 1.7, 2.1);

TEST(LaneBits, OfFreeRotation) {
  std::vector<RotorState> results(count);
  EXPECT_TRUE(propagate({&body, 1}, sample().states, sample().times, 0.25, results).empty());
  EXPECT_EQ(checksum(results), 0x3bb3858f028abc2du);
  const FreeRotation motion(body, {{0.9, 0.1, -0.3, 0.2}, {0.2, 0.4, 0.89}});
  motion.at(sample().times, results);
  EXPECT_EQ(checksum(results), 0x7fdd8040d2bb1466u);
  motion.at(TimeGrid{-3.5, 0.0625}, results, 10);
  EXPECT_EQ(checksum(results), 0xfa302809a5fa327eu);
}

TEST(LaneBits, OfCanonicalCharts) {
  std::vector<RotorState> results(count);
  std::vector<AndoyerState> andoyer(count);
  to_andoyer(sample().states, andoyer);
  EXPECT_EQ(checksum(andoyer), 0xad21a44bd037ab9eu);
  to_rotor(andoyer, results);
  EXPECT_EQ(checksum(results), 0x5412885f1dae4e44u);
  std::vector<EulerState> euler(count);
  to_euler(sample().states, euler);
  EXPECT_EQ(checksum(euler), 0x4cdcc98ee9f643e5u);
  to_rotor(euler, results);
  EXPECT_EQ(checksum(results), 0x7571d817d05f62c1u);
  std::vector<PoincareState> poincare(count);
  nearest_poincare(sample().states, poincare);
  EXPECT_EQ(checksum(poincare), 0x2321d97f51ad1f42u);
  to_rotor(poincare, results);
  EXPECT_EQ(checksum(results), 0x88655792e8b3d4d4u);
}

TEST(LaneBits, OfFlowCharts) {
  std::vector<RotorState> results(count);
  std::vector<SadovState> sadov(count);
  to_sadov(body, sample().states, sadov);
  EXPECT_EQ(checksum(sadov), 0x91b7bebd41feb44eu);
  to_rotor(body, sadov, results);
  EXPECT_EQ(checksum(results), 0x54885447fd69fc66u);
  std::vector<SerretState> serret(count);
  to_serret(body, sample().states, sample().times, serret);
  EXPECT_EQ(checksum(serret), 0x6c6085bcac35cbb0u);
  to_rotor(body, serret, sample().times, results);
  EXPECT_EQ(checksum(results), 0x004ad82905e8332cu);
}

}  // namespace
