// SPDX-License-Identifier: MIT
#include "polhode/tables/obj.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "tables/detail/gzip_file.hpp"
#include "tables/detail/trimmed.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr std::size_t largest_mesh = std::size_t{256} << 20;
constexpr std::size_t most_corners = 4096;  // of a face that is no fan about its first
constexpr double rounding = 4.0 * 0x1p-52;  // of a coordinate, with those of a few differences
constexpr double largest_coordinate = 1e75;
constexpr double flatness = 0.1;  // of the size of a face

// Statements of OBJ that say nothing about the shape of the facets.
constexpr std::string_view skipped[] = {
    "vt",     "vn",     "vp",       "o",        "g",          "s",         "mg",    "l",    "p",
    "usemtl", "mtllib", "usemap",   "maplib",   "shadow_obj", "trace_obj", "bevel", "lod",  "end",
    "cstype", "deg",    "bmat",     "step",     "curv",       "curv2",     "surf",  "parm", "trim",
    "hole",   "scrv",   "c_interp", "d_interp", "sp",         "con",       "ctech", "stech"};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

// The fields of one statement after another, with the line on which it begins.
class Statements {
 public:
  explicit Statements(std::string_view text) : rest_(detail::without_mark(text)) {}

  bool next(std::vector<std::string_view>& fields) {
    fields.clear();
    while (fields.empty() && !rest_.empty()) {
      line_ = next_line_;
      bool goes_on = true;
      while (goes_on && !rest_.empty()) goes_on = split(fields);
    }
    return !fields.empty();
  }
  std::size_t line() const { return line_; }

 private:
  // One line of the file; whether the next continues it.
  bool split(std::vector<std::string_view>& fields) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++next_line_;
    line = line.substr(0, line.find('#'));
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    const bool goes_on = !line.empty() && line.back() == '\\';
    if (goes_on) line.remove_suffix(1);
    for (std::size_t i = 0; i < line.size();) {
      std::size_t stop = i;
      while (stop < line.size() && !is_blank(line[stop])) ++stop;
      if (stop > i) fields.push_back(line.substr(i, stop - i));
      i = stop + 1;
    }
    return goes_on;
  }

  std::string_view rest_;
  std::size_t line_ = 0;
  std::size_t next_line_ = 1;
};

// A face as it stands in the file: its triangles ask for vertices that may come later.
struct Corner {
  std::uint64_t vertex;  // from 0
  std::string_view text;
};
struct Face {
  std::size_t line;
  std::size_t first;  // of `corners`
  std::size_t count;
};

// A polygon seen along the axis nearest to its normal, where it runs counterclockwise. Coordinates
// are those of the file, so that corners on one line stay there.
class FlatPolygon {
 public:
  // Corners of a triangle, by their places in the polygon.
  using Ear = std::array<std::size_t, 3>;

  explicit FlatPolygon(const std::vector<Vec3>& corners);

  bool has_area() const { return has_area_; }
  // The corner that is farthest from the mean plane, beyond `most` of the size of the polygon.
  std::optional<std::size_t> corner_off_plane(double most) const;
  // The triangles about its first corner, where they fill it without overlap.
  bool is_fan() const;
  // Places of two edges that cross or touch, each named by its first corner.
  std::optional<std::pair<std::size_t, std::size_t>> crossing() const;
  // The triangles that are left when corners are cut off one by one; empty where none can be.
  std::vector<Ear> ears() const;

 private:
  struct Point {
    double x, y;
  };
  std::size_t after(std::size_t i) const { return i + 1 < points_.size() ? i + 1 : 0; }
  int turn(std::size_t a, std::size_t b, std::size_t c) const;
  bool is_between(std::size_t a, std::size_t b, std::size_t c) const;
  bool meet(std::size_t i, std::size_t k) const;
  bool is_ear(const std::vector<std::size_t>& left, std::size_t at) const;

  const std::vector<Vec3>& corners_;
  Vec3 normal_;
  std::vector<Point> points_;
  double largest_ = 0.0;  // coordinate
  bool has_area_ = false;
};

FlatPolygon::FlatPolygon(const std::vector<Vec3>& corners) : corners_(corners), normal_{} {
  const Vec3& o = corners.front();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal_ = normal_ + cross(corners[i] - o, corners[i + 1] - o);
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::fabs(normal_[i]) > std::fabs(normal_[axis])) axis = i;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const bool mirrored = normal_[axis] < 0.0;
  double perimeter = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& c = corners[i];
    points_.push_back(mirrored ? Point{c[v], c[u]} : Point{c[u], c[v]});
    largest_ = std::max({largest_, std::fabs(c[u]), std::fabs(c[v])});
    perimeter += norm(corners[i + 1 < corners.size() ? i + 1 : 0] - c);
  }
  has_area_ = std::fabs(normal_[axis]) > rounding * largest_ * perimeter;
}

