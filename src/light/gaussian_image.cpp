// SPDX-License-Identifier: MIT
// Gaussian images of convex bodies as series of spherical harmonics.
#include <Eigen/QR>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "light/harmonics.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/convex_body.hpp"

namespace polhode {
inline namespace v0 {
namespace light {

// P_lm / sin^m theta, normalised, by the recurrence in l; sin^m theta e^(i m phi) = (x + i y)^m.
std::vector<double> spherical_harmonics(int degree, const Vec3& n) {
  const auto size = static_cast<std::size_t>(degree) + 1;
  std::vector<double> Y(size * size);
  const auto place = [](int l, int m) {
    const int at = l * l + l + m;
    return static_cast<std::size_t>(at);
  };
  double re = 1.0, im = 0.0;  // (x + i y)^m
  double own = 1.0;           // of l = m
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) {
      const double before = re;
      re = before * n.x - im * n.y;
      im = before * n.y + im * n.x;
      // mean square 1: 2 from cos and sin at m = 1, (2m + 1) / (2m) from the degree
      own *= std::sqrt((m == 1 ? 2.0 : 1.0) * (2.0 * m + 1.0) / (2.0 * m));
    }
    double last = 0.0, P = own;
    for (int l = m; l <= degree; ++l) {
      Y[place(l, m)] = P * re;
      if (m > 0) Y[place(l, -m)] = P * im;
      const auto ratio = [m](double k) {  // of the norms of k - 1 and k, times k - m
        return std::sqrt((k * k - 1.0 * m * m) / (4.0 * k * k - 1.0));
      };
      const double next = (n.z * P - (l > m ? ratio(l) : 0.0) * last) / ratio(l + 1.0);
      last = P;
      P = next;
    }
  }
  return Y;
}

namespace {

constexpr std::size_t most_harmonics = std::size_t{1} << 24;  // 128 MiB
// Of the diagonal of R to its largest: 1e-16 where normals do not determine the coefficients, 1e-3
// or more where they do.
constexpr double smallest_pivot = 1e-9;
// Of the roots of solid angles: twice as wide takes light from thin bodies, half as wide leaves
// them nearly the bends of flat facets.
constexpr double patch_width = 1.5;

Vec3 unit(const Vec3& v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

// Of the triangle on the unit sphere (Van Oosterom & Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2.0 * std::atan2(dot(a, cross(b, c)), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

template <class F>
void for_triangles(int rows, const F& f) {  // 8 rows^2 trips
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3 sign{octant % 2 == 0 ? 1.0 : -1.0, octant / 2 % 2 == 0 ? 1.0 : -1.0,
                    octant / 4 == 0 ? 1.0 : -1.0};
    const bool is_mirrored = sign.x * sign.y * sign.z < 0.0;
    const auto corner = [&](int i, int j) {
      const double k = rows - i - j;
      return unit({sign.x * i, sign.y * j, sign.z * k});
    };
    const auto triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      if (is_mirrored)
        f(a, c, b);
      else
        f(a, b, c);
    };
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; i + j < rows; ++j) {
        triangle(corner(i, j), corner(i + 1, j), corner(i, j + 1));
        if (i + j + 1 < rows) triangle(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
      }
    }
  }
}

void require_range(const char* what, int x, int lowest, int highest) {
  if (x >= lowest && x <= highest) return;
  throw DomainError("GaussianImage: " + std::string(what) + " " + std::to_string(x) +
                    " must be from " + std::to_string(lowest) + " to " + std::to_string(highest));
}
void require_count(const char* what, std::size_t got, std::size_t expected) {
  if (got == expected) return;
  throw DomainError("GaussianImage: got " + std::to_string(got) + " " + what + "; expected " +
                    std::to_string(expected));
}

}  // namespace

GaussianImage::GaussianImage(int degree, int rows) {
  require_range("degree", degree, 0, 40);
  require_range("rows", rows, 1, 200);
  Basis made;
  made.degree = degree;
  made.rows = rows;
  const auto orders = static_cast<std::size_t>(degree) + 1;
  made.count = orders * orders;
  const std::size_t normals = 8 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(rows);
  if (normals < made.count)
    throw DomainError("GaussianImage: " + std::to_string(normals) + " normals for " +
                      std::to_string(made.count) + " coefficients of degree " +
                      std::to_string(degree) + "; expected more rows");
  if (normals * made.count > most_harmonics)
    throw DomainError("GaussianImage: degree " + std::to_string(degree) + " with rows " +
                      std::to_string(rows) + " has " + std::to_string(normals * made.count) +
                      " harmonics; expected at most " + std::to_string(most_harmonics) +
                      ", of a lower degree or fewer rows");
  for_triangles(rows, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = unit(a + b + c);
    const std::vector<double> Y = spherical_harmonics(degree, n);
    made.normals.push_back(n);
    made.solid_angles.push_back(solid_angle(a, b, c));
    made.widths.push_back(patch_width * std::sqrt(made.solid_angles.back()));
    made.harmonics.insert(made.harmonics.end(), Y.begin(), Y.end());
  });
  basis_ = std::make_shared<const Basis>(std::move(made));
}

