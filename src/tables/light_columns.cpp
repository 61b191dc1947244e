// SPDX-License-Identifier: MIT
#include "polhode/tables/light_columns.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/tables/number_table.hpp"
#include "tables/detail/light_sessions.hpp"
#include "tables/detail/light_times.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using Three = LightColumns::Three;

constexpr std::size_t longest_path = 4096;
constexpr std::size_t longest_note = 10000;

const Three csv_to_sun = {"sun_x", "sun_y", "sun_z"};
const Three csv_to_observer = {"observer_x", "observer_y", "observer_z"};

bool has_vectors(std::span<const LightCurve> curves) {
  return std::any_of(curves.begin(), curves.end(), [](const LightCurve& curve) {
    return std::any_of(curve.points.begin(), curve.points.end(), [](const LightPoint& p) {
      return p.to_sun != Vec3{} || p.to_observer != Vec3{};
    });
  });
}

[[noreturn]] void fail_to_write(const std::string& text) {
  throw DomainError("light_csv: " + text);
}

// What the columns cannot hold would come back as something else.
void require_writable(std::span<const LightCurve> curves) {
  if (curves.empty()) fail_to_write("there are no light curves; expected one or more");
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::string which = "light curve " + std::to_string(c + 1);
    const LightCurve& curve = curves[c];
    if (curve.points.empty()) fail_to_write(which + " has no points; expected one or more");
    if (curve.is_calibrated != curves[0].is_calibrated)
      fail_to_write(which + " is " + (curve.is_calibrated ? "calibrated" : "relative") +
                    ", light curve 1 is not; expected the same of all in one table");
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      const LightPoint& p = curve.points[k];
      for (const double x : {p.t, p.flux, p.sigma, p.to_sun.x, p.to_sun.y, p.to_sun.z,
                             p.to_observer.x, p.to_observer.y, p.to_observer.z})
        if (!std::isfinite(x))
          fail_to_write(which + ": point " + std::to_string(k + 1) + ": got " +
                        detail::number_text(x) + "; expected finite numbers");
    }
  }
}

// A table of the columns that are asked for, and where in it each of them is.
class ColumnReader {
 public:
  ColumnReader(const std::string& path, const LightColumns& columns)
      : path_(path), columns_(columns) {}

  LightCurveFile read() {
    require_sense();
    place(columns_.time);
    const std::size_t value = place(columns_.flux.empty() ? columns_.magnitude : columns_.flux);
    const std::optional<std::size_t> sigma = optional(columns_.sigma);
    const std::optional<std::size_t> session = optional(columns_.session);
    const std::optional<std::size_t> sun = optional(columns_.to_sun);
    const std::optional<std::size_t> observer = optional(columns_.to_observer);
    const NumberTable table = read_table();
    const auto vector = [&](std::optional<std::size_t> first, std::size_t row) {
      return first ? Vec3{table.columns[*first][row], table.columns[*first + 1][row],
                          table.columns[*first + 2][row]}
                   : Vec3{};
    };
    for (std::size_t row = 0; row < table.rows(); ++row) {
      LightSession& to = session_of(session ? table.columns[*session][row] : 0.0,
                                    session.has_value(), table.lines[row]);
      const double x = table.columns[value][row];
      if (const std::string flaw = detail::magnitude_flaw(x);
          columns_.flux.empty() && !flaw.empty())
        throw DomainError(table.file + ":" + std::to_string(table.lines[row]) + ": " + flaw);
      to.curve.points.push_back({table.columns[0][row], x,
                                 sigma ? table.columns[*sigma][row] : columns_.one_sigma,
                                 vector(sun, row), vector(observer, row)});
      to.lines.push_back(table.lines[row]);
    }
    return finished();
  }

 private:
  [[noreturn]] void fail(const std::string& text) const {
    throw DomainError(detail::printable(path_, longest_path) + ": " + text);
  }

  void require_sense() const {
    if (columns_.time.empty()) fail("no column of times is named; expected one");
    if (columns_.flux.empty() == columns_.magnitude.empty())
      fail(std::string(columns_.flux.empty() ? "neither" : "both") +
           " a column of fluxes and one of magnitudes named; expected one of them");
    if (!columns_.sigma.empty() && columns_.one_sigma != 0.0)
      fail("a column of errors and one error of all points; expected one of them");
    for (const Three* three : {&columns_.to_sun, &columns_.to_observer}) {
      const auto named = std::count_if(three->begin(), three->end(),
                                       [](const std::string& name) { return !name.empty(); });
      if (named != 0 && named != 3)
        fail(std::to_string(named) + " columns of a vector to the " +
             (three == &columns_.to_sun ? "Sun" : "observer") + "; expected three or none");
    }
  }

