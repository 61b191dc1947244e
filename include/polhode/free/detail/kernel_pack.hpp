// SPDX-License-Identifier: MIT
// Kernels of single bodies in the lanes of a pack.
#pragma once

#include <cstddef>

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/math/real.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// One lane of a pack.
template <Number T>
BasicVec3<ScalarOf<T>> lane(const BasicVec3<T>& v, std::size_t i) {
  using L = LaneTraits<T>;
  return {L::get(v.x, i), L::get(v.y, i), L::get(v.z, i)};
}
template <Number T>
BasicRotorState<ScalarOf<T>> lane(const BasicRotorState<T>& s, std::size_t i) {
  using L = LaneTraits<T>;
  return {{L::get(s.q.w, i), L::get(s.q.x, i), L::get(s.q.y, i), L::get(s.q.z, i)}, lane(s.g, i)};
}

// Writes the kernel of one lane; `terms` becomes the most of any lane.
template <Number T>
class LaneOfKernel {
 public:
  LaneOfKernel(BasicFreeKernel<T>& pack, std::size_t lane) : pack_(pack), lane_(lane) {}
  void write(const BasicFreeKernel<ScalarOf<T>>& k) {
    put_mask(pack_.steady, k.steady);
    put_series(k.series);
    put(pack_.epoch, k.epoch);
    put(pack_.time_scale, k.time_scale);
    put_parts(pack_.phase0, k.phase0);
    put_parts(pack_.phase_rate, k.phase_rate);
    put_parts(pack_.phase_period, k.phase_period);
    put(pack_.inverse_phase_period, k.inverse_phase_period);
    put_parts(pack_.half_precession, k.half_precession);
    put(pack_.left, k.left);
    put(pack_.right, k.right);
    put(pack_.axis, k.axis);
    put(pack_.g0, k.g0);
    put(pack_.G, k.G);
    pack_.to_body.set_lane(lane_, k.to_body);
  }

 private:
  using S = ScalarOf<T>;
  void put(T& to, const S& from) { LaneTraits<T>::set(to, lane_, from); }
  void put_mask(Mask<T>& to, bool from) { LaneTraits<T>::set_mask(to, lane_, from); }
  template <class Parts, class From>
  void put_parts(Parts& to, const From& from) {
    put(to.hi, from.hi);
    put(to.lo, from.lo);
  }
  void put(BasicVec3<T>& to, const BasicVec3<S>& from) {
    put(to.x, from.x);
    put(to.y, from.y);
    put(to.z, from.z);
  }
  void put(BasicQuaternion<T>& to, const BasicQuaternion<S>& from) {
    put(to.w, from.w);
    put(to.x, from.x);
    put(to.y, from.y);
    put(to.z, from.z);
  }
  void put_series(const CayleyKleinSeries<S>& from) {
    CayleyKleinSeries<T>& to = pack_.series;
    put_mask(to.hyperbolic, from.hyperbolic);
    if (to.terms < from.terms) to.terms = from.terms;
    for (std::size_t i = 0; i < max_series_terms; ++i) {
      put(to.A[i], from.A[i]);
      put(to.B[i], from.B[i]);
      put(to.C[i], from.C[i]);
      put(to.D[i], from.D[i]);
    }
    put(to.nome, from.nome);
    put(to.chi_per_u, from.chi_per_u);
    put(to.phase_per_u, from.phase_per_u);
  }

  BasicFreeKernel<T>& pack_;
  std::size_t lane_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
