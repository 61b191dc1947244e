// SPDX-License-Identifier: MIT
// Stores that go round the caches: what the memory takes.
#pragma once

#include <cstddef>

namespace peers {

// `out` aligned to 8 bytes.
void stream(double* out, std::size_t count, double value);

}  // namespace peers