std::optional<std::size_t> FlatPolygon::corner_off_plane(double most) const {
  Vec3 mean{}, low = corners_.front(), high = low;
  for (const Vec3& c : corners_) {
    mean = mean + (1.0 / static_cast<double>(corners_.size())) * c;
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], c[i]);
      high[i] = std::max(high[i], c[i]);
    }
  }
  std::size_t farthest = 0;
  double distance = 0.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const double d = std::fabs(dot(corners_[i] - mean, normal_)) / norm(normal_);
    if (d > distance) distance = d, farthest = i;
  }
  if (distance <= most * norm(high - low)) return std::nullopt;
  return farthest;
}

// 1 for a turn to the left at b, -1 to the right, 0 where the three are on one line to the rounding
// of their coordinates.
int FlatPolygon::turn(std::size_t a, std::size_t b, std::size_t c) const {
  const Point &p = points_[a], &q = points_[b], &r = points_[c];
  const double qx = q.x - p.x, qy = q.y - p.y, rx = r.x - p.x, ry = r.y - p.y;
  const double twice_area = qx * ry - qy * rx;
  const double bound =
      rounding * largest_ * (std::fabs(qx) + std::fabs(qy) + std::fabs(rx) + std::fabs(ry));
  return twice_area > bound ? 1 : twice_area < -bound ? -1 : 0;
}

// Of three on one line: c lies on the segment from a to b, its ends included.
bool FlatPolygon::is_between(std::size_t a, std::size_t b, std::size_t c) const {
  const Point &p = points_[a], &q = points_[b], &r = points_[c];
  return std::min(p.x, q.x) <= r.x && r.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= r.y &&
         r.y <= std::max(p.y, q.y);
}

// Two edges without a common corner.
bool FlatPolygon::meet(std::size_t i, std::size_t k) const {
  const std::size_t j = after(i), l = after(k);
  const int a = turn(i, j, k), b = turn(i, j, l), c = turn(k, l, i), d = turn(k, l, j);
  if (a * b < 0 && c * d < 0) return true;
  return (a == 0 && is_between(i, j, k)) || (b == 0 && is_between(i, j, l)) ||
         (c == 0 && is_between(k, l, i)) || (d == 0 && is_between(k, l, j));
}

std::optional<std::pair<std::size_t, std::size_t>> FlatPolygon::crossing() const {
  const std::size_t count = points_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = after(i), k = after(j);
    // an edge that runs back over the one before it
    if (turn(i, j, k) == 0 && (is_between(i, j, k) || is_between(j, k, i))) return std::pair(i, j);
    for (std::size_t other = i + 2; other < count; ++other)
      if (after(other) != i && meet(i, other)) return std::pair(i, other);
  }
  return std::nullopt;
}

bool FlatPolygon::is_fan() const {
  constexpr double round = 2.0 * std::numbers::pi - 1e-6;
  double angle = 0.0;
  const Point& o = points_.front();
  for (std::size_t k = 1; k + 1 < points_.size(); ++k) {
    if (turn(0, k, k + 1) <= 0) return false;
    const Point &p = points_[k], &q = points_[k + 1];
    const double px = p.x - o.x, py = p.y - o.y, qx = q.x - o.x, qy = q.y - o.y;
    angle += std::atan2(px * qy - py * qx, px * qx + py * qy);
  }
  return angle < round;
}

// The corner at a place of those left turns left, and no other corner is in its triangle or on its
// border.
bool FlatPolygon::is_ear(const std::vector<std::size_t>& left, std::size_t at) const {
  const std::size_t count = left.size();
  const std::size_t a = left[(at + count - 1) % count], b = left[at], c = left[(at + 1) % count];
  if (turn(a, b, c) <= 0) return false;
  return std::none_of(left.begin(), left.end(), [&](std::size_t p) {
    return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
           turn(c, a, p) >= 0;
  });
}

