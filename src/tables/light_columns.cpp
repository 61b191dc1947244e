// SPDX-License-Identifier: MIT
// Light curves as columns of a table.
#include <algorithm>
#include <cmath>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "tables/detail/light_sessions.hpp"
#include "tables/number_table.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using Three = LightColumns::Three;

constexpr std::size_t longest_note = 10000;

const Three csv_to_sun = {"sun_x", "sun_y", "sun_z"};
const Three csv_to_observer = {"observer_x", "observer_y", "observer_z"};

bool has_vectors(std::span<const light::LightCurve> curves) {
  return std::any_of(curves.begin(), curves.end(), [](const light::LightCurve& curve) {
    return std::any_of(curve.points.begin(), curve.points.end(), [](const light::LightPoint& p) {
      return p.to_sun != Vec3{} || p.to_observer != Vec3{};
    });
  });
}

[[noreturn]] void fail_to_write(const std::string& text) {
  throw DomainError("light_csv: " + text);
}

// What the columns cannot hold would come back as something else.
void require_writable(std::span<const light::LightCurve> curves) {
  if (curves.empty()) fail_to_write("there are no light curves; expected one or more");
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::string which = "light curve " + std::to_string(c + 1);
    const light::LightCurve& curve = curves[c];
    if (curve.points.empty()) fail_to_write(which + " has no points; expected one or more");
    if (curve.is_calibrated != curves[0].is_calibrated)
      fail_to_write(which + " is " + (curve.is_calibrated ? "calibrated" : "relative") +
                    ", light curve 1 is not; expected the same of all in one table");
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      const light::LightPoint& p = curve.points[k];
      for (const double x : {p.t, p.flux, p.sigma, p.to_sun.x, p.to_sun.y, p.to_sun.z,
                             p.to_observer.x, p.to_observer.y, p.to_observer.z})
        if (!std::isfinite(x))
          fail_to_write(which + ": point " + std::to_string(k + 1) + ": got " +
                        polhode::detail::number_text(x) + "; expected finite numbers");
    }
  }
}

// In place of a flux, in the same members.
light::Flux magnitude_in_place(std::size_t curve, const light::Flux& flux) {
  const light::Magnitude m = light::magnitude_of(flux);
  if (!std::isfinite(m.value))
    fail_to_write("light curve " + std::to_string(curve + 1) + " has the flux " +
                  polhode::detail::number_text(flux.value) +
                  ", which has no magnitude; expected less noise");
  return {m.value, m.sigma};
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
    const NumberTable table = read_table(sigma, session);
    const auto vector = [&](std::optional<std::size_t> first, std::size_t row) {
      return first ? Vec3{table.columns[*first][row], table.columns[*first + 1][row],
                          table.columns[*first + 2][row]}
                   : Vec3{};
    };
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const double place = session ? table.columns[*session][row] : 0.0;
      LightSession& to = session_of(
          std::isnan(place) ? last_session() : static_cast<std::size_t>(place), table.lines[row]);
      if (std::ranges::find(columns_.leave_out, table.lines[row]) != columns_.leave_out.end()) {
        to.left_out.push_back(table.lines[row]);
        continue;
      }
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
    throw DomainError(detail::printable(path_, detail::longest_name) + ": " + text);
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

  // Of sessions the place of the name, of errors that are left empty 0: require_sound names them.
  NumberTable read_table(std::optional<std::size_t> sigma, std::optional<std::size_t> session) {
    result_.file = detail::printable(path_, detail::longest_name);
    std::vector<FieldReader> readers(names_.size(), number_from_field);
    if (sigma)
      readers[*sigma] = [](std::string_view field) {
        return field.empty() ? 0.0 : number_from_field(field);
      };
    if (session)
      readers[*session] = [this](std::string_view field) {
        return static_cast<double>(place_of_session(field));
      };
    if (columns_.form == LightColumns::Times::numbers)
      return read_number_table(path_, names_, readers, columns_.leave_out);
    std::optional<detail::LightTimes> times;
    try {
      times.emplace(columns_.scale, columns_.epoch, columns_.julian_zero);
    } catch (const DomainError& error) {
      fail(error.what());
    }
    const bool julian = columns_.form == LightColumns::Times::julian_dates;
    readers.front() = [&](std::string_view field) {
      return julian ? times->of_julian_date(field) : times->of_date(field);
    };
    NumberTable table = read_number_table(path_, names_, readers, columns_.leave_out);
    result_.epoch = times->epoch();
    return table;
  }

  // Names of sessions are text; numbers are the same however they are written.
  std::size_t place_of_session(std::string_view field) {
    std::string name(field);
    try {
      name = polhode::detail::number_text(number_from_field(field));
    } catch (const DomainError&) {
      if (name.empty()) throw DomainError("is empty; expected the name of a session");
    }
    const auto found = std::ranges::find(session_names_, name);
    if (found != session_names_.end())
      return static_cast<std::size_t>(found - session_names_.begin());
    session_names_.push_back(std::move(name));
    return session_names_.size() - 1;
  }

  // The session of a row that is left out, if its name cannot be read.
  std::size_t last_session() const {
    return result_.sessions.empty() ? 0 : result_.sessions.size() - 1;
  }

  LightSession& session_of(std::size_t place, std::size_t line) {
    if (place == result_.sessions.size()) {
      LightSession session;
      if (!session_names_.empty())
        session.curve.name = detail::printable(session_names_[place], longest_note);
      session.curve.is_calibrated = columns_.is_calibrated;
      session.times = columns_.times;
      session.distances = columns_.distances;
      session.band = columns_.band;
      session.line = line;
      result_.sessions.push_back(std::move(session));
    }
    return result_.sessions[place];
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
  std::vector<std::string> session_names_;  // in the order in which they come
  LightCurveFile result_;
};

}  // namespace

