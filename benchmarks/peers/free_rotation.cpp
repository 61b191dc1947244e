// SPDX-License-Identifier: MIT
// Goals G1 to G6: free rotation by polhode and by its peers, over moduli from near the axis to next
// to the separatrix. The seed draws bodies, phases and times. Arguments: seed, repetitions.
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "contenders.hpp"
#include "draws.hpp"
#include "samples.hpp"
#include "streaming.hpp"
#include "worst.hpp"

namespace peers {
namespace {

constexpr std::size_t count = 1024, checked = 64, streamed = 1u << 20;

// All of a grid at once, and what some of the states miss.
double error_on_grid(const Exact& exact, const Motion& motion, std::span<const double> grid) {
  std::vector<double> rows(7 * grid.size());
  motion.rows(grid, rows.data());
  polhode::test::Worst worst;
  for (std::size_t i = 0; i < grid.size(); i += grid.size() / checked)
    worst.add(exact.error(grid[i], {rows.data() + 7 * i, 7}, {rows.data(), 7}));
  return worst.value();
}

Entry grid_entry(const Start& start, const Exact* exact, std::span<const double> grid,
                 std::vector<double>& out) {
  const Maker maker = polhode_grid_maker();
  const std::shared_ptr<Motion> motion = maker.make(start);
  return {maker.who,
          [motion, grid, &out] {
            motion->rows(grid, out.data());
            keep(out[0]);
          },
          static_cast<double>(grid.size()),
          exact != nullptr ? error_on_grid(*exact, *motion, grid) : std::nan("")};
}

// Times of any size cost the same; peers have nothing left to compare there.
Entry ages_entry(const std::string& who, const Exact& exact, const Motion& motion, Draw& draw,
                 std::vector<double>& out) {
  std::vector<double> t(count);
  for (double& x : t) x = draw.uniform(0.0, 1e5 * farthest);
  const double error = error_of(exact, motion, std::span(t).first(checked));
  return {who,
          [&motion, t, &out] {
            motion.rows(t, out.data());
            keep(out[0]);
          },
          static_cast<double>(count), error};
}

void one_body(const char* what, double k, const std::vector<Maker>& makers, Draw& draw,
              int repetitions) {
  const Start start = draw.of_modulus(k);
  std::vector<double> t(count), grid(count), out(12 * count);
  for (double& x : t) x = draw.uniform(0.0, farthest);
  const double step = even_step(count);
  for (std::size_t i = 0; i < count; ++i) grid[i] = static_cast<double>(i) * step;
  const Exact exact(start);
  std::vector<std::unique_ptr<Motion>> motions;
  std::vector<Entry> many, even, ages, scalar, set_up;
  for (const Maker& m : makers) {
    const bool together = m.who == polhode_lanes_maker().who || m.who == polhode_avx2_maker().who;
    motions.push_back(m.make(start));
    const Motion& motion = *motions.back();
    const double error = error_of(exact, motion, std::span(t).first(checked));
    const double n = static_cast<double>(count);
    if (!together)
      set_up.push_back({m.who, [&m, &start] { keep(m.make(start).get()); }, 1.0, error});
    if (m.who == polhode_short_arc_maker().who) continue;  // the same evaluation
    many.push_back({m.who,
                    [&motion, &t, &out] {
                      motion.rows(t, out.data());
                      keep(out[0]);
                    },
                    n, error});
    even.push_back({m.who,
                    [&motion, &grid, &out] {
                      motion.rows(grid, out.data());
                      keep(out[0]);
                    },
                    n, error});
    if (together) {
      ages.push_back(ages_entry(m.who, exact, motion, draw, out));
      continue;
    }
    scalar.push_back({m.who,
                      [&motion, &t, &out] {
                        for (const double& x : t) {
                          motion.rows({&x, 1}, out.data());
                          keep(out[0]);
                        }
                      },
                      n, error});
  }
  even.push_back(grid_entry(start, &exact, grid, out));
  compare("G1", what, many, repetitions);
  compare("G2", std::string(what) + ", in cache", even, repetitions);
  compare("G3", std::string(what) + ", within 1e9 turns", ages, repetitions);
  compare("G4", what, scalar, repetitions);
  compare("G5", what, set_up, repetitions);
}

// A million states of an even grid into memory, beside stores that compute nothing.
void streamed_grid(const std::vector<Maker>& makers, Draw& draw, int repetitions) {
  const Start start = draw.of_modulus(0.75);
  std::vector<double> t(streamed), out(12 * streamed);
  for (std::size_t i = 0; i < streamed; ++i) t[i] = static_cast<double>(i) * even_step(streamed);
  std::vector<std::unique_ptr<Motion>> motions;
  const double n = static_cast<double>(streamed);
  std::vector<Entry> list{
      {"streaming stores of 56 bytes", [&out] { stream(out.data(), 7 * streamed, 1.0); }, n}};
  for (const Maker& m : makers) {
    if (m.who.starts_with("Boost")) continue;  // seconds
    motions.push_back(m.make(start));
    const Motion& motion = *motions.back();
    list.push_back({m.who,
                    [&motion, &t, &out] {
                      motion.rows(t, out.data());
                      keep(out[0]);
                    },
                    n});
  }
  list.push_back(grid_entry(start, nullptr, t, out));
  compare("G2", "to memory", list, repetitions);
}

// States of short-axis mode to Sadov's variables, a state of another body each.
void to_sadov_variables(const std::vector<Maker>& makers, Draw& draw, int repetitions) {
  std::vector<Start> starts(256);
  for (Start& s : starts) s = draw.of_modulus(std::sqrt(draw.uniform(0.001, 0.999)));
  std::vector<Entry> list;
  for (const Maker& m : makers) {
    if (m.action == nullptr) continue;
    polhode::test::Worst worst;
    for (std::size_t i = 0; i < checked; ++i)
      worst.add(std::abs(m.action(starts[i]) - Exact(starts[i]).action()));
    list.push_back({m.who,
                    [&m, &starts] {
                      for (const Start& s : starts) keep(m.action(s));
                    },
                    static_cast<double>(starts.size()), worst.value()});
  }
  compare("G6", "state of a fresh body to Sadov", list, repetitions);
}

// The same of one body, whose states polhode takes together; the others take one after the other.
void many_to_sadov_variables(const std::vector<Maker>& makers, Draw& draw, int repetitions) {
  std::vector<Start> starts(256);
  const Start body = draw.of_modulus(0.5);
  for (Start& s : starts) {
    s = {body.I, {draw.normal(), draw.normal(), draw.normal()}};
    const double slope = std::sqrt((s.I[1] - s.I[0]) * s.I[2] / ((s.I[2] - s.I[1]) * s.I[0]));
    // short-axis mode, which is what the others are written for
    s.g[2] = slope * std::abs(s.g[0]) * draw.uniform(1.01, 3.0);
    Draw::scale(s, s.I[1]);
  }
  std::vector<double> found(starts.size());
  polhode_actions(starts, found.data());
  polhode::test::Worst own;
  for (std::size_t i = 0; i < checked; ++i) own.add(std::abs(found[i] - Exact(starts[i]).action()));
  std::vector<Entry> list{{"polhode to_sadov, many states at once",
                           [&starts, &found] {
                             polhode_actions(starts, found.data());
                             keep(found[0]);
                           },
                           static_cast<double>(starts.size()), own.value()}};
  for (const Maker& m : makers) {
    if (m.action == nullptr || m.who.starts_with("polhode")) continue;
    polhode::test::Worst worst;
    for (std::size_t i = 0; i < checked; ++i)
      worst.add(std::abs(m.action(starts[i]) - Exact(starts[i]).action()));
    list.push_back({m.who,
                    [&m, &starts] {
                      for (const Start& s : starts) keep(m.action(s));
                    },
                    static_cast<double>(starts.size()), worst.value()});
  }
  compare("G6", "many states of a body to Sadov", list, repetitions);
}

}  // namespace
}  // namespace peers

int main(int argc, char** argv) {
  using namespace peers;
  Draw draw{std::mt19937_64(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1)};
  const int repetitions = argc > 2 ? std::atoi(argv[2]) : 7;
  const std::vector<Maker> makers = present(
      {polhode_lanes_maker(), polhode_avx2_maker(), polhode_maker(), polhode_short_arc_maker(),
       boost_maker(), boost_double_maker(), geographic_maker(), van_zon_maker()});
  one_body("k = 0.05", 0.05, makers, draw, repetitions);
  one_body("k = 0.5", 0.5, makers, draw, repetitions);
  one_body("k = 0.75", 0.75, makers, draw, repetitions);
  one_body("k = 0.9999", 0.9999, makers, draw, repetitions);
  one_body("k = 1 - 1e-9", 1.0 - 1e-9, makers, draw, repetitions);
  streamed_grid(makers, draw, repetitions);
  std::vector<Maker> with_sadov = makers;
  with_sadov.push_back(polhode_sadov_maker());
  to_sadov_variables(with_sadov, draw, repetitions);
  many_to_sadov_variables(makers, draw, repetitions);
}