std::vector<FlatPolygon::Ear> FlatPolygon::ears() const {
  std::vector<Ear> all;
  std::vector<std::size_t> left(points_.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::size_t at = 0;
  while (left.size() > 3) {
    const std::size_t count = left.size();
    std::size_t tried = 0;
    while (tried < count && !is_ear(left, at % count)) ++at, ++tried;
    if (tried == count) return {};
    at %= count;
    all.push_back({left[(at + count - 1) % count], left[at], left[(at + 1) % count]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  all.push_back({left[0], left[1], left[2]});
  return all;
}

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : statements_(text), name_(name) {}

  shape::FacetShape read() {
    std::vector<std::string_view> fields;
    while (statements_.next(fields)) {
      const std::string_view word = fields.front();
      if (word == "v") {
        add_vertex(fields);
      } else if (word == "f") {
        add_facet(fields);
      } else if (std::find(std::begin(skipped), std::end(skipped), word) == std::end(skipped)) {
        fail(statements_.line(), "got \"" + detail::printable(word) +
                                     "\"; expected a statement of OBJ, such as v or f");
      }
    }
    if (faces_.empty()) throw DomainError(name_ + ": has no facets; expected a Wavefront OBJ file");
    std::vector<shape::FacetShape::Triangle> all = triangles();
    return {std::move(vertices_), std::move(all)};
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& text) const {
    throw DomainError(name_ + ":" + std::to_string(line) + ": " + text);
  }

  double coordinate(std::string_view field) const {
    std::string_view digits = field;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double x = 0.0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    const std::string got = "got \"" + detail::printable(field) + "\"; ";
    if (error == std::errc::result_out_of_range)
      fail(statements_.line(), got + "expected a number in the range of double");
    if (error != std::errc() || stop != digits.data() + digits.size())
      fail(statements_.line(), got + "expected a number");
    if (!std::isfinite(x)) fail(statements_.line(), got + "expected a finite number");
    return x;
  }

  // x y z, then perhaps a weight or a colour.
  void add_vertex(const std::vector<std::string_view>& fields) {
    if (fields.size() < 4 || fields.size() > 8)
      fail(statements_.line(),
           "got " + std::to_string(fields.size() - 1) + " numbers; expected v x y z");
    for (std::size_t i = 4; i < fields.size(); ++i) coordinate(fields[i]);
    vertices_.push_back({coordinate(fields[1]), coordinate(fields[2]), coordinate(fields[3])});
  }

  // An index of OBJ: from 1, or from -1 backwards among the `count` there are so far.
  std::int64_t index(std::string_view field, std::string_view part) const {
    std::int64_t i = 0;
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), i);
    if (error != std::errc() || stop != part.data() + part.size() || part.empty() || i == 0)
      fail(statements_.line(), "got \"" + detail::printable(field) +
                                   "\"; expected the number of a vertex, from 1 or from -1 down");
    return i;
  }

  Corner corner(std::string_view field) const {
    const std::size_t slash = std::min(field.find('/'), field.size());
    const std::int64_t i = index(field, field.substr(0, slash));
    std::string_view rest = field.substr(std::min(slash + 1, field.size()));
    for (int part = 0; part < 2 && !rest.empty(); ++part) {  // texture and normal: only checked
      const std::size_t end = std::min(rest.find('/'), rest.size());
      if (end > 0) index(field, rest.substr(0, end));
      rest = rest.substr(std::min(end + 1, rest.size()));
    }
    const auto known = static_cast<std::int64_t>(vertices_.size());
    if (i < -known || !rest.empty())
      fail(statements_.line(),
           "got \"" + detail::printable(field) +
               (rest.empty() ? "\"; there are only " + std::to_string(known) + " vertices before it"
                             : "\"; expected i, i/t, i//n or i/t/n"));
    return {static_cast<std::uint64_t>(i > 0 ? i - 1 : known + i), field};
  }

  void add_facet(const std::vector<std::string_view>& fields) {
    if (fields.size() < 4)
      fail(statements_.line(),
           "got a facet of " + std::to_string(fields.size() - 1) + " corners; expected at least 3");
    faces_.push_back({statements_.line(), corners_.size(), fields.size() - 1});
    for (std::size_t i = 1; i < fields.size(); ++i) corners_.push_back(corner(fields[i]));
  }

  std::vector<shape::FacetShape::Triangle> triangles() const {
    std::vector<shape::FacetShape::Triangle> all;
    all.reserve(corners_.size() - 2 * faces_.size());
    for (const Face& face : faces_) {
      for (std::size_t k = 0; k < face.count; ++k) {
        const Corner& c = corners_[face.first + k];
        if (c.vertex >= vertices_.size())
          fail(face.line, "got \"" + detail::printable(c.text) + "\"; there are " +
                              std::to_string(vertices_.size()) + " vertices");
      }
      for (const FlatPolygon::Ear& ear : ears_of(face)) add_triangle(all, face, ear);
    }
    return all;
  }

  // A fan about the first corner where that is right.
  std::vector<FlatPolygon::Ear> ears_of(const Face& face) const {
    std::vector<FlatPolygon::Ear> fan;
    for (std::size_t k = 1; k + 1 < face.count; ++k) fan.push_back({0, k, k + 1});
    if (face.count == 3) return fan;
    std::vector<Vec3> corners;
    for (std::size_t k = 0; k < face.count; ++k) {
      corners.push_back(vertices_[corners_[face.first + k].vertex]);
      const Vec3& c = corners.back();
      // the constructor of the shape rejects it by name
      if (!(std::max({std::fabs(c.x), std::fabs(c.y), std::fabs(c.z)}) < largest_coordinate))
        return fan;
    }
    const FlatPolygon polygon(corners);
    const auto name = [&](std::size_t k) {
      return std::to_string(corners_[face.first + (k < face.count ? k : 0)].vertex + 1);
    };
    if (!polygon.has_area())
      fail(face.line, "a face with no area, or one that crosses itself: " + first_corners(face));
    if (const std::optional<std::size_t> off = polygon.corner_off_plane(flatness))
      fail(face.line, "a face that is not flat: vertex " + name(*off) +
                          " is farther from its plane than a tenth of its size; expected "
                          "triangles in its place");
    if (polygon.is_fan()) return fan;
    if (face.count > most_corners)
      fail(face.line, "a concave face of " + std::to_string(face.count) +
                          " corners; expected at most " + std::to_string(most_corners));
    if (const auto crossing = polygon.crossing())
      fail(face.line, "a face that crosses or touches itself: edges " + name(crossing->first) +
                          " to " + name(crossing->first + 1) + " and " + name(crossing->second) +
                          " to " + name(crossing->second + 1));
    std::vector<FlatPolygon::Ear> ears = polygon.ears();
    if (ears.empty())
      fail(face.line, "a face too thin to be cut into triangles: " + first_corners(face));
    return ears;
  }

  // "corners 1, 2, 3, ..."
  std::string first_corners(const Face& face) const {
    constexpr std::size_t most = 8;
    std::string text = "corners ";
    for (std::size_t k = 0; k < std::min(face.count, most); ++k)
      text += (k == 0 ? "" : ", ") + std::to_string(corners_[face.first + k].vertex + 1);
    return text + (face.count > most ? ", ..." : "");
  }

  void add_triangle(std::vector<shape::FacetShape::Triangle>& all, const Face& face,
                    const FlatPolygon::Ear& ear) const {
    const auto place = [&](std::size_t i) {
      return static_cast<std::uint32_t>(corners_[face.first + i].vertex);
    };
    const shape::FacetShape::Triangle t{place(ear[0]), place(ear[1]), place(ear[2])};
    const double area = shape::facet(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]).area;
    if (!(area > 0.0) || !std::isfinite(area))
      fail(face.line, std::string("a facet ") +
                          (area > 0.0 ? "beyond the range of double" : "with no area") +
                          (face.count > 3 ? ", in a triangle of this polygon" : "") + ": corners " +
                          std::to_string(std::uint64_t{t[0]} + 1) + ", " +
                          std::to_string(std::uint64_t{t[1]} + 1) + ", " +
                          std::to_string(std::uint64_t{t[2]} + 1));
    all.push_back(t);
  }

  Statements statements_;
  std::string name_;
  std::vector<Vec3> vertices_;
  std::vector<Corner> corners_;
  std::vector<Face> faces_;
};

}  // namespace

shape::FacetShape shape_from_obj(std::string_view text, const std::string& name) {
  const std::string shown = detail::printable(name, detail::longest_path);
  if (text.size() > largest_mesh)
    throw DomainError(shown + ": more than 256 MB; expected a smaller mesh");
  return ObjReader(text, shown).read();
}

std::string obj_text(const shape::FacetShape& shape) {
  std::string text;
  for (const Vec3& v : shape.vertices())
    text += "v " + polhode::detail::number_text(v.x) + " " + polhode::detail::number_text(v.y) +
            " " + polhode::detail::number_text(v.z) + "\n";
  for (const shape::FacetShape::Triangle& t : shape.triangles()) {
    text += "f";
    for (const std::uint32_t k : t) text += " " + std::to_string(std::uint64_t{k} + 1);
    text += "\n";
  }
  return text;
}

shape::FacetShape read_obj(const std::string& path) {
  return shape_from_obj(detail::text_of_file(path, largest_mesh), path);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
