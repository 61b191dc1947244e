// SPDX-License-Identifier: MIT
// A file that changes only as a whole and can be taken back: writes wait in memory until commit();
// what a commit overwrites of the file as it was at the last savepoint is kept in PATH-undo first.
// A process that is killed at any moment leaves a file that goes back to its savepoint, byte for
// byte.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

class JournaledFile {
 public:
  // A state to go back to: the length of the file, and a number that no other savepoint of it has.
  struct Savepoint {
    std::int64_t bytes;
    std::int64_t number;
  };

  // An empty file; DomainError when it cannot be made.
  explicit JournaledFile(std::string path);
  // The file that is there, taken back to a savepoint; DomainError when it is not its file.
  JournaledFile(std::string path, const Savepoint& savepoint);
  ~JournaledFile();
  JournaledFile(const JournaledFile&) = delete;
  JournaledFile& operator=(const JournaledFile&) = delete;

  std::int64_t bytes() const { return bytes_; }
  // With what waits; zeros beyond the end. False when the file cannot be read.
  bool read(std::uint64_t offset, std::span<char> out) const;
  bool write(std::uint64_t offset, std::span<const char> bytes);
  // Makes what waits the file, `bytes` long. OutputError when the disk is full: the file is as it
  // was, and all still waits.
  void commit(std::int64_t bytes);
  // All of it is on the disk when this returns.
  void sync() const;
  // From now on it can be taken back to its state of now, and no further.
  void savepoint(std::int64_t number);
  void forget_savepoints();

 private:
  static constexpr std::uint64_t page_bytes = 4096;
  using Page = std::array<char, page_bytes>;

  static bool can_roll_back(const std::string& path, const Savepoint& savepoint);
  void roll_back(const Savepoint& savepoint);
  void keep_old_pages();
  using Pages = std::map<std::uint64_t, Page>;
  // A page to write into, as it is in the file where not `all` of it will be written. Null when the
  // file cannot be read.
  Page* waiting_page(std::uint64_t page, bool all);
  bool put_page(std::uint64_t page, const Page& bytes, std::int64_t length) const;
  using Place = Pages::const_iterator;
  // Those that follow each other, in one call. Where they end: `begin` where it failed.
  Place put_run(Place begin, Place end, std::int64_t length) const;
  bool put_all(Place begin, Place end, std::int64_t length) const;
  void keep_pages(std::int64_t old_bytes);
  [[noreturn]] void fail(int error_number) const;

  std::string path_;
  int descriptor_;
  int undo_ = -1;
  std::int64_t bytes_ = 0;        // of the file
  Savepoint savepoint_{0, 0};     // 0 bytes: none
  std::set<std::uint64_t> kept_;  // pages in PATH-undo
  Pages waiting_;
  Pages written_;  // some of the file's pages, as they are there
  std::vector<Pages::node_type> spare_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
