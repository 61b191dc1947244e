// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "output/output_notes.hpp"
#include "output/part_file.hpp"
#include "polhode/output/output_format.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::Origin;

class TextSink : public Sink, public detail::ClosingNotes {
 public:
  using AppendRow = std::function<void(std::string&, std::span<const double>)>;

  TextSink(const SinkRequest& request, const std::string& head, AppendRow row, std::string end,
           const CommentStyle& closing)
      : file_(request.path, request.from
                                ? std::optional(detail::PartState{request.from->bytes, head})
                                : std::nullopt),
        row_(std::move(row)),
        end_(std::move(end)),
        closing_(closing),
        rows_(request.from ? request.from->rows : 0) {
    for (const ColumnGroup& group : request.groups) width_ += group.columns.size();
    if (!request.from) file_.write(head);
  }

  void push(std::span<const double> rows) override {
    text_.clear();
    for (std::size_t i = 0; i < rows.size(); i += width_) row_(text_, rows.subspan(i, width_));
    file_.write(text_);
    rows_ += static_cast<std::int64_t>(rows.size() / width_);
  }

  std::optional<SinkPosition> position() override {
    const std::optional<std::int64_t> bytes = file_.synced_bytes();
    return bytes ? std::optional(SinkPosition{*bytes, rows_}) : std::nullopt;
  }

  void close_with(const std::string& name, const std::vector<std::string>& notes) override {
    if (closing_.start.empty()) return;
    for (const std::string& note : notes) append_comment(end_, closing_, name + ": ", note);
  }

  void finish() override {
    if (!end_.empty()) file_.write(end_);
    file_.commit();
  }

 private:
  detail::PartFile file_;
  AppendRow row_;
  std::string end_;
  CommentStyle closing_;
  std::int64_t rows_;
  std::size_t width_ = 0;
  std::string text_;
};

Origin origin_in(std::istream& lines, const CommentStyle& style) {
  Origin origin;
  std::string line;
  while (std::getline(lines, line)) {
    if (!line.starts_with(style.start)) {
      if (style.head_end.empty()) {
        origin.columns.push_back(line);
        break;
      }
      if (line.starts_with(style.head_end)) break;
      continue;
    }
    const std::string_view text = std::string_view(line).substr(style.start.size());
    if (text.starts_with(detail::scenario_lead)) origin.scenario.emplace_back(text);
    if (text.starts_with(detail::file_lead)) origin.files.emplace_back(text);
  }
  return origin;
}

}  // namespace

std::string detail::difference(const Origin& found, const Origin& wanted) {
  if (found.scenario.empty()) return "and does not say of which scenario";
  if (found.scenario != wanted.scenario) return "of another scenario";
  if (found.files != wanted.files) return "of this scenario with other files";
  return found.columns == wanted.columns ? "" : "of another run or map of this scenario";
}

void append_comment(std::string& out, const CommentStyle& style, std::string_view lead,
                    std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    text.remove_prefix(std::min(end + 1, text.size()));
    do {
      const std::string_view piece = line.substr(0, style.longest);
      out += style.start;
      out += lead;
      for (const char c : piece)
        if (!style.ascii || c != '\r') out += !style.ascii || (c >= ' ' && c <= '~') ? c : '?';
      out += '\n';
      line.remove_prefix(piece.size());
    } while (!line.empty());
  }
}

void append_origin(std::string& out, const CommentStyle& style, const Provenance& provenance) {
  const auto add = [&](std::string_view lead, std::string_view text) {
    append_comment(out, style, lead, text);
  };
  add("", "polhode " + provenance.version);
  add("", provenance.title);
  for (const std::string& note : provenance.notes) add("", note);
  for (const std::string& citation : provenance.citations) add("cite: ", citation);
  if (provenance.scenario_text.empty()) return;
  add("scenario: ", provenance.scenario_name);
  add(detail::scenario_lead, provenance.scenario_text);
}

std::string text_difference(const std::string& path, const CommentStyle& style,
                            const std::string& head) {
  std::ifstream found(path, std::ios::binary);
  std::istringstream wanted(head);
  return detail::difference(origin_in(found, style), origin_in(wanted, style));
}

std::unique_ptr<Sink> text_sink(const SinkRequest& request, const std::string& head,
                                std::function<void(std::string&, std::span<const double>)> row,
                                std::string end, const CommentStyle& closing) {
  return std::make_unique<TextSink>(request, head, std::move(row), std::move(end), closing);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
