// SPDX-License-Identifier: MIT
// The worst error so far, and the larger and smaller of numbers, such that NaN is never lost:
// std::max(worst, NaN) is worst, and a test that takes it passes on a result that is NaN.
#pragma once

#include <limits>
#include <string>
#include <type_traits>
#include <utility>

namespace polhode::test {

// NaN if one of them is; that is x != x for every type of number.
template <class T>
constexpr T larger(const T& a, const std::type_identity_t<T>& b) {
  return a != a || (b == b && b <= a) ? a : b;
}
template <class T>
constexpr T smaller(const T& a, const std::type_identity_t<T>& b) {
  return a != a || (b == b && b >= a) ? a : b;
}
template <class T, class... More>
constexpr T larger(const T& a, const std::type_identity_t<T>& b, const More&... more) {
  return larger<T>(larger<T>(a, b), more...);
}
template <class T, class... More>
constexpr T smaller(const T& a, const std::type_identity_t<T>& b, const More&... more) {
  return smaller<T>(smaller<T>(a, b), more...);
}

// The largest number that was added, and the words given with it. It is NaN after a NaN, and while
// nothing was added: a loop that measured nothing has not passed.
template <class T = double>
class Worst {
 public:
  void add(const T& x, std::string where = {}) {
    const bool first = !measured_;
    measured_ = true;
    if (!first && (value_ != value_ || x <= value_)) return;
    value_ = x;
    where_ = std::move(where);
  }
  bool measured() const { return measured_; }
  const T& value() const { return value_; }
  const std::string& where() const { return where_; }

 private:
  bool measured_ = false;
  T value_ = std::numeric_limits<T>::quiet_NaN();
  std::string where_;
};

}  // namespace polhode::test
