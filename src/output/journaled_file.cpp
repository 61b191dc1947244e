// SPDX-License-Identifier: MIT
#include "output/detail/journaled_file.hpp"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "output/part_file.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "polhode/error.hpp"
#include "polhode/output/sink.hpp"
#include "text/file_bytes.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::string_view title = "polhode undo 1";

off_t offset_of(std::uint64_t x) { return static_cast<off_t>(x); }

bool written(int descriptor, std::string_view bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor, bytes.data(), bytes.size(), offset_of(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = ENOSPC;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
    offset += static_cast<std::uint64_t>(n);
  }
  return true;
}

// Zeros beyond the end.
bool read_at(int descriptor, std::span<char> out, std::uint64_t offset) {
  while (!out.empty()) {
    const ssize_t n = ::pread(descriptor, out.data(), out.size(), offset_of(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    if (n == 0) {
      std::fill(out.begin(), out.end(), '\0');
      return true;
    }
    out = out.subspan(static_cast<std::size_t>(n));
    offset += static_cast<std::uint64_t>(n);
  }
  return true;
}

// One piece of an undo file: what stood at `offset`.
struct Piece {
  std::uint64_t offset = 0;
  std::string bytes;
  std::uint64_t hash = 0;

  void serialize(Archive& visit) { visit.all(offset, bytes, hash); }
  std::uint64_t true_hash() const { return fingerprint(bytes) ^ offset; }
};

// Of the undo file of `path`, up to the first that was not written to its end: the file has not
// been changed there yet. None where there is no undo file.
std::vector<Piece> pieces_of(const std::string& path, const JournaledFile::Savepoint& savepoint) {
  const std::string undo = file_bytes(undo_path(path)).value_or("");
  std::vector<Piece> pieces;
  Archive reader(undo);
  try {
    std::string head;
    JournaledFile::Savepoint of{};
    reader.all(head, of.bytes, of.number);
    if (head != title || of.bytes != savepoint.bytes || of.number != savepoint.number) return {};
    while (!reader.is_done()) {
      Piece piece;
      piece.serialize(reader);
      if (piece.hash != piece.true_hash()) break;
      pieces.push_back(std::move(piece));
    }
  } catch (const DomainError&) {  // the bytes end within a piece
  }
  return pieces;
}

}  // namespace

JournaledFile::JournaledFile(std::string path)
    : path_(std::move(path)), descriptor_(new_part(path_)) {
  ::unlink(undo_path(path_).c_str());  // of another run
}

JournaledFile::JournaledFile(std::string path, const Savepoint& savepoint)
    : path_(std::move(path)),
      descriptor_(reopened_part(path_, {savepoint.bytes, "", can_roll_back(path_, savepoint)})),
      bytes_(savepoint.bytes) {
  try {
    roll_back(savepoint);
    this->savepoint(savepoint.number);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

JournaledFile::~JournaledFile() {
  if (undo_ >= 0) {
    ::close(undo_);
    if (kept_.empty()) ::unlink(undo_path(path_).c_str());
  }
  ::close(descriptor_);
}

void JournaledFile::fail(int error_number) const { fail_to_write(path_, error_number); }

bool JournaledFile::can_roll_back(const std::string& path, const Savepoint& savepoint) {
  return !pieces_of(path, savepoint).empty();
}

void JournaledFile::roll_back(const Savepoint& savepoint) {
  for (const Piece& piece : pieces_of(path_, savepoint))
    if (!written(descriptor_, piece.bytes, piece.offset)) fail(errno);
  if (::ftruncate(descriptor_, savepoint.bytes) != 0) fail(errno);
  sync();
}

bool JournaledFile::read(std::uint64_t offset, std::span<char> out) const {
  if (!read_at(descriptor_, out, offset)) return false;
  const std::uint64_t end = offset + out.size();
  for (auto i = waiting_.lower_bound(offset / page_bytes);
       i != waiting_.end() && i->first * page_bytes < end; ++i) {
    const std::uint64_t first = std::max(offset, i->first * page_bytes);
    const std::uint64_t last = std::min(end, (i->first + 1) * page_bytes);
    std::memcpy(out.data() + (first - offset), i->second.data() + first % page_bytes, last - first);
  }
  return true;
}

JournaledFile::Page* JournaledFile::waiting_page(std::uint64_t page, bool all) {
  const auto found = waiting_.lower_bound(page);
  if (found != waiting_.end() && found->first == page) return &found->second;
  if (auto known = written_.extract(page)) return &waiting_.insert(found, std::move(known))->second;
  auto i = found;
  if (spare_.empty()) {
    i = waiting_.emplace_hint(found, page, Page{});
  } else {
    spare_.back().key() = page;
    i = waiting_.insert(found, std::move(spare_.back()));
    spare_.pop_back();
  }
  if (all) return &i->second;
  if (static_cast<std::int64_t>(page * page_bytes) >= bytes_) {
    i->second.fill('\0');
  } else if (!read_at(descriptor_, i->second, page * page_bytes)) {
    waiting_.erase(i);
    return nullptr;
  }
  return &i->second;
}

bool JournaledFile::write(std::uint64_t offset, std::span<const char> bytes) {
  while (!bytes.empty()) {
    const std::uint64_t page = offset / page_bytes, from = offset % page_bytes;
    const std::size_t count = std::min<std::size_t>(bytes.size(), page_bytes - from);
    Page* const waiting = waiting_page(page, count == page_bytes);
    if (waiting == nullptr) return false;
    std::memcpy(waiting->data() + from, bytes.data(), count);
    bytes = bytes.subspan(count);
    offset += count;
  }
  return true;
}

bool JournaledFile::put_page(std::uint64_t page, const Page& bytes, std::int64_t length) const {
  const auto begin = static_cast<std::int64_t>(page * page_bytes);
  const auto count = std::clamp<std::int64_t>(length - begin, 0, std::int64_t{page_bytes});
  return written(descriptor_, {bytes.data(), static_cast<std::size_t>(count)}, page * page_bytes);
}

JournaledFile::Place JournaledFile::put_run(Place begin, Place end, std::int64_t length) const {
  constexpr std::size_t most = 64;
  std::array<iovec, most> parts;
  std::size_t count = 0;
  Place next = begin;
  for (; next != end && count < most && next->first == begin->first + count &&
         static_cast<std::int64_t>((next->first + 1) * page_bytes) <= length;
       ++next)
    parts[count++] = {const_cast<char*>(next->second.data()), page_bytes};  // NOLINT: it is read
  if (count > 1 &&
      ::pwritev(descriptor_, parts.data(), static_cast<int>(count),
                offset_of(begin->first * page_bytes)) == static_cast<ssize_t>(count * page_bytes))
    return next;
  // one that is cut, one alone, or an error, which shows again
  return put_page(begin->first, begin->second, length) ? std::next(begin) : begin;
}

bool JournaledFile::put_all(Place begin, Place end, std::int64_t length) const {
  while (begin != end) {
    const Place before = std::exchange(begin, put_run(begin, end, length));
    if (begin == before) return false;
  }
  return true;
}

// Before a byte of the marked state is overwritten, it is in PATH-undo, on the disk.
void JournaledFile::keep_old_pages() {
  Archive added;
  std::vector<std::uint64_t> pages;
  for (const auto& [page, bytes] : waiting_) {
    const auto begin = static_cast<std::int64_t>(page * page_bytes);
    if (begin >= savepoint_.bytes || kept_.contains(page)) continue;
    const auto count = std::min<std::int64_t>(page_bytes, savepoint_.bytes - begin);
    Piece piece{page * page_bytes, std::string(static_cast<std::size_t>(count), '\0'), 0};
    if (!read_at(descriptor_, piece.bytes, piece.offset)) fail(errno);
    piece.hash = piece.true_hash();
    piece.serialize(added);
    pages.push_back(page);
  }
  if (pages.empty()) return;
  if (undo_ < 0) {
    undo_ = ::open(undo_path(path_).c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (undo_ < 0) fail(errno);
  }
  const off_t end = ::lseek(undo_, 0, SEEK_END);
  Archive head;
  if (end == 0) {
    std::string text(title);
    head.all(text, savepoint_.bytes, savepoint_.number);
  }
  if (!written(undo_, head.bytes() + added.bytes(), static_cast<std::uint64_t>(end)) ||
      ::fdatasync(undo_) != 0) {
    const int error_number = errno;
    if (::ftruncate(undo_, end) != 0) errno = error_number;
    fail(error_number);
  }
  kept_.insert(pages.begin(), pages.end());
}

void JournaledFile::commit(std::int64_t bytes) {
  keep_old_pages();
  // What is new first: it needs space on the disk, and nothing refers to it yet.
  const auto first_new = std::as_const(waiting_).lower_bound(
      (static_cast<std::uint64_t>(bytes_) + page_bytes - 1) / page_bytes);
  bool good = put_all(first_new, waiting_.end(), bytes);
  const bool reached =
      !waiting_.empty() &&
      static_cast<std::int64_t>((waiting_.rbegin()->first + 1) * page_bytes) >= bytes;
  good = good && (bytes <= bytes_ || reached || ::ftruncate(descriptor_, bytes) == 0);
  if (!good) {
    const int error_number = errno;
    if (::ftruncate(descriptor_, bytes_) != 0) fail(errno);
    fail(error_number);
  }
  if (!put_all(waiting_.begin(), first_new, bytes)) fail(errno);
  if (bytes < bytes_ && ::ftruncate(descriptor_, bytes) != 0) fail(errno);
  keep_pages(std::exchange(bytes_, bytes));
}

// Those that stood in the file before, and one that it ends in, are written again and again: they
// are kept as they are. The others are room for new ones.
void JournaledFile::keep_pages(std::int64_t old_bytes) {
  constexpr std::size_t most = 64;
  if (bytes_ < old_bytes || written_.size() > most) written_.clear();
  while (!waiting_.empty()) {
    auto page = waiting_.extract(waiting_.begin());
    const auto begin = static_cast<std::int64_t>(page.key() * page_bytes);
    const std::int64_t inside = bytes_ - begin;
    if (inside > 0 && (begin < old_bytes || inside < std::int64_t{page_bytes})) {
      if (inside < std::int64_t{page_bytes})
        std::fill(page.mapped().begin() + inside, page.mapped().end(), '\0');
      written_.insert(std::move(page));
    } else if (spare_.size() < most) {
      spare_.push_back(std::move(page));
    }
  }
}

void JournaledFile::sync() const {
  if (::fsync(descriptor_) != 0) fail(errno);
}

void JournaledFile::savepoint(std::int64_t number) {
  if (undo_ >= 0 && ::ftruncate(undo_, 0) != 0) ::close(std::exchange(undo_, -1));
  if (undo_ < 0) ::unlink(undo_path(path_).c_str());
  savepoint_ = {bytes_, number};
  kept_.clear();
}

void JournaledFile::forget_savepoints() {
  savepoint_ = {0, 0};
  ::unlink(undo_path(path_).c_str());
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