  std::size_t place(const std::string& column) {
    names_.push_back(column);
    return names_.size() - 1;
  }
  std::optional<std::size_t> optional(const std::string& column) {
    if (column.empty()) return std::nullopt;
    return place(column);
  }
  // The place of the first of them.
  std::optional<std::size_t> optional(const Three& three) {
    if (three[0].empty()) return std::nullopt;
    const std::size_t first = place(three[0]);
    place(three[1]);
    place(three[2]);
    return first;
  }

  NumberTable read_table() {
    result_.file = detail::printable(path_, longest_path);
    if (columns_.form == LightColumns::Times::numbers) return read_number_table(path_, names_);
    std::optional<detail::LightTimes> times;
    try {
      times.emplace(columns_.scale, columns_.epoch, columns_.julian_zero);
    } catch (const DomainError& error) {
      fail(error.what());
    }
    const bool julian = columns_.form == LightColumns::Times::julian_dates;
    NumberTable table = read_number_table(path_, names_, [&](std::string_view field) {
      return julian ? times->of_julian_date(field) : times->of_date(field);
    });
    result_.epoch = times->epoch();
    return table;
  }

  LightSession& session_of(double number, bool is_named, std::size_t line) {
    const auto [found, is_new] = places_.emplace(number, result_.sessions.size());
    if (is_new) {
      LightSession session;
      if (is_named) session.curve.name = detail::number_text(number);
      session.curve.is_calibrated = columns_.is_calibrated;
      session.times = columns_.times;
      session.distances = columns_.distances;
      session.band = columns_.band;
      session.line = line;
      result_.sessions.push_back(std::move(session));
    }
    return result_.sessions[found->second];
  }

  LightCurveFile finished() {
    if (result_.sessions.empty()) fail("has no rows; expected points of a light curve");
    if (columns_.flux.empty())
      for (LightSession& session : result_.sessions) detail::take_magnitudes(session);
    result_.axes = columns_.axes;
    result_.length = columns_.length;
    return std::move(result_);
  }

  const std::string& path_;
  const LightColumns& columns_;
  std::vector<std::string> names_;
  std::map<double, std::size_t> places_;
  LightCurveFile result_;
};

}  // namespace

LightCurveFile read_light_columns(const std::string& path, const LightColumns& columns) {
  return ColumnReader(path, columns).read();
}

std::string light_csv(std::span<const LightCurve> curves, std::span<const std::string> notes) {
  require_writable(curves);
  std::string text;
  for (const std::string& note : notes) text += "# " + detail::printable(note, longest_note) + "\n";
  for (std::size_t c = 0; c < curves.size(); ++c)
    text += "# session " + std::to_string(c + 1) + ": " +
            (curves[c].name.empty() ? "" : detail::printable(curves[c].name, longest_note) + ", ") +
            (curves[c].is_calibrated ? "calibrated\n" : "relative\n");
  const bool vectors = has_vectors(curves);
  text += "session,t,flux,sigma";
  if (vectors)
    for (const Three* three : {&csv_to_sun, &csv_to_observer})
      for (const std::string& name : *three) text += "," + name;
  text += "\n";
  const auto add = [&](double x) { text += "," + detail::number_text(x); };
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (const LightPoint& p : curves[c].points) {
      text += std::to_string(c + 1);
      for (const double x : {p.t, p.flux, p.sigma}) add(x);
      if (vectors)
        for (const Vec3& v : {p.to_sun, p.to_observer})
          for (int i = 0; i < 3; ++i) add(v[i]);
      text += "\n";
    }
  return text;
}

LightColumns light_csv_columns(bool has_vectors, bool is_calibrated) {
  LightColumns columns;
  columns.is_calibrated = is_calibrated;
  columns.flux = "flux";
  columns.sigma = "sigma";
  columns.session = "session";
  if (has_vectors) {
    columns.to_sun = csv_to_sun;
    columns.to_observer = csv_to_observer;
  }
  return columns;
}

}  // namespace v0
}  // namespace polhode
