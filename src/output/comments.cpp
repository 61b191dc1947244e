// SPDX-License-Identifier: MIT
#include "output/comments.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "output/detail/hdf5_handle.hpp"
#include "output/sinks.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr std::string_view of_scenario = "| ";
constexpr std::string_view of_file = "file ";

// What a scenario, its files and the rows are known by.
struct Origin {
  std::vector<std::string> scenario;
  std::vector<std::string> files;
  std::vector<std::string> columns;  // the head line of a CSV file; groups of HDF5; not of an AEM
};

// From lines of comments, and the first line of a CSV file that is not a comment.
Origin origin_in(std::istream& lines, const CommentStyle& style) {
  Origin origin;
  std::string line;
  while (std::getline(lines, line)) {
    if (!line.starts_with(style.start)) {
      if (style.start == csv_comments.start) {
        origin.columns.push_back(line);
        break;
      }
      if (line.starts_with("META_START")) break;
      continue;  // keywords of an AEM
    }
    const std::string_view text = std::string_view(line).substr(style.start.size());
    if (text.starts_with(of_scenario)) origin.scenario.emplace_back(text);
    if (text.starts_with(of_file)) origin.files.emplace_back(text);
  }
  return origin;
}

Origin origin_of_text(const std::string& path, const CommentStyle& style) {
  std::ifstream file(path, std::ios::binary);
  return origin_in(file, style);
}

std::string group_text(const std::string& name, const std::vector<std::string>& columns) {
  std::string text = name + ":";
  for (const std::string& column : columns) text += " " + column;
  return text;
}

// Every dataset with its columns, by name.
std::vector<std::string> groups_in(hid_t file) {
  std::vector<std::string> groups;
  H5G_info_t info;
  if (H5Gget_info(file, &info) < 0) return groups;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    char name[256] = {};
    H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name, H5P_DEFAULT);
    const Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
    groups.push_back(group_text(name, attribute_texts(dataset.id(), "columns")));
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

Origin origin_of_hdf5(const std::string& path) {
  const QuietScope quiet;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  Origin origin;
  if (file.id() < 0) return origin;
  origin.scenario = attribute_texts(file.id(), "scenario");
  for (std::string& note : attribute_texts(file.id(), "notes"))
    if (note.starts_with(of_file)) origin.files.push_back(std::move(note));
  origin.columns = groups_in(file.id());
  return origin;
}

std::string difference(const Origin& found, const Origin& wanted) {
  if (found.scenario.empty()) return "and does not say of which scenario";
  if (found.scenario != wanted.scenario) return "of another scenario";
  if (found.files != wanted.files) return "of this scenario with other files";
  return found.columns == wanted.columns ? "" : "of another run or map of this scenario";
}

Origin as_csv(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  std::istringstream lines(csv_head(groups, provenance));
  return origin_in(lines, csv_comments);
}

Origin as_aem(const Provenance& provenance) {
  std::string text;
  append_origin(text, aem_comments, provenance);
  std::istringstream lines(text);
  return origin_in(lines, aem_comments);
}

Origin as_hdf5(const std::vector<ColumnGroup>& groups, const Provenance& provenance) {
  Origin origin{{provenance.scenario_text}, {}, {}};
  for (const ColumnGroup& group : groups) {
    std::vector<std::string> columns;
    for (const Column& column : group.columns) columns.push_back(column.name);
    if (!columns.empty()) origin.columns.push_back(group_text(group.name, columns));
  }
  std::sort(origin.columns.begin(), origin.columns.end());
  for (const std::string& note : provenance.notes)
    if (note.starts_with(of_file)) origin.files.push_back(note);
  return origin;
}

}  // namespace

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
  add(of_scenario, provenance.scenario_text);
}

std::string foreign_origin(const std::string& path, const std::vector<ColumnGroup>& groups,
                           const Provenance& provenance) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".h5") return difference(origin_of_hdf5(path), as_hdf5(groups, provenance));
  if (extension == ".aem")
    return difference(origin_of_text(path, aem_comments), as_aem(provenance));
  return difference(origin_of_text(path, csv_comments), as_csv(groups, provenance));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
