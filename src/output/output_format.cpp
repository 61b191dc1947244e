// SPDX-License-Identifier: MIT
#include "polhode/output/output_format.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "output/formats/formats.hpp"
#include "output/part_file.hpp"
#include "text/dates.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

std::string shown(const std::string& path) { return detail::printable(path, path.size()); }

std::string in_words(const std::vector<std::string>& words) {
  return detail::one_of(std::vector<std::string_view>(words.begin(), words.end()));
}

void require_plain(const OutputFormat& format) {
  const std::string_view extension = format.extension;
  if (!detail::is_name(format.name) || format.name == "columns")
    throw DomainError("output format: got the name \"" + format.name +
                      "\"; expected letters, digits, - and _, and not \"columns\"");
  if (extension.size() < 2 || extension[0] != '.' || !detail::is_name(extension.substr(1)) ||
      extension == ".part" || extension == ".checkpoint")
    throw DomainError("output format " + format.name + ": got the extension \"" + format.extension +
                      "\"; expected one such as \".csv\"");
  if (format.help.empty() || !format.open)
    throw DomainError("output format " + format.name + ": expected a text and a function open");
}

void require_columns(const std::vector<std::string>& names, const SinkRequest& request) {
  for (const std::string& name : names)
    if (std::none_of(request.groups.begin(), request.groups.end(),
                     [&](const ColumnGroup& group) { return group.name == name; }))
      throw DomainError(shown(request.path) + ": expected \"" + name +
                        "\" among the columns of [output]");
}

// Whether the run has what the format needs.
void require_needs(const OutputFormat& format, const SinkRequest& request) {
  const FormatNeeds& needs = format.needs;
  const RunFacts& run = request.provenance.run;
  const std::string path = shown(request.path) + ": ";
  if (needs.file && (request.path == "-" || detail::part_path(request.path) == request.path))
    throw DomainError(path + "is not a regular file; " + format.label + " needs one");
  if (needs.dates && run.epoch.empty())
    throw DomainError(path + format.label + " has dates; expected epoch in [state]");
  if (needs.dates && detail::scale_of_epoch(run.epoch) == "UT1")
    throw DomainError(path +
                      "the epoch is in UT1, which does not run evenly; expected UTC, TAI, "
                      "TT or TDB");
  if (needs.rising && !run.rising)
    throw DomainError(path + "the dates of " + format.label +
                      " rise; expected times in [time] that rise");
  if (format.columns) require_columns(format.columns(request), request);
}

bool reads(const OutputFormat* format) { return format != nullptr && format->rows; }

}  // namespace

OutputFormats::OutputFormats(std::vector<OutputFormat> all) {
  for (auto format = all.begin(); format != all.end(); ++format) {
    require_plain(*format);
    for (auto other = all.begin(); other != format; ++other)
      if (other->name == format->name || other->extension == format->extension)
        throw DomainError("output format " + format->name + ", " + format->extension +
                          ": there is " + other->name + ", " + other->extension +
                          "; expected another name and extension");
  }
  all_ = std::make_shared<const std::vector<OutputFormat>>(std::move(all));
}

OutputFormats OutputFormats::with(OutputFormat format) const {
  std::vector<OutputFormat> more = *all_;
  more.push_back(std::move(format));
  return OutputFormats(std::move(more));
}

const OutputFormat* OutputFormats::named(std::string_view name) const {
  for (const OutputFormat& format : *all_)
    if (format.name == name) return &format;
  return nullptr;
}

const OutputFormat* OutputFormats::of_extension(std::string_view path) const {
  const std::string extension = std::filesystem::path(path).extension().string();
  for (const OutputFormat& format : *all_)
    if (format.extension == extension) return &format;
  return nullptr;
}

const OutputFormat* OutputFormats::of_streams() const {
  for (const OutputFormat& format : *all_)
    if (!format.needs.file) return &format;
  return nullptr;
}

const OutputFormat& OutputFormats::of_output(const std::string& path) const {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    throw DomainError(shown(path) + ": is a folder; expected a file to write, " +
                      paths_in_words(*this));
  const bool device = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  const OutputFormat* const own = path == "-" ? nullptr : of_extension(path);
  const OutputFormat* const streamed = of_streams();
  if (own != nullptr) return *own;
  if ((path == "-" || device) && streamed != nullptr) return *streamed;
  std::vector<std::string> extensions;
  for (const OutputFormat& format : *all_) extensions.push_back(format.extension);
  throw DomainError(
      shown(path) + ": the extension says what to write; expected " + in_words(extensions) +
      (streamed == nullptr ? "" : ", or - for " + streamed->label + " to standard output"));
}

OutputFormats default_output_formats() {
  return OutputFormats({detail::csv_format(), detail::hdf5_format(), detail::aem_format()});
}

std::string paths_in_words(const OutputFormats& formats,
                           const std::function<bool(const OutputFormat&)>& of) {
  std::vector<std::string> paths;
  for (const OutputFormat& format : formats.all())
    if (!of || of(format)) paths.push_back("PATH" + format.extension);
  return in_words(paths);
}

bool can_read_rows(const OutputFormats& formats, std::span<const std::string> paths) {
  return std::any_of(paths.begin(), paths.end(),
                     [&](const std::string& path) { return reads(formats.of_extension(path)); });
}

std::vector<double> first_rows(const OutputFormats& formats, std::span<const std::string> paths,
                               const std::vector<ColumnGroup>& groups, std::int64_t count) {
  for (const std::string& path : paths) {
    const OutputFormat* const format = formats.of_extension(path);
    if (!reads(format)) continue;
    std::error_code ignored;
    return format->rows(std::filesystem::exists(path, ignored) ? path : path + ".part", groups,
                        count);
  }
  throw DomainError("rows of an output: got none that is read back; expected " +
                    paths_in_words(formats, [](const OutputFormat& f) { return reads(&f); }));
}

std::unique_ptr<Sink> open_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                                const Provenance& provenance,
                                const std::optional<SinkPosition>& from,
                                const OutputFormats& formats) {
  const OutputFormat& format = formats.of_output(path);
  const std::any nothing;
  const auto asked = provenance.options.find(format.name);
  const SinkRequest request{path, groups, provenance, from,
                            asked == provenance.options.end() ? nothing : asked->second};
  require_needs(format, request);
  return format.open(request);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
