// SPDX-License-Identifier: MIT
// Free rotation in double-double by Taylor series, which know no elliptic functions: an oracle for
// derivatives of fits, by differences.
#pragma once

#include <cstddef>
#include <vector>

#include "polhode/math/double_double.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/math/vector.hpp"

namespace polhode::test {

// dg/dt = g x w, dq/dt = q w / 2.
struct WideMotion {
  using DD = DoubleDouble;

  BasicQuaternion<DD> q;
  BasicVec3<DD> g, I;

  void advance(const DD& t) {
    constexpr std::size_t order = 26;
    const int steps = 1 + static_cast<int>(3.0 * static_cast<double>(t));
    const DD h = t / DD(static_cast<double>(steps));
    for (int n = 0; n < steps; ++n) {
      std::vector<BasicVec3<DD>> gs{g}, ws;
      std::vector<BasicQuaternion<DD>> qs{q};
      for (std::size_t k = 0; k < order; ++k) {
        ws.push_back({gs[k].x / I.x, gs[k].y / I.y, gs[k].z / I.z});
        BasicVec3<DD> dg{DD(0.0), DD(0.0), DD(0.0)};
        BasicQuaternion<DD> dq{DD(0.0), DD(0.0), DD(0.0), DD(0.0)};
        for (std::size_t j = 0; j <= k; ++j) {
          const BasicVec3<DD>& w = ws[k - j];
          dg = dg + cross(gs[j], w);
          const auto p = qs[j] * BasicQuaternion<DD>{DD(0.0), w.x, w.y, w.z};
          dq = {dq.w + p.w, dq.x + p.x, dq.y + p.y, dq.z + p.z};
        }
        const DD part = DD(1.0) / DD(static_cast<double>(k + 1)), half = DD(0.5) * part;
        gs.push_back(part * dg);
        qs.push_back({half * dq.w, half * dq.x, half * dq.y, half * dq.z});
      }
      g = gs[order];
      q = qs[order];
      for (std::size_t k = order; k-- > 0;) {
        g = h * g + gs[k];
        q = {h * q.w + qs[k].w, h * q.x + qs[k].x, h * q.y + qs[k].y, h * q.z + qs[k].z};
      }
    }
  }
};

}  // namespace polhode::test
