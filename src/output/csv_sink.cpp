// SPDX-License-Identifier: MIT
// CSV: `#` lines with provenance, one header line, shortest round-trip numbers.
#include "output/comments.hpp"
#include "output/part_file.hpp"
#include "output/sinks.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
std::string csv_head(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  std::string out;
  append_origin(out, csv_comments, provenance);
  std::string names, units;
  for (const ColumnGroup& group : groups)
    for (const Column& column : group.columns) {
      names += (names.empty() ? "" : ",") + column.name;
      units += (units.empty() ? "" : ", ") + column.name + " [" + column.unit + "]";
    }
  append_comment(out, csv_comments, "units: ", units);
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
