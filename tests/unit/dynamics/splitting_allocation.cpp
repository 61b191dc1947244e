// SPDX-License-Identifier: MIT
// A step of a splitting allocates nothing, and its drift cannot throw: every allocation of this
// program is counted.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>

#include "dynamics/splitting/splitting_map.hpp"
#include "splitting_support.hpp"

namespace {
std::atomic<long> allocations = 0;
}

// Not inline: g++ would take free for a mismatch of new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* place = std::malloc(size > 0 ? size : 1)) return place;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}
[[gnu::noinline]] void operator delete(void* place) noexcept { std::free(place); }
[[gnu::noinline]] void operator delete(void* place, std::size_t) noexcept { std::free(place); }

namespace polhode {
namespace {

static_assert(noexcept(std::declval<const detail::ShortFlow&>().after({}, 0.0)));

TEST(Splitting, AStepAllocatesNothing) {
  const AnyPerturbation gravity("gravity gradient", splitting_test::PointMassTorque{1.0, 0.1});
  const AnyPerturbation damping("damping", splitting_test::Damping{0.1});
  for (const auto& terms : {std::vector{gravity}, std::vector{gravity, damping}}) {
    const System system(splitting_test::workload_body(), splitting_test::precessing_frame(), terms);
    const detail::SplittingMap map(system, SplittingScheme::ABA864);
    detail::SplittingState s = map.start(0.0, splitting_test::workload_state());
    const long before = allocations;
    EXPECT_GT(before, 0);  // they are counted
    for (int i = 0; i < 100; ++i) s = map.stepped(s, 0.05);
    EXPECT_EQ(allocations, before);
  }
}

}  // namespace
}  // namespace polhode
