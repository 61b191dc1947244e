// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <string_view>

#include "math/number_text.hpp"
#include "polhode/dynamics/detail/run.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::string_view magic = "polhode checkpoint 5";

template <class... X>
std::string bytes_of(X... x) {
  StateBytes bytes;
  bytes.all(x...);
  return bytes.bytes();
}

}  // namespace

Checkpoint::Checkpoint(std::string bytes) : bytes_(std::move(bytes)) {
  StateBytes reader(bytes_);
  std::string head;
  std::uint64_t hash = 0;
  reader.all(head, hash, t_);
  if (head != magic) throw DomainError("Checkpoint: bytes that are no checkpoint of this version");
  const std::size_t hashed = 8 + head.size() + 8;  // t and all that follows
  if (fingerprint(std::string_view(bytes_).substr(hashed)) != hash)
    throw DomainError("Checkpoint: its bytes were damaged");
}

namespace detail {
namespace {

// A run does not end that would need this many steps of the length that its last ones had: 1e12 of
// a microsecond are twelve days.
constexpr double most_steps = 1e12;
// The last ones: a step that a jump of a torque has cut is followed by longer ones long before.
constexpr std::int64_t settled = 1000;

}  // namespace

std::string full_text(double most_bytes, double t) {
  return "the steps up to t = " + number_text(t) + " fill the " + number_text(most_bytes) +
         " bytes that a trajectory may take in memory (most_bytes): take samples at fewer times "
         "and no dense output, a shorter run, or a higher limit";
}

std::string number_bytes(double x) { return bytes_of(x); }

std::string event_bytes(const std::string& name, Crossing crossing, bool stops, double period,
                        double interval) {
  return bytes_of(name, static_cast<int>(crossing), stops, period, interval);
}

std::string method_bytes(const Method& method) {
  const MethodTraits traits = method_traits(method);
  std::string bytes = traits.text;
  for (const double x : traits.further) bytes += bytes_of(x);
  return bytes;
}

std::string times_bytes(const SaveAt& times) {
  const std::int64_t n = times.size();
  return n == 0 ? bytes_of(n) : bytes_of(n, times[0], times[n / 2], times[n - 1]);
}

Checkpoint made_checkpoint(const Features& features, double t, const std::string& state) {
  const std::string hashed = bytes_of(t, features) + state;
  return Checkpoint(bytes_of(std::string(magic), fingerprint(hashed)) + hashed);
}

StateBytes opened_checkpoint(const Checkpoint& from, const Features& features) {
  StateBytes bytes(from.bytes());
  std::string head;
  std::uint64_t hash = 0;
  double t = 0.0;
  Features kept;
  bytes.all(head, hash, t, kept);
  for (std::size_t i = 0; i < features.size(); ++i)
    if (i >= kept.size() || kept[i] != features[i])
      throw DomainError("resume: the checkpoint is of another problem: " + features[i].first +
                        " differs");
  if (kept.size() != features.size())
    throw DomainError("resume: the checkpoint is of another problem: its state differs");
  return bytes;
}

std::string EndJudge::judged(double t, double stop, std::int64_t steps) {
  if (steps < steps_ + settled) return {};
  const double made = std::abs(t - t_) / static_cast<double>(steps - steps_);
  const double left = std::abs(stop - t);
  steps_ = steps;
  t_ = t;
  if (!(left > most_steps * made)) return {};
  double power = std::pow(10.0, std::floor(std::log10(left / made)));
  if (power * made > left) power *= 0.1;  // its logarithm was rounded up
  return "at t = " + number_text(t) + " the last " + number_text(settled) + " steps are " +
         number_text(made) + " each, so reaching the end would take " + number_text(power) +
         " of them and more: is the rotation, an orbit or a torque that fast, does it grow, or is "
         "a damping that stiff? Try a shorter run";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
