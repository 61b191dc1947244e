// SPDX-License-Identifier: MIT
#include "polhode/tables/obj.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::size_t largest_file = std::size_t{256} << 20;
constexpr std::size_t longest_path = 500;

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
  explicit Statements(std::string_view text) : rest_(text) {}

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

// A facet as it stands in the file: its triangles ask for vertices that may come later.
struct Corner {
  std::uint64_t vertex;  // from 0
  std::string_view text;
};
struct Fan {
  std::size_t line;
  std::size_t first;  // of `corners`
  std::size_t count;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : statements_(text), name_(name) {}

  FacetShape read() {
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
    if (fans_.empty()) throw DomainError(name_ + ": has no facets; expected a Wavefront OBJ file");
    std::vector<FacetShape::Triangle> all = triangles();
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
    fans_.push_back({statements_.line(), corners_.size(), fields.size() - 1});
    for (std::size_t i = 1; i < fields.size(); ++i) corners_.push_back(corner(fields[i]));
  }

  std::vector<FacetShape::Triangle> triangles() const {
    std::vector<FacetShape::Triangle> all;
    all.reserve(corners_.size() - 2 * fans_.size());
    for (const Fan& fan : fans_) {
      for (std::size_t k = 0; k < fan.count; ++k) {
        const Corner& c = corners_[fan.first + k];
        if (c.vertex >= vertices_.size())
          fail(fan.line, "got \"" + detail::printable(c.text) + "\"; there are " +
                             std::to_string(vertices_.size()) + " vertices");
      }
      for (std::size_t k = 1; k + 1 < fan.count; ++k) add_triangle(all, fan, k);
    }
    return all;
  }
  void add_triangle(std::vector<FacetShape::Triangle>& all, const Fan& fan, std::size_t k) const {
    const auto place = [&](std::size_t i) {
      return static_cast<std::uint32_t>(corners_[fan.first + i].vertex);
    };
    const FacetShape::Triangle t{place(0), place(k), place(k + 1)};
    const double area = facet(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]).area;
    if (!(area > 0.0) || !std::isfinite(area))
      fail(fan.line, std::string("a facet ") +
                         (area > 0.0 ? "beyond the range of double" : "with no area") +
                         (fan.count > 3 ? ", in the fan of this polygon" : "") + ": corners " +
                         std::to_string(std::uint64_t{t[0]} + 1) + ", " +
                         std::to_string(std::uint64_t{t[1]} + 1) + ", " +
                         std::to_string(std::uint64_t{t[2]} + 1));
    all.push_back(t);
  }

  Statements statements_;
  std::string name_;
  std::vector<Vec3> vertices_;
  std::vector<Corner> corners_;
  std::vector<Fan> fans_;
};

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

FacetShape shape_from_obj(std::string_view text, const std::string& name) {
  const std::string shown = detail::printable(name, longest_path);
  if (text.size() > largest_file)
    throw DomainError(shown + ": more than 256 MB; expected a smaller mesh");
  return ObjReader(text, shown).read();
}

std::string obj_text(const FacetShape& shape) {
  std::string text;
  for (const Vec3& v : shape.vertices())
    text += "v " + detail::number_text(v.x) + " " + detail::number_text(v.y) + " " +
            detail::number_text(v.z) + "\n";
  for (const FacetShape::Triangle& t : shape.triangles()) {
    text += "f";
    for (const std::uint32_t k : t) text += " " + std::to_string(std::uint64_t{k} + 1);
    text += "\n";
  }
  return text;
}

FacetShape read_obj(const std::string& path) {
  const std::string shown = detail::printable(path, longest_path);
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw DomainError(shown + ": is no plain file; expected a Wavefront OBJ file");
  errno = 0;
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw DomainError(shown + ": cannot be read: " + std::strerror(errno));
  std::string text;
  std::vector<char> block(std::size_t{1} << 20);
  while (text.size() <= largest_file) {
    const std::size_t count = std::fread(block.data(), 1, block.size(), file.get());
    if (count == 0) break;
    text.append(block.data(), count);
  }
  if (std::ferror(file.get()) != 0)
    throw DomainError(shown + ": cannot be read: " + std::strerror(errno));
  return shape_from_obj(text, path);
}

}  // namespace v0
}  // namespace polhode
