// SPDX-License-Identifier: MIT
// What a probe prints: one value per line, "case field value", parted by tabs. Doubles are in
// hexadecimal, so that a line is equal where every bit is.
#pragma once

#include <cmath>
#include <cstdio>
#include <exception>
#include <polhode/free/generating_function.hpp>
#include <polhode/polhode.hpp>
#include <polhode/rotor/chart_jacobian.hpp>
#include <polhode/system/axes.hpp>
#include <polhode/system/osculation.hpp>
#include <string>
#include <utility>

namespace probe {

class Record {
 public:
  explicit Record(std::string name) : name_(std::move(name)) {}

  void text(const std::string& field, const std::string& value) const {
    std::printf("%s\t%s\t%s\n", name_.c_str(), field.c_str(), value.c_str());
  }
  // The sign of NaN means nothing.
  void value(const std::string& field, double x) const {
    if (std::isnan(x))
      text(field, "nan");
    else
      std::printf("%s\t%s\t%a\n", name_.c_str(), field.c_str(), x);
  }
  void vector(const std::string& field, const polhode::Vec3& v) const {
    value(field + ".x", v.x);
    value(field + ".y", v.y);
    value(field + ".z", v.z);
  }
  void quaternion(const std::string& field, const polhode::Quaternion& q) const {
    value(field + ".w", q.w);
    value(field + ".x", q.x);
    value(field + ".y", q.y);
    value(field + ".z", q.z);
  }
  void state(const std::string& field, const polhode::RotorState& s) const {
    quaternion(field + ".q", s.q);
    vector(field + ".g", s.g);
  }
  template <class Matrix>
  void matrix(const std::string& field, const Matrix& m, int size) const {
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j)
        value(field + "[" + std::to_string(i) + "," + std::to_string(j) + "]", m(i, j));
  }
  // f(), or the sentence that it refuses with.
  template <class F>
  void tried(const std::string& field, const F& f) const {
    try {
      f();
    } catch (const std::exception& error) {
      text(field + ".refused", error.what());
    }
  }

 private:
  std::string name_;
};

}  // namespace probe
