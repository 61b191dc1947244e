// SPDX-License-Identifier: MIT
// Meshes whose integrals are known in closed form.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "polhode/shape/facet_shape.hpp"

namespace shape_test {

using namespace polhode;

// Half edges a, b, c about the origin.
inline shape::FacetShape box(double a, double b, double c) {
  std::vector<Vec3> v;
  for (int i = 0; i < 8; ++i)
    v.push_back({(i & 1) != 0 ? a : -a, (i & 2) != 0 ? b : -b, (i & 4) != 0 ? c : -c});
  return {v,
          {{0, 2, 3},
           {0, 3, 1},
           {4, 5, 7},
           {4, 7, 6},
           {0, 1, 5},
           {0, 5, 4},
           {2, 6, 7},
           {2, 7, 3},
           {0, 4, 6},
           {0, 6, 2},
           {1, 3, 7},
           {1, 7, 5}}};
}

inline shape::FacetShape tetrahedron(const std::array<Vec3, 4>& v) {
  return {{v.begin(), v.end()}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// x -> A x + b, A of positive determinant.
inline shape::FacetShape image(const shape::FacetShape& shape, const Mat3& A, const Vec3& b) {
  std::vector<Vec3> v;
  for (const Vec3& x : shape.vertices()) v.push_back(A * x + b);
  return {v, {shape.triangles().begin(), shape.triangles().end()}};
}

// An octahedron divided `level` times and put on the ellipsoid of half axes a, b, c.
inline shape::FacetShape ellipsoid(double a, double b, double c, int level) {
  std::vector<Vec3> v{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<shape::FacetShape::Triangle> t{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int k = 0; k < level; ++k) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, is_new] = middle.try_emplace(std::pair(i < j ? i : j, i < j ? j : i), 0);
      if (is_new) {
        const Vec3 x = v[i] + v[j];
        v.push_back((1.0 / norm(x)) * x);
        at->second = static_cast<std::uint32_t>(v.size() - 1);
      }
      return at->second;
    };
    std::vector<shape::FacetShape::Triangle> finer;
    for (const auto& [p, q, r] : t) {
      const std::uint32_t pq = between(p, q), qr = between(q, r), rp = between(r, p);
      for (const shape::FacetShape::Triangle& f :
           {shape::FacetShape::Triangle{p, pq, rp}, {pq, q, qr}, {rp, qr, r}, {pq, qr, rp}})
        finer.push_back(f);
    }
    t = std::move(finer);
  }
  for (Vec3& x : v) x = {a * x.x, b * x.y, c * x.z};
  return {v, t};
}

}  // namespace shape_test
