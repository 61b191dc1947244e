// SPDX-License-Identifier: MIT
// Checkpoints: their bytes, and the check that one belongs to a problem.
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "polhode/dynamics/detail/run.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

namespace {

constexpr std::string_view magic = "polhode checkpoint 7";

template <class... X>
std::string bytes_of(X... x) {
  Archive bytes;
  bytes.all(x...);
  return bytes.bytes();
}

}  // namespace

Checkpoint::Checkpoint(std::string bytes) : bytes_(std::move(bytes)) {
  Archive reader(bytes_);
  std::string head;
  std::uint64_t hash = 0;
  reader.all(head, hash, t_);
  if (head != magic) throw DomainError("Checkpoint: bytes that are no checkpoint of this version");
  const std::size_t hashed = 8 + head.size() + 8;  // t and all that follows
  if (fingerprint(std::string_view(bytes_).substr(hashed)) != hash)
    throw DomainError("Checkpoint: its bytes were damaged");
}

namespace detail {

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

Archive opened_checkpoint(const Checkpoint& from, const Features& features) {
  Archive bytes(from.bytes());
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

}  // namespace detail
}  // namespace v0
}  // namespace polhode
