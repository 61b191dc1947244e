// SPDX-License-Identifier: MIT
// Goal G12: the state of a new body each, by polhode and by its peers; a million of them, on one
// and on two threads, within a hundred turns and within 1e9 of them. The seed draws bodies and
// times. Arguments: seed, repetitions.
#include <cstdlib>
#include <memory>
#include <span>

#include "draws.hpp"
#include "polhode/ensemble/batches.hpp"
#include "samples.hpp"

namespace peers {
namespace {

constexpr std::size_t few = 512, many = 1'000'000, checked = 64;

void some(const std::vector<Maker>& makers, Draw& draw, int repetitions) {
  std::vector<Start> starts(few);
  for (Start& s : starts) s = draw.any();
  const double t = draw.uniform(100.0, 628.0);
  std::vector<Entry> list;
  for (const Maker& m : makers) {
    polhode::test::Worst worst;
    for (std::size_t i = 0; i < checked; ++i)
      worst.add(error_of(Exact(starts[i]), *m.make(starts[i]), {&t, 1}));
    list.push_back({m.who, [&m, &starts, t] { keep(m.fresh(starts, t)); }, static_cast<double>(few),
                    worst.value()});
  }
  compare("G12", "any mode, within 100 turns", list, repetitions);
}

struct Bodies {
  std::vector<Start> starts;
  std::vector<polhode::RotorState> states;
  std::vector<double> times;

  Bodies(Draw& draw, double longest, double near_separatrix) {
    for (std::size_t i = 0; i < many; ++i) {
      Start s = draw.any();
      if (draw.uniform(0.0, 1.0) < near_separatrix)
        draw.move_to_separatrix(s, 1e-6 * draw.uniform(-1.0, 1.0));
      starts.push_back(s);
      states.push_back({{}, {s.g[0], s.g[1], s.g[2]}});
      times.push_back(draw.uniform(0.0, longest));
    }
  }
  polhode::BodyRows rows() const {
    static constexpr double epoch = 0.0;
    return {{starts[0].I.data(), sizeof(Start) / sizeof(double)},
            {&states[0].q.w, sizeof(polhode::RotorState) / sizeof(double)},
            {times.data(), 1},
            {&epoch, 0}};
  }
  double error(std::span<const polhode::RotorState> found) const {
    polhode::test::Worst worst;
    const std::array<double, 7> first{1.0};
    for (std::size_t i = 0; i < many; i += many / checked)
      worst.add(Exact(starts[i]).error(times[i], {&found[i].q.w, 7}, first));
    return worst.value();
  }
};

double wall_seconds() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void a_million(const std::string& what, const Bodies& bodies, const Maker* peer, int repetitions) {
  std::vector<polhode::RotorState> found(many);
  const auto on = [&](int threads) {
    polhode::ensemble::propagate(bodies.rows(), found, threads);
    keep(found[0]);
  };
  on(1);
  const double error = bodies.error(found), n = static_cast<double>(many);
  const std::string who = "polhode propagate, many bodies at once";
  std::vector<Entry> list{{who, [&] { on(1); }, n, error}};
  if (peer != nullptr)
    list.push_back(
        {peer->who, [&] { keep(peer->fresh(std::span(bodies.starts), bodies.times[0])); }, n});
  compare("G12", what, list, repetitions);
  compare("G12", "waited for, " + what,
          {{who, [&] { on(1); }, n, error}, {who + ", two threads", [&] { on(2); }, n, error}},
          repetitions, 0.2, wall_seconds);
}

}  // namespace
}  // namespace peers

int main(int argc, char** argv) {
  using namespace peers;
  Draw draw{std::mt19937_64(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1)};
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 7;
  const std::vector<Maker> makers =
      present({polhode_bodies_maker(), polhode_maker(), polhode_short_arc_maker(), boost_maker(),
               boost_double_maker(), geographic_maker(), van_zon_maker()});
  some(makers, draw, repetitions);
  const Maker van_zon = van_zon_maker();
  const double turns = 6.283;
  a_million("a million, within 100 turns", Bodies(draw, 100 * turns, 0.0), &van_zon, repetitions);
  a_million("a million within 1e9 turns, a tenth next to the separatrix",
            Bodies(draw, 1e9 * turns, 0.1), nullptr, repetitions);
}
