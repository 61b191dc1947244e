// SPDX-License-Identifier: MIT
// Light curves in the ALCDEF format.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/light/light_curve.hpp"
#include "polhode/tables/light_curve_file.hpp"
#include "tables/detail/gzip_file.hpp"
#include "tables/detail/kvn_reader.hpp"
#include "tables/detail/light_sessions.hpp"
#include "tables/detail/trimmed.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::KvnLine;

constexpr double day_in_s = 86400.0;
constexpr std::size_t longest_line = 500;  // of what is written

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

constexpr std::string_view read_keywords[] = {
    "OBJECTNUMBER", "OBJECTNAME", "MPCDESIG", "DELIMITER", "DIFFERMAGS",  "STANDARD",   "LTCAPP",
    "REDUCEDMAGS",  "LTCDAYS",    "MAGBAND",  "FILTER",    "SESSIONDATE", "SESSIONTIME"};

class AlcdefReader {
 public:
  AlcdefReader(std::string_view text, const std::string& shown,
               const std::optional<ephemeris::Date>& epoch, std::span<const std::size_t> leave_out)
      : lines_(text, shown),
        times_(detail::light_times(shown, ephemeris::TimeScale::UTC, epoch)),
        leave_out_(leave_out) {
    result_.file = shown;
  }

  LightCurveFile read() {
    std::optional<KvnLine> line = lines_.next();
    if (!line) lines_.fail("has no session; expected STARTMETADATA");
    while (line) {
      if (!is_word(*line, "STARTMETADATA")) unexpected(*line, "STARTMETADATA");
      LightSession session;
      session.line = lines_.line_number();
      read_metadata(session);
      require_same_object(session);
      declare(session);
      line = read_rows(session);
      detail::take_magnitudes(session);
      result_.sessions.push_back(std::move(session));
    }
    result_.epoch = times_.epoch();
    return std::move(result_);
  }

 private:
  static bool is_word(const KvnLine& line, std::string_view word) {
    return line.kind == KvnLine::Kind::word && line.key == word;
  }
  [[noreturn]] void unexpected(const KvnLine& line, const std::string& expected) const {
    lines_.fail("got \"" + detail::printable(line.key.empty() ? line.value : line.key) +
                "\"; expected " + expected);
  }
  [[noreturn]] void refuse(std::string_view key, std::string_view value,
                           const std::string& expected) const {
    lines_.fail(std::string(key) + ": got \"" + detail::printable(value) + "\"; expected " +
                expected);
  }

  void read_metadata(LightSession& session) {
    while (const std::optional<KvnLine> line = lines_.next()) {
      if (is_word(*line, "ENDMETADATA")) return;
      if (line->kind == KvnLine::Kind::comment) {
        session.notes.emplace_back("COMMENT", line->value.substr(line->value.starts_with('=')));
        continue;
      }
      if (line->kind != KvnLine::Kind::pair) unexpected(*line, "KEYWORD=VALUE or ENDMETADATA");
      std::string key = upper(line->key);
      // keywords that are not read may come twice: EPOCH is also that of the comparison star
      const std::string* const before = note(session, key);
      if (before != nullptr && *before != line->value &&
          std::ranges::find(read_keywords, key) != std::end(read_keywords))
        lines_.fail(detail::printable(key) + " is there twice, \"" + detail::printable(*before) +
                    "\" and \"" + detail::printable(line->value) + "\"");
      session.notes.emplace_back(std::move(key), line->value);
    }
    lines_.fail("the file ends before ENDMETADATA");
  }

  // The value of a keyword, null where it is not there.
  static const std::string* note(const LightSession& session, std::string_view key) {
    const auto found = std::find_if(session.notes.begin(), session.notes.end(),
                                    [&](const auto& pair) { return pair.first == key; });
    return found == session.notes.end() ? nullptr : &found->second;
  }
  static std::string value(const LightSession& session, std::string_view key) {
    const std::string* const found = note(session, key);
    return found == nullptr ? std::string() : *found;
  }

