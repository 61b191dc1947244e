// SPDX-License-Identifier: MIT
// Archive: the numbers of a state as bytes and back, to the last bit. One function of an object
// visits its numbers for both ways, so that what is read is what was written.
//
// Units       any.
// Domain      numbers, texts, vectors, quaternions, arrays, lists, pairs, optional ones of them,
//             samples and events of any state. To write: visit, then bytes(); what is visited
//             is only read, so other threads may read it too. To read: visit the same things in the
//             same order.
// Accuracy    exact: every double is kept as its bits, the lowest byte first on every machine.
// Errors      DomainError for bytes that end too early.
// Cost        eight bytes per number.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/math/double_double.hpp"
#include "polhode/math/dual.hpp"
#include "polhode/trajectory/trajectory.hpp"

namespace polhode {
inline namespace v0 {
// FNV-1a of 64 bits: distinguishes texts and finds bytes that were damaged. Of a text in pieces,
// each goes on from the hash of those before.
inline std::uint64_t fingerprint(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325U) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

class Archive {
 public:
  Archive() = default;  // to write
  explicit Archive(std::string_view bytes) : rest_(bytes), reads_(true) {}

  bool reads() const { return reads_; }
  const std::string& bytes() const { return bytes_; }
  bool is_done() const { return rest_.empty(); }

  void operator()(std::uint64_t& x) {
    char eight[8];  // the lowest byte first, on every machine
    if (!reads_) {
      for (int i = 0; i < 8; ++i) eight[i] = static_cast<char>(x >> (8 * i) & 0xffU);
      bytes_.append(eight, sizeof eight);
      return;
    }
    const std::string_view text = taken(sizeof eight);
    x = 0;
    for (int i = 7; i >= 0; --i)
      x = x << 8 | static_cast<unsigned char>(text[static_cast<std::size_t>(i)]);
  }
  void operator()(std::int64_t& x) { as<std::uint64_t>(x); }
  void operator()(int& x) { as<std::int64_t>(x); }
  void operator()(bool& x) { as<std::int64_t>(x); }
  void operator()(double& x) {
    std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    (*this)(bits);
    if (reads_) x = std::bit_cast<double>(bits);
  }
  void operator()(std::string& x) {
    std::uint64_t size = x.size();
    (*this)(size);
    if (reads_) {
      x = taken(size);
    } else {
      bytes_ += x;
    }
  }
  void operator()(DoubleDouble& x) { all(x.hi, x.lo); }
  void operator()(TwoTerms<double>& x) { all(x.hi, x.lo); }
  void operator()(Vec3& v) { all(v.x, v.y, v.z); }
  void operator()(Quaternion& q) { all(q.w, q.x, q.y, q.z); }
  void operator()(Mat3& m) { all(m.row[0], m.row[1], m.row[2]); }
  void operator()(Statistics& s) { all(s.steps, s.rejected, s.evaluations); }
  template <MotionState S>
  void operator()(S& s) {
    each_number(s, [this](double& x) { (*this)(x); });
  }
  template <MotionState S>
  void operator()(BasicSample<S>& s) {
    all(s.t, s.s);
  }
  template <MotionState S>
  void operator()(BasicEventRecord<S>& e) {
    all(e.name, e.t, e.s, e.direction);
  }
  template <class T, int N>
  void operator()(Dual<T, N>& x) {
    all(x.value, x.derivative);
  }
  template <class T, std::size_t N>
  void operator()(std::array<T, N>& values) {
    for (T& x : values) (*this)(x);
  }
  template <class T>
  void operator()(std::optional<T>& x) {
    bool is_given = x.has_value();
    (*this)(is_given);
    if (!is_given && x) x.reset();
    if (is_given && !x) x.emplace(T{});
    if (x) (*this)(*x);
  }
  template <class A, class B>
  void operator()(std::pair<A, B>& x) {
    all(x.first, x.second);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    std::uint64_t size = values.size();
    (*this)(size);
    if (reads_) {
      if (size > rest_.size()) throw too_short();  // each has a byte at least
      values.assign(size, T{});
    }
    for (T& x : values) (*this)(x);
  }
  template <class... T>
  void all(T&... x) {
    ((*this)(x), ...);
  }
  // The last text, without its size: all that is left.
  void rest(std::string& x) {
    if (reads_) {
      x = taken(rest_.size());
    } else {
      bytes_ += x;
    }
  }
  // A list: the number of its elements, then each, as `each` visits it.
  template <class T, class Each>
  void list(std::vector<T>& values, const Each& each) {
    std::uint64_t size = values.size();
    (*this)(size);
    if (reads_) values.clear();
    for (std::uint64_t i = 0; i < size; ++i) each(reads_ ? values.emplace_back() : values[i]);
  }

 private:
  static DomainError too_short() { return DomainError("Checkpoint: its bytes end too early"); }

  template <class Wide, class T>
  void as(T& x) {
    Wide wide = static_cast<Wide>(x);
    (*this)(wide);
    if (reads_) x = static_cast<T>(wide);
  }
  std::string_view taken(std::uint64_t size) {
    if (size > rest_.size()) throw too_short();
    const std::string_view text = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return text;
  }

  std::string bytes_;
  std::string_view rest_;
  bool reads_ = false;
};

}  // namespace v0
}  // namespace polhode