LightCurveFile read_light_columns(const std::string& path, const LightColumns& columns) {
  return ColumnReader(path, columns).read();
}

std::string light_csv(std::span<const light::LightCurve> curves,
                      std::span<const std::string> notes) {
  return light_csv(curves, notes, light_csv_columns(has_vectors(curves)),
                   [](double t) { return polhode::detail::number_text(t); });
}

std::string light_csv(std::span<const light::LightCurve> curves, std::span<const std::string> notes,
                      const LightColumns& columns,
                      const std::function<std::string(double t)>& time_text) {
  require_writable(curves);
  std::string text;
  for (const std::string& note : notes) text += "# " + detail::printable(note, longest_note) + "\n";
  for (std::size_t c = 0; c < curves.size(); ++c)
    text += "# session " + std::to_string(c + 1) + ": " +
            (curves[c].name.empty() ? "" : detail::printable(curves[c].name, longest_note) + ", ") +
            (curves[c].is_calibrated ? "calibrated\n" : "relative\n");
  std::string row;
  const auto add = [&](const std::string& column, const std::string& field) {
    if (!column.empty()) row += (row.empty() ? "" : ",") + field;
  };
  const auto end_row = [&] {
    text += row + "\n";
    row.clear();
  };
  const std::string& value = columns.flux.empty() ? columns.magnitude : columns.flux;
  for (const std::string* name : {&columns.session, &columns.time, &value, &columns.sigma})
    add(*name, *name);
  for (const Three* three : {&columns.to_sun, &columns.to_observer})
    for (const std::string& name : *three) add(name, name);
  end_row();
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (const light::LightPoint& p : curves[c].points) {
      add(columns.session, std::to_string(c + 1));
      add(columns.time, time_text(p.t));
      const light::Flux seen{p.flux, p.sigma};
      const light::Flux written = columns.flux.empty() ? magnitude_in_place(c, seen) : seen;
      add(value, polhode::detail::number_text(written.value));
      add(columns.sigma, polhode::detail::number_text(written.sigma));
      for (int i = 0; i < 3; ++i)
        add(columns.to_sun[static_cast<std::size_t>(i)], polhode::detail::number_text(p.to_sun[i]));
      for (int i = 0; i < 3; ++i)
        add(columns.to_observer[static_cast<std::size_t>(i)],
            polhode::detail::number_text(p.to_observer[i]));
      end_row();
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

}  // namespace io
}  // namespace v0
}  // namespace polhode