  // One object a file, as far as the sessions name it: by the first of these that both have, as
  // names are spelled in more than one way and designations are many.
  void require_same_object(const LightSession& session) {
    bool is_known = false;
    for (Identity& known : identity_) {
      const std::string own = value(session, known.key);
      if (own.empty() || (own == "0" && known.key == "OBJECTNUMBER")) continue;
      if (known.line == 0) {
        known.value = own;
        known.line = session.line;
      } else if (!is_known) {
        if (own != known.value)
          refuse(known.key, own,
                 detail::printable(known.value) + ", as in the session of line " +
                     std::to_string(known.line) + ": one object a file");
        is_known = true;
      }
    }
    const auto& [number, name, designation] = identity_;
    const std::string& called = name.line > 0 ? name.value : designation.value;
    result_.object = number.value + (number.line == 0 || called.empty() ? "" : " ") + called;
  }

  // Lines DATA of a session. Gives what begins the next one, if there is one.
  std::optional<KvnLine> read_rows(LightSession& session) {
    const std::string delimiter = upper(value(session, "DELIMITER"));
    if (delimiter != "PIPE" && delimiter != "TAB") refuse("DELIMITER", delimiter, "PIPE or TAB");
    std::optional<KvnLine> line;
    while ((line = lines_.next())) {
      const bool is_row = line->kind == KvnLine::Kind::pair && line->key == "DATA";
      if (is_row && std::ranges::find(leave_out_, lines_.line_number()) != leave_out_.end()) {
        session.left_out.push_back(lines_.line_number());
        continue;
      }
      if (is_row) {
        read_row(session, line->value, delimiter == "TAB" ? '\t' : '|');
        continue;
      }
      if (is_word(*line, "ENDDATA"))
        line = lines_.next();
      else if (!is_word(*line, "STARTMETADATA"))
        unexpected(*line, "DATA=..., ENDDATA or STARTMETADATA");
      break;
    }
    if (session.curve.points.empty() && session.left_out.empty())
      lines_.fail("the session of line " + std::to_string(session.line) +
                  " has no points; expected DATA=...");
    return line;
  }

  void read_row(LightSession& session, std::string_view rest, char delimiter) {
    std::vector<std::string_view> fields;
    for (bool more = true; more;) {
      const std::size_t end = std::min(rest.find(delimiter), rest.size());
      fields.push_back(detail::trimmed(rest.substr(0, end), " "));
      more = end < rest.size();
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (fields.size() < 2 || fields.size() > 4)
      lines_.fail("got " + std::to_string(fields.size()) +
                  " fields; expected DATA=JD, magnitude, its error and airmass, of which the last "
                  "two may be missing");
    light::LightPoint p;
    try {
      p.t = times_.of_julian_date(fields[0]);
    } catch (const DomainError& error) {
      lines_.fail("\"" + detail::printable(fields[0]) + "\" " + error.what());
    }
    p.flux = lines_.number(fields[1], "magnitude");
    if (const std::string flaw = detail::magnitude_flaw(p.flux); !flaw.empty()) lines_.fail(flaw);
    if (fields.size() > 2 && !fields[2].empty())
      p.sigma = lines_.number(fields[2], "error of the magnitude");
    session.curve.points.push_back(p);
    session.lines.push_back(lines_.line_number());
  }

  // What the keywords say, and no more.
  void declare(LightSession& session) const {
    const auto word = [&](std::string_view key) { return upper(value(session, key)); };
    const std::string differ = word("DIFFERMAGS"), standard = word("STANDARD");
    if (!differ.empty() && differ != "TRUE" && differ != "FALSE")
      refuse("DIFFERMAGS", differ, "TRUE or FALSE");
    session.curve.is_calibrated =
        differ == "FALSE" && !standard.empty() && standard != "NONE" && standard != "INTERNAL";
    const auto is_applied = [](const std::string& way) {
      return way == "AVERAGE" || way == "POINT";
    };
    const std::string applied = word("LTCAPP"), reduced = word("REDUCEDMAGS");
    if (applied == "NONE") session.times = light::LightTime::at_observer;
    if (is_applied(applied)) session.times = light::LightTime::at_body;
    if (reduced == "NONE") session.distances = Distances::of_the_time;
    if (is_applied(reduced)) session.distances = Distances::unit;
    if (const std::string days = value(session, "LTCDAYS"); !days.empty()) {
      const double correction = lines_.number(days, "LTCDAYS");
      if (correction > 0.0)
        refuse("LTCDAYS", days, "0 or less, as it is added to the times at the observer");
      if (correction != 0.0) session.light_time = -correction * day_in_s;
    }
    session.band = value(session, "MAGBAND");
    if (session.band.empty()) session.band = value(session, "FILTER");
    std::string name;
    for (const char* key : {"SESSIONDATE", "SESSIONTIME", "FILTER"}) {
      const std::string part = detail::printable(value(session, key));
      if (!part.empty()) name += (name.empty() ? "" : " ") + part;
    }
    session.curve.name = name.empty() ? std::to_string(result_.sessions.size() + 1) : name;
  }

  detail::KvnReader lines_;
  detail::LightTimes times_;
  std::span<const std::size_t> leave_out_;
  LightCurveFile result_;
  struct Identity {
    std::string_view key;
    std::string value = {};
    std::size_t line = 0;  // of the session that said it first; 0: none
  };
  std::array<Identity, 3> identity_ = {Identity{"OBJECTNUMBER"}, Identity{"OBJECTNAME"},
                                       Identity{"MPCDESIG"}};
};

[[noreturn]] void fail_to_write(std::size_t curve, const std::string& what) {
  throw DomainError("alcdef_text: light curve " + std::to_string(curve + 1) + what);
}

// When a session begins, to a second.
std::string began_text(const ephemeris::Date& date) {
  const ephemeris::CalendarTime t = ephemeris::calendar_time(date);
  std::array<char, 80> text;
  std::snprintf(text.data(), text.size(),
                "SESSIONDATE=%04d-%02d-%02d\nSESSIONTIME=%02d:%02d:%02d\n", t.year, t.month, t.day,
                t.hour, t.minute, static_cast<int>(t.second));
  return text.data();
}

}  // namespace

