// SPDX-License-Identifier: MIT
// Light curves in the lc format of DAMIT.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "tables/detail/gzip_file.hpp"
#include "tables/detail/kvn_reader.hpp"
#include "tables/detail/light_sessions.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::KvnLine;
using Fields = std::vector<std::string_view>;

constexpr std::size_t point_fields = 8;

class LcReader {
 public:
  LcReader(std::string_view text, const std::string& shown, ephemeris::TimeScale scale,
           const std::optional<ephemeris::Date>& epoch, std::span<const std::size_t> leave_out)
      : lines_(text, shown),
        times_(detail::light_times(shown, scale, epoch)),
        leave_out_(leave_out) {
    result_.file = shown;
  }

  LightCurveFile read() {
    const std::string what = "the number of light curves";
    const Fields first = fields(next_line(what), what);
    if (first.size() != 1) refuse(first, "the number of light curves alone in the first line");
    const std::uint64_t count = number_of(first[0], "light curves");
    for (std::uint64_t k = 1; k <= count; ++k) read_session(k, count);
    if (lines_.next())
      lines_.fail("there is more after the last of " + std::to_string(count) +
                  " light curves; expected as many as the first line says");
    result_.epoch = times_.epoch();
    result_.axes = "ecliptic-J2000";
    result_.length = "au";
    return std::move(result_);
  }

 private:
  KvnLine next_line(const std::string& what) {
    const std::optional<KvnLine> line = lines_.next();
    if (!line) lines_.fail("the file ends before " + what);
    return *line;
  }
  Fields fields(const KvnLine& line, const std::string& what) const {
    if (line.kind != KvnLine::Kind::data)
      lines_.fail("got \"" + detail::printable(line.key) + "\"; expected " + what);
    return lines_.fields(line);
  }
  [[noreturn]] void refuse(const Fields& got, const std::string& expected) const {
    lines_.fail("got " + std::to_string(got.size()) + " fields; expected " + expected);
  }

  std::uint64_t number_of(std::string_view field, const std::string& what) const {
    std::uint64_t count = 0;
    const char* const end = field.data() + field.size();
    const auto [stop, error] = std::from_chars(field.data(), end, count);
    if (error != std::errc() || stop != end || count == 0)
      lines_.fail("got \"" + detail::printable(field) + "\"; expected the number of " + what +
                  ", 1 or more");
    return count;
  }

  void read_session(std::uint64_t place, std::uint64_t count) {
    const std::string which =
        "light curve " + std::to_string(place) + " of " + std::to_string(count);
    const Fields head = fields(next_line(which), which);
    if (head.size() != 2)
      refuse(head,
             "two to begin " + which + ": how many points, and 0 (relative) or 1 (calibrated)");
    const std::uint64_t points = number_of(head[0], "points of " + which);
    if (head[1] != "0" && head[1] != "1")
      lines_.fail("got \"" + detail::printable(head[1]) +
                  "\"; expected 0 (relative) or 1 (calibrated) behind the number of points");
    LightSession session;
    session.curve.name = std::to_string(place);
    session.curve.is_calibrated = head[1] == "1";
    session.times = light::LightTime::at_body;
    if (session.curve.is_calibrated) session.distances = Distances::unit;
    session.line = lines_.line_number();
    for (std::uint64_t k = 1; k <= points; ++k)
      read_point(session,
                 "point " + std::to_string(k) + " of " + std::to_string(points) + " of " + which);
    result_.sessions.push_back(std::move(session));
  }

  void read_point(LightSession& session, const std::string& which) {
    const KvnLine line = next_line(which);
    if (std::ranges::find(leave_out_, lines_.line_number()) != leave_out_.end()) {
      session.left_out.push_back(lines_.line_number());
      return;
    }
    const Fields row = fields(line, which);
    if (row.size() != point_fields)
      refuse(row, "8 in " + which +
                      ": Julian date, flux, x y z from the body to the Sun, x y z to the Earth");
    light::LightPoint p;
    try {
      p.t = times_.of_julian_date(row[0]);
    } catch (const DomainError& error) {
      lines_.fail("\"" + detail::printable(row[0]) + "\" " + error.what());
    }
    p.flux = lines_.number(row[1], "flux");
    p.to_sun = vector(row, 2, "Sun");
    p.to_observer = vector(row, 5, "Earth");
    session.curve.points.push_back(p);
    session.lines.push_back(lines_.line_number());
  }
  Vec3 vector(const Fields& row, std::size_t first, const std::string& to) const {
    const std::string what = "vector to the " + to;
    const Vec3 v{lines_.number(row[first], what), lines_.number(row[first + 1], what),
                 lines_.number(row[first + 2], what)};
    if (v == Vec3{}) lines_.fail("the " + what + " is 0; expected one in au");
    return v;
  }

  detail::KvnReader lines_;
  detail::LightTimes times_;
  std::span<const std::size_t> leave_out_;
  LightCurveFile result_;
};

[[noreturn]] void fail_to_write(std::size_t curve, std::size_t point, const char* what) {
  throw DomainError("lc_text: light curve " + std::to_string(curve + 1) + ": point " +
                    std::to_string(point + 1) + ": " + what);
}

bool is_vector(const Vec3& v) { return v != Vec3{} && std::isfinite(v.x + v.y + v.z); }

}  // namespace

LightCurveFile lc_from_text(std::string_view text, const std::string& name,
                            ephemeris::TimeScale scale, const std::optional<ephemeris::Date>& epoch,
                            std::span<const std::size_t> leave_out) {
  const std::string shown = detail::printable(name, detail::longest_path);
  detail::require_size(text, shown);
  return LcReader(text, shown, scale, epoch, leave_out).read();
}

LightCurveFile read_lc(const std::string& path, ephemeris::TimeScale scale,
                       const std::optional<ephemeris::Date>& epoch,
                       std::span<const std::size_t> leave_out) {
  return lc_from_text(detail::text_of_file(path, detail::largest_light_file), path, scale, epoch,
                      leave_out);
}

std::string lc_text(std::span<const light::LightCurve> curves, const ephemeris::Date& epoch) {
  if (curves.empty()) throw DomainError("lc_text: there are no light curves; expected one or more");
  std::string text = std::to_string(curves.size()) + "\n";
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::vector<light::LightPoint>& points = curves[c].points;
    if (points.empty())
      throw DomainError("lc_text: light curve " + std::to_string(c + 1) +
                        " has no points; expected one or more");
    text += std::to_string(points.size()) + (curves[c].is_calibrated ? " 1\n" : " 0\n");
    for (std::size_t k = 0; k < points.size(); ++k) {
      const light::LightPoint& p = points[k];
      if (!std::isfinite(p.t) || !std::isfinite(p.flux))
        fail_to_write(c, k, "its time or flux is not finite");
      if (!is_vector(p.to_sun) || !is_vector(p.to_observer))
        fail_to_write(c, k, "expected its vectors to the Sun and to the observer, in au");
      text +=
          detail::julian_text(ephemeris::converted(ephemeris::date_after(epoch, p.t), epoch.scale));
      for (const double x : {p.flux, p.to_sun.x, p.to_sun.y, p.to_sun.z, p.to_observer.x,
                             p.to_observer.y, p.to_observer.z})
        text += " " + polhode::detail::number_text(x);
      text += "\n";
    }
  }
  return text;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
