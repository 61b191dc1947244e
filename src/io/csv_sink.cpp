// SPDX-License-Identifier: MIT
// CSV: `#` lines with provenance, one header line, shortest round-trip numbers.
#include <algorithm>

#include "io/detail/number_text.hpp"
#include "io/detail/part_file.hpp"
#include "io/detail/sinks.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

void append_comment(std::string& out, std::string_view lead, std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    out += "# ";
    out += lead;
    out += line;
    out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace

std::string csv_head(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  std::string out = "# polhode " + provenance.version + "\n";
  append_comment(out, "", provenance.title);
  for (const std::string& note : provenance.notes) append_comment(out, "", note);
  for (const std::string& citation : provenance.citations) append_comment(out, "cite: ", citation);
  if (!provenance.scenario_text.empty()) {
    append_comment(out, "scenario: ", provenance.scenario_name);
    append_comment(out, "| ", provenance.scenario_text);
  }
  std::string names, units;
  for (const ColumnGroup& group : groups)
    for (const Column& column : group.columns) {
      names += (names.empty() ? "" : ",") + column.name;
      units += (units.empty() ? "" : ", ") + column.name + " [" + column.unit + "]";
    }
  append_comment(out, "units: ", units);
  return out + names + "\n";
}

namespace {

class CsvSink : public Sink {
 public:
  CsvSink(const std::string& path, const std::vector<ColumnGroup>& groups,
          const Provenance& provenance, const std::optional<SinkPosition>& from)
      : file_(path, from ? std::optional(PartState{from->bytes, csv_head(groups, provenance)})
                         : std::nullopt),
        rows_(from ? from->rows : 0) {
    for (const ColumnGroup& group : groups) width_ += group.columns.size();
    if (!from) file_.write(csv_head(groups, provenance));
  }

  void push(std::span<const double> rows) override {
    text_.resize(rows.size() * static_cast<std::size_t>(longest_number));
    char* end = text_.data();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      end = write_number(end, rows[i]);
      *end++ = (i + 1) % width_ == 0 ? '\n' : ',';
    }
    file_.write({text_.data(), static_cast<std::size_t>(end - text_.data())});
    rows_ += static_cast<std::int64_t>(rows.size() / width_);
  }

  std::optional<SinkPosition> position() override {
    const std::optional<std::int64_t> bytes = file_.synced_bytes();
    return bytes ? std::optional(SinkPosition{*bytes, rows_}) : std::nullopt;
  }

  void finish() override { file_.commit(); }

 private:
  PartFile file_;
  std::int64_t rows_;
  std::size_t width_ = 0;
  std::string text_;
};

}  // namespace

std::unique_ptr<Sink> csv_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                               const Provenance& provenance,
                               const std::optional<SinkPosition>& from) {
  return std::make_unique<CsvSink>(path, groups, provenance, from);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