LightCurveFile alcdef_from_text(std::string_view text, const std::string& name,
                                const std::optional<ephemeris::Date>& epoch,
                                std::span<const std::size_t> leave_out) {
  const std::string shown = detail::printable(name, detail::longest_path);
  detail::require_size(text, shown);
  return AlcdefReader(text, shown, epoch, leave_out).read();
}

LightCurveFile read_alcdef(const std::string& path, const std::optional<ephemeris::Date>& epoch,
                           std::span<const std::size_t> leave_out) {
  return alcdef_from_text(detail::text_of_file(path, detail::largest_light_file), path, epoch,
                          leave_out);
}

std::string alcdef_text(std::span<const light::LightCurve> curves, const ephemeris::Date& epoch,
                        const AlcdefHead& head) {
  if (curves.empty())
    throw DomainError("alcdef_text: there are no light curves; expected one or more");
  std::string text;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::vector<light::LightPoint>& points = curves[c].points;
    if (points.empty()) fail_to_write(c, " has no points; expected one or more");
    const auto date = [&](const light::LightPoint& p) {
      return ephemeris::converted(ephemeris::date_after(epoch, p.t), ephemeris::TimeScale::UTC);
    };
    text += "STARTMETADATA\nOBJECTNAME=" + detail::printable(head.object, longest_line) + "\n";
    for (std::size_t k = 0; k < points.size(); ++k) {
      const light::LightPoint& p = points[k];
      const light::Magnitude m = light::magnitude_of({p.flux, p.sigma});
      if (!std::isfinite(p.t) || !std::isfinite(m.value) || !std::isfinite(m.sigma))
        fail_to_write(c, ": point " + std::to_string(k + 1) +
                             ": expected a finite time and a flux above 0, which has a magnitude");
      if (k == 0) {
        text += began_text(date(p));
        text += curves[c].is_calibrated ? "DIFFERMAGS=FALSE\nSTANDARD=OTHER\n"
                                        : "DIFFERMAGS=TRUE\nSTANDARD=NONE\n";
        text += std::string("LTCAPP=") +
                (head.times == light::LightTime::at_body ? "POINT" : "NONE") +
                "\nREDUCEDMAGS=" + (head.is_of_the_time ? "NONE" : "POINT") + "\n";
        for (const std::string& note : head.notes)
          text += "COMMENT=" + detail::printable(note, longest_line) + "\n";
        text += "DELIMITER=PIPE\nENDMETADATA\n";
      }
      text += "DATA=" + detail::julian_text(date(p)) + "|" + polhode::detail::number_text(m.value) +
              "|" + polhode::detail::number_text(m.sigma) + "\n";
    }
    text += "ENDDATA\n";
  }
  return text;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
