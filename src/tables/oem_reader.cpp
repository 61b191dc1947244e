// SPDX-License-Identifier: MIT
#include <array>
#include <optional>
#include <utility>

#include "polhode/tables/oem.hpp"
#include "tables/detail/gzip_file.hpp"
#include "tables/detail/kvn_reader.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::KvnLine;

constexpr std::size_t largest_ephemeris = std::size_t{1} << 30;
constexpr std::string_view oem_versions[] = {"1.0", "2.0", "3.0"};

class OemReader {
 public:
  OemReader(std::string_view text, std::string name)
      : lines_(text, std::move(name), "OEM", oem_versions) {}
  OrbitEphemeris read();

 private:
  void read_meta();
  bool read_rows();  // whether another segment follows
  void read_row(const KvnLine& line);
  void skip_covariance();

  detail::KvnEphemerisReader lines_;
  OrbitEphemeris result_;
};

OrbitEphemeris OemReader::read() {
  detail::KvnHeader header = lines_.read_header();
  result_.version = std::move(header.version);
  result_.creation_date = std::move(header.creation_date);
  result_.originator = std::move(header.originator);
  do read_meta();
  while (read_rows());
  return std::move(result_);
}

void OemReader::read_meta() {
  lines_.read_metadata();
  const auto either = [&](std::string_view key, std::string_view otherwise) {
    return lines_.needed(lines_.has(key) ? key : otherwise);
  };
  OemSegment segment{.object_name = lines_.needed("OBJECT_NAME"),
                     .object_id = lines_.needed("OBJECT_ID"),
                     .center = lines_.needed("CENTER_NAME"),
                     .frame = lines_.needed("REF_FRAME"),
                     .frame_line = lines_.line_of("REF_FRAME"),
                     .time_system = lines_.read_time_system(),
                     .start = either("USEABLE_START_TIME", "START_TIME"),
                     .stop = either("USEABLE_STOP_TIME", "STOP_TIME"),
                     .epochs = {},
                     .t = {},
                     .position = {},
                     .velocity = {}};
  for (const std::string* date : {&segment.start, &segment.stop})
    lines_.date(*date, " as start or stop");
  result_.segments.push_back(std::move(segment));
}

bool OemReader::read_rows() {
  bool more = false;
  while (const std::optional<KvnLine> line = lines_.next()) {
    if (line->kind == KvnLine::Kind::comment) continue;
    if ((more = line->key == "META_START")) break;
    if (line->key == "COVARIANCE_START")
      skip_covariance();
    else if (line->kind == KvnLine::Kind::data)
      read_row(*line);
    else
      lines_.unexpected(*line, "among the data", "a row, COVARIANCE_START or META_START");
  }
  if (result_.segments.back().t.empty()) lines_.fail("a segment without rows");
  return more;
}

void OemReader::read_row(const KvnLine& line) {
  OemSegment& segment = result_.segments.back();
  const std::vector<std::string_view> fields = lines_.fields(line);
  if (fields.size() != 7 && fields.size() != 10)
    lines_.fail("got " + std::to_string(fields.size()) +
                " fields; expected date, position and velocity (7), or with acceleration (10)");
  const double t = lines_.read_seconds(fields[0]);
  std::array<double, 6> x{};
  for (std::size_t i = 0; i < x.size(); ++i)
    x.at(i) = lines_.number(fields[i + 1], i < 3 ? "position" : "velocity");
  segment.epochs.emplace_back(fields[0]);
  segment.t.push_back(t);
  segment.position.push_back({x[0], x[1], x[2]});
  segment.velocity.push_back({x[3], x[4], x[5]});
}

void OemReader::skip_covariance() {
  while (const std::optional<KvnLine> line = lines_.next())
    if (line->key == "COVARIANCE_STOP") return;
  lines_.fail("the file ends before COVARIANCE_STOP");
}

}  // namespace

OrbitEphemeris oem_from_text(std::string_view text, const std::string& name) {
  return OemReader(text, detail::printable(name, name.size())).read();
}

OrbitEphemeris read_oem(const std::string& path) {
  return oem_from_text(detail::text_of_file(path, largest_ephemeris),
                       path == "-" ? "<stdin>" : path);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
