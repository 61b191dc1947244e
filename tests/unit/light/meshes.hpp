// SPDX-License-Identifier: MIT
// Meshes whose brightness is known.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "polhode/shape/facet_shape.hpp"

namespace polhode::test {

// A globe of rows and twice as many columns; `radius` of a direction of length 1.
template <class F>
shape::FacetShape globe(int rows, const F& place) {
  const int columns = 2 * rows;
  std::vector<Vec3> v;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double theta = 3.141592653589793 * i / rows, phi = 3.141592653589793 * j / rows;
      const double sine = i % rows == 0 ? 0.0 : std::sin(theta);
      v.push_back(place(Vec3{sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)}));
    }
  }
  std::vector<shape::FacetShape::Triangle> t;
  const auto at = [&](int i, int j) {
    const int pole = i == 0 || i == rows ? 0 : j % columns;
    return static_cast<std::uint32_t>(i * columns + pole);
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (i + 1 < rows) t.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) t.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {v, t};
}

inline shape::FacetShape joined(const shape::FacetShape& a, const shape::FacetShape& b) {
  std::vector<Vec3> v(a.vertices().begin(), a.vertices().end());
  std::vector<shape::FacetShape::Triangle> t(a.triangles().begin(), a.triangles().end());
  const auto first = static_cast<std::uint32_t>(v.size());
  v.insert(v.end(), b.vertices().begin(), b.vertices().end());
  for (const auto& k : b.triangles()) t.push_back({k[0] + first, k[1] + first, k[2] + first});
  return {std::move(v), std::move(t)};
}

// The square [0, 1]^2 that looks up, in 2 cells^2 triangles.
inline shape::FacetShape floor(int cells) {
  std::vector<Vec3> v;
  std::vector<shape::FacetShape::Triangle> t;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) v.push_back({1.0 * i / cells, 1.0 * j / cells, 0.0});
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (cells + 1) + j); };
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      t.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      t.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return {v, t};
}

}  // namespace polhode::test