std::vector<double> GaussianImage::areas(std::span<const double> coefficients) const {
  require_count("coefficients", coefficients.size(), basis_->count);
  std::vector<double> A(basis_->normals.size());
  for (std::size_t j = 0; j < A.size(); ++j) {
    const std::span<const double> Y = harmonics(j);
    double sum = 0.0;
    for (std::size_t k = 0; k < Y.size(); ++k) sum += coefficients[k] * Y[k];
    A[j] = basis_->solid_angles[j] * std::exp(sum);
  }
  return A;
}

std::vector<double> GaussianImage::coefficients(std::span<const double> areas) const {
  require_count("areas", areas.size(), basis_->normals.size());
  const auto count = static_cast<Eigen::Index>(basis_->count);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(areas.size()), count);
  Eigen::VectorXd right(rows.rows());
  for (std::size_t j = 0; j < areas.size(); ++j) {
    if (!(areas[j] > 0.0) || !std::isfinite(areas[j]))
      throw DomainError("GaussianImage: area " + std::to_string(j + 1) + ", " +
                        polhode::detail::number_text(areas[j]) + ", must be positive and finite");
    const double w = basis_->solid_angles[j], root = std::sqrt(w);
    const auto row = static_cast<Eigen::Index>(j);
    rows.row(row) = root * Eigen::Map<const Eigen::RowVectorXd>(harmonics(j).data(), count);
    right(row) = root * std::log(areas[j] / w);
  }
  Eigen::ColPivHouseholderQR<Eigen::Ref<Eigen::MatrixXd>> qr(rows);  // in its place
  qr.setThreshold(smallest_pivot);
  if (qr.rank() < count)
    throw DomainError("GaussianImage: the " + std::to_string(areas.size()) + " normals of rows " +
                      std::to_string(basis_->rows) + " determine " + std::to_string(qr.rank()) +
                      " of the " + std::to_string(count) + " coefficients of degree " +
                      std::to_string(basis_->degree) + "; expected more rows");
  const Eigen::VectorXd c = qr.solve(right);
  return {c.data(), c.data() + c.size()};
}

std::vector<double> GaussianImage::coefficients(const Ellipsoid& body) const {
  std::vector<double> A(basis_->normals.size());
  for (std::size_t j = 0; j < A.size(); ++j) {
    const Vec3& n = basis_->normals[j];
    const Vec3 stretched{body.a * n.x, body.b * n.y, body.c * n.z};
    const double curvature = body.a * body.b * body.c / dot(stretched, stretched);
    A[j] = basis_->solid_angles[j] * curvature * curvature;
  }
  return coefficients(A);
}

Vec3 GaussianImage::closure(std::span<const double> areas) const {
  require_count("areas", areas.size(), basis_->normals.size());
  Vec3 sum;
  for (std::size_t j = 0; j < areas.size(); ++j) sum = sum + areas[j] * basis_->normals[j];
  return sum;
}

std::vector<Vec3> GaussianImage::closure_gradient(std::span<const double> areas) const {
  require_count("areas", areas.size(), basis_->normals.size());
  std::vector<Vec3> by(basis_->count);
  for (std::size_t j = 0; j < areas.size(); ++j) {
    const std::span<const double> Y = harmonics(j);
    const Vec3 own = areas[j] * basis_->normals[j];
    for (std::size_t k = 0; k < Y.size(); ++k) by[k] = by[k] + Y[k] * own;
  }
  return by;
}

std::vector<double> GaussianImage::roughness() const {
  std::vector<double> out;
  for (int l = 0; l <= basis_->degree; ++l)
    out.insert(out.end(), 2 * static_cast<std::size_t>(l) + 1, l * (l + 1.0));
  return out;
}

std::vector<double> GaussianImage::by_coefficients(std::span<const double> by_areas,
                                                   std::span<const double> areas) const {
  require_count("areas", areas.size(), basis_->normals.size());
  require_count("derivatives", by_areas.size(), basis_->normals.size());
  std::vector<double> by(basis_->count);
  for (std::size_t j = 0; j < areas.size(); ++j) {
    const double own = by_areas[j] * areas[j];  // dA/dc = A Y
    if (own == 0.0) continue;
    const std::span<const double> Y = harmonics(j);
    for (std::size_t k = 0; k < Y.size(); ++k) by[k] += own * Y[k];
  }
  return by;
}

}  // namespace light
}  // namespace v0
}  // namespace polhode
