// SPDX-License-Identifier: MIT
// polhode's free rotation through its public interface.
#include <algorithm>
#include <array>
#include <vector>

#include "contenders.hpp"
#include "polhode/detail/free/states_at.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/free/propagate.hpp"
#include "polhode/free/sadov.hpp"

namespace peers {
namespace {

using namespace polhode;

RotorState state_of(const Start& s) { return {{}, {s.g[0], s.g[1], s.g[2]}}; }
Body body_of(const Start& s) { return {s.I[0], s.I[1], s.I[2]}; }

void write_row(const Start& start, const RotorState& s, double* out) {
  out[0] = s.q.w;
  out[1] = s.q.x;
  out[2] = s.q.y;
  out[3] = s.q.z;
  out[4] = s.g.x / start.I[0];
  out[5] = s.g.y / start.I[1];
  out[6] = s.g.z / start.I[2];
}

template <bool short_arc>
FreeRotation prepared(const Start& s) {
  if constexpr (short_arc) return FreeRotation::short_arc(body_of(s), state_of(s));
  return FreeRotation(body_of(s), state_of(s));
}

template <bool short_arc>
class Polhode : public Motion {
 public:
  explicit Polhode(const Start& s) : start_(s), motion_(prepared<short_arc>(s)) {}
  void rows(std::span<const double> t, double* out) const override {
    for (const double x : t) {
      write_row(start_, motion_.at(x), out);
      out += 7;
    }
  }

 private:
  Start start_;
  FreeRotation motion_;
};

// Many times at once, in place; then the angular velocity in the place of the momentum.
class InLanes : public Motion {
 public:
  explicit InLanes(const Start& s, InstructionSet set = widest_instruction_set())
      : motion_(body_of(s), state_of(s)),
        inverse_{1.0 / s.I[0], 1.0 / s.I[1], 1.0 / s.I[2]},
        set_(set) {}
  void rows(std::span<const double> t, double* out) const override {
    static_assert(sizeof(RotorState) == 7 * sizeof(double));
    states_at(motion_.kernel(), t, {reinterpret_cast<RotorState*>(out), t.size()}, set_);
    for (std::size_t i = 0; i < t.size(); ++i, out += 7)
      for (std::size_t k = 0; k < 3; ++k) out[4 + k] *= inverse_[k];
  }

 private:
  FreeRotation motion_;
  std::array<double, 3> inverse_;
  InstructionSet set_;
};

// Even times alone, from the first on: rows hold the momentum in place of the angular velocity.
class OnGrid : public Motion {
 public:
  explicit OnGrid(const Start& s) : motion_(body_of(s), state_of(s)) {}
  void rows(std::span<const double> t, double* out) const override {
    const double step = t.size() > 1 ? t[1] - t[0] : 0.0;
    motion_.at(TimeGrid{t[0], step}, {reinterpret_cast<RotorState*>(out), t.size()});
  }

 private:
  FreeRotation motion_;
};

template <bool short_arc>
std::unique_ptr<Motion> make(const Start& s) {
  return std::make_unique<Polhode<short_arc>>(s);
}

template <bool short_arc>
double fresh(std::span<const Start> starts, double t) {
  double sum = 0.0;
  for (const Start& s : starts) sum += prepared<short_arc>(s).at(t).q.w;
  return sum;
}

// A body as propagate takes it.
class OfMany : public Motion {
 public:
  explicit OfMany(const Start& s) : start_(s), body_(body_of(s)), state_(state_of(s)) {}
  void rows(std::span<const double> t, double* out) const override {
    for (const double& x : t) {
      RotorState found;
      propagate({&body_, 1}, {&state_, 1}, {&x, 1}, 0.0, {&found, 1});
      write_row(start_, found, out);
      out += 7;
    }
  }

 private:
  Start start_;
  Body body_;
  RotorState state_;
};

double fresh_in_lanes(std::span<const Start> starts, double t) {
  static std::vector<RotorState> states, found;
  states.resize(starts.size());
  found.resize(starts.size());
  std::transform(starts.begin(), starts.end(), states.begin(), state_of);
  constexpr double epoch = 0.0;
  propagate({{starts[0].I.data(), sizeof(Start) / sizeof(double)},
             {&states[0].q.w, sizeof(RotorState) / sizeof(double)},
             {&t, 0},
             {&epoch, 0}},
            found);
  double sum = 0.0;
  for (const RotorState& s : found) sum += s.q.w;
  return sum;
}

template <bool short_arc>
double action(const Start& s) {
  const SadovState found = to_sadov(prepared<short_arc>(s), 0.0);
  asm volatile("" : : "m"(found));
  return found.I_l / found.I_g;
}

double action_alone(const Start& s) {
  const SadovState found = to_sadov(body_of(s), state_of(s));
  asm volatile("" : : "m"(found));
  return found.I_l / found.I_g;
}

}  // namespace

Maker polhode_grid_maker() {
  return {"polhode FreeRotation, even grid",
          [](const Start& s) -> std::unique_ptr<Motion> { return std::make_unique<OnGrid>(s); },
          nullptr};
}
Maker polhode_sadov_maker() { return {"polhode to_sadov", nullptr, nullptr, action_alone}; }
void polhode_actions(std::span<const Start> of_one_body, double* actions) {
  std::vector<RotorState> states;
  for (const Start& s : of_one_body) states.push_back(state_of(s));
  std::vector<SadovState> found(states.size());
  to_sadov(body_of(of_one_body[0]), states, found);
  for (std::size_t i = 0; i < found.size(); ++i) actions[i] = found[i].I_l / found[i].I_g;
}

Maker polhode_maker() { return {"polhode FreeRotation", make<false>, fresh<false>, action<false>}; }
Maker polhode_lanes_maker() {
  return {"polhode FreeRotation, many times at once",
          [](const Start& s) -> std::unique_ptr<Motion> { return std::make_unique<InLanes>(s); },
          nullptr};
}
Maker polhode_avx2_maker() {
  const std::string who = polhode_lanes_maker().who + ", AVX2";
  if (!supports(InstructionSet::avx2)) return {who, nullptr, nullptr};
  return {who,
          [](const Start& s) -> std::unique_ptr<Motion> {
            return std::make_unique<InLanes>(s, InstructionSet::avx2);
          },
          nullptr};
}
Maker polhode_bodies_maker() {
  return {"polhode propagate, many bodies at once",
          [](const Start& s) -> std::unique_ptr<Motion> { return std::make_unique<OfMany>(s); },
          fresh_in_lanes};
}
Maker polhode_short_arc_maker() {
  return {"polhode short_arc", make<true>, fresh<true>, action<true>};
}

}  // namespace peers
