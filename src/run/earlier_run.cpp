// SPDX-License-Identifier: MIT
#include "run/detail/earlier_run.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ranges>
#include <sstream>

#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view pointer_head = "the checkpoint is\n";

bool is_there(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// What the file next to an output is, or points to.
std::string followed(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string head(pointer_head.size(), '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!stream || head != pointer_head) return file;
  std::ostringstream rest;
  rest << stream.rdbuf();
  std::string target = rest.str();
  if (target.ends_with('\n')) target.pop_back();
  return (fs::path(file).parent_path() / target).string();
}

}  // namespace

std::string shown_path(const std::string& path) { return printable(path, 500); }

std::string checkpoint_path(const std::string& output) { return output + ".checkpoint"; }

std::string checkpoint_among(std::span<const std::string> outputs, const BeginWords& words) {
  for (const std::string& output : outputs) {
    const std::string own = checkpoint_path(output);
    if (output == "-" || !is_there(own)) continue;
    std::string checkpoint = followed(own);
    if (is_there(checkpoint)) return checkpoint;
    throw DomainError(shown_path(own) +
                      ": an unfinished run or map is there; expected its checkpoint " +
                      shown_path(checkpoint) + ", which is gone: put it back, or " + words.restart +
                      " begins anew");
  }
  return {};
}

void point_to_checkpoint(const std::string& output, const std::string& checkpoint) {
  const fs::path folder = fs::absolute(output).parent_path();
  std::error_code failed;
  fs::path target = fs::proximate(fs::absolute(checkpoint), folder, failed);
  if (failed) target = fs::absolute(checkpoint);
  replace_file(checkpoint_path(output), std::string(pointer_head) + target.string() + "\n");
  sync_folder_of(output);
}

// That of the first output last: what points to it does not outlive it. Then the files that only a
// resume needs.
void forget_checkpoints(std::span<const std::string> outputs) {
  std::error_code ignored;
  for (const std::string& output : outputs | std::views::reverse)
    if (output != "-") fs::remove(checkpoint_path(output), ignored);
  for (const std::string& output : outputs) {
    if (output == "-") continue;
    fs::remove(checkpoint_path(output) + ".part", ignored);
    fs::remove(undo_path(output + ".part"), ignored);
  }
}

void sync_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // a folder that cannot be synced is none of a local disk
  ::close(descriptor);
}

void refuse_unfinished(const std::string& file, const std::string& kind,
                       const std::string& progress, const BeginWords& words) {
  throw DomainError(shown_path(file) + ": an unfinished " + kind + " is there (" +
                    printable(progress, 500) + "); " + words.resume + " continues it, " +
                    words.restart + " begins anew and loses what it has done");
}

bool are_complete(std::span<const PlannedOutput> outputs, const OutputFormats& formats,
                  const Provenance& provenance, const BeginWords& words) {
  if (std::any_of(outputs.begin(), outputs.end(), [](const PlannedOutput& output) {
        return output.path == "-" || !is_there(output.path) || is_there(output.path + ".part");
      }))
    return false;
  for (const auto& [path, groups] : outputs) {
    const OutputFormat& format = formats.of_output(path);
    const std::string why = format.difference ? format.difference(path, groups, provenance)
                                              : "and does not say of which scenario";
    if (!why.empty())
      throw DomainError(shown_path(path) + ": is there, " + why + "; " + words.restart +
                        " runs this one anew");
  }
  return true;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
