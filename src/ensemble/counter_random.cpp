// SPDX-License-Identifier: MIT
#include "polhode/ensemble/counter_random.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <cstddef>

#include "ensemble/detail/philox.hpp"
#include "polhode/ensemble/distributions.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

PhiloxCounter philox(const PhiloxCounter& counter, const PhiloxKey& key) {
  const philox4x64_ctr_t block =
      philox4x64_R(10, {{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
  return {block.v[0], block.v[1], block.v[2], block.v[3]};
}

}  // namespace detail

std::uint64_t CounterRandom::bits(std::uint64_t member, std::uint64_t draw) const {
  return detail::philox({draw / 4, member, 0, 0}, {seed_, key_})[draw % 4];
}

double CounterRandom::normal(std::uint64_t member, std::uint64_t draw) const {
  return normal_quantile(uniform(member, draw));
}

void CounterRandom::uniforms(std::uint64_t member, std::span<double> u) const {
  for (std::size_t first = 0; first < u.size(); first += 4) {
    const detail::PhiloxCounter block = detail::philox({first / 4, member, 0, 0}, {seed_, key_});
    const std::size_t count = std::min<std::size_t>(4, u.size() - first);
    for (std::size_t i = 0; i < count; ++i) u[first + i] = open_uniform(block[i]);
  }
}

std::uint64_t CounterRandom::shared_bits(std::uint64_t draw) const {
  return detail::philox({draw / 4, 0, 0, 1}, {seed_, key_})[draw % 4];
}

}  // namespace v0
}  // namespace polhode
